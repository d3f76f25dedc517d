// Calls of entry points as data, which the expressions and steps of rules.h read and change.
#pragma once

#include <array>
#include <vector>

#include <evalcts/gl/tokens.h>
#include "fault.h"

namespace evalcts::faults {

using enum gl::EntryPoint;

inline constexpr GLint kMaxOrder = 64;  // of production

inline bool is_map1_target(GLenum token) { return token >= GL_MAP1_COLOR_4 && token <= GL_MAP1_VERTEX_4; }
inline bool is_map2_target(GLenum token) { return token >= GL_MAP2_COLOR_4 && token <= GL_MAP2_VERTEX_4; }

// The control points of a map without padding, v fastest. A curve has one column.
struct Net {
  int components = 0, rows = 1, columns = 1;
  std::vector<double> values;

  double* point(int i, int j = 0) {
    return &values[static_cast<std::size_t>((i * columns + j) * components)];
  }
  Net transposed() const;
};

// A map of either dimension; v1 and v2 are not used for curves.
struct Map {
  GLenum target = 0;
  double u1 = 0, u2 = 1, v1 = 0, v2 = 1;
  Net net;

  void define() const;  // by the original Map1d or Map2d
};
// Queries the present definition of a map. Not between Begin and End.
Map current_map(GLenum target);

// One call of an entry point with a rule, with its arguments as numbers.
struct Call {
  gl::EntryPoint entry{};
  std::array<double, 12> numbers{};
  std::array<void*, 12> pointers{};
  void* pointer = nullptr;  // the last of them
  std::size_t last_pointer = 0;
  char element = ' ';  // the type behind `pointer`: f, d, i (int) or b (boolean)
  double result = 0;
  std::size_t next = 0;         // the rules before this index have been applied
  std::vector<double> storage;  // keeps the points of set_net() alive

  // Calls the original command, or the next rule for it, with the present arguments.
  void go();
  // Calls the original command.
  void go_original();
  // The argument with that letter (see the constants below).
  double& argument(char letter);
  GLint integer(char letter) { return static_cast<GLint>(argument(letter)); }
  GLenum target() { return static_cast<GLenum>(argument('t')); }
  // Elements behind the pointer.
  double read(std::size_t i) const;
  void write(std::size_t i, double value);
  // Map1 and Map2: true if the arguments are legal and the points may be read; the points; other points, with
  // the strides that they need.
  bool is_legal();
  Net net();
  void set_net(const Net& net);
};

// Puts the wrapper of an entry point, which makes a Call, into the table.
void install(gl::EntryPoint entry, gl::Table& table);
// Takes the entry point out of the table.
void remove(gl::EntryPoint entry, gl::Table& table);

}  // namespace evalcts::faults
