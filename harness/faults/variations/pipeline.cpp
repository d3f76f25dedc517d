// Variations of the rest of the pipeline: pixels, buffers, and names of lists.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "variation.h"

namespace evalcts::variations {
namespace {

// --- Pixels ------------------------------------------------------------------------------------------------

constexpr float kLargestOf5Bits = 31;

EVALCTS_VARIATION(PixelsOf5Bits, "dropin", "pixels are read with 5 bits for each component", "") {
  v.gl.ReadPixels = [](GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
                       GLvoid* pixels) {
    unvaried.ReadPixels(x, y, width, height, format, type, pixels);
    if (format != GL_RGBA || width < 0 || height < 0) return;
    const std::size_t count =
        std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const auto quantized = [](float value) { return std::round(value * kLargestOf5Bits) / kLargestOf5Bits; };
    if (type == GL_FLOAT)
      std::transform(static_cast<GLfloat*>(pixels), static_cast<GLfloat*>(pixels) + count,
                     static_cast<GLfloat*>(pixels), quantized);
    if (type == GL_UNSIGNED_BYTE)
      std::transform(
          static_cast<GLubyte*>(pixels), static_cast<GLubyte*>(pixels) + count, static_cast<GLubyte*>(pixels),
          [&](GLubyte byte) { return static_cast<GLubyte>(std::round(255.0f * quantized(byte / 255.0f))); });
  };
}

// --- Contents that are undefined ---------------------------------------------------------------------------

EVALCTS_VARIATION(GarbageInBuffers, "dropin",
                  "buffers hold garbage until something is written: those of feedback and selection, and "
                  "buffer objects without data",
                  "") {
  v.gl.FeedbackBuffer = [](GLsizei size, GLenum type, GLfloat* buffer) {
    unvaried.FeedbackBuffer(size, type, buffer);
    if (buffer && size > 0) std::fill_n(buffer, size, std::numeric_limits<GLfloat>::quiet_NaN());
  };
  v.gl.SelectBuffer = [](GLsizei size, GLuint* buffer) {
    unvaried.SelectBuffer(size, buffer);
    if (buffer && size > 0) std::fill_n(buffer, size, 0xdeadbeefu);
  };
  v.gl.BufferData = [](GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
    const std::vector<GLubyte> garbage(!data && size > 0 ? static_cast<std::size_t>(size) : 0, 0xa5);
    unvaried.BufferData(target, size, data ? data : garbage.data(), usage);
  };
}

// --- Display lists -----------------------------------------------------------------------------------------

GLuint next_list = 0;

EVALCTS_VARIATION(LargeListNames, "dropin", "GenLists answers names from 2^30 on", "") {
  next_list = 1u << 30;
  v.gl.GenLists = [](GLsizei range) {
    if (range <= 0 || remembered.inside || remembered.compiling) return unvaried.GenLists(range);
    const GLuint first = next_list;
    for (; next_list < first + static_cast<GLuint>(range); ++next_list) {
      unvaried.NewList(next_list, GL_COMPILE);
      unvaried.EndList();
    }
    return first;
  };
}

}  // namespace
}  // namespace evalcts::variations
