// Writes and reads findings and the events of a campaign of random programs as JSON.
#pragma once

#include <optional>
#include <string>

#include <evalcts/fuzz/campaign.h>
#include <evalcts/fuzz/finding.h>

namespace evalcts::fuzz {

// Returns the event as one line, which ends with a newline.
std::string to_line(const CampaignEvent& event);
// Returns none if the line is not such an event.
std::optional<CampaignEvent> parse_campaign_event(const std::string& line);

// Returns a finding as JSON: {"program": commands as in gl/case_json.h, "cause", "title", "requirement",
// "known", "outside_evaluators", "difference", "what", "message", "expected", "captured", "calls"}.
std::string to_text(const Finding& finding);

// Convert the data of a job to JSON and back. parse_random_job() throws std::invalid_argument.
std::string to_text(const RandomJob& job);
RandomJob parse_random_job(const std::string& text);

}  // namespace evalcts::fuzz
