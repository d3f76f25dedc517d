#include <evalcts/accuracy/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <reference/bernstein_form.h>

#include <evalcts/gl/tokens.h>

namespace evalcts::accuracy {
namespace {

using nlohmann::json;

constexpr std::size_t kArguments = 256, kArgumentsOfLarge = 64;
constexpr int kLarge = 200;  // control points

// Mostly any multiple of 2^-24; one in sixteen of 1/16, where exact zeros and ties are.
float random_argument(Random& random) {
  if (random.once_in(16)) return static_cast<float>(random.below(17)) / 16;
  return static_cast<float>(std::ldexp(static_cast<double>(random.below((1u << 24) + 1)), -24));
}

// No JSON number is infinite.
json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json worst_as_json(const Worst& worst) {
  if (worst.error < 0) return nullptr;
  const Input& input = worst.input;
  json points = json::array();
  for (const double point : input.points) points.push_back(hex(point));
  json at = {hex(input.u)};
  if (input.two_dimensional) at.push_back(hex(input.v));
  json orders = {input.uorder};
  if (input.two_dimensional) orders.push_back(input.vorder);
  return {{"error", number(worst.error)},
          {"found_by", worst.climbed ? "climbing" : "sample"},
          {"orders", orders},
          {"points", points},
          {"at", at},
          {"got", {{"value", hex(worst.got)}, {"bits", bits(worst.got)}}},
          {"right", {{"value", hex(worst.right)}, {"bits", bits(worst.right)}}},
          {"exact", worst.exact}};
}

json head_as_json(const RowRequest& request) {
  json orders = {request.what.uorder};
  if (request.what.vorder > 0) orders.push_back(request.what.vorder);
  return {
      {"name", request.what.name()}, {"orders", orders}, {"data", request.what.data}, {"seed", request.seed}};
}

}  // namespace

std::vector<Class> table_classes() {
  std::vector<Class> all;
  const std::vector<std::string> data = {"ordinary", "integers", "lines", "cancelling", "wide", "extreme"};
  for (const int order : {2, 3, 4, 6, 10, 20, 30})
    for (const std::string& kind : data) all.push_back({order, 0, kind});
  for (const auto& [u, v] : {std::pair{2, 2}, {4, 4}, {3, 8}, {30, 30}})
    for (const std::string& kind : data) all.push_back({u, v, kind});
  return all;
}

std::size_t arguments_of_a_map(const Class& what) {
  return what.uorder * std::max(what.vorder, 1) > kLarge ? kArgumentsOfLarge : kArguments;
}

Errors measure(Subject& subject, const RowRequest& request, const std::atomic<bool>& stop) {
  const Class& what = request.what;
  const bool two_dimensional = what.vorder > 0;
  const GLenum target = target_of(request.target, two_dimensional);
  const int vorder = std::max(what.vorder, 1);
  const std::size_t count = arguments_of_a_map(what);
  Map map{what.uorder, vorder, gl::components_of(target), true, {0, 1, 0, 1}, {}};
  const std::uint64_t maps = (request.values + count * map.components - 1) / (count * map.components);
  std::vector<float> u(count), v(two_dimensional ? count : 0), results(count * map.components);
  Errors errors;
  for (std::uint64_t item = 0; item < maps && !stop; ++item) {
    Random random(request.seed, item);
    draw_points(map, what, random);
    for (float& x : u) x = random_argument(random);
    for (float& x : v) x = random_argument(random);
    subject.evaluate(target, map, u, v, results);
    for (int k = 0; k < map.components; ++k) {
      Input input{map.uorder, map.vorder, two_dimensional, {}};
      for (std::size_t i = k; i < map.points.size(); i += map.components)
        input.points.push_back(map.points[i]);
      const reference::BernsteinForm exact(input.surface());
      for (std::size_t a = 0; a < count; ++a) {
        input.u = u[a];
        if (two_dimensional) input.v = v[a];
        errors.add(results[a * map.components + k],
                   exact.evaluate_with_magnitude(input.argument_u(), input.argument_v()), input);
      }
    }
  }
  return errors;
}

float replay(Subject& subject, const std::string& target_name, const Input& input) {
  const GLenum target = target_of(target_name, input.two_dimensional);
  Map map{input.uorder, input.vorder, gl::components_of(target), true, {0, 1, 0, 1}, {}};
  for (const double point : input.points) map.points.insert(map.points.end(), map.components, point);
  std::vector<float> results(map.components);
  const std::vector<float> v(input.two_dimensional ? 1 : 0, input.v);
  subject.evaluate(target, map, std::span(&input.u, 1), v, results);
  return results[0];
}

json row_as_json(const RowRequest& request, const Subject& subject, const Errors& errors,
                 const Errors& sample, std::uint64_t climbed) {
  json row = head_as_json(request);
  if (subject.has_targets()) row["target"] = request.target;
  if (!subject.capture().empty()) row["capture"] = subject.capture();
  row["proven"] = false;
  row["values"] = errors.values;
  row["not_correctly_rounded"] = errors.not_correctly_rounded;
  row["not_finite"] = errors.not_finite;
  row["max_ulp"] = errors.values > 0 ? number(errors.ulp.error) : json(0);
  row["mean_ulp"] = number(errors.mean_ulp());
  row["max_condition_aware"] = errors.values > 0 ? number(errors.condition_aware.error) : json(0);
  row["mean_condition_aware"] = number(errors.mean_condition_aware());
  row["climbed"] = climbed;
  row["sample_max_ulp"] = errors.values > 0 ? number(sample.ulp.error) : json(0);
  row["sample_max_condition_aware"] = errors.values > 0 ? number(sample.condition_aware.error) : json(0);
  row["histogram"] = errors.histogram;
  row["zeros"] = {{"values", errors.zeros}, {"wrong", errors.zeros_wrong}};
  row["without_terms"] = {{"values", errors.without_terms}, {"wrong", errors.without_terms_wrong}};
  for (const auto& [name, worst] : {std::pair{"worst_ulp", &errors.ulp},
                                    {"worst_condition_aware", &errors.condition_aware},
                                    {"worst_zero", &errors.zero}})
    if (worst->error >= 0) row[name] = worst_as_json(*worst);
  return row;
}

json row_as_json(const RowRequest& request, const std::string& why_not_measured) {
  json row = head_as_json(request);
  row["target"] = request.target;
  row["not_measured"] = why_not_measured;
  return row;
}

std::string hex(double value) { return fmt::format("{:a}", value); }
std::string bits(float value) { return fmt::format("0x{:08x}", std::bit_cast<std::uint32_t>(value)); }

}  // namespace evalcts::accuracy
