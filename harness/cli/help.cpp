// Formats --help, and suggests the word with the smallest edit distance for a mistyped one.
#include "help.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "wrap.h"

namespace evalcts::cli {
namespace {

// Returns the restricted Damerau-Levenshtein distance (optimal string alignment).
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      cost[i][j] =
          std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[a.size()][b.size()];
}

constexpr std::size_t kLongestWord = 64;

// Returns " TEXT", " INT" or " {quick,full}", the type of a value or the accepted words, without the range of
// a number; empty for a flag.
std::string type_shown(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  if (option.get_type_size() == 0 || type.empty()) return {};
  return " " + (colon != std::string::npos && type[colon + 1] == '{' ? type.substr(colon + 1)
                                                                     : type.substr(0, colon));
}

// Returns a line of the help, such as "  --seed UINT    seed of the random tests".
std::string row(const std::string& name, const std::string& description) {
  constexpr std::size_t kColumn = 30, kColumns = 100;
  std::string line = "  " + name;
  if (description.empty()) return line + "\n";
  line +=
      line.size() + 2 > kColumn ? "\n" + std::string(kColumn, ' ') : std::string(kColumn - line.size(), ' ');
  return line + wrapped(description, kColumns, std::string(kColumn, ' '), kColumn) + "\n";
}

// Formats the help in the form that help2man reads, equally with every version of CLI11.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
    std::string usage = "Usage: " + name + " [OPTIONS]", positionals, options, commands;
    for (const CLI::Option* option : app->get_options(std::function<bool(const CLI::Option*)>())) {
      if (option->get_group().empty()) continue;
      const bool repeats = option->get_expected_max() >= CLI::detail::expected_max_vector_size;
      const std::string value = type_shown(*option) + (repeats ? " ..." : "");
      if (option->get_positional()) {
        const std::string word = option->get_name(true) + (repeats ? "..." : "");
        usage += option->get_required() ? " " + word : " [" + word + "]";
        positionals += row(option->get_name(true) + value, option->get_description());
      } else {
        options += row(option->get_name(false, true) + value, option->get_description());
      }
    }
    for (const CLI::App* command : app->get_subcommands(std::function<bool(const CLI::App*)>()))
      commands += row(command->get_name(), command->get_description());
    std::string text = app->get_description() + "\n" + usage + (commands.empty() ? "\n" : " SUBCOMMAND\n");
    for (const auto& [heading, rows] :
         {std::pair("Positionals", positionals), {"Options", options}, {"Subcommands", commands}})
      if (!rows.empty()) text += std::string("\n") + heading + ":\n" + rows;
    return text + "\n" + app->get_footer() + "\n";
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_formatter() { return std::make_shared<HelpFormatter>(); }

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > kLongestWord) return {};
  std::string best;
  std::size_t least = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (const std::string& candidate : candidates)
    if (const std::size_t cost = distance(word, candidate); cost < least) {
      least = cost;
      best = candidate;
    }
  return best;
}

std::string suggestion(const CLI::App& app, const std::vector<std::string>& arguments) {
  const CLI::App* command = &app;
  for (const std::string& argument : arguments) {
    std::vector<std::string> known;
    std::string word = argument;
    if (argument.starts_with("-")) {
      word = argument.substr(0, argument.find('='));
      for (const CLI::Option* option : command->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    } else {
      const std::vector<const CLI::App*> commands =
          command->get_subcommands(std::function<bool(const CLI::App*)>());
      const auto found =
          std::ranges::find(commands, argument, [](const CLI::App* each) { return each->get_name(); });
      if (found != commands.end()) {
        command = *found;
        continue;
      }
      for (const CLI::App* each : commands) known.push_back(each->get_name());
    }
    if (std::ranges::find(known, word) != known.end()) continue;
    if (const std::string meant = nearest(word, known); !meant.empty()) return "did you mean " + meant + "?";
  }
  return {};
}

}  // namespace evalcts::cli
