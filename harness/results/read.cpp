// Reads results and events from JSON, which may come from anybody: unknown fields are ignored, and errors
// name the field.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include <evalcts/results/json_object.h>
#include <evalcts/results/serialization.h>

namespace evalcts {
namespace {

using nlohmann::json;

constexpr std::string_view kFormat = "evalcts-results-1";
constexpr std::size_t kMostDepth = 100;  // nested brackets; copying a JSON value needs stack for each

// Returns the depth of nested brackets in a JSON text.
std::size_t depth_of(const std::string& text) {
  std::size_t depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') {
      ++i;  // an escaped character ends nothing
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

std::optional<Verdict> read_verdict(const JsonObject& in) {
  const std::string word = in.text("verdict");
  if (!in.has("verdict")) return std::nullopt;
  const std::optional<Verdict> verdict = verdict_named(word);
  if (!verdict) throw FormatError(fmt::format("{}: unknown verdict \"{}\"", in.path("verdict"), word));
  return verdict;
}

std::vector<PlottedPrimitive> read_primitives(const JsonObject& in, const std::string& key) {
  std::vector<PlottedPrimitive> out;
  in.each_object(key, [&](const JsonObject& item) {
    PlottedPrimitive& primitive = out.emplace_back();
    primitive.mode = item.text("mode");
    const std::vector<double> coordinates = item.reals("positions");
    for (std::size_t i = 0; i + 3 <= coordinates.size(); i += 3) {
      std::array<float, 3>& position = primitive.positions.emplace_back();
      for (std::size_t j = 0; j < 3; ++j) position[j] = static_cast<float>(coordinates[i + j]);
    }
  });
  return out;
}

std::vector<PlottedPixels> read_pixels(const JsonObject& in, const std::string& key) {
  std::vector<PlottedPixels> out;
  in.each_object(key, [&](const JsonObject& item) {
    const auto number = [&](const std::string& name) {
      return static_cast<int>(item.natural(name).value_or(0));
    };
    out.push_back({number("x"), number("y"), number("width"), number("height"), item.text("expected"),
                   item.text("captured")});
  });
  return out;
}

Failure read_failure(const JsonObject& in) {
  Failure out;
  out.case_identity = in.text("case");
  out.message = in.text("message");
  out.what = in.text("what");
  out.difference = in.word("difference", parse_difference).value_or(Difference());
  out.expected = in.text("expected");
  out.captured = in.text("captured");
  out.exact = in.text("exact");
  out.capture = in.text("capture");
  out.ulp = in.distance("ulp");
  out.condition_aware = in.distance("condition_aware");
  out.calls = in.texts("calls");
  if (const auto plot = in.object("plot")) {
    out.plot = {.expected = std::nullopt,
                .captured = read_primitives(*plot, "captured"),
                .pixels = read_pixels(*plot, "pixels"),
                .is_cut = plot->boolean("cut")};
    if (plot->has("expected")) out.plot->expected = read_primitives(*plot, "expected");
  }
  return out;
}

Accuracy read_accuracy(const JsonObject& in) {
  Accuracy out;
  out.values = in.natural("values").value_or(0);
  out.not_correctly_rounded = in.natural("incorrectly_rounded").value_or(0);
  out.all_terms_zero = in.natural("all_terms_zero").value_or(0);
  out.all_terms_zero_wrong = in.natural("all_terms_zero_wrong").value_or(0);
  out.not_judged = in.natural("not_judged").value_or(0);
  out.ulp.error = in.distance("max_ulp").value_or(0);
  out.ulp.where = in.text("worst");
  out.ulp.exact = in.text("worst_exact");
  out.condition_aware.error = in.distance("max_condition_aware").value_or(0);
  out.condition_aware.where = in.text("worst_condition_aware");
  return out;
}

std::vector<RequirementId> read_requirements(const JsonObject& in, const char* key = "requirements") {
  const std::vector<std::string> texts = in.texts(key);
  return {texts.begin(), texts.end()};
}

Crash read_crash(const JsonObject& in) {
  return {in.text("call"), in.natural("commands_before").value_or(0), in.texts("frames")};
}

TestRecord read_test(const JsonObject& in) {
  TestRecord out;
  out.name = in.text("name");
  out.requirements = read_requirements(in);
  out.violated = read_requirements(in, "violated");
  out.level = in.word("level", level_named).value_or(Level::kMust);
  out.expected_by_baseline = in.boolean("expected_by_baseline");
  out.baseline_reason = in.text("baseline_reason");
  out.known_bugs = in.texts("known_bugs");
  out.also_in_fresh_context = in.boolean("also_in_fresh_context");
  out.message = in.text("message");
  out.source = in.text("source");
  out.cases = in.natural("cases");
  out.failed_cases = in.natural("failed_cases");
  out.seed = in.natural("seed");
  out.seconds = in.real("seconds");
  out.rerun = in.text("rerun");
  out.debug = in.text("debug");
  out.reproducer = in.text("reproducer");
  if (in.has("history")) out.history = in.texts("history");
  out.history_case = in.text("history_case");
  out.flake = in.boolean("flake");
  if (const auto again = in.object("again"))
    out.again = Repetition{read_verdict(*again).value_or(Verdict::kInternalError), again->text("message")};
  out.mismatches = in.texts("mismatches");
  std::ranges::sort(out.mismatches);
  out.signature_of_all = in.text("signature_of_all");
  if (const auto readings = in.object("readings"))
    readings->each_key(
        [&](const std::string& key, const std::string& name) { out.readings[name] = readings->text(key); });
  if (const std::optional<Verdict> verdict = read_verdict(in)) {
    out.verdict = *verdict;
  } else {
    out.verdict = Verdict::kInternalError;  // never a silent pass
    out.message =
        "the record holds no verdict for this test" + (out.message.empty() ? "" : ": " + out.message);
  }
  in.each_object("failures", [&](const JsonObject& item) { out.failures.push_back(read_failure(item)); });
  Failure of_test = read_failure(in);  // the same fields stand at the level of the test
  out.capture = of_test.capture;
  out.unobserved = in.text("unobserved");
  out.left_out = in.texts("left_out");
  if (const auto crash = in.object("crash")) out.crash = read_crash(*crash);
  of_test.message.clear();
  const bool says_something =
      !of_test.expected.empty() || !of_test.captured.empty() || !of_test.calls.empty();
  if (out.failures.empty() && out.verdict != Verdict::kPass && says_something)
    out.failures.push_back(of_test);
  if (const auto accuracy = in.object("accuracy")) out.accuracy = read_accuracy(*accuracy);
  return out;
}

Bug read_bug(const JsonObject& in) {
  Bug out;
  out.id = in.text("id");
  out.title = in.text("title");
  out.cause = in.text("cause");
  out.requirements = read_requirements(in);
  out.clause = in.text("clause");
  out.level = in.word("level", level_named).value_or(Level::kMust);
  out.verdict = read_verdict(in).value_or(Verdict::kFail);
  if (const auto failure = in.object("failure")) out.failure = read_failure(*failure);
  out.commands = in.json_text("commands");
  out.why_not_reduced = in.text("why_not_reduced");
  out.outside_evaluators = in.boolean("outside_evaluators");
  out.tests = in.texts("tests");
  std::ranges::sort(out.tests);
  out.explains = read_requirements(in, "explains");
  out.known = in.text("known");
  out.known_in = in.text("known_in");
  out.breaks_real_programs = in.boolean("breaks_real_programs");
  return out;
}

CaptureRecord read_capture(const JsonObject& in) {
  return {in.text("name"), in.boolean("available"), in.text("reason"), in.text("shows")};
}

ImplementationRecord read_implementation(const JsonObject& in) {
  ImplementationRecord out;
  out.name = in.text("name");
  out.kind = in.text("kind");
  out.library = in.text("library");
  out.context_library = in.text("context_library");
  out.vendor = in.text("vendor");
  out.renderer = in.text("renderer");
  out.version = in.text("version");
  out.machine = in.text("machine");
  out.note = in.text("note");
  out.files = in.texts("files");
  out.max_eval_order = in.integer("max_eval_order");
  in.each_object("captures", [&](const JsonObject& item) { out.captures.push_back(read_capture(item)); });
  return out;
}

void read_tests(const JsonObject& in, RunResult& out) {
  std::set<std::string> names;
  in.each_object("tests", [&](const JsonObject& item) {
    TestRecord test = read_test(item);
    if (test.name.empty()) test.name = "(unnamed " + item.place() + ")";
    if (!names.insert(test.name).second)
      throw FormatError(fmt::format("{}.name: \"{}\" occurs twice in this record", item.place(), test.name));
    ++out.counts[static_cast<std::size_t>(test.verdict)];
    out.tests.push_back(std::move(test));
  });
  const auto summary = in.object("summary");
  if (!summary) return;
  summary->each_key([&](const std::string& key, const std::string& word) {
    const std::optional<Verdict> verdict = verdict_named(word);
    if (!verdict) throw FormatError(fmt::format("summary: unknown verdict \"{}\"", word));
    const std::uint64_t count = summary->natural(key).value_or(0);
    if (!in.has("tests")) out.counts[static_cast<std::size_t>(*verdict)] = count;
  });
}

// Returns read(object) for the JSON object in the text; none if the text is not an object or does not follow
// the format.
template <class Read>
auto parse_object(const std::string& text, Read read) -> decltype(read(json())) {
  const json value = json::parse(text, nullptr, false);
  if (!value.is_object()) return std::nullopt;
  try {
    return read(value);
  } catch (const FormatError&) {
    return std::nullopt;
  }
}

std::vector<ListedTest> read_listed_tests(const JsonObject& in) {
  std::vector<ListedTest> tests;
  in.each_object("groups", [&](const JsonObject& group) {
    const ListedTest properties{
        "", read_requirements(group), group.word("level", level_named).value_or(Level::kMust),
        group.word("from", [](const std::string& word) { return depth_named(word); }).value_or(Depth::kQuick),
        group.text("source")};
    for (std::string& name : group.texts("names")) {
      tests.push_back(properties);
      tests.back().name = std::move(name);
    }
  });
  std::ranges::sort(tests, {}, &ListedTest::name);
  return tests;
}

}  // namespace

RunResult read_run_result(const json& value) {
  const JsonObject in(value, "");
  in.word("format",
          [](const std::string& word) { return word == kFormat ? std::optional(0) : std::nullopt; });
  RunResult out;
  out.evalcts_version = in.text("evalcts_version");
  out.status = in.word("status", status_named);
  out.reason = in.text("reason");
  out.command = in.text("command");
  out.started = in.text("started");
  out.seconds = in.real("seconds");
  out.host = in.text("host");
  out.suite_command = in.texts("suite_command");
  out.timeout = in.real("timeout");
  out.memory = in.natural("memory");
  out.depth = in.word("depth", [](const std::string& word) { return depth_named(word); });
  out.filter = in.text("filter");
  out.pass = in.word("pass", pass_named).value_or(Pass::kFreshContexts);
  out.origin = in.text("origin");
  out.seed = in.natural("seed");
  out.baseline = in.text("baseline");
  out.stale_baseline_entries = in.texts("stale_baseline_entries");
  out.strict = in.boolean("strict");
  out.confirmed_by_group = in.natural("confirmed_by_group").value_or(0);
  if (const std::string shard = in.text("shard"); !shard.empty()) {
    out.shard = Shard::parse(shard);
    if (!out.shard) throw FormatError(fmt::format("shard: \"{}\" is not K-of-N", shard));
  }
  if (const auto readings = in.object("readings"))
    readings->each_key(
        [&](const std::string& key, const std::string& name) { out.readings[name] = readings->texts(key); });
  if (const auto implementation = in.object("implementation"))
    out.implementation = read_implementation(*implementation);
  read_tests(in, out);
  in.each_object("bugs", [&](const JsonObject& item) { out.bugs.push_back(read_bug(item)); });
  out.bugs_note = in.text("bugs_note");
  return out;
}

RunResult parse_run_result(const std::string& text) {
  if (depth_of(text) > kMostDepth)
    throw FormatError("this is not a result file: brackets are nested too deeply");
  json result;
  try {
    result = json::parse(text);
  } catch (const json::parse_error& error) {
    throw FormatError(fmt::format("this is not JSON, or was cut off (byte {})", error.byte));
  }
  const std::string format = JsonObject(result, "").text("format");
  if (format != kFormat)
    throw FormatError(fmt::format("this is not a result file: its format is {}, not \"{}\"",
                                  format.empty() ? "missing" : "\"" + cut(format, 60) + "\"", kFormat));
  return read_run_result(result);
}

std::optional<Event> parse_event(const std::string& line) {
  return parse_object(line, [&](const json& value) -> std::optional<Event> {
    const JsonObject in(value, "event");
    const std::string kind = in.text("event");
    if (kind == "start") return JobStarted{in.text("name")};
    if (kind == "done") return JobEnded{};
    if (kind == "case")
      return CaseStarted{in.text("case"), in.boolean("control"), in.texts("calls"), in.text("commands")};
    if (kind == "failing-case") return CaseFailed{in.text("name"), in.text("commands")};
    if (kind == "end") return RunEnded{};
    const auto crash = in.object("crash");
    if (kind == "crash" && crash) return Crashed{read_crash(*crash)};
    const auto record = in.object("record");
    if (kind == "result" && record && record->has("verdict")) return TestFinished{read_test(*record)};
    const auto implementation = in.object("implementation");
    if (kind == "description" && implementation)
      return Description{read_implementation(*implementation), in.texts("all_captures")};
    const auto capture = in.object("capture");
    if (kind == "capture" && capture) return read_capture(*capture);
    if (kind == "cannot-open") return CannotOpen{in.text("reason")};
    if (kind == "tests") return TestsListed{read_listed_tests(in)};
    return OtherEvent{line};
  });
}

std::optional<Job> parse_job(const std::string& line) {
  return parse_object(line, [](const json& value) -> std::optional<Job> {
    const JsonObject in(value, "job");
    if (in.text("job").empty()) return std::nullopt;
    Job job{in.text("job"), in.text("name")};
    if (const auto cases = in.integer("cases")) job.cases = static_cast<std::uint64_t>(*cases);
    job.traces_cases = in.boolean("traces_cases");
    job.runs_control = in.boolean("runs_control");
    job.data = in.text("data");
    return job;
  });
}

}  // namespace evalcts
