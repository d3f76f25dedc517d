// Tests that the types and tokens of the public header are those of the GL. The library itself does not need
// a GL header; this test does.
#include <GL/gl.h>
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <type_traits>

#include <glevaluator.h>

namespace {

static_assert(std::is_same_v<glev_enum, GLenum>);
static_assert(std::is_same_v<glev_boolean, GLboolean>);
static_assert(std::is_same_v<glev_ubyte, GLubyte>);
static_assert(std::is_same_v<glev_bitfield, GLbitfield>);
static_assert(std::is_same_v<glev_int, GLint>);
static_assert(std::is_same_v<glev_int, GLsizei>);
static_assert(std::is_same_v<glev_uint, GLuint>);
static_assert(std::is_same_v<glev_float, GLfloat>);
static_assert(std::is_same_v<glev_double, GLdouble>);

// Returns the macros of a header whose names begin with `prefix` and whose values are numbers.
std::map<std::string, unsigned long> tokens_of(const std::string& path, const std::string& prefix) {
  std::map<std::string, unsigned long> tokens;
  std::ifstream header(path);
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string define, name, number;
    words >> define >> name >> number;
    if (define == "#define" && name.starts_with(prefix) && !number.empty() &&
        std::isdigit(static_cast<unsigned char>(number[0])))
      tokens[name.substr(prefix.size())] = std::stoul(number, nullptr, 0);
  }
  return tokens;
}

TEST(GlTypes, TokensHaveTheValuesOfTheGl) {
  auto own = tokens_of(GLEV_HEADER, "GLEV_"), gl = tokens_of(GL_HEADERS "/gl.h", "GL_");
  gl.merge(tokens_of(GL_HEADERS "/glext.h", "GL_"));
  EXPECT_EQ(own.erase("TEXTURE_UNITS"), 1u);  // not a token
  EXPECT_GE(own.size(), 86u);
  for (const auto& [name, value] : own) {
    ASSERT_EQ(gl.count(name), 1u) << "the GL has no " << name;
    EXPECT_EQ(value, gl[name]) << name;
  }
}

}  // namespace
