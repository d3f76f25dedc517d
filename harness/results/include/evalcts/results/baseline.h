// Baselines: the known failures of one implementation, each with its reason. A baseline never changes a
// verdict. It states which results are expected, so that only a change makes a run fail.
//
// Known are the failures of the known bugs (known_bugs.h), and those in the files of the user, which have the
// format of GL driver CI. The reason of an entry is the comment above it (the same for all entries up to the
// next empty line), and every entry needs one.
// NAME-fails.txt has lines "test name,Status" (Fail, Crash, Timeout, or Pass, which takes a test out of what
// is known). The comments at its top form the header, which states the implementations that the files are
// for:
//   # vendor: TEXT            part of GL_VENDOR
//   # renderer: TEXT          part of GL_RENDERER
//   # version: RANGE          range of GL_VERSION, see version_range.h
//   # implementation: A, B    names of implementations, see `evalcts list implementations`
//   # pass: reuse-context     the second pass, over one shared context, instead of the first
// NAME-signatures.txt has lines "test name,depth,signature": the failing cases of the test, so that a known
// failure cannot hide a new one. A signature belongs to its depth and to seed 1. NAME-skips.txt has regular
// expressions (ECMAScript, found anywhere in the name) for tests that are not run and get the verdict
// `skipped`. NAME-flakes.txt has regular expressions for tests whose fail, crash, timeout or pass is never
// unexpected.
//
// A test name may be a pattern of the shell, in which * stands for any characters, ? for one, [ab] for one of
// these, and @(A|B) for A or B. A pattern permits failures: some of its tests may pass. If all of them pass,
// or all tests of a known bug, the passes are unexpected.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/results/known_bugs.h>
#include <evalcts/results/run_result.h>
#include <evalcts/results/scope.h>

namespace evalcts {

// Thrown if a file of a baseline does not follow its format, or a baseline cannot be selected or written as
// requested. The message is for the user and names file and line.
struct BadBaseline : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// True if the pattern stands for the test.
bool stands_for(const std::string& pattern, const std::string& test);

// The content of the four files with one NAME.
struct BaselineFiles {
  struct Entry {
    std::string status;  // Fail, Crash, Timeout, Pass
    std::string reason;

    // Returns the ID in a reason "bug: ID. text"; empty if there is none.
    std::string bug() const;
  };

  struct Pattern {
    std::string text;
    std::function<bool(const std::string& test)> matches;
    std::string reason;
  };

  std::string name;
  Scope header;
  std::map<std::string, Entry> entries;                                  // by test or pattern
  std::map<std::string, std::map<std::string, std::string>> signatures;  // by test or pattern, and depth
  std::vector<Pattern> skips, flakes;

  // Reads NAME-fails.txt and the other files, if they exist. Throws BadBaseline.
  static BaselineFiles read(const std::filesystem::path& folder, const std::string& name);
  // Reads all files of a folder (none if it does not exist), in the order of their names. Throws BadBaseline.
  static std::vector<BaselineFiles> read_all(const std::filesystem::path& folder);

  // Writes the fails and the signatures; the files of skips and flakes are maintained by hand. Throws
  // std::runtime_error.
  void write(const std::filesystem::path& folder) const;
};

// The choice of a baseline.
struct BaselineChoice {
  bool known_bugs = true;                 // the failures of known bugs are expected
  std::vector<BaselineFiles> files = {};  // the one with the most specific header that fits is used
  std::string name = {};  // the name of the files to use regardless of their header; empty: none
};

// The known failures of one implementation. A default-constructed baseline expects no failures.
class Baseline {
 public:
  Baseline() = default;
  // Throws BadBaseline if no files have the chosen name.
  Baseline(const BaselineChoice& choice, const ImplementationRecord& implementation,
           Pass pass = Pass::kFreshContexts, const std::vector<KnownBug>& bugs = evalcts::known_bugs());

  // Returns the name of the baseline, such as "mesa" or "mesa with library"; empty if there is none.
  std::string name() const;
  // Returns the files of the user; null if none are used.
  const BaselineFiles* files() const { return files_ ? &*files_ : nullptr; }

  // Return the reason for which the test is not run, or is flaky; none if it is not.
  std::optional<std::string> skip(const std::string& test) const;
  std::optional<std::string> flake(const std::string& test) const;

  // True if the test record is a known fail, crash or timeout. With seed 1, the failing cases must be known,
  // too: those of the user's entries if they have a signature for the depth, and those of known bugs at quick
  // and full depth. In the second pass, those of known bugs depend on the tests before and are not compared.
  bool knows(const TestRecord& test, Depth depth, std::uint64_t seed) const;

  // Sets `baseline` of the result, and `expected_by_baseline`, `baseline_reason` and `known_bugs` of its
  // tests. A known failure whose failing cases changed stays unexpected, and its message says so. Does not
  // change tests that also fail in a fresh context. `all`: all tests of the suite.
  void apply(RunResult& result, const std::vector<ListedTest>& all) const;

  // Returns entries of the user's files for tests that do not exist, patterns that match no test, and "Pass"
  // entries of tests that are not expected to fail anyway.
  std::vector<std::string> stale_entries(const std::vector<ListedTest>& all) const;
  // Returns the signatures of the user's files for which no failure is expected.
  std::vector<std::string> unused_signatures() const;

  // Returns the user's files with an entry for each failure of the result that is not known without them, and
  // without those of tests that pass; new files are called `new_name`. Patterns, skips and flakes are kept.
  // `reason`: of the entries; empty: existing reasons are kept, and new entries name their bug and its
  // clause. Flaky tests get no entry. Throws BadBaseline if the new files would replace some of the choice,
  // which are for other implementations.
  BaselineFiles renewed(const RunResult& result, const BaselineChoice& choice, const std::string& new_name,
                        const std::string& reason = {}) const;

 private:
  // Tests that are expected to fail for one reason.
  struct Line {
    std::string tests;   // pattern
    std::string status;  // Fail, Crash, Timeout, Pass, Flaky, Skip
    std::string reason;
    std::string bug;  // ID of the known bug; empty: none
    bool is_of_user = false;

    // The tests of lines with the same group are expected to contain a failure.
    const std::string& group() const { return is_of_user ? tests : bug; }
  };

  // Returns the lines for the test, the most specific one first; none if "Pass" takes it out of them.
  std::vector<const Line*> lines_for(const std::string& test) const;
  std::optional<std::string> reason_for(const std::string& status, const std::string& test) const;
  void mark_unexpected_passes(RunResult& result, const std::vector<ListedTest>& all) const;

  Pass pass_ = Pass::kFreshContexts;
  std::vector<Line> lines_;
  std::set<std::string> products_;  // of the known bugs, in lower case: "mesa"
  std::optional<BaselineFiles> files_;
};

}  // namespace evalcts
