// Tests the pipe: random cases are the same on every machine, are judged as by exact arithmetic, and are made
// and judged fast.
#include <evalcts/vectors/pipe.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <reference/component.h>

#include <cmath>
#include <limits>
#include <sstream>

#include <evalcts/results/hash.h>
#include "pipe/random_cases.h"
#include "write/normals.h"
#include "write/numbers.h"
#include "write/text.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;

const char* const kKinds[] = {"map1_eval", "map2_eval", "grid", "auto_normal"};

std::string questions(const std::string& kind, std::uint64_t seed, std::uint64_t count) {
  std::ostringstream lines;
  emit_random(kind, seed, count, lines);
  return lines.str();
}

TEST(RandomCases, AreTheSameEverywhere) {
  std::string all;
  for (const char* kind : kKinds) all += questions(kind, 7, 500);
  EXPECT_EQ(
      all.substr(0, all.find('\n')),
      "map1 map1_eval.random-7.1 f 4 3 0x0p+0 0x1p+0 0x1.7461a8p-3 0x1.023542p+0 0x1.fabccap-1 0x1.01491ep+0 "
      "0x1.0341e2p+0 -0x1.0098b4p+0 -0x1.00aa14p+0 -0x1.02a0cap+0 -0x1.ff26b8p-1 0x1.03918ep+0 "
      "0x1.ffa1ccp-1 0x1.0281f8p+0 0x1.0350cep+0");
  EXPECT_EQ(fnv1a<std::uint64_t>(all), 10210271564166180473u);
  EXPECT_EQ(questions("grid", 7, 20), questions("grid", 7, 30).substr(0, questions("grid", 7, 20).size()));
  EXPECT_NE(questions("grid", 8, 1), questions("grid", 7, 1));
}

TEST(Dice, KeepTheirPromises) {
  Dice dice("promises");
  for (int i = 0; i < 2000; ++i) {
    const double real = dice.real(53);
    ASSERT_TRUE(real >= -1 && real < 1);
    const double single = dice.significand(24);
    ASSERT_EQ(single, static_cast<float>(single));
    ASSERT_TRUE(std::abs(single) >= 1 && std::abs(single) < 2);
    const double scaled = std::abs(dice.scaled(10, -3, 4));
    ASSERT_TRUE(scaled >= 0x1p-3 && scaled < 0x1p5);
    const int number = dice.between(-2, 2);
    ASSERT_TRUE(number >= -2 && number <= 2);
  }
}

// Returns an answer to a case that depends on `turn`: the correct one, one near the limits of acceptance, or
// a wrong one.
std::vector<double> answer(const json& entry, std::uint64_t turn) {
  std::vector<double> values;
  if (entry.contains("derivatives")) {
    const bool has_normal = !entry["normal"].is_null();
    for (std::size_t c = 0; c < 3; ++c)
      values.push_back(has_normal ? number(entry["normal"][c]["double"]) : 1);
    constexpr double kErrors[] = {0, 1e-3, 1.99e-3, 2.05e-3, 1e-2};
    values[turn % 3] += kErrors[turn % 5];
    if (turn % 7 == 0)
      for (double& x : values) x = -x;
    return values;
  }
  for (const json& component : entry["components"]) {
    const double right = number(component["float"]);
    values.push_back(right);
    if (component["accept"].is_null()) continue;
    const double low = number(component["accept"][0]);
    const double high = number(component["accept"][1]);
    constexpr float kUp = std::numeric_limits<float>::infinity();
    const double all[] = {right,
                          std::nextafter(static_cast<float>(right), kUp),
                          right + (high - right) / 2,
                          high,
                          std::nextafter(static_cast<float>(high), kUp),
                          low,
                          std::nextafter(static_cast<float>(low), -kUp),
                          right + 3 * (high - right),
                          std::nan("")};
    values.back() = all[turn % std::size(all)];
  }
  return values;
}

// Returns a file of random cases with their exact answers.
json exact_file(const std::string& kind, std::uint64_t seed, std::uint64_t count) {
  json file = {{"kind", kind}, {"cases", json::array()}};
  RandomCases cases(kind, seed);
  for (std::uint64_t i = 0; i < count; ++i) {
    cases.draw();
    json entry = cases.is_normal() ? normal_case(cases.problem()) : value_case(cases.problem());
    entry.update({{"id", cases.id()}, {"flags", json::array()}});
    file["cases"].push_back(std::move(entry));
  }
  return file;
}

TEST(RandomCases, AreJudgedAsExactArithmeticJudges) {
  constexpr std::uint64_t kCount = 600, kSeed = 3;
  for (const char* kind : kKinds) {
    const json file = exact_file(kind, kSeed, kCount);
    std::string lines;
    std::uint64_t turn = 0;
    for (const json& entry : file["cases"]) {
      lines += as_text(entry["id"]);
      for (const double x : answer(entry, turn)) lines += fmt::format(" {:a}", x);
      lines += '\n';
      ++turn;
    }
    std::istringstream stream(lines), again(lines);
    Answers answers = read_answers(again), none;
    const Score exact = judge(file, answers), quick = judge_random(kind, kSeed, kCount, stream, none);
    ASSERT_EQ(quick.wrong.size(), exact.wrong.size()) << kind;
    EXPECT_GT(exact.wrong.size(), kCount / 20) << kind;
    EXPECT_LT(exact.wrong.size(), kCount * 3 / 4) << kind;
    for (std::size_t i = 0; i < exact.wrong.size(); ++i) {
      EXPECT_EQ(quick.wrong[i].id, exact.wrong[i].id);
      EXPECT_TRUE(quick.wrong[i].message.starts_with(exact.wrong[i].message)) << quick.wrong[i].message;
    }
    EXPECT_EQ(quick.cases, kCount);
    EXPECT_EQ(quick.largest_ulp, exact.largest_ulp) << kind;
    EXPECT_EQ(quick.values, exact.values) << kind;
    EXPECT_EQ(quick.correctly_rounded, exact.correctly_rounded) << kind;
    ASSERT_EQ(quick.quality.size(), exact.quality.size()) << kind;
    for (const auto& [target, quality] : exact.quality) {
      // Good normals are counted without looking whether the rule applies to them.
      if (target != "GL_AUTO_NORMAL") {
        EXPECT_EQ(quick.quality.at(target).values, quality.values) << target;
      }
      EXPECT_EQ(quick.quality.at(target).worse, quality.worse) << target;
    }
  }
}

// The largest error and the counts are the same as with exact arithmetic.
TEST(RandomCases, AreMeasured) {
  constexpr std::uint64_t kCount = 400, kSeed = 5;
  const json file = exact_file("map1_eval", kSeed, kCount);
  std::string lines;
  std::uint64_t turn = 0;
  for (const json& entry : file["cases"]) {
    lines += as_text(entry["id"]);
    for (const json& component : entry["components"]) {
      const float right = static_cast<float>(number(component["float"]));
      lines += fmt::format(" {:a}", turn++ % 3 == 0 ? std::nextafter(right, 2 * right) : right);
    }
    lines += '\n';
  }
  std::istringstream stream(lines), again(lines);
  Answers answers = read_answers(again), none;
  const Score exact = judge(file, answers), quick = judge_random("map1_eval", kSeed, kCount, stream, none);
  EXPECT_EQ(quick.largest_ulp, exact.largest_ulp);
  EXPECT_EQ(quick.largest_id, exact.largest_id);
  EXPECT_EQ(quick.values, exact.values);
  EXPECT_EQ(quick.correctly_rounded, exact.correctly_rounded);
  EXPECT_GT(quick.values, quick.correctly_rounded);
}

// The lines of cases at points of grids. One grid has equal ends, and its index lies outside the grid.
TEST(Emit, AsksOfGridPoints) {
  const json argument = {{"segments", 7}, {"first", "0x1p-1"}, {"last", "0x1p-1"}, {"index", -3}};
  const json other = {{"segments", 2}, {"first", "0x0p+0"}, {"last", "0x1.8p+1"}, {"index", 1}};
  const json map = {{"type", "d"}, {"domain", {"0x0p+0", "0x1p+0"}}, {"points", {{"0x1p+0"}, {"-0x1p+1"}}}};
  const json surface = {{"type", "f"},
                        {"domain", {"0x0p+0", "0x1p+0", "-0x1p+0", "0x1p+2"}},
                        {"points", {{{"0x1p+0"}, {"0x1p+1"}, {"0x1p+2"}}}}};
  EXPECT_EQ(
      emit({{"kind", "grid"},
            {"cases",
             {{{"id", "a"}, {"map", map}, {"u", argument}},
              {{"id", "b"}, {"map", surface}, {"u", argument}, {"v", other}}}}}),
      "grid1 a d 1 2 0x0p+0 0x1p+0 7 0x1p-1 0x1p-1 -3 0x1p+0 -0x1p+1\n"
      "grid2 b f 1 1 3 0x0p+0 0x1p+0 -0x1p+0 0x1p+2 7 0x1p-1 0x1p-1 -3 2 0x0p+0 0x1.8p+1 1 0x1p+0 0x1p+1 "
      "0x1p+2\n");
}

// If the correct value is finite, infinity and NaN are wrong in each component, and their error is infinite
// or large.
TEST(Judge, RejectsWhatIsNotFinite) {
  const json file = exact_file("map2_eval", 2, 20);
  for (const double x :
       {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), std::nan("")}) {
    std::string lines;
    for (const json& entry : file["cases"]) {
      lines += as_text(entry["id"]);
      for (std::size_t c = 0; c < entry["components"].size(); ++c)
        lines += c + 1 < entry["components"].size()
                     ? fmt::format(" {}", as_text(entry["components"][c]["float"]))
                     : fmt::format(" {}", x);
      lines += '\n';
    }
    std::istringstream stream(lines), again(lines);
    Answers answers = read_answers(stream), none;
    for (const Score& score : {judge(file, answers), judge_random("map2_eval", 2, 20, again, none)}) {
      EXPECT_EQ(score.wrong.size(), 20u) << x;
      EXPECT_GT(score.largest_ulp, 1e6) << x;
    }
  }
}

// At every point of a grid with equal ends, the correct value is the value at these ends. Other values are
// rejected. Such a grid is among the first random cases of grids.
TEST(Judge, KnowsGridsOfEqualEnds) {
  constexpr std::uint64_t kSeed = 1;
  RandomCases cases("grid", kSeed);
  std::uint64_t count = 0;
  const auto has_equal_ends = [&] {
    const Argument& u = cases.problem().u;
    return u.first() == u.last() && u.index() != 0 && u.index() != u.segments() &&
           cases.problem().map.u.order > 1;
  };
  do {
    ASSERT_LT(++count, 5000u);
    cases.draw();
  } while (!has_equal_ends());
  Problem problem = cases.problem();
  problem.u = Argument::coordinate(problem.u.first());
  const json at_end = value_case(problem);
  std::string right = cases.id(), wrong = cases.id();
  for (const json& component : at_end["components"]) {
    right += fmt::format(" {}", as_text(component["float"]));
    wrong += fmt::format(" {:a}", number(component["float"]) + 1000);
  }
  for (const auto& [line, expected] : {std::pair{right, 0u}, {wrong, 1u}}) {
    std::istringstream stream(line + '\n');
    Answers none;
    EXPECT_EQ(judge_random("grid", kSeed, count, stream, none).wrong.size(), expected);
  }
}

// Returns the score of answers change(value, entry, component), where `value` is the correctly rounded one.
template <class Change>
Score score_of(const json& file, const Change& change) {
  Answers answers;
  for (const json& entry : file["cases"]) {
    const bool is_normal = entry.contains("derivatives");
    if (is_normal && entry["normal"].is_null()) {
      answers.of[entry["id"]] = {0, 0, 1};
      continue;
    }
    std::vector<double> values;
    for (const json& component : is_normal ? entry["normal"] : entry["components"])
      values.push_back(change(number(component["float"]), entry, values.size()));
    answers.of[entry["id"]] = values;
  }
  return judge(file, answers);
}

TEST(Quality, IsSeenWhereTheRuleAcceptsAll) {
  const json curves = exact_file("map1_eval", 11, 900), normals = exact_file("auto_normal", 11, 100);
  const auto right = [](double x, const json&, std::size_t) { return x; };
  EXPECT_EQ(quality_in_words({score_of(curves, right), score_of(normals, right)}),
            "quality: as good as single precision for 10 of 10 targets");
  // Results with 16 significant bits, the float adjacent to the control point at an end of the domain, and
  // normals with an error of 0.12 degrees: all of them conform.
  const auto verdict = [&](const json& file, const auto& change) {
    const Score score = score_of(file, change);
    EXPECT_TRUE(score.wrong.empty()) << (score.wrong.empty() ? "" : score.wrong[0].message);
    return quality_in_words({score});
  };
  const auto bits_16 = [](double x, const json& entry, std::size_t) {
    const json &u = entry["u"], &domain = entry["map"]["domain"];
    if (u == domain[0] || u == domain[1]) return x;
    int exponent = 0;
    const double significand = std::frexp(x, &exponent);
    return std::ldexp(std::round(std::ldexp(significand, 16)), exponent - 16);
  };
  const std::string coarse = verdict(curves, bits_16);
  EXPECT_TRUE(coarse.starts_with("quality: as good as single precision for 0 of 9 targets; not for GL_MAP1_"))
      << coarse;
  EXPECT_NE(coarse.find(" times the bound in map1_eval.random-11."), std::string::npos) << coarse;
  const auto next_at_end = [](double x, const json& entry, std::size_t c) {
    const bool is_target = as_text(entry["map"]["target"]) == "GL_MAP1_VERTEX_3" && c == 0;
    const bool is_end = entry["u"] == entry["map"]["domain"][0];
    return is_target && is_end ? std::nextafter(static_cast<float>(x), 2 * static_cast<float>(x)) : x;
  };
  const std::string off = verdict(curves, next_at_end);
  EXPECT_TRUE(
      off.starts_with("quality: as good as single precision for 8 of 9 targets; not for GL_MAP1_VERTEX_3 ("))
      << off;
  EXPECT_NE(off.find("a corner is not its control point or a result not finite in "), std::string::npos)
      << off;
  const std::string turned =
      verdict(normals, [](double x, const json&, std::size_t c) { return c == 0 ? x + 0.002 : x; });
  EXPECT_TRUE(
      turned.starts_with("quality: as good as single precision for 0 of 1 targets; not for GL_AUTO_NORMAL ("))
      << turned;
  EXPECT_EQ(quality_in_words({Score{}}), "");
}

// Normals that are off by a tenth of a degree are accepted without exact arithmetic, but not good. NaN is
// neither accepted nor good.
TEST(Quality, IsSeenInRandomNormals) {
  constexpr std::uint64_t kCount = 60, kSeed = 11;
  const json file = exact_file("auto_normal", kSeed, kCount);
  const auto score = [&](double error) {
    std::string lines;
    for (const json& entry : file["cases"]) {
      lines += as_text(entry["id"]);
      for (std::size_t c = 0; c < 3; ++c)
        lines += fmt::format(" {:a}", entry["normal"].is_null()
                                          ? 1
                                          : number(entry["normal"][c]["float"]) + (c == 0 ? error : 0));
      lines += '\n';
    }
    std::istringstream stream(lines);
    Answers none;
    return judge_random("auto_normal", kSeed, kCount, stream, none);
  };
  EXPECT_EQ(quality_in_words({score(0)}), "quality: as good as single precision for 1 of 1 targets");
  const Score tilted = score(0.0018);
  EXPECT_TRUE(tilted.wrong.empty());
  EXPECT_TRUE(quality_in_words({tilted}).starts_with(
      "quality: as good as single precision for 0 of 1 targets; not for GL_AUTO_NORMAL ("))
      << quality_in_words({tilted});
  const Score nan = score(std::nan(""));
  EXPECT_GT(nan.wrong.size(), kCount / 2);
  EXPECT_EQ(nan.quality.at("GL_AUTO_NORMAL").worse, nan.quality.at("GL_AUTO_NORMAL").values);
}

TEST(RandomCases, MayBeAnsweredInAnyOrder) {
  RandomCases cases("map1_eval", 1);
  std::vector<std::string> ids;
  for (int i = 0; i < 4; ++i) {
    cases.draw();
    ids.push_back(cases.id());
  }
  std::istringstream lines(ids[2] + " skip\n# a comment\n\n" + ids[0] + "  skip \n" + ids[3] + " nothing\n" +
                           ids[2] + " 1\n");
  Answers answers;
  const Score score = judge_random("map1_eval", 1, 4, lines, answers);
  EXPECT_EQ(score.skipped, 2u);
  EXPECT_EQ(score.missing, (std::vector{ids[1], ids[3]}));
  EXPECT_EQ(answers.answered_twice, std::vector{ids[2]});
  ASSERT_EQ(answers.malformed.size(), 1u);
  EXPECT_TRUE(answers.malformed[0].starts_with("line 5: ")) << answers.malformed[0];
}

TEST(RandomCases, AcceptCorrectlyRoundedAnswers) {
  constexpr std::uint64_t kCount = 2000;
  for (const char* kind : {"map1_eval", "map2_eval", "grid"}) {
    RandomCases cases(kind, 1);
    std::string lines;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      cases.draw();
      lines += cases.id();
      const Problem& problem = cases.problem();
      const auto map = std::make_shared<const Map>(problem.map);
      for (int c = 0; c < map->components(); ++c)
        lines += fmt::format(" {:a}", reference::rounded(reference::Sample(map, c, problem.u, problem.v)));
      lines += '\n';
    }
    std::istringstream stream(lines);
    Answers answers;
    const Score score = judge_random(kind, 1, kCount, stream, answers);
    EXPECT_GE(score.values, kCount) << kind;
    EXPECT_EQ(score.correctly_rounded, score.values) << kind;
    EXPECT_TRUE(score.wrong.empty()) << kind;
  }
}

}  // namespace
}  // namespace evalcts::vectors
