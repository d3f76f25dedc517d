// Converts the results of `evalcts ulp` to and from JSON.
#include <evalcts/accuracy/report.h>

#include <algorithm>
#include <stdexcept>

#include "numbers.h"

namespace evalcts::accuracy {
namespace {

using nlohmann::json;

template <class Info>
auto texts_of(Info& info) {
  return std::array{std::pair{"library", &info.library}, std::pair{"vendor", &info.vendor},
                    std::pair{"renderer", &info.renderer}, std::pair{"version", &info.version}};
}

json orders_as_json(int uorder, int vorder, bool two_dimensional) {
  return two_dimensional ? json{uorder, vorder} : json{uorder};
}

json to_json(const ImplementationInfo& info) {
  json out = {{"kind", info.name}, {"max_eval_order", info.max_eval_order}};
  for (const auto& [name, text] : texts_of(info))
    if (!text->empty()) out[name] = *text;
  return out;
}

ImplementationInfo info_from(const json& in) {
  ImplementationInfo info;
  in.at("kind").get_to(info.name);
  in.at("max_eval_order").get_to(info.max_eval_order);
  for (const auto& [name, text] : texts_of(info)) *text = in.value(name, "");
  return info;
}

json to_json(const WorstResult& result) {
  const auto& [worst, replay] = result;
  const Input& input = worst.input;
  std::vector<double> at = {input.u};
  if (input.two_dimensional) at.push_back(input.v);
  json out = {{"error", number_as_json(worst.error)},
              {"found_by", worst.climbed ? "climbing" : "sample"},
              {"orders", orders_as_json(input.uorder, input.vorder, input.two_dimensional)},
              {"points", hex_as_json(input.points)},
              {"at", hex_as_json(at)},
              {"got", float_as_json(worst.got)},
              {"right", float_as_json(worst.right)},
              {"exact", worst.exact}};
  if (input.domain != kUnitDomain) {
    const std::size_t ends = input.two_dimensional ? 4 : 2;
    out["domain"] =
        hex_as_json({input.domain.begin(), input.domain.begin() + static_cast<std::ptrdiff_t>(ends)});
  }
  if (input.segments > 0) out["segments"] = input.segments;
  if (!replay.empty()) out["replay"] = replay;
  return out;
}

WorstResult worst_from(const json& in) {
  WorstResult result;
  Worst& worst = result.worst;
  worst.error = number_from(in.at("error"));
  worst.climbed = as_text(in.at("found_by")) == "climbing";
  const json &orders = in.at("orders"), &at = in.at("at");
  worst.input.two_dimensional = orders.size() == 2;
  worst.input.uorder = orders.at(0);
  worst.input.points = hex_list_from(in.at("points"));
  worst.input.u = static_cast<float>(hex_from(at.at(0)));
  if (worst.input.two_dimensional) {
    worst.input.vorder = orders.at(1);
    worst.input.v = static_cast<float>(hex_from(at.at(1)));
  }
  if (in.contains("domain")) {
    const std::vector<double> domain = hex_list_from(in.at("domain"));
    std::copy_n(domain.begin(), std::min(domain.size(), worst.input.domain.size()),
                worst.input.domain.begin());
  }
  worst.input.segments = in.value("segments", 0);
  worst.got = float_from(in.at("got"));
  worst.right = float_from(in.at("right"));
  in.at("exact").get_to(worst.exact);
  return result;
}

// These functions call each(name, field) for all fields of one type, for writing and for reading.
template <class R, class Each>
void for_row_counts(R& row, const Each& each) {
  each("values", row.values);
  each("not_correctly_rounded", row.not_correctly_rounded);
  each("not_finite", row.not_finite);
  each("climbed", row.climbed);
}
template <class R, class Each>
void for_means(R& row, const Each& each) {
  each("mean_ulp", row.mean_ulp);
  each("mean_condition_aware", row.mean_condition_aware);
}
template <class R, class Each>
void for_maxima(R& row, const Each& each) {
  each("max_ulp", row.max_ulp);
  each("max_condition_aware", row.max_condition_aware);
  each("sample_max_ulp", row.sample_max_ulp);
  each("sample_max_condition_aware", row.sample_max_condition_aware);
}
template <class R, class Each>
void for_apart(R& row, const Each& each) {
  each("zeros", row.zeros);
  each("without_terms", row.without_terms);
}
template <class R, class Each>
void for_worst(R& row, const Each& each) {
  each("worst_ulp", row.worst_ulp);
  each("worst_condition_aware", row.worst_condition_aware);
  each("worst_zero", row.worst_zero);
}

json to_json(const Row& row) {
  json out = {{"name", row.what.name()},
              {"orders", orders_as_json(row.what.uorder, row.what.vorder, row.what.vorder > 0)},
              {"data", row.what.data},
              {"seed", row.seed}};
  if (!row.target.empty()) out["target"] = row.target;
  if (!row.not_measured.empty()) {
    out["not_measured"] = row.not_measured;
    return out;
  }
  if (!row.capture.empty()) out["capture"] = row.capture;
  out["proven"] = false;
  for_row_counts(row, [&](const char* name, std::uint64_t count) { out[name] = count; });
  for_means(row, [&](const char* name, double mean) { out[name] = number_as_json(mean); });
  for_maxima(row, [&](const char* name, double error) {
    out[name] = row.values > 0 ? number_as_json(error) : json(0);
  });
  for_apart(row, [&](const char* name, const Apart& apart) {
    out[name] = {{"values", apart.values}, {"wrong", apart.wrong}};
  });
  for_worst(row, [&](const char* name, const std::optional<WorstResult>& worst) {
    if (worst) out[name] = to_json(*worst);
  });
  out["histogram"] = row.histogram;
  return out;
}

Row row_from(const json& in) {
  Row row;
  const json& orders = in.at("orders");
  row.what = {orders.at(0), orders.size() == 2 ? orders.at(1).get<int>() : 0, in.at("data")};
  in.at("seed").get_to(row.seed);
  row.target = in.value("target", "");
  row.not_measured = in.value("not_measured", "");
  if (!row.not_measured.empty()) return row;
  row.capture = in.value("capture", "");
  for_row_counts(row, [&](const char* name, std::uint64_t& count) { in.at(name).get_to(count); });
  const auto read = [&](const char* name, double& error) { error = number_from(in.at(name)); };
  for_means(row, read);
  for_maxima(row, read);
  for_apart(row, [&](const char* name, Apart& apart) {
    in.at(name).at("values").get_to(apart.values);
    in.at(name).at("wrong").get_to(apart.wrong);
  });
  for_worst(row, [&](const char* name, std::optional<WorstResult>& worst) {
    if (in.contains(name)) worst = worst_from(in.at(name));
  });
  in.at("histogram").get_to(row.histogram);
  return row;
}

json errors_as_json(const std::vector<double>& errors) {
  json all = json::array();
  for (const double error : errors) all.push_back(number_as_json(error));
  return all;
}

json to_json(const Profile& profile) {
  if (!profile.not_measured.empty()) return {{"name", profile.curve}, {"not_measured", profile.not_measured}};
  return {{"name", profile.curve},
          {"max_ulp", errors_as_json(profile.max_ulp)},
          {"max_condition_aware", errors_as_json(profile.max_condition_aware)}};
}

Profile profile_from(const json& in) {
  Profile profile{in.at("name"), in.value("not_measured", ""), {}, {}};
  if (!profile.not_measured.empty()) return profile;
  for (const json& error : in.at("max_ulp")) profile.max_ulp.push_back(number_from(error));
  for (const json& error : in.at("max_condition_aware"))
    profile.max_condition_aware.push_back(number_from(error));
  return profile;
}

const char* word_of(MeasuredImplementation::Status status) {
  using enum MeasuredImplementation::Status;
  switch (status) {
    case kComplete:
      return "complete";
    case kInterrupted:
      return "interrupted";
    case kCrashed:
      return "crashed";
    case kNotStarted:
      return "not-started";
  }
  throw std::logic_error("no status");
}

json to_json(const MeasuredImplementation& implementation) {
  json out = implementation.info ? to_json(*implementation.info) : json::object();
  out["name"] = implementation.name;
  out["status"] = word_of(implementation.status);
  if (!implementation.reason.empty()) out["reason"] = implementation.reason;
  out["rows"] = out["profiles"] = json::array();
  for (const Row& row : implementation.rows) out["rows"].push_back(to_json(row));
  for (const Profile& profile : implementation.profiles) out["profiles"].push_back(to_json(profile));
  return out;
}

json to_json(const ProfileCurve& curve) {
  return {{"name", curve.name},
          {"what", curve.what},
          {"points", hex_as_json(curve.points)},
          {"zeros", zeros_of(curve)}};
}

std::optional<WorstResult> known(const Worst& worst) {
  if (worst.error < 0) return std::nullopt;
  return WorstResult{worst, {}};
}

}  // namespace

Row row_of(const RowRequest& request, const Subject& subject, const Errors& errors, const Errors& sample,
           std::uint64_t climbed) {
  return {.what = request.what,
          .target = subject.has_targets() ? request.target : "",
          .seed = request.seed,
          .not_measured = {},
          .capture = subject.capture(),
          .values = errors.values,
          .not_correctly_rounded = errors.not_correctly_rounded,
          .not_finite = errors.not_finite,
          .max_ulp = errors.ulp.error,
          .mean_ulp = errors.mean_ulp(),
          .max_condition_aware = errors.condition_aware.error,
          .mean_condition_aware = errors.mean_condition_aware(),
          .climbed = climbed,
          .sample_max_ulp = sample.ulp.error,
          .sample_max_condition_aware = sample.condition_aware.error,
          .histogram = errors.histogram,
          .zeros = {errors.zeros, errors.zeros_wrong},
          .without_terms = {errors.without_terms, errors.without_terms_wrong},
          .worst_ulp = known(errors.ulp),
          .worst_condition_aware = known(errors.condition_aware),
          .worst_zero = known(errors.zero)};
}

Row not_measured(const RowRequest& request, const std::string& why) {
  Row row;
  row.what = request.what;
  row.target = request.target;
  row.seed = request.seed;
  row.not_measured = why;
  return row;
}

json to_json(const Report& report) {
  json out = {{"format", "evalcts-ulp-1"}, {"evalcts_version", EVALCTS_VERSION},
              {"command", report.command}, {"status", report.interrupted ? "interrupted" : "complete"},
              {"seed", report.seed},       {"targets", report.targets},
              {"curves", json::array()},   {"implementations", json::array()}};
  for (const ProfileCurve& curve : profile_curves()) out["curves"].push_back(to_json(curve));
  for (const MeasuredImplementation& implementation : report.implementations)
    out["implementations"].push_back(to_json(implementation));
  return out;
}

std::string to_text(const Line& line) {
  struct Writer {
    json operator()(const ImplementationInfo& info) const { return {{"implementation", to_json(info)}}; }
    json operator()(const Row& row) const { return {{"row", to_json(row)}}; }
    json operator()(const Profile& profile) const { return {{"profile", to_json(profile)}}; }
  };
  return std::visit(Writer(), line).dump();
}

std::optional<Line> parse_line(const std::string& text) {
  const json in = json::parse(text, nullptr, false);
  if (!in.is_object()) return std::nullopt;
  if (in.contains("implementation")) return info_from(in["implementation"]);
  if (in.contains("profile")) return profile_from(in["profile"]);
  return row_from(in.at("row"));
}

}  // namespace evalcts::accuracy
