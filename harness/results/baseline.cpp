// Reads, applies and writes the files of baselines.
#include <evalcts/results/baseline.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include <evalcts/results/files.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/text.h>
#include "posix.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNotTraced = "not traced to a bug yet";
constexpr std::uint32_t kSeedOfSignatures = 1;
constexpr const char* kSpecial = "*?[@";  // the first characters of the parts of a pattern

// Returns the status of an entry that expects the verdict; null if a baseline cannot expect it.
const char* status_of(Verdict verdict) {
  return verdict == Verdict::kFail      ? "Fail"
         : verdict == Verdict::kCrash   ? "Crash"
         : verdict == Verdict::kTimeout ? "Timeout"
                                        : nullptr;
}

// An entry of a file, with the comment above it as its reason.
struct Line {
  std::string text, reason;
  fs::path file;
  int number;

  BadBaseline bad(const std::string& why) const {
    return BadBaseline(fmt::format("{}:{}: {}", file.string(), number, why));
  }
};

// Returns the entries of a file. Calls in_header(line) for each comment line before the first entry, up to
// the first empty line after one for which it returns true: reasons may look like lines of a header. Throws
// BadBaseline if an entry has no reason, or the file cannot be read.
template <class InHeader>
std::vector<Line> entry_lines(const fs::path& path, InHeader in_header) {
  std::ifstream file(path);
  if (!file) throw BadBaseline(fmt::format("cannot read '{}'", path.string()));
  std::vector<Line> lines;
  std::string reason;
  int number = 0;
  bool has_header = false, is_after_header = false;
  for (std::string text; std::getline(file, text);) {
    ++number;
    if (text.empty()) {
      reason.clear();
      is_after_header = has_header;
    } else if (text.starts_with("#")) {
      const std::string comment = text.size() > 2 ? text.substr(2) : std::string();
      if (lines.empty() && !is_after_header && in_header(Line{comment, "", path, number})) has_header = true;
      reason += (reason.empty() ? "" : " ") + comment;
    } else {
      lines.push_back({text, reason, path, number});
      if (reason.empty()) throw lines.back().bad("an entry needs its reason in a comment above it");
    }
  }
  return lines;
}

std::vector<BaselineFiles::Pattern> read_patterns(const fs::path& path) {
  std::vector<BaselineFiles::Pattern> patterns;
  if (!fs::exists(path)) return patterns;
  for (const Line& line : entry_lines(path, [](const Line&) { return false; })) {
    try {
      patterns.push_back({line.text,
                          [expression = std::regex(line.text)](const std::string& test) {
                            return std::regex_search(test, expression);
                          },
                          line.reason});
    } catch (const std::regex_error& error) {
      throw line.bad(fmt::format("'{}' is not a regular expression: {}", line.text, error.what()));
    }
  }
  return patterns;
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

// Reads "key: value" at the top of NAME-fails.txt. Returns false for any other comment, which belongs to the
// first reason.
bool read_header_line(const Line& line, Scope& header) {
  const std::size_t colon = line.text.find(": ");
  if (colon == std::string::npos) return false;
  const std::string key = line.text.substr(0, colon), value = trimmed(line.text.substr(colon + 2));
  if (key == "vendor") header.vendor = value;
  if (key == "renderer") header.renderer = value;
  if (key == "implementation")
    for (const std::string& name : fields(value)) header.implementations.push_back(trimmed(name));
  if (key == "pass") {
    header.pass = pass_named(value);
    if (!header.pass)
      throw line.bad(fmt::format("unknown pass '{}'; known is '{}'", value, name_of(Pass::kReuseContext)));
  }
  if (key == "version") try {
      header.version = VersionRange(value);
    } catch (const std::invalid_argument& error) {
      throw line.bad(error.what());
    }
  static const std::set<std::string> kKeys = {"vendor", "renderer", "implementation", "pass", "version"};
  return kKeys.contains(key);
}

// Reads "test name,depth,signature".
void read_signatures(const fs::path& path, BaselineFiles& files) {
  if (!fs::exists(path)) return;
  std::ifstream stream(path);
  int number = 0;
  for (std::string text; std::getline(stream, text);) {
    ++number;
    if (text.empty() || text.starts_with("#")) continue;
    const std::vector<std::string> parts = fields(text);
    if (parts.size() != 3) throw Line{text, "", path, number}.bad("expected 'test name,depth,signature'");
    files.signatures[parts[0]][parts[1]] = parts[2];
  }
}

// Appends "# text", wrapped at 100 columns, with "bug: ID." on a separate line. Reading joins
// the lines again.
void append_comment(const std::string& text, std::string& out) {
  std::string line = "#";
  std::istringstream words(text);
  const auto end_line = [&] { out += std::exchange(line, "#") + "\n"; };
  for (std::string word; words >> word;) {
    const bool is_bug = line == "# bug:";
    if (line.size() + word.size() > 99) end_line();
    line += " " + word;
    if (is_bug) end_line();
  }
  if (line != "#") end_line();
}

std::string bug_of(const std::string& reason) {
  constexpr std::string_view kPrefix = "bug: ";
  if (!reason.starts_with(kPrefix)) return {};
  return reason.substr(kPrefix.size(), reason.find('.') - kPrefix.size());
}

// Returns the reason for a failure as far as the run found it: the bug with its clause, or else the violated
// requirement.
std::string reason_found(const RunResult& result, const TestRecord& test) {
  if (const Bug* const bug = result.bug_of(test.name))
    return fmt::format("bug: {}. {}{}", bug->known.empty() ? bug->id : bug->known, one_line(bug->title),
                       bug->clause.empty() ? "" : fmt::format(" [{}]", one_line(bug->clause)));
  const std::vector<RequirementId> violated = test.blamed();
  const Requirement* const requirement = violated.empty() ? nullptr : catalogue().find(violated.front());
  if (!requirement) return std::string(kNotTraced);
  return fmt::format("{} [{}]; {}", requirement->id, requirement->source, kNotTraced);
}

// Returns "AutomaticNormals.OrderOne" for one of its tests.
std::string function_of(const std::string& test) { return test.substr(0, test.find('/')); }

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_pattern(const std::string& text) { return text.find_first_of(kSpecial) != std::string::npos; }

const std::vector<BaselineFiles::Pattern>& none() {
  static const std::vector<BaselineFiles::Pattern> kNone;
  return kNone;
}

std::optional<std::string> first_match(const std::vector<BaselineFiles::Pattern>& patterns,
                                       const std::string& test) {
  for (const BaselineFiles::Pattern& pattern : patterns)
    if (pattern.matches(test)) return pattern.reason;
  return std::nullopt;
}

// Returns the files with this name; null if there are none.
const BaselineFiles* find(const std::vector<BaselineFiles>& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &BaselineFiles::name);
  return found == all.end() ? nullptr : &*found;
}

// Returns the files that the choice names, or those with the most specific header that fits; null if there
// are none. A header is more specific if it has more fields, or longer ones.
const BaselineFiles* chosen_of(const BaselineChoice& choice, const ImplementationRecord& implementation,
                               Pass pass) {
  const auto specificity = [](const BaselineFiles& files) {
    std::pair<std::size_t, std::size_t> sum;
    for (const auto& [key, value] : files.header.fields()) {
      ++sum.first;
      sum.second += value.size();
    }
    return sum;
  };
  if (!choice.name.empty()) {
    const BaselineFiles* const named = find(choice.files, choice.name);
    if (!named) throw BadBaseline(fmt::format("unknown baseline '{}'", choice.name));
    if (named->header.pass == pass) return named;
  }
  const BaselineFiles* best = nullptr;
  for (const BaselineFiles& files : choice.files)
    if (files.header.fits(implementation, pass) && (!best || specificity(*best) < specificity(files)))
      best = &files;
  return best;
}

}  // namespace

bool stands_for(const std::string& pattern, const std::string& test) {
  const std::size_t literal = pattern.find_first_of(kSpecial);  // fnmatch() takes long
  if (literal == std::string::npos) return pattern == test;
  return pattern.compare(0, literal, test, 0, literal) == 0 &&
         fnmatch(pattern.c_str(), test.c_str(), FNM_NOESCAPE | FNM_EXTMATCH) == 0;
}

// --- files

std::string BaselineFiles::Entry::bug() const { return bug_of(reason); }

BaselineFiles BaselineFiles::read(const fs::path& folder, const std::string& name) {
  BaselineFiles files;
  files.name = name;
  const fs::path fails = folder / (name + "-fails.txt");
  files.header.pass = Pass::kFreshContexts;
  const std::vector<Line> lines =
      entry_lines(fails, [&](const Line& line) { return read_header_line(line, files.header); });
  const Scope& header = files.header;
  for (const Line& line : lines) {
    const std::vector<std::string> parts = fields(line.text);
    if (parts.size() != 2) throw line.bad("expected 'test name,Status'");
    if (parts[1] != "Fail" && parts[1] != "Crash" && parts[1] != "Timeout" && parts[1] != "Pass")
      throw line.bad(fmt::format("the status '{}' is not Fail, Crash, Timeout or Pass", parts[1]));
    if (!files.entries.emplace(parts[0], Entry{parts[1], line.reason}).second)
      throw line.bad(fmt::format("a second entry for {}", parts[0]));
  }
  if (header.vendor.empty() && header.renderer.empty() && header.version.text().empty())
    throw BadBaseline(
        fmt::format("{}: the header must say which implementations the file is for: '# vendor: TEXT', "
                    "'# renderer: TEXT' or '# version: NAME A to B'",
                    fails.string()));
  files.skips = read_patterns(folder / (name + "-skips.txt"));
  files.flakes = read_patterns(folder / (name + "-flakes.txt"));
  read_signatures(folder / (name + "-signatures.txt"), files);
  return files;
}

std::vector<BaselineFiles> BaselineFiles::read_all(const fs::path& folder) {
  std::set<std::string> names, of_others;  // in a fixed order
  if (fs::is_directory(folder))
    for (const auto& file : fs::directory_iterator(folder)) {
      const std::string name = file.path().filename().string();
      for (const std::string ending : {"-fails.txt", "-signatures.txt", "-skips.txt", "-flakes.txt"})
        if (name.ends_with(ending))
          (ending == "-fails.txt" ? names : of_others).insert(name.substr(0, name.size() - ending.size()));
    }
  for (const std::string& name : of_others)
    if (!names.contains(name))
      throw BadBaseline(
          fmt::format("'{}' is missing (a header is enough): it states which implementations the "
                      "other files of that name are for",
                      (folder / (name + "-fails.txt")).string()));
  std::vector<BaselineFiles> all;
  for (const std::string& name : names) all.push_back(read(folder, name));
  return all;
}

void BaselineFiles::write(const fs::path& folder) const {
  std::string fails;
  for (const auto& [key, value] : header.fields()) fails += fmt::format("# {}: {}\n", key, value);
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const auto& [test, entry] : entries) by_reason[entry.reason].push_back(test);
  for (const auto& [reason, tests] : by_reason) {
    fails += "\n";
    append_comment(reason, fails);
    for (const std::string& test : tests) fails += fmt::format("{},{}\n", test, entries.at(test).status);
  }
  std::string lines = fmt::format(
      "# test name,depth,signature: the number of mismatches and a hash of their identities. A signature\n"
      "# belongs to its depth and to seed {}: runs with other seeds are not compared with it.\n\n",
      kSeedOfSignatures);
  for (const auto& [test, by_depth] : signatures)
    for (const auto& [depth, signature] : by_depth)
      lines += fmt::format("{},{},{}\n", test, depth, signature);
  fs::create_directories(folder);
  write_atomically(folder / (name + "-fails.txt"), fails);
  write_atomically(folder / (name + "-signatures.txt"), lines);
}

// --- one implementation

Baseline::Baseline(const BaselineChoice& choice, const ImplementationRecord& implementation, Pass pass,
                   const std::vector<KnownBug>& bugs)
    : pass_(pass) {
  if (choice.known_bugs)
    for (const KnownBug& bug : bugs) {
      if (!bug.affects.may_contain(implementation)) continue;
      products_.insert(lower_case(bug.affects.product));
      for (const FailingTests& failing : bug.tests)
        if (failing.scope.fits(implementation, pass))
          for (const std::string& tests : failing.tests)
            lines_.push_back({tests, failing.status, fmt::format("{}: {}", bug.id, bug.title), bug.id});
    }
  // The pattern with more parts is the more specific one, and a name is more specific than a pattern.
  std::ranges::stable_sort(lines_, std::ranges::greater(), [](const Line& line) {
    return std::pair(std::ranges::count(line.tests, '/'), !is_pattern(line.tests));
  });
  if (const BaselineFiles* const chosen = chosen_of(choice, implementation, pass)) {
    files_ = *chosen;
    std::vector<Line> own;
    for (const auto& [tests, entry] : files_->entries)
      own.push_back({tests, entry.status, entry.reason, entry.bug(), true});
    // The name of a test is more specific than any pattern.
    std::stable_partition(own.begin(), own.end(), [](const Line& line) { return !is_pattern(line.tests); });
    lines_.insert(lines_.begin(), own.begin(), own.end());
  }
}

std::string Baseline::name() const {
  std::vector<std::string> names(products_.begin(), products_.end());
  if (files_) names.push_back(files_->name);
  return fmt::format("{}", fmt::join(names, " with "));
}

std::vector<const Baseline::Line*> Baseline::lines_for(const std::string& test) const {
  std::vector<const Line*> found;
  for (const Line& line : lines_) {
    if (!stands_for(line.tests, test)) continue;
    if (line.status == "Pass") break;
    found.push_back(&line);
  }
  return found;
}

std::optional<std::string> Baseline::reason_for(const std::string& status, const std::string& test) const {
  for (const Line* const line : lines_for(test))
    if (line->status == status) return line->reason;
  return std::nullopt;
}

std::optional<std::string> Baseline::skip(const std::string& test) const {
  const std::optional<std::string> own = first_match(files_ ? files_->skips : none(), test);
  return own ? own : reason_for("Skip", test);
}

std::optional<std::string> Baseline::flake(const std::string& test) const {
  const std::optional<std::string> own = first_match(files_ ? files_->flakes : none(), test);
  return own ? own : reason_for("Flaky", test);
}

bool Baseline::knows(const TestRecord& test, Depth depth, std::uint64_t seed) const {
  const char* const status = status_of(test.verdict);
  if (!status) return false;
  if (flake(test.name)) return true;
  bool is_expected = false, is_of_bug = false;
  for (const Line* const line : lines_for(test.name))
    if (line->status == status) (line->is_of_user ? is_expected : is_of_bug) = true;
  if (seed != kSeedOfSignatures || test.verdict != Verdict::kFail) return is_expected || is_of_bug;
  // An entry of the user is compared if it has a signature for the depth.
  bool has_signature = false, is_known = false;
  if (files_)
    for (const auto& [tests, by_depth] : files_->signatures)
      if (const auto found = by_depth.find(name_of(depth));
          found != by_depth.end() && stands_for(tests, test.name)) {
        has_signature = true;
        is_known = is_known || found->second == test.signature();
      }
  if (is_expected && (is_known || !has_signature)) return true;
  return is_of_bug && (depth == Depth::kThorough || pass_ != Pass::kFreshContexts ||
                       std::ranges::any_of(products_, [&](const std::string& product) {
                         return known_signatures(product, function_of(test.name)).contains(test.signature());
                       }));
}

void Baseline::apply(RunResult& result, const std::vector<ListedTest>& all) const {
  result.baseline = name();
  const Depth depth = result.depth.value_or(Depth::kFull);
  for (TestRecord& test : result.tests) {
    const char* const status = status_of(test.verdict);
    if (test.also_in_fresh_context || !status) continue;
    const std::vector<const Line*> lines = lines_for(test.name);
    const std::optional<std::string> flaky = flake(test.name);
    const auto expects = [&](const Line* line) { return line->status == status || line->status == "Flaky"; };
    const auto line = std::ranges::find_if(lines, expects);
    if (!flaky && lines.empty()) continue;
    if (!flaky && line == lines.end()) {
      test.message =
          fmt::format("the baseline expects {}, not {}: {}", lines[0]->status, status, test.message);
    } else if (!knows(test, depth, result.seed.value_or(kSeedOfSignatures))) {
      test.message =
          fmt::format("a known failure, but other cases fail than the baseline knows: {}", test.message);
    } else {
      test.expected_by_baseline = true;
      test.baseline_reason = flaky ? "flaky: " + *flaky : (*line)->reason;
      for (const Line* const each : lines)
        if (expects(each) && !each->bug.empty() && std::ranges::count(test.known_bugs, each->bug) == 0)
          test.known_bugs.push_back(each->bug);
      if (const std::string bug = flaky ? bug_of(*flaky) : ""; !bug.empty()) test.known_bugs = {bug};
    }
  }
  mark_unexpected_passes(result, all);
}

void Baseline::mark_unexpected_passes(RunResult& result, const std::vector<ListedTest>& all) const {
  // The programs of known bugs are for fresh contexts.
  std::map<std::string, std::vector<const Line*>> groups;
  for (const Line& line : lines_)
    if (line.status != "Pass" && line.status != "Flaky" && line.status != "Skip" &&
        (line.is_of_user || result.pass == Pass::kFreshContexts))
      groups[line.group()].push_back(&line);
  std::map<std::string, TestRecord*> records;
  for (TestRecord& test : result.tests) records[test.name] = &test;
  for (const auto& [group, lines] : groups) {
    std::vector<TestRecord*> passes;
    bool is_open = false;  // a test fails, was not judged, or was not run
    for (const ListedTest& test : all) {
      if (test.from > result.depth.value_or(Depth::kFull) && !records.contains(test.name)) continue;
      if (std::ranges::none_of(lines, [&](const Line* line) { return stands_for(line->tests, test.name); }))
        continue;
      const auto record = records.find(test.name);
      if (record != records.end() && record->second->verdict == Verdict::kPass)
        passes.push_back(record->second);
      else
        is_open = true;
    }
    if (is_open) continue;
    for (TestRecord* const pass : passes)
      if (!lines_for(pass->name).empty() && !flake(pass->name)) pass->baseline_reason = lines[0]->reason;
  }
}

std::vector<std::string> Baseline::stale_entries(const std::vector<ListedTest>& all) const {
  if (!files_) return {};
  std::set<std::string> stale;
  for (const auto& [tests, entry] : files_->entries) {
    const auto stands = [&pattern = tests](const ListedTest& test) { return stands_for(pattern, test.name); };
    if (std::ranges::none_of(all, stands)) {
      stale.insert(tests);
    } else if (entry.status == "Pass") {
      const auto is_expected = [&](const Line& line) {
        return line.status != "Pass" && std::ranges::any_of(all, [&](const ListedTest& test) {
                 return stands(test) && stands_for(line.tests, test.name);
               });
      };
      if (std::ranges::none_of(lines_, is_expected))
        stale.insert(fmt::format("{} (Pass, but no failure is expected)", tests));
    }
  }
  for (const auto& [patterns, kind] : {std::pair{&files_->skips, "skips"}, {&files_->flakes, "flakes"}})
    for (const BaselineFiles::Pattern& pattern : *patterns)
      if (std::ranges::none_of(all, [&](const ListedTest& test) { return pattern.matches(test.name); }))
        stale.insert(fmt::format("{} (in the {})", pattern.text, kind));
  return {stale.begin(), stale.end()};
}

std::vector<std::string> Baseline::unused_signatures() const {
  std::vector<std::string> unused;
  if (files_)
    for (const auto& [tests, signatures] : files_->signatures)
      if (std::ranges::none_of(lines_, [&pattern = tests](const Line& line) {
            return line.status != "Pass" &&
                   (stands_for(line.tests, pattern) || stands_for(pattern, line.tests));
          }))
        unused.push_back(tests);
  return unused;
}

BaselineFiles Baseline::renewed(const RunResult& result, const BaselineChoice& choice,
                                const std::string& new_name, const std::string& reason) const {
  BaselineFiles files;
  if (files_) {
    files = *files_;
  } else {
    if (const BaselineFiles* const existing = find(choice.files, new_name)) {
      std::vector<std::string> header;
      for (const auto& [key, value] : existing->header.fields())
        header.push_back(fmt::format("{}: {}", key, value));
      throw BadBaseline(fmt::format(
          "{0}-fails.txt is for other implementations ({1}) and was not replaced. To update it, choose it "
          "with --baseline FOLDER/{0}, or change its header, for example to a range of versions "
          "('# version: Mesa 20.3 to 24.3'); to write another file, choose its name with --name",
          new_name, fmt::join(header, ", ")));
    }
    const ImplementationRecord& implementation = result.implementation;
    files.name = new_name;
    files.header = {implementation.vendor,
                    implementation.renderer,
                    VersionRange(implementation.version),
                    {implementation.kind},
                    result.pass};
  }
  const Depth depth = result.depth.value_or(Depth::kFull);
  const std::uint64_t seed = result.seed.value_or(kSeedOfSignatures);
  for (const std::string& test : unused_signatures()) files.signatures.erase(test);
  Baseline without = *this;  // the entries of single tests
  std::erase_if(without.lines_, [](const Line& line) { return line.is_of_user && !is_pattern(line.tests); });
  if (without.files_)
    std::erase_if(without.files_->signatures, [](const auto& each) { return !is_pattern(each.first); });
  for (const TestRecord& test : result.tests) {
    if (test.also_in_fresh_context || flake(test.name)) continue;
    const auto own = files.entries.find(test.name);
    const bool has_reason = own != files.entries.end() && !own->second.reason.ends_with(kNotTraced);
    const std::string new_reason = !reason.empty() ? reason
                                   : has_reason    ? own->second.reason
                                                   : reason_found(result, test);
    const char* const status = status_of(test.verdict);
    if (!status &&
        (test.verdict != Verdict::kPass || (own != files.entries.end() && own->second.status == "Pass")))
      continue;
    files.entries.erase(test.name);
    if (!status || without.knows(test, depth, seed)) {
      files.signatures.erase(test.name);
    } else {
      files.entries[test.name] = {status, new_reason};
      if (seed == kSeedOfSignatures) files.signatures[test.name][name_of(depth)] = test.signature();
    }
  }
  return files;
}

}  // namespace evalcts
