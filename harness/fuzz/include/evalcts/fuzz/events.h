// Findings and the events of a campaign of random programs as lines of text, and back: the one place of
// harness/fuzz that knows their JSON format.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <evalcts/fuzz/campaign.h>
#include <evalcts/results/serialization.h>

namespace evalcts::fuzz {

struct CampaignStarted {
  int max_eval_order = 8;  // as programs are made for
};
// While a failing program shrinks.
struct FindingShrank {
  Finding finding;
};
struct FindingMade {
  std::uint32_t number = 0;  // of the program
  Finding finding;
};
// Totals since the campaign started.
struct CampaignProgress {
  std::uint64_t programs = 0;
  std::uint64_t judged = 0;   // those of which something could be observed
  std::uint64_t in_full = 0;  // those of which everything could
  std::uint64_t commands = 0;
  std::uint64_t not_repeated = 0;  // those that differed in the shared context only
};
using CampaignEvent =
    std::variant<CampaignStarted, TestStarted, FindingShrank, FindingMade, CampaignProgress>;

// Runs the campaign, of each program the commands that the implementation has, and reports events: first
// CampaignStarted, TestStarted before each program, and CampaignProgress now and then.
void play(const Subject& subject, const Campaign& campaign,
          const std::function<void(const CampaignEvent& event)>& report);

// One line, which ends with a newline.
std::string to_line(const CampaignEvent& event);
// None if the line is not such an event.
std::optional<CampaignEvent> parse_campaign_event(const std::string& line);

// {"program": commands as in gl/case_json.h, "cause", "requirement", "outside_evaluators", "what", "message",
// "expected", "captured", "calls"}
std::string to_text(const Finding& finding);

// A list of texts, and back; empty if the text holds no list.
std::string list_as_text(const std::vector<std::string>& list);
std::vector<std::string> parse_list(const std::string& text);

// A program that random search found on some implementation, and that every run replays (suites/findings).
struct KnownFinding {
  std::string name, requirement;
  std::string what;  // what differed
  gl::Case program;
};
const std::vector<KnownFinding>& known_findings();

}  // namespace evalcts::fuzz
