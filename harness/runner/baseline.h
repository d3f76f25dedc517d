// Baselines: what is known of one implementation and not news, each with its reason. A baseline never changes
// a verdict; it says what was expected, so that only what changes is red.
//
// A folder of plain text files, as GL driver CI uses them. The reason of an entry is the comment above it
// (the same for all entries up to the next empty line), and no entry goes without:
//   NAME-fails.txt       "test name,Status" (Fail, Crash, Timeout). At the top of the file "# vendor: ",
//                        "# renderer: " and "# version: " name what it is for: each must be part of what the
//                        implementation says of itself. "# implementation: osmesa" tells two ways to the same
//                        library apart; "# pass: reuse-context" makes it the baseline of the second pass over
//                        one shared context (without: the pass with fresh contexts). Where several fit, the
//                        one with the more specific header is meant.
//   NAME-signatures.txt  "test name,depth,signature": which cases of the test fail, so that a known failure
//                        cannot hide a new one. Signatures belong to a depth and to the seed 1.
//   NAME-skips.txt       regular expressions (ECMAScript; found anywhere in the name, so anchor with ^ and
//   $):
//                        tests that are not run and get the verdict `skipped`
//   NAME-flakes.txt      regular expressions: tests whose fail, crash, timeout or pass is no news
#pragma once

#include <filesystem>
#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/results/json.h"

namespace evalcts {

// A file of a baseline does not follow its format; the message names file and line.
struct BadBaseline : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Baseline {
 public:
  struct Entry {
    std::string status;  // Fail, Crash, Timeout
    std::string reason;
    std::map<std::string, std::string> signatures;  // by depth; a depth that is missing is not compared
  };

  struct Pattern {
    std::string text;
    std::regex expression;
    std::string reason;
  };

  // Reads NAME-fails.txt and those of the other files that exist. Throws BadBaseline.
  static Baseline read(const std::filesystem::path& folder, const std::string& name);
  // All baselines of a folder (none where it does not exist), by name. Throws BadBaseline.
  static std::vector<Baseline> read_all(const std::filesystem::path& folder);

  // The one whose header fits the implementation of a result record and the pass (empty: fresh contexts) most
  // specifically; an empty one where none does.
  static Baseline best_fit(const std::vector<Baseline>& baselines, const nlohmann::json& implementation,
                           const std::string& pass = {});

  const std::string& name() const { return name_; }
  const std::map<std::string, Entry>& entries() const { return entries_; }
  bool fits(const nlohmann::json& implementation, const std::string& pass = {}) const;

  // The pattern that says not to run the test, or that it is flaky; null where none does.
  const Pattern* skip(const std::string& test) const { return matching(skips_, test); }
  const Pattern* flake(const std::string& test) const { return matching(flakes_, test); }

  // Whether a test record is a fail, crash or timeout that is known, with the same failing cases where the
  // record was made at the depth and seed of a signature.
  bool knows(const nlohmann::json& test, const std::string& depth, std::uint32_t seed) const;

  // Marks the tests of a result record: "expected_by_baseline" and "baseline_reason". A known failure whose
  // signature changed stays unexpected and says so in its message. Sets "baseline" of the record. Leaves
  // alone what is marked as "also_in_fresh_context".
  void apply(nlohmann::json& result) const;

  // Entries for tests that do not exist any more, and patterns that match no test (`tests`: as the suite
  // program lists them).
  std::vector<std::string> stale_entries(const nlohmann::json& tests) const;

  // What fails in the record, as a baseline: reasons of entries that this one has are kept, new ones say that
  // they have not been traced yet. Skips and flakes stay as they are, and flaky tests get no entry.
  Baseline renewed(const nlohmann::json& result, const std::string& name) const;
  // Writes the fails and the signatures; the files of skips and flakes belong to people. Throws
  // std::runtime_error.
  void write(const std::filesystem::path& folder) const;

 private:
  static const Pattern* matching(const std::vector<Pattern>& patterns, const std::string& test);
  std::size_t specificity() const;

  std::string name_;
  std::string vendor_, renderer_, version_, implementation_, pass_;
  std::map<std::string, Entry> entries_;
  std::vector<Pattern> skips_, flakes_;
};

// Stands for the sorted identities of the failing cases of a test record.
std::string signature_of(const nlohmann::json& test);

}  // namespace evalcts
