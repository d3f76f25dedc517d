// Reads and writes results, jobs and events as JSON. `fields` names the fields of each type once, for both
// directions. Input may come from anybody: unknown fields are ignored, and errors name the field.
#include <evalcts/results/serialization.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <type_traits>

#include <evalcts/results/hash.h>
#include <evalcts/results/json_object.h>

namespace evalcts {
namespace {

using nlohmann::json;

constexpr std::string_view kFormat = "evalcts-results-1";
constexpr std::size_t kMostDepth = 100;  // nested brackets; copying a JSON value needs stack for each

// --- archives

class Reader;
class Writer;
// A value as an archive takes it: a Reader fills it, a Writer reads it.
template <class Archive, class T>
using In = std::conditional_t<std::same_as<Archive, Reader>, T&, const T&>;

// Types with a function `fields` are objects in JSON.
template <class T>
concept HasFields = requires(Writer& writer, const T& value) {
  fields(writer, value);
};

// The words that stand for the values of a type.
const char* word_of(Level level) { return name_of(level); }
const char* word_of(Depth depth) { return name_of(depth); }
const char* word_of(Pass pass) { return name_of(pass); }
const char* word_of(RunStatus status) { return name_of(status); }
std::string_view word_of(Verdict verdict) { return text_of(verdict).word; }
std::string word_of(const Shard& shard) { return shard.text(); }
std::string word_of(const Difference& difference) {
  return difference.kind.empty() ? std::string() : difference.text();
}
void parse_word(const std::string& word, std::optional<Level>& out) { out = level_named(word); }
void parse_word(const std::string& word, std::optional<Depth>& out) { out = depth_named(word); }
void parse_word(const std::string& word, std::optional<Pass>& out) { out = pass_named(word); }
void parse_word(const std::string& word, std::optional<RunStatus>& out) { out = status_named(word); }
void parse_word(const std::string& word, std::optional<Verdict>& out) { out = verdict_named(word); }
void parse_word(const std::string& word, std::optional<Difference>& out) { out = parse_difference(word); }
void parse_word(const std::string& word, std::optional<Shard>& out) {
  out = Shard::parse(word);
  if (!out) throw FormatError(fmt::format("shard: \"{}\" is not K-of-N", word));
}
template <class T>
concept HasWord = requires(const T& value) {
  word_of(value);
};

// Returns true for values that a file leaves out.
template <class T>
bool is_empty(const T& value) {
  if constexpr (HasWord<T>)
    return std::string_view(word_of(value)).empty();
  else if constexpr (requires { value.empty(); })
    return value.empty();
  else if constexpr (requires { value.has_value(); })
    return !value.has_value();
  else
    return value == T();
}

// JSON has no infinities: they are null.
json number(double value) { return std::isfinite(value) ? json(value) : json(); }

// Sets members of a JSON object.
class Writer {
 public:
  // Sets members unless the values are empty.
  template <class T, class... More>
  void operator()(const char* key, const T& value, const More&... more) {
    if (!is_empty(value)) always(key, value);
    if constexpr (sizeof...(more) > 0) (*this)(more...);
  }
  // Sets members even if the values are empty.
  template <class T, class... More>
  void always(const char* key, const T& value, const More&... more) {
    out_[key] = to_json(value);
    if constexpr (sizeof...(more) > 0) always(more...);
  }
  // An error, which may be infinite.
  void distance(const char* key, double value) { out_[key] = number(value); }
  void distance(const char* key, const std::optional<double>& value) {
    if (value) distance(key, *value);
  }
  // A text that is JSON itself.
  void json_text(const char* key, const std::string& text) {
    if (json value = parse_json(text); !value.is_discarded()) out_[key] = std::move(value);
  }
  const json& object() const { return out_; }

  template <class T>
  static json to_json(const T& value) {
    if constexpr (HasWord<T>) {
      return word_of(value);
    } else if constexpr (HasFields<T>) {
      Writer object;
      fields(object, value);
      return object.out_;
    } else {
      return value;
    }
  }
  static json to_json(const RequirementId& id) { return id.text(); }
  template <class T>
  static json to_json(const std::optional<T>& value) {
    return to_json(*value);
  }
  template <class T>
  static json to_json(const std::vector<T>& values) {
    json out = json::array();
    for (const T& value : values) out.push_back(to_json(value));
    return out;
  }
  // The coordinates of all positions, one after the other. Five digits are enough for a picture.
  static json to_json(const std::vector<std::array<float, 3>>& positions) {
    json out = json::array();
    for (const auto& position : positions)
      for (const float coordinate : position)
        out.push_back(number(std::strtod(fmt::format("{:.5g}", coordinate).c_str(), nullptr)));
    return out;
  }

 private:
  json out_ = json::object();
};

// Fills values from the members of a JSON object. What is missing keeps its value.
class Reader {
 public:
  explicit Reader(JsonObject in) : in_(std::move(in)) {}

  template <class T, class... More>
  void operator()(const char* key, T& value, More&&... more) {
    if (in_.has(key)) read(key, value);
    if constexpr (sizeof...(more) > 0) (*this)(more...);
  }
  template <class... Members>
  void always(Members&&... members) {
    (*this)(members...);
  }
  void distance(const char* key, double& value) { value = in_.distance(key).value_or(0); }
  void distance(const char* key, std::optional<double>& value) { value = in_.distance(key); }
  void json_text(const char* key, std::string& text) { text = in_.json_text(key); }
  bool has(const char* key) const { return in_.has(key); }
  // Calls use(object) for each element of an array of objects.
  template <class Use>
  void each(const char* key, Use use) {
    in_.each_object(key, use);
  }

 private:
  void read(const char* key, std::string& value) { value = in_.text(key); }
  void read(const char* key, bool& value) { value = in_.boolean(key); }
  void read(const char* key, std::uint64_t& value) { value = *in_.natural(key); }
  void read(const char* key, int& value) { value = static_cast<int>(*in_.natural(key)); }
  void read(const char* key, std::int64_t& value) { value = *in_.integer(key); }
  void read(const char* key, double& value) { value = *in_.real(key); }
  void read(const char* key, std::vector<std::string>& value) { value = in_.texts(key); }
  void read(const char* key, std::vector<RequirementId>& value) {
    const std::vector<std::string> texts = in_.texts(key);
    value.assign(texts.begin(), texts.end());
  }
  void read(const char* key, std::vector<std::array<float, 3>>& value) {
    const std::vector<double> coordinates = in_.reals(key);
    for (std::size_t i = 0; i + 3 <= coordinates.size(); i += 3)
      value.push_back({static_cast<float>(coordinates[i]), static_cast<float>(coordinates[i + 1]),
                       static_cast<float>(coordinates[i + 2])});
  }
  void read(const char* key, std::map<std::string, std::string>& value) {
    const JsonObject object = *in_.object(key);
    object.each_key(
        [&](const std::string& name, const std::string& clean) { value[clean] = object.text(name); });
  }
  void read(const char* key, std::map<std::string, std::vector<std::string>>& value) {
    const JsonObject object = *in_.object(key);
    object.each_key(
        [&](const std::string& name, const std::string& clean) { value[clean] = object.texts(name); });
  }
  template <class T>
  void read(const char* key, std::optional<T>& value) {
    read(key, value.emplace());
  }
  template <HasWord T>
  void read(const char* key, std::optional<T>& value) {
    value = in_.word(key, [](const std::string& word) {
      std::optional<T> parsed;
      parse_word(word, parsed);
      return parsed;
    });
  }
  template <HasWord T>
  void read(const char* key, T& value) {
    std::optional<T> parsed;
    read(key, parsed);
    if (parsed) value = *parsed;
  }
  template <HasFields T>
  void read(const char* key, T& value) {
    Reader object(*in_.object(key));
    fields(object, value);
  }
  template <HasFields T>
  void read(const char* key, std::vector<T>& values) {
    in_.each_object(key, [&](const JsonObject& item) {
      Reader object(item);
      fields(object, values.emplace_back());
    });
  }

  const JsonObject in_;
};

// --- fields

template <class A>
void fields(A& archive, In<A, PlottedPrimitive> primitive) {
  archive.always("mode", primitive.mode, "positions", primitive.positions);
}

template <class A>
void fields(A& archive, In<A, PlottedPixels> pixels) {
  archive.always("x", pixels.x, "y", pixels.y, "width", pixels.width, "height", pixels.height, "expected",
                 pixels.expected, "captured", pixels.captured);
}

template <class A>
void fields(A& archive, In<A, Plot> plot) {
  archive("expected", plot.expected);
  archive.always("captured", plot.captured);
  archive("pixels", plot.pixels, "cut", plot.is_cut);
}

// These fields of the first failure are also fields of its test.
template <class A>
void fields_of_test(A& archive, In<A, Failure> failure) {
  archive.always("calls", failure.calls, "expected", failure.expected, "captured", failure.captured);
  archive("capture", failure.capture);
  archive.distance("ulp", failure.ulp);
  archive.distance("condition_aware", failure.condition_aware);
}

template <class A>
void fields(A& archive, In<A, Failure> failure) {
  fields_of_test(archive, failure);
  archive.always("case", failure.case_identity, "message", failure.message, "what", failure.what);
  archive("difference", failure.difference, "exact", failure.exact, "plot", failure.plot);
}

template <class A>
void fields(A& archive, In<A, Accuracy> accuracy) {
  archive.always("values", accuracy.values);
  archive.distance("max_ulp", accuracy.ulp.error);
  archive.distance("max_condition_aware", accuracy.condition_aware.error);
  archive.always("incorrectly_rounded", accuracy.not_correctly_rounded, "all_terms_zero",
                 accuracy.all_terms_zero, "all_terms_zero_wrong", accuracy.all_terms_zero_wrong, "not_judged",
                 accuracy.not_judged, "worst", accuracy.ulp.where, "worst_exact", accuracy.ulp.exact,
                 "worst_condition_aware", accuracy.condition_aware.where);
}

template <class A>
void fields(A& archive, In<A, Crash> crash) {
  archive.always("call", crash.call, "commands_before", crash.commands_before);
  archive("frames", crash.frames);
}

template <class A>
void fields(A& archive, In<A, Repetition> again) {
  archive.always("verdict", again.verdict, "message", again.message);
}

template <class A>
void fields(A& archive, In<A, TestRecord> test) {
  archive.always("name", test.name, "requirements", test.requirements, "level", test.level, "verdict",
                 test.verdict, "message", test.message, "expected_by_baseline", test.expected_by_baseline,
                 "baseline_reason", test.baseline_reason);
  archive("known_bugs", test.known_bugs, "source", test.source, "violated", test.violated, "cases",
          test.cases, "failed_cases", test.failed_cases, "seed", test.seed, "seconds", test.seconds,
          "mismatches", test.mismatches, "signature_of_all", test.signature_of_all);
  archive.always("failures", test.failures);
  archive("capture", test.capture, "unobserved", test.unobserved, "left_out", test.left_out, "crash",
          test.crash, "accuracy", test.accuracy, "readings", test.readings, "also_in_fresh_context",
          test.also_in_fresh_context, "history", test.history, "history_case", test.history_case, "flake",
          test.flake, "again", test.again, "rerun", test.rerun, "debug", test.debug, "reproducer",
          test.reproducer);
  if constexpr (std::same_as<A, Writer>) {
    if (!test.failures.empty()) fields_of_test(archive, test.failures.front());
  } else {
    std::ranges::sort(test.mismatches);
    if (!archive.has("verdict"))
      test.message =
          "the record holds no verdict for this test" + (test.message.empty() ? "" : ": " + test.message);
    Failure first;
    fields_of_test(archive, first);
    const bool says_something = !first.expected.empty() || !first.captured.empty() || !first.calls.empty();
    if (test.failures.empty() && test.verdict != Verdict::kPass && says_something)
      test.failures.push_back(first);
  }
}

template <class A>
void fields(A& archive, In<A, Bug> bug) {
  archive.always("id", bug.id, "title", bug.title, "cause", bug.cause, "requirements", bug.requirements,
                 "clause", bug.clause, "level", bug.level, "verdict", bug.verdict, "failure", bug.failure);
  archive.json_text("commands", bug.commands);
  archive("why_not_reduced", bug.why_not_reduced, "outside_evaluators", bug.outside_evaluators);
  archive.always("tests", bug.tests, "explains", bug.explains);
  archive("known", bug.known, "known_in", bug.known_in, "breaks_real_programs", bug.breaks_real_programs);
  if constexpr (std::same_as<A, Reader>) std::ranges::sort(bug.tests);
}

template <class A>
void fields(A& archive, In<A, CaptureRecord> capture) {
  archive.always("name", capture.name, "available", capture.available, "reason", capture.reason);
  archive("shows", capture.shows);
}

template <class A>
void fields(A& archive, In<A, ImplementationRecord> implementation) {
  archive.always("name", implementation.name);
  archive("kind", implementation.kind, "library", implementation.library, "context_library",
          implementation.context_library, "vendor", implementation.vendor, "renderer",
          implementation.renderer, "version", implementation.version, "machine", implementation.machine,
          "note", implementation.note, "max_eval_order", implementation.max_eval_order, "files",
          implementation.files, "captures", implementation.captures);
}

template <class A>
void fields(A& archive, In<A, ListedTest> test) {
  archive("name", test.name);
  archive.always("requirements", test.requirements, "level", test.level, "from", test.from, "source",
                 test.source);
}

// All but the tests and the summary.
template <class A>
void fields(A& archive, In<A, RunResult> result) {
  archive.always("evalcts_version", result.evalcts_version);
  archive("status", result.status);
  archive.always("reason", result.reason, "command", result.command, "implementation", result.implementation);
  archive("suite_command", result.suite_command, "started", result.started, "seconds", result.seconds, "host",
          result.host, "timeout", result.timeout, "memory", result.memory, "depth", result.depth, "filter",
          result.filter, "seed", result.seed, "pass", result.pass, "shard", result.shard, "baseline",
          result.baseline, "stale_baseline_entries", result.stale_baseline_entries, "strict", result.strict,
          "confirmed_by_group", result.confirmed_by_group, "readings", result.readings, "bugs", result.bugs,
          "bugs_note", result.bugs_note);
}

template <class A>
void fields(A& archive, In<A, Job> job) {
  archive.always("job", job.kind, "name", job.name);
  archive("cases", job.cases, "traces_cases", job.traces_cases, "runs_control", job.runs_control, "data",
          job.data);
}

template <class A>
void fields(A& archive, In<A, WorkerOptions> start) {
  archive.always("options", start.options);
  archive("programs", start.programs);
}

// --- events

// The word for an event, and its fields.
template <class T>
constexpr const char* kKind = nullptr;
template <>
constexpr const char* kKind<JobStarted> = "start";
template <>
constexpr const char* kKind<JobEnded> = "done";
template <>
constexpr const char* kKind<StillRunning> = "running";
template <>
constexpr const char* kKind<CaseStarted> = "case";
template <>
constexpr const char* kKind<CaseFailed> = "failing-case";
template <>
constexpr const char* kKind<TestFinished> = "result";
template <>
constexpr const char* kKind<TestsListed> = "tests";
template <>
constexpr const char* kKind<ProgramWritten> = "program";
template <>
constexpr const char* kKind<ValuesObserved> = "values";
template <>
constexpr const char* kKind<Description> = "description";
template <>
constexpr const char* kKind<CaptureRecord> = "capture";
template <>
constexpr const char* kKind<CannotOpen> = "cannot-open";
template <>
constexpr const char* kKind<Hung> = "hang";
template <>
constexpr const char* kKind<Crashed> = "crash";
template <>
constexpr const char* kKind<RunEnded> = "end";

template <class A>
void event_fields(A& archive, In<A, JobStarted> event) {
  archive.always("name", event.name);
}
template <class A>
void event_fields(A&, In<A, JobEnded>) {}
template <class A>
void event_fields(A&, In<A, StillRunning>) {}
template <class A>
void event_fields(A& archive, In<A, CaseStarted> event) {
  archive.always("case", event.identity);
  archive("control", event.is_control);
  archive.always("calls", event.calls, "commands", event.commands);
}
template <class A>
void event_fields(A& archive, In<A, CaseFailed> event) {
  archive.always("name", event.test, "commands", event.commands);
}
template <class A>
void event_fields(A& archive, In<A, TestFinished> event) {
  archive.always("record", event.record);
}
template <class A>
void event_fields(A& archive, In<A, ProgramWritten> event) {
  archive.always("text", event.text);
}
// JSON has no infinities, so values are their bits.
template <class A>
void event_fields(A& archive, In<A, ValuesObserved> event) {
  std::string bits;
  if constexpr (std::same_as<A, Writer>)
    for (const float value : event.values) bits += fmt::format("{:08x}", std::bit_cast<std::uint32_t>(value));
  archive.always("capture", event.capture, "bits", bits);
  archive("why_not", event.why_not);
  if constexpr (std::same_as<A, Reader>)
    for (std::size_t i = 0; i + 8 <= bits.size(); i += 8) {
      std::uint32_t value = 0;
      std::from_chars(&bits[i], &bits[i] + 8, value, 16);
      event.values.push_back(std::bit_cast<float>(value));
    }
}
template <class A>
void event_fields(A& archive, In<A, Description> event) {
  archive.always("suite", event.suite, "implementation", event.implementation, "all_captures",
                 event.captures);
}
template <class A>
void event_fields(A& archive, In<A, CaptureRecord> event) {
  archive.always("capture", event);
}
template <class A>
void event_fields(A& archive, In<A, CannotOpen> event) {
  archive.always("reason", event.reason);
}
template <class A>
void event_fields(A&, In<A, Hung>) {}
template <class A>
void event_fields(A& archive, In<A, Crashed> event) {
  archive.always("crash", event.crash);
}
template <class A>
void event_fields(A&, In<A, RunEnded>) {}

// Many tests have the same properties, so an event has their names in groups.
template <class A>
void event_fields(A& archive, In<A, TestsListed> event) {
  if constexpr (std::same_as<A, Writer>) {
    std::map<std::tuple<std::vector<RequirementId>, Level, Depth, std::string>, std::vector<std::string_view>>
        groups;
    for (const ListedTest& test : event.tests)
      groups[{test.requirements, test.level, test.from, test.source}].push_back(test.name);
    json out = json::array();
    for (const auto& [properties, names] : groups) {
      const auto& [requirements, level, from, source] = properties;
      out.push_back(Writer::to_json(ListedTest{"", requirements, level, from, source}));
      out.back()["names"] = names;
    }
    archive.always("groups", out);
  } else {
    archive.each("groups", [&](const JsonObject& group) {
      ListedTest test;
      Reader properties(group);
      fields(properties, test);
      for (std::string& name : group.texts("names")) {
        test.name = std::move(name);
        event.tests.push_back(test);
      }
    });
    std::ranges::sort(event.tests, {}, &ListedTest::name);
  }
}

// Returns the event of the kind, which is one of the alternatives from `I` on.
template <std::size_t I = 0>
std::optional<Event> read_event(const std::string& kind, Reader& in) {
  if constexpr (I < std::variant_size_v<Event>) {
    using Alternative = std::variant_alternative_t<I, Event>;
    if constexpr (kKind<Alternative> != nullptr)
      if (kind == kKind<Alternative>) {
        Alternative event{};
        event_fields(in, event);
        return event;
      }
    return read_event<I + 1>(kind, in);
  }
  return std::nullopt;
}

// --- files and lines

std::string dumped(const json& value, int indent) {
  return value.dump(indent, ' ', false, json::error_handler_t::replace) + "\n";
}

// Returns read(object) for the JSON object in the text; none if the text is not an object or does not follow
// the format.
template <class Read>
auto parse_object(const std::string& text, Read read) -> decltype(read(JsonObject(json(), ""))) {
  const json value = parse_json(text);
  if (!value.is_object()) return std::nullopt;
  try {
    return read(JsonObject(value, ""));
  } catch (const FormatError&) {
    return std::nullopt;
  }
}

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

void read_tests(const JsonObject& in, RunResult& out) {
  std::set<std::string> names;
  in.each_object("tests", [&](const JsonObject& item) {
    TestRecord& test = out.tests.emplace_back();
    Reader record(item);
    fields(record, test);
    if (test.name.empty()) test.name = "(unnamed " + item.place() + ")";
    if (!names.insert(test.name).second)
      throw FormatError(fmt::format("{}.name: \"{}\" occurs twice in this record", item.place(), test.name));
    ++out.counts[static_cast<std::size_t>(test.verdict)];
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

}  // namespace

RunResult read_run_result(const json& value) {
  const JsonObject in(value, "");
  in.word("format",
          [](const std::string& word) { return word == kFormat ? std::optional(0) : std::nullopt; });
  RunResult out;
  Reader record(in);
  fields(record, out);
  out.origin = in.text("origin");
  read_tests(in, out);
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

std::string to_text(const RunResult& result) {
  json out = Writer::to_json(result);
  out["format"] = kFormat;
  out["tests"] = Writer::to_json(result.tests);
  json& summary = out["summary"] = json::object();
  for (std::size_t i = 0; i < kVerdicts; ++i)
    if (result.counts[i]) summary[std::string(text_of(static_cast<Verdict>(i)).word)] = result.counts[i];
  return dumped(out, 1);
}

std::string to_text(const std::vector<ListedTest>& tests) {
  return dumped({{"tests", Writer::to_json(tests)}}, -1);
}

std::string suite_id(const std::vector<ListedTest>& tests) {
  std::uint64_t digest = fnv1a<std::uint64_t>("");
  for (const ListedTest& test : tests)
    digest = fnv1a(fmt::format("{} {} {} {}\n", test.name, fmt::join(texts_of(test.requirements), ","),
                               name_of(test.level), name_of(test.from)),
                   digest);
  return fmt::format("{}, {} tests, digest {:016x}", EVALCTS_VERSION, tests.size(), digest);
}

std::string to_line(const WorkerOptions& options) { return dumped(Writer::to_json(options), -1); }

std::optional<WorkerOptions> parse_worker_options(const std::string& line) {
  return parse_object(line, [](const JsonObject& in) -> std::optional<WorkerOptions> {
    if (!in.has("options")) return std::nullopt;
    WorkerOptions start;
    Reader record(in);
    fields(record, start);
    return start;
  });
}

std::string to_line(const Job& job) { return dumped(Writer::to_json(job), -1); }

std::optional<Job> parse_job(const std::string& line) {
  return parse_object(line, [](const JsonObject& in) -> std::optional<Job> {
    Job job;
    Reader record(in);
    fields(record, job);
    return job.kind.empty() ? std::nullopt : std::optional(job);
  });
}

std::string to_line(const Event& event) {
  return std::visit(
      [](const auto& alternative) {
        using Alternative = std::remove_cvref_t<decltype(alternative)>;
        if constexpr (std::same_as<Alternative, OtherEvent>) {
          return dumped(parse_json(alternative.line), -1);
        } else {
          Writer out;
          out.always("event", std::string(kKind<Alternative>));
          event_fields(out, alternative);
          return dumped(out.object(), -1);
        }
      },
      event);
}

std::optional<Event> parse_event(const std::string& line) {
  return parse_object(line, [&](const JsonObject& in) -> std::optional<Event> {
    Reader record(in);
    const std::string kind = in.text("event");
    const std::optional<Event> event = read_event(kind, record);
    return event ? event : OtherEvent{line};
  });
}

}  // namespace evalcts
