// Random programs: made, judged, made small, kept.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "harness/fuzz/campaign.h"
#include "harness/fuzz/legal.h"
#include "harness/fuzz/random_program.h"
#include "harness/fuzz/shrink.h"
#include "harness/gl/call_log.h"
#include "harness/gl/case_json.h"
#include "harness/tests/program.h"

namespace evalcts::fuzz {
namespace {

using nlohmann::json;

constexpr int kMaxOrder = 30, kLength = 120;

std::string text_of(const gl::Case& program) {
  std::string text;
  for (const gl::Command& command : program.commands()) text += gl::to_c(command) + "\n";
  return text;
}

bool has(const gl::Case& program, gl::EntryPoint entry) {
  return std::ranges::any_of(program.commands(),
                             [&](const gl::Command& command) { return command.entry == entry; });
}

gl::Case small_curve() {
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<GLfloat>{0, 0, 0, 1, 2, 3});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.End();
  return c;
}

// --- programs ---------------------------------------------------------------------------------------------

TEST(RandomProgram, IsTheSameForTheSameSeedOnEveryMachine) {
  const auto program = [](std::uint32_t seed, std::uint32_t number) {
    return text_of(random_program(seed, number, kLength, kMaxOrder));
  };
  EXPECT_EQ(program(3, 7), program(3, 7));
  EXPECT_NE(program(3, 7), program(3, 8));
  EXPECT_NE(program(3, 7), program(4, 7));
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char c : program(1, 0)) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  EXPECT_EQ(hash, 3631112718035775970u) << "the programs of all seeds have changed: mean it";
}

TEST(RandomProgram, GoesEverywhereAndIsDefined) {
  std::map<gl::EntryPoint, int> times;
  for (std::uint32_t number = 0; number < 200; ++number) {
    const gl::Case program = random_program(1, number, kLength, kMaxOrder);
    ASSERT_TRUE(specify_if_defined(program, kMaxOrder)) << number;
    for (const gl::Command& command : program.commands()) ++times[command.entry];
  }
  using gl::EntryPoint;
  for (const EntryPoint entry :
       {EntryPoint::Map1f, EntryPoint::Map1d, EntryPoint::Map2f, EntryPoint::Map2d, EntryPoint::MapGrid1d,
        EntryPoint::MapGrid2f, EntryPoint::EvalCoord1dv, EntryPoint::EvalCoord2fv, EntryPoint::EvalPoint1,
        EntryPoint::EvalPoint2, EntryPoint::EvalMesh1, EntryPoint::EvalMesh2, EntryPoint::GetMapdv,
        EntryPoint::CallList, EntryPoint::PushAttrib, EntryPoint::PopAttrib, EntryPoint::ActiveTexture,
        EntryPoint::Vertex3f})
    EXPECT_GT(times[entry], 5) << gl::name_of(entry);
}

TEST(IsDefined, TellsWhatTheSpecificationLeavesOpen) {
  EXPECT_TRUE(specify_if_defined(small_curve(), kMaxOrder));
  gl::Case outside;
  outside.EvalCoord1f(0);
  EXPECT_FALSE(specify_if_defined(outside, kMaxOrder));
  gl::Case open = small_curve();
  open.Begin(GL_POINTS);
  EXPECT_FALSE(specify_if_defined(open, kMaxOrder));
  gl::Case two_mistakes;
  two_mistakes.Map1f(GL_MAP1_VERTEX_3, 0, 0, 3, 0, std::vector<GLfloat>(6));
  two_mistakes.GetError();
  EXPECT_TRUE(specify_if_defined(two_mistakes, kMaxOrder)) << "both are INVALID_VALUE";
  two_mistakes.Map1f(GL_COEFF, 0, 0, 3, 0, std::vector<GLfloat>(6));
  two_mistakes.GetError();
  EXPECT_FALSE(specify_if_defined(two_mistakes, kMaxOrder)) << "INVALID_ENUM or INVALID_VALUE";
  gl::Case unasked;
  unasked.Enable(GL_COEFF);
  EXPECT_FALSE(specify_if_defined(unasked, kMaxOrder));
  gl::Case in_list;
  in_list.NewList(1, GL_COMPILE);
  in_list.EvalCoord1f(0);
  in_list.EndList();
  EXPECT_TRUE(specify_if_defined(in_list, kMaxOrder));
  in_list.CallList(1);
  EXPECT_FALSE(specify_if_defined(in_list, kMaxOrder));
}

// --- as data ----------------------------------------------------------------------------------------------

TEST(CaseJson, ComesBackTheSame) {
  for (std::uint32_t number = 0; number < 50; ++number) {
    const gl::Case program = random_program(2, number, kLength, kMaxOrder);
    EXPECT_EQ(text_of(gl::case_from_json(json::parse(gl::to_json(program).dump()))), text_of(program))
        << number;
  }
}

TEST(CaseJson, SaysWhatIsWrong) {
  const auto read = [](const char* text) { return gl::case_from_json(json::parse(text)); };
  for (const char* wrong :
       {"{}", "[[]]", "[[1]]", R"([["NoSuchCommand"]])", R"([["EvalCoord1f"]])", R"([["EvalCoord1f", "x"]])",
        R"([["Enable", "GL_NO_SUCH_TOKEN"]])", R"([["Enable", 1.5]])", R"([["EvalCoord1fv", [0.5]]])",
        R"([["EvalCoord1fv", {"f99": [0.5]}]])", R"([["EvalCoord1fv", {}]])",
        R"([["EvalCoord1fv", {"f32": ["x"]}]])", R"([["GetFloatv", "GL_CURRENT_COLOR", {"out": "f32"}]])",
        R"([["GetFloatv", "GL_CURRENT_COLOR", {"out": 4}]])",
        R"([["GetFloatv", "GL_CURRENT_COLOR", {"out": "f32", "count": -1}]])",
        R"([["GetFloatv", "GL_CURRENT_COLOR", {"out": "f32", "count": 1000000000000}]])"})
    EXPECT_THROW(read(wrong), std::invalid_argument) << wrong;
  gl::Case strings;
  strings.ShaderSource(1, 1, gl::Strings{{"void main() {}"}}, nullptr);
  EXPECT_THROW(gl::to_json(strings), std::invalid_argument);
}

// --- making small -----------------------------------------------------------------------------------------

TEST(Shrink, LeavesWhatMatters) {
  int asked = 0;
  const auto still = [&](const gl::Case& candidate) {
    ++asked;
    return specify_if_defined(candidate, kMaxOrder) && has(candidate, gl::EntryPoint::EvalCoord1d);
  };
  std::uint32_t number = 0;
  while (!has(random_program(1, number, kLength, kMaxOrder), gl::EntryPoint::EvalCoord1d)) ++number;
  const gl::Case small = shrink(random_program(1, number, kLength, kMaxOrder), still, 2000);
  EXPECT_LE(small.commands().size(), 5u) << text_of(small);
  EXPECT_NE(text_of(small).find("glEvalCoord1d(0.0)"), std::string::npos) << text_of(small);
  EXPECT_LT(asked, 2000);
}

TEST(Shrink, StopsWhenItMayNotAskAnyMore) {
  int asked = 0;
  const gl::Case program = random_program(1, 0, kLength, kMaxOrder);
  shrink(
      program, [&](const gl::Case&) { return ++asked % 3 == 0; }, 40);
  EXPECT_EQ(asked, 40);
}

// --- judging ----------------------------------------------------------------------------------------------

// Production, with a table of the test's.
class Altered final : public Implementation {
 public:
  explicit Altered(void (*alter)(gl::Table&)) : alter_(alter) {}
  std::string name() const override { return "altered"; }
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<AlteredContext>(inner_->create_context(), alter_);
  }
  static inline gl::Table sound;

 private:
  class AlteredContext final : public Context {
   public:
    AlteredContext(std::unique_ptr<Context> inner, void (*alter)(gl::Table&)) : inner_(std::move(inner)) {
      sound = table_ = inner_->table();
      if (alter) alter(table_);
    }
    const gl::Table& table() const override { return table_; }
    bool has_sink() const override { return true; }
    std::vector<ObservedPrimitive> take_emitted() override { return inner_->take_emitted(); }

   private:
    std::unique_ptr<Context> inner_;
    gl::Table table_;
  };

  std::unique_ptr<Implementation> inner_ = open_implementation({.name = "production"});
  void (*alter_)(gl::Table&);
};

struct Played {
  std::vector<json> findings;
  std::uint64_t programs = 0, commands = 0;
};

Played play_against(Implementation& implementation, std::uint32_t programs) {
  Subject subject;
  subject.implementation = &implementation;
  subject.info = inquire(implementation);
  Captures captures(implementation, subject.info, nullptr);
  subject.captures = &captures;
  Played played;
  play(subject, {.programs = programs, .length = 60}, [&](const json& event) {
    if (event["event"] == "finding") played.findings.push_back(event);
    if (event["event"] == "progress") {
      played.programs = event["programs"];
      played.commands = event["commands"];
    }
  });
  return played;
}

TEST(Campaign, FindsNothingInASoundEvaluator) {
  Altered sound(nullptr);
  const Played played = play_against(sound, 40);
  EXPECT_EQ(played.programs, 40u);
  EXPECT_GT(played.commands, 40u * 60);
  for (const json& finding : played.findings) ADD_FAILURE() << finding.dump(1);
}

// EvalCoord2d mixes up its arguments: a defect of one form.
TEST(Campaign, FindsADefectAndMakesItSmall) {
  Altered altered([](gl::Table& table) {
    table.EvalCoord2d = [](GLdouble u, GLdouble v) { Altered::sound.EvalCoord2d(v, u); };
  });
  const Played played = play_against(altered, 40);
  ASSERT_FALSE(played.findings.empty());
  const json& finding = played.findings.front()["finding"];
  const gl::Case program = gl::case_from_json(finding["program"]);
  EXPECT_LE(program.commands().size(), 5u) << text_of(program);
  EXPECT_TRUE(has(program, gl::EntryPoint::EvalCoord2d)) << text_of(program);
  EXPECT_EQ(finding["cause"], "Begin, Enable, End, EvalCoord2, Map2: position");
  EXPECT_EQ(finding["outside_evaluators"], false);
}

// Color4f goes wrong with explicit vertices as well: that is said, and its cause cannot hide one of
// evaluation.
TEST(Campaign, TellsDefectsOutsideEvaluatorsApart) {
  Altered altered([](gl::Table& table) {
    table.Color4f = [](GLfloat r, GLfloat g, GLfloat b, GLfloat a) { Altered::sound.Color4f(g, r, b, a); };
  });
  const Played played = play_against(altered, 200);
  ASSERT_FALSE(played.findings.empty());
  const json& finding = played.findings.front()["finding"];
  EXPECT_EQ(finding["outside_evaluators"], true) << finding.dump(1);
  EXPECT_EQ(finding["cause"].get<std::string>().find("Eval"), std::string::npos) << finding["cause"];
}

// An answer, not a vertex.
TEST(Campaign, FindsAWrongAnswer) {
  Altered altered([](gl::Table& table) {
    table.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
      Altered::sound.MapGrid1f(n < 1 ? 1 : n, u1, u2);
    };
  });
  const Played played = play_against(altered, 400);
  ASSERT_FALSE(played.findings.empty());
  EXPECT_EQ(played.findings.front()["finding"]["cause"], "GetError, MapGrid1: glGetError");
}

// --- the command ------------------------------------------------------------------------------------------

class FuzzCommand : public ProgramTest {
 protected:
  Outcome fuzz(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"fuzz", "--output", folder_.string()});
    return evalcts(arguments);
  }
  Outcome fuzz_drill(const char* drill) {
    setenv("EVALCTS_DRILL", drill, 1);
    return fuzz({"--implementation", "osmesa", "--library", DRILL_LIBRARY, "--programs", "150"});
  }
  json finding() const {
    std::ifstream file(folder_ / "fuzz-osmesa-1.json");
    return json::parse(file, nullptr, false);
  }
};

TEST_F(FuzzCommand, SaysWhatItNeeds) {
  EXPECT_EQ(fuzz({}).code, 2);
  EXPECT_EQ(fuzz({"--implementation", "no-such-implementation", "--programs", "1"}).code, 2);
  EXPECT_EQ(fuzz({"--library", "/no/such/library.so", "--programs", "1"}).code, 2);
}

TEST_F(FuzzCommand, ProductionHoldsOut) {
  // What an earlier call found goes; what is called alike stays.
  for (const char* file : {"fuzz-production-1.json", "fuzz-production-1.c", "fuzz-production-old-1.json"})
    std::ofstream(folder_ / file) << "{}";
  const Outcome outcome = fuzz({"--implementation", "production", "--programs", "40", "--seed", "5"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("seed 5: 40 programs (40 of them seen in full)"), std::string::npos)
      << outcome.text;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fuzz-production-1.json"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fuzz-production-1.c"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "fuzz-production-old-1.json"));
}

// Map1f for INDEX with order 5 crashes.
TEST_F(FuzzCommand, ACrashIsMadeSmall) {
  const Outcome outcome = fuzz_drill("crash");
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  EXPECT_NE(outcome.text.find("150 programs"), std::string::npos) << outcome.text;
  ASSERT_TRUE(finding().is_object()) << outcome.text;
  EXPECT_EQ(finding()["cause"], "Map1: crash");
  EXPECT_EQ(finding()["program"].size(), 1u);
  std::ifstream program(folder_ / "fuzz-osmesa-1.c");
  EXPECT_TRUE(program) << "a C program";
}

TEST_F(FuzzCommand, AWrongAnswerIsMadeSmall) {
  const Outcome outcome = fuzz_drill("lenient");
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  ASSERT_TRUE(finding().is_object()) << outcome.text;
  EXPECT_EQ(finding()["what"], "glGetError");
  EXPECT_EQ(finding()["program"].size(), 2u) << finding()["program"];
}

}  // namespace
}  // namespace evalcts::fuzz
