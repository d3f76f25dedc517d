// What the header promises of random pasts, over many seeds, on the executable specification.
#include "suites/random_commands.h"

#include <gtest/gtest.h>

#include <set>

#include "harness/gl/call_log.h"
#include "harness/implementations/implementation.h"

namespace evalcts {
namespace {

constexpr int kSeeds = 60, kCommands = 80;

std::vector<std::string> lines_of(const gl::Case& c) {
  return gl::to_c(c, 0, static_cast<int>(c.commands().size()) - 1);
}

gl::Case past(std::uint32_t seed) {
  std::mt19937 random(seed);
  gl::Case c("past");
  add_random_commands(c, random, kCommands);
  return c;
}

TEST(RandomCommands, AreTheSameForTheSameSeedOnly) {
  EXPECT_EQ(lines_of(past(7)), lines_of(past(7)));
  EXPECT_NE(lines_of(past(7)), lines_of(past(8)));
}

TEST(RandomCommands, LeaveNothingOpen) {
  const std::unique_ptr<Implementation> reference = open_implementation({.name = "reference"});
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    gl::Case c = past(seed);
    const gl::Ref left = c.GetError();
    const gl::Ref list = c.GetIntegerv(GL_LIST_INDEX, gl::out<GLint>(1));
    const gl::Ref depth = c.GetIntegerv(GL_ATTRIB_STACK_DEPTH, gl::out<GLint>(1));
    const gl::Ref unit = c.GetIntegerv(GL_ACTIVE_TEXTURE, gl::out<GLint>(1));
    const gl::Ref error = c.GetError();  // GL_INVALID_OPERATION between Begin and End
    const gl::Trace trace = reference->create_context()->play(c);
    EXPECT_EQ(trace.error(left), GLenum{GL_NO_ERROR});
    EXPECT_EQ(trace.values<GLint>(list)[0], 0);
    EXPECT_EQ(trace.values<GLint>(depth)[0], 0);
    EXPECT_EQ(trace.values<GLint>(unit)[0], GL_TEXTURE0);
    EXPECT_EQ(trace.error(error), GLenum{GL_NO_ERROR});
  }
}

// Every kind of command that the header names comes up, and each past draws and defines something.
TEST(RandomCommands, GoEverywhere) {
  std::set<gl::EntryPoint> seen;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const gl::Case c = past(seed);
    EXPECT_GE(c.commands().size(), static_cast<std::size_t>(kCommands) / 2);
    for (const gl::Command& command : c.commands()) seen.insert(command.entry);
  }
  using enum gl::EntryPoint;
  for (const gl::EntryPoint entry :
       {Map1f,       Map1d,       Map2f,      Map2d,      MapGrid1f, MapGrid2f, Enable,   Disable,
        EvalCoord1f, EvalCoord2f, EvalPoint1, EvalPoint2, EvalMesh1, EvalMesh2, GetError, NewList,
        EndList,     CallList,    PushAttrib, PopAttrib,  Color4f,   Begin,     End})
    EXPECT_TRUE(seen.contains(entry)) << gl::name_of(entry);
}

}  // namespace
}  // namespace evalcts
