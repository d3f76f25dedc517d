// Tests excerpts of programs that draw very much.
#include <gtest/gtest.h>

#include <algorithm>

#include "fuzz/excerpt.h"

namespace evalcts::fuzz {
namespace {

using gl::EntryPoint;

// Returns a program with points at 0, 1, and so on, each in its own primitive of three commands.
gl::Case many_points(int count) {
  gl::Case c;
  c.Enable(GL_MAP1_VERTEX_3);
  for (int i = 0; i < count; ++i) {
    c.Begin(GL_POINTS);
    c.EvalCoord1f(static_cast<float>(i));
    c.End();
  }
  return c;
}

bool evaluates_at(const gl::Case& program, float u) {
  return std::ranges::any_of(program.commands(), [&](const gl::Command& command) {
    const float* argument = command.arguments.empty() ? nullptr : std::get_if<float>(&command.arguments[0]);
    return command.entry == EntryPoint::EvalCoord1f && argument && *argument == u;
  });
}

TEST(Excerpt, CountsVertices) {
  gl::Case c = many_points(3);
  c.EvalMesh1(GL_LINE, -1, 2);
  c.EvalMesh2(GL_FILL, 0, 9, 1, 2);
  c.EvalMesh1(GL_LINE, 3, 2);
  EXPECT_EQ(vertices_of(c), 3 + 4 + 20);
}

TEST(Excerpt, IsOneWindowOfTheDrawingsWithAllState) {
  const gl::Case program = many_points(5000);
  for (const float failing : {0.0f, 4999.0f}) {
    int asked = 0;
    const gl::Case part = excerpt_of(program, [&](const gl::Case& candidate) {
      ++asked;
      EXPECT_LE(vertices_of(candidate), kMostVertices);
      EXPECT_EQ(candidate.commands().front().entry, EntryPoint::Enable);
      return evaluates_at(candidate, failing);
    });
    EXPECT_TRUE(evaluates_at(part, failing));
    EXPECT_EQ(part.commands().size(), 1 + 3 * static_cast<std::size_t>(vertices_of(part)));
    EXPECT_LE(asked, 12);
  }
}

TEST(Excerpt, IsTheProgramIfNoPartFails) {
  const gl::Case program = many_points(5000);
  int asked = 0;
  const gl::Case part = excerpt_of(program, [&](const gl::Case&) { return ++asked < 0; });
  EXPECT_EQ(part.commands().size(), program.commands().size());
  EXPECT_EQ(asked, 12);
}

TEST(Excerpt, HalvesMeshesAndTheirGridsWhileTheyFail) {
  gl::Case program;
  program.MapGrid1f(10000, 0, 1);
  program.EvalMesh1(GL_POINT, 0, 10000);
  const gl::Case part = excerpt_of(program, [](const gl::Case& candidate) {
    const std::int64_t steps = std::get<std::int64_t>(candidate.commands()[0].arguments[0]);
    return steps >= 1000 && std::get<std::int64_t>(candidate.commands()[1].arguments[2]) == steps;
  });
  EXPECT_EQ(std::get<std::int64_t>(part.commands()[0].arguments[0]), 1250);
  EXPECT_EQ(std::get<std::int64_t>(part.commands()[1].arguments[2]), 1250);
  EXPECT_LE(vertices_of(part), kMostVertices / 4) << "only the end of the mesh is needed";
}

}  // namespace
}  // namespace evalcts::fuzz
