// Converts findings, events of campaigns and reductions, and the data of jobs to JSON and back.
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
  json operator()(const FindingShrank& smaller) const {
    return {{"event", "smaller"}, {"number", smaller.number}, {"finding", to_json(smaller.finding)}};
  }
  json operator()(const FindingMade& found) const {
    return {{"event", "finding"}, {"number", found.number}, {"finding", to_json(found.finding)}};
  }
  json operator()(const StillJudging&) const { return {{"event", "judging"}}; }
  json operator()(const ProgramJudged& result) const {
    return {{"event", "judged"},
            {"judged", result.judged},
            {"in_full", result.in_full},
            {"commands", result.commands},
            {"not_repeated", result.not_repeated},
            {"seconds_of_known", result.seconds_of_known}};
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
    if (kind == "smaller") return FindingShrank{event.at("number"), finding_from(event.at("finding"))};
    if (kind == "finding") return FindingMade{event.at("number"), finding_from(event.at("finding"))};
    if (kind == "judging") return StillJudging{};
    if (kind == "judged")
      return ProgramJudged{event.at("judged"), event.at("in_full"), event.at("commands"),
                           event.at("not_repeated"), event.at("seconds_of_known")};
  } catch (const json::exception&) {
  } catch (const std::invalid_argument&) {
  }
  return std::nullopt;
}

std::string to_text(const Finding& finding) {
  return to_json(finding).dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string to_text(const RandomJob& job) {
  return json{{"number", job.number},       {"length", job.length},
              {"seconds", job.seconds},     {"in_fresh_context", job.in_fresh_context},
              {"in_flight", job.in_flight}, {"deadly", job.deadly}}
      .dump();
}

RandomJob parse_random_job(const std::string& text) try {
  const json data = json::parse(text);
  return {data.at("number"),           data.at("length"),    data.at("seconds"),
          data.at("in_fresh_context"), data.at("in_flight"), data.at("deadly")};
} catch (const json::exception& error) {
  throw std::invalid_argument(error.what());
}

std::string to_text(const FailingCase& failing) {
  return json{{"test", failing.test},
              {"difference", failing.difference.text()},
              {"commands", failing.commands},
              {"seconds", failing.seconds},
              {"is_known_bug", failing.is_known_bug}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

FailingCase parse_failing_case(const std::string& text) try {
  const json data = json::parse(text);
  return {data.at("test"), parse_difference(data.at("difference")).value_or(Difference()),
          data.at("commands"), data.at("seconds"), data.at("is_known_bug")};
} catch (const json::exception& error) {
  throw std::invalid_argument(error.what());
}

std::string to_line(const ReductionEvent& event) {
  json data = {{"event", "reducing"}};
  if (const auto* reduction = std::get_if<Reduction>(&event)) {
    data = {{"event", "reduction"},
            {"test", reduction->test},
            {"why_not", reduction->why_not},
            {"is_known_bug", reduction->is_known_bug}};
    if (reduction->minimal) data["finding"] = to_json(*reduction->minimal);
  }
  return data.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::optional<Reduction> parse_reduction(const std::string& line) {
  try {
    const json event = json::parse(line);
    if (event.at("event") != json("reduction")) return std::nullopt;
    Reduction reduction{event.at("test"), {}, event.at("why_not"), event.at("is_known_bug")};
    if (event.contains("finding")) reduction.minimal = finding_from(event.at("finding"));
    return reduction;
  } catch (const json::exception&) {
  } catch (const std::invalid_argument&) {
  }
  return std::nullopt;
}

}  // namespace evalcts::fuzz
