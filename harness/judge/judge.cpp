#include "harness/judge/judge.h"

#include <fmt/format.h>
#include <reference/rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "harness/gl/tokens.h"

namespace evalcts {
namespace {

using reference::Component;
using reference::Rational;
using reference::Sample;

std::string text(float value) { return fmt::format("{:.9g} ({:a})", value, value); }

class VertexJudge {
 public:
  VertexJudge(const JudgeOptions& options, const Observation& observation, Judgement& judgement)
      : options_(options), observation_(observation), judgement_(judgement) {}

  void vertex(std::size_t index, const reference::Vertex& expected, const ObservedVertex& got) {
    index_ = index;
    values(kPosition, "position", "xyzw", expected.position, got.position);
    values(kColor, "color", "RGBA", expected.color, got.color);
    values(kNormal, "normal", "xyz", expected.normal, got.normal);
    for (std::size_t unit = 0; unit < observation_.units; ++unit)
      values(unit == 0 ? kTextureCoordinate0 : kTextureCoordinatesOther, "texture coordinate", "strq",
             expected.texture_coordinate[unit], got.texture_coordinate[unit], unit);
  }

 private:
  template <class Expected, class Got>
  void values(Attribute attribute, const char* name, const char* components, const Expected& expected,
              const Got& got, std::size_t unit = 0) {
    if (!(options_.attributes & observation_.attributes & attribute)) return;
    measured_ = options_.measured & attribute;
    const bool clamped = attribute == kColor && observation_.clamped_colors;
    for (std::size_t i = 0; i < got.size(); ++i) {
      const auto what = [&] {
        const std::string number = attribute == kTextureCoordinate0 || attribute == kTextureCoordinatesOther
                                       ? fmt::format(" {}", unit)
                                       : std::string();
        return fmt::format("{}{}.{} of vertex {}", name, number, components[i], index_);
      };
      if (const auto* given = std::get_if<float>(&expected[i])) {
        given_value(what, clamped ? std::clamp(*given, 0.0f, 1.0f) : *given, got[i]);
      } else {
        evaluated_value(what, std::get<Sample>(expected[i]), got[i], clamped);
      }
    }
  }

  template <class What>
  void given_value(const What& what, float expected, float got) {
    if (expected == got || (std::isnan(expected) && std::isnan(got))) return;
    Mismatch mismatch;
    mismatch.what = what();
    mismatch.message = fmt::format("{} is {}, but no map supplies it: {} was given", mismatch.what, text(got),
                                   text(expected));
    mismatch.expected = text(expected);
    mismatch.captured = text(got);
    mismatch.exact = text(expected);
    mismatch.ulp = std::isfinite(expected)
                       ? reference::ulp_distance(got, Rational(static_cast<double>(expected)))
                       : std::numeric_limits<double>::infinity();
    mismatch.condition_aware = std::numeric_limits<double>::infinity();
    mismatch.got = static_cast<double>(got);
    mismatch.lowest = mismatch.highest = static_cast<double>(expected);
    judgement_.mismatches.push_back(std::move(mismatch));
  }

  template <class What>
  void evaluated_value(const What& what, const Sample& sample, float got, bool clamped) {
    const Component component = sample;
    Accuracy& accuracy = judgement_.accuracy;
    if (!reference::is_finite(component)) {
      if (measured_) ++accuracy.not_judged;
      return;
    }
    const auto [exact, magnitude] = reference::exact_with_magnitude(component);
    if (clamped && (got == 0.0f || got == 1.0f)) {
      // What lies outside [0,1] cannot be told from the end of the interval.
      if (got == 0.0f ? exact.sign() <= 0 : exact >= Rational(1)) return;
    }
    if (options_.level != Level::quality && clearly_accepted(sample, exact, magnitude, got)) {
      measure(what, sample, exact, magnitude, got);
      return;
    }
    const int range = reference::guaranteed_range(sample.map->target, options_.version);
    if (!reference::must_applies(component, range)) {
      if (measured_) ++accuracy.not_judged;
      return;
    }
    measure(what, sample, exact, magnitude, got);
    const Rational bound = options_.level == Level::quality ? reference::quality_bound(component)
                                                            : reference::acceptance_bound(component);
    if (!reference::is_within(got, exact, bound) && !(clamped && within_clamped(got, exact, bound)))
      judgement_.mismatches.push_back(mismatch(what(), sample, exact, magnitude, bound, got, clamped));
  }

  // The outermost doubles of the interval: no float lies between them and its ends.
  static void set_interval(Mismatch& mismatch, const Rational& exact, const Rational& bound, bool clamped) {
    const double infinity = std::numeric_limits<double>::infinity();
    const Rational low = exact - bound, high = exact + bound;
    mismatch.lowest = low.to_double();
    mismatch.highest = high.to_double();
    while (std::isfinite(mismatch.lowest) && Rational(mismatch.lowest) < low)
      mismatch.lowest = std::nextafter(mismatch.lowest, infinity);
    while (std::isfinite(mismatch.highest) && high < Rational(mismatch.highest))
      mismatch.highest = std::nextafter(mismatch.highest, -infinity);
    if (clamped && mismatch.lowest <= 0) mismatch.highest = std::max(mismatch.highest, 0.0);
    if (clamped && mismatch.highest >= 1) mismatch.lowest = std::min(mismatch.lowest, 1.0);
  }

  // The interval clamped like the colour: a value inside it may come back as the end that it was clamped to.
  static bool within_clamped(float got, const Rational& exact, const Rational& bound) {
    return (got == 0.0f && (exact - bound).sign() <= 0) || (got == 1.0f && exact + bound >= Rational(1));
  }

  // A lower estimate of the bound in double, with room for its own rounding: almost every value is accepted
  // here, and none that the exact bound would refuse.
  static bool clearly_accepted(const Sample& sample, const Rational& exact, const Rational& magnitude,
                               float got) {
    if (!std::isfinite(got)) return false;
    const Rational below =
        reference::acceptance_bound_below(sample.map->u.order - 1, sample.map->v.order - 1, magnitude);
    const double error = std::abs((Rational(static_cast<double>(got)) - exact).to_double());
    return error <= below.to_double() * (1 - 1e-12);
  }

  template <class What>
  void measure(const What& what, const Sample& sample, const Rational& exact, const Rational& magnitude,
               float got) {
    if (!measured_) return;
    Accuracy& accuracy = judgement_.accuracy;
    ++accuracy.values;
    const bool correctly_rounded = reference::round_to_float(exact) == got;
    if (!correctly_rounded) ++accuracy.not_correctly_rounded;
    if (magnitude.is_zero()) {
      ++accuracy.all_terms_zero;
      if (got != 0.0f) ++accuracy.all_terms_zero_wrong;
      return;
    }
    const auto keep_worst = [&](Worst& worst, double error) {
      if (!(error > worst.error)) return;
      worst = {error,
               fmt::format("{}: {}, order {} at u = {}", options_.where, what(), sample.map->u.order,
                           reference::describe(sample.u.value())),
               got, reference::describe(exact)};
    };
    keep_worst(accuracy.ulp, reference::ulp_distance(got, exact));
    keep_worst(accuracy.condition_aware, reference::condition_distance(got, exact, magnitude));
  }

  Mismatch mismatch(std::string what, const Sample& sample, const Rational& exact, const Rational& magnitude,
                    const Rational& bound, float got, bool clamped) const {
    Mismatch mismatch;
    mismatch.got = static_cast<double>(got);
    set_interval(mismatch, exact, bound, clamped);
    mismatch.what = std::move(what);
    mismatch.captured = text(got);
    mismatch.exact = reference::describe(exact);
    mismatch.expected =
        fmt::format("[{:.9g}, {:.9g}]", (exact - bound).to_double(), (exact + bound).to_double());
    mismatch.ulp = reference::ulp_distance(got, exact);
    mismatch.condition_aware = reference::condition_distance(got, exact, magnitude);
    mismatch.message =
        fmt::format("{} ({} of order {}, component {}, at u = {}) is {}, {:.4g} ULP from {}", mismatch.what,
                    gl::token_name(sample.map->target), sample.map->u.order, sample.component,
                    reference::describe(sample.u.value()), mismatch.captured, mismatch.ulp, mismatch.exact);
    return mismatch;
  }

  const JudgeOptions& options_;
  const Observation& observation_;
  Judgement& judgement_;
  std::size_t index_ = 0;
  bool measured_ = true;
};

std::vector<const ObservedVertex*> flat(const Observation& observation) {
  std::vector<const ObservedVertex*> vertices;
  for (const ObservedPrimitive& primitive : observation.primitives)
    for (const ObservedVertex& vertex : primitive.vertices) vertices.push_back(&vertex);
  return vertices;
}

// What came out for each vertex of the case, where it came out at all; of several times the first.
std::map<std::size_t, const ObservedVertex*> by_vertex(const Seen& seen) {
  std::map<std::size_t, const ObservedVertex*> vertices;
  const auto all = flat(seen.observation);
  for (std::size_t i = 0; i < std::min(all.size(), seen.topology.vertices.size()); ++i)
    vertices.emplace(seen.topology.vertices[i], all[i]);
  return vertices;
}

bool same_value(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return true;
  constexpr float kTiny = std::numeric_limits<float>::min();
  return std::abs(a) <= kTiny && std::abs(b) <= kTiny;
}

}  // namespace

Judgement judge(const Prediction& prediction, const Topology& topology, const Observation& observation,
                const JudgeOptions& options) {
  Judgement judgement;
  const Shape shape = shape_of(observation);
  if (shape != topology.shape) {
    Mismatch mismatch;
    mismatch.what = topology.only_points() ? "number of vertices" : "primitives";
    mismatch.expected = describe(topology.shape);
    mismatch.captured = describe(shape) + (observation.overflow ? " or more" : "");
    mismatch.message = fmt::format("{} came out, {} should have", mismatch.captured, mismatch.expected);
    mismatch.of = Mismatch::Of::vertices;
    mismatch.got = static_cast<double>(flat(observation).size());
    mismatch.lowest = mismatch.highest = static_cast<double>(topology.vertices.size());
    judgement.mismatches.push_back(std::move(mismatch));
    return judgement;  // which vertex is missing or too many is not known: comparing the rest would mislead
  }
  std::vector<const reference::Vertex*> expected;
  for (const reference::Primitive& primitive : prediction.primitives)
    for (const reference::Vertex& vertex : primitive.vertices) expected.push_back(&vertex);
  const std::vector<const ObservedVertex*> got = flat(observation);
  VertexJudge vertex_judge(options, observation, judgement);
  for (std::size_t i = 0; i < got.size(); ++i) {
    const std::size_t vertex = topology.vertices[i];
    vertex_judge.vertex(vertex, *expected[vertex], *got[i]);
  }
  return judgement;
}

Judgement judge(const Prediction& prediction, const Observation& observation, const JudgeOptions& options) {
  return judge(prediction, Topology::points(prediction.vertex_count()), observation, options);
}

std::string disagreement(const Seen& a, const Seen& b) {
  const auto first = by_vertex(a);
  const auto second = by_vertex(b);
  if (first.size() != second.size())
    return fmt::format("one capture saw {} vertices, the other {}", first.size(), second.size());
  const Attributes both = a.observation.attributes & b.observation.attributes;
  const auto clamp = [&](float color) {
    return a.observation.clamped_colors || b.observation.clamped_colors ? std::clamp(color, 0.0f, 1.0f)
                                                                        : color;
  };
  const auto same = [](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), same_value);
  };
  for (const auto& [index, one] : first) {
    const auto found = second.find(index);
    if (found == second.end()) return fmt::format("only one capture saw vertex {}", index);
    const ObservedVertex* const other = found->second;
    const char* differs = nullptr;
    if ((both & kPosition) && !same(one->position, other->position)) differs = "position";
    if (both & kColor)
      for (std::size_t k = 0; k < 4; ++k)
        if (!same_value(clamp(one->color[k]), clamp(other->color[k]))) differs = "colour";
    if ((both & kNormal) && !same(one->normal, other->normal)) differs = "normal";
    for (std::size_t unit = 0; unit < std::min(a.observation.units, b.observation.units); ++unit)
      if ((both & (unit == 0 ? kTextureCoordinate0 : kTextureCoordinatesOther)) &&
          !same(one->texture_coordinate[unit], other->texture_coordinate[unit]))
        differs = "texture coordinates";
    if (differs) return fmt::format("the {} of vertex {} differs", differs, index);
  }
  return {};
}

}  // namespace evalcts
