// Helpers that compile display lists and query the effects of their commands.
#pragma once

#include <reference/specification.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <memory>
#include <vector>

#include "context.h"

namespace evalcts::reference {

using Commands = std::function<void(Specification&)>;

inline void compile(Specification& gl, GLuint name, const Commands& commands, GLenum mode = GL_COMPILE) {
  gl.NewList(name, mode);
  commands(gl);
  gl.EndList();
}

inline std::vector<float> drawn_x(Specification& gl) {
  std::vector<float> x;
  for (const Primitive& primitive : gl.take_primitives()) {
    for (const Vertex& vertex : primitive.vertices) x.push_back(rounded(vertex.position[0]));
  }
  return x;
}

inline GLdouble current_index(Specification& gl) { return get(gl, GL_CURRENT_INDEX)[0]; }

// Returns heap memory of exactly the size that a command may read, so that sanitizers detect other accesses.
template <typename T>
std::unique_ptr<T[]> heap(std::initializer_list<T> values) {
  auto memory = std::make_unique<T[]>(values.size());
  std::ranges::copy(values, memory.get());
  return memory;
}

}  // namespace evalcts::reference
