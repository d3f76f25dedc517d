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
  std::ifstream file(fails);
  if (!file) throw BadBaseline(fmt::format("cannot read '{}'", fails.string()));
  std::string reason;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const auto bad = [&](const std::string& why) {
      return BadBaseline(fmt::format("{}:{}: {}", fails.string(), number, why));
    };
    if (line.empty()) {
      reason.clear();
      continue;
    }
    if (line.starts_with("#")) {
      const std::string text = line.size() > 2 ? line.substr(2) : std::string();
      for (const auto& [key, value] : {std::pair{"vendor: ", &baseline.vendor_},
                                       {"renderer: ", &baseline.renderer_},
                                       {"version: ", &baseline.version_}})
        if (text.starts_with(key)) *value = text.substr(std::string(key).size());
      reason += (reason.empty() ? "" : " ") + text;
      continue;
    }
    const std::vector<std::string> parts = fields(line);
    if (parts.size() != 2) throw bad("expected 'test name,Status'");
    if (parts[1] != "Fail" && parts[1] != "Crash" && parts[1] != "Timeout")
      throw bad(fmt::format("the status '{}' is none of Fail, Crash, Timeout", parts[1]));
    if (reason.empty()) throw bad("an entry needs its reason in a comment above it");
    if (!baseline.entries_.emplace(parts[0], Entry{parts[1], reason, {}}).second)
      throw bad(fmt::format("a second entry for {}", parts[0]));
  }
  if (baseline.vendor_.empty() || baseline.renderer_.empty() || baseline.version_.empty())
    throw BadBaseline(
        fmt::format("{}: the lines '# vendor: ', '# renderer: ' and '# version: ' must say what it is for",
                    fails.string()));

  const fs::path signatures = folder / (name + "-signatures.txt");
  if (!fs::exists(signatures)) return baseline;
  std::ifstream signature_file(signatures);
  number = 0;
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

bool Baseline::fits(const json& implementation) const {
  const auto part_of = [&](const std::string& part, const char* member) {
    return text_of(implementation, member).find(part) != std::string::npos;
  };
  return part_of(vendor_, "vendor") && part_of(renderer_, "renderer") && part_of(version_, "version");
}

Baseline Baseline::find(const fs::path& folder, const json& implementation) {
  const std::string ending = "-fails.txt";
  std::set<std::string> names;  // in a fixed order
  if (fs::is_directory(folder))
    for (const auto& file : fs::directory_iterator(folder)) {
      const std::string name = file.path().filename().string();
      if (name.ends_with(ending)) names.insert(name.substr(0, name.size() - ending.size()));
    }
  for (const std::string& name : names) {
    Baseline baseline = read(folder, name);
    if (baseline.fits(implementation)) return baseline;
  }
  return {};
}

void Baseline::apply(json& result) const {
  if (!name_.empty()) result["baseline"] = name_;
  for (json& test : result["tests"]) {
    const auto found = entries_.find(test["name"]);
    if (found == entries_.end()) continue;
    const Entry& entry = found->second;
    const char* status = status_of(test["verdict"]);
    if (!status) {
      // Only a pass is news: what could not be judged says nothing about the entry.
      if (test["verdict"] == "pass") test["baseline_reason"] = entry.reason;
      continue;
    }
    if (entry.status != status) {
      test["message"] =
          fmt::format("the baseline expects {}, not {}: {}", entry.status, status, text_of(test, "message"));
      continue;
    }
    const auto signature = entry.signatures.find(text_of(result, "depth"));
    const bool seed_known = result.value("seed", 1) == 1;  // signatures belong to the seed 1
    if (signature != entry.signatures.end() && seed_known && signature->second != signature_of(test)) {
      test["message"] = fmt::format("a known failure, but other cases fail than the baseline knows: {}",
                                    text_of(test, "message"));
      continue;
    }
    test["expected_by_baseline"] = true;
    test["baseline_reason"] = entry.reason;
  }
}

std::vector<std::string> Baseline::stale_entries(const json& tests) const {
  std::set<std::string> existing;
  for (const json& test : tests.at("tests")) existing.insert(test.at("name").get<std::string>());
  std::vector<std::string> stale;
  for (const auto& [name, entry] : entries_)
    if (!existing.count(name)) stale.push_back(name);
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
  }
  for (const json& test : result["tests"]) {
    const std::string test_name = test["name"];
    const char* status = status_of(test["verdict"]);
    if (!status) {
      if (test["verdict"] == "pass") renewed.entries_.erase(test_name);
      continue;
    }
    Entry& entry = renewed.entries_[test_name];
    entry.status = status;
    if (entry.reason.empty()) entry.reason = kNotTraced;
    entry.signatures[text_of(result, "depth")] = signature_of(test);
  }
  return renewed;
}

void Baseline::write(const fs::path& folder) const {
  std::string fails =
      fmt::format("# vendor: {}\n# renderer: {}\n# version: {}\n", vendor_, renderer_, version_);
  std::string signatures;
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
