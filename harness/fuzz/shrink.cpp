#include "harness/fuzz/shrink.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace evalcts::fuzz {
namespace {

constexpr std::size_t kMostElements = 24;  // of an array whose elements are tried one by one

using gl::Command;
using gl::EntryPoint;

class Shrinker {
 public:
  Shrinker(gl::Case best, const std::function<bool(const gl::Case&)>& still, int most,
           const std::function<void(const gl::Case&)>& smaller)
      : best_(std::move(best)), still_(still), left_(most), smaller_(smaller) {}

  gl::Case shrink() {
    for (bool again = true; again && left_ > 0;) {
      again = remove_commands();
      again = simplify_arguments() || again;
    }
    return best_;
  }

 private:
  std::size_t size() const { return best_.commands().size(); }

  bool attempt(std::vector<Command> commands) {
    if (left_ <= 0) return false;
    --left_;
    gl::Case candidate(best_.identity());
    for (Command& command : commands) candidate.add(std::move(command));
    if (!still_(candidate)) return false;
    best_ = std::move(candidate);
    if (smaller_) smaller_(best_);
    return true;
  }

  bool attempt_without(std::size_t first, std::size_t count) {
    std::vector<Command> commands = best_.commands();
    const auto begin = commands.begin() + static_cast<std::ptrdiff_t>(first);
    commands.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    return attempt(std::move(commands));
  }

  // Ranges of half the size, a quarter, ..., one; then pairs that only go together (Begin and End, PushAttrib
  // and PopAttrib, NewList and EndList, a command and the question for its error).
  bool remove_commands() {
    bool any = false;
    for (std::size_t count = std::max<std::size_t>(size() / 2, 1); count > 0 && left_ > 0; count /= 2)
      for (std::size_t end = size(); end > 0 && left_ > 0;) {
        const std::size_t first = end > count ? end - count : 0;
        if (attempt_without(first, end - first)) any = true;
        end = first;
        end = std::min(end, size());
      }
    for (std::size_t first = 0; first < size() && left_ > 0; ++first)
      for (const std::size_t second : partners(first)) {
        std::vector<Command> commands = best_.commands();
        commands.erase(commands.begin() + static_cast<std::ptrdiff_t>(second));
        commands.erase(commands.begin() + static_cast<std::ptrdiff_t>(first));
        if (!attempt(std::move(commands))) continue;
        any = true;
        if (first > 0) --first;
        break;
      }
    return any;
  }

  std::vector<std::size_t> partners(std::size_t first) const {
    constexpr std::pair<EntryPoint, EntryPoint> kPairs[] = {
        {EntryPoint::Begin, EntryPoint::End},
        {EntryPoint::PushAttrib, EntryPoint::PopAttrib},
        {EntryPoint::NewList, EntryPoint::EndList},
        {EntryPoint::ActiveTexture, EntryPoint::ActiveTexture}};
    const std::vector<Command>& commands = best_.commands();
    std::vector<std::size_t> found;
    for (const auto& [opening, closing] : kPairs) {
      if (commands[first].entry != opening) continue;
      for (std::size_t i = first + 1; i < commands.size() && found.size() < 3; ++i)
        if (commands[i].entry == closing) found.push_back(i);
    }
    if (found.empty() && first + 1 < commands.size() && commands[first + 1].entry == EntryPoint::GetError)
      found.push_back(first + 1);
    return found;
  }

  bool simplify_arguments() {
    bool any = false;
    for (std::size_t i = 0; i < size() && left_ > 0; ++i) {
      any = lower_order(i) || any;
      for (std::size_t k = 0; i < size() && k < best_.commands()[i].arguments.size(); ++k)
        any = simplify(i, k) || any;
    }
    return any;
  }

  bool replace(std::size_t i, Command command) {
    std::vector<Command> commands = best_.commands();
    commands[i] = std::move(command);
    return attempt(std::move(commands));
  }

  // Map1 with one point less.
  bool lower_order(std::size_t i) {
    bool any = false;
    for (;;) {
      Command command = best_.commands()[i];
      if (command.entry != EntryPoint::Map1f && command.entry != EntryPoint::Map1d) return any;
      auto& order = std::get<std::int64_t>(command.arguments[4]);
      auto* points = std::get_if<gl::Input>(&command.arguments[5]);
      const auto bytes =
          static_cast<std::size_t>(std::max<std::int64_t>(std::get<std::int64_t>(command.arguments[3]), 0)) *
          (points ? size_of(points->type) : 0);
      if (order < 2 || !points || points->bytes.size() <= bytes) return any;
      --order;
      points->bytes.resize(points->bytes.size() - bytes);
      if (!replace(i, std::move(command))) return any;
      any = true;
    }
  }

  static double rounded(double value) {
    return std::abs(value) < 8 ? std::trunc(value) + 0.0 : std::copysign(1.0, value);
  }

  bool simplify(std::size_t i, std::size_t k) {
    const gl::Value& value = best_.commands()[i].arguments[k];
    const auto with = [&](gl::Value simpler) {
      Command command = best_.commands()[i];
      command.arguments[k] = std::move(simpler);
      return replace(i, std::move(command));
    };
    if (const auto* single = std::get_if<float>(&value)) {
      const float now = *single;
      for (const float simpler : {0.0f, 1.0f, static_cast<float>(rounded(now)), 0.5f}) {
        if (simpler == now) return false;
        if (with(simpler)) return true;
      }
    } else if (const auto* real = std::get_if<double>(&value)) {
      const double now = *real;
      for (const double simpler : {0.0, 1.0, rounded(now), 0.5}) {
        if (simpler == now) return false;
        if (with(simpler)) return true;
      }
    } else if (const auto* integer = std::get_if<std::int64_t>(&value)) {
      if (gl::parameter_kinds(best_.commands()[i].entry)[k] != '.') return false;
      const std::int64_t now = *integer;
      for (const std::int64_t simpler : {std::int64_t{0}, std::int64_t{1}, now - 1}) {
        if (simpler == now || now < 0) return false;
        if (with(simpler)) return true;
      }
    } else if (const auto* input = std::get_if<gl::Input>(&value)) {
      return simplify_array(i, k, *input, with);
    }
    return false;
  }

  template <class With>
  bool simplify_array(std::size_t i, std::size_t k, const gl::Input& input, const With& with) {
    if (input.type == gl::Scalar::f32) return simplify_elements<float>(i, k, input, with);
    if (input.type == gl::Scalar::f64) return simplify_elements<double>(i, k, input, with);
    return false;
  }

  // All elements at once, then one by one.
  template <class Real, class With>
  bool simplify_elements(std::size_t i, std::size_t k, const gl::Input& input, const With& with) {
    std::vector<Real> values(input.bytes.size() / sizeof(Real));
    std::memcpy(values.data(), input.bytes.data(), values.size() * sizeof(Real));
    std::vector<Real> simple = values;
    for (Real& value : simple) value = static_cast<Real>(rounded(value));
    for (const std::vector<Real>& all :
         {std::vector<Real>(values.size(), 0), std::vector<Real>(values.size(), 1), simple})
      if (all != values && with(gl::array(all))) {
        values = all;
        if (std::ranges::all_of(values, [](Real value) { return value == 0; })) return true;
        break;
      }
    bool any = false;
    if (values.size() > kMostElements) return any;
    for (std::size_t e = 0; e < values.size() && left_ > 0; ++e)
      for (const Real simpler : {Real(0), Real(1), static_cast<Real>(rounded(values[e]))}) {
        if (simpler == values[e]) break;
        std::vector<Real> changed = values;
        changed[e] = simpler;
        Command command = best_.commands()[i];
        command.arguments[k] = gl::array(changed);
        if (!replace(i, std::move(command))) continue;
        values = std::move(changed);
        any = true;
        break;
      }
    return any;
  }

  gl::Case best_;
  const std::function<bool(const gl::Case&)>& still_;
  int left_;
  const std::function<void(const gl::Case&)>& smaller_;
};

}  // namespace

gl::Case shrink(const gl::Case& program, const std::function<bool(const gl::Case&)>& still, int most,
                const std::function<void(const gl::Case&)>& smaller) {
  return Shrinker(program, still, most, smaller).shrink();
}

}  // namespace evalcts::fuzz
