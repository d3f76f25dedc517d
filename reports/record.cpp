#include "reports/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "evalcts/reports.h"
#include "reports/text.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

constexpr std::string_view kFormat = "evalcts-results-1";
constexpr std::size_t kMostDepth = 100;  // of brackets; copies of a JSON value need stack for each

constexpr std::array<VerdictText, kVerdicts> kVerdictTexts{{
    {"internal-error", "!", "evalcts itself went wrong; says nothing about the implementation"},
    {"crash", "‼", "the process died while this test ran"},
    {"timeout", "◷", "no end within the time limit"},
    {"fail", "✗", "something observed contradicts the requirement"},
    {"quality-warning", "△", "conforms, but falls short of what good implementations do"},
    {"not-observable", "◌", "this implementation gives no trustworthy way to see the effect"},
    {"not-supported", "∅", "the implementation does not offer what the test needs"},
    {"skipped", "–", "not run, because something asked for that"},
    {"pass", "✓", "everything observed agrees with the requirement"},
}};

// How deep brackets are nested in a JSON text.
std::size_t depth_of(const std::string& text) {
  std::size_t depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') {
      ++i;  // what is escaped ends nothing
    } else if (c == '"') {
      in_string = !in_string;
    } else if (!in_string && (c == '[' || c == '{')) {
      deepest = std::max(deepest, ++depth);
    } else if (!in_string && (c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

Verdict parse_verdict(const std::string& word, const std::string& path) {
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    if (kVerdictTexts[i].word == word) return static_cast<Verdict>(i);
  }
  throw FormatError(fmt::format("{}: unknown verdict \"{}\"", path, word));
}

// A JSON object and where it stands. A field that is missing or null is empty; null is also how a JSON writer
// spells an infinite distance.
class Object {
 public:
  Object(const json& value, std::string path) : value_(value), path_(std::move(path)) {
    if (!value.is_object()) fail(path_.empty() ? "the record" : path_, "an object", value);
  }

  std::string path(const std::string& key) const {
    return path_.empty() ? key : fmt::format("{}.{}", path_, key);
  }

  const json* find(const std::string& key) const {
    const auto it = value_.find(key);
    return it == value_.end() || it->is_null() ? nullptr : &*it;
  }

  std::string text(const std::string& key) const {
    const json* value = find(key);
    return value ? text(*value, path(key)) : std::string();
  }

  // One of `words`, or empty.
  std::string word(const std::string& key, std::initializer_list<std::string_view> words) const {
    std::string found = text(key);
    for (const std::string_view candidate : words) {
      if (found == candidate) return found;
    }
    if (!found.empty()) throw FormatError(fmt::format("{}: unknown word \"{}\"", path(key), found));
    return found;
  }

  bool boolean(const std::string& key) const {
    const json* value = find(key);
    if (value && !value->is_boolean()) fail(path(key), "a boolean", *value);
    return value && value->get<bool>();
  }

  std::optional<double> real(const std::string& key) const {
    const json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_number()) fail(path(key), "a number", *value);
    return value->get<double>();
  }

  std::optional<std::int64_t> integer(const std::string& key) const {
    const json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_number_integer()) fail(path(key), "an integer", *value);
    return value->get<std::int64_t>();
  }

  std::optional<std::uint64_t> natural(const std::string& key) const {
    const json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_number_integer() || (!value->is_number_unsigned() && value->get<std::int64_t>() < 0)) {
      fail(path(key), "a non-negative integer", *value);
    }
    return value->get<std::uint64_t>();
  }

  std::vector<std::string> texts(const std::string& key) const {
    std::vector<std::string> out;
    each(key, [&](const json& item, const std::string& where) { out.push_back(text(item, where)); });
    return out;
  }

  // use(element, its path) for each element of an array.
  template <typename Use>
  void each(const std::string& key, Use use) const {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_array()) fail(path(key), "an array", *value);
    for (std::size_t i = 0; i < value->size(); ++i) use((*value)[i], fmt::format("{}[{}]", path(key), i));
  }

 private:
  [[noreturn]] static void fail(const std::string& where, const char* expected, const json& found) {
    throw FormatError(fmt::format("{}: expected {}, found {} {}", where, expected,
                                  found.is_array() || found.is_object() ? "an" : "a", found.type_name()));
  }

  static std::string text(const json& value, const std::string& where) {
    if (!value.is_string()) fail(where, "a string", value);
    return clean(value.get_ref<const std::string&>());
  }

  const json& value_;
  std::string path_;
};

Failure read_failure(const Object& in) {
  Failure out;
  out.case_name = in.text("case");
  out.message = in.text("message");
  out.what = in.text("what");
  out.expected = in.text("expected");
  out.captured = in.text("captured");
  out.exact = in.text("exact");
  out.capture = in.text("capture");
  out.ulp = in.real("ulp");
  out.condition_aware = in.real("condition_aware");
  out.calls = in.texts("calls");
  return out;
}

Accuracy read_accuracy(const Object& in) {
  Accuracy out;
  out.values = in.natural("values");
  out.incorrectly_rounded = in.natural("incorrectly_rounded");
  out.max_ulp = in.real("max_ulp");
  out.max_condition_aware = in.real("max_condition_aware");
  out.worst = in.text("worst");
  return out;
}

TestResult read_test(const Object& in) {
  TestResult out;
  out.name = in.text("name");
  out.requirements = in.texts("requirements");
  out.level = in.word("level", {"must", "interpretation", "quality"});
  out.expected_by_baseline = in.boolean("expected_by_baseline");
  out.baseline_reason = in.text("baseline_reason");
  out.message = in.text("message");
  out.cases = in.natural("cases");
  out.failed_cases = in.natural("failed_cases");
  out.seed = in.natural("seed");
  out.rerun = in.text("rerun");
  out.debug = in.text("debug");
  out.reproducer = in.text("reproducer");
  out.history = in.texts("history");
  out.flake = in.boolean("flake");
  if (const json* again = in.find("again"))
    out.again =
        text_of(parse_verdict(Object(*again, in.path("again")).text("verdict"), in.path("again"))).word;
  out.mismatches = in.texts("mismatches");
  std::sort(out.mismatches.begin(), out.mismatches.end());
  out.seconds = in.real("seconds");
  if (in.find("verdict")) {
    out.verdict = parse_verdict(in.text("verdict"), in.path("verdict"));
  } else {
    out.verdict = Verdict::kInternalError;  // never a silent pass
    out.message =
        "the record holds no verdict for this test" + (out.message.empty() ? "" : ": " + out.message);
  }
  in.each("failures", [&](const json& item, const std::string& where) {
    out.failures.push_back(read_failure(Object(item, where)));
  });
  Failure of_test = read_failure(in);  // the same words stand at the level of the test
  of_test.message.clear();
  const bool says_something =
      !of_test.expected.empty() || !of_test.captured.empty() || !of_test.calls.empty();
  if (out.failures.empty() && out.verdict != Verdict::kPass && says_something)
    out.failures.push_back(of_test);
  if (const json* accuracy = in.find("accuracy")) {
    out.accuracy = read_accuracy(Object(*accuracy, in.path("accuracy")));
  }
  return out;
}

Implementation read_implementation(const Object& in) {
  Implementation out;
  out.name = in.text("name");
  out.library = in.text("library");
  out.vendor = in.text("vendor");
  out.renderer = in.text("renderer");
  out.note = in.text("note");
  out.files = in.texts("files");
  out.version = in.text("version");
  out.machine = in.text("machine");
  out.max_eval_order = in.integer("max_eval_order");
  in.each("captures", [&](const json& item, const std::string& where) {
    const Object capture(item, where);
    out.captures.push_back({capture.text("name"), capture.boolean("available"), capture.text("reason")});
  });
  return out;
}

}  // namespace

const VerdictText& text_of(Verdict verdict) { return kVerdictTexts[static_cast<std::size_t>(verdict)]; }

int TestResult::severity() const {
  const int rank = static_cast<int>(verdict), shift = static_cast<int>(kBadVerdicts);
  if (bad()) return expected_bad() ? rank + shift : rank;
  return unexpected_pass() ? 2 * shift : rank + shift + 1;
}

std::uint64_t Record::total() const {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

std::uint64_t Record::unexpected_count() const {
  if (tests.empty()) return std::accumulate(counts.begin(), counts.begin() + kBadVerdicts, std::uint64_t{0});
  return std::count_if(tests.begin(), tests.end(), [](const TestResult& test) { return test.unexpected(); });
}

std::uint64_t Record::expected_bad_count() const {
  return std::count_if(tests.begin(), tests.end(),
                       [](const TestResult& test) { return test.expected_bad(); });
}

std::string Record::heading(const std::string& unnamed) const {
  const std::string name = implementation.name.empty() ? unnamed : one_line(implementation.name);
  return pass.empty() ? name : name + ", one shared context";
}

Record read_record(const json& value) {
  const Object in(value, "");
  in.word("format", {kFormat});
  Record out;
  out.evalcts_version = in.text("evalcts_version");
  out.status = in.word("status", {"complete", "interrupted", "not-started"});
  out.reason = in.text("reason");
  out.command = in.text("command");
  out.depth = in.text("depth");
  out.pass = in.word("pass", {"reuse-context"});
  out.shard = in.text("shard");
  out.origin = in.text("origin");
  out.seed = in.natural("seed");
  out.baseline = in.text("baseline");
  out.stale_baseline_entries = in.texts("stale_baseline_entries");
  out.not_played_again = in.natural("not_played_again").value_or(0);
  if (const json* readings = in.find("readings")) {
    const Object by_text(*readings, "readings");
    for (const auto& item : readings->items()) out.readings[clean(item.key())] = by_text.texts(item.key());
  }
  if (const json* implementation = in.find("implementation")) {
    out.implementation = read_implementation(Object(*implementation, "implementation"));
  }
  std::set<std::string> names;
  in.each("tests", [&](const json& item, const std::string& where) {
    TestResult test = read_test(Object(item, where));
    if (test.name.empty()) test.name = "(unnamed " + where + ")";
    if (!names.insert(test.name).second) {
      throw FormatError(fmt::format("{}.name: \"{}\" stands in this record twice", where, test.name));
    }
    ++out.counts[static_cast<std::size_t>(test.verdict)];
    out.tests.push_back(std::move(test));
  });
  if (const json* summary = in.find("summary")) {
    const Object counts(*summary, "summary");
    for (const auto& item : summary->items()) {
      const Verdict verdict = parse_verdict(clean(item.key()), "summary");
      const std::uint64_t n = counts.natural(item.key()).value_or(0);
      if (!in.find("tests")) out.counts[static_cast<std::size_t>(verdict)] = n;
    }
  }
  return out;
}

json parse_result(const std::string& text) {
  if (depth_of(text) > kMostDepth) throw FormatError("this is no result: brackets are nested too deeply");
  json result;
  try {
    result = json::parse(text);
  } catch (const json::parse_error& error) {
    throw FormatError(fmt::format("this is no JSON, or was cut off (byte {})", error.byte));
  }
  const Object in(result, "");
  const std::string format = in.text("format");
  if (format != kFormat)
    throw FormatError(fmt::format("this is no result: its format is {}, not \"{}\"",
                                  format.empty() ? "missing" : "\"" + cut(format, 60) + "\"", kFormat));
  read_record(result);
  return result;
}

const Requirement* find_requirement(const Requirements& catalogue, const std::string& id) {
  auto found = catalogue.find(id);
  if (found == catalogue.end()) found = catalogue.find(id.substr(0, id.find('/')));
  return found == catalogue.end() ? nullptr : &found->second;
}

Requirements read_requirements(const json& value) {
  Requirements out;
  if (value.is_null()) return out;
  Object(value, "the requirements").each("requirements", [&](const json& item, const std::string& where) {
    const Object in(item, where);
    Requirement requirement{in.text("id"),       in.text("section"), in.text("text"),
                            in.text("source"),   in.text("since"),   in.text("observation"),
                            in.text("severity"), in.text("level"),   out.size()};
    if (requirement.id.empty()) throw FormatError(where + ".id is missing");
    out.emplace(requirement.id, requirement);
  });
  return out;
}

Ambiguities read_ambiguities(const json& value) {
  Ambiguities out;
  if (value.is_null()) return out;
  const Object catalogue(value, "the requirements");
  const auto add = [&](const json& item, const std::string& where) {
    const Object in(item, where);
    const json* readings = in.find("readings");
    if (!readings) return;
    Ambiguity& ambiguity = out[in.text("id")];
    // What is unclear stands under the word for its kind.
    for (const char* kind : {"conflict", "change", "slip", "situation"})
      if (in.find(kind)) ambiguity.text = in.text(kind);
    ambiguity.where = in.text("where");
    const Object meanings(*readings, in.path("readings"));
    for (const auto& reading : readings->items())
      ambiguity.readings[clean(reading.key())] = meanings.text(reading.key());
  };
  catalogue.each("contradictions", add);
  catalogue.each("undefined", add);
  return out;
}

}  // namespace evalcts::reports
