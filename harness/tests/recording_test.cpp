// Tests of recordings: their file format, and the programs into which they are split.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <fstream>
#include <limits>
#include <thread>

#include <evalcts/fuzz/random_program.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/roles.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/record/format.h>
#include <evalcts/record/programs.h>
#include <evalcts/record/recording.h>
#include <evalcts/record/writer.h>
#include "program.h"

namespace evalcts {
namespace {

using nlohmann::json;
using record::Recording;

class RecordingFile : public record::RecordingWriter {
 public:
  RecordingFile() : RecordingWriter({"viewer", "-fast"}, {{"glLightfv", 7}, {"glRectf", 9}}) {}
  void context(std::uint64_t number, std::uint32_t of_thread = 0) {
    thread(of_thread);
    RecordingWriter::context(number);
  }
  void commands(const gl::Case& script) {
    for (const gl::Command& each : script.commands()) command(each);
  }
  void write(const std::filesystem::path& file) const { std::ofstream(file, std::ios::binary) << text(); }
};

class Recordings : public testing::Test {
 protected:
  void write(const std::string& text) { std::ofstream(file_, std::ios::binary | std::ios::trunc) << text; }
  // Returns the message with which a text is rejected.
  std::string rejection_of(const std::string& text) {
    write(text);
    try {
      const Recording recording(file_);
    } catch (const record::BadRecording& error) {
      return error.what();
    }
    return "accepted";
  }
  std::vector<record::Program> programs(const RecordingFile& recorded, const record::Frames& frames = {}) {
    recorded.write(file_);
    return record::programs_of(Recording(file_), frames);
  }

  const std::filesystem::path file_ =
      testing::TempDir() + "/" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".evalrec";
};

gl::Case curve() {
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 3, 2, std::vector<float>{0, 0, 0, 1, 2, 3});
  c.Enable(GL_MAP1_VERTEX_3);
  return c;
}

gl::Case points() {
  gl::Case c;
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.End();
  return c;
}

std::string commands_of(const Recording& recording, std::size_t context) {
  gl::Case script;
  recording.read(
      context, [&](gl::Command command) { script.add(std::move(command)); }, [] {});
  return gl::to_text(script, gl::NonFinite::kByName);
}

TEST_F(Recordings, ReadBackBitForBit) {
  gl::Case c = curve();
  c.Map1d(GL_MAP1_COLOR_4, -1.0, std::numeric_limits<double>::denorm_min(), 4, 1,
          std::vector<double>{std::nan(""), HUGE_VAL, -HUGE_VAL, -0.0});
  c.append(points());
  c.CallLists(2, GL_UNSIGNED_INT, std::vector<GLuint>{1, 4000000000u});
  c.MapGrid1f(-3, 0.0f, 0.0f);
  RecordingFile recorded;
  recorded.context(1);
  recorded.commands(c);
  recorded.write(file_);
  const Recording recording(file_);
  ASSERT_EQ(recording.contexts(), 1u);
  EXPECT_EQ(commands_of(recording, 0), gl::to_text(c, gl::NonFinite::kByName));
  EXPECT_EQ(recording.program(), (std::vector<std::string>{"viewer", "-fast"}));
  ASSERT_EQ(recording.others().size(), 2u);
  EXPECT_EQ(recording.others()[0].name, "glRectf");
  EXPECT_EQ(recording.others()[0].times, 9u);
  EXPECT_EQ(recording.problem(), "");
}

TEST_F(Recordings, CommandsOfAContextAreInOrderAlthoughThreadsTakeTurns) {
  RecordingFile recorded;
  recorded.context(7, 0);
  recorded.commands(curve());
  recorded.context(7, 1);
  recorded.commands(points());
  recorded.context(8, 0);
  recorded.commands(points());
  recorded.destroy(8);
  recorded.context(8, 0);  // another context at the same address
  recorded.commands(curve());
  recorded.write(file_);
  const Recording recording(file_);
  ASSERT_EQ(recording.contexts(), 3u);
  gl::Case both = curve();
  both.append(points());
  EXPECT_EQ(commands_of(recording, 0), gl::to_text(both));
  EXPECT_EQ(commands_of(recording, 1), gl::to_text(points()));
  EXPECT_EQ(commands_of(recording, 2), gl::to_text(curve()));
}

TEST_F(Recordings, DamageIsNamedAndTheRestIsRead) {
  RecordingFile recorded;
  recorded.context(1);
  recorded.commands(curve());
  recorded.context(2, 1);
  recorded.commands(points());
  const std::string whole = recorded.text();
  EXPECT_TRUE(contains(rejection_of("GIF89a"), "not a recording"));
  EXPECT_TRUE(contains(rejection_of(""), "not a recording"));
  EXPECT_TRUE(contains(rejection_of(whole.substr(0, 1000)), "ends within its header"));
  std::string other = whole;
  other[7] = '9';
  EXPECT_TRUE(contains(rejection_of(other), "version 9"));
  other = whole;
  other[sizeof(record::FileHeader)] = '[';
  EXPECT_TRUE(contains(rejection_of(other), "damaged header"));

  write(whole.substr(0, whole.size() - record::kAlignment + 40));  // within the second chunk
  const Recording cut(file_);
  EXPECT_TRUE(contains(cut.problem(), "damaged or was cut"));
  EXPECT_EQ(commands_of(cut, 0), gl::to_text(curve()));

  // Each byte of the header and of the chunks may have any value.
  for (std::size_t at = 0; at < sizeof(record::FileHeader); ++at)
    for (const char value : {'\0', '\xFF'}) {
      std::string damaged = whole;
      damaged[at] = value;
      rejection_of(damaged);
    }
  std::string small = whole;
  small.replace(offsetof(record::FileHeader, size), 8, 8, '\0');
  small[offsetof(record::FileHeader, text_length) + 5] = '\x7F';
  EXPECT_TRUE(contains(rejection_of(small), "ends within its header"));
  const std::size_t header = whole.size() - 2 * record::kAlignment;
  for (std::size_t at = header; at < whole.size(); at += at % record::kAlignment < 200 ? 1 : 4999) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0xA5);
    write(damaged);
    const Recording recording(file_);
    for (std::size_t context = 0; context < recording.contexts(); ++context) commands_of(recording, context);
  }
}

TEST_F(Recordings, WhatCannotBeReplayedIsLeftOut) {
  RecordingFile recorded;
  recorded.context(1);
  recorded.command(curve().commands()[0], false);
  recorded.commands(points());
  recorded.write(file_);
  const Recording recording(file_);
  ASSERT_EQ(recording.left_out().size(), 1u);
  EXPECT_EQ(recording.left_out()[0].name, "glMap1f");
  EXPECT_EQ(commands_of(recording, 0), gl::to_text(points()));
}

TEST_F(Recordings, EqualFramesAreOneProgram) {
  RecordingFile recorded;
  recorded.context(1);
  recorded.commands(curve());
  for (int i = 0; i < 3; ++i) {
    recorded.commands(points());
    recorded.frame();
  }
  const auto all = programs(recorded);
  ASSERT_EQ(all.size(), 2u);  // the first one defines the map
  EXPECT_EQ(all[1].name, "Frame1/1");
  EXPECT_EQ(all[1].times, 2u);
  EXPECT_EQ(all[1].vertices, 1u);
}

TEST_F(Recordings, FramesAreChosenWithTheStateBeforeThem) {
  RecordingFile recorded;
  recorded.context(1);
  recorded.commands(curve());
  recorded.frame();
  recorded.commands(points());
  recorded.frame();
  const auto second = programs(recorded, {1, 1});
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].name, "Frame1/1");
  EXPECT_EQ(second[0].vertices, 1u);
  EXPECT_TRUE(programs(recorded, {2, 5}).empty());
}

TEST_F(Recordings, FramesWithoutEvaluatorsAreNotJudged) {
  RecordingFile recorded;
  recorded.context(1);
  gl::Case triangle;
  triangle.Begin(GL_TRIANGLES);
  for (int i = 0; i < 3; ++i) triangle.Vertex2f(0, 0);
  triangle.End();
  recorded.commands(triangle);
  recorded.frame();
  recorded.commands(curve());
  recorded.commands(points());
  recorded.commands(triangle);  // its current values may be those of the evaluation
  recorded.frame();
  const auto all = programs(recorded);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].name, "Frame1/1");
  EXPECT_EQ(all[0].vertices, 4u);
}

TEST_F(Recordings, LongFramesAreSeveralPrograms) {
  RecordingFile recorded;
  recorded.context(1);
  recorded.commands(curve());
  for (int i = 0; i < 5000; ++i) recorded.commands(points());
  std::uint64_t vertices = 0;
  const auto all = programs(recorded);
  for (const record::Program& program : all) vertices += program.times * program.vertices;
  EXPECT_GT(all.size(), 1u);
  EXPECT_EQ(vertices, 5000u);
}

TEST_F(Recordings, OtherPartsOfTheGlAndRejectedCommandsChangeNothing) {
  RecordingFile recorded;
  recorded.context(1);
  gl::Case c = curve();
  c.Enable(GL_LIGHTING);
  c.GetError();
  c.Map1f(GL_MAP1_VERTEX_3, 1.0f, 1.0f, 3, 2, std::vector<float>{5, 5, 5, 6, 6, 6});  // INVALID_VALUE
  c.Flush();
  c.append(points());
  recorded.commands(c);
  const auto all = programs(recorded);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_FALSE(contains(all[0].commands, "LIGHTING"));
  EXPECT_FALSE(contains(all[1].commands, "5.0"));
  // One GetError for each kind of error is behind the program that raises one.
  const gl::Case first = gl::parse_case(all[0].commands);
  EXPECT_EQ(std::ranges::count(first.commands(), gl::EntryPoint::GetError, &gl::Command::entry), 1 + 6);
}

constexpr float kUndefined = -12345;  // in place of NaN, which is unequal to itself

// The evaluated vertices of a case, as correctly rounded numbers.
std::vector<std::vector<float>> evaluated(const gl::Case& script) {
  std::vector<std::vector<float>> all;
  for (const reference::Primitive& primitive : predict(script, reference::kMaxOrder).primitives)
    for (const reference::Vertex& vertex : primitive.vertices) {
      if (std::holds_alternative<float>(vertex.position[0])) continue;
      std::vector<float>& values = all.emplace_back();
      for (const auto& part : {vertex.position, vertex.color, vertex.texture_coordinate[0]})
        for (const reference::Component& component : part) values.push_back(reference::rounded(component));
      for (const float value : reference::rounded(vertex.normal)) values.push_back(value);
      std::ranges::replace_if(
          values, [](float value) { return std::isnan(value); }, kUndefined);
    }
  return all;
}

// Random commands, with lists, errors, and the attribute stack, are split at many places. Each program has to
// draw what the whole draws there.
TEST_F(Recordings, ProgramsDrawWhatTheWholeDraws) {
  constexpr std::uint32_t kSeed = 1;
  std::size_t split = 0, vertices = 0;
  for (std::uint32_t number = 0; number < 60; ++number) {
    const gl::Case whole = fuzz::random_past(kSeed, number, 150, reference::kMaxOrder);
    RecordingFile recorded;
    recorded.context(1);
    std::size_t i = 0;
    for (const gl::Command& command : whole.commands()) {
      recorded.command(command);
      if (++i % 7 == 0) recorded.frame();
    }
    std::vector<std::vector<float>> parts;
    bool is_repeated = false;
    const auto all = programs(recorded);
    for (const record::Program& program : all) {
      is_repeated = is_repeated || program.times > 1;
      for (auto& vertex : evaluated(gl::parse_case(program.commands))) parts.push_back(std::move(vertex));
    }
    split += all.size();
    const auto expected = evaluated(whole);
    vertices += expected.size();
    if (is_repeated) continue;
    const auto [part, due] = std::ranges::mismatch(parts, expected);
    EXPECT_TRUE(parts == expected) << fmt::format(
        "seed {}, program {}: {} vertices, expected {}; vertex {} is the first that differs: {}, expected {}",
        kSeed, number, parts.size(), expected.size(), part - parts.begin(),
        part == parts.end() ? "missing" : testing::PrintToString(*part),
        due == expected.end() ? "none" : testing::PrintToString(*due));
  }
  EXPECT_GT(split, 300u);
  EXPECT_GT(vertices, 300u);
}

// --- evalcts check -----------------------------------------------------------------------------------------

class CheckRecording : public ProgramTest {
 protected:
  CheckRecording() {
    gl::Case map;  // the wrong sink takes all domains for [0,1]
    map.Map1f(GL_MAP1_VERTEX_3, 0.0f, 2.0f, 3, 2, std::vector<float>{0, 0, 0, 1, 2, 3});
    map.Enable(GL_MAP1_VERTEX_3);
    recorded_.context(1);
    recorded_.commands(map);
    for (int i = 0; i < 3; ++i) {
      recorded_.commands(points());
      recorded_.frame();
    }
    recorded_.write(file_);
  }
  Outcome check(std::vector<std::string> options) {
    options.insert(options.begin(), {"check", file_, "--output", folder_.string()});
    return evalcts(options);
  }

  RecordingFile recorded_;
  const std::string file_ = folder_ / "points.evalrec";
};

TEST_F(CheckRecording, SaysWhatIsRightAndWhatIsWrong) {
  const Outcome right = check({"--library", SMALLEST_SINK});
  EXPECT_EQ(right.code, 0) << right.text;
  EXPECT_TRUE(
      contains(right.text, "viewer -fast: 3 programs in 1 context, 2 of them different; vertices: 3\n"))
      << right.text;
  EXPECT_TRUE(contains(right.text, ": 0 programs wrong, 3 right\n")) << right.text;
  const Outcome wrong = check({"--library", WRONG_SINK});
  EXPECT_EQ(wrong.code, 1) << wrong.text;
  EXPECT_TRUE(contains(wrong.text, ": 3 programs wrong, 0 right\n  Frame0/1: 1 of 1 vertices: position."))
      << wrong.text;
  EXPECT_TRUE(contains(wrong.text, "\n  Frame1/1, 2 times: 1 of 1 vertices: position.")) << wrong.text;
  EXPECT_TRUE(contains(wrong.text, "1 distinct bug")) << wrong.text;
  EXPECT_EQ(results("library")["summary"]["fail"], 2);
  const json test = test_named(results("library"), "Recording.Frame1/1");
  EXPECT_TRUE(contains(test["rerun"], " check " + file_ + " --library ")) << test["rerun"];
  EXPECT_TRUE(as_text(test["rerun"]).ends_with(" --frames 1")) << test["rerun"];
  const Outcome reproduced = evalcts({"reproduce", "Recording.Frame1/1", "--run", folder_.string()});
  EXPECT_TRUE(contains(reproduced.text, "a sink")) << reproduced.text;  // has no C program
}

TEST_F(CheckRecording, AWorkerElsewhereGetsThePrograms) {
  for (const auto& [library, code, words] : {std::tuple{SMALLEST_SINK, 0, ": 0 programs wrong, 3 right\n"},
                                             {WRONG_SINK, 1, ": 3 programs wrong, 0 right\n"}}) {
    const Outcome outcome = check({"--library", library, "--worker", EVALCTS_PROGRAM "-suite"});
    EXPECT_EQ(outcome.code, code) << outcome.text;
    EXPECT_TRUE(contains(outcome.text, words)) << outcome.text;
  }
}

TEST_F(CheckRecording, JudgesSeveralImplementations) {
  const Outcome both = check({"--implementation", "production", "--implementation", "reference"});
  EXPECT_EQ(both.code, 0) << both.text;
  for (const char* const name : {"production", "reference"})
    EXPECT_EQ(as_text(test_named(results(name), "Recording.Frame0/1")["verdict"]), "pass");
}

// The wrong sink hangs in a map of order 6.
TEST_F(CheckRecording, AnInterruptedCheckDecidesNothing) {
  gl::Case map;
  map.Map1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 3, 6, std::vector<float>(18, 1.0f));
  map.Enable(GL_MAP1_VERTEX_3);
  map.append(points());
  RecordingFile hanging;
  hanging.context(1);
  hanging.commands(map);
  hanging.write(file_);
  const std::filesystem::path reached = folder_ / "reached", log = folder_ / "command.log";
  setenv("EVALCTS_DRILL", "hang", 1);
  setenv("EVALCTS_DRILL_FILE", reached.c_str(), 1);
  ChildProcess check({EVALCTS_PROGRAM, "check", file_, "--output", folder_.string(), "--library", WRONG_SINK},
                     log.string());
  for (int i = 0; i < 1000 && !std::filesystem::exists(reached); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(check.id(), SIGINT);
  const auto ending = check.wait(20);
  unsetenv("EVALCTS_DRILL_FILE");
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->value, 125) << read_file(log);
  EXPECT_TRUE(contains(read_file(log), "evalcts: interrupted; the results so far")) << read_file(log);
}

// The smallest sink has no surfaces.
TEST_F(CheckRecording, AnUnobservedCheckDecidesNothing) {
  gl::Case map;
  map.Map2f(GL_MAP2_VERTEX_3, 0.0f, 1.0f, 3, 2, 0.0f, 1.0f, 6, 2, std::vector<float>(12, 1.0f));
  map.Enable(GL_MAP2_VERTEX_3);
  map.Begin(GL_POINTS);
  map.EvalCoord2f(0.5f, 0.5f);
  map.End();
  RecordingFile surface;
  surface.context(1);
  surface.commands(map);
  surface.write(file_);
  const Outcome outcome = check({"--library", SMALLEST_SINK});
  EXPECT_EQ(outcome.code, 125) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "programs could be observed, which decides nothing")) << outcome.text;
}

TEST_F(CheckRecording, BadInputIsNamed) {
  const auto expect_unknown = [&](const Outcome& outcome, const std::string& why) {
    EXPECT_EQ(outcome.code, 125) << outcome.text;
    EXPECT_TRUE(contains(outcome.text, why)) << outcome.text;
  };
  expect_unknown(check({"--implementation", "production", "--frames", "9"}),
                 "no evaluator command is executed");
  expect_unknown(check({"--implementation", "production", "--frames", "2..1"}), "is not A..B or A");
  expect_unknown(check({}), "check needs --implementation");
  const std::string whole = recorded_.text();
  std::ofstream(file_, std::ios::binary | std::ios::trunc) << whole.substr(0, 100);
  expect_unknown(check({"--implementation", "production"}), "ends within its header");
  std::ofstream(file_, std::ios::binary | std::ios::trunc)
      << whole.substr(0, whole.size() - record::kAlignment + 140);
  const Outcome cut = check({"--implementation", "production"});
  EXPECT_EQ(cut.code, 0) << cut.text;
  EXPECT_TRUE(contains(cut.text, "note: the file is damaged or was cut")) << cut.text;
}

}  // namespace
}  // namespace evalcts
