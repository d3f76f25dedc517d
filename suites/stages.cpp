// Draws in stages, and compares evaluated drawings with explicit ones.
#include "stages.h"

#include <algorithm>

namespace evalcts {
namespace {

Picture take(Test& t, const gl::Identity& identity, const std::vector<Stage>& stages,
             const std::vector<Drawing>& drawings, Vertices vertices, const View& view) {
  std::vector<Scene> scenes;
  for (const Stage& stage : stages)
    for (Scene& scene : scenes_of(drawings, vertices == Vertices::kEvaluated, stage.name, stage.state))
      scenes.push_back(std::move(scene));
  if (!view.areas.empty()) return pixels(t, identity, scenes, view.areas, view.format);
  Picture picture = feedback(t, identity, scenes);
  forget_stipple_starts(picture);
  return picture;
}

}  // namespace

StagedPicture::StagedPicture(Test& t, const gl::Identity& identity, const std::vector<Stage>& stages,
                             const std::vector<Drawing>& drawings, Vertices vertices, const View& view)
    : stages_(stages.size()),
      drawings_(drawings.size()),
      picture_(take(t, identity, stages, drawings, vertices, view)) {}

std::span<const Part> StagedPicture::parts(std::size_t stage, std::size_t drawing) const {
  const std::size_t each = picture_.parts.size() / (stages_ * drawings_);
  return std::span(picture_.parts).subspan((stage * drawings_ + drawing) * each, each);
}

bool StagedPicture::has_effect(std::size_t stage, std::size_t drawing, double tolerance) const {
  return !std::ranges::equal(parts(stage, drawing), parts(0, drawing), [&](const Part& a, const Part& b) {
    return alike(a.values, b.values, tolerance);
  });
}

void StagedPicture::require_an_effect(std::size_t stage, std::size_t drawing) const {
  if (std::ranges::all_of(parts(stage, drawing), [](const Part& part) { return part.values.empty(); }))
    throw NotObservable("pipeline: nothing comes out of explicit vertices");
  if (!has_effect(stage, drawing, kEffect))
    throw NotObservable("pipeline: the stage does not show with explicit vertices");
}

void expect_stages(Test& t, const std::vector<Stage>& stages, const std::vector<Drawing>& drawings,
                   const View& view, const Affects& affects, const Requirement& require) {
  const StagedPicture control(t, gl::control("explicit vertices"), stages, drawings, Vertices::kExplicit,
                              view);
  for (std::size_t stage = 0; stage < stages.size(); ++stage)
    for (std::size_t i = 0; i < drawings.size(); ++i) {
      if (stage > 0 && (!affects || affects(stage, drawings[i]))) control.require_an_effect(stage, i);
      for (const Part& part : control.parts(stage, i))
        if (require) require(stages[stage], drawings[i], part);
    }
  StagedPicture seen(t, "evaluated", stages, drawings, Vertices::kEvaluated, view);
  for (std::size_t stage = 0; stage < stages.size(); ++stage)
    for (std::size_t i = 0; i < drawings.size(); ++i)
      for (std::size_t k = 0; k < seen.parts(stage, i).size(); ++k) {
        const Part &part = seen.parts(stage, i)[k], &expected = control.parts(stage, i)[k];
        if (view.areas.empty())
          expect_drawn_like_explicit(seen.picture().checked, drawings[i], part, expected);
        else
          expect_like_explicit(seen.picture().checked, part, expected);
      }
}

}  // namespace evalcts
