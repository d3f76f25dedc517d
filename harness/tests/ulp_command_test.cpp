// Tests `evalcts ulp` as its users start it: table, files, replays, exit codes.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <thread>

#include <evalcts/vectors/json_schema.h>
#include "drill.h"

namespace evalcts {
namespace {

using nlohmann::json;

class UlpCommand : public DrillTest {
 protected:
  Outcome ulp(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "ulp");
    for (const char* more : {"--output", folder_.c_str()}) arguments.emplace_back(more);
    return evalcts(arguments);
  }
  json document() const { return json_of("ulp.json"); }
  // Returns the number of files in the folder, which must not contain temporary files.
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
  static std::string complaints(const json& file) {
    return JsonSchema(parse_json(read_file(ULP_SCHEMA))).complaint(file);
  }
};

TEST_F(UlpCommand, MeasuresImplementations) {
  const Outcome outcome =
      ulp({"--implementation", "production", "--implementation", "reference", "--implementation", "sum-float",
           "--values", "500", "--filter", "*/4/*:*/3x8/*"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const json file = document();
  EXPECT_EQ(complaints(file), "");
  ASSERT_EQ(file["implementations"].size(), 3u);
  EXPECT_EQ(as_text(file["status"]), "complete");
  for (const json& entry : file["implementations"]) {
    EXPECT_EQ(as_text(entry["status"]), "complete");
    ASSERT_EQ(entry["rows"].size(), 17u);
    std::uint64_t wrong = 0;
    for (const json& row : entry["rows"]) {
      ASSERT_FALSE(row.contains("not_measured")) << row;
      EXPECT_GE(row["values"].get<int>() + row["zeros"].get<int>(), 500);
      wrong += row["not_correctly_rounded"].get<std::uint64_t>() + row["zeros_wrong"].get<std::uint64_t>();
    }
    EXPECT_EQ(wrong == 0, as_text(entry["name"]) != "sum-float") << entry["name"];
  }
  EXPECT_EQ(as_text(file["implementations"][0]["rows"][0]["target"]), "vertex_3");
  EXPECT_EQ(as_text(file["implementations"][0]["rows"][0]["capture"]), "Sink");
  std::istringstream row(outcome.text.substr(outcome.text.find("curve/4/ordinary")));
  const std::vector<std::string> cells{std::istream_iterator<std::string>(row), {}};
  EXPECT_GE(std::stoi(cells.at(1)), 500) << outcome.text;
  EXPECT_EQ(cells.at(2), "0.00") << outcome.text;
  const std::string table = text_of("ulp.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 3 * 17) << table;
  EXPECT_TRUE(contains(table, "\nsum-float,curve/4/ordinary,,"));
  EXPECT_EQ(files(), 5u) << "ulp.json, ulp.csv, two pictures, the log of this test";
}

// The pictures have a line for each implementation. Those of an earlier measurement do not stay.
TEST_F(UlpCommand, DrawsTheErrors) {
  ASSERT_EQ(ulp({"--implementation", "production", "--implementation", "sum-float", "--values", "100",
                 "--filter", "curve/4/*:curve/10/ordinary"})
                .code,
            0);
  const auto points_of = [&](const std::string& picture, const std::string& name) {
    const std::string svg = text_of(picture), kPoints = "points=\"";
    const std::size_t end = svg.find("\"><title>" + name + "</title>");
    EXPECT_NE(end, std::string::npos) << picture << ", " << name;
    const std::size_t begin = svg.rfind(kPoints, end) + kPoints.size();
    std::istringstream words(svg.substr(begin, end - begin));
    return std::vector<std::string>{std::istream_iterator<std::string>(words), {}};
  };
  EXPECT_EQ(points_of("ulp-by-argument.svg", "production").size(), 256u);
  const std::vector<std::string> right = points_of("ulp-by-order.svg", "production"),
                                 wrong = points_of("ulp-by-order.svg", "sum-float");
  ASSERT_EQ(right.size(), 2u) << "orders 4 and 10";
  const auto height = [](const std::string& point) { return std::stod(point.substr(point.find(',') + 1)); };
  EXPECT_EQ(wrong[1].substr(0, wrong[1].find(',')), right[1].substr(0, right[1].find(',')));
  EXPECT_LT(height(wrong[1]), height(right[1]) - 10) << "larger errors are higher, which is a smaller y";
  EXPECT_TRUE(contains(text_of("ulp-by-order.svg"), ">10</text>"));

  ASSERT_EQ(
      ulp({"--implementation", "sum-float", "--values", "100", "--filter", "curve/4/lines", "--name", "<b>"})
          .code,
      0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "ulp-by-order.svg"));
  EXPECT_TRUE(contains(text_of("ulp-by-argument.svg"), "&lt;b&gt;"));
}

TEST_F(UlpCommand, WorstInputsCanBeReplayed) {
  ASSERT_EQ(ulp({"--implementation", "horner-float", "--values", "500", "--filter", "*/wide"}).code, 0);
  const json file = document();
  ASSERT_EQ(file["implementations"][0]["rows"].size(), 11u);
  for (const json& row : file["implementations"][0]["rows"])
    for (const char* which : {"worst_ulp", "worst_condition_aware"}) {
      const json& worst = row[which];
      const Outcome again = start(worst["replay"].get<std::vector<std::string>>());
      EXPECT_EQ(again.code, 0) << again.text;
      EXPECT_TRUE(contains(again.text, ": " + worst["got"]["value"].get<std::string>() + " (" +
                                           worst["got"]["bits"].get<std::string>() + "), correctly rounded " +
                                           worst["right"]["value"].get<std::string>()))
          << again.text << worst;
      EXPECT_TRUE(contains(again.text, "exact value " + worst["exact"].get<std::string>()));
    }
}

// A correctly rounded evaluator is also correct over other domains and at points of grids, and worst inputs
// can be replayed over their domain.
TEST_F(UlpCommand, MeasuresOtherDomainsAndGrids) {
  ASSERT_EQ(ulp({"--implementation", "production", "--implementation", "horner-float", "--values", "300",
                 "--filter", "*/shifted:*/reversed:*/narrow:*/huge:*/grid"})
                .code,
            0);
  const json file = document();
  EXPECT_EQ(complaints(file), "");
  ASSERT_EQ(file["implementations"][0]["rows"].size(), 10u);
  for (const json& row : file["implementations"][0]["rows"]) {
    EXPECT_EQ(row["not_correctly_rounded"], 0) << row["name"];
    EXPECT_EQ(row["worst_ulp"].contains("domain"), as_text(row["data"]) != "grid");
    EXPECT_EQ(row["worst_ulp"].contains("segments"), as_text(row["data"]) == "grid");
  }
  for (const json& row : file["implementations"][1]["rows"]) {
    EXPECT_GT(row["not_correctly_rounded"], 0) << row["name"];
    const json& worst = row["worst_ulp"];
    const Outcome again = start(worst["replay"].get<std::vector<std::string>>());
    EXPECT_EQ(again.code, 0) << again.text;
    EXPECT_TRUE(contains(again.text, worst["got"]["bits"].get<std::string>())) << again.text << worst;
    EXPECT_TRUE(contains(again.text, "exact value " + worst["exact"].get<std::string>()))
        << again.text << worst;
  }
}

TEST_F(UlpCommand, TakesADomain) {
  // The value is (5 - 4)/(8 - 4) of the way from 0.25 to 0.75.
  const std::vector<std::string> input = {"--implementation",   "production", "--orders", "2",
                                          "--points=0.25,0.75", "--at",       "5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), input.begin(), input.end());
    return ulp(more);
  };
  EXPECT_TRUE(contains(with({"--domain", "4,8"}).text, "exact value 0.375 (0x1.8p-2): error 0 ULP"));
  EXPECT_TRUE(contains(with({"--domain", "4,8", "--segments", "4"}).text, ": 0x1.8p-2 (0x3ec00000)"));
  for (const char* wrong : {"4,4", "4", "1,2,3", "0,1e99", "nan,1"})
    EXPECT_EQ(with({"--domain", wrong}).code, 2) << wrong;
  EXPECT_EQ(with({"--segments", "0"}).code, 2);
  // Points of grids need not be floats.
  EXPECT_TRUE(contains(ulp({"--implementation", "production", "--orders", "2", "--points=0,3", "--at",
                            "0x1.555556p-2", "--segments", "3"})
                           .text,
                       "exact value 1 (0x1p+0): error 0 ULP"));
}

// The search finds larger errors than the sample, which "found_by" and the replayed inputs show.
TEST_F(UlpCommand, ClimbsToWorseInputs) {
  ASSERT_EQ(ulp({"--implementation", "horner-float", "--values", "6000", "--filter",
                 "curve/4/ordinary:curve/10/integers:surface/3x8/ordinary"})
                .code,
            0);
  const json rows = document()["implementations"][0]["rows"];
  ASSERT_EQ(rows.size(), 3u);
  for (const json& row : rows) {
    EXPECT_EQ(as_text(row["worst_ulp"]["found_by"]), "climbing") << row["name"];
    for (const char* which : {"worst_ulp", "worst_condition_aware"}) {
      const Outcome again = start(row[which]["replay"].get<std::vector<std::string>>());
      EXPECT_TRUE(contains(again.text, row[which]["got"]["bits"])) << again.text;
    }
  }
}

TEST_F(UlpCommand, GivesTheSameWhateverTheNumberOfJobs) {
  const auto measured = [&](const char* seed, const char* jobs) {
    EXPECT_EQ(ulp({"--implementation", "production", "--implementation", "sum-float", "--values", "300",
                   "--filter", "curve/4/*", "--seed", seed, "--jobs", jobs})
                  .code,
              0);
    return text_of("ulp.csv") + text_of("ulp-by-order.svg") + text_of("ulp-by-argument.svg") +
           document()["implementations"].dump();
  };
  const std::string one = measured("3", "1");
  EXPECT_EQ(measured("3", "2"), one);
  EXPECT_NE(measured("4", "1"), one);
}

TEST_F(UlpCommand, MeasuresTargetsApart) {
  const Outcome outcome = ulp({"--implementation", "reference", "--implementation", "casteljau-float",
                               "--values", "100", "--filter", "curve/3/integers", "--target", "normal",
                               "--target", "color_4", "--target", "texture_coord_2"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const json file = document();
  EXPECT_EQ(complaints(file), "");
  const json& rows = file["implementations"][0]["rows"];
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(as_text(rows[0]["target"]), "normal");
  EXPECT_EQ(as_text(rows[2]["target"]), "texture_coord_2");
  for (const json& row : rows) EXPECT_EQ(row["not_correctly_rounded"], 0);
  EXPECT_EQ(file["implementations"][1]["rows"].size(), 1u) << "an algorithm has no targets";
  EXPECT_TRUE(contains(outcome.text, "curve/3/integers/color_4"));
}

TEST_F(UlpCommand, SaysWhatItCannotMeasure) {
  // The sink emits only positions, and so cannot be measured for colours.
  const Outcome outcome = ulp({"--library", BEZIER_SINK, "--values", "100", "--filter", "curve/3/integers",
                               "--target", "vertex_3", "--target", "color_4", "--name", "mine"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const json entry = document()["implementations"][0];
  EXPECT_EQ(complaints(document()), "");
  EXPECT_EQ(as_text(entry["name"]), "mine");
  ASSERT_EQ(entry["rows"].size(), 2u);
  EXPECT_TRUE(entry["rows"][0].contains("max_ulp")) << entry;
  EXPECT_TRUE(entry["rows"][1].contains("not_measured")) << entry;

  const Outcome none = ulp({"--library", "/no/such/library.so", "--filter", "curve/3/integers"});
  EXPECT_EQ(none.code, 2) << none.text;
  EXPECT_EQ(as_text(document()["implementations"][0]["status"]), "not-started");
  EXPECT_EQ(complaints(document()), "");
}

TEST_F(UlpCommand, SurvivesACrash) {
  setenv("EVALCTS_DRILL", "start", 1);
  const Outcome outcome = ulp({"--library", DRILL_LIBRARY, "--implementation", "osmesa", "--filter",
                               "curve/3/integers", "--values", "100"});
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "SIGSEGV"));
  EXPECT_EQ(as_text(document()["implementations"][0]["status"]), "crashed");
  EXPECT_EQ(complaints(document()), "");
}

TEST_F(UlpCommand, MeasuresTheOtherRowsAfterACrash) {
  setenv("EVALCTS_DRILL", "order", 1);
  const Outcome outcome = ulp({"--library", WRONG_SINK, "--filter", "curve/?/integers", "--values", "100"});
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  const json entry = document()["implementations"][0];
  EXPECT_EQ(as_text(entry["status"]), "crashed");
  EXPECT_GT(entry["rows"].size(), 3u);
  for (const json& row : entry["rows"])
    EXPECT_EQ(row.contains("not_measured"), as_text(row["name"]) == "curve/6/integers") << row;
  EXPECT_TRUE(contains(outcome.text, "SIGABRT"));
  EXPECT_EQ(complaints(document()), "");
}

TEST_F(UlpCommand, WrongUseIsTwo) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--implementation", "nonsense"},
        {"--filter", "No/Such"},
        {"--target", "index"},
        {"--values", "0"},
        {"--values", "-1"},
        {"--jobs", "0"},
        {"--implementation", "osmesa", "--implementation", "production", "--library", "libOSMesa.so.8"},
        {"--implementation", "sum-float", "--orders", "3", "--points", "1,2", "--at", "0.5"},
        {"--implementation", "sum-float", "--orders", "2,2", "--points", "1,2,3,4", "--at", "0.5"},
        {"--implementation", "sum-float", "--orders", "0", "--points", "1", "--at", "0.5"},
        {"--implementation", "sum-float", "--orders", "1", "--points", "0.1", "--at", "0.5"},
        {"--implementation", "sum-float", "--at", "0.5"},
        {"--implementation", "sum-float", "--domain", "1,2"},
        {"--implementation", "sum-float", "--segments", "4"},
        {"--implementation", "production-fast", "--orders", "1", "--points", "1", "--at", "0x1p-25"},
        {"--orders", "1", "--points", "1", "--at", "0.5"},
        {"nonsense"}}) {
    std::string typed;
    for (const std::string& argument : arguments) typed += argument + " ";
    EXPECT_EQ(ulp(arguments).code, 2) << typed;
  }
  EXPECT_EQ(evalcts({"ulp", "--output", "/proc/nowhere"}).code, 2);
  EXPECT_EQ(ulp({"--help"}).code, 0);
}

// The first row is finished when the library hangs in the second.
TEST_F(UlpCommand, KeepsWhatWasMeasuredWhenInterrupted) {
  setenv("EVALCTS_DRILL", "hang", 1);
  ChildProcess child(
      {EVALCTS_PROGRAM, "ulp", "--library", WRONG_SINK, "--name", "wrong", "--filter",
       "curve/4/integers:curve/6/integers", "--values", "100", "--jobs", "1", "--output", folder_.string()},
      (folder_ / "interrupted.log").string());
  for (int i = 0; i < 500 && !std::filesystem::exists(drill_file()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(child.id(), SIGINT);
  const auto ending = child.wait(60);
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->value, 2);
  EXPECT_EQ(as_text(document()["status"]), "interrupted");
  const json entry = document()["implementations"][0];
  EXPECT_EQ(as_text(entry["status"]), "interrupted");
  ASSERT_EQ(entry["rows"].size(), 1u);
  EXPECT_EQ(as_text(entry["rows"][0]["name"]), "curve/4/integers");
  EXPECT_EQ(complaints(document()), "");
}

}  // namespace
}  // namespace evalcts
