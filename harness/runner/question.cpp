// Starts the suite program for a question, such as the list of its tests, and waits for the answer in a
// temporary file.
#include <evalcts/runner/question.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include <evalcts/backends/gl_environment.h>
#include <evalcts/results/files.h>
#include <evalcts/runner/interruption.h>

namespace evalcts {
namespace {

namespace fs = std::filesystem;

constexpr double kSecondsBetweenLooks = 0.02;  // interval at which the process is checked
constexpr double kPatience = 60;               // maximum time for an answer, in seconds
constexpr std::size_t kMostQuotedLines = 3;
constexpr char kCannotStartLine[] = "cannot start: ";  // suite_main prints the reason in such a line, too

// Creates an empty file in the folder for temporary files.
fs::path temporary_file() {
  std::string name = (fs::temp_directory_path() / "evalcts-answer-XXXXXX").string();
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0) throw std::runtime_error("cannot make a temporary file");
  close(descriptor);
  return name;
}

}  // namespace

Question::Question(std::vector<std::string> command, const fs::path& log, std::uint64_t memory)
    : answer_file_(temporary_file()), log_(log), memory_(memory) {
  command.insert(command.end(), {"--die-with-parent", "--answer", answer_file_.string()});
  child_.emplace(command, log.string(), ChildProcess::Prints::kLimited);
}

Question::~Question() {
  std::error_code ignored;
  fs::remove(answer_file_, ignored);
}

std::optional<std::string> Question::wait(std::string& reason) {
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  };
  std::optional<Ending> ending;
  bool is_too_large = false;
  while (!(ending = child_->wait(kSecondsBetweenLooks)) && !interrupted && !is_too_large &&
         seconds() < kPatience)
    is_too_large = memory_ != 0 && child_->memory() > memory_;
  if (!ending) {
    child_->kill();
    reason = interrupted    ? "interrupted"
             : is_too_large ? fmt::format("it used more than {} MiB of memory", memory_ >> 20)
                            : fmt::format("no answer within {} seconds", kPatience);
    return std::nullopt;
  }
  ending_ = *ending;
  std::string text = read_file(answer_file_);
  if (!ending->signalled && ending->value == 0) return text;
  const std::optional<std::string> why_not = parse_cannot_start(text);
  reason = why_not ? *why_not + quote_output() : how_it_ended();
  return std::nullopt;
}

std::string Question::how_it_ended() const {
  return fmt::format("the process that loads the library ended with {}{}{}{}", describe(ending_),
                     describe_gl_environment(), log_.empty() ? "" : "; see " + log_.string(), quote_output());
}

// Returns a clause with the first different lines that a library printed before it failed to start, and the
// name of the log with all of them; empty if it printed none.
std::string Question::quote_output() const {
  std::vector<std::string> lines;
  std::istringstream stream(child_->printed());
  for (std::string line; std::getline(stream, line);)
    if (!line.empty() && !line.starts_with(kCannotStartLine) && std::ranges::count(lines, line) == 0)
      lines.push_back(line);
  if (lines.empty() || log_.empty()) return {};
  if (lines.size() > kMostQuotedLines) lines.resize(kMostQuotedLines);
  return fmt::format("; the library printed \"{}\" (all of its output is in {})", fmt::join(lines, " | "),
                     log_.string());
}

std::optional<Description> describe_implementation(const std::vector<std::string>& suite_command,
                                                   std::string& reason) {
  std::vector<std::string> command = suite_command;
  command.push_back("--describe");
  return Question(command).answer(parse_description, reason);
}

std::vector<ListedTest> list_tests(const fs::path& suite_program) {
  std::string reason;
  std::optional<std::vector<ListedTest>> tests =
      Question({suite_program.string(), "--list"}).answer(parse_tests, reason);
  if (!tests)
    throw std::runtime_error(fmt::format("{} does not list its tests ({})", suite_program.string(), reason));
  return *std::move(tests);
}

}  // namespace evalcts
