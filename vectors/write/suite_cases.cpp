// Makes files of sequences from the cases of the suite and from recorded programs.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include <evalcts/gl/roles.h>
#include <evalcts/vectors/write.h>
#include "sequences.h"
#include "suite_cases.h"

namespace evalcts::vectors {
namespace {

// Sizes of JSON text. The cases of a test function share kMostBytesOfFunction: the first case of each test
// has its share of it, at least kLeastBytesOfCase; second and further cases follow until it is used up. First
// cases may take more, because a case is not cut off before it shows something, but not twice as much.
constexpr std::size_t kMostBytesOfFunction = 30'000, kLeastBytesOfCase = 5'000;

// Returns the flags by which a reader skips a case, with their meanings.
std::vector<std::pair<std::string, std::string>> flags_of(const gl::Case& script) {
  std::int64_t order = 0;
  bool asks_by_size = false, uses_units = false;
  for (const gl::Command& command : script.commands()) {
    order = std::max(order, gl::largest_order(command));
    const std::string stem = gl::stem_of(command.entry);
    asks_by_size = asks_by_size || stem == "GetnMap";
    if (stem == "ActiveTexture" || stem == "MultiTexCoord") {
      const auto unit = std::get<std::int64_t>(command.arguments[0]) - GL_TEXTURE0;
      uses_units = uses_units || (unit > 1 && unit < 8);
    }
  }
  std::vector<std::pair<std::string, std::string>> flags;
  if (order > 64) flags.emplace_back("max-order-64", "only where MAX_EVAL_ORDER is 64 or less");
  if (order > 8)
    flags.emplace_back("order-above-8", "where MAX_EVAL_ORDER is at least the order of each map");
  if (uses_units) flags.emplace_back("texture-units-8", "only where there are 8 texture units or more");
  if (asks_by_size) flags.emplace_back("robustness", "needs GetnMap (ARB_robustness or GL 4.5)");
  return flags;
}

std::string function_of(const std::string& test) { return test.substr(0, test.find('/')); }

std::string kind_of(const std::string& test) {
  const std::string suite = test.substr(0, test.find('.'));
  return suite.ends_with("Errors") ? "errors" : suite.starts_with("Get") ? "get_map" : "state";
}

struct Sequence {
  const SuiteCase* suite_case;
  int number;  // of the case among those of its test, from 1
  gl::Case script;
  Json content;
};

// Returns the cases of the kind that are exported, by test function, in the order of the suite.
std::map<std::string, std::vector<Sequence>> exported(const std::string& kind,
                                                      const std::vector<SuiteCase>& cases) {
  std::map<std::string, std::vector<const SuiteCase*>> by_function;
  for (const SuiteCase& each : cases)
    if (kind_of(each.test) == kind) by_function[function_of(each.test)].push_back(&each);
  std::map<std::string, int> counts;
  std::map<const SuiteCase*, int> numbers;
  for (const SuiteCase& each : cases) numbers[&each] = ++counts[each.test];

  std::map<std::string, std::vector<Sequence>> all;
  for (auto& [function, of_function] : by_function) {
    std::ranges::stable_sort(of_function, {}, [&](const SuiteCase* each) { return numbers[each]; });
    const auto tests = static_cast<std::size_t>(
        std::ranges::count_if(of_function, [&](const SuiteCase* each) { return numbers[each] == 1; }));
    const std::size_t share =
        std::max(kMostBytesOfFunction / std::max<std::size_t>(tests, 1), kLeastBytesOfCase);
    std::set<std::string> texts;
    std::size_t bytes = 0;
    for (const SuiteCase* const each : of_function) {
      if (bytes >= (numbers[each] == 1 ? 2 : 1) * kMostBytesOfFunction) break;
      try {
        gl::Case script = cut_off(each->script, share);
        Json content = sequence(script);
        const std::string text = content.dump();
        if (!texts.insert(text).second) continue;
        bytes += text.size();
        all[function].push_back({each, numbers[each], std::move(script), std::move(content)});
      } catch (const HasNoForm&) {
        continue;
      }
    }
    std::ranges::sort(all[function], {}, &Sequence::suite_case);
  }
  return all;
}

}  // namespace

namespace {

// Adds a case with the flags of its script behind `flag`, the theme. `meaning`: of the theme.
void add(Document& document, const std::string& id, const Names& requirements, const std::string& flag,
         const std::string& meaning, const gl::Case& script, const Json& content) {
  Names flags = {flag};
  document.explain(flag, meaning);
  for (const auto& [other, its_meaning] : flags_of(script)) {
    document.explain(other, its_meaning);
    flags.push_back(other);
  }
  document.add(id, requirements, flags, content);
}

}  // namespace

Document sequences(const std::string& kind, const std::string& description,
                   const std::vector<SuiteCase>& cases) {
  Document document(kind, description);
  for (const auto& [function, of_function] : exported(kind, cases))
    for (const auto& [suite_case, number, script, content] : of_function)
      add(document, fmt::format("{}.{}.{}", kind, suite_case->test, number), suite_case->requirements,
          function, fmt::format("the test {} of the suite", function), script, content);
  return document;
}

Sequences sequences_of_programs(const std::vector<SuiteCase>& programs) {
  constexpr std::size_t kMostBytesOfProgram = 1'000'000;
  Document document("state", "Programs of a recording, each with the state that it needs.");
  Sequences sequences;
  for (const SuiteCase& program : programs) {
    try {
      const gl::Case script = cut_off(program.script, kMostBytesOfProgram);
      const Json content = sequence(script);
      add(document, fmt::format("state.{}.1", program.test), program.requirements, function_of(program.test),
          "a frame of the recording", script, content);
      if (script.commands().size() < program.script.commands().size()) ++sequences.shortened;
    } catch (const HasNoForm&) {
      continue;
    }
  }
  sequences.cases = document.size();
  sequences.text = document.text();
  return sequences;
}

}  // namespace evalcts::vectors
