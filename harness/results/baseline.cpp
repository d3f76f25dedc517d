// Reads, applies and writes the files of baselines.
#include <evalcts/results/baseline.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include <evalcts/results/files.h>
#include <evalcts/results/test_patterns.h>

namespace evalcts {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNotTraced = "not traced to a clause yet";
constexpr std::uint32_t kSeedOfSignatures = 1;

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

// Returns the entries of a file. Calls in_header(line) for each comment line before the first entry. Throws
// BadBaseline if an entry has no reason, or the file cannot be read.
template <class InHeader>
std::vector<Line> entry_lines(const fs::path& path, InHeader in_header) {
  std::ifstream file(path);
  if (!file) throw BadBaseline(fmt::format("cannot read '{}'", path.string()));
  std::vector<Line> lines;
  std::string reason;
  int number = 0;
  for (std::string text; std::getline(file, text);) {
    ++number;
    if (text.empty()) {
      reason.clear();
    } else if (text.starts_with("#")) {
      const std::string comment = text.size() > 2 ? text.substr(2) : std::string();
      if (lines.empty()) in_header(Line{comment, "", path, number});
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
  for (const Line& line : entry_lines(path, [](const Line&) {})) {
    try {
      patterns.push_back({line.text, std::regex(line.text), line.reason});
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

// Reads "key: value" at the top of NAME-fails.txt. Any other comment there belongs to the first reason.
void read_header_line(const Line& line, BaselineFiles::Header& header) {
  const std::size_t colon = line.text.find(": ");
  if (colon == std::string::npos) return;
  const std::string key = line.text.substr(0, colon), value = trimmed(line.text.substr(colon + 2));
  if (key == "vendor") header.vendor = value;
  if (key == "renderer") header.renderer = value;
  if (key == "extends") header.extends = value;
  if (key == "implementation")
    for (const std::string& name : fields(value)) header.implementations.push_back(trimmed(name));
  if (key == "pass") {
    const std::optional<Pass> pass = pass_named(value);
    if (!pass)
      throw line.bad(fmt::format("unknown pass '{}'; known is '{}'", value, name_of(Pass::kReuseContext)));
    header.pass = *pass;
  }
  if (key == "depth") {
    header.depth = depth_named(value);
    if (!header.depth)
      throw line.bad(fmt::format("unknown depth '{}'; known are {}", value, fmt::join(kDepthNames, ", ")));
  }
  if (key == "version") try {
      header.version = VersionRange(value);
    } catch (const std::invalid_argument& error) {
      throw line.bad(error.what());
    }
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

// Returns the files of this name; null if there are none.
const BaselineFiles* find(const std::vector<BaselineFiles>& all, const std::string& name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& files) { return files.name == name; });
  return found == all.end() ? nullptr : &*found;
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

}  // namespace

// --- files

std::vector<std::pair<std::string, std::string>> BaselineFiles::Header::fields() const {
  std::vector<std::pair<std::string, std::string>> given = {
      {"extends", extends},
      {"vendor", vendor},
      {"renderer", renderer},
      {"version", version.text()},
      {"implementation", fmt::format("{}", fmt::join(implementations, ", "))},
      {"pass", name_of(pass)},
      {"depth", depth ? name_of(*depth) : ""}};
  std::erase_if(given, [](const auto& field) { return field.second.empty(); });
  return given;
}

BaselineFiles::Header::Specificity BaselineFiles::Header::specificity() const {
  Specificity sum;
  for (const auto& [key, value] : fields()) {
    ++sum.fields;
    sum.length += value.size();
  }
  return sum;
}

bool BaselineFiles::Header::fits(const ImplementationRecord& implementation, Pass for_pass,
                                 Depth at_depth) const {
  return for_pass == pass && depth.value_or(at_depth) == at_depth &&
         implementation.vendor.find(vendor) != std::string::npos &&
         implementation.renderer.find(renderer) != std::string::npos &&
         version.contains(implementation.version) &&
         (implementations.empty() || std::ranges::count(implementations, implementation.kind) > 0);
}

BaselineFiles BaselineFiles::read(const fs::path& folder, const std::string& name) {
  BaselineFiles files;
  files.name = name;
  const fs::path fails = folder / (name + "-fails.txt");
  const std::vector<Line> lines =
      entry_lines(fails, [&](const Line& line) { read_header_line(line, files.header); });
  const Header& header = files.header;
  for (const Line& line : lines) {
    const std::vector<std::string> parts = fields(line.text);
    if (parts.size() != 2) throw line.bad("expected 'test name,Status'");
    if (parts[1] != "Fail" && parts[1] != "Crash" && parts[1] != "Timeout" && parts[1] != "Pass")
      throw line.bad(fmt::format("the status '{}' is not Fail, Crash, Timeout or Pass", parts[1]));
    if (!files.entries.emplace(parts[0], Entry{parts[1], line.reason}).second)
      throw line.bad(fmt::format("a second entry for {}", parts[0]));
  }
  for (const auto& [test, entry] : files.entries) {
    const auto has_pattern_of = [&name_of_test = test](const auto& each) {
      return each.second.status != "Pass" && !tests_of(each.first, {name_of_test}).empty();
    };
    if (entry.status == "Pass" && header.extends.empty() &&
        std::ranges::none_of(files.entries, has_pattern_of))
      throw BadBaseline(fmt::format("{}: no pattern expects a failure of {}, so that '{},Pass' has no effect",
                                    fails.string(), test, test));
  }
  if (header.vendor.empty() && header.renderer.empty() && header.version.text().empty() &&
      (header.extends.empty() || header.implementations.empty()))
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
  for (const BaselineFiles& files : all) {
    if (files.header.extends.empty()) continue;
    const BaselineFiles* const base = find(all, files.header.extends);
    if (!base || !base->header.extends.empty())
      throw BadBaseline(fmt::format("{}: it extends '{}', which is {}",
                                    (folder / (files.name + "-fails.txt")).string(), files.header.extends,
                                    base ? "an overlay itself" : "not in this folder"));
  }
  return all;
}

BaselineFiles BaselineFiles::expanded(const std::vector<std::string>& tests) const {
  const auto is_pattern = [](const std::string& text) { return text.find('*') != std::string::npos; };
  BaselineFiles files = *this;
  for (const auto& [pattern, entry] : entries) {
    if (!is_pattern(pattern)) continue;
    const std::vector<std::string> matched = tests_of(pattern, tests);
    if (!matched.empty()) files.entries.erase(pattern);
    for (const std::string& test : matched) files.entries.emplace(test, entry);
  }
  // In a base, "Pass" takes a test out of a pattern. In an overlay, it withdraws the entry of the base.
  if (header.extends.empty())
    std::erase_if(files.entries, [](const auto& each) { return each.second.status == "Pass"; });
  for (const auto& [pattern, by_depth] : signatures) {
    if (!is_pattern(pattern)) continue;
    std::vector<std::string> matched = tests_of(pattern, tests);
    std::erase_if(matched, [&](const std::string& test) { return !files.entries.contains(test); });
    if (!matched.empty()) files.signatures.erase(pattern);
    for (const std::string& test : matched)
      for (const auto& [depth, signature] : by_depth) files.signatures[test].emplace(depth, signature);
  }
  return files;
}

BaselineFiles BaselineFiles::with_patterns(const std::vector<std::string>& tests) const {
  BaselineFiles files = *this;
  files.entries.clear();
  std::map<std::pair<std::string, std::string>, std::set<std::string>> by_entry;
  for (const auto& [test, entry] : entries) by_entry[{entry.status, entry.reason}].insert(test);
  for (const auto& [entry, names] : by_entry) {
    std::set<std::string> others(tests.begin(), tests.end());
    for (const std::string& test : names) others.erase(test);
    for (const std::string& pattern : patterns_for(names, others))
      files.entries[pattern] = {entry.first, entry.second};
  }

  files.signatures.clear();
  std::map<std::pair<std::string, std::string>, std::set<std::string>> by_signature;
  for (const auto& [test, by_depth] : signatures)
    for (const auto& [depth, signature] : by_depth) {
      if (entries.contains(test))
        by_signature[{depth, signature}].insert(test);
      else
        files.signatures[test][depth] = signature;
    }
  for (const auto& [key, names] : by_signature) {
    const auto& [depth, signature] = key;
    std::set<std::string> others;  // with another signature, or none
    for (const auto& [test, entry] : entries)
      if (!names.contains(test)) others.insert(test);
    for (const std::string& pattern : patterns_for(names, others))
      files.signatures[pattern][depth] = signature;
  }
  return files;
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

Baseline Baseline::best_fit(const std::vector<BaselineFiles>& all, const ImplementationRecord& implementation,
                            Pass pass, const std::string& chosen, Depth depth) {
  const BaselineFiles* const wanted = chosen.empty() ? nullptr : find(all, chosen);
  if (!chosen.empty() && !wanted) throw BadBaseline(fmt::format("unknown baseline '{}'", chosen));
  const bool is_chosen = wanted && wanted->header.pass == pass;
  const auto more_specific = [](const BaselineFiles* a, const BaselineFiles* b) {
    return a->header.specificity() < b->header.specificity();
  };

  const BaselineFiles* base = nullptr;
  if (is_chosen) {
    base = wanted->header.extends.empty() ? wanted : find(all, wanted->header.extends);
  } else {
    for (const BaselineFiles& files : all)
      if (files.header.extends.empty() && files.header.fits(implementation, pass, depth) &&
          (!base || more_specific(base, &files)))
        base = &files;
  }
  if (!base) return {};

  std::vector<const BaselineFiles*> overlays;
  for (const BaselineFiles& files : all)
    if (files.header.extends == base->name &&
        (files.header.fits(implementation, pass, depth) || (is_chosen && &files == wanted)))
      overlays.push_back(&files);
  std::stable_sort(overlays.begin(), overlays.end(), more_specific);
  std::vector<BaselineFiles> parts = {*base};
  for (const BaselineFiles* overlay : overlays) parts.push_back(*overlay);
  return composed(std::move(parts));
}

Baseline Baseline::composed(std::vector<BaselineFiles> parts) {
  Baseline baseline;
  for (const BaselineFiles& part : parts) {
    for (const auto& [test, entry] : part.entries) {
      if (entry.status == "Pass") {
        baseline.entries_.erase(test);
      } else {
        Entry& composed = baseline.entries_[test];
        if (composed.status != entry.status) composed.signatures.clear();  // they belong to the old status
        composed.status = entry.status;
        composed.reason = entry.reason;
      }
    }
    for (const auto& [test, by_depth] : part.signatures)
      if (const auto entry = baseline.entries_.find(test); entry != baseline.entries_.end())
        for (const auto& [depth, signature] : by_depth) entry->second.signatures[depth] = signature;
  }
  baseline.parts_ = std::move(parts);
  return baseline;
}

Baseline Baseline::with(const BaselineFiles& files) const {
  std::vector<BaselineFiles> parts = parts_;
  for (BaselineFiles& part : parts)
    if (part.name == files.name) part = files;
  if (parts.empty()) parts.push_back(files);
  return composed(std::move(parts));
}

bool Baseline::has_part(const std::string& name) const { return find(parts_, name) != nullptr; }

std::string Baseline::name() const {
  if (parts_.empty()) return {};
  std::vector<std::string> overlays;
  for (std::size_t i = 1; i < parts_.size(); ++i) overlays.push_back(parts_[i].name);
  return parts_[0].name + (overlays.empty() ? "" : fmt::format(" with {}", fmt::join(overlays, ", ")));
}

const Baseline::Pattern* Baseline::matching(std::vector<Pattern> BaselineFiles::*patterns,
                                            const std::string& test) const {
  for (const BaselineFiles& part : parts_)
    for (const Pattern& pattern : part.*patterns)
      if (std::regex_search(test, pattern.expression)) return &pattern;
  return nullptr;
}

bool Baseline::knows(const TestRecord& test, Depth depth, std::uint64_t seed) const {
  const char* status = status_of(test.verdict);
  if (!status) return false;
  if (flake(test.name)) return true;
  const auto found = entries_.find(test.name);
  if (found == entries_.end() || found->second.status != status) return false;
  const auto signature = found->second.signatures.find(name_of(depth));
  return signature == found->second.signatures.end() || seed != kSeedOfSignatures ||
         signature->second == test.signature();
}

void Baseline::apply(RunResult& result) const {
  result.baseline = name();
  for (TestRecord& test : result.tests) {
    if (test.also_in_fresh_context) continue;
    const char* status = status_of(test.verdict);
    if (const Pattern* flaky = flake(test.name)) {
      test.expected_by_baseline = status != nullptr;
      test.baseline_reason = status ? "flaky: " + flaky->reason : "";
      continue;
    }
    const auto found = entries_.find(test.name);
    if (found == entries_.end()) continue;
    const Entry& entry = found->second;
    if (!status) {
      // Only a pass contradicts the entry; a test that could not be judged does not.
      if (test.verdict == Verdict::kPass) test.baseline_reason = entry.reason;
    } else if (entry.status != status) {
      test.message = fmt::format("the baseline expects {}, not {}: {}", entry.status, status, test.message);
    } else if (!knows(test, result.depth.value_or(Depth::kFull), result.seed.value_or(kSeedOfSignatures))) {
      test.message =
          fmt::format("a known failure, but other cases fail than the baseline knows: {}", test.message);
    } else {
      test.expected_by_baseline = true;
      test.baseline_reason = entry.reason;
    }
  }
}

std::vector<std::string> Baseline::stale_entries(const std::vector<ListedTest>& tests) const {
  std::set<std::string> existing, stale;
  for (const ListedTest& test : tests) existing.insert(test.name);
  for (const BaselineFiles& part : parts_) {
    for (const auto& [test, entry] : part.entries) {
      if (!existing.contains(test)) stale.insert(test);
      if (entry.status == "Pass" && !parts_[0].entries.contains(test))
        stale.insert(
            fmt::format("{} (Pass in {}, but {} expects no failure)", test, part.name, parts_[0].name));
    }
    for (const auto& [patterns, kind] : {std::pair{&part.skips, "skips"}, {&part.flakes, "flakes"}})
      for (const Pattern& pattern : *patterns) {
        const auto matches = [&](const std::string& name) {
          return std::regex_search(name, pattern.expression);
        };
        if (std::none_of(existing.begin(), existing.end(), matches))
          stale.insert(fmt::format("{} (in the {})", pattern.text, kind));
      }
  }
  return {stale.begin(), stale.end()};
}

std::vector<std::string> Baseline::unused_signatures() const {
  std::set<std::string> unused;
  for (const BaselineFiles& part : parts_)
    for (const auto& [test, by_depth] : part.signatures)
      if (std::ranges::none_of(parts_,
                               [&name = test](const auto& any) { return any.entries.contains(name); }))
        unused.insert(test);
  return {unused.begin(), unused.end()};
}

BaselineFiles Baseline::renewed(const RunResult& result, const std::string& target,
                                const std::string& new_name, const std::vector<BaselineFiles>& all) const {
  BaselineFiles files;
  std::vector<BaselineFiles> others = parts_;
  if (parts_.empty()) {
    if (const BaselineFiles* const existing = find(all, new_name)) {
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
    files.header.vendor = implementation.vendor;
    files.header.renderer = implementation.renderer;
    files.header.version = VersionRange(implementation.version);
    files.header.implementations = {implementation.kind};
    files.header.pass = result.pass;
  } else {
    if (parts_.size() > 1 && target.empty())
      throw BadBaseline(fmt::format(
          "the baseline of this implementation is {}: choose the one to write with --baseline FOLDER/NAME",
          name()));
    const auto found = std::find_if(others.begin(), others.end(), [&](const BaselineFiles& part) {
      return target.empty() || part.name == target;
    });
    if (found == others.end())
      throw BadBaseline(fmt::format("'{}' is not part of the baseline {}", target, name()));
    files = *found;
    others.erase(found);
  }

  for (const std::string& test : unused_signatures()) files.signatures.erase(test);
  const Baseline without = composed(std::move(others));
  const std::string depth = name_of(result.depth.value_or(Depth::kFull));
  const bool with_signatures = result.seed.value_or(kSeedOfSignatures) == kSeedOfSignatures;
  for (const TestRecord& test : result.tests) {
    const std::string& test_name = test.name;
    if (test.also_in_fresh_context || flake(test_name)) continue;
    const char* const status = status_of(test.verdict);
    const auto other = without.entries().find(test_name);
    const bool expected_anyway = other != without.entries().end();
    const auto own = files.entries.find(test_name);
    const std::string reason = own == files.entries.end() ? kNotTraced : own->second.reason;
    if (!status) {
      if (test.verdict != Verdict::kPass) continue;
      files.signatures.erase(test_name);
      files.entries.erase(test_name);
      if (expected_anyway) files.entries[test_name] = {"Pass", reason};
      continue;
    }
    if (expected_anyway && other->second.status == status) {
      files.entries.erase(test_name);
    } else {
      files.entries[test_name] = {status, reason};
    }
    if (!with_signatures) continue;
    const std::string signature = test.signature();
    if (expected_anyway && other->second.signatures.contains(depth) &&
        other->second.signatures.at(depth) == signature) {
      files.signatures[test_name].erase(depth);
    } else {
      files.signatures[test_name][depth] = signature;
    }
  }
  return files;
}

}  // namespace evalcts
