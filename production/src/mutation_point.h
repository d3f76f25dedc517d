// Names points of the code for the mutations of mutations/mutations.json, which tests of the tests switch on.
// Otherwise GLEV_AT(point, expression) is the expression, and GLEV_HERE(point) is nothing.
#pragma once

#ifdef GLEV_MUTATED
#include <mutations/mutation.h>
#include <mutations/mutation_points.h>
#define GLEV_AT(point, ...) GLEV_AT_##point((__VA_ARGS__))
#define GLEV_HERE(point) GLEV_HERE_##point
#else
#define GLEV_AT(point, ...) (__VA_ARGS__)
#define GLEV_HERE(point)
#endif
