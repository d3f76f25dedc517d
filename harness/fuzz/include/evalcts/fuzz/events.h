// Writes and reads findings and the events of a campaign of random programs as JSON.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <evalcts/fuzz/campaign.h>
#include <evalcts/fuzz/finding.h>
#include <evalcts/results/serialization.h>

namespace evalcts::fuzz {

struct CampaignStarted {
  int max_eval_order = 8;  // the limit with which programs are made
};
// A smaller program of the finding that is being reduced.
struct FindingShrank {
  Finding finding;
};
struct FindingMade {
  std::uint32_t number = 0;  // number of the program
  Finding finding;
};
// Totals since the campaign started.
struct CampaignProgress {
  std::uint64_t programs = 0;
  std::uint64_t judged = 0;   // programs of which at least some effects could be observed
  std::uint64_t in_full = 0;  // programs of which all effects could be observed
  std::uint64_t commands = 0;
  std::uint64_t not_repeated = 0;  // programs that differed only in the shared context
  double seconds_of_known = 0;     // time spent on differences without a new cause
};
using CampaignEvent =
    std::variant<CampaignStarted, TestStarted, FindingShrank, FindingMade, CampaignProgress>;

// Runs the campaign and reports events: first CampaignStarted, then TestStarted before each program, and
// CampaignProgress every half second and at the end. Commands that the implementation does not provide are
// left out of the programs.
void run_campaign(const Subject& subject, const Campaign& campaign,
                  const std::function<void(const CampaignEvent& event)>& report);

// Returns the event as one line, which ends with a newline.
std::string to_line(const CampaignEvent& event);
// Returns none if the line is not such an event.
std::optional<CampaignEvent> parse_campaign_event(const std::string& line);

// Returns a finding as JSON: {"program": commands as in gl/case_json.h, "cause", "title", "requirement",
// "known", "outside_evaluators", "difference", "what", "message", "expected", "captured", "calls"}.
std::string to_text(const Finding& finding);

// Write and read a list of texts. parse_list() returns an empty list if the text is not a list.
std::string list_as_text(const std::vector<std::string>& list);
std::vector<std::string> parse_list(const std::string& text);

}  // namespace evalcts::fuzz
