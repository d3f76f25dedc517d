// evalcts coverage and evalcts explain: the requirements in words, and what the tests decide of them.
#include <fmt/format.h>

#include <fmt/ranges.h>
#include <algorithm>

#include <iostream>
#include <map>

#include "harness/cli/catalogue.h"
#include "harness/cli/commands.h"
#include "harness/cli/wrap.h"
#include "harness/runner/runner.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;

// --- coverage ----------------------------------------------------------------------------------------------

const char* const kStates[] = {"decided", "in part", "undecidable", "undecided"};

// "7. Evaluation commands: 12 decided, 3 in part, 4 undecided"
std::string counted(const std::map<std::string, int>& counts) {
  std::vector<std::string> parts;
  for (const char* state : kStates)
    if (counts.count(state)) parts.push_back(fmt::format("{} {}", counts.at(state), state));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string state_of(const Coverage& entry) {
  return entry.lacks.empty() ? entry.state : fmt::format("in part, not {}", entry.lacks);
}

std::string tests_of(const Coverage& entry) {
  if (entry.tests.empty()) return {};
  if (entry.tests.size() == 1) return entry.tests.front();
  return fmt::format("{} and {} more", entry.tests.front(), entry.tests.size() - 1);
}

void show(const std::vector<Coverage>& all, std::size_t tests) {
  std::map<std::string, std::map<std::string, int>> sections;
  std::map<std::string, int> total;
  for (const Coverage& entry : all) {
    ++sections[entry.section][entry.state];
    ++total[entry.state];
  }
  const std::size_t columns = terminal_columns();
  std::string section;
  for (const Coverage& entry : all) {
    if (entry.section != section) {
      std::cout << fmt::format("{}{}: {}\n", section.empty() ? "" : "\n", entry.section,
                               counted(sections[entry.section]));
      section = entry.section;
    }
    std::string line = fmt::format("  {:<28} {:<16} {}", entry.id, state_of(entry), tests_of(entry));
    line.erase(line.find_last_not_of(' ') + 1);
    std::cout << line << "\n";
    if (!entry.reason.empty()) std::cout << "      " << wrapped(entry.reason, columns, "      ", 6) << "\n";
  }
  std::cout << fmt::format("\n{} requirements: {}; {} tests\n", all.size(), counted(total), tests);
}

// --- explain -----------------------------------------------------------------------------------------------

void paragraph(const std::string& text, std::size_t indent = 2) {
  const std::string margin(indent, ' ');
  std::cout << margin << wrapped(text, terminal_columns(), margin, indent) << "\n";
}

// "  label: text", where there is a text.
void labelled(const std::string& label, const json& entry, const char* member) {
  const auto value = entry.find(member);
  if (value == entry.end() || !value->is_string() || value->get<std::string>().empty()) return;
  paragraph(label + ": " + value->get<std::string>());
}

const json* entry_named(const char* group, const std::string& id) {
  for (const json& entry : catalogue()[group])
    if (as_text(entry["id"]) == id) return &entry;
  return nullptr;
}

void explain_requirement(const json& requirement) {
  std::cout << requirement["id"].get<std::string>() << "\n";
  paragraph(requirement["text"]);
  labelled("Section", requirement, "section");
  labelled("Source", requirement, "source");
  labelled("Since", requirement, "since");
  labelled("How it shows", requirement, "observation");
  labelled("What it concerns", requirement, "severity");
  labelled("Level", requirement, "level");
  if (requirement.value("inferred", false))
    paragraph("Inferred: no single sentence says it; it follows from those that are named.");
  for (const Coverage& covered : coverage_of(catalogue(), list_tests(places().suite_program))) {
    if (covered.id != as_text(requirement["id"])) continue;
    std::string state = covered.state;
    if (!covered.lacks.empty()) state += fmt::format(": no test decides its {} half", covered.lacks);
    if (!covered.reason.empty()) state += ". " + covered.reason;
    paragraph("Tests: " + state);
    for (const std::string& test : covered.tests) std::cout << "    " << test << "\n";
  }
}

void list_readings(const json& entry) {
  if (!entry.contains("readings")) return;
  paragraph(
      "Readings that are accepted; 'evalcts run' records which one an implementation follows, and with "
      "--interpretation NAME=READING fails another:");
  for (const auto& [reading, meaning] : entry["readings"].items())
    paragraph(fmt::format("{}={}: {}", entry["id"].get<std::string>(), reading, meaning.get<std::string>()),
              4);
}

// Where documents disagree: which, how, and what this suite makes of it.
void explain_contradiction(const json& entry) {
  std::cout << entry["id"].get<std::string>() << ": an interpretation, since the documents do not agree\n";
  labelled("The documents", entry, "where");
  labelled("They disagree", entry, "conflict");
  labelled("What changed between them", entry, "change");
  labelled("The slip", entry, "slip");
  labelled("Taken here", entry, "take");
  labelled("Why", entry, "why");
  labelled("Section", entry, "section");
  list_readings(entry);
}

void explain_undefined(const json& entry) {
  std::cout << entry["id"].get<std::string>() << ": undefined, or left to the implementation\n";
  labelled("When", entry, "situation");
  labelled("A test may assert", entry, "may_assert");
  labelled("A test must not assert", entry, "must_not_assert");
  labelled("Section", entry, "section");
  list_readings(entry);
}

void explain_test(const json& test) {
  std::cout << fmt::format("{} ({})\n", test["name"].get<std::string>(), test["level"].get<std::string>());
  for (const std::string id : test["requirements"])
    if (const json* requirement = entry_named("requirements", id.substr(0, id.find('/')))) {
      paragraph(id + ": " + (*requirement)["text"].get<std::string>());
      paragraph("Source: " + (*requirement)["source"].get<std::string>(), 4);
    }
}

constexpr std::pair<const char*, const char*> kVerdicts[] = {
    {"pass", "every case of the test came out as the requirement demands"},
    {"fail", "at least one case contradicts citable text of the specification"},
    {"quality-warning", "conforming, but worse than good single precision; never a failure"},
    {"not-supported", "the version or extension that the rule belongs to is missing"},
    {"not-observable", "nothing that this implementation offers can show it; never a pass"},
    {"skipped", "left out on purpose, with a reason"},
    {"crash", "the process that ran the test ended by a signal or by itself"},
    {"timeout", "the test did not end within its time"},
    {"internal-error", "a fault of evalcts itself"}};

}  // namespace

int coverage(bool as_json, bool complete) {
  const json tests = list_tests(places().suite_program);
  const std::vector<Coverage> all = coverage_of(catalogue(), tests);
  const std::vector<std::string> problems = lint(catalogue(), tests);
  if (as_json) {
    json rows = json::array();
    for (const Coverage& entry : all)
      rows.push_back({{"id", entry.id},
                      {"section", entry.section},
                      {"state", entry.state},
                      {"lacks", entry.lacks},
                      {"reason", entry.reason},
                      {"tests", entry.tests}});
    std::cout << json{{"requirements", rows}, {"problems", problems}}.dump(1) << "\n";
  } else {
    show(all, tests["tests"].size());
  }
  for (const std::string& problem : problems) std::cerr << "evalcts: " << problem << "\n";
  if (!problems.empty()) return kOwnFault;
  const auto is_open = [](const Coverage& entry) {
    return entry.state == "undecided" || (entry.state == "in part" && entry.reason.empty());
  };
  return complete && std::any_of(all.begin(), all.end(), is_open) ? kUnexpected : kNothingUnexpected;
}

int explain(const std::string& name) {
  // A half, "ID/1-D", is explained with its requirement.
  const std::size_t slash = name.rfind('/');
  const bool is_half = name.ends_with("/1-D") || name.ends_with("/2-D");
  if (const json* entry = entry_named("requirements", is_half ? name.substr(0, slash) : name)) {
    explain_requirement(*entry);
    return kNothingUnexpected;
  }
  if (const json* entry = entry_named("contradictions", name)) {
    explain_contradiction(*entry);
    return kNothingUnexpected;
  }
  if (const json* entry = entry_named("undefined", name)) {
    explain_undefined(*entry);
    return kNothingUnexpected;
  }
  const json tests = list_tests(places().suite_program);
  for (const json& test : tests["tests"])
    if (as_text(test["name"]) == name) {
      explain_test(test);
      return kNothingUnexpected;
    }
  for (const auto& [verdict, meaning] : kVerdicts)
    if (name == verdict) {
      std::cout << fmt::format("{}: {}\n", verdict, meaning);
      return kNothingUnexpected;
    }
  std::cerr << fmt::format(
      "evalcts: '{}' is no requirement, interpretation, test or verdict; see 'evalcts list'\n", name);
  return kWrongUse;
}

}  // namespace evalcts::cli
