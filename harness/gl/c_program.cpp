// Writes the commands of a case and the check of its result as C, with the frame of the chosen style.
#include <evalcts/gl/c_program.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <type_traits>
#include <utility>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/contexts.h>
#include <evalcts/gl/hexadecimal.h>
#include <evalcts/results/text.h>
#include "c_contexts.h"
#include "c_frames.h"
#include "promotions.h"

namespace evalcts::gl {
namespace {

// --- The rest of the program -------------------------------------------------------------------------------

// Headers of a program for Windows, and the functions of POSIX that Windows lacks.
constexpr char kOnWindows[] = R"(#include <windows.h>

#include <io.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The functions of POSIX that are used below. */
enum { RTLD_NOW, RTLD_LOCAL = 0, PROT_NONE = 0, PROT_READ, PROT_WRITE, MAP_PRIVATE = 0, MAP_ANONYMOUS = 0, _SC_PAGESIZE };
enum { SIGALRM = 14 };
#define MAP_FAILED NULL
static inline void *dlopen(const char *path, int how) { return (void)how, (void *)LoadLibraryA(path); }
static inline void *dlsym(void *from, const char *name) { return (void *)GetProcAddress((HMODULE)from, name); }
static inline const char *dlerror(void) { return "LoadLibrary fails"; }
static inline long sysconf(int name) {
  SYSTEM_INFO info;
  GetSystemInfo(&info);
  return (void)name, (long)info.dwPageSize;
}
static inline void *mmap(void *at, size_t size, int access, int kind, int file, long begin) {
  (void)at, (void)access, (void)kind, (void)file, (void)begin;
  return VirtualAlloc(NULL, size, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
}
static inline int mprotect(void *at, size_t size, int access) {
  DWORD before;
  return (void)access, !VirtualProtect(at, size, PAGE_NOACCESS, &before);
}
static inline int munmap(void *at, size_t size) { return (void)size, !VirtualFree(at, 0, MEM_RELEASE); }
static void died(int);
static DWORD WINAPI wait_for_alarm(void *seconds) {
  Sleep(1000 * (DWORD)(size_t)seconds);
  died(SIGALRM);
  return 0;
}
static inline void alarm(unsigned seconds) { CreateThread(NULL, 0, wait_for_alarm, (void *)(size_t)seconds, 0, NULL); }
)";

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

// Returns the last statement of a program in a short style. `fails`: a C expression that is true if it fails.
std::string return_of(CStyle style, const std::string& fails) {
  if (style == CStyle::kPiglit)
    return fails == "0" ? "return PIGLIT_PASS;"
                        : fmt::format("return {} ? PIGLIT_FAIL : PIGLIT_PASS;", fails);
  return fails == "0" ? "return 0;" : fmt::format("return {}; /* 1: the failure shows */", fails);
}

// Returns the text in the layout of piglit: indented by tabs, with the names of functions on their own lines.
std::string in_layout_of_piglit(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    const std::size_t spaces = std::min(line.find_first_not_of(' '), line.size());
    line.replace(0, spaces, std::string(spaces / 2, '\t'));
    if (line.starts_with("static ") && line.ends_with(") {")) {
      line.replace(line.size() - 2, 2, "\n{");
      line[line.rfind(' ', line.find('('))] = '\n';
    }
    out += line + "\n";
    begin = end + 1;
  }
  return out;
}

// Returns the name of the variable for the answer of a command of a capture in a short style; null for other
// commands.
const char* variable_of(EntryPoint entry) {
  switch (entry) {
    case EntryPoint::CreateProgram:
      return "program";
    case EntryPoint::CreateShader:
      return "shader";
    case EntryPoint::GenBuffers:
      return "buffer";
    case EntryPoint::GenQueries:
      return "query";
    case EntryPoint::GetQueryObjectuiv:
      return "primitives";
    case EntryPoint::GetBufferSubData:
      return "captured";
    case EntryPoint::GetError:
      return "error";
    default:
      return nullptr;
  }
}

// Returns the C type of the value that a command returns, for a short style.
const char* type_of_result(EntryPoint entry) {
  switch (entry) {
    case EntryPoint::GetString:
    case EntryPoint::GetStringi:
      return "const GLubyte *";
    case EntryPoint::GetError:
      return "GLenum ";
    case EntryPoint::CreateProgram:
    case EntryPoint::CreateShader:
    case EntryPoint::GenLists:
      return "GLuint ";
    default:
      return "GLint ";
  }
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
    if (!is_full()) return write_short();
    headers();
    text_ += c_contexts(program_);
    entry_points();
    if (uses_inputs()) text_ += kClientArrays;
    text_ += "\n";
    variables();
    text_ += "\nstatic void draw(void) {\n";
    for (std::size_t i = 0; i < commands_.size(); ++i)
      for (const std::string& statement : statements(i)) line("  {}", statement);
    text_ += "}\n";
    const std::string statements = check();
    text_ += fmt::format("\nstatic int fails(void) {{\n{}}}\n", statements);
    main_function();
    return std::move(text_);
  }

 private:
  bool production() const { return program_.context == "production"; }
  bool on_windows() const { return program_.context == "wgl"; }
  bool is_full() const { return program_.style == CStyle::kFull; }
  bool checks_written_elements() const {
    return program_.check && program_.check->answer.kind == Answer::Kind::kWritten;
  }

  // --- the short styles ---

  // Returns the kind of the context that the test asks for with its first command; 0 if it does not.
  GLuint first_kind() const {
    const Command* const first = commands_.empty() ? nullptr : commands_.data();
    if (!first || first->entry != EntryPoint::ContextOfKindEVALCTS) return 0;
    return static_cast<GLuint>(std::get<std::int64_t>(first->arguments.at(1)));
  }

  // Throws NoCProgram if the case needs the full style.
  void reject_what_needs_the_full_style() const {
    const Check* const check = program_.check;
    for (std::size_t i = 0; i < commands_.size(); ++i) {
      const EntryPoint entry = commands_[i].entry;
      if (name_of(entry).ends_with("EVALCTS") && !(i == 0 && entry == EntryPoint::ContextOfKindEVALCTS))
        throw NoCProgram("the case uses several contexts");
      for (const Value& value : commands_[i].arguments)
        if (const auto* const input = std::get_if<Input>(&value))
          if (input->after == AfterCall::kUnmap || input->after == AfterCall::kProtect)
            throw NoCProgram("the case makes client arrays inaccessible");
    }
    if (check && check->rule == Check::Rule::kHasCommands) throw NoCProgram("a command is missing");
    if (check && (check->answer.kind == Answer::Kind::kEmittedValue ||
                  check->answer.kind == Answer::Kind::kEmittedVertices))
      throw NoCProgram("the vertices come from a sink");
  }

  // Omits a capture's commands that check its own success, read or count what the check does not need, and
  // save time.
  void omit_dispensable(std::size_t first_own, std::size_t own) {
    using E = EntryPoint;
    for (const std::set<E>& together : {std::set{E::GetError},
                                        {E::GetProgramiv},
                                        {E::GetBufferSubData},
                                        {E::GenQueries, E::BeginQuery, E::EndQuery, E::GetQueryObjectuiv}}) {
      std::set<std::size_t> found;
      for (std::size_t i = 0; i < commands_.size(); ++i)
        if ((i < first_own || i >= first_own + own) && together.contains(commands_[i].entry)) found.insert(i);
      if (std::ranges::none_of(found, [&](std::size_t i) { return is_checked(i); })) omitted_.merge(found);
    }
    for (std::size_t i = 0; i < first_own; ++i) {
      const auto* const argument = commands_[i].entry == E::Enable
                                       ? std::get_if<std::int64_t>(&commands_[i].arguments.front())
                                       : nullptr;
      if (argument && *argument == GL_RASTERIZER_DISCARD) omitted_.insert(i);
    }
  }

  // If the check asks for the answer of one of the test's commands, omits the commands behind it, and the
  // queries before it on which nothing depends, but not the command whose error it asks for.
  void omit_other_questions(std::size_t first_own, std::size_t own) {
    const Check* const check = program_.check;
    if (!check || check->rule != Check::Rule::kWithin) return;
    const Answer::Kind kind = check->answer.kind;
    if (kind != Answer::Kind::kReturned && kind != Answer::Kind::kElement && kind != Answer::Kind::kWritten)
      return;
    const auto checked = static_cast<std::size_t>(check->answer.command.index);
    if (checked < first_own || checked >= first_own + own) return;
    for (std::size_t i = checked + 1; i < commands_.size(); ++i) omitted_.insert(i);
    const std::size_t end = check->answer.is_error ? std::max(checked, first_own + 1) - 1 : checked;
    for (std::size_t i = first_own; i < end; ++i) {
      const std::string_view name = name_of(commands_[i].entry);
      const bool is_query = (name.starts_with("glGet") && name != "glGetError") || name == "glIsEnabled";
      if (is_query && !kept_.contains(static_cast<int>(i))) omitted_.insert(i);
    }
  }

  // Returns true if the check depends on the answer of a command.
  bool is_checked(std::size_t index) const {
    const int i = static_cast<int>(index);
    const Check* const check = program_.check;
    return check && (check->answer.command.index == i || check->other.index == i ||
                     std::ranges::any_of(check->recorded, [i](Ref ref) { return ref.index == i; }));
  }

  // Writes the commands from `first` on as lines of a function.
  void body(std::size_t first, std::size_t count) {
    std::vector<std::string> lines;
    for (std::size_t i = first; i < first + count; ++i) {
      if (omitted_.contains(i)) continue;
      for (std::string& statement : statements(i)) lines.push_back(std::move(statement));
    }
    for (const std::string& statement : with_loops(lines)) line("  {}", statement);
  }

  std::string write_short() {
    reject_what_needs_the_full_style();
    const CFrame frame = c_frame(program_, first_kind(), program_.check && program_.check->answer.is_error);
    const bool all_own = program_.own == SIZE_MAX;
    const std::size_t first = all_own ? 0 : program_.first_own;
    const std::size_t own = all_own ? commands_.size() : program_.own;
    omit_dispensable(first, own);
    omit_other_questions(first, own);
    own_ = {first, first + own};
    name_variables();
    variables();
    if (!text_.empty()) text_ += "\n";
    line("static void draw(void) {{");
    body(first, own);
    text_ += "}\n";
    const std::string statements = check();  // and its declarations
    text_ += frame.main;
    body(0, first);
    line("  draw();");
    body(first + own, commands_.size() - first - own);
    text_ += statements + "}\n";
    std::string head = frame.headers;
    const bool needs_headers = program_.style != CStyle::kPiglit;  // piglit's header includes them
    for (const auto& [word, header] : {std::pair{"NAN", "math.h"},
                                       {"INFINITY", "math.h"},
                                       {"memcmp(", "string.h"},
                                       {"memset(", "string.h"}})
      if (needs_headers && text_.find(word) != std::string::npos && head.find(header) == std::string::npos)
        head += fmt::format("#include <{}>\n", header);
    return head + "\n" + (program_.style == CStyle::kPiglit ? in_layout_of_piglit(text_) : text_);
  }

  template <class... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    text_ += fmt::format(format, std::forward<T>(values)...) + "\n";
  }

  void headers() {
    if (on_windows()) {
      text_ += kOnWindows;
    } else {
      posix_headers();
    }
    text_ +=
        "\n#define GL_GLEXT_PROTOTYPES 1 /* for the types only */\n#include <GL/gl.h>\n#include "
        "<GL/glext.h>\n";
    if (production()) text_ += "#include <glevaluator.h>\n";
    text_ += "\nenum { MOST_CONTEXTS = 8 };\n";
  }
  void posix_headers() {
    text_ += "#ifndef _GNU_SOURCE\n#define _GNU_SOURCE\n#endif\n";
    for (const char* header :
         {"dlfcn.h", "math.h", "signal.h", "stdio.h", "stdlib.h", "string.h", "sys/mman.h", "unistd.h"})
      line("#include <{}>", header);
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

  bool is_own(std::size_t index) const { return index >= own_.first && index < own_.second; }

  // Chooses the names of variables for a short style.
  void name_variables() {
    std::map<std::string, int> uses;
    for (std::size_t i = 0; i < commands_.size(); ++i) {
      const char* const name = variable_of(commands_[i].entry);
      if (!name || omitted_.contains(i) || (returns_value(commands_[i].entry) && !keeps(i))) continue;
      const int use = ++uses[name];
      names_[static_cast<int>(i)] = use == 1 ? name : fmt::format("{}{}", name, use);
    }
  }

  // Return the names of the variables for the result of a command, its array, and an element of the array.
  std::string result_name(int command) const {
    const auto name = names_.find(command);
    return name != names_.end() ? name->second : fmt::format("result_{}", command);
  }
  std::string array_name(int command) const {
    const auto name = names_.find(command);
    return name != names_.end() ? name->second : fmt::format("array_{}", command);
  }
  std::string element_name(int command, std::size_t element) const {
    return is_scalar(command) ? array_name(command) : fmt::format("{}[{}]", array_name(command), element);
  }

  // Returns true if a variable of the capture stands for an array of one element.
  bool is_scalar(int command) const {
    const Output* const output = output_of(commands_.at(static_cast<std::size_t>(command)));
    return output && output->count == 1 && names_.contains(command) && !checks_written_elements() &&
           !(program_.check && compares_arrays(*program_.check));
  }

  // Writes the arrays that commands fill, and the results that later commands or the check use.
  void variables() {
    std::map<std::string, std::vector<std::string>> by_type;
    for (std::size_t i = 0; i < commands_.size(); ++i) {
      if (omitted_.contains(i)) continue;
      const EntryPoint entry = commands_[i].entry;
      if (const Output* output = output_of(commands_[i])) {
        const bool is_guarded = is_full() || checks_written_elements();
        const std::string name = array_name(static_cast<int>(i));
        by_type[std::string("static ") + c_type(output->type) + " "].push_back(
            is_scalar(static_cast<int>(i))
                ? name
                : fmt::format(
                      "{}[{}]", name,
                      is_guarded ? output->count + kGuardElements : std::max<std::size_t>(output->count, 1)));
      }
      if (!keeps(i) || is_declared_by_its_call(i)) continue;
      const std::string name = result_name(static_cast<int>(i));
      if (entry == EntryPoint::GetString || entry == EntryPoint::GetStringi)
        by_type["static const GLubyte "].push_back("*" + name);
      else
        by_type[is_full() ? "static long long " : std::string("static ") + type_of_result(entry)].push_back(
            name);
    }
    for (const auto& [type, names] : by_type) line("{}{};", type, fmt::join(names, ", "));
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

  // Returns true for a result in the main function of a short style.
  bool is_declared_by_its_call(std::size_t index) const { return !is_full() && !is_own(index); }

  // Returns the statements for one command.
  std::vector<std::string> statements(std::size_t index) {
    const Command& command = commands_[index];
    if (!is_full() && command.entry == EntryPoint::ContextOfKindEVALCTS) return {};  // the frame makes it
    std::vector<std::string> lines, after_call;
    std::map<std::size_t, std::string> texts;  // of arguments, by position
    const int at = static_cast<int>(index);
    for (std::size_t i = 0; i < command.arguments.size(); ++i) {
      if (std::holds_alternative<Output>(command.arguments[i])) {
        if (is_full() || checks_written_elements())
          lines.push_back(fmt::format("memset({0}, 0xA5, sizeof {0});", array_name(at)));
        texts[i] = (is_scalar(at) ? "&" : "") + array_name(at);
      }
      if (const auto* result = std::get_if<ResultOf>(&command.arguments[i]))
        texts[i] = result->element < 0
                       ? result_name(result->command)
                       : element_name(result->command, static_cast<std::size_t>(result->element));
      const auto* input = std::get_if<Input>(&command.arguments[i]);
      if (!input) continue;
      const std::string name = fmt::format("in_{}{}", index, i == 0 ? "" : fmt::format("_{}", i));
      if (is_full()) {
        const std::string array = placed(*input, name, lines);
        texts[i] = array + ".start";
        after_call.push_back(treatment(array, input->after));
      } else if (input->after == AfterCall::kOverwrite) {
        lines.push_back(
            fmt::format("static {} {}[] = {{{}}};", c_type(input->type), name, elements_of(*input)));
        texts[i] = name;
        after_call.push_back(
            fmt::format("memset({0}, 0x4B, sizeof {0}); /* overwritten after the call */", name));
      }
    }
    const char* const declared = is_declared_by_its_call(index) ? type_of_result(command.entry) : "";
    lines.push_back(
        (keeps(index) ? fmt::format("{}{} = ", declared, result_name(at)) : "") +
        to_c(command, [&](std::size_t i) { return texts.contains(i) ? texts[i] : std::string(); }));
    for (std::string& statement : after_call)
      if (!statement.empty()) lines.push_back(std::move(statement));
    return lines;
  }

  static std::string treatment(const std::string& array, AfterCall after) {
    switch (after) {
      case AfterCall::kKeep:
        break;
      case AfterCall::kOverwrite:
        return fmt::format("memset({0}.start, 0x4B, {0}.size); /* overwritten after the call */", array);
      case AfterCall::kUnmap:
        return fmt::format(
            "munmap({0}.base, {0}.usable + (size_t)sysconf(_SC_PAGESIZE)); /* unmapped after the call */",
            array);
      case AfterCall::kProtect:
        return fmt::format("mprotect({0}.base, {0}.usable, PROT_NONE); /* protected after the call */",
                           array);
    }
    return {};
  }

  // Adds the statements that place a client array, and returns its name. Arrays with the same slot and size
  // share their memory.
  std::string placed(const Input& input, const std::string& name, std::vector<std::string>& lines) {
    const std::string bytes = input.bytes.empty() ? std::string("NULL") : literal_of(input);
    if (input.slot >= 0) {
      const auto [found, is_new] = slots_.try_emplace({input.slot, input.bytes.size()}, name);
      if (!is_new) {
        if (!input.bytes.empty())
          lines.push_back(fmt::format("memcpy({}.start, {}, {});", found->second, bytes, input.bytes.size()));
        return found->second;
      }
    }
    lines.push_back(fmt::format("struct array {} = place({}, {});", name, bytes, input.bytes.size()));
    return name;
  }

  // --- the verdict ---

  // Writes the declarations of the check, and returns its statements, which end with a return.
  std::string check() {
    std::string statements;
    std::swap(text_, statements);  // line() writes to text_
    const Check* const check = program_.check;
    if (!check || check->rule == Check::Rule::kHasCommands) {
      line("  puts(\"all commands came back: the failure does not show\");");
      end_check("1");
    } else if (check->rule == Check::Rule::kWithin) {
      check_within(*check);
    } else if (check->rule == Check::Rule::kSame) {
      check_same(*check);
    } else {
      check_unlike(*check);
    }
    std::swap(text_, statements);
    text_ += std::exchange(declarations_, "");
    return statements;
  }

  // Writes the end of the check: `holds` and `fails` are C expressions. `fails` may be empty: not `holds`.
  void end_check(const std::string& holds, const std::string& fails = "") {
    if (!is_full())
      return line("  {}", return_of(program_.style, !fails.empty() ? fails
                                                    : holds == "1" ? "0"
                                                                   : fmt::format("!({})", holds)));
    if (holds == "1") return line("  return 0;");
    line("  const int holds = {};", holds);
    line("  puts(holds ? \"the failure does not show\" : \"the failure shows\");");
    line("  return !holds;");
  }

  // Writes a line that prints what was expected and what was got. `format`: conversion of `got`.
  void print_outcome(const std::string& subject, const std::string& expected, const std::string& format,
                     const std::string& got) {
    std::string text = fmt::format("{}: expected {}, got ", subject, expected);
    for (std::size_t at = text.find('%'); at != std::string::npos; at = text.find('%', at + 2))
      text.insert(at, 1, '%');
    line("  printf({}, {});", quoted(text + format + "\n"), got);
  }

  std::string answer_text(const Answer& answer) {
    const int command = answer.command.index;
    switch (answer.kind) {
      case Answer::Kind::kReturned:
        return result_name(command);
      case Answer::Kind::kElement:
        return element_name(command, answer.element);
      case Answer::Kind::kWritten:
        declarations_ += fmt::format(
            "\n/* How many elements hold something else than the filler. */\nstatic size_t written(void) {{\n"
            "  size_t bytes = sizeof {0};\n"
            "  while (bytes && ((unsigned char *){0})[bytes - 1] == 0xA5) --bytes;\n"
            "  return (bytes + sizeof *{0} - 1) / sizeof *{0};\n}}\n",
            array_name(command));
        return "written()";
      case Answer::Kind::kLeftOver:
        return "glGetError()";
      case Answer::Kind::kEmittedValue:
        return fmt::format("emitted[{}]", answer.element);
      case Answer::Kind::kEmittedVertices:
        return "emitted_vertices";
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

  void check_within(const Check& check) {
    if (!is_full()) return check_within_in_short(check);
    line("  const double got = (double){};", answer_text(check.answer));
    const std::string what = subject(check), expected = interval(check);
    if (check.answer.is_error) {
      declarations_ += kErrorName;
      print_outcome(what, expected, "%s", "error_name((GLenum)got)");
    } else if (is_whole(check.answer)) {
      print_outcome(what, expected, "%.0f", "got");
    } else {
      print_outcome(what, expected, "%.9g (%a)", "got, got");
    }
    end_check(holds(check, "got", shortest_constant));
  }

  // Returns a C expression that is true if the answer `got` is accepted.
  static std::string holds(const Check& check, const std::string& got, std::string (*constant)(double)) {
    std::string text;
    for (const auto& [low, high] : check.accepted) {
      if (!text.empty()) text += " || ";
      const std::string range = fmt::format("{0} >= {1} && {0} <= {2}", got, constant(low), constant(high));
      text += std::isnan(low)              ? fmt::format("{0} != {0}", got)
              : low == high                ? fmt::format("{} == {}", got, constant(low))
              : check.accepted.size() == 1 ? range
                                           : "(" + range + ")";
    }
    return text.empty() ? "0" : text;
  }

  // Returns the value as a constant of an integer type if C has one of type int or unsigned int.
  static std::string integer_constant(double value) {
    if (value != std::trunc(value) || value <= -2147483648.0 || value > 4294967295.0)
      return c_constant(value);
    return fmt::format("{:.0f}{}", value, value > 2147483647.0 ? "u" : "");
  }

  void check_within_in_short(const Check& check) {
    const Answer& answer = check.answer;
    std::string got = answer_text(answer);
    if (answer.kind == Answer::Kind::kLeftOver) {
      line("  const GLenum left_over = {};", got);
      got = "left_over";
    }
    const std::string what = subject(check), expected = interval(check);
    const bool is_single =
        check.accepted.size() == 1 && check.accepted.front().first == check.accepted.front().second;
    if (answer.is_error) {
      const double error = check.accepted.empty() ? 0 : check.accepted.front().first;
      print_outcome(what, fmt::format("{} (0x{:04X})", expected, static_cast<GLenum>(error)), "0x%04X", got);
      if (is_single && expected.starts_with("GL_"))
        return end_check("", fmt::format("{} != {}", got, expected));
    } else {
      const std::string_view format = format_of(answer);
      print_outcome(what, in_plain_numbers(expected), std::string(format),
                    format == "%lld" ? "(long long)" + got : got);
    }
    const auto constant = is_whole(answer) ? integer_constant : shortest_constant;
    if (is_single) return end_check("", fmt::format("{} != {}", got, constant(check.accepted.front().first)));
    end_check(holds(check, got, constant));
  }

  // Returns the conversion of printf for an answer of a short style.
  const char* format_of(const Answer& answer) const {
    if (answer.kind == Answer::Kind::kWritten) return "%zu";
    const std::size_t command = static_cast<std::size_t>(answer.command.index);
    if (answer.kind == Answer::Kind::kReturned)
      return std::string_view(type_of_result(commands_.at(command).entry)) == "GLint " ? "%d" : "%u";
    const Output* const output =
        answer.kind == Answer::Kind::kElement ? output_of(commands_.at(command)) : nullptr;
    if (!output || output->type == Scalar::kU32) return "%u";
    if (output->type == Scalar::kF32 || output->type == Scalar::kF64) return "%.9g";
    return output->type == Scalar::kI64 ? "%lld" : "%d";
  }

  // Returns the value as a constant of type float if that is exact.
  static std::string shortest_constant(double value) {
    const auto single = static_cast<float>(value);
    return single == value ? c_constant(single) : c_constant(value);
  }

  void check_same(const Check& check) {
    const int a = check.other.index, b = check.answer.command.index;
    const Command& command = commands_.at(static_cast<std::size_t>(b));
    line("  printf(\"%s\\n\", {});", quoted(subject(check) + ", before and now:"));
    std::string holds;
    if (const Output* output = output_of(command)) {
      print_array(a, output->count);
      print_array(b, output->count);
      holds = fmt::format("memcmp({0}, {1}, sizeof {0}) == 0", array_name(a), array_name(b));
    }
    if (keeps(static_cast<std::size_t>(b))) {
      line("  printf(\"%lld\\n%lld\\n\", (long long){}, (long long){});", result_name(a), result_name(b));
      holds += fmt::format("{}{} == {}", holds.empty() ? "" : " && ", result_name(a), result_name(b));
    }
    end_check(holds.empty() ? "1" : holds);
  }

  void print_array(int index, std::size_t count) {
    line(
        "  for (size_t i = 0; i < {}; ++i) printf(\"%s%.9g\", i ? \" \" : \"  \", (double){}[i]);\n  "
        "puts(\"\");",
        count, array_name(index));
  }

  // Returns the recorded elements of an array, without those at its end that the command did not write.
  Input recorded_answer(Ref ref, const Output& output) const {
    Input recorded{.type = output.type, .bytes = program_.trace->bytes(ref)};
    const std::size_t size = size_of(output.type);
    recorded.bytes.resize(output.count * size);
    const auto is_filler = [](std::byte byte) { return byte == std::byte{0xA5}; };
    while (!recorded.bytes.empty() && std::all_of(recorded.bytes.end() - static_cast<std::ptrdiff_t>(size),
                                                  recorded.bytes.end(), is_filler))
      recorded.bytes.resize(recorded.bytes.size() - size);
    return recorded;
  }

  // Returns true if the check compares arrays, byte by byte.
  bool compares_arrays(const Check& check) const {
    return check.rule == Check::Rule::kSame || (check.rule == Check::Rule::kUnlike && !only_integer(check));
  }

  // Returns the recorded answer if the check depends on one integer.
  std::optional<double> only_integer(const Check& check) const {
    if (check.recorded.size() != 1) return std::nullopt;
    const Ref ref = check.recorded.front();
    const Output* const output = output_of(commands_.at(static_cast<std::size_t>(ref.index)));
    if (!output)
      return keeps(static_cast<std::size_t>(ref.index)) ? std::optional<double>(program_.trace->result(ref))
                                                        : std::nullopt;
    if (output->count != 1 || output->type != Scalar::kU32) return std::nullopt;
    return program_.trace->values<std::uint32_t>(ref)[0];
  }

  // Writes the check for a test that compares answers by itself: the program fails if all answers equal
  // the recorded ones.
  void check_unlike(const Check& check) {
    if (const std::optional<double> number = only_integer(check)) {
      const Ref ref = check.recorded.front();
      const bool is_array = output_of(commands_.at(static_cast<std::size_t>(ref.index))) != nullptr;
      const std::string got = is_array ? element_name(ref.index, 0) : result_name(ref.index);
      if (!is_full()) {
        print_outcome(subject(check), check.expected,
                      format_of({is_array ? Answer::Kind::kElement : Answer::Kind::kReturned, ref}), got);
        return end_check("", fmt::format("{} == {}", got, integer_constant(*number)));
      }
      line("  const double got = {};", got);
      print_outcome(subject(check), check.expected, "%.0f", "got");
      return end_check(fmt::format("got != {}", c_constant(*number)));
    }
    std::string same;
    for (const Ref ref : check.recorded) {
      const Command& command = commands_.at(static_cast<std::size_t>(ref.index));
      if (const Output* output = output_of(command)) {
        const Input recorded = recorded_answer(ref, *output);
        if (recorded.bytes.empty()) continue;
        declarations_ += fmt::format("static const {} recorded_{}[] = {{{}}};\n", c_type(recorded.type),
                                     ref.index, elements_of(recorded));
        same += fmt::format("{0}memcmp({1}, recorded_{2}, sizeof recorded_{2}) == 0",
                            same.empty() ? "" : " && ", array_name(ref.index), ref.index);
      } else if (keeps(static_cast<std::size_t>(ref.index))) {
        same += fmt::format("{}{} == {}LL", same.empty() ? "" : " && ", result_name(ref.index),
                            program_.trace->result(ref));
      }
    }
    if (declarations_.starts_with("static")) declarations_.insert(0, "\n");
    line("  /* The test compares several values; the failure shows if the answers are those recorded. */");
    line("  puts({});", quoted(fmt::format("{}: expected {}", subject(check), check.expected)));
    for (const Ref ref : check.recorded) {
      const Output* output = output_of(commands_.at(static_cast<std::size_t>(ref.index)));
      if (output) print_array(ref.index, std::min<std::size_t>(output->count, 64));
    }
    // If there are no answers to compare, the program only makes the calls.
    end_check(same.empty() ? "1" : fmt::format("!({})", same));
  }

  void main_function() {
    text_ += kDied;
    text_ +=
        "\nint main(int argc, char **argv) {\n"
        "  static const int deadly[] = {SIGSEGV, SIGFPE, SIGILL, SIGABRT";
    text_ += on_windows() ? "" : ", SIGBUS, SIGALRM";
    text_ +=
        "};\n  for (size_t i = 0; i < sizeof deadly / sizeof *deadly; ++i) signal(deadly[i], died);\n"
        "#ifdef SECONDS\n  alarm(SECONDS);\n#endif\n";
    if (production()) {
      text_ += "  (void)argc, (void)argv;\n  make_context();\n";
    } else {
      line("  make_context(argc > 1 ? argv[1] : {});\n  load();", quoted(program_.library));
    }
    text_ +=
        "  draw();\n  const int result = fails();\n  fflush(stdout);\n  _exit(result); /* not through what "
        "the library left behind */\n}\n";
  }

  const CProgram& program_;
  const std::vector<Command>& commands_;
  std::set<int> kept_;
  std::set<std::size_t> omitted_;                            // commands that are not written
  std::pair<std::size_t, std::size_t> own_ = {0, SIZE_MAX};  // the commands of draw() in a short style
  std::map<int, std::string> names_;                         // of variables, by command
  std::map<std::pair<int, std::size_t>, std::string> slots_;
  std::string text_, declarations_;
};

}  // namespace

std::optional<CStyle> c_style_named(std::string_view name) {
  if (name == "short") return CStyle::kShort;
  if (name == "full") return CStyle::kFull;
  if (name == "piglit") return CStyle::kPiglit;
  return std::nullopt;
}

std::string to_c(const CProgram& program) { return Writer(program).write(); }

std::string to_c(const CProgram& program, const std::vector<std::string>& statements,
                 const std::string& fails, GLuint kind) {
  const bool has_errors = std::ranges::any_of(statements, [](const std::string& statement) {
    return statement.find("glGetError") != std::string::npos;
  });
  const CFrame frame = c_frame(program, kind, has_errors);
  std::string text = frame.main;
  const bool dies = fails.empty(), is_piglit = program.style == CStyle::kPiglit;
  if (dies && !is_piglit) text += "  fflush(stdout);\n";
  for (const std::string& statement : statements) text += "  " + statement + "\n";
  text += fmt::format("  {}\n}}\n", return_of(program.style, dies ? "0" : fails));
  return frame.headers + (is_piglit ? in_layout_of_piglit(text) : text);
}

}  // namespace evalcts::gl
