#include "harness/runner/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "harness/runner/runner.h"

namespace evalcts {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kNotTraced = "not traced to a clause yet";
constexpr std::uint32_t kSeedOfSignatures = 1;

const char* status_of(const std::string& verdict) {
  return verdict == "fail"      ? "Fail"
         : verdict == "crash"   ? "Crash"
         : verdict == "timeout" ? "Timeout"
                                : nullptr;
}

std::string text_of(const json& object, const char* member) {
  return object.contains(member) && object[member].is_string() ? object[member].get<std::string>()
                                                               : std::string();
}

// The lines of a file that are entries, each with the comment above it as its reason. Throws BadBaseline
// where there is none, or where the file cannot be read.
struct Line {
  std::string text, reason;
  fs::path file;
  int number;

  BadBaseline bad(const std::string& why) const {
    return BadBaseline(fmt::format("{}:{}: {}", file.string(), number, why));
  }
};

// `in_header(text)` gets each comment line before the first entry.
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

std::vector<Baseline::Pattern> read_patterns(const fs::path& path) {
  std::vector<Baseline::Pattern> patterns;
  if (!fs::exists(path)) return patterns;
  for (const Line& line : entry_lines(path, [](const Line&) {})) {
    try {
      patterns.push_back({line.text, std::regex(line.text), line.reason});
    } catch (const std::regex_error& error) {
      throw line.bad(fmt::format("'{}' is no regular expression: {}", line.text, error.what()));
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

}  // namespace

std::string signature_of(const json& test) {
  std::vector<std::string> identities;
  if (test.contains("mismatches")) identities = test["mismatches"].get<std::vector<std::string>>();
  std::sort(identities.begin(), identities.end());
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const std::string& identity : identities)
    for (const char c : identity + '\n') hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return fmt::format("{}-{:016x}", identities.size(), hash);
}

Baseline Baseline::read(const fs::path& folder, const std::string& name) {
  Baseline baseline;
  baseline.name_ = name;
  const fs::path fails = folder / (name + "-fails.txt");
  const auto read_header = [&](const Line& line) {
    for (const auto& [key, value] : {std::pair{"vendor: ", &baseline.vendor_},
                                     {"renderer: ", &baseline.renderer_},
                                     {"version: ", &baseline.version_},
                                     {"implementation: ", &baseline.implementation_},
                                     {"pass: ", &baseline.pass_}})
      if (line.text.starts_with(key)) *value = line.text.substr(std::string(key).size());
    if (!baseline.pass_.empty() && baseline.pass_ != kReuseContext)
      throw line.bad(fmt::format("there is no pass '{}', only '{}'", baseline.pass_, kReuseContext));
  };
  for (const Line& line : entry_lines(fails, read_header)) {
    const std::vector<std::string> parts = fields(line.text);
    if (parts.size() != 2) throw line.bad("expected 'test name,Status'");
    if (parts[1] != "Fail" && parts[1] != "Crash" && parts[1] != "Timeout")
      throw line.bad(fmt::format("the status '{}' is none of Fail, Crash, Timeout", parts[1]));
    if (!baseline.entries_.emplace(parts[0], Entry{parts[1], line.reason, {}}).second)
      throw line.bad(fmt::format("a second entry for {}", parts[0]));
  }
  if (baseline.vendor_.empty() || baseline.renderer_.empty() || baseline.version_.empty())
    throw BadBaseline(
        fmt::format("{}: the lines '# vendor: ', '# renderer: ' and '# version: ' must say what it is for",
                    fails.string()));
  baseline.skips_ = read_patterns(folder / (name + "-skips.txt"));
  baseline.flakes_ = read_patterns(folder / (name + "-flakes.txt"));

  const fs::path signatures = folder / (name + "-signatures.txt");
  if (!fs::exists(signatures)) return baseline;
  std::ifstream signature_file(signatures);
  int number = 0;
  for (std::string line; std::getline(signature_file, line);) {
    ++number;
    if (line.empty() || line.starts_with("#")) continue;
    const std::vector<std::string> parts = fields(line);
    const auto entry = parts.size() == 3 ? baseline.entries_.find(parts[0]) : baseline.entries_.end();
    if (entry == baseline.entries_.end())
      throw BadBaseline(fmt::format("{}:{}: expected 'test name,depth,signature' of a test in the other file",
                                    signatures.string(), number));
    entry->second.signatures[parts[1]] = parts[2];
  }
  return baseline;
}

std::vector<Baseline> Baseline::read_all(const fs::path& folder) {
  std::set<std::string> names, of_others;  // in a fixed order
  if (fs::is_directory(folder))
    for (const auto& file : fs::directory_iterator(folder)) {
      const std::string name = file.path().filename().string();
      for (const std::string ending : {"-fails.txt", "-signatures.txt", "-skips.txt", "-flakes.txt"})
        if (name.ends_with(ending))
          (ending == "-fails.txt" ? names : of_others).insert(name.substr(0, name.size() - ending.size()));
    }
  for (const std::string& name : of_others)
    if (!names.count(name))
      throw BadBaseline(
          fmt::format("'{}' is missing (it may hold nothing but its header): it says what the "
                      "other files of that name are for",
                      (folder / (name + "-fails.txt")).string()));
  std::vector<Baseline> baselines;
  for (const std::string& name : names) baselines.push_back(read(folder, name));
  return baselines;
}

bool Baseline::fits(const json& implementation, const std::string& pass) const {
  const auto part_of = [&](const std::string& part, const char* member) {
    return text_of(implementation, member).find(part) != std::string::npos;
  };
  return pass == pass_ && (implementation_.empty() || implementation_ == text_of(implementation, "kind")) &&
         part_of(vendor_, "vendor") && part_of(renderer_, "renderer") && part_of(version_, "version");
}

std::size_t Baseline::specificity() const {
  return vendor_.size() + renderer_.size() + version_.size() + implementation_.size();
}

Baseline Baseline::best_fit(const std::vector<Baseline>& baselines, const json& implementation,
                            const std::string& pass) {
  const Baseline* best = nullptr;
  for (const Baseline& baseline : baselines)
    if (baseline.fits(implementation, pass) && (!best || baseline.specificity() > best->specificity()))
      best = &baseline;
  return best ? *best : Baseline();
}

const Baseline::Pattern* Baseline::matching(const std::vector<Pattern>& patterns, const std::string& test) {
  for (const Pattern& pattern : patterns)
    if (std::regex_search(test, pattern.expression)) return &pattern;
  return nullptr;
}

bool Baseline::knows(const json& test, const std::string& depth, std::uint32_t seed) const {
  const char* status = status_of(test["verdict"]);
  if (!status) return false;
  if (flake(test["name"])) return true;
  const auto found = entries_.find(test["name"]);
  if (found == entries_.end() || found->second.status != status) return false;
  const auto signature = found->second.signatures.find(depth);
  return signature == found->second.signatures.end() || seed != kSeedOfSignatures ||
         signature->second == signature_of(test);
}

void Baseline::apply(json& result) const {
  if (!name_.empty()) result["baseline"] = name_;
  for (json& test : result["tests"]) {
    if (test.value("also_in_fresh_context", false)) continue;
    const char* status = status_of(test["verdict"]);
    if (const Pattern* flaky = flake(test["name"])) {
      test["expected_by_baseline"] = status != nullptr;
      test["baseline_reason"] = status ? "flaky: " + flaky->reason : "";
      continue;
    }
    const auto found = entries_.find(test["name"]);
    if (found == entries_.end()) continue;
    const Entry& entry = found->second;
    if (!status) {
      // Only a pass is news: what could not be judged says nothing about the entry.
      if (as_text(test["verdict"]) == "pass") test["baseline_reason"] = entry.reason;
    } else if (entry.status != status) {
      test["message"] =
          fmt::format("the baseline expects {}, not {}: {}", entry.status, status, text_of(test, "message"));
    } else if (!knows(test, text_of(result, "depth"), result.value("seed", kSeedOfSignatures))) {
      test["message"] = fmt::format("a known failure, but other cases fail than the baseline knows: {}",
                                    text_of(test, "message"));
    } else {
      test["expected_by_baseline"] = true;
      test["baseline_reason"] = entry.reason;
    }
  }
}

std::vector<std::string> Baseline::stale_entries(const json& tests) const {
  std::set<std::string> existing;
  for (const json& test : tests.at("tests")) existing.insert(test.at("name").get<std::string>());
  std::vector<std::string> stale;
  for (const auto& [name, entry] : entries_)
    if (!existing.count(name)) stale.push_back(name);
  for (const auto& [patterns, kind] : {std::pair{&skips_, "skips"}, {&flakes_, "flakes"}})
    for (const Pattern& pattern : *patterns) {
      const auto matches = [&](const std::string& name) {
        return std::regex_search(name, pattern.expression);
      };
      if (std::none_of(existing.begin(), existing.end(), matches))
        stale.push_back(fmt::format("{} (in the {})", pattern.text, kind));
    }
  return stale;
}

Baseline Baseline::renewed(const json& result, const std::string& name) const {
  Baseline renewed = *this;
  renewed.name_ = name_.empty() ? name : name_;
  const json& implementation = result["implementation"];
  if (vendor_.empty()) {
    renewed.vendor_ = text_of(implementation, "vendor");
    renewed.renderer_ = text_of(implementation, "renderer");
    renewed.version_ = text_of(implementation, "version");
    renewed.implementation_ = text_of(implementation, "kind");
    renewed.pass_ = text_of(result, "pass");
  }
  const bool with_signatures = result.value("seed", kSeedOfSignatures) == kSeedOfSignatures;
  for (const json& test : result["tests"]) {
    const std::string test_name = test["name"];
    if (test.value("also_in_fresh_context", false) || flake(test_name)) continue;
    const char* status = status_of(test["verdict"]);
    if (!status) {
      if (as_text(test["verdict"]) == "pass") renewed.entries_.erase(test_name);
      continue;
    }
    Entry& entry = renewed.entries_[test_name];
    entry.status = status;
    if (entry.reason.empty()) entry.reason = kNotTraced;
    if (with_signatures) entry.signatures[text_of(result, "depth")] = signature_of(test);
  }
  return renewed;
}

void Baseline::write(const fs::path& folder) const {
  std::string fails =
      fmt::format("# vendor: {}\n# renderer: {}\n# version: {}\n", vendor_, renderer_, version_);
  if (!implementation_.empty()) fails += fmt::format("# implementation: {}\n", implementation_);
  if (!pass_.empty()) fails += fmt::format("# pass: {}\n", pass_);
  std::string signatures = fmt::format(
      "# test name,depth,signature: the number of mismatches and a hash of their identities. A signature\n"
      "# belongs to its depth and to seed {}: runs with other seeds are not compared with it.\n\n",
      kSeedOfSignatures);
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const auto& [test, entry] : entries_) by_reason[entry.reason].push_back(test);
  for (const auto& [reason, tests] : by_reason) {
    // Wrapped at 100 columns; reading joins the lines again.
    std::string line = "#";
    fails += "\n";
    std::istringstream words(reason);
    for (std::string word; words >> word;) {
      if (line.size() + word.size() > 99) {
        fails += line + "\n";
        line = "#";
      }
      line += " " + word;
    }
    fails += line + "\n";
    for (const std::string& test : tests) {
      const Entry& entry = entries_.at(test);
      fails += fmt::format("{},{}\n", test, entry.status);
      for (const auto& [depth, signature] : entry.signatures)
        signatures += fmt::format("{},{},{}\n", test, depth, signature);
    }
  }
  fs::create_directories(folder);
  write_atomically(folder / (name_ + "-fails.txt"), fails);
  write_atomically(folder / (name_ + "-signatures.txt"), signatures);
}

}  // namespace evalcts
