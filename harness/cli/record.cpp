// `evalcts record`: runs a program with the recorder in front of its GL, and says what was recorded.
#include <elf.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <numeric>
#include <string_view>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/recordings.h>
#include <evalcts/record/programs.h>
#include <evalcts/record/recording.h>
#include <evalcts/results/text.h>

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;
using record::Counted;
using record::Recording;

struct RecordOptions {
  std::string output = "recording.evalrec";
  std::string limit = "1024";  // MiB
  std::string frames;          // "A..B" or "A"; empty: all
  std::vector<std::string> program;
};

// Returns the first few of the counted commands: "glEvalCoord1f 300, glEnd 2".
std::string first_counts(const std::vector<Counted>& commands) {
  constexpr std::size_t kMostNamed = 8;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(commands.size(), kMostNamed); ++i)
    texts.push_back(fmt::format("{} {}", commands[i].name, commands[i].times));
  if (commands.size() > kMostNamed) texts.push_back(fmt::format("{} more", commands.size() - kMostNamed));
  return fmt::format("{}", fmt::join(texts, ", "));
}

// Returns the path of the program as the shell finds it; an empty path if there is none.
fs::path find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) return fs::exists(name) ? fs::path(name) : fs::path();
  const char* const folders = std::getenv("PATH");
  std::istringstream list(folders ? folders : "/usr/bin:/bin");
  for (std::string folder; std::getline(list, folder, ':');)
    if (const fs::path file = fs::path(folder.empty() ? "." : folder) / name; access(file.c_str(), X_OK) == 0)
      return file;
  return {};
}

// Returns the reason why the dynamic linker does not load the recorder into the program; empty if there is
// none.
std::string why_not_preloaded(const fs::path& program) {
  struct stat status {};
  if (stat(program.c_str(), &status) == 0 && (status.st_mode & (S_ISUID | S_ISGID)) != 0)
    return "is setuid or setgid, and the dynamic linker ignores LD_PRELOAD then; record a copy of it without "
           "that bit";
  std::ifstream file(program, std::ios::binary);
  const std::string begin(std::istreambuf_iterator<char>(file), {});
  Elf64_Ehdr header{}, own{};
  std::ifstream("/proc/self/exe", std::ios::binary).read(reinterpret_cast<char*>(&own), sizeof own);
  if (begin.size() < sizeof header || !begin.starts_with(ELFMAG)) return {};
  std::memcpy(&header, begin.data(), sizeof header);
  if (header.e_ident[EI_CLASS] != own.e_ident[EI_CLASS] || header.e_machine != own.e_machine)
    return "is for another architecture than this evalcts; build evalcts for the same one";
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment{};
    const std::uint64_t place = header.e_phoff + std::uint64_t{i} * header.e_phentsize;
    if (place + sizeof segment > begin.size()) return {};
    std::memcpy(&segment, begin.data() + place, sizeof segment);
    if (segment.p_type == PT_INTERP) return {};
  }
  return "is statically linked, and nothing can be loaded in front of its GL; link it dynamically";
}

// Returns the names of the recordings of a run, which exist: FILE, FILE.2, FILE.3 and so on.
std::vector<fs::path> recordings_of(const fs::path& file) {
  std::vector<fs::path> all;
  for (int i = 1;; ++i) {
    const fs::path name = i == 1 ? file : fs::path(fmt::format("{}.{}", file.string(), i));
    if (i > 1 && !record::is_recording(name)) return all;
    if (record::is_recording(name)) all.push_back(name);
  }
}

volatile std::sig_atomic_t child = 0;

void pass_on(int signal) {
  if (child > 0) kill(child, signal);
}

// Runs the program, and returns its status as of waitpid. Returns -1 after a message if it does not start.
int run_program(const RecordOptions& options, const fs::path& file, const fs::path& library) {
  // This process has changed its environment.
  std::vector<std::string> variables;
  std::ifstream environment("/proc/self/environ", std::ios::binary);
  std::string preload = library.string();
  for (std::string each; std::getline(environment, each, '\0');)
    if (constexpr std::string_view kPreload = "LD_PRELOAD="; each.starts_with(kPreload))
      preload += ":" + each.substr(kPreload.size());
    else if (!each.starts_with("EVALCTS_RECORD") && !each.starts_with("EVALCTS_LAUNCHER="))
      variables.push_back(each);
  variables.push_back("LD_PRELOAD=" + preload);
  variables.push_back("EVALCTS_RECORD=" + file.string());
  variables.push_back(
      fmt::format("EVALCTS_RECORD_LIMIT={}", static_cast<std::uint64_t>(std::stod(options.limit) * 1048576)));
  if (const auto frames = record::parse_frames(options.frames))
    variables.push_back(fmt::format("EVALCTS_RECORD_FRAMES={}..{}", frames->first, frames->last));
  const auto pointers = [](std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& text : texts) all.push_back(text.data());
    all.push_back(nullptr);
    return all;
  };
  std::vector<std::string> arguments = options.program;
  // The terminal sends these to the program as well.
  for (const int signal : {SIGINT, SIGQUIT}) std::signal(signal, SIG_IGN);
  // Signals that come before there is a program wait until it is known.
  sigset_t defaults, waiting, before;
  sigemptyset(&defaults);
  for (const int signal : {SIGINT, SIGQUIT, SIGTERM, SIGHUP}) sigaddset(&defaults, signal);
  sigemptyset(&waiting);
  for (const int signal : {SIGTERM, SIGHUP}) sigaddset(&waiting, signal);
  sigprocmask(SIG_BLOCK, &waiting, &before);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setsigmask(&attributes, &before);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  pid_t started = -1;
  const int error = posix_spawnp(&started, arguments[0].c_str(), nullptr, &attributes,
                                 pointers(arguments).data(), pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  if (error == 0) {
    child = started;
    for (const int signal : {SIGTERM, SIGHUP}) std::signal(signal, pass_on);
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  if (error != 0) {
    wrong_use(fmt::format("cannot start '{}': {}", arguments[0], std::strerror(error)));
    return -1;
  }
  int status = 0;
  while (waitpid(started, &status, 0) < 0 && errno == EINTR) {
  }
  child = 0;
  return status;
}

}  // namespace

std::string check_frames(const std::string& text) {
  return record::parse_frames(text) ? "" : "'" + text + "' is not A..B or A with 0 <= A <= B";
}

bool is_of_evaluators(const Counted& command) {
  return std::ranges::any_of(std::initializer_list<const char*>{"glMap", "glEval", "glGetMap", "glGetnMap"},
                             [&](const char* prefix) { return command.name.starts_with(prefix); });
}

std::string summary_of(const fs::path& file, const Recording& recording) {
  std::vector<Counted> evaluators, others;
  for (const Counted& command : recording.commands())
    (is_of_evaluators(command) ? evaluators : others).push_back(command);
  const auto line = [](const std::vector<Counted>& commands, const std::string& noun, const char* end = "") {
    if (commands.empty()) return std::string();
    const auto times =
        std::accumulate(commands.begin(), commands.end(), std::uint64_t{0},
                        [](std::uint64_t sum, const Counted& each) { return sum + each.times; });
    return fmt::format("  {}{}: {}\n", count(times, noun), end, first_counts(commands));
  };
  std::string text = fmt::format("{}: {:.1f} MiB, {}, {}\n", file.string(),
                                 static_cast<double>(fs::file_size(file)) / 1048576,
                                 count(recording.frames(), "frame"), count(recording.contexts(), "context"));
  text += line(evaluators, "evaluator command") + line(others, "other command") +
          line(recording.others(), "command", " only counted");
  return recording.problem().empty() ? text : text + "  " + recording.problem() + "\n";
}

namespace {

// Returns what was seen instead of evaluators, and what to do.
std::string why_nothing(const RecordOptions& options, std::vector<Counted> seen) {
  std::ranges::stable_sort(seen, std::greater(), &Counted::times);
  const std::string name = "'" + clean(options.program[0]) + "'";
  if (!seen.empty())
    return fmt::format("{} called no evaluator command, so there is no recording; it called {}", name,
                       first_counts(seen));
  if (const std::string why = why_not_preloaded(find_program(options.program[0])); !why.empty())
    return fmt::format("nothing was recorded: {} {}", name, why);
  return fmt::format(
      "nothing was recorded: {} called no command of an OpenGL with evaluators. If it is a script or starts "
      "another "
      "program, check that this one is dynamically linked and does not clear LD_PRELOAD; contexts of OpenGL "
      "ES and of the "
      "core profile have no evaluators",
      name);
}

int record_program(const RecordOptions& options) {
  const fs::path library = places().recorder, file = fs::absolute(options.output).lexically_normal();
  if (!fs::exists(library))
    return wrong_use(fmt::format("the recorder is missing: no file '{}'", library.string()));
  if (library.string().find_first_of(" :") != std::string::npos)
    return wrong_use(fmt::format(
        "LD_PRELOAD cannot name '{}'; move evalcts to a path without spaces and colons", library.string()));
  if (fs::exists(file) && !fs::is_regular_file(file))
    return wrong_use(fmt::format("--output '{}': not a regular file", options.output));
  if (access(file.parent_path().c_str(), W_OK) != 0)
    return wrong_use(
        fmt::format("--output '{}': cannot write there: {}", options.output, std::strerror(errno)));
  const std::vector<fs::path> earlier = recordings_of(file);
  std::for_each(earlier.begin(), earlier.end(), [](const fs::path& each) { fs::remove(each); });
  fs::remove(file);
  const int status = run_program(options, file, library);
  if (status < 0) return kWrongUse;
  if (WIFSIGNALED(status))
    std::cerr << fmt::format("evalcts: the program ended by signal {} ({})\n", WTERMSIG(status),
                             strsignal(WTERMSIG(status)));
  else if (WEXITSTATUS(status) != 0)
    std::cerr << fmt::format("evalcts: the program ended with exit status {}\n", WEXITSTATUS(status));
  // A process without evaluators, such as one that asks for the version of the GL, needs no file.
  std::vector<Counted> seen;
  int kept = 0;
  for (const fs::path& each : recordings_of(file)) {
    fs::path name = each;
    try {
      const Recording recording(each);
      if (std::ranges::none_of(recording.commands(), is_of_evaluators)) {
        for (const auto* commands : {&recording.commands(), &recording.others()})
          seen.insert(seen.end(), commands->begin(), commands->end());
        fs::remove(each);
        continue;
      }
      ++kept;
      name = kept == 1 ? file : fs::path(fmt::format("{}.{}", file.string(), kept));
      if (name != each) fs::rename(each, name);
      std::cout << "recorded " << summary_of(name, recording);
    } catch (const record::BadRecording& error) {
      std::cerr << "evalcts: " << error.what() << "\n";
    }
  }
  return kept > 0 ? kNothingUnexpected : wrong_use(why_nothing(options, seen));
}

std::function<int()> define_record(CLI::App& app, const Call&) {
  const auto options = std::make_shared<RecordOptions>();
  app.add_option("program", options->program,
                 "the program and its arguments; what is behind its name belongs to it")
      ->required();
  app.positionals_at_end();
  app.add_option("-o,--output", options->output,
                 "file to write (default: recording.evalrec); it is overwritten");
  app.add_option("--limit", options->limit,
                 "largest size of the file in MiB, at which the recording ends (default: 1024)")
      ->check(positive_number);
  app.add_option(
         "--frames", options->frames,
         "record drawing and queries in these frames only, as A..B or A, from 0; state is always recorded")
      ->check(check_frames);
  return [options] { return record_program(*options); };
}

}  // namespace

const Command kRecordCommand = {
    "record", "run a program, and record the evaluator commands that it calls, to judge them with check",
    R"(  $ evalcts record glxgears
  $ evalcts record -o game.evalrec --frames 100..110 -- ./game --level 3
  $ evalcts check game.evalrec --implementation osmesa)",
    define_record};

}  // namespace evalcts::cli
