/* The maps and arguments of the client. The test evaluates the same maps with libglevaluator. */
#ifndef GLEVALUATOR_DROPIN_CLIENT_H_
#define GLEVALUATOR_DROPIN_CLIENT_H_

enum { kOrder = 6, kUOrder = 4, kVOrder = 5, kArguments = 9, kSegments = 7 };

/* Positions are inside the clip volume; feedback returns texture coordinates unchanged. */
static const float kDomain[4] = {0.1f, 0.7f, -0.3f, 0.9f};

static inline float client_point(int i) { return (float)((i * 37 + 11) % 64 - 31) / 3.0f; }
static inline float client_position(int i) { return client_point(i) / 32.0f; }
static inline float client_argument(int i) { return 0.1f + 0.6f * (float)i / (kArguments - 1); }

#endif
