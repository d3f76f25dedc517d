// The fixture of tests of display lists.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "fixture.h"

namespace glev_tests {

// A command, and its name in failure messages.
using Command = std::function<void(glev_context*)>;
using Row = std::pair<const char*, Command>;

class Lists : public ContextTest {
 protected:
  void compile(glev_uint name, const std::function<void()>& commands, glev_enum mode = GLEV_COMPILE) {
    glevNewList(gl, name, mode);
    commands();
    glevEndList(gl);
  }

  float current_index() {
    float index;
    glevGetFloatv(gl, GLEV_CURRENT_INDEX, &index);
    return index;
  }

  std::vector<float> recorded_indices() {
    std::vector<float> indices;
    for (const glev_vertex& vertex : recording.vertices) indices.push_back(vertex.index);
    return indices;
  }

  int get_integer(glev_enum name) {
    int value = -77;
    glevGetIntegerv(gl, name, &value);
    return value;
  }

  void fresh() {
    glevDestroyContext(gl);
    ASSERT_EQ(glevCreateContext(nullptr, &gl), GLEV_SUCCESS);
    recording = {};
    const glev_sink sink = recording.make_sink();
    glevSetSink(gl, &sink);
  }
};

}  // namespace glev_tests
