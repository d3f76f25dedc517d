// Writes the headers, the commands of the case, the check of its result and main() of a C program.
#include <evalcts/gl/c_program.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <type_traits>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/hexadecimal.h>
#include "c_contexts.h"
#include "promotions.h"

namespace evalcts::gl {
namespace {

// --- The rest of the program -------------------------------------------------------------------------------

constexpr char kClientArrays[] = R"(
/* A client array ends directly before an inaccessible page: reading past its end crashes. */
struct array {
  unsigned char *base;
  void *start;
  size_t usable, size;
};

static struct array place(const void *bytes, size_t size) {
  const size_t page = (size_t)sysconf(_SC_PAGESIZE);
  struct array a = {NULL, NULL, (size + page - 1) / page * page, size};
  a.base = mmap(NULL, a.usable + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if ((void *)a.base == MAP_FAILED) exit(2);
  mprotect(a.base + a.usable, page, PROT_NONE);
  a.start = a.base + a.usable - size;
  if (size) memcpy(a.start, bytes, size);
  return a;
}
)";

constexpr char kDied[] = R"(
static void died(int signal_number) {
  static const char crash[] = "the library crashes: the failure shows\n";
  static const char hang[] = "no answer in time: the failure shows\n";
  const int hangs = signal_number == SIGALRM;
  if (write(1, hangs ? hang : crash, hangs ? sizeof hang - 1 : sizeof crash - 1)) {}
  _exit(1);
}
)";

constexpr char kErrorName[] = R"(
static const char *error_name(GLenum error) {
  switch (error) {
    case GL_NO_ERROR: return "GL_NO_ERROR";
    case GL_INVALID_ENUM: return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE: return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION: return "GL_INVALID_OPERATION";
    case GL_STACK_OVERFLOW: return "GL_STACK_OVERFLOW";
    case GL_STACK_UNDERFLOW: return "GL_STACK_UNDERFLOW";
    case GL_OUT_OF_MEMORY: return "GL_OUT_OF_MEMORY";
    default: return "another error";
  }
}
)";

bool returns_value(EntryPoint entry) {
  switch (entry) {
#define GL_ENTRY(name, kinds)                                                                       \
  case EntryPoint::name:                                                                            \
    return !std::is_void_v<decltype([]<class R, class... P>(R (*)(P...)) -> std::type_identity<R> { \
      return {};                                                                                    \
    }(decltype(Table::name){}))::type>;
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  }
  return false;
}

const Output* output_of(const Command& command) {
  for (const Value& value : command.arguments)
    if (const auto* output = std::get_if<Output>(&value)) return output;
  return nullptr;
}

class Writer {
 public:
  explicit Writer(const CProgram& program) : program_(program), commands_(program.script->commands()) {
    if (const Check* check = program.check) {
      if (check->answer.kind == Answer::Kind::kReturned) kept_.insert(check->answer.command.index);
      for (const Ref command : check->recorded) kept_.insert(command.index);
      kept_.insert({check->answer.command.index, check->other.index});
    }
    for (const Command& command : commands_)
      for (const Value& value : command.arguments)
        if (const auto* result = std::get_if<ResultOf>(&value)) kept_.insert(result->command);
  }

  std::string write() {
    if (std::ranges::count(commands_, EntryPoint::MoveToThreadEVALCTS, &Command::entry) > 0)
      throw NoCProgram("the case moves its context between threads: a C program has one thread");
    headers();
    text_ += c_contexts(program_);
    entry_points();
    play();
    decide();
    main_function();
    return std::move(text_);
  }

 private:
  bool production() const { return program_.context == "production"; }

  template <class... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    text_ += fmt::format(format, std::forward<T>(values)...) + "\n";
  }

  void headers() {
    text_ += "#ifndef _GNU_SOURCE\n#define _GNU_SOURCE\n#endif\n";
    for (const char* header :
         {"dlfcn.h", "math.h", "signal.h", "stdio.h", "stdlib.h", "string.h", "sys/mman.h", "unistd.h"})
      line("#include <{}>", header);
    text_ +=
        "\n#define GL_GLEXT_PROTOTYPES 1 /* for the types only */\n#include <GL/gl.h>\n#include "
        "<GL/glext.h>\n";
    if (production()) text_ += "#include <glevaluator.h>\n";
    text_ += "\nenum { MOST_CONTEXTS = 8 };\n";
  }

  void entry_points() {
    std::set<EntryPoint> used;
    for (const Command& command : commands_) used.insert(command.entry);
    used.insert(EntryPoint::GetError);
    for (const EntryPoint entry : {EntryPoint::OtherContextEVALCTS, EntryPoint::SharingContextEVALCTS,
                                   EntryPoint::ContextOfKindEVALCTS})
      used.erase(entry);  // use_context() in C
    text_ += "\n/* The commands by their names. */\n";
    if (production()) {
      for (const EntryPoint entry : used) {
        const std::string name(name_of(entry));
        if (parameter_kinds(entry).empty()) {
          line("#define {}() glev{}(context)", name, name.substr(2));
        } else {
          line("#define {}(...) glev{}(context, __VA_ARGS__)", name, name.substr(2));
        }
      }
      return;
    }
    for (const EntryPoint entry : used)
      line("static __typeof__({0}) *my_{0};\n#define {0} my_{0}", name_of(entry));
    text_ += "\nstatic void load(void) {\n";
    for (const EntryPoint entry : used) {
      const std::string older = name_in_extension(name_of(entry));
      line("  *(void **)&my_{0} = address_of(\"{0}\");", name_of(entry));
      if (!older.empty())
        line("  if (!my_{0}) *(void **)&my_{0} = address_of(\"{1}\");", name_of(entry), older);
      line("  if (!my_{0}) missing(\"{0}\");", name_of(entry));
    }
    text_ += "}\n";
    const bool is_failure = program_.check && program_.check->rule == Check::Rule::kHasCommands;
    const std::string missing = fmt::format(
        "\nstatic void missing(const char *name) {{\n  printf(\"%s is missing{}\\n\", name);\n  "
        "exit({});\n}}\n",
        is_failure ? ": the failure shows" : "", is_failure ? 1 : 2);
    text_.insert(text_.find("\nstatic void load(void)"), missing);
  }

  // --- the commands ---

  void play() {
    if (uses_inputs()) text_ += kClientArrays;
    text_ += "\n";
    for (std::size_t i = 0; i < commands_.size(); ++i) {
      if (const Output* output = output_of(commands_[i]))
        line("static {} array_{}[{}];", c_type(output->type), i, output->count + kGuardElements);
      if (keeps(i)) {
        if (commands_[i].entry == EntryPoint::GetString || commands_[i].entry == EntryPoint::GetStringi) {
          line("static const GLubyte *result_{};", i);
        } else {
          line("static long long result_{};", i);
        }
      }
    }
    text_ += "\nstatic void play(void) {\n";
    for (std::size_t i = 0; i < commands_.size(); ++i) issue(i);
    text_ += "}\n";
  }

  bool uses_inputs() const {
    for (const Command& command : commands_)
      for (const Value& value : command.arguments)
        if (std::holds_alternative<Input>(value)) return true;
    return false;
  }

  bool keeps(std::size_t index) const {
    return kept_.count(static_cast<int>(index)) && returns_value(commands_[index].entry);
  }

  void issue(std::size_t index) {
    const Command& command = commands_[index];
    std::map<std::size_t, std::string> places;  // position -> the array's name
    std::string after_calls;
    for (std::size_t i = 0; i < command.arguments.size(); ++i) {
      if (std::holds_alternative<Output>(command.arguments[i])) {
        line("  memset(array_{0}, 0xA5, sizeof array_{0});", index);
        places[i] = fmt::format("array_{}", index);
      }
      const auto* input = std::get_if<Input>(&command.arguments[i]);
      if (!input) continue;
      const std::string name =
          placed(*input, fmt::format("in_{}{}", index, i == 0 ? "" : fmt::format("_{}", i)));
      places[i] = name + ".start";
      switch (input->after) {
        case AfterCall::kKeep:
          break;
        case AfterCall::kOverwrite:
          after_calls +=
              fmt::format("  memset({0}.start, 0x4B, {0}.size); /* overwritten after the call */\n", name);
          break;
        case AfterCall::kUnmap:
          after_calls += fmt::format(
              "  munmap({0}.base, {0}.usable + (size_t)sysconf(_SC_PAGESIZE)); /* unmapped after the "
              "call */\n",
              name);
          break;
        case AfterCall::kProtect:
          after_calls += fmt::format(
              "  mprotect({0}.base, {0}.usable, PROT_NONE); /* protected after the call */\n", name);
          break;
      }
    }
    line("  {}{}", keeps(index) ? fmt::format("result_{} = ", index) : "",
         to_c(command, [&](std::size_t i) { return places.count(i) ? places[i] : std::string(); }));
    text_ += after_calls;
  }

  // Returns an expression for a client array. Arrays with the same slot and size share their memory.
  std::string placed(const Input& input, const std::string& name) {
    const std::string bytes = input.bytes.empty()
                                  ? std::string("NULL")
                                  : fmt::format("({}[]){{{}}}", c_type(input.type), elements_of(input));
    if (input.slot >= 0) {
      const auto [found, is_new] = slots_.try_emplace({input.slot, input.bytes.size()}, name);
      if (!is_new) {
        if (!input.bytes.empty())
          line("  memcpy({}.start, {}, {});", found->second, bytes, input.bytes.size());
        return found->second;
      }
    }
    line("  struct array {} = place({}, {});", name, bytes, input.bytes.size());
    return name;
  }

  // --- the verdict ---

  void decide() {
    const Check* check = program_.check;
    if (!check || check->rule == Check::Rule::kHasCommands) {
      text_ +=
          "\nstatic int decide(void) {\n  printf(\"all commands came back: the failure does not show\\n\");\n"
          "  return 0;\n}\n";
      return;
    }
    switch (check->rule) {
      case Check::Rule::kWithin:
        decide_within(*check);
        break;
      case Check::Rule::kSame:
        decide_same(*check);
        break;
      case Check::Rule::kUnlike:
        decide_unlike(*check);
        break;
      case Check::Rule::kHasCommands:
        break;
    }
  }

  void end_decide(const std::string& holds) {
    line("  const int holds = {};", holds);
    text_ +=
        "  printf(holds ? \"the failure does not show\\n\" : \"the failure shows\\n\");\n  return "
        "!holds;\n}\n";
  }

  std::string answer_text(const Answer& answer) {
    const int command = answer.command.index;
    switch (answer.kind) {
      case Answer::Kind::kReturned:
        return fmt::format("(double)result_{}", command);
      case Answer::Kind::kElement:
        return fmt::format("(double)array_{}[{}]", command, answer.element);
      case Answer::Kind::kWritten:
        text_ += fmt::format(
            "\n/* How many elements hold something else than the filler. */\nstatic size_t written(void) {{\n"
            "  size_t bytes = sizeof array_{0};\n"
            "  while (bytes && ((unsigned char *)array_{0})[bytes - 1] == 0xA5) --bytes;\n"
            "  return (bytes + sizeof *array_{0} - 1) / sizeof *array_{0};\n}}\n",
            command);
        return "(double)written()";
      case Answer::Kind::kLeftOver:
        return "(double)glGetError()";
      case Answer::Kind::kEmittedValue:
        return fmt::format("(double)emitted[{}]", answer.element);
      case Answer::Kind::kEmittedVertices:
        return "(double)emitted_vertices";
    }
    return "0";
  }

  // Returns a description of the checked answer: "values[0] of glGetMapiv(GL_MAP1_INDEX, GL_COEFF, values)".
  std::string subject(const Check& check) const {
    if (!check.what.empty()) return check.what;
    const Ref asked = check.answer.command.index < 0 && !check.recorded.empty() ? check.recorded.front()
                                                                                : check.answer.command;
    if (asked.index < 0) return "the answer";
    const Command& command = commands_.at(static_cast<std::size_t>(asked.index));
    std::string call = to_c(
        command,
        [&](std::size_t i) {
          return std::holds_alternative<Output>(command.arguments[i]) ? std::string("values") : std::string();
        },
        4);
    call.pop_back();  // the semicolon
    if (check.rule == Check::Rule::kWithin && check.answer.kind == Answer::Kind::kElement)
      return fmt::format("values[{}] of {}", check.answer.element, call);
    if (check.rule == Check::Rule::kWithin && check.answer.kind == Answer::Kind::kWritten)
      return "number of values written by " + call;
    return call;
  }

  // Returns true if the type of the answer is an integer.
  bool is_whole(const Answer& answer) const {
    if (answer.kind == Answer::Kind::kEmittedValue) return false;
    if (answer.kind != Answer::Kind::kElement) return true;
    const Output* output = output_of(commands_.at(static_cast<std::size_t>(answer.command.index)));
    return output && output->type != Scalar::kF32 && output->type != Scalar::kF64;
  }

  std::string interval(const Check& check) const {
    if (check.answer.is_error) return check.expected;
    const bool whole = is_whole(check.answer);
    std::string text;
    for (const auto& [low, high] : check.accepted) {
      if (!text.empty()) text += " or ";
      if (low != high) {
        text +=
            whole ? fmt::format("{:.0f} to {:.0f}", low, high) : fmt::format("[{:.9g}, {:.9g}]", low, high);
      } else {
        text += whole ? fmt::format("{:.0f}", low) : fmt::format("{:.9g} ({})", low, hexadecimal(low));
      }
    }
    return text;
  }

  void decide_within(const Check& check) {
    if (check.answer.is_error) text_ += kErrorName;
    const std::string answer = answer_text(check.answer);
    text_ += "\nstatic int decide(void) {\n";
    line("  const double got = {};", answer);
    if (check.answer.is_error) {
      line("  printf(\"%s: expected %s, got %s\\n\", {}, {}, error_name((GLenum)got));",
           quoted(subject(check)), quoted(interval(check)));
    } else if (is_whole(check.answer)) {
      line("  printf(\"%s: expected %s, got %.0f\\n\", {}, {}, got);", quoted(subject(check)),
           quoted(interval(check)));
    } else {
      line("  printf(\"%s: expected %s, got %.9g (%a)\\n\", {}, {}, got, got);", quoted(subject(check)),
           quoted(interval(check)));
    }
    std::string holds;
    for (const auto& [low, high] : check.accepted) {
      if (!holds.empty()) holds += " || ";
      if (std::isnan(low)) {
        holds += "got != got";
      } else if (low == high) {
        holds += fmt::format("got == {}", c_constant(low));
      } else {
        holds += fmt::format("(got >= {} && got <= {})", c_constant(low), c_constant(high));
      }
    }
    end_decide(holds.empty() ? "0" : holds);
  }

  void decide_same(const Check& check) {
    text_ += "\nstatic int decide(void) {\n";
    const int a = check.other.index, b = check.answer.command.index;
    const Command& command = commands_.at(static_cast<std::size_t>(b));
    line("  printf(\"%s\\n\", {});", quoted(subject(check) + ", before and now:"));
    std::string holds;
    if (const Output* output = output_of(command)) {
      print_array(a, output->count);
      print_array(b, output->count);
      holds = fmt::format("memcmp(array_{0}, array_{1}, sizeof array_{0}) == 0", a, b);
    }
    if (keeps(static_cast<std::size_t>(b))) {
      line("  printf(\"%lld\\n%lld\\n\", (long long)result_{}, (long long)result_{});", a, b);
      holds += fmt::format("{}result_{} == result_{}", holds.empty() ? "" : " && ", a, b);
    }
    end_decide(holds.empty() ? "1" : holds);
  }

  void print_array(int index, std::size_t count) {
    line(
        "  for (size_t i = 0; i < {}; ++i) printf(\"%s%.9g\", i ? \" \" : \"  \", (double)array_{}[i]);\n  "
        "puts(\"\");",
        count, index);
  }

  // Writes the decision for a test that compares answers by itself: the program fails if all answers equal
  // the recorded ones.
  void decide_unlike(const Check& check) {
    std::string same;
    for (const Ref ref : check.recorded) {
      const Command& command = commands_.at(static_cast<std::size_t>(ref.index));
      if (const Output* output = output_of(command)) {
        const std::vector<std::byte> bytes = program_.trace->bytes(ref);
        line("static const unsigned char recorded_{}[] = {{", ref.index);
        for (std::size_t i = 0; i < bytes.size(); i += 24) {
          std::string row = " ";
          for (std::size_t k = i; k < std::min(i + 24, bytes.size()); ++k)
            row += fmt::format(" {},", std::to_integer<int>(bytes[k]));
          line("{}", row);
        }
        line("}};");
        same += fmt::format("{0}memcmp(array_{1}, recorded_{1}, {2}) == 0", same.empty() ? "" : " && ",
                            ref.index, output->count * size_of(output->type));
      } else if (keeps(static_cast<std::size_t>(ref.index))) {
        same += fmt::format("{}result_{} == {}LL", same.empty() ? "" : " && ", ref.index,
                            program_.trace->result(ref));
      }
    }
    text_ +=
        "\n/* The test compares several values; here the failure shows where the answers are those recorded. "
        "*/\n"
        "static int decide(void) {\n";
    line("  puts({});", quoted(fmt::format("{}: expected {}", subject(check), check.expected)));
    for (const Ref ref : check.recorded) {
      const Output* output = output_of(commands_.at(static_cast<std::size_t>(ref.index)));
      if (output) print_array(ref.index, std::min<std::size_t>(output->count, 64));
    }
    // If there are no answers to compare, the program only makes the calls.
    end_decide(same.empty() ? "1" : fmt::format("!({})", same));
  }

  void main_function() {
    text_ += kDied;
    text_ +=
        "\nint main(int argc, char **argv) {\n"
        "  static const int deadly[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM};\n"
        "  for (size_t i = 0; i < sizeof deadly / sizeof *deadly; ++i) signal(deadly[i], died);\n"
        "#ifdef SECONDS\n  alarm(SECONDS);\n#endif\n";
    if (production()) {
      text_ += "  (void)argc, (void)argv;\n  make_context();\n";
    } else {
      line("  make_context(argc > 1 ? argv[1] : {});\n  load();", quoted(program_.library));
    }
    text_ +=
        "  play();\n  const int result = decide();\n  fflush(stdout);\n  _exit(result); /* not through what "
        "the library left behind */\n}\n";
  }

  const CProgram& program_;
  const std::vector<Command>& commands_;
  std::set<int> kept_;
  std::map<std::pair<int, std::size_t>, std::string> slots_;
  std::string text_;
};

}  // namespace

std::string to_c(const CProgram& program) { return Writer(program).write(); }

}  // namespace evalcts::gl
