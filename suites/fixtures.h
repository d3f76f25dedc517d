// Helpers that several suites share: deliveries, commands with which test cases begin, requirements on the
// implementation, and checks of observations.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <evalcts/testkit/test.h>

namespace evalcts {

// The attributes of a vertex, with the texture coordinates of texture unit 0 only.
inline constexpr Attributes kUnit0 = kPosition | kColor | kNormal | kTextureCoordinate0;

// A value of a test parameter, with its name in the names of tests.
template <class T>
struct NamedValue {
  const char* name;
  T value;
};

inline constexpr GLint kHighest = std::numeric_limits<GLint>::max();
inline constexpr GLint kLowest = std::numeric_limits<GLint>::min();

// Returns the count + 1 multiples of 1/count in [0,1].
std::vector<double> unit_steps(int count);

// Deliveries of unmodified cases, without and with display lists, except those that draw everything twice.
// Used by tests with a judge of their own.
std::vector<gl::Delivery> in_lists();
// Deliveries of one-dimensional cases without display lists, because some implementations draw the explicit
// vertices of the control wrongly from lists. Below thorough depth one of them runs.
std::vector<gl::Delivery> without_lists();

// Current values that differ from the initial ones in every component, so that a lost one is noticed.
struct CurrentValues {
  std::array<float, 4> color = {0.1f, 0.2f, 0.3f, 0.4f};
  std::array<float, 3> normal = {0.6f, -0.5f, 0.8f};
};
// Sets the current colour, the current normal and the current texture coordinates (5, 6, 7, 8).
void set_current_values(gl::Case& c, const CurrentValues& values = {});

// Evaluates four points of the enabled one-dimensional maps over [0,1].
void evaluate_some(gl::Case& c);

// Enables lighting with LIGHT0 at this position.
void enable_light(gl::Case& c, const std::vector<float>& position);

// Returns a case that begins with set_current_values().
gl::Case with_current_values(std::string identity, const CurrentValues& values = {});

// Throws NotSupported unless there are at least two texture units.
void require_texture_units(const Test& t);
// Returns the last texture unit that tests use.
GLenum last_unit(const Test& t);
// Throws NotSupported if the extension is not advertised. For extensions that never became part of a GL
// version.
void require_extension(const Test& t, const std::string& extension);

// Returns all observed vertices, in order.
std::vector<ObservedVertex> vertices_of(const Observation& seen);
// The same; throws NotObservable unless there are `count` of them.
std::vector<ObservedVertex> vertices_of(const Observation& seen, std::size_t count);
// True if the attributes of texture unit 0 are the same, -0 counting as +0.
bool same_vertex(const ObservedVertex& a, const ObservedVertex& b, Attributes attributes);

// Makes a failure for a test that has a judge of its own. `what`: the value that is wrong.
Failure failure_of(const gl::Case& c, std::string what, std::string message, std::string expected,
                   std::string captured);

}  // namespace evalcts
