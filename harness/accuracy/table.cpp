// Measures the errors of random maps, searches for larger errors, and measures single inputs.
#include <evalcts/accuracy/table.h>

#include <algorithm>
#include <cmath>

#include <reference/rounding.h>

#include <evalcts/gl/tokens.h>

namespace evalcts::accuracy {
namespace {

constexpr int kPatience = 24;  // generations without a worse input before a restart
// The first item of the random numbers of searches; items of the sample count from 0.
constexpr std::uint64_t kFirstItem = std::uint64_t{1} << 40;

// Random maps of a request at random arguments, and their results.
class Sampling {
 public:
  Sampling(Subject& subject, const RowRequest& request, std::uint64_t item)
      : random(request.seed, item),
        subject_(subject),
        what_(request.what),
        target_(target_of(request.target, what_.vorder > 0)),
        map(map_of(what_, gl::components_of(target_))) {}

  Random random;

  // Returns the number of arguments per map. It is smaller for large maps, so that there are many different
  // maps.
  std::size_t arguments() const { return map.uorder * map.vorder > 200 ? 64 : 256; }
  std::uint64_t values() const { return arguments() * static_cast<std::uint64_t>(map.components); }

  // Evaluates the map at arguments that argument(index, first, last, is_v) returns. Calls each(result, exact
  // value, input) for every result.
  template <class Argument, class Each>
  void evaluate(const Argument& argument, const Each& each) {
    const auto& [u1, u2, v1, v2] = map.domain;
    std::vector<float> u(arguments()), v(what_.vorder > 0 ? arguments() : 0);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = argument(i, u1, u2, false);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = argument(i, v1, v2, true);
    const std::vector<float> results = subject_.evaluate(target_, map, u, v);
    for (int k = 0; k < map.components; ++k) {
      Input input = input_of(k);
      const reference::BernsteinForm form(input.surface());
      for (std::size_t i = 0; i < u.size(); ++i) {
        input.u = u[i];
        if (!v.empty()) input.v = v[i];
        each(results[i * map.components + k], input.evaluate(form), input);
      }
    }
  }

  // Returns component k of the map.
  Input input_of(int k) const {
    Input input{map.uorder, map.vorder, what_.vorder > 0, {}, 0, 0, map.domain, map.segments};
    for (std::size_t i = k; i < map.points.size(); i += map.components) input.points.push_back(map.points[i]);
    return input;
  }

  void draw() { draw_points(map, what_, random); }

 private:
  Subject& subject_;
  const Class& what_;
  GLenum target_;

 public:
  Map map;
};

class Climb {
 public:
  // Starts from a result of the sample, or from a random input if there is none.
  Climb(Subject& subject, const RowRequest& request, bool by_ulp, const Worst& worst)
      : what_(request.what),
        by_ulp_(by_ulp),
        sampling_(subject, request, kFirstItem + (by_ulp ? 0 : 1)),
        current_(worst) {
    if (current_.error < 0) restart();
  }

  // Number of results of the subject in one generation.
  std::uint64_t generation() const { return sampling_.values(); }

  // Runs one generation. Replaces `worst` if the generation has found a larger error.
  void step(Worst& worst) {
    Worst best;
    best.error = std::nextafter(current_.error, -INFINITY);  // equal errors pass, to cross plateaus
    keep_worst_neighbour(best);
    if (best.input.points.empty()) {
      if (++waited_ > kPatience) restart();
      return;
    }
    waited_ = best.error > current_.error ? 0 : waited_ + 1;
    current_ = best;
    if (current_.error > worst.error) {
      worst = current_;
      worst.climbed = true;
    }
    if (waited_ > kPatience || std::isinf(current_.error)) restart();
  }

 private:
  float near(float x, double first, double last) {
    return varied_argument(x, first, last, sampling_.map.segments, sampling_.random);
  }

  void restart() {
    sampling_.draw();
    current_ = {};
    current_.input = sampling_.input_of(0);
    const auto& [u1, u2, v1, v2] = current_.input.domain;
    current_.input.u = near(argument_at(0.5, u1, u2), u1, u2);
    if (current_.input.two_dimensional) current_.input.v = near(argument_at(0.5, v1, v2), v1, v2);
    waited_ = 0;
  }

  // Each component of the map is a neighbour of the current polynomial; the first one is the same in half of
  // the generations.
  void keep_worst_neighbour(Worst& best) {
    Map& map = sampling_.map;
    map.points.resize(current_.input.points.size() * map.components);
    for (int k = 0; k < map.components; ++k) {
      std::vector<double> points = current_.input.points;
      if (k > 0 || sampling_.random.once_in(2)) vary_points(points, what_, sampling_.random);
      for (std::size_t i = 0; i < points.size(); ++i) map.points[i * map.components + k] = points[i];
    }
    const Input now = current_.input;
    sampling_.evaluate(
        [&](std::size_t i, double first, double last, bool is_v) {
          const float x = is_v ? now.v : now.u, neighbour = near(x, first, last);
          return i == 0 ? x : neighbour;
        },
        [&](float got, const reference::Evaluation& exact, const Input& input) {
          if (exact.value.is_zero()) return;  // exact zeros are counted separately
          best.keep(by_ulp_ ? reference::ulp_distance(got, exact.value)
                            : reference::condition_distance(got, exact.value, exact.magnitude),
                    input, got, exact.value);
        });
  }

  const Class& what_;
  bool by_ulp_;
  Sampling sampling_;
  Worst current_;
  int waited_ = 0;
};

}  // namespace

Errors measure(Subject& subject, const RowRequest& request, const std::atomic<bool>& stop) {
  Errors errors;
  std::uint64_t done = 0;
  for (std::uint64_t item = 0; done < request.values && !stop; ++item) {
    Sampling sampling(subject, request, item);
    sampling.draw();
    sampling.evaluate(
        [&](std::size_t, double first, double last, bool) {
          return random_argument(first, last, sampling.map.segments, sampling.random);
        },
        [&](float got, const reference::Evaluation& exact, const Input& input) {
          errors.add(got, exact, input);
        });
    done += sampling.values();
  }
  return errors;
}

void climb(Subject& subject, const RowRequest& request, Errors& errors, const std::atomic<bool>& stop) {
  for (const bool by_ulp : {true, false}) {
    Worst& worst = by_ulp ? errors.ulp : errors.condition_aware;
    Climb climb(subject, request, by_ulp, worst);
    for (std::uint64_t done = 0; done < request.values / 2 && !stop; done += climb.generation())
      climb.step(worst);
  }
}

const std::vector<double>& profile_curve() {
  static const std::vector<double> kPoints = {0.37F, -0.98F, 0.87F, -0.31F};
  return kPoints;
}

std::vector<double> measure_profile(Subject& subject, const std::string& target_name) {
  constexpr int kBins = 256, kArguments = 16, kPart = (1 << 24) / kBins / kArguments;
  const GLenum target = target_of(target_name, false);
  Input input{static_cast<int>(profile_curve().size()), 1, false, profile_curve()};
  const reference::BernsteinForm form(input.surface());
  Map map{input.uorder, 1, gl::components_of(target)};
  for (const double point : input.points) map.points.insert(map.points.end(), map.components, point);
  // Random offsets avoid arguments that all lie midway between two fractions of small denominators.
  Random random(1, 0);
  std::vector<float> u(kBins);
  std::vector<double> errors(kBins);
  for (int i = 0; i < kArguments; ++i) {
    for (int bin = 0; bin < kBins; ++bin)
      u[bin] = std::ldexp(
          static_cast<float>((bin * kArguments + i) * kPart + static_cast<int>(random.below(kPart))), -24);
    const std::vector<float> results = subject.evaluate(target, map, u, {});
    for (int bin = 0; bin < kBins; ++bin) {
      input.u = u[bin];
      const reference::Rational exact = input.evaluate(form).value;
      if (!exact.is_zero())
        errors[bin] = std::max(errors[bin], reference::ulp_distance(results[bin * map.components], exact));
    }
  }
  return errors;
}

float replay(Subject& subject, const std::string& target_name, const Input& input) {
  const GLenum target = target_of(target_name, input.two_dimensional);
  Map map{input.uorder, input.vorder, gl::components_of(target), input.domain, input.segments};
  for (const double point : input.points) map.points.insert(map.points.end(), map.components, point);
  const std::vector<float> v(input.two_dimensional ? 1 : 0, input.v);
  return subject.evaluate(target, map, std::span(&input.u, 1), v)[0];
}

}  // namespace evalcts::accuracy
