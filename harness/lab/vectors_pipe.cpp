// `evalcts vectors emit` prints cases as lines of text, and `evalcts vectors check` judges the answers of
// another program to them.
#include <fmt/format.h>

#include <fstream>
#include <iostream>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/vectors/lint.h>
#include <evalcts/vectors/pipe.h>
#include <evalcts/vectors/write.h>
#include "vectors.h"

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostShown = 20;

// Returns the requested kinds of cases, or all kinds that the pipe supports.
std::vector<std::string> kinds_of(const VectorsOptions& options) {
  return options.kinds.empty() ? std::vector<std::string>{"map1_eval", "map2_eval", "grid", "auto_normal"}
                               : options.kinds;
}

// Returns the parsed files. Throws vectors::Malformed.
std::vector<nlohmann::json> files_of(const VectorsOptions& options) {
  std::vector<nlohmann::json> files;
  for (const std::string& kind : kinds_of(options)) {
    const fs::path path = places().vectors / (kind + ".json");
    try {
      std::ifstream stream(path);
      if (!stream) throw vectors::Malformed("cannot be read");
      nlohmann::json file = nlohmann::json::parse(stream, nullptr, false);
      if (file.is_discarded()) throw vectors::Malformed("is not JSON");
      vectors::check_structure(file);
      files.push_back(std::move(file));
    } catch (const vectors::Malformed& problem) {
      throw vectors::Malformed(fmt::format("{}: {}", path.string(), problem.what()));
    }
  }
  return files;
}

template <typename Range, typename Print>
void show_some(const Range& entries, Print print) {
  std::size_t shown = 0;
  for (const auto& entry : entries) {
    if (++shown > kMostShown) {
      std::cout << fmt::format("  ... and {} more\n", entries.size() - kMostShown);
      return;
    }
    print(entry);
  }
}

void print(const vectors::Score& score) {
  const std::size_t answered = score.cases - score.skipped - score.missing.size();
  std::cout << fmt::format("{}: {} cases, {} answered, {} skipped, {} missing, {} wrong", score.kind,
                           score.cases, answered, score.skipped, score.missing.size(), score.wrong.size());
  if (score.values > 0) {
    std::cout << fmt::format("; {} of {} values correctly rounded, largest error {:.3g} ULP",
                             score.correctly_rounded, score.values, score.largest_ulp);
    if (!score.largest_id.empty()) std::cout << fmt::format(" ({})", score.largest_id);
  }
  std::cout << '\n';
  for (const auto& [flag, count] : score.by_flag)
    if (count.wrong > 0)
      std::cout << fmt::format("  {}: {} of {} wrong\n", flag, count.wrong, count.answered);
  show_some(score.wrong, [](const vectors::Wrong& wrong) {
    std::cout << fmt::format("  wrong: {}: {}\n", wrong.id, wrong.message);
  });
  show_some(score.missing, [](const std::string& id) { std::cout << fmt::format("  missing: {}\n", id); });
}

}  // namespace

int emit_vectors(const VectorsOptions& options) {
  std::ios::sync_with_stdio(false);
  try {
    if (options.count > 0) {
      for (const std::string& kind : kinds_of(options))
        vectors::emit_random(kind, options.seed, options.count, std::cout);
    } else {
      for (const nlohmann::json& file : files_of(options)) std::cout << vectors::emit(file);
    }
  } catch (const vectors::Malformed& problem) {
    return wrong_use(problem.what());
  }
  std::cout.flush();
  if (std::cout) return kNothingUnexpected;
  return wrong_use("the reader closed the pipe before the end");
}

namespace {

// Judges the answers on standard input, one kind after the other.
std::vector<vectors::Score> scores_of(const VectorsOptions& options, vectors::Answers& answers) {
  std::vector<vectors::Score> scores;
  if (options.count > 0) {
    for (const std::string& kind : kinds_of(options))
      scores.push_back(vectors::judge_random(kind, options.seed, options.count, std::cin, answers));
    while (vectors::read_answer(std::cin, answers)) {
    }
    return scores;
  }
  const std::vector<nlohmann::json> files = files_of(options);
  answers = vectors::read_answers(std::cin);
  for (const nlohmann::json& file : files) scores.push_back(vectors::judge(file, answers));
  return scores;
}

}  // namespace

int check_vectors(const VectorsOptions& options) {
  std::ios::sync_with_stdio(false);
  int code = kNothingUnexpected;
  std::size_t cases = 0, skipped = 0;
  try {
    vectors::Answers answers;
    const std::vector<vectors::Score> scores = scores_of(options, answers);
    for (const vectors::Score& score : scores) {
      print(score);
      cases += score.cases;
      skipped += score.skipped;
      if (!score.wrong.empty() || !score.missing.empty()) code = std::max(code, kUnexpected);
    }
    if (const std::string quality = vectors::quality_in_words(scores); !quality.empty())
      std::cout << quality << '\n';
    show_some(answers.answered_twice,
              [](const std::string& id) { std::cout << fmt::format("answered twice: {}\n", id); });
    if (!answers.answered_twice.empty()) code = std::max(code, kUnexpected);
    show_some(answers.of,
              [](const auto& answer) { std::cout << fmt::format("unknown id: {}\n", answer.first); });
    show_some(answers.malformed, [](const std::string& words) { std::cout << words << '\n'; });
    if (!answers.of.empty() || !answers.malformed.empty()) {
      std::cerr << "evalcts: some lines are not answers; vectors/INTERPRETING.md describes the format\n";
      code = std::max(code, kWrongUse);
    }
  } catch (const vectors::Malformed& problem) {
    return wrong_use(problem.what());
  }
  if (code == kNothingUnexpected && !options.allow_unobserved &&
      warn_if_mostly_unobserved("the answers", cases - skipped, cases, "cases"))
    code = kWrongUse;
  return code;
}

}  // namespace evalcts::cli
