// Compares captured values with predicted ones, and two observations with each other.
#include <evalcts/judge/judge.h>

#include <fmt/format.h>
#include <reference/rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <evalcts/gl/hexadecimal.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/results/text.h>

namespace evalcts {
namespace {

using reference::Component;
using reference::Rational;
using reference::Sample;

std::string text(float value) { return fmt::format("{:.9g} ({})", value, hexadecimal(value)); }

std::string text(const std::array<float, 3>& vector) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", vector[0], vector[1], vector[2]);
}

// Returns a text such as "order 4 at u = 0.5 (0x1p-1)" or "order 4x2 at u = ..., v = ...".
std::string place(const Sample& sample) {
  std::string order = std::to_string(sample.map().u.order);
  if (sample.v()) order += fmt::format("x{}", sample.map().v.order);
  std::string at = "u = " + reference::describe(sample.u().value());
  if (sample.v()) at += ", v = " + reference::describe(sample.v()->value());
  return fmt::format("order {} at {}", order, at);
}

class VertexJudge {
 public:
  VertexJudge(const JudgeOptions& options, const Observation& observation, Judgement& judgement)
      : options_(options), observation_(observation), judgement_(judgement) {}

  void vertex(std::size_t index, const reference::Vertex& expected, const ObservedVertex& got) {
    index_ = index;
    is_evaluated_ = std::ranges::any_of(expected.position, [](const Component& component) {
      return std::holds_alternative<Sample>(component);
    });
    if (!lost(expected.position)) values(kPosition, "position", "xyzw", expected.position, got.position);
    values(kColor, "color", "RGBA", expected.color, got.color);
    if (const auto* components = std::get_if<0>(&expected.normal))
      values(kNormal, "normal", "xyz", *components, got.normal);
    else if (options_.attributes & observation_.attributes & kNormal)
      automatic_normal(std::get<reference::AutomaticNormal>(expected.normal), got.normal);
    for (std::size_t unit = 0; unit < observation_.units; ++unit)
      if (!lost(expected.texture_coordinate[unit]))
        values(unit == 0 ? kTextureCoordinate0 : kTextureCoordinatesOther, "texture coordinate", "strq",
               expected.texture_coordinate[unit], got.texture_coordinate[unit], unit);
  }

 private:
  bool lost(const std::array<Component, 4>& vector) const {
    return options_.vectors_as_a_whole && std::ranges::any_of(vector, [&](const Component& component) {
             const auto* sample = std::get_if<Sample>(&component);
             return sample &&
                    !reference::must_applies(
                        component, reference::guaranteed_range(sample->map().target, options_.version));
           });
  }

  template <class Expected, class Got>
  void values(Attribute attribute, const char* name, const char* components, const Expected& expected,
              const Got& got, std::size_t unit = 0) {
    if (!(options_.attributes & observation_.attributes & attribute)) return;
    measured_ = options_.measured & attribute;
    const bool clamped = attribute == kColor && observation_.clamped_colors;
    const double capture_error = attribute == kColor ? observation_.color_error : 0;
    // Quality is not judged if the capture adds an error, which would be attributed to the library.
    if (capture_error > 0 && options_.level == Level::kQuality) return;
    if (capture_error > 0) measured_ = false;
    // If a map supplies some components only, the others have fixed values, not current ones.
    using Source = Mismatch::Source;
    const bool is_given = std::ranges::none_of(
        expected, [](const auto& component) { return std::holds_alternative<Sample>(component); });
    const Source source = !is_given                ? Source::kMap
                          : attribute == kPosition ? Source::kExplicitPosition
                          : is_evaluated_          ? Source::kCurrentOfEvaluatedVertex
                                                   : Source::kCurrentOfExplicitVertex;
    for (std::size_t i = 0; i < got.size(); ++i) {
      const auto what = [&] {
        const std::string number = attribute == kTextureCoordinate0 || attribute == kTextureCoordinatesOther
                                       ? fmt::format(" {}", unit)
                                       : std::string();
        return fmt::format("{}{}.{} of vertex {}", name, number, components[i], index_);
      };
      if (const auto* given = std::get_if<float>(&expected[i])) {
        given_value(what, clamped ? std::clamp(*given, 0.0f, 1.0f) : *given, got[i], source, capture_error);
      } else {
        evaluated_value(what, std::get<Sample>(expected[i]), got[i], clamped, capture_error);
      }
    }
  }

  template <class Describe>
  void given_value(const Describe& what, float expected, float got, Mismatch::Source source,
                   double capture_error) {
    if (expected == got || (std::isnan(expected) && std::isnan(got))) return;
    if (std::abs(static_cast<double>(expected) - static_cast<double>(got)) <= capture_error) return;
    const bool is_current = source == Mismatch::Source::kCurrentOfEvaluatedVertex ||
                            source == Mismatch::Source::kCurrentOfExplicitVertex;
    Mismatch mismatch;
    mismatch.what = what();
    mismatch.message =
        fmt::format("{} is {}; expected {}{}, because no enabled map supplies this component", mismatch.what,
                    text(got), is_current ? "the current value " : "", text(expected));
    mismatch.expected = text(expected);
    mismatch.captured = text(got);
    mismatch.exact = text(expected);
    mismatch.source = source;
    mismatch.ulp = std::isfinite(expected)
                       ? reference::ulp_distance(got, Rational(static_cast<double>(expected)))
                       : std::numeric_limits<double>::infinity();
    mismatch.condition_aware = std::numeric_limits<double>::infinity();
    mismatch.got = static_cast<double>(got);
    mismatch.lowest = static_cast<double>(expected) - capture_error;
    mismatch.highest = static_cast<double>(expected) + capture_error;
    judgement_.mismatches.push_back(std::move(mismatch));
  }

  template <class Describe>
  void evaluated_value(const Describe& what, const Sample& sample, float got, bool clamped,
                       double capture_error) {
    const Component component = sample;
    Accuracy& accuracy = judgement_.accuracy;
    if (!reference::is_finite(component)) {
      if (measured_) ++accuracy.not_judged;
      return;
    }
    if (!measured_ && !clamped && options_.level != Level::kQuality && plainly_accepted(sample, got)) return;
    const auto [exact, magnitude] = reference::exact_with_magnitude(component);
    if (clamped && (got == 0.0f || got == 1.0f)) {
      // Values outside [0,1] were clamped and cannot be distinguished from the end of the interval.
      if (got == 0.0f ? exact.sign() <= 0 : exact >= Rational(1)) return;
    }
    if (options_.level != Level::kQuality && clearly_accepted(sample, exact, magnitude, got)) {
      measure(what, sample, exact, magnitude, got);
      return;
    }
    const int range = reference::guaranteed_range(sample.map().target, options_.version);
    if (!reference::must_applies(component, range)) {
      if (measured_) ++accuracy.not_judged;
      return;
    }
    measure(what, sample, exact, magnitude, got);
    const Rational bound = (options_.level == Level::kQuality ? reference::quality_bound(component)
                                                              : reference::acceptance_bound(component)) +
                           Rational(capture_error);
    if (!reference::is_within(got, exact, bound) && !(clamped && within_clamped(got, exact, bound)))
      judgement_.mismatches.push_back(mismatch(what(), sample, exact, magnitude, bound, got, clamped));
  }

  // Judges an automatic normal. Any method is allowed (EV-AUTON-METHOD); agreement with the analytic method,
  // which GL 1.0 required, to single precision is quality. With a vertex shader, the normal is not
  // normalised. Then only its direction is judged, because its length depends on the variables of the
  // derivatives (U-AUTON-MAGN), except over [0,1].
  void automatic_normal(const reference::AutomaticNormal& normal, const std::array<float, 3>& got) {
    Accuracy& accuracy = judgement_.accuracy;
    const int range = reference::guaranteed_range(normal.map->target, options_.version);
    const auto acceptance = reference::acceptance(normal, range);
    if (!acceptance || !acceptance->must_applies || !acceptance->bound) {
      if (options_.measured & kNormal) ++accuracy.not_judged;
      return;
    }
    const reference::Map::Direction &u = normal.map->u, &v = normal.map->v;
    // The readings of the derivatives agree if both directions are reversed (U-AUTON-REVSIGN).
    const bool either_sign = (u.first > u.last) != (v.first > v.last);
    const Rational bound = options_.level == Level::kQuality
                               ? reference::normal_quality_bound(*acceptance->bound)
                               : *acceptance->bound + reference::normal_method_allowance();
    const bool with_shader = observation_.attributes & kShaderNormal;
    const bool accepted = with_shader ? reference::direction_is_within(got, acceptance->m, bound, either_sign)
                                      : reference::is_within(got, acceptance->m, bound, either_sign);
    const auto expected = reference::rounded_unit_vector(acceptance->m);
    if (!accepted) {
      normal_mismatch(
          normal,
          fmt::format("{} +- {:.3g}{}{}", text(expected), bound.to_double(),
                      either_sign ? ", or the opposite" : "", with_shader ? ", of any length" : ""),
          expected, got, bound);
    } else if (with_shader && options_.lengths_of_shader_normals) {
      length(normal, *acceptance, got);
    }
  }

  void length(const reference::AutomaticNormal& normal, const reference::NormalAcceptance& acceptance,
              const std::array<float, 3>& got) {
    if (!acceptance.vector_bound) return;
    const reference::Vector m = reference::normal_vector(normal.map->surfaces(), normal.u, normal.v);
    const Rational bound =
        *acceptance.vector_bound + reference::normal_method_allowance() * reference::length(m, 20).high;
    bool accepted = true;
    std::array<float, 3> expected{};
    for (std::size_t i = 0; i < 3; ++i) {
      accepted = accepted && reference::is_within(got[i], m[i], bound);
      expected[i] = reference::round_to_float(m[i]);
    }
    if (!accepted)
      normal_mismatch(normal, fmt::format("{} +- {:.3g}", text(expected), bound.to_double()), expected, got,
                      bound);
  }

  void normal_mismatch(const reference::AutomaticNormal& normal, const std::string& expected,
                       const std::array<float, 3>& exact, const std::array<float, 3>& got,
                       const Rational& bound) {
    // The component with the largest error represents the vector.
    std::size_t worst = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (!(std::abs(got[i] - exact[i]) <= std::abs(got[worst] - exact[worst]))) worst = i;
    Mismatch mismatch;
    mismatch.what = fmt::format("normal.{} of vertex {}", "xyz"[worst], index_);
    mismatch.source =
        is_rational(normal) ? Mismatch::Source::kRationalNormal : Mismatch::Source::kAutomaticNormal;
    mismatch.expected = expected;
    mismatch.captured = text(got);
    mismatch.exact = text(exact);
    mismatch.ulp = reference::ulp_distance(got[worst], Rational(static_cast<double>(exact[worst])));
    mismatch.condition_aware = std::numeric_limits<double>::infinity();
    mismatch.message = fmt::format("the automatic normal of vertex {} is {}, expected {}", index_,
                                   mismatch.captured, mismatch.expected);
    mismatch.got = static_cast<double>(got[worst]);
    set_interval(mismatch, Rational(static_cast<double>(exact[worst])), bound, false);
    judgement_.mismatches.push_back(std::move(mismatch));
  }

  // Sets the interval to doubles such that no float lies between them and its ends.
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

  // Returns true if a clamped colour is accepted: a value of the interval may have been clamped to 0 or 1.
  static bool within_clamped(float got, const Rational& exact, const Rational& bound) {
    return (got == 0.0f && (exact - bound).sign() <= 0) || (got == 1.0f && exact + bound >= Rational(1));
  }

  // Barycentric coordinates t and s = 1 - t of an argument in the domain of a map.
  struct Weights {
    double t = 0, s = 1;
  };

  static Weights weights_of(const reference::Argument& at, const reference::Map::Direction& domain) {
    const double length = domain.last - domain.first;
    if (!at.is_grid())
      return {(at.coordinate() - domain.first) / length, (domain.last - at.coordinate()) / length};
    // Almost every grid begins where the domain does. Then nothing cancels in t, and in s only near its end.
    if (at.first() == domain.first) {
      const double t = (at.last() - at.first()) *
                       (static_cast<double>(at.index()) / static_cast<double>(at.segments())) / length;
      const bool is_end = at.index() == at.segments() && at.last() == domain.last;
      if (is_end || (t >= 0 && t <= 1 - 0x1p-20)) return {t, 1 - t};
    }
    const Rational u = at.value(), first(domain.first), last(domain.last);
    return {((u - first) / (last - first)).to_double(), ((last - u) / (last - first)).to_double()};
  }

  // Returns the values of the Bernstein polynomials of degree order - 1. `order`: at most 8.
  static std::array<double, 8> polynomials(const Weights& weights, int order) {
    std::array<double, 8> values = {1};
    for (int n = 1; n < order; ++n)
      for (int i = n; i >= 0; --i) {
        const auto at = static_cast<std::size_t>(i);
        values[at] = (i < n ? weights.s * values[at] : 0) + (i > 0 ? weights.t * values[at - 1] : 0);
      }
    return values;
  }

  // Returns true if an evaluation in double shows that the value is within 2e-5 of the magnitude, half of the
  // least bound. The relative error of t and s is below 2^-31, and each polynomial is a sum of products of
  // them without cancellation if both are positive, so that the error is below 1e-7 of the magnitude.
  static bool plainly_accepted(const Sample& sample, float got) {
    constexpr int kHighestOrder = 8;
    constexpr double kAccepted = 2e-5, kLeast = 1e-200, kMost = 1e200;
    const reference::Map& map = sample.map();
    if (map.u.order > kHighestOrder || map.v.order > kHighestOrder || !std::isfinite(got)) return false;
    const Weights u = weights_of(sample.u(), map.u);
    const Weights v = sample.v() ? weights_of(*sample.v(), map.v) : Weights{};
    if (!(u.t >= 0 && u.s >= 0 && v.t >= 0 && v.s >= 0)) return false;
    const std::array<double, 8> of_u = polynomials(u, map.u.order), of_v = polynomials(v, map.v.order);
    double value = 0, magnitude = 0;
    for (int i = 0; i < map.u.order; ++i)
      for (int j = 0; j < map.v.order; ++j) {
        const double term =
            of_u[static_cast<std::size_t>(i)] * of_v[static_cast<std::size_t>(j)] *
            map.points[static_cast<std::size_t>((i * map.v.order + j) * map.components() + sample.component)];
        value += term;
        magnitude += std::abs(term);
      }
    return magnitude > kLeast && magnitude < kMost &&
           std::abs(static_cast<double>(got) - value) <= kAccepted * magnitude;
  }

  // Returns true if the value is within a lower estimate of the bound, computed in double with a margin for
  // rounding. Almost every value is accepted here, and none that the exact bound would reject.
  static bool clearly_accepted(const Sample& sample, const Rational& exact, const Rational& magnitude,
                               float got) {
    if (!std::isfinite(got)) return false;
    const Rational below =
        reference::acceptance_bound_below(sample.map().u.order - 1, sample.map().v.order - 1, magnitude);
    const double error = std::abs((Rational(static_cast<double>(got)) - exact).to_double());
    return error <= below.to_double() * (1 - 1e-12);
  }

  template <class Describe>
  void measure(const Describe& what, const Sample& sample, const Rational& exact, const Rational& magnitude,
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
      worst = {error, fmt::format("{}: {}, {}", options_.where, what(), place(sample)), got,
               reference::describe(exact)};
    };
    keep_worst(accuracy.ulp, reference::ulp_distance(got, exact));
    // No result is better than the correctly rounded one, even if it is far away because of underflow.
    if (!correctly_rounded)
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
    mismatch.message = fmt::format("{} (component {} of {}, {}) is {}, {} ULP from {}", mismatch.what,
                                   sample.component, gl::token_name(sample.map().target), place(sample),
                                   mismatch.captured, plain_error(mismatch.ulp), mismatch.exact);
    return mismatch;
  }

  const JudgeOptions& options_;
  const Observation& observation_;
  Judgement& judgement_;
  bool is_evaluated_ = false;  // true if a map supplies the position of the current vertex
  std::size_t index_ = 0;
  bool measured_ = true;
};

std::vector<const ObservedVertex*> flat(const Observation& observation) {
  std::vector<const ObservedVertex*> vertices;
  for (const ObservedPrimitive& primitive : observation.primitives)
    for (const ObservedVertex& vertex : primitive.vertices) vertices.push_back(&vertex);
  return vertices;
}

// Returns the captured vertex for each vertex of the case that was captured; the first one, if there are
// several.
std::map<std::size_t, const ObservedVertex*> by_vertex(const OrderedObservation& seen) {
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

// Judges vertices until there are `most` mismatches.
Judgement judge_until(std::size_t most, const Prediction& prediction, const Topology& topology,
                      const Observation& observation, const JudgeOptions& options) {
  Judgement judgement;
  const Shape shape = shape_of(observation);
  if (shape != topology.shape) {
    Mismatch mismatch;
    mismatch.what = topology.only_points() ? "number of vertices" : "primitives";
    mismatch.expected = describe(topology.shape);
    mismatch.captured = describe(shape) + (observation.overflow ? " or more" : "");
    mismatch.message = fmt::format("{} instead of {}", mismatch.captured, mismatch.expected);
    mismatch.kind = Mismatch::Kind::kVertices;
    mismatch.got = static_cast<double>(flat(observation).size());
    mismatch.lowest = mismatch.highest = static_cast<double>(topology.vertices.size());
    judgement.mismatches.push_back(std::move(mismatch));
    return judgement;  // unknown which vertex is missing or superfluous: comparing values would mislead
  }
  std::vector<const reference::Vertex*> expected;
  for (const reference::Primitive& primitive : prediction.primitives)
    for (const reference::Vertex& vertex : primitive.vertices) expected.push_back(&vertex);
  const std::vector<const ObservedVertex*> got = flat(observation);
  VertexJudge vertex_judge(options, observation, judgement);
  // A vertex of a strip is captured up to three times, but exact arithmetic is needed only once.
  std::vector<const ObservedVertex*> accepted(expected.size());
  for (std::size_t i = 0; i < got.size() && judgement.mismatches.size() < most; ++i) {
    const std::size_t vertex = topology.vertices[i];
    if (accepted[vertex] && *accepted[vertex] == *got[i]) continue;
    const std::size_t before = judgement.mismatches.size();
    vertex_judge.vertex(vertex, *expected[vertex], *got[i]);
    accepted[vertex] = judgement.mismatches.size() == before ? got[i] : nullptr;
  }
  return judgement;
}

}  // namespace

Difference Mismatch::difference() const {
  if (kind == Kind::kVertices)
    return {Difference::kVertices, "", got > highest ? "more" : got < lowest ? "fewer" : "other primitives"};
  if (!observed.empty()) return {observed, "", ""};
  const std::string attribute = kind_of(what);
  if (attribute.empty()) return {};
  switch (source) {
    case Source::kMap:
      return {attribute, Difference::kMap, relation_of(got, lowest, highest)};
    case Source::kAutomaticNormal:
    case Source::kRationalNormal:
      return {attribute, Difference::kAutomaticNormal, relation_of(got, lowest, highest)};
    case Source::kCurrentOfEvaluatedVertex:
      return {attribute, Difference::kEvaluatedVertex, ""};
    case Source::kCurrentOfExplicitVertex:
    case Source::kExplicitPosition:
      return {attribute, Difference::kExplicitVertex, ""};
  }
  return {};
}

Judgement judge(const Prediction& prediction, const Topology& topology, const Observation& observation,
                const JudgeOptions& options) {
  return judge_until(options.most, prediction, topology, observation, options);
}

Judgement judge(const Prediction& prediction, const Observation& observation, const JudgeOptions& options) {
  return judge(prediction, Topology::points(prediction.vertex_count()), observation, options);
}

Topology with_meshes_in_own_order(const Prediction& prediction, Topology topology,
                                  const Observation& observation, const JudgeOptions& options) {
  if (!prediction.has_meshes()) return topology;
  // Exact arithmetic for every vertex of a long mesh in the wrong order would take minutes.
  const auto wrong = [&](const Topology& order, std::size_t most) {
    return judge_until(most, prediction, order, observation, options).mismatches.size();
  };
  if (wrong(topology, 1) == 0) return topology;
  std::optional<Topology> own = match_meshes(prediction, topology, observation);
  if (!own) return topology;
  const std::size_t in_own = wrong(*own, std::numeric_limits<std::size_t>::max());
  return in_own < wrong(topology, in_own + 1) ? *std::move(own) : topology;
}

std::string disagreement(const OrderedObservation& a, const OrderedObservation& b) {
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
    const double color_error = a.observation.color_error + b.observation.color_error;
    const auto same_color = [&](float x, float y) {
      return same_value(clamp(x), clamp(y)) ||
             std::abs(static_cast<double>(clamp(x)) - static_cast<double>(clamp(y))) <= color_error;
    };
    const char* differs = nullptr;
    if ((both & kPosition) && !same(one->position, other->position)) differs = "position";
    if (both & kColor)
      for (std::size_t k = 0; k < 4; ++k)
        if (!same_color(one->color[k], other->color[k])) differs = "colour";
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
