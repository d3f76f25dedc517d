// Converts findings, events of campaigns and lists of failing cases to JSON and back.
#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/reduction.h>

#include <algorithm>

#include <evalcts/gl/case_json.h>
#include <evalcts/results/json.h>

namespace evalcts::fuzz {
namespace {

using nlohmann::json;

json to_json(const Finding& finding) {
  return {{"program", gl::to_json(finding.program)},
          {"cause", finding.cause},
          {"title", finding.title},
          {"requirement", finding.requirement},
          {"known", finding.known},
          {"outside_evaluators", finding.outside_evaluators},
          {"difference", finding.failure.difference.text()},
          {"what", finding.failure.what},
          {"message", finding.failure.message},
          {"expected", finding.failure.expected},
          {"captured", finding.failure.captured},
          {"calls", finding.failure.calls}};
}

Finding finding_from(const json& data) {
  Finding finding;
  finding.program = gl::case_from_json(data.at("program"));
  data.at("cause").get_to(finding.cause);
  data.at("title").get_to(finding.title);
  data.at("known").get_to(finding.known);
  finding.failure.difference = parse_difference(data.at("difference")).value_or(Difference());
  data.at("requirement").get_to(finding.requirement);
  data.at("outside_evaluators").get_to(finding.outside_evaluators);
  data.at("what").get_to(finding.failure.what);
  data.at("message").get_to(finding.failure.message);
  data.at("expected").get_to(finding.failure.expected);
  data.at("captured").get_to(finding.failure.captured);
  data.at("calls").get_to(finding.failure.calls);
  return finding;
}

struct EventWriter {
  json operator()(const CampaignStarted& start) const {
    return {{"event", "campaign"}, {"max_eval_order", start.max_eval_order}};
  }
  json operator()(const TestStarted& start) const { return {{"event", "start"}, {"name", start.name}}; }
  json operator()(const FindingShrank& smaller) const {
    return {{"event", "smaller"}, {"finding", to_json(smaller.finding)}};
  }
  json operator()(const FindingMade& found) const {
    return {{"event", "finding"}, {"number", found.number}, {"finding", to_json(found.finding)}};
  }
  json operator()(const CampaignProgress& progress) const {
    return {{"event", "progress"},
            {"programs", progress.programs},
            {"judged", progress.judged},
            {"in_full", progress.in_full},
            {"commands", progress.commands},
            {"not_repeated", progress.not_repeated},
            {"seconds_of_known", progress.seconds_of_known}};
  }
};

}  // namespace

std::string to_line(const CampaignEvent& event) {
  return std::visit(EventWriter(), event).dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::optional<CampaignEvent> parse_campaign_event(const std::string& line) {
  try {
    const json event = json::parse(line);
    const std::string kind = event.at("event");
    if (kind == "campaign") return CampaignStarted{event.at("max_eval_order")};
    if (kind == "start") return TestStarted{event.at("name")};
    if (kind == "smaller") return FindingShrank{finding_from(event.at("finding"))};
    if (kind == "finding") return FindingMade{event.at("number"), finding_from(event.at("finding"))};
    if (kind == "progress")
      return CampaignProgress{event.at("programs"), event.at("judged"),       event.at("in_full"),
                              event.at("commands"), event.at("not_repeated"), event.at("seconds_of_known")};
  } catch (const json::exception&) {
  } catch (const std::invalid_argument&) {
  }
  return std::nullopt;
}

std::string to_text(const Finding& finding) {
  return to_json(finding).dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string to_text(const std::vector<FailingCase>& cases) {
  json list = json::array();
  for (const FailingCase& each : cases)
    list.push_back(
        {{"test", each.test}, {"difference", each.difference.text()}, {"commands", each.commands}});
  return list.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::vector<FailingCase> parse_failing_cases(const std::string& text) {
  try {
    std::vector<FailingCase> cases;
    for (const json& data : json::parse(text))
      cases.push_back({data.at("test"), parse_difference(data.at("difference")).value_or(Difference()),
                       data.at("commands")});
    return cases;
  } catch (const json::exception& error) {
    throw std::invalid_argument(error.what());
  }
}

std::string to_line(const ReductionEvent& event) {
  json data;
  if (const auto* start = std::get_if<TestStarted>(&event)) {
    data = {{"event", "start"}, {"name", start->name}};
  } else if (std::holds_alternative<StillReducing>(event)) {
    data = {{"event", "reducing"}};
  } else {
    const auto& reduction = std::get<Reduction>(event);
    data = {{"event", "reduction"}, {"test", reduction.test}, {"why_not", reduction.why_not}};
    if (reduction.minimal) data["finding"] = to_json(*reduction.minimal);
  }
  return data.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::optional<Reduction> parse_reduction(const std::string& line) {
  try {
    const json event = json::parse(line);
    if (event.at("event") != json("reduction")) return std::nullopt;
    Reduction reduction{event.at("test"), {}, event.at("why_not")};
    if (event.contains("finding")) reduction.minimal = finding_from(event.at("finding"));
    return reduction;
  } catch (const json::exception&) {
  } catch (const std::invalid_argument&) {
  }
  return std::nullopt;
}

std::string list_as_text(const std::vector<std::string>& list) { return json(list).dump(); }

std::vector<std::string> parse_list(const std::string& text) {
  const json list = json::parse(text, nullptr, false);
  return list.is_array() ? list.get<std::vector<std::string>>() : std::vector<std::string>();
}

}  // namespace evalcts::fuzz
