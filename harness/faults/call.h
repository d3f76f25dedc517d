// Represents calls of entry points as data, which the expressions and steps of rules.h read and change.
#pragma once

#include <array>
#include <vector>

#include <evalcts/gl/table.h>
#include <evalcts/gl/tokens.h>

namespace evalcts::faults {

using enum gl::EntryPoint;

// The entry points of the implementation without any layer.
inline thread_local gl::Table innermost;
// The entry points behind the layer whose rules run.
inline thread_local gl::Table unmodified;

inline constexpr GLint kMaxOrder = 64;  // MAX_EVAL_ORDER of production

inline GLenum token(double value) { return static_cast<GLenum>(value); }
inline bool is_map1_target(GLenum token) { return token >= GL_MAP1_COLOR_4 && token <= GL_MAP1_VERTEX_4; }
inline bool is_map2_target(GLenum token) { return token >= GL_MAP2_COLOR_4 && token <= GL_MAP2_VERTEX_4; }

// The control points of a map, without padding. v varies fastest. A curve has one column.
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

  void define() const;  // defines the map by the unmodified Map1d or Map2d
};
// Queries the current definition of a map. Must not be called between Begin and End.
Map current_map(GLenum target);

// One call of an entry point with a rule, with its arguments as numbers.
struct Call {
  gl::EntryPoint entry{};
  std::array<double, 12> numbers{};
  std::array<void*, 12> pointers{};
  void* pointer = nullptr;  // the last pointer argument
  std::size_t last_pointer = 0;
  char element = ' ';  // type of the elements at `pointer`: f (float), d (double), i (int) or b (boolean)
  double result = 0;
  const void* result_pointer = nullptr;
  std::size_t next = 0;         // the rules of the layer before this index have been applied
  std::vector<double> storage;  // keeps the points of set_net() alive

  // Makes the call of a wrapper: takes it through the layers behind the one whose rules run, to the command.
  void enter();
  // Applies the next rule of the layer for the command, or if there is none, calls the unmodified command
  // with the current arguments.
  void go();
  // Calls the unmodified command with the current arguments.
  void go_original();
  // Returns the argument with this letter (see the constants of rules.h). Throws std::logic_error if
  // there is none.
  double& argument(char letter);
  GLint integer(char letter) { return static_cast<GLint>(argument(letter)); }
  GLenum target() { return static_cast<GLenum>(argument('t')); }
  // Read and write element i at `pointer`.
  double read(std::size_t i) const;
  void write(std::size_t i, double value);
  bool is_curve() const { return entry == Map1f || entry == Map1d; }
  // Returns true if the arguments of Map1 or Map2 are legal, so that the control points may be read.
  bool is_legal();
  // Returns the index, at `pointer`, of value k of a control point of Map1 or Map2.
  std::size_t place(int i, int j, int k);
  // Returns the control points of a legal call of Map1 or Map2.
  Net net();
  // Replaces the control points of Map1 or Map2, and adapts the strides and the order of u.
  void set_net(const Net& net);
  // Replaces the values of the control points, and keeps the strides.
  void set_values(Net net);
};

// Sets an entry point of the table to its wrapper, which makes a Call.
void install(gl::EntryPoint entry, gl::Table& table);
// Sets an entry point of the table to null.
void remove(gl::EntryPoint entry, gl::Table& table);
// Calls the command of `innermost`.
void call_innermost(Call& call);

}  // namespace evalcts::faults
