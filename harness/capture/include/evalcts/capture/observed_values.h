// The values of one attribute of the points that a program draws, as a capture shows them exactly.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <evalcts/capture/capture.h>

namespace evalcts {

struct ValuesRequest {
  gl::Case program;              // draws points
  Attributes attribute = 0;      // kPosition, kColor, kNormal, or texture coordinates of unit 0
  std::uint64_t components = 0;  // the first ones of the attribute, of each vertex
  std::uint64_t vertices = 0;    // that are due
};
// Convert to JSON text and back. parse_values_request() throws std::invalid_argument.
std::string to_text(const ValuesRequest& request);
ValuesRequest parse_values_request(const std::string& text);

struct ObservedValues {
  std::string capture;
  std::vector<float> values;  // of the first vertex, then of the next
};
// Throws NotObservable if the program raises an error, draws another number of vertices, or if no capture
// shows the attribute exactly.
ObservedValues observe_values(Captures& captures, Implementation& implementation,
                              const ValuesRequest& request);

}  // namespace evalcts
