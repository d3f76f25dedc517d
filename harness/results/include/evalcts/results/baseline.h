// Baselines: the known failures of one implementation, each with its reason. A baseline never changes a
// verdict. It states which results are expected, so that only a change makes a run fail.
//
// A baseline is stored as plain text files in one folder, in the format of GL driver CI. The reason of an
// entry is the comment above it (the same for all entries up to the next empty line), and every entry needs
// one.
// NAME-fails.txt has lines "test name,Status" (Fail, Crash, Timeout); in a name, * stands for any characters.
// The comments at its top form the
// header, which states the implementations that the files are for:
//   # vendor: TEXT            part of GL_VENDOR
//   # renderer: TEXT          part of GL_RENDERER
//   # version: RANGE          range of GL_VERSION, see version_range.h
//   # implementation: A, B    names of implementations, see `evalcts list implementations`
//   # pass: reuse-context     the second pass, over one shared context, instead of the first
//   # depth: thorough         runs at this depth only
//   # extends: BASE           makes the files an overlay
// NAME-signatures.txt has lines "test name,depth,signature": the failing cases of the test, so that a known
// failure cannot hide a new one. A pattern stands for all its tests with an entry in the same files. A
// signature belongs to its depth and to seed 1, and is ignored if its test has no entry. NAME-skips.txt has
// regular expressions (ECMAScript, found anywhere in the name) for tests that are not run and get the verdict
// `skipped`. NAME-flakes.txt has regular expressions for tests whose fail, crash, timeout or pass is never
// unexpected.
//
// An overlay holds only the differences from BASE for one driver, window system or range of versions. The
// status "Pass" withdraws an entry of BASE, and a signature replaces the one in BASE. The baseline of an
// implementation is the base with the most specific header, and all overlays of this base that fit, the most
// specific one last.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/results/run_result.h>
#include <evalcts/results/version_range.h>

namespace evalcts {

// Thrown if a file of a baseline does not follow its format, or a baseline cannot be selected or written as
// requested. The message is for the user and names file and line.
struct BadBaseline : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The content of the four files with one NAME.
struct BaselineFiles {
  struct Header {
    std::string vendor, renderer;
    VersionRange version;
    std::vector<std::string> implementations;  // empty: all
    Pass pass = Pass::kFreshContexts;
    std::optional<Depth> depth;  // none: all
    std::string extends;         // empty: not an overlay

    // The larger of two values belongs to the more specific header: it has more fields, or longer ones.
    struct Specificity {
      std::size_t fields = 0, length = 0;
      auto operator<=>(const Specificity&) const = default;
    };
    Specificity specificity() const;
    // Returns the fields of the header, in the order of the file: {"version", "Mesa 20.3 or newer"}.
    std::vector<std::pair<std::string, std::string>> fields() const;
    bool fits(const ImplementationRecord& implementation, Pass for_pass, Depth at_depth) const;
  };

  struct Entry {
    std::string status;  // Fail, Crash, Timeout, Pass
    std::string reason;
  };

  struct Pattern {
    std::string text;
    std::regex expression;
    std::string reason;
  };

  std::string name;
  Header header;
  std::map<std::string, Entry> entries;                                  // by test
  std::map<std::string, std::map<std::string, std::string>> signatures;  // by test and depth
  std::vector<Pattern> skips, flakes;

  // Reads NAME-fails.txt and the other files, if they exist. Throws BadBaseline.
  static BaselineFiles read(const std::filesystem::path& folder, const std::string& name);
  // Reads all files of a folder (none if it does not exist), in the order of their names. Throws BadBaseline,
  // also if the base of an overlay is missing.
  static std::vector<BaselineFiles> read_all(const std::filesystem::path& folder);

  // Returns the files with the tests that patterns of `tests` (sorted) stand for in place of these patterns.
  // An entry for a test takes precedence over patterns; the status "Pass" takes the test out of them. A
  // pattern that matches no test stays.
  BaselineFiles expanded(const std::vector<std::string>& tests) const;
  // Returns the files with patterns in place of several tests with the same status and reason, or with the
  // same signature. They expand to these files.
  BaselineFiles with_patterns(const std::vector<std::string>& tests) const;

  // Writes the fails and the signatures; the files of skips and flakes are maintained by hand. Throws
  // std::runtime_error.
  void write(const std::filesystem::path& folder) const;
};

// The known failures of one implementation, composed of a base and its overlays. A default-constructed
// baseline expects no failures.
class Baseline {
 public:
  struct Entry {
    std::string status;  // Fail, Crash, Timeout
    std::string reason;
    std::map<std::string, std::string> signatures;  // by depth; not compared at a missing depth
  };
  using Pattern = BaselineFiles::Pattern;

  // Returns the baseline of the implementation in the given pass and at the given depth. If `chosen` is not
  // empty, that base or overlay is used regardless of its header, provided that it is for the pass. Throws
  // BadBaseline if no files have the name `chosen`.
  static Baseline best_fit(const std::vector<BaselineFiles>& all, const ImplementationRecord& implementation,
                           Pass pass = Pass::kFreshContexts, const std::string& chosen = {},
                           Depth depth = Depth::kFull);

  // Returns this baseline with the given files in place of those with the same name, or, if it is empty, a
  // baseline of these files.
  Baseline with(const BaselineFiles& files) const;

  // Returns the name of the baseline, such as "mesa" or "mesa with mesa.softpipe"; empty if there is none.
  std::string name() const;
  // True if the base or one of the overlays has this name.
  bool has_part(const std::string& name) const;
  const std::map<std::string, Entry>& entries() const { return entries_; }

  // Return the pattern that excludes the test from the run, or declares it flaky; null if there is none.
  const Pattern* skip(const std::string& test) const { return matching(&BaselineFiles::skips, test); }
  const Pattern* flake(const std::string& test) const { return matching(&BaselineFiles::flakes, test); }

  // True if the test record is a known fail, crash or timeout. If there is a signature for the depth and the
  // seed is 1, the failing cases must be the same, too.
  bool knows(const TestRecord& test, Depth depth, std::uint64_t seed) const;

  // Sets `baseline` of the result, and `expected_by_baseline` and `baseline_reason` of its tests. A known
  // failure whose signature changed stays unexpected, and its message says so. Does not change tests that
  // also fail in a fresh context.
  void apply(RunResult& result) const;

  // Returns entries for tests that no longer exist, patterns that match no test, and "Pass" entries of an
  // overlay that withdraw nothing (`tests`: all tests of the suite).
  std::vector<std::string> stale_entries(const std::vector<ListedTest>& tests) const;
  // Returns the tests that have a signature but no entry.
  std::vector<std::string> unused_signatures() const;

  // Returns files with which this baseline expects exactly the failures of the result. They replace the
  // part called `target`; an empty `target` stands for the only part, or, if there is none, for new files
  // called `new_name`. Their entries are the differences from the other parts. Existing reasons are kept;
  // new entries state that their cause has not been traced. Skips and flakes are kept, flaky tests get no
  // entry, and signatures without an entry are removed. Throws BadBaseline if no part is called `target`, if
  // there are several parts and `target` is empty, or if the new files would replace files in `all`, which
  // are for other implementations.
  BaselineFiles renewed(const RunResult& result, const std::string& target, const std::string& new_name,
                        const std::vector<BaselineFiles>& all = {}) const;

 private:
  static Baseline composed(std::vector<BaselineFiles> parts);
  const Pattern* matching(std::vector<Pattern> BaselineFiles::*patterns, const std::string& test) const;

  std::vector<BaselineFiles> parts_;  // the base first
  std::map<std::string, Entry> entries_;
};

}  // namespace evalcts
