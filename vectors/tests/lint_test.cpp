// Tests the linter: it finds errors in a file and names the case.
#include <evalcts/results/files.h>
#include <evalcts/vectors/lint.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include <evalcts/vectors/write.h>
#include "lint/themes.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;

const std::set<std::string>& requirements() {
  static const std::set<std::string> kIds = [] {
    const json catalogue = parse_json(read_file(REQUIREMENTS_FILE));
    std::set<std::string> all;
    for (const json& row : catalogue["requirements"]) all.insert(row["id"]);
    return all;
  }();
  return kIds;
}

// Returns a file with the first cases of a shipped one and the notes of their flags.
json first_cases(const std::string& kind) {
  json file = parse_json(read_file(std::string(VECTORS_FOLDER) + "/" + kind + ".json")), few = json::array(),
       notes = json::object();
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
  return files.emplace(kind, parse_json(read_file(std::string(VECTORS_FOLDER) + "/" + kind + ".json")))
      .first->second;
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

// Returns the case with another theme.
json relabelled(json entry, const std::string& theme) {
  entry["flags"][0] = theme;
  return entry;
}

// Each theme has a claim, which some case of another theme does not satisfy.
TEST(Lint, ChecksWhatThemesSay) {
  // The claims of exact ends are those of their requirements; the other themes are about several cases.
  const std::set<std::string> unclaimed = {"map2_eval.every-target", "map2_eval.transposed",
                                           "grid.exact-first", "grid.exact-last", "grid.targets"};
  for (const char* kind : {"map1_eval", "map2_eval", "grid", "auto_normal"}) {
    const json& cases = shipped_file(kind)["cases"];
    std::set<std::string> themes;
    for (const json& entry : cases) themes.insert(entry["flags"][0]);
    for (const std::string& theme : themes) {
      if (unclaimed.contains(fmt::format("{}.{}", kind, theme))) continue;
      EXPECT_TRUE(std::ranges::any_of(
          cases, [&](const json& entry) { return broken_theme(relabelled(entry, theme)) == theme; }))
          << kind << "." << theme;
    }
  }
  json file = shipped("map1_eval", "map1_eval.near-tie-float.1");
  file["cases"][0]["components"][0]["exact"] = "100000001/200000000";
  EXPECT_EQ(complaint(file),
            "map1_eval.near-tie-float.1: does not have the property that its theme 'near-tie-float' claims");
}

// Neighbouring themes are told apart: the first case of one has not the property of the other.
TEST(Lint, TellsThemesApart) {
  for (const auto& [id, theme] : {std::pair{"map1_eval.tie-float.1", "near-tie-float"},
                                  {"map1_eval.near-tie-float.1", "tie-float"},
                                  {"map1_eval.near-tie-float.1", "hardest"},
                                  {"map1_eval.tie-double.1", "near-tie-double"},
                                  {"map1_eval.tie-float.1", "tie-double"},
                                  {"map1_eval.cancel-nearly.1", "cancel-zero"},
                                  {"map1_eval.huge.1", "overflow"},
                                  {"map1_eval.tiny.1", "underflow"},
                                  {"map1_eval.promised-range.1", "overflow"},
                                  {"map1_eval.at-an-end.1", "outside"},
                                  {"map1_eval.at-an-end.1", "next-to-an-end"},
                                  {"map1_eval.tiny.1", "subnormal"},
                                  {"grid.first.1", "last"},
                                  {"grid.inside.1", "index-outside"},
                                  {"auto_normal.plane.1", "curved"},
                                  {"auto_normal.saddle.1", "plane"},
                                  {"auto_normal.cylinder.2", "sphere"},
                                  {"auto_normal.constant-w.1", "either-w"}}) {
    const std::string name = id;
    const json entry = shipped(name.substr(0, name.find('.')), name)["cases"][0];
    EXPECT_EQ(broken_theme(entry), "") << id;
    EXPECT_EQ(broken_theme(relabelled(entry, theme)), theme) << id;
  }
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
  for (const char* number : {"0x0p+0", "-0x0p+0", "0x1p+0", "-0x1.8p-3", "0x1.fffffep+127", "0x1p-149"})
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
  EXPECT_EQ(complaint(file), "malformed: map1_eval.ordinary.1: 3 values of a control point, expected 4");
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
