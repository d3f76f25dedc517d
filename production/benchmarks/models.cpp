// The models of the benchmarks, and the check and registration of their benchmarks.
#include "models.h"

#include <random>

#include "float_horner.h"

extern "C" {
#include "examples/teapot_patches.h"
}

namespace evalcts::bench {
namespace {

constexpr int kRandomPatches = 256;

std::vector<std::vector<float>> teapot() {
  std::vector<std::vector<float>> patches;
  for (int i = 0; i < TEAPOT_PATCHES; ++i) {
    float points[4][4][3];
    teapot_patch(i, points);
    patches.emplace_back(&points[0][0][0], &points[0][0][0] + 48);
  }
  return patches;
}

// Returns patches of random numbers in [-1,1]: floats, or multiples of 2^-bits.
std::vector<std::vector<float>> random_patches(int order, int count, int bits) {
  std::mt19937 generator(3);
  std::vector<std::vector<float>> patches(static_cast<std::size_t>(count));
  for (auto& patch : patches) {
    for (int i = 0; i < order * order * 3; ++i) {
      const double unit = 2 * (static_cast<double>(generator()) / 4294967296.0) - 1;
      patch.push_back(bits == 0 ? static_cast<float>(unit)
                                : static_cast<float>(static_cast<int>(unit * (1 << bits))) /
                                      static_cast<float>(1 << bits));
    }
  }
  return patches;
}

Model make_model(const std::string& kind, int order, int segments, std::vector<std::vector<float>> patches) {
  return {"Model/" + kind + "/segments:" + std::to_string(segments), order, segments, std::move(patches)};
}

std::vector<Model> all_models() {
  std::vector<Model> result;
  for (const int segments : {4, 8, 10, 16, 32, 64})
    result.push_back(make_model("teapot", 4, segments, teapot()));
  for (const int segments : {7, 8, 64})
    result.push_back(make_model("random", 4, segments, random_patches(4, kRandomPatches, 0)));
  result.push_back(make_model("dyadic", 4, 8, random_patches(4, 32, 24)));
  result.push_back(make_model("bilinear", 2, 8, random_patches(2, 32, 0)));
  return result;
}

// Evaluates a patch on its grid, row by row, by float Horner.
void horner_patch(const Model& model, std::size_t patch, float* results) {
  const float scale = 1 / static_cast<float>(model.segments);
  for (int j = 0; j <= model.segments; ++j) {
    for (int i = 0; i <= model.segments; ++i, results += 3)
      horner_surface(model.patches[patch].data(), model.order, model.order, 3, static_cast<float>(i) * scale,
                     static_cast<float>(j) * scale, results);
  }
}

// Evaluates a block of ManyPatches. horner_surface() takes its arguments in the order v, u for these points.
void horner_block(const float* points, float* results) {
  constexpr float kScale = 1.0F / ManyPatches::kSegments;
  for (std::size_t p = 0; p < ManyPatches::kBlock; ++p, points += ManyPatches::kValues) {
    for (int j = 0; j <= ManyPatches::kSegments; ++j) {
      for (int i = 0; i <= ManyPatches::kSegments; ++i, results += 3)
        horner_surface(points, 4, 4, 3, static_cast<float>(j) * kScale, static_cast<float>(i) * kScale,
                       results);
    }
  }
}

[[maybe_unused]] const bool kRegistered = [] {
  add_many_patches("float_Horner", [] { return horner_block; });
  for (const Model& model : models()) {
    add(model, "float_Horner", [&model]() -> PatchSide {
      return [&model](std::size_t patch, float* results) { horner_patch(model, patch, results); };
    });
  }
  return true;
}();

}  // namespace

const std::vector<Model>& models() {
  static const std::vector<Model> kAll = all_models();
  return kAll;
}

const ManyPatches& many_patches() {
  static const ManyPatches kAll = [] {
    ManyPatches all;
    std::mt19937 generator(4);
    all.points.resize(ManyPatches::kCount * ManyPatches::kValues);
    for (float& value : all.points) value = static_cast<float>(generator()) / 2147483648.0F - 1;
    return all;
  }();
  return kAll;
}

void add_many_patches(const std::string& side,
                      std::function<std::function<void(const float* points, float* results)>()> prepare) {
  add("Patches/million/segments:7/" + side, [prepare = std::move(prepare)]() -> Measured {
    const std::vector<float>& points = many_patches().points;
    const auto evaluate = prepare();
    evaluate(points.data(), results());
    std::vector<float> expected(ManyPatches::kBlock * ManyPatches::kPoints * 3);
    horner_block(points.data(), expected.data());
    check_agreement({results(), expected.size()}, expected, tolerance_for(4, points));
    const auto block = [&points, evaluate, first = std::size_t{0}]() mutable {
      evaluate(points.data() + first * ManyPatches::kValues, results());
      first = (first + ManyPatches::kBlock) % ManyPatches::kCount;
    };
    return {block, static_cast<std::int64_t>(ManyPatches::kBlock * ManyPatches::kPoints)};
  });
}

void add(const Model& model, const std::string& side, std::function<PatchSide()> prepare) {
  add(model.name + "/" + side, [&model, prepare = std::move(prepare)]() -> Measured {
    const PatchSide made = prepare();
    std::vector<float> expected(model.points_of_patch() * 3);
    for (std::size_t patch = 0; patch < model.patches.size(); ++patch) {
      made(patch, results());
      horner_patch(model, patch, expected.data());
      check_agreement({results(), expected.size()}, expected,
                      tolerance_for(model.order, model.patches[patch]));
    }
    const auto all = [&model, made] {
      for (std::size_t patch = 0; patch < model.patches.size(); ++patch) made(patch, results());
    };
    return {all, static_cast<std::int64_t>(model.patches.size() * model.points_of_patch())};
  });
}

}  // namespace evalcts::bench
