// Converts findings, events of campaigns and reductions, and the data of jobs to JSON and back.
#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/reduction.h>

#include <algorithm>

#include <evalcts/gl/case_json.h>
#include <evalcts/results/json.h>

namespace evalcts {

using nlohmann::json;

static void to_json(json& out, const Difference& difference) { out = difference.text(); }
static void from_json(const json& in, Difference& difference) {
  difference = parse_difference(in).value_or(Difference());
}

namespace gl {
static void to_json(json& out, const Case& program) { out = to_json(program); }
static void from_json(const json& in, Case& program) { program = case_from_json(in); }
}  // namespace gl

namespace fuzz {

// Calls `visit` with the name and the value of each field.
template <class AnyFinding, class Visit>
static void for_each_field(AnyFinding& finding, const Visit& visit) {
  auto& failure = finding.failure;
  visit("program", finding.program);
  visit("cause", finding.cause);
  visit("title", finding.title);
  visit("requirement", finding.requirement);
  visit("known", finding.known);
  visit("outside_evaluators", finding.outside_evaluators);
  visit("difference", failure.difference);
  visit("what", failure.what);
  visit("message", failure.message);
  visit("expected", failure.expected);
  visit("captured", failure.captured);
  visit("calls", failure.calls);
}

static void to_json(json& out, const Finding& finding) {
  for_each_field(finding, [&](const char* name, const auto& field) { out[name] = field; });
}
static void from_json(const json& in, Finding& finding) {
  for_each_field(finding, [&](const char* name, auto& field) { in.at(name).get_to(field); });
}

// Functions that convert a type, whose members are the fields.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CampaignStarted, max_eval_order)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CandidateStarted, number, program)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FindingShrank, number, finding)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FindingMade, number, finding)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ProgramJudged, judged, in_full, commands, not_repeated, seconds_of_known)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RandomJob, number, length, seconds, in_fresh_context, deadly)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FailingCase, test, difference, commands, seconds)

namespace {

std::string dumped(const json& value, int indent) {
  return value.dump(indent, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string line_of(const char* kind, json event) {
  event["event"] = kind;
  return dumped(event, -1);
}

struct EventWriter {
  std::string operator()(const CampaignStarted& start) const { return line_of("campaign", start); }
  std::string operator()(const CandidateStarted& start) const { return line_of("candidate", start); }
  std::string operator()(const FindingShrank& smaller) const { return line_of("smaller", smaller); }
  std::string operator()(const FindingMade& found) const { return line_of("finding", found); }
  std::string operator()(const ProgramJudged& result) const { return line_of("judged", result); }
};

// Returns parse_json(text) as a value. Throws std::invalid_argument if it lacks a field.
template <class T>
T parsed(const std::string& text) try {
  return parse_json(text).get<T>();
} catch (const json::exception& error) {
  throw std::invalid_argument(error.what());
}

}  // namespace

std::string to_line(const CampaignEvent& event) { return std::visit(EventWriter(), event); }

std::optional<CampaignEvent> parse_campaign_event(const std::string& line) {
  try {
    const json event = parse_json(line);
    const std::string kind = event.at("event");
    if (kind == "campaign") return event.get<CampaignStarted>();
    if (kind == "candidate") return event.get<CandidateStarted>();
    if (kind == "smaller") return event.get<FindingShrank>();
    if (kind == "finding") return event.get<FindingMade>();
    if (kind == "judged") return event.get<ProgramJudged>();
  } catch (const json::exception&) {
  } catch (const std::invalid_argument&) {
  }
  return std::nullopt;
}

std::string to_text(const Finding& finding) { return dumped(finding, 1); }
std::string to_text(const RandomJob& job) { return json(job).dump(); }
std::string to_text(const FailingCase& failing) {
  return json(failing).dump(-1, ' ', false, json::error_handler_t::replace);
}
RandomJob parse_random_job(const std::string& text) { return parsed<RandomJob>(text); }
FailingCase parse_failing_case(const std::string& text) { return parsed<FailingCase>(text); }

std::string to_line(const Reduction& reduction) {
  json data = {{"test", reduction.test}, {"why_not", reduction.why_not}};
  if (reduction.minimal) data["finding"] = *reduction.minimal;
  return line_of("reduction", data);
}

std::optional<Reduction> parse_reduction(const std::string& line) {
  try {
    const json event = parse_json(line);
    if (event.at("event") != json("reduction")) return std::nullopt;
    Reduction reduction{event.at("test"), {}, event.at("why_not")};
    if (event.contains("finding")) reduction.minimal = event.at("finding").get<Finding>();
    return reduction;
  } catch (const json::exception&) {
  } catch (const std::invalid_argument&) {
  }
  return std::nullopt;
}

}  // namespace fuzz
}  // namespace evalcts
