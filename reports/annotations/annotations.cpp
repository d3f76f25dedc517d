// Writes new failures as annotations of CI services.
#include <fmt/format.h>

#include <algorithm>

#include <evalcts/results/hash.h>
#include <evalcts/results/json.h>
#include "evalcts/reports.h"
#include "text.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

constexpr std::size_t kMostOfGithub = 10;  // the errors of a step that GitHub shows

// A bug with new failures, or a new failure that belongs to no bug.
struct Annotation {
  std::string id;  // stable from run to run
  std::string title, text;
  Verdict verdict = Verdict::kFail;
};

std::string difference_of(const Failure& failure, const std::string& message) {
  if (failure.expected.empty() && failure.captured.empty()) return in_plain_numbers(message);
  return fmt::format("{}expected {}, got {}", failure.what.empty() ? "" : failure.what + ": ",
                     in_plain_numbers(failure.expected), in_plain_numbers(failure.captured));
}

std::vector<Annotation> annotations_of(const RunResult& result) {
  std::vector<Annotation> all;
  const std::string name = result.file_label();
  const auto is_new = [](const TestRecord& test) { return test.is_bad() && test.is_unexpected(); };
  for (const Bug& bug : result.bugs) {
    const auto count_of = std::ranges::count_if(result.tests, [&](const TestRecord& test) {
      return is_new(test) && std::ranges::binary_search(bug.tests, test.name);
    });
    if (count_of == 0) continue;
    all.push_back({name + ":" + bug.id, fmt::format("{}: {}", name, bug.title),
                   fmt::format("{} ({}, {}). {} [{}]", bug.id, text_of(bug.verdict).label,
                               count(static_cast<std::uint64_t>(count_of), "new failing test"),
                               difference_of(bug.failure, bug.failure.message), bug.clause),
                   bug.verdict});
  }
  for (const TestRecord& test : result.tests) {
    if (!is_new(test) || result.bug_of(test.name)) continue;
    const Failure none{};
    all.push_back(
        {name + ":" + test.name, fmt::format("{}: {}", name, test.name),
         fmt::format("{}: {}", text_of(test.verdict).label,
                     difference_of(test.failures.empty() ? none : test.failures.front(), test.message)),
         test.verdict});
  }
  return all;
}

// Escapes the data of a workflow command; `property`: also what separates its properties.
std::string escaped(const std::string& text, bool property) {
  std::string out;
  for (const char c : text) {
    if (c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ',')))
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string github_annotations(const std::vector<RunResult>& results) {
  std::string out;
  std::size_t shown = 0, all = 0;
  for (const RunResult& result : results)
    for (const Annotation& each : annotations_of(result)) {
      ++all;
      if (shown + 1 < kMostOfGithub) {
        out += fmt::format("::error title={}::{}\n", escaped(each.title, true), escaped(each.text, false));
        ++shown;
      }
    }
  if (all > shown) out += fmt::format("::error title=evalcts::{} more are in the summary\n", all - shown);
  return out;
}

std::string gitlab_code_quality(const std::vector<RunResult>& results, const std::string& file) {
  json all = json::array();
  for (const RunResult& result : results)
    for (const Annotation& each : annotations_of(result))
      all.push_back({{"description", each.title + ". " + each.text},
                     {"check_name", each.id},
                     {"fingerprint", fmt::format("{:016x}", fnv1a<std::uint64_t>(each.id))},
                     {"severity", is_death(each.verdict) ? "critical" : "major"},
                     {"location", {{"path", file}, {"lines", {{"begin", 1}}}}}});
  return all.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace evalcts::reports
