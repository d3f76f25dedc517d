// Stages of the pipeline after evaluation: evaluated vertices go through them like explicit ones. A test
// names the stages and the drawings; the same drawings by explicit vertices are the control.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "drawings.h"

namespace evalcts {

// A state in which drawings are drawn. The first stage of a test is the state without any. Stages follow each
// other in one context, so each begins with the state of the one before it.
struct Stage {
  std::string name;
  gl::Case state;
};

// The areas of the framebuffer in which a stage shows, or, if there are none, feedback.
struct View {
  std::vector<Area> areas = {};
  GLenum format = GL_RGBA;
};

enum class Vertices { kExplicit, kEvaluated };

// A picture of all drawings in all stages.
class StagedPicture {
 public:
  // Throws NotObservable.
  StagedPicture(Test& t, const gl::Identity& identity, const std::vector<Stage>& stages,
                const std::vector<Drawing>& drawings, Vertices vertices, const View& view = {});

  Picture& picture() { return picture_; }
  const Picture& picture() const { return picture_; }
  std::size_t stages() const { return stages_; }
  std::size_t drawings() const { return drawings_; }
  // Returns the parts of one drawing in one stage: one for each area, or the feedback.
  std::span<const Part> parts(std::size_t stage, std::size_t drawing) const;
  // True if the drawing differs from that without a stage.
  bool has_effect(std::size_t stage, std::size_t drawing, double tolerance) const;
  // Throws NotObservable if the drawing is empty, or as without a stage.
  void require_an_effect(std::size_t stage, std::size_t drawing) const;

 private:
  std::size_t stages_, drawings_;
  Picture picture_;
};

// Returns true for the stages that must show in the drawing.
using Affects = std::function<bool(std::size_t stage, const Drawing& drawing)>;
// Throws NotObservable unless the explicit drawing, which is drawn in the stage, is as it has to be.
using Requirement = std::function<void(const Stage& stage, const Drawing& drawing, const Part& part)>;

// Expects evaluated drawings to be like explicit ones in all stages. Throws NotObservable if a stage does not
// show in an explicit drawing that it has to affect.
void expect_stages(Test& t, const std::vector<Stage>& stages, const std::vector<Drawing>& drawings,
                   const View& view = {}, const Affects& affects = {}, const Requirement& require = {});

}  // namespace evalcts
