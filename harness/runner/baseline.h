// Baselines: the failures that are known of one implementation, each with its reason. A baseline never
// changes a verdict; it says what was expected, so that only what changes is red.
//
// A folder of plain text files, as GL driver CI uses them:
//   NAME-fails.txt       "test name,Status" (Fail, Crash, Timeout), the reason in the comment lines above the
//   entry; at
//                        the top of the file "# vendor: ", "# renderer: " and "# version: " name what it is
//                        for: each must be part of what the implementation says of itself
//   NAME-signatures.txt  "test name,depth,signature": which cases of the test fail, so that a known failure
//   cannot
//                        hide a new one
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

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

  // Reads NAME-fails.txt and, where it exists, NAME-signatures.txt. Throws BadBaseline.
  static Baseline read(const std::filesystem::path& folder, const std::string& name);

  // The baseline of the folder whose header fits the implementation of a result record; an empty one where
  // none does. Throws BadBaseline.
  static Baseline find(const std::filesystem::path& folder, const nlohmann::json& implementation);

  const std::string& name() const { return name_; }
  const std::map<std::string, Entry>& entries() const { return entries_; }
  bool fits(const nlohmann::json& implementation) const;

  // Marks the tests of a result record: "expected_by_baseline" and "baseline_reason". A known failure whose
  // signature changed stays unexpected and says so in its message. Sets "baseline" of the record.
  void apply(nlohmann::json& result) const;

  // Entries for tests that do not exist any more (`tests`: as the suite program lists them).
  std::vector<std::string> stale_entries(const nlohmann::json& tests) const;

  // What fails in the record, as a baseline: reasons of entries that this one has are kept, new ones say that
  // they have not been traced yet.
  Baseline renewed(const nlohmann::json& result, const std::string& name) const;
  // Writes both files. Throws std::runtime_error.
  void write(const std::filesystem::path& folder) const;

 private:
  std::string name_;
  std::string vendor_, renderer_, version_;
  std::map<std::string, Entry> entries_;
};

// Stands for the sorted identities of the failing cases of a test record.
std::string signature_of(const nlohmann::json& test);

}  // namespace evalcts
