// Tests captures on altered libraries, and the choice among the captures of an implementation.
#include <gtest/gtest.h>

#include <initializer_list>

#include "altered.h"
#include "synthetic_capture.h"

namespace evalcts {
namespace {

using Names = std::vector<std::string>;

class CapturesTest : public testing::Test {
 protected:
  Captures captures(std::initializer_list<CaptureTraits> all) {
    std::vector<std::unique_ptr<Capture>> owned;
    for (const CaptureTraits& traits : all) {
      auto capture = std::make_unique<SyntheticCapture>(traits);
      all_.push_back(capture.get());
      owned.push_back(std::move(capture));
    }
    return Captures(implementation_, info_, std::move(owned));
  }
  // Returns the number of proofs of each capture. Must not be called if a capture was found
  // to be unavailable.
  std::vector<int> proofs() const {
    std::vector<int> proofs;
    for (const SyntheticCapture* capture : all_) proofs.push_back(capture->proofs);
    return proofs;
  }

  WithoutContexts implementation_;
  ImplementationInfo info_;

 private:
  std::vector<const SyntheticCapture*> all_;
};

Names most(Captures& captures, Attributes required, std::size_t count, PrimitiveKinds kinds = kPoints,
           bool nonpositive_w = false) {
  Names names;
  for (const Capture* capture : captures.showing_most(required, kinds, nonpositive_w, count))
    names.push_back(capture->name());
  return names;
}

TEST_F(CapturesTest, TheFirstThatShowsAllExactlyIsTaken) {
  Captures some = captures({{.name = "A", .attributes = kPosition, .inexact_attributes = kColor},
                            {.name = "B", .attributes = kPosition | kColor, .takes = kPoints},
                            {.name = "C", .attributes = kAllAttributes}});
  EXPECT_EQ(some.showing_all(kPosition, kPoints).name(), "A");
  EXPECT_EQ(some.showing_all(kColor, kPoints).name(), "B");
  EXPECT_EQ(some.showing_all(kColor, kPoints | kLines).name(), "C");
  EXPECT_THROW(some.showing_all(kColor | kUnitNormal, kPoints), NotObservable);
}

TEST_F(CapturesTest, MostOfWhatIsShownExactlyIsFound) {
  Captures some = captures({{.name = "A", .attributes = kPosition, .inexact_attributes = kColor},
                            {.name = "B", .attributes = kPosition | kNormal, .takes = kPoints},
                            {.name = "C", .attributes = kColor}});
  EXPECT_EQ(some.shown_exactly(kPosition, kPoints), Attributes{kPosition});
  EXPECT_EQ(proofs(), (std::vector{1, 0, 0}));
  EXPECT_EQ(some.shown_exactly(kPosition | kColor | kNormal, kPoints), kPosition | kNormal);
  EXPECT_EQ(some.shown_exactly(kPosition | kNormal, kLines), Attributes{kPosition});
  EXPECT_THROW(some.shown_exactly(kTextureCoordinate0, kPoints), NotObservable);
}

TEST_F(CapturesTest, CapturesAreProvedOnceAndNoEarlierThanNeeded) {
  Captures some = captures({{.name = "A"}, {.name = "B", .attributes = kColor}, {.name = "C"}});
  EXPECT_EQ(proofs(), (std::vector{0, 0, 0}));
  some.showing_all(kPosition, kPoints);
  most(some, kPosition, 1);
  EXPECT_EQ(proofs(), (std::vector{1, 0, 0}));
  some.showing_all(kColor, kPoints);
  EXPECT_EQ(proofs(), (std::vector{1, 1, 0}));
  some.prove_all();
  EXPECT_EQ(proofs(), (std::vector{1, 1, 1}));
}

TEST_F(CapturesTest, ACaptureThatFailsItsProofIsNamedOnceAndLeftOut) {
  Captures some = captures({{.name = "A", .available = false}, {.name = "B"}});
  testing::internal::CaptureStdout();
  EXPECT_EQ(some.showing_all(kPosition, kPoints).name(), "B");
  EXPECT_EQ(most(some, kPosition, 2), Names{"B"});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "capture A is not available: not in this test\n");
}

TEST_F(CapturesTest, TheOneThatShowsMostIsTakenInexactAttributesIncluded) {
  Captures some = captures({{.name = "A", .attributes = kPosition},
                            {.name = "B", .attributes = kPosition, .inexact_attributes = kColor},
                            {.name = "C", .attributes = kPosition | kColor | kNormal}});
  EXPECT_EQ(most(some, kPosition, 1), Names{"A"});
  EXPECT_EQ(most(some, kPosition | kColor, 1), Names{"B"});
  EXPECT_EQ(most(some, kPosition | kColor | kNormal, 1), Names{"C"});
  EXPECT_EQ(most(some, kPosition | kTextureCoordinate0, 1), Names{"A"});
  EXPECT_THROW(most(some, kTextureCoordinate0, 1), NotObservable);
}

TEST_F(CapturesTest, OthersFollowThatShowAtLeastTheSame) {
  Captures some = captures({{.name = "A", .attributes = kColor},
                            {.name = "B", .attributes = kPosition | kColor},
                            {.name = "C", .attributes = kPosition},
                            {.name = "D", .attributes = kPosition | kColor | kNormal},
                            {.name = "E", .attributes = kPosition | kColor}});
  EXPECT_EQ(most(some, kPosition | kColor, 5), (Names{"B", "D", "E"}));
  EXPECT_EQ(most(some, kPosition | kColor, 2), (Names{"B", "D"}));
}

TEST_F(CapturesTest, OfNormalsTheOtherKindDoesNotCount) {
  Captures some = captures({{.name = "unit", .attributes = kPosition | kNormal | kUnitNormal},
                            {.name = "shader", .attributes = kPosition | kNormal | kShaderNormal}});
  EXPECT_EQ(most(some, kPosition | kNormal | kShaderNormal, 1), Names{"shader"});
  EXPECT_EQ(most(some, kPosition | kNormal | kUnitNormal, 2), Names{"unit"});
  EXPECT_EQ(most(some, kPosition | kNormal, 2), (Names{"unit", "shader"}));
}

TEST_F(CapturesTest, TheLastResortIsForWhatNoOtherCaptureShows) {
  Captures some = captures({{.name = "A", .attributes = kPosition},
                            {.name = "slow", .attributes = kPosition | kColor, .is_last_resort = true}});
  EXPECT_EQ(most(some, kPosition, 2), Names{"A"});
  EXPECT_EQ(proofs(), (std::vector{1, 0}));
  EXPECT_EQ(most(some, kColor, 2), Names{"slow"});
}

TEST_F(CapturesTest, CapturesThatLoseTheVerticesOrPrimitivesAreLeftOut) {
  Captures some = captures({{.name = "A", .loses_nonpositive_w = true}, {.name = "B", .takes = kPoints}});
  EXPECT_EQ(most(some, kPosition, 2), (Names{"A", "B"}));
  EXPECT_EQ(most(some, kPosition, 2, kPoints, true), Names{"B"});
  EXPECT_EQ(most(some, kPosition, 2, kLines), Names{"A"});
  EXPECT_THROW(most(some, kPosition, 2, kLines, true), NotObservable);
}

TEST_F(CapturesTest, NamesChooseWhichMayBeUsed) {
  const Names names = {"Pixels", "Sink"};
  EXPECT_EQ(Captures(implementation_, info_, &names).size(), 2u);
  EXPECT_EQ(Captures(implementation_, info_).size(), all_captures().size());
}

// Returns OSMesa, or else EGL, with some entry points replaced; null if neither starts.
std::unique_ptr<Altered> altered_gl(void (*alter)(gl::Table&)) {
  for (const char* implementation : {"osmesa", "egl"}) try {
      return std::make_unique<Altered>(alter, implementation);
    } catch (const CannotStart&) {
    }
  return nullptr;
}

// A feedback mode that divides s, t and r by q, as that of Mesa up to 7 does.
void divide_by_last(gl::Table& table) {
  static GLfloat* written = nullptr;
  table.FeedbackBuffer = [](GLsizei size, GLenum type, GLfloat* buffer) {
    written = buffer;
    Altered::original.FeedbackBuffer(size, type, buffer);
  };
  table.RenderMode = [](GLenum mode) {
    const GLint count = Altered::original.RenderMode(mode);
    if (mode == GL_RENDER)
      for (GLint i = 0; i + 12 < count; i += 13)  // points only
        for (GLint k = i + 9; k < i + 12; ++k)
          if (written[i + 12] != 0) written[k] /= written[i + 12];
    return count;
  };
}

TEST_F(CapturesTest, TheFeedbackBufferShowsAllThoughItDividesByTheLastCoordinate) {
  const std::unique_ptr<Altered> divides = altered_gl(divide_by_last);
  if (!divides) GTEST_SKIP() << "neither OSMesa nor EGL here";
  const std::unique_ptr<Capture> capture = make_feedback_buffer();
  capture->prove(*divides, info_);
  constexpr Attributes kAll = kPosition | kColor | kNormal | kTextureCoordinate0;
  EXPECT_EQ(capture->attributes() & kAll, kAll);

  gl::Case c;
  c.Begin(GL_POINTS);
  c.TexCoord4f(1, 2, 3, 7);
  c.Vertex4f(4, 5, 6, 3);
  c.End();
  const ObservedVertex vertex =
      capture->observe(*divides, c, {kPosition | kTextureCoordinate0, 1}).primitives.at(0).vertices.at(0);
  EXPECT_EQ(vertex.texture_coordinate[0], (std::array{1.0f, 2.0f, 3.0f, 7.0f}));
  EXPECT_EQ(vertex.position, (std::array{4.0f, 5.0f, 6.0f, 3.0f}));
  // q would need a pass of its own, so an observation of colours alone does not claim to show it.
  EXPECT_EQ(capture->observe(*divides, c, {kColor, 1}).attributes & kTextureCoordinate0, 0u);
}

gl::Case point_with_normal(float x, float y, float z) {
  gl::Case c;
  c.Begin(GL_POINTS);
  c.Normal3f(x, y, z);
  c.Vertex3f(0, 0, 0);
  c.End();
  return c;
}

TEST_F(CapturesTest, TheFeedbackBufferShowsNormalsByLightIfThereIsNoNormalMap) {
  const std::unique_ptr<Altered> without_normal_map = altered_gl([](gl::Table& table) {
    table.TexGeni = [](GLenum coordinate, GLenum name, GLint mode) {
      if (mode != GL_NORMAL_MAP) Altered::original.TexGeni(coordinate, name, mode);
    };
  });
  if (!without_normal_map) GTEST_SKIP() << "neither OSMesa nor EGL here";
  const std::unique_ptr<Capture> capture = make_feedback_buffer();
  capture->prove(*without_normal_map, info_);
  EXPECT_TRUE(capture->attributes() & kNormal);
  const auto normal_of = [&](const gl::Case& c) {
    return capture->observe(*without_normal_map, c, {kNormal, 1}).primitives.at(0).vertices.at(0).normal;
  };
  for (const std::array<float, 3>& normal : {std::array{0.1f, -0.25f, 0.0f}, std::array{-3.0f, 1e6f, 1e-5f}})
    EXPECT_EQ(normal_of(point_with_normal(normal[0], normal[1], normal[2])), normal);
  // Larger values are clamped, and a case that lights its vertices would be misread.
  EXPECT_THROW(normal_of(point_with_normal(0, 0x1p40f, 0)), NotObservable);
  gl::Case lit;
  lit.Disable(GL_LIGHT0);
  lit.append(point_with_normal(1, 0, 0));
  EXPECT_THROW(normal_of(lit), NotObservable);
}

TEST_F(CapturesTest, PixelsShowColorsWithoutShaders) {
  const std::unique_ptr<Altered> without_shaders =
      altered_gl([](gl::Table& table) { table.CreateProgram = nullptr; });
  if (!without_shaders) GTEST_SKIP() << "neither OSMesa nor EGL here";
  const std::unique_ptr<Capture> capture = make_pixels();
  capture->prove(*without_shaders, info_);
  EXPECT_EQ(capture->attributes(), 0u);
  EXPECT_EQ(capture->inexact_attributes(), kColor);

  constexpr std::size_t kPoints = 200;  // more than fit into one picture
  gl::Case c;
  c.Begin(GL_POINTS);
  for (std::size_t i = 0; i < kPoints; ++i) {
    c.Color4f(static_cast<float>(i) / 255, 1, 0, 0.5f);
    c.Vertex3f(static_cast<float>(i), -9, 5);
  }
  c.End();
  const Observation seen = capture->observe(*without_shaders, c, {kColor, kPoints});
  ASSERT_EQ(seen.vertex_count(), kPoints);
  EXPECT_TRUE(seen.color_error > 0 && seen.color_error < 0.01) << seen.color_error;
  for (std::size_t i = 0; i < kPoints; ++i)
    EXPECT_EQ(seen.primitives.at(0).vertices[i].color[0], static_cast<float>(i) / 255.0f) << i;
}

}  // namespace
}  // namespace evalcts
