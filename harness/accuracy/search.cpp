// The hill-climbing search for large errors.
#include <evalcts/accuracy/search.h>

#include <algorithm>
#include <cmath>

#include <reference/bernstein_form.h>
#include <reference/rounding.h>

#include <evalcts/gl/tokens.h>

namespace evalcts::accuracy {
namespace {

constexpr std::uint64_t kSteps = 1u << 24;  // arguments are multiples of 2^-24
constexpr int kPatience = 24;               // generations without a worse input before a restart
// The first item of the random numbers of climbs; items of the sample count from 0.
constexpr std::uint64_t kFirstItem = std::uint64_t{1} << 40;

// Returns an argument near u in the domain; a grid point if there are segments.
float varied_argument(float u, double first, double last, int segments, Random& random) {
  auto step = static_cast<std::uint64_t>(std::lround(std::ldexp(part_of(u, first, last), 24)));
  switch (random.below(8)) {
    case 0:
      step = random.below(kSteps + 1);
      break;
    case 1:
    case 2:
      step += random.below(2001);
      step -= std::min<std::uint64_t>(step, 1000);
      break;
    case 3:
      break;
    default:
      step ^= std::uint64_t{1} << random.below(24);
  }
  step = std::min(step, kSteps);
  if (segments > 0) step -= step % (kSteps / static_cast<std::uint64_t>(segments));
  return argument_at(std::ldexp(static_cast<double>(step), -24), first, last);
}

class Climb {
 public:
  Climb(Subject& subject, const RowRequest& request, bool by_ulp, std::uint64_t item)
      : subject_(subject),
        request_(request),
        target_(target_of(request.target, request.what.vorder > 0)),
        by_ulp_(by_ulp),
        random_(request.seed, item),
        map_(map_of(request)) {}

  // Number of results of the subject in one generation.
  std::uint64_t generation() const { return arguments_of_a_map(request_.what) * map_.components; }

  // Starts from a result of the sample, or from a random input if there is none.
  void start(const Worst& worst) {
    current_ = worst;
    if (current_.error < 0) restart();
  }

  // Runs one generation. Replaces `worst` if the generation has found a larger error.
  void step(Worst& worst) {
    Worst best;
    best.error = std::nextafter(current_.error, -INFINITY);  // equal errors pass, to cross plateaus
    neighbours(best);
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
  void restart() {
    draw_points(map_, request_.what, random_);
    current_ = {};
    current_.input = {map_.uorder, map_.vorder,  request_.what.vorder > 0, {}, 0, 0,
                      map_.domain, map_.segments};
    for (std::size_t i = 0; i < map_.points.size(); i += map_.components)
      current_.input.points.push_back(map_.points[i]);
    current_.input.u = near_u(argument_at(0.5, map_.domain[0], map_.domain[1]));
    if (current_.input.two_dimensional)
      current_.input.v = near_v(argument_at(0.5, map_.domain[2], map_.domain[3]));
    waited_ = 0;
  }

  float near_u(float u) { return varied_argument(u, map_.domain[0], map_.domain[1], map_.segments, random_); }
  float near_v(float v) { return varied_argument(v, map_.domain[2], map_.domain[3], map_.segments, random_); }

  // Keeps the worst of the generation in `best`. The first component is the current polynomial.
  void neighbours(Worst& best) {
    const std::size_t count = arguments_of_a_map(request_.what);
    const bool two_dimensional = current_.input.two_dimensional;
    std::vector<Input> components(map_.components, current_.input);
    for (int k = 0; k < map_.components; ++k) {
      // With a single component, the polynomial must change sometimes, too.
      if (k > 0 || random_.once_in(2)) vary_points(components[k].points, request_.what, random_);
      map_.points.resize(components[k].points.size() * map_.components);
      for (std::size_t i = 0; i < components[k].points.size(); ++i)
        map_.points[i * map_.components + k] = components[k].points[i];
    }
    std::vector<float> u(count), v(two_dimensional ? count : 0), results(count * map_.components);
    for (float& x : u) x = near_u(current_.input.u);
    for (float& x : v) x = near_v(current_.input.v);
    u[0] = current_.input.u;
    if (two_dimensional) v[0] = current_.input.v;
    subject_.evaluate(target_, map_, u, v, results);
    for (int k = 0; k < map_.components; ++k) {
      Input& input = components[k];
      const reference::BernsteinForm exact(input.surface());
      for (std::size_t a = 0; a < count; ++a) {
        input.u = u[a];
        if (two_dimensional) input.v = v[a];
        const float got = results[a * map_.components + k];
        const reference::Evaluation value =
            exact.evaluate_with_magnitude(input.argument_u(), input.argument_v());
        if (value.value.is_zero()) continue;  // exact zeros are counted separately
        best.keep(by_ulp_ ? reference::ulp_distance(got, value.value)
                          : reference::condition_distance(got, value.value, value.magnitude),
                  input, got, value.value);
      }
    }
  }

  Subject& subject_;
  const RowRequest& request_;
  GLenum target_;
  bool by_ulp_;
  Random random_;
  Map map_;
  Worst current_;
  int waited_ = 0;
};

}  // namespace

void climb(Subject& subject, const RowRequest& request, std::uint64_t values, Errors& errors,
           const std::atomic<bool>& stop) {
  std::uint64_t item = kFirstItem;
  for (const bool by_ulp : {true, false}) {
    Worst& worst = by_ulp ? errors.ulp : errors.condition_aware;
    Climb climb(subject, request, by_ulp, item++);
    climb.start(worst);
    const std::uint64_t generations = (values / 2 + climb.generation() - 1) / climb.generation();
    for (std::uint64_t i = 0; i < generations && !stop; ++i) climb.step(worst);
  }
}

}  // namespace evalcts::accuracy
