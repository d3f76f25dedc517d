// Tests the linter: it finds errors in a file and names the case.
#include <evalcts/vectors/lint.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include <evalcts/vectors/write.h>

namespace evalcts::vectors {
namespace {

using nlohmann::json;

const std::set<std::string>& requirements() {
  static const std::set<std::string> kIds = [] {
    std::ifstream stream(REQUIREMENTS_FILE);
    const json catalogue = json::parse(stream);
    std::set<std::string> all;
    for (const json& row : catalogue["requirements"]) all.insert(row["id"]);
    return all;
  }();
  return kIds;
}

// Returns a file with the first cases of a shipped one and the notes of their flags.
json first_cases(const std::string& kind) {
  std::ifstream stream(std::string(VECTORS_FOLDER) + "/" + kind + ".json");
  json file = json::parse(stream), few = json::array(), notes = json::object();
  for (int i = 0; i < 3; ++i) {
    few.push_back(file["cases"][i]);
    for (const std::string flag : few.back()["flags"]) notes[flag] = file["notes"][flag];
  }
  file["numberOfTests"] = few.size();
  file["cases"] = few;
  file["notes"] = notes;
  return file;
}

const json& sample(const std::string& kind) {
  static std::map<std::string, json> samples;
  const auto found = samples.find(kind);
  return found != samples.end() ? found->second : samples.emplace(kind, first_cases(kind)).first->second;
}

// Returns the findings, or the reason for which the file is malformed.
std::string complaint(const json& file) {
  try {
    const Report report = lint(file.dump(), requirements());
    return report.findings.empty() ? "" : report.findings.front();
  } catch (const Malformed& problem) {
    return std::string("malformed: ") + problem.what();
  }
}

std::string changed(const std::string& kind, const char* place, const json& value) {
  json file = sample(kind);
  file[json::json_pointer(place)] = value;
  return complaint(file);
}
std::string without(const std::string& kind, const char* place, const char* member) {
  json file = sample(kind);
  file[json::json_pointer(place)].erase(member);
  return complaint(file);
}

TEST(Lint, SamplesAreWell) {
  for (const std::string& kind : kinds()) EXPECT_EQ(complaint(sample(kind)), "") << kind;
}

TEST(Lint, FindsWhatDoesNotHoldTogether) {
  json file = sample("grid");
  file["cases"].push_back(file["cases"][0]);
  EXPECT_EQ(complaint(file), "numberOfTests: 3 for 4 cases");
  file["numberOfTests"] = 4;
  EXPECT_EQ(complaint(file), "grid.inside.1: the id occurs twice");
  EXPECT_EQ(changed("grid", "/cases/0/id", "map1_eval.inside.1"),
            "map1_eval.inside.1: an id of another kind than grid");
  EXPECT_EQ(changed("grid", "/cases/1/requirements/0", "EV-NONE"),
            "grid.inside.2: no requirement is called EV-NONE");
  EXPECT_EQ(changed("grid", "/cases/1/flags/0", "other"), "grid.inside.2: the flag 'other' has no note");
  EXPECT_EQ(changed("grid", "/notes/unused", "Words."), "notes: no case has the flag 'unused'");
}

const json& shipped_file(const std::string& kind) {
  static std::map<std::string, json> files;
  const auto found = files.find(kind);
  if (found != files.end()) return found->second;
  std::ifstream stream(std::string(VECTORS_FOLDER) + "/" + kind + ".json");
  return files.emplace(kind, json::parse(stream)).first->second;
}

// Returns a file with one case of a shipped one.
json shipped(const std::string& kind, const std::string& id) {
  const json& all = shipped_file(kind);
  json file = {}, only = json::array(), notes = json::object();
  for (const auto& member : all.items())
    if (member.key() != "cases") file[member.key()] = member.value();
  for (const json& entry : all["cases"])
    if (as_text(entry["id"]) == id) only.push_back(entry);
  for (const std::string flag : only.at(0)["flags"]) notes[flag] = all["notes"][flag];
  file["numberOfTests"] = only.size();
  file["cases"] = only;
  file["notes"] = notes;
  return file;
}

TEST(Lint, ChecksWhatExactEndsClaim) {
  for (const char* id : {"grid.exact-first.1", "grid.exact-last.4", "grid.exact-last.50"}) {
    json file = shipped("grid", id);
    EXPECT_EQ(complaint(file), "");
    const std::string requirement = file["cases"][0]["requirements"][0];
    // Makes the case accept all values.
    for (json& component : file["cases"][0]["components"]) component["accept"] = nullptr;
    EXPECT_EQ(complaint(file),
              std::string(id) + ": claims " + requirement + ", but accepts a result that violates it");
  }
  // On the grid from 0 to 1 with 43 segments, the steps reach exactly 1 in every precision, fused or not.
  json file = shipped("grid", "grid.exact-last.1");
  file["cases"][0]["u"].update({{"segments", 43}, {"first", "0x0p+0"}, {"last", "0x1p+0"}, {"index", 43}});
  EXPECT_NE(complaint(file), "");
  file = shipped("grid", "grid.last.1");
  file["cases"][0]["requirements"].push_back("EV-POINT-EXACT-N");
  EXPECT_NE(complaint(file), "");
}

// A theme, and a change (a JSON pointer and the new value) after which its first case does not have its
// property.
struct BrokenTheme {
  const char *kind, *theme, *place;
  json value;
};

const std::vector<BrokenTheme>& broken_themes() {
  const char *const exact = "/cases/0/components/0/exact", *const u = "/cases/0/u",
                    *const first = "/cases/0/map/points/0/0", *const end = "/cases/0/map/domain/0";
  static const std::vector<BrokenTheme> kAll = {
      {"map1_eval", "tie-float", exact, "3/1"},
      {"map1_eval", "near-tie-float", exact, "100000001/200000000"},
      {"map1_eval", "tie-double", exact, "1/3"},
      {"map1_eval", "near-tie-double", exact, "1/1"},
      {"map1_eval", "hardest", exact, "1/3"},
      {"map1_eval", "cancel-zero", exact, "1/3"},
      {"map1_eval", "cancel-nearly", exact, "2/3"},
      {"map1_eval", "overflow", exact, "1/1"},
      {"map1_eval", "underflow", exact, "1/1"},
      {"map1_eval", "elevated", exact, "1/1"},
      {"map1_eval", "circle", exact, "1/3"},
      {"map1_eval", "huge", first, "0x1p+0"},
      {"map1_eval", "promised-range", first, "0x1p+33"},
      {"map1_eval", "tiny", first, "0x1p+0"},
      {"map1_eval", "subnormal", first, "0x1p+0"},
      {"map1_eval", "huge-double", first, "0x1p+0"},
      {"map1_eval", "tiny-double", first, "0x1p+0"},
      {"map1_eval", "constant", first, "0x1p+40"},
      {"map1_eval", "linear", "/cases/0/map/points", json::parse(R"([["0x0p+0"],["0x1p+0"],["0x0p+0"]])")},
      {"map1_eval", "one-point", first, "0x1p+1"},
      {"map1_eval", "wide", "/cases/0/map/points", json::parse(R"([["0x1p+0","0x1p+1","0x1p+0","0x1p+1"]])")},
      {"map1_eval", "outside", u, "0x1p-1"},
      {"map1_eval", "ordinary", u, "0x1p+9"},
      {"map1_eval", "at-an-end", u, "0x1p+9"},
      {"map1_eval", "next-to-an-end", u, "0x1p+9"},
      {"map1_eval", "far-away", u, "0x1p-1"},
      {"map1_eval", "domain-huge", "/cases/0/map/domain", {"0x0p+0", "0x1p+0"}},
      {"map1_eval", "domain-tiny", "/cases/0/map/domain", {"0x0p+0", "0x1p+0"}},
      {"map1_eval", "domain-reversed", "/cases/0/map/domain", {"0x0p+0", "0x1p+0"}},
      {"map1_eval", "domain-negative", end, "0x1p+0"},
      {"map1_eval", "domain-offset", "/cases/0/map/domain", {"0x0p+0", "0x1p+0"}},
      {"map1_eval", "domain-inexact", "/cases/0/map/domain", {"0x0p+0", "0x1p+0"}},
      {"map1_eval", "high-order", "/cases/0/map/points", json::parse(R"([["0x0p+0"],["0x1p+0"]])")},
      {"map2_eval", "corner", u, "0x1p+9"},
      {"map2_eval", "order-one", "/cases/0/flags/0", "high-order"},
      {"grid", "inside", "/cases/0/u/index", -1},
      {"grid", "first", "/cases/0/u/index", 1},
      {"grid", "last", "/cases/0/u/index", 0},
      {"grid", "index-outside", "/cases/0/u/index", 0},
      {"grid", "reversed", "/cases/0/u/first", "-0x1p+9"},
      {"grid", "equal-ends", "/cases/0/u/first", "-0x1p+9"},
      {"grid", "many-segments", "/cases/0/u/segments", 3},
      {"grid", "far-index", "/cases/0/u/index", 3},
      {"grid", "cancelling", "/cases/0/u/last", "-0x1p+9"},
      {"grid", "offset", "/cases/0/u/last", "-0x1p+30"},
      {"grid", "awkward", "/cases/0/u",
       json::parse(R"({"segments":2,"first":"0x0p+0","last":"0x1p+0","index":1,"exact":"1/2"})")},
      {"auto_normal", "border", "/cases/0/map/domain", {"-0x1p+0", "0x1p+1", "-0x1p+0", "0x1p+1"}},
      {"auto_normal", "reversed", "/cases/0/map/domain", {"0x0p+0", "0x1p+0", "0x0p+0", "0x1p+0"}},
      {"auto_normal", "domain", "/cases/0/map/domain", {"0x0p+0", "0x1p+0", "0x0p+0", "0x1p+0"}},
      {"auto_normal", "negative-w", "/cases/0/map/points/0/0/3", "0x1p+0"},
      {"auto_normal", "constant-w", "/cases/0/map/points/0/0/3", "0x1p+0"},
      {"auto_normal", "zero-w", "/cases/0/m", {"1/1", "0/1", "0/1"}}};
  return kAll;
}

TEST(Lint, ChecksWhatThemesSay) {
  for (const auto& [kind, theme, place, value] : broken_themes()) {
    const std::string id = fmt::format("{}.{}.1", kind, theme);
    json file = shipped(kind, id);
    EXPECT_EQ(complaint(file), "") << id;
    const json flags = file["cases"][0]["flags"];
    file[json::json_pointer(place)] = value;
    if (file["cases"][0]["flags"] != flags) file["notes"] = {{as_text(value), "Words."}};
    EXPECT_EQ(complaint(file), fmt::format("{}: does not have the property that its theme '{}' claims", id,
                                           as_text(file["cases"][0]["flags"][0])));
  }
}

TEST(Lint, KnowsThatRefusedQueriesAnswerNothing) {
  json file = shipped("errors", "errors.enable-begin-end.1");
  EXPECT_EQ(complaint(file), "");
  // The first query is between Begin and End, the second one outside.
  file["cases"][0]["steps"][2]["answers"] = json::parse("[[0]]");
  EXPECT_EQ(complaint(file), "errors.enable-begin-end.1: step 2: a rejected query has an answer");
  file = shipped("errors", "errors.getmap-target.1");
  file["cases"][0]["steps"][0]["answers"] = json::parse(R"([["0x0p+0"]])");
  EXPECT_EQ(complaint(file), "errors.getmap-target.1: step 0: a rejected query has an answer");
}

TEST(Lint, SaysWhatIsMalformed) {
  const std::string enumeration = "Failed to match against any enum values.";
  const auto superfluous = [](const std::string& member) {
    return fmt::format(
        "Object contains a property that could not be validated using 'properties' or "
        "'additionalProperties' constraints: '{}'.",
        member);
  };
  const auto begins_with = [](const std::string& text, const std::string& expected) {
    EXPECT_EQ(text.substr(0, expected.size()), expected);
  };
  EXPECT_EQ(complaint("text"), "malformed: file: Value type not permitted by 'type' constraint.: \"text\"");
  EXPECT_EQ(changed("grid", "/kind", "grids"), "malformed: file/kind: " + enumeration + ": \"grids\"");
  EXPECT_NE(changed("grid", "/schemaVersion", "1.0"), "");
  EXPECT_NE(changed("grid", "/cases/0/level", "should"), "");
  EXPECT_NE(changed("grid", "/cases/0/since", "1.2"), "");
  EXPECT_NE(without("grid", "/cases/0", "level"), "");
  EXPECT_EQ(changed("grid", "/format", "evalcts-vectors-2"),
            "malformed: file/format: Failed to match expected value set by 'const' constraint.: "
            "\"evalcts-vectors-2\"");
  begins_with(changed("grid", "/more", 1), "malformed: file: " + superfluous("more"));
  begins_with(without("map1_eval", "/cases/1", "u"),
              "malformed: map1_eval.ordinary.2: Missing required property 'u'.");
  begins_with(without("map1_eval", "/cases/1", "id"), "malformed: case 2: Missing required property 'id'.");
  begins_with(changed("map1_eval", "/cases/1/v", "0x0p+0"),
              "malformed: map1_eval.ordinary.2: " + superfluous("v"));
  EXPECT_EQ(changed("grid", "/cases/0/u/index", 0.5),
            "malformed: grid.inside.1/u/index: Value type not permitted by 'type' constraint.: 0.5");
  EXPECT_EQ(changed("map1_eval", "/cases/0/map/target", "GL_MAP2_VERTEX_3"),
            "malformed: map1_eval.ordinary.1/map/target: " + enumeration + ": \"GL_MAP2_VERTEX_3\"");
  const auto complaint_of_text = [](const std::string& text) -> std::string {
    try {
      lint(text, requirements());
      return "";
    } catch (const Malformed& problem) {
      return problem.what();
    }
  };
  EXPECT_TRUE(complaint_of_text("{\"kind\": ").starts_with("no JSON: "));
  EXPECT_TRUE(complaint_of_text("{\"cases\": [\n{\"id\":\"grid.inside.7\",\"flags\":[}\n]}")
                  .starts_with("grid.inside.7: no JSON: "));
}

// Returns true if the file is well-formed with another number at the place, even if it violates other rules.
bool is_well_formed(const char* place, const json& number) {
  return !changed("map1_eval", place, number).starts_with("malformed");
}

TEST(Lint, KnowsTheFormsOfNumbers) {
  for (const char* number : {"0x0p+0", "-0x0p+0", "0x1p+0", "-0x1.8p-3", "0x1.fffffep+127", "0x1p-1074"})
    EXPECT_TRUE(is_well_formed("/cases/0/u", number)) << number;
  for (const json& number :
       {json("0.5"), json(0.5), json("0x1.p+0"), json("0x1.80p+0"), json("0x1p0"), json("0x1p-0"),
        json("0x1p+01"), json("0x2p+1"), json("0X1p+1"), json("inf"), json("nan"), json(""), json("0x1.Ap+0"),
        json("0x0p+1"), json("+0x1p+0"), json(nullptr)})
    EXPECT_FALSE(is_well_formed("/cases/0/u", number)) << number;
  for (const char* fraction : {"0/1", "-3/8", "2/1"})
    EXPECT_TRUE(is_well_formed("/cases/0/components/0/exact", fraction)) << fraction;
  for (const char* fraction :
       {"0/2", "-0/1", "3", "3/-8", "03/8", "3/08", "3/0", "/8", "3/", "0x3/8", "1.5/2"})
    EXPECT_FALSE(is_well_formed("/cases/0/components/0/exact", fraction)) << fraction;
  EXPECT_TRUE(is_well_formed("/cases/0/components/0/float", "-inf"));
  EXPECT_FALSE(is_well_formed("/cases/0/components/0/float", "nan"));
}

TEST(Lint, CountsWithTheTargets) {
  json file = sample("map1_eval");
  file["cases"][0]["components"].erase(0);
  EXPECT_EQ(complaint(file), "malformed: map1_eval.ordinary.1: 'components' has 3 entries for 4 components");
  file = sample("map1_eval");
  file["cases"][0]["map"]["points"][0].erase(0);
  EXPECT_EQ(complaint(file), "malformed: map1_eval.ordinary.1/map/points/0: 3 values, expected 4");
  file = sample("map2_eval");
  file["cases"][2]["map"]["domain"].erase(0);
  EXPECT_NE(complaint(file), "");
  file = sample("map1_eval");
  file["cases"][0]["quotients"] = json::array();
  EXPECT_NE(complaint(file), "");
}

TEST(Lint, LooksIntoSequences) {
  EXPECT_NE(changed("errors", "/cases/0/steps/0/errors", json::array({"GL_NO_ERROR"})), "");
  EXPECT_NE(changed("errors", "/cases/0/steps/0/call", json::array()), "");
  EXPECT_NE(changed("errors", "/cases/0/steps/0/call/0", "glMap1f"), "");
  EXPECT_NE(changed("errors", "/cases/0/steps/0/call/1", "MAP1_INDEX"), "");
  EXPECT_NE(changed("errors", "/cases/0/steps/0/call/6", {{"f16", json::array()}}), "");
  EXPECT_NE(changed("errors", "/cases/0/steps/0/answer", json::array()), "");
  EXPECT_EQ(changed("get_map", "/cases/0/steps/0/level", "advisory"), "");
  EXPECT_NE(changed("get_map", "/cases/0/steps/0/level", "must"), "");
  EXPECT_NE(changed("state", "/cases/0/steps/0/answers", json::array({json::array()})), "");
  EXPECT_NE(changed("state", "/cases/0/steps/0/emits", json::array({{{"mode", "GL_POINTS"}}})), "");
}

TEST(Lint, LooksIntoNormals) {
  EXPECT_NE(changed("auto_normal", "/cases/0/m", nullptr), "");
  EXPECT_NE(changed("auto_normal", "/cases/0/normal/0/enclosure", json::array({"0/1"})), "");
  EXPECT_NE(changed("auto_normal", "/cases/0/accept", json::array()), "");
  EXPECT_NE(changed("auto_normal", "/cases/0/derivatives/u", json::array({"0/1", "0/1", "0/1", "0/1"})), "");
}

}  // namespace
}  // namespace evalcts::vectors
