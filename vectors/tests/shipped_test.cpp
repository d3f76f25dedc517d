// Tests that the shipped files are the same as those that the writer makes, and tests `evalcts vectors`.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <evalcts/results/files.h>
#include <evalcts/results/hash.h>
#include <evalcts/results/json.h>
#include <evalcts/vectors/lint.h>
#include <evalcts/vectors/write.h>

namespace evalcts::vectors {
namespace {

namespace fs = std::filesystem;

// INTERPRETING.md promises another generatorVersion if a case of values or normals changes.
TEST(ShippedCases, ChangeWithTheGeneratorVersion) {
  std::string version, cases;
  for (const char* const kind : {"map1_eval", "map2_eval", "grid", "auto_normal"}) {
    const std::string text = read_file(fs::path(VECTORS_FOLDER) / (std::string(kind) + ".json"));
    const std::size_t begin = text.find("\"cases\": [");
    version = parse_json(text.substr(0, begin) + "\"cases\": []}")["generatorVersion"];
    cases += text.substr(begin);
  }
  EXPECT_EQ(version, "3");
  EXPECT_EQ(fnv1a<std::uint64_t>(cases), 11250905206947019131u)
      << "increment kGeneratorVersion (write/document.h) if the cases have changed";
}

// The cases of map2_eval.transposed are pairs of the same surface with u and v exchanged.
TEST(ShippedCases, AreTransposedInPairs) {
  const auto file = parse_json(read_file(fs::path(VECTORS_FOLDER) / "map2_eval.json"));
  std::vector<nlohmann::json> cases;
  for (const auto& entry : file["cases"])
    if (as_text(entry["flags"][0]) == "transposed") cases.push_back(entry);
  ASSERT_EQ(cases.size() % 2, 0u);
  for (std::size_t i = 0; i < cases.size(); i += 2) {
    const auto &one = cases[i], &other = cases[i + 1];
    const auto &points = one["map"]["points"], &turned = other["map"]["points"];
    EXPECT_EQ(one["u"], other["v"]);
    EXPECT_EQ(one["v"], other["u"]);
    EXPECT_EQ(one["components"], other["components"]) << one["id"];
    ASSERT_EQ(points[0].size(), turned.size()) << one["id"];
    for (std::size_t j = 0; j < points.size(); ++j)
      for (std::size_t k = 0; k < turned.size(); ++k) EXPECT_EQ(points[j][k], turned[k][j]) << one["id"];
  }
}

// --- Writing

class WrittenCases : public testing::Test {
 protected:
  WrittenCases() { fs::create_directories(folder_); }
  ~WrittenCases() override { fs::remove_all(folder_); }
  // Returns the text of the file that is written if the file of the kind has these cases and the other ones
  // have none.
  std::string written(const std::string& kind, const nlohmann::json& cases) const {
    for (const char* const each : {"map1_eval", "map2_eval", "grid", "auto_normal"}) {
      const bool has_cases = each == kind;
      const nlohmann::json file = {{"description", "Words."},
                                   {"notes", has_cases ? shipped(kind)["notes"] : nlohmann::json::object()},
                                   {"cases", has_cases ? cases : nlohmann::json::array()}};
      std::ofstream(folder_ / (std::string(each) + ".json")) << file;
    }
    write_all(
        folder_, folder_, [] { return std::vector<SuiteCase>(); }, [](const WrittenFile&) {});
    return read_file(folder_ / (kind + ".json"));
  }
  // Returns the reason for which such a file is not written.
  std::string complaint(const std::string& kind, const nlohmann::json& cases) const {
    try {
      written(kind, cases);
      return "";
    } catch (const std::runtime_error& problem) {
      const std::string text = problem.what();
      return text.substr(text.find(".json: ") + 7);
    }
  }
  // Returns a shipped file with its first cases.
  static const nlohmann::json& shipped(const std::string& kind) {
    static std::map<std::string, nlohmann::json> files;
    nlohmann::json& file = files[kind];
    if (file.is_null()) {
      file = parse_json(read_file(fs::path(VECTORS_FOLDER) / (kind + ".json")));
      file["cases"].erase(file["cases"].begin() + 10, file["cases"].end());
    }
    return file;
  }

 private:
  const fs::path folder_ = fs::path(testing::TempDir()) / ("evalcts-written-" + std::to_string(getpid()));
};

TEST_F(WrittenCases, GetTheirAnswers) {
  for (const char* const kind : {"map1_eval", "map2_eval", "grid", "auto_normal"}) {
    const nlohmann::json& cases = shipped(kind)["cases"];
    nlohmann::json questions = nlohmann::json::array();
    for (const auto& entry : cases) {
      nlohmann::json question;
      for (const char* const member : {"id", "requirements", "flags", "map", "u", "v", "intermediate"})
        if (entry.contains(member)) question[member] = entry[member];
      for (const char* const name : {"u", "v"})
        if (question.contains(name) && question[name].is_object()) question[name].erase("exact");
      if (question.contains("intermediate")) question["intermediate"] = nullptr;
      questions.push_back(question);
    }
    EXPECT_EQ(parse_json(written(kind, questions))["cases"], cases) << kind;
  }
}

TEST_F(WrittenCases, HaveProblemsThatAreDescribed) {
  const nlohmann::json curve = shipped("map1_eval")["cases"][0], surface = shipped("map2_eval")["cases"][0];
  const auto changed = [&](nlohmann::json entry, const char* place, const nlohmann::json& value) {
    entry[nlohmann::json::json_pointer(place)] = value;
    const std::string kind = entry.contains("v") ? "map2_eval" : "map1_eval";
    return complaint(kind, nlohmann::json::array({entry}));
  };
  EXPECT_EQ(changed(curve, "/u", "0.5"), "");
  EXPECT_EQ(changed(curve, "/u", "0.1"), R"(map1_eval.ordinary.1: "0.1" is not a finite binary32)");
  EXPECT_EQ(changed(curve, "/u", "inf"), R"(map1_eval.ordinary.1: "inf" is not a finite binary32)");
  EXPECT_EQ(changed(curve, "/u", "half"), "map1_eval.ordinary.1: 'half' is not a number");
  EXPECT_EQ(changed(curve, "/map/type", "i"), R"(map1_eval.ordinary.1: the type "i" is neither "f" nor "d")");
  EXPECT_EQ(changed(curve, "/map/target", "GL_MAP1"),
            R"(map1_eval.ordinary.1: "GL_MAP1" is not the target of a map)");
  EXPECT_EQ(changed(curve, "/map/domain/0", curve["map"]["domain"][1]),
            "map1_eval.ordinary.1: the ends of the domain are equal");
  EXPECT_EQ(changed(curve, "/map/domain", surface["map"]["domain"]),
            "map1_eval.ordinary.1: 4 ends of the domain, expected 2");
  EXPECT_EQ(changed(curve, "/map/points", nlohmann::json::array()),
            "map1_eval.ordinary.1: no control points");
  EXPECT_EQ(changed(curve, "/map/points/0", nlohmann::json::array()),
            "map1_eval.ordinary.1: 0 values of a control point, expected 4");
  EXPECT_TRUE(changed(surface, "/map/points/1", nlohmann::json::array())
                  .starts_with("map2_eval.ordinary.1: 0 control points in a row, expected"));
  EXPECT_EQ(changed(curve, "/flags/0", "other"), "map1_eval.ordinary.1: map1_eval: no note on 'other'");
  EXPECT_EQ(complaint("map1_eval", nlohmann::json::array({curve, curve})),
            "map1_eval.ordinary.1: the id 'map1_eval.ordinary.1' occurs twice");
  EXPECT_EQ(complaint("auto_normal", nlohmann::json::array({curve})),
            "map1_eval.ordinary.1: only surfaces of vertices have automatic normals");
  nlohmann::json incomplete = curve;
  incomplete.erase("u");
  EXPECT_TRUE(complaint("map1_eval", nlohmann::json::array({incomplete})).ends_with("key 'u' not found"));
}

// --- The command line

int run(const std::string& arguments) {
  const int status =
      std::system((std::string(EVALCTS_PROGRAM) + " vectors " + arguments + " > /dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class VectorsCommand : public testing::Test {
 protected:
  VectorsCommand() { fs::create_directories(folder_); }
  ~VectorsCommand() override { fs::remove_all(folder_); }
  void put(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name) << content;
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("evalcts-vectors-" + std::to_string(getpid()));
};

TEST_F(VectorsCommand, WritesTheShippedFiles) {
  ASSERT_EQ(run("write --output " + folder_.string()), 0);
  for (const std::string& kind : kinds()) {
    const std::string shipped = read_file(fs::path(VECTORS_FOLDER) / (kind + ".json"));
    const std::string written = read_file(folder_ / (kind + ".json"));
    // EXPECT_EQ would print megabytes.
    if (shipped == written) continue;
    const auto [a, b] = std::mismatch(shipped.begin(), shipped.end(), written.begin(), written.end());
    const auto line = 1 + std::count(shipped.begin(), a, '\n');
    ADD_FAILURE() << kind << ": line " << line << " differs; 'evalcts vectors write' rewrites the files";
  }
}

TEST_F(VectorsCommand, RefusesWhatItCannotReadOrWrite) {
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run("write --output /proc/nowhere"), 2);
  EXPECT_EQ(run("lint " + (folder_ / "missing.json").string()), 2);
  EXPECT_EQ(run("lint " + folder_.string()), 2);
  put("text.json", "no JSON");
  EXPECT_EQ(run("lint " + (folder_ / "text.json").string()), 2);
}

TEST_F(VectorsCommand, WritesToNoFullDisk) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  fs::create_symlink("/dev/full", folder_ / "map1_eval.json.new");
  EXPECT_EQ(run("write --output " + folder_.string()), 2);
}

TEST_F(VectorsCommand, DoesNotPassWhatSkipsAll) {
  const std::string answers = (folder_ / "answers").string();
  const auto check = [&](const std::string& lines) {
    put("answers", lines);
    return run("check --kind map1_eval --count 2 --seed 1 < " + answers);
  };
  EXPECT_EQ(check("map1_eval.random-1.1 skip\nmap1_eval.random-1.2 skip\n"), 2);
  EXPECT_EQ(check(""), 1);
  EXPECT_EQ(check("map1_eval.random-1.1 0 0 0 0\n"), 1);
  EXPECT_EQ(check("map1_eval.random-2.1 0\n"), 2);
  EXPECT_EQ(run("emit --kind grid --seed 3"), 2);
  EXPECT_EQ(run("emit --kind grid --count 0"), 2);
}

TEST_F(VectorsCommand, FindsWhatIsWrong) {
  auto file = parse_json(read_file(fs::path(VECTORS_FOLDER) / "grid.json"));
  put("grid.json", file.dump());
  EXPECT_EQ(run("lint " + (folder_ / "grid.json").string()), 0);
  file["cases"][0]["requirements"][0] = "EV-NONE";
  put("grid.json", file.dump());
  EXPECT_EQ(run("lint " + (folder_ / "grid.json").string()), 1);
}

// `check` does not pass a program that skips most cases.
TEST_F(VectorsCommand, RefusesToPassWhatIsMostlySkipped) {
  const fs::path answers = folder_ / "answers.txt";
  ASSERT_EQ(run(R"(emit --kind grid | awk '{print $2, "skip"}' | tee )" + answers.string()), 0);
  EXPECT_EQ(run("check --kind grid < " + answers.string()), 2);
  EXPECT_EQ(run("check --kind grid --allow-unobserved < " + answers.string()), 0);
}

}  // namespace
}  // namespace evalcts::vectors
