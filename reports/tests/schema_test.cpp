// Tests that the schema and the reader agree: the samples are valid, and what read_run_result rejects is not.
#include <gtest/gtest.h>

#include <evalcts/results/files.h>
#include <evalcts/vectors/json_schema.h>
#include "samples.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

// Returns the first complaint, or "valid".
std::string verdict(const json& record) {
  static const JsonSchema kSchema(parse_json(read_file(EVALCTS_REPORTS_SCHEMA)));
  const std::string complaint = kSchema.complaint(record);
  return complaint.empty() ? "valid" : complaint;
}

TEST(Schema, SamplesAreValid) {
  for (const char* name : {"results-osmesa.json", "results-reference.json", "results-glx.json"}) {
    EXPECT_EQ(verdict(read_sample(name)), "valid") << name;
  }
}

// Results that were read are written as valid JSON, and reading and writing that again gives the same bytes.
TEST(Schema, WrittenResultsAreValid) {
  for (const char* name : {"results-osmesa.json", "results-reference.json", "results-glx.json"}) {
    const std::string text = to_text(read_run_result(read_sample(name)));
    EXPECT_EQ(verdict(parse_json(text)), "valid") << name;
    EXPECT_EQ(to_text(parse_run_result(text)), text) << name;
    const json written = parse_json(text), read = read_sample(name);
    for (const char* field : {"started", "seconds", "host"})
      EXPECT_EQ(written.value(field, json()), read.value(field, json())) << name << " " << field;
  }
}

TEST(Schema, ChangedSamplesAreNot) {
  const auto changed = [](const char* pointer, const json& value) {
    json record = read_sample("results-osmesa.json");
    record[json::json_pointer(pointer)] = value;
    return verdict(record);
  };
  EXPECT_EQ(changed("/reason", "another"), "valid");
  EXPECT_EQ(changed("/tests/1/failures/0/ulp", nullptr), "valid");  // null: infinite
  EXPECT_EQ(changed("/tests/1/flake", true), "valid");
  EXPECT_EQ(changed("/bugs/0/known", "mesa-list-crash"), "valid");
  EXPECT_EQ(changed("/tests/1/again", {{"verdict", "pass"}, {"message", ""}}), "valid");
  for (const auto& [pointer, value] :
       std::vector<std::pair<const char*, json>>{{"/format", "evalcts-results-2"},
                                                 {"/status", "done"},
                                                 {"/implementation/captures/0/available", "yes"},
                                                 {"/implementation/max_eval_order", 30.5},
                                                 {"/summary/passed", 1},
                                                 {"/summary/pass", "1"},
                                                 {"/tests/0/verdict", "passed"},
                                                 {"/tests/0/level", "should"},
                                                 {"/tests/0/requirements/0", 1},
                                                 {"/tests/0/cases", 1.5},
                                                 {"/tests/0/accuracy/values", "480"},
                                                 {"/tests/1/failures/0/calls", "glEnd();"},
                                                 {"/tests/1/failures/0/ulp", "1"},
                                                 {"/tests/1/flake", "pass"},
                                                 {"/tests/1/again", {{"verdict", "passes"}, {"message", ""}}},
                                                 {"/confirmed_by_group", 0},
                                                 {"/bugs/0/id", ""},
                                                 {"/bugs/0/verdict", "pass"},
                                                 {"/bugs/0/commands", "glEnd();"},
                                                 {"/bugs/0/tests", "Map2Output.FillOrder"},
                                                 {"/bugs/0/failure/calls", "glEnd();"}}) {
    EXPECT_NE(changed(pointer, value), "valid") << pointer;
  }
}

}  // namespace
}  // namespace evalcts::reports
