// Writes the data of the page as JSON, with each text stored once.
#include "data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <evalcts/results/documents.h>
#include <evalcts/results/json.h>
#include <evalcts/results/known_bugs.h>
#include "text.h"
#include "view.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;
using Number = std::uint32_t;
using Numbers = std::vector<Number>;

// Numbers items in the order of first appearance; equal items have the same number.
template <class Item>
class Numbering {
 public:
  Number number_of(const Item& item) {
    const auto [it, inserted] = numbers_.emplace(item, static_cast<Number>(items_.size()));
    if (inserted) items_.push_back(&it->first);
    return it->second;
  }
  json as_json() const {
    json out = json::array();
    for (const Item* item : items_) out.push_back(*item);
    return out;
  }

 private:
  std::map<Item, Number> numbers_;
  std::vector<const Item*> items_;
};

// Bits that a record has in addition to its verdict.
constexpr Number kUnexpected = 1, kExpectedFailure = 2, kFlake = 4;

Number flags_of(const TestRecord& test) {
  return (test.is_unexpected() ? kUnexpected : 0) | (test.is_expected_failure() ? kExpectedFailure : 0) |
         (test.flake ? kFlake : 0);
}

std::string baseline_sentence(const TestRecord& test) {
  const std::string reason = test.baseline_reason.empty() ? "no reason given" : test.baseline_reason;
  if (test.is_expected_failure()) return "Expected by the baseline: " + reason;
  if (test.baseline_reason.empty()) return {};
  return (test.is_unexpected() ? "Not what the baseline expects: " : "Baseline: ") + reason;
}

// Returns "2 of 12 cases failed, 1 recorded, seed 1" or the like. It has no times, because these would make
// equal records differ.
std::string facts_of(const TestRecord& test) {
  std::vector<std::string> facts;
  if (test.failed_cases.value_or(0) && test.cases) {
    facts.push_back(fmt::format("{} of {} failed", *test.failed_cases, count(*test.cases, "case")));
  } else if (test.cases.value_or(0)) {
    facts.push_back(count(*test.cases, "case"));
  }
  if (test.failed_cases && *test.failed_cases > test.failures.size() && !test.failures.empty())
    facts.push_back(fmt::format("{} recorded", test.failures.size()));
  if (!test.unobserved.empty()) facts.push_back("not observed: " + test.unobserved);
  if (test.seed) facts.push_back(fmt::format("seed {}", *test.seed));
  return join(facts, ", ");
}

// Returns "480 values, largest error 3.5 ULP, condition-aware 1.25; not correctly rounded: 20 % (96); ...";
// empty if the test measured no accuracy.
std::string accuracy_of(const TestRecord& test) {
  if (!test.accuracy) return {};
  const Accuracy& accuracy = *test.accuracy;
  std::string out = count(accuracy.values, "value");
  const std::string far = distance(accuracy.ulp.error, accuracy.condition_aware.error);
  if (!far.empty()) out += ", largest error " + far;
  out += "; not correctly rounded: " + view::share(accuracy);
  if (!accuracy.ulp.where.empty()) out += "; worst input: " + accuracy.ulp.where;
  return out;
}

// Returns the command with U+0000 in place of the test's name, so that all tests share one string.
std::string template_of(std::string command, const std::string& name) {
  for (std::size_t at = command.find(name); at != std::string::npos && !name.empty();
       at = command.find(name, at + 1))
    command.replace(at, name.size(), 1, '\0');
  return command;
}

// Returns the value as JSON text without "<", so that it cannot end a script element or begin a comment
// there.
std::string script_safe(const json& value) {
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

class Writer {
 public:
  Writer() { strings_.number_of({}); }  // 0 is the empty text

  void add_requirement(const std::string& id) {
    requirements_.emplace(id, static_cast<Number>(requirements_.size()));
  }
  Number requirement(const RequirementId& id) const { return requirements_.at(id.text()); }

  Number text(const std::string& text) { return strings_.number_of(text); }
  Number plain(const std::string& text) { return this->text(in_plain_numbers(text)); }

  // Returns the numbers of the documents that the source names.
  Numbers documents(const std::string& source) {
    Numbers out;
    for (const Document& document : documents_in(source))
      out.push_back(documents_.number_of(json::array({document.name, document.address})));
    return out;
  }

  // Returns "GL_LINE_STRIP x y z x y z ...", one line for each primitive.
  static std::string plotted(const std::vector<PlottedPrimitive>& primitives) {
    std::string out;
    for (const PlottedPrimitive& primitive : primitives) {
      out += out.empty() ? "" : "\n";
      out += primitive.mode;
      for (const auto& position : primitive.positions)
        for (const float coordinate : position) out += fmt::format(" {:.5g}", coordinate);
    }
    return out;
  }
  // Returns a line "x y width height expected captured" for each rectangle.
  static std::string plotted(const std::vector<PlottedPixels>& pixels) {
    std::string out;
    for (const PlottedPixels& one : pixels)
      out += fmt::format("{}{} {} {} {} {} {}", out.empty() ? "" : "\n", one.x, one.y, one.width, one.height,
                         one.expected, one.captured);
    return out;
  }
  // Returns the expected primitives (null if a rule decides), the captured ones, 1 if there are more, and the
  // pixels; an empty array without a plot.
  json plot_of(const Failure& failure) {
    if (!failure.plot) return json::array();
    const Plot& plot = *failure.plot;
    return {plot.expected ? json(plotted(*plot.expected)) : json(), plotted(plot.captured),
            plot.is_cut ? 1 : 0, plotted(plot.pixels)};
  }

  Number failure(const Failure& failure) {
    Numbers lines;
    for (const std::string& line : failure.calls) lines.push_back(text(line));
    return failures_.number_of({plain(failure.case_identity), plain(failure.message), plain(failure.what),
                                plain(failure.expected), plain(failure.captured), plain(failure.exact),
                                text(failure.capture), text(distance(failure.ulp, failure.condition_aware)),
                                calls_.number_of(lines), plots_.number_of(plot_of(failure))});
  }

  Number record(const TestRecord& test) {
    Numbers violated;
    for (const RequirementId& id : test.blamed()) violated.push_back(requirement(id));
    Numbers out{static_cast<Number>(test.verdict),
                static_cast<Number>(test.severity()),
                flags_of(test),
                plain(test.message),
                text(baseline_sentence(test)),
                text(facts_of(test)),
                plain(accuracy_of(test)),
                violations_.number_of(violated)};
    for (const Failure& one : test.failures) out.push_back(failure(one));
    return records_.number_of(out);
  }

  Number commands(const TestRecord& test) {
    return commands_.number_of({text(template_of(test.rerun, test.name)),
                                text(template_of(test.debug, test.name)),
                                text(template_of(test.reproducer, test.name))});
  }

  void add_tables(json& out) const {
    out["strings"] = strings_.as_json();
    out["calls"] = calls_.as_json();
    out["failures"] = failures_.as_json();
    out["plots"] = plots_.as_json();
    out["violations"] = violations_.as_json();
    out["records"] = records_.as_json();
    out["commands"] = commands_.as_json();
    out["documents"] = documents_.as_json();
  }

 private:
  Numbering<std::string> strings_;
  Numbering<json> plots_, documents_;
  Numbering<Numbers> calls_, failures_, violations_, records_, commands_;
  std::map<std::string, Number> requirements_;
};

// Returns the requirements that the tests name or violate, and those of the bugs, in the order of the
// catalogue, then those that the catalogue does not have.
std::vector<std::string> requirements_of(const std::vector<Row>& rows, const std::vector<BugRow>& bugs,
                                         const Catalogue& catalogue) {
  std::set<std::pair<std::size_t, std::string>> ordered;
  const auto add = [&](const RequirementId& id) {
    const Requirement* known = catalogue.find(id);
    ordered.emplace(known ? known->place : std::numeric_limits<std::size_t>::max(), id.text());
  };
  for (const BugRow& row : bugs)
    for (const RequirementId& id : row.bug.requirements) add(id);
  for (const Row& row : rows)
    for (const TestRecord* test : row.outcomes) {
      if (!test) continue;
      for (const RequirementId& id : test->requirements) add(id);
      for (const RequirementId& id : test->blamed()) add(id);
    }
  std::vector<std::string> out;
  for (const auto& [place, id] : ordered) out.push_back(id);
  return out;
}

// Returns the bug; its "found" has for each column with the bug: the column, 1 if the bug is known there, and
// the tests.
json bug_as_json(const BugRow& row, const std::map<std::string, Number>& test_numbers, Writer& writer) {
  const Bug& bug = row.bug;
  json requirements = json::array(), found = json::array();
  for (const RequirementId& id : bug.requirements) requirements.push_back(id.text());
  for (std::size_t column = 0; column < row.found.size(); ++column) {
    if (!row.found[column]) continue;
    json of_column = {column, row.found[column]->known.empty() ? 0 : 1};
    for (const std::string& test : row.found[column]->tests)
      if (const auto number = test_numbers.find(test); number != test_numbers.end())
        of_column.push_back(number->second);
    found.push_back(std::move(of_column));
  }
  const KnownBug* const registered = find_known_bug(bug.known);
  const KnownBug known = registered ? *registered : KnownBug{};
  return {{"id", bug.id},
          {"title", in_plain_numbers(bug.title)},
          {"requirements", requirements},
          {"clause", bug.clause},
          {"documents", writer.documents(bug.clause)},
          {"affects", registered ? known.affects.text() : ""},
          {"cause", known.cause},
          {"isSuspected", known.suspected},
          {"realPrograms", known.real_programs},
          {"verified", known.verified},
          {"example", known.example},
          {"level", static_cast<int>(bug.level)},
          {"verdict", static_cast<int>(bug.verdict)},
          {"failure", writer.failure(bug.failure)},
          {"whyNotReduced", bug.why_not_reduced},
          {"outside", bug.outside_evaluators},
          {"breaksPrograms", bug.breaks_real_programs},
          {"known", bug.known},
          {"knownIn", bug.known_in},
          {"found", found}};
}

json comparison_as_json(const Comparison& comparison, const std::vector<Column>& columns,
                        const std::map<std::string, Number>& test_numbers, Writer& writer) {
  const auto number_of = [&columns](const RunResult* record) {
    return std::find_if(columns.begin(), columns.end(),
                        [record](const Column& column) { return &column.record == record; }) -
           columns.begin();
  };
  json changes = json::array();  // three items for each change: test, kind, further mismatch
  for (const Change& change : comparison.changes) {
    const bool both = change.before && change.now;
    changes.push_back(test_numbers.at((change.now ? change.now : change.before)->name));
    changes.push_back(static_cast<int>(change.kind));
    changes.push_back(writer.text(both && change.kind == ChangeKind::kRegression &&
                                          change.now->verdict == change.before->verdict
                                      ? one_line(further_mismatch(*change.before, *change.now))
                                      : std::string()));
  }
  return {{"from", number_of(comparison.before)},
          {"to", number_of(comparison.now)},
          {"headline", comparison.headline()},
          {"caveats", comparison.caveats},
          {"changes", changes}};
}

}  // namespace

std::string page_data(const std::vector<Column>& columns, std::size_t earlier, const std::vector<Row>& rows,
                      const Catalogue& catalogue, const std::vector<Comparison>& comparisons,
                      const Comparisons& since, const std::string& sources) {
  Writer writer;
  json out;
  const std::vector<BugRow> bug_rows = read_bugs(columns);

  json& verdicts = out["verdicts"] = json::array();
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    const VerdictText& verdict = text_of(static_cast<Verdict>(i));
    verdicts.push_back({verdict.word, verdict.label, verdict.symbol});
  }
  json& levels = out["levels"] = json::array();
  for (const Level level : {Level::kQuality, Level::kInterpretation, Level::kMust})
    levels.push_back(name_of(level));
  json& kinds = out["changeKinds"] = json::array();
  for (std::size_t i = 0; i < kChangeKinds; ++i) {
    const ChangeText& kind = text_of(static_cast<ChangeKind>(i));
    kinds.push_back({kind.one, kind.several, kind.difference, kind.differences});
  }

  json& labels = out["columns"] = json::array();
  for (const Column& column : columns) labels.push_back(column.label);
  out["earlier"] = earlier;
  out["sources"] = sources;

  json &requirements = out["requirements"] = json::array(), &documents = out["documentsOf"] = json::array();
  for (const std::string& id : requirements_of(rows, bug_rows, catalogue)) {
    const Requirement* known = catalogue.find(id);
    const Requirement requirement = known ? *known : Requirement{};
    writer.add_requirement(id);
    requirements.push_back({writer.text(id), writer.text(requirement.section), writer.text(requirement.text),
                            writer.text(requirement.source), writer.text(requirement.since)});
    documents.push_back(writer.documents(requirement.source));
  }

  json &tests = out["tests"] = json::array(), &outcomes = out["outcomes"] = json::array(),
       &commands = out["commandsOf"] = json::array();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    outcomes.push_back(json::array());
    commands.push_back(json::array());
  }
  std::map<std::string, Number> test_numbers;
  for (const Row& row : rows) {
    test_numbers.emplace(row.name, static_cast<Number>(tests.size()));
    Numbers test{writer.text(row.name), static_cast<Number>(row.worst().level),
                 writer.text(row.worst().source)};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const TestRecord* outcome = row.outcomes[i];
      outcomes[i].push_back(outcome ? json(writer.record(*outcome)) : json(-1));
      commands[i].push_back(outcome ? json(writer.commands(*outcome)) : json(-1));
      if (!outcome) continue;
      // Records of different versions of the suite may name different requirements.
      for (const RequirementId& id : outcome->requirements) {
        const Number number = writer.requirement(id);
        if (std::find(test.begin() + 3, test.end(), number) == test.end()) test.push_back(number);
      }
    }
    tests.push_back(test);
  }

  json& bugs = out["bugs"] = json::array();
  for (const BugRow& row : bug_rows) bugs.push_back(bug_as_json(row, test_numbers, writer));
  json& notes = out["bugNotes"] = json::array();
  for (const Column& column : columns) notes.push_back(column.record.bugs_note);

  json &changes = out["comparisons"] = json::array(), &pairs = out["since"] = json::array();
  for (const Comparison& comparison : comparisons) {
    const auto is_same = [&comparison](const Comparison& pair) {
      return pair.before == comparison.before && pair.now == comparison.now;
    };
    if (std::any_of(since.pairs.begin(), since.pairs.end(), is_same)) pairs.push_back(changes.size());
    changes.push_back(comparison_as_json(comparison, columns, test_numbers, writer));
  }

  writer.add_tables(out);
  return script_safe(out);
}

}  // namespace evalcts::reports
