// Tests `evalcts reproduce`, by building and running the C programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <evalcts/results/json.h>
#include "drill.h"

namespace evalcts {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class Reproduce : public DrillTest {
 protected:
  // Writes the program and builds it with the command that evalcts prints, without starting it.
  // Returns the text that evalcts prints. An empty style is not given.
  std::string write_and_build(const std::string& failure, const std::string& style = "full") {
    const std::string file = (folder_ / "x.c").string();
    std::vector<std::string> command = {"reproduce", failure, "--run", folder_.string(), "--output", file};
    if (!style.empty()) command.insert(command.end(), {"--style", style});
    const Outcome written = evalcts(command);
    build(written);
    return written.text;
  }

 private:
  void build(const Outcome& written) {
    ASSERT_EQ(written.code, 0) << written.text;
    const std::size_t begin = written.text.find("  cc "), end = written.text.find(" && ", begin);
    ASSERT_NE(end, std::string::npos) << written.text;
    const std::string line = "cc " CC_OPTIONS + written.text.substr(begin + 4, end - begin - 4);
    const Outcome built = start({"/bin/sh", "-c", line});
    ASSERT_EQ(built.code, 0) << built.text;
  }

 protected:
  Outcome program(const std::string& library = {}) {
    std::vector<std::string> command = {(folder_ / "x").string()};
    if (!library.empty()) command.push_back(library);
    return start(command);
  }
};

// The C program fails with the library that was judged, and passes with a correct library.
TEST_F(Reproduce, AFailureBecomesACProgram) {
  ASSERT_EQ(drill("lenient", {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_*_f"}).code, 1);
  const json test = test_named(results("drill"), "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f");
  EXPECT_TRUE(contains(test["reproducer"], " reproduce drill:Map1Errors.StrideBelowK/MAP1_VERTEX_3_f "));
  write_and_build("drill:Map1Errors.StrideBelowK/MAP1_VERTEX_3_f");
  const Outcome shown = program();
  EXPECT_EQ(shown.code, 1);
  EXPECT_TRUE(
      contains(shown.text, "glGetError(): expected GL_INVALID_VALUE, got GL_NO_ERROR\nthe failure shows"));
  setenv("EVALCTS_DRILL", "nothing", 1);
  const Outcome sound = program(DRILL_LIBRARY);
  EXPECT_EQ(sound.code, 0) << sound.text;
  EXPECT_EQ(program("/absent.so").code, 2);
  EXPECT_EQ(program("libm.so.6").code, 2);
}

// Without --style, the program is short if it shows the failure.
TEST_F(Reproduce, ShortProgramsAreTried) {
#if __has_include(<GL/osmesa.h>) && !defined(__SANITIZE_ADDRESS__)
  const std::string file = (folder_ / "x.c").string();
  const auto reproduce = [&](const std::string& failure) {
    return evalcts({"reproduce", failure, "--run", folder_.string(), "--output", file});
  };
  ASSERT_EQ(drill("lenient", {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f"}).code, 1);
  const Outcome written = reproduce("StrideBelowK");
  EXPECT_EQ(written.code, 0) << written.text;
  EXPECT_FALSE(contains(written.text, "style 'full'"));
  EXPECT_FALSE(contains(written.text, "not tried"));
  const std::string program = read_file(file);
  EXPECT_TRUE(contains(program, "#include <GL/osmesa.h>"));
  EXPECT_LE(std::ranges::count(program, '\n'), 60) << program;

  ASSERT_EQ(drill("crash", {"--filter", kVictim, "--timeout", "2"}).code, 1);
  const Outcome crash = reproduce("MAP1_INDEX_f");
  EXPECT_EQ(crash.code, 0);
  EXPECT_FALSE(contains(crash.text, "style 'full'")) << crash.text;
#else
  GTEST_SKIP() << "needs GL/osmesa.h, and no sanitizer";
#endif
}

TEST_F(Reproduce, ACrashAndAHangAsWell) {
  for (const std::string way : {"crash", "abort", "hang"}) {
#ifdef __SANITIZE_ADDRESS__
    if (way == "crash") continue;  // with sanitizers, no handler can catch this crash
#endif
    ASSERT_EQ(drill(way, {"--filter", kVictim, "--timeout", "2"}).code, 1);
    write_and_build("MAP1_INDEX_f");  // a part of the name is enough
    const Outcome shown = program();
    EXPECT_EQ(shown.code, 1) << way << shown.text;
    EXPECT_TRUE(contains(shown.text, "the failure shows"));
    setenv("EVALCTS_DRILL", "nothing", 1);
    EXPECT_EQ(program().code, 0);
  }
}

// A library without OSMesaCreateContextExt is judged, and the C program makes its contexts, too.
TEST_F(Reproduce, WithoutTheExtendedFormOfCreateContext) {
  const std::string test = "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f";
  std::vector<std::string> arguments = drill_arguments("lenient", {"--filter", test});
  std::ranges::replace(arguments, std::string(DRILL_LIBRARY), std::string(DRILL_PLAIN_OSMESA_LIBRARY));
  ASSERT_EQ(evalcts(arguments).code, 1);
  write_and_build("drill:" + test);
  const Outcome shown = program();
  EXPECT_EQ(shown.code, 1) << shown.text;
  setenv("EVALCTS_DRILL", "nothing", 1);
  EXPECT_EQ(program().code, 0);
}

// The C program puts a drop-in library in front of the same GL, and passes with that GL alone.
TEST_F(Reproduce, ADropInLibrary) {
  struct Judged {
    std::string implementation, gl, drill;
  };
  const std::string test = "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f";
  int count = 0;
  for (const auto& [implementation, gl, drill] : {Judged{"dropin", "libOSMesa.so.8", ""},
                                                  {"dropin", "libOSMesa.so.8", "plain"},
                                                  {"dropin-egl", "libEGL.so.1", ""}}) {
    SCOPED_TRACE(implementation + " " + drill);
    setenv("EVALCTS_DRILL", drill.c_str(), 1);
    const Outcome run = evalcts({"run", "--implementation", implementation, "--library", WRONG_DROPIN,
                                 "--filter", test, "--output", folder_.string(), "--baseline", "none"});
    if (test_named(results(implementation), test).is_null()) {
      EXPECT_TRUE(drill.empty() || count == 0) << run.text;
      continue;
    }
    ++count;
    EXPECT_EQ(run.code, 1) << run.text;
    EXPECT_TRUE(contains(write_and_build(implementation + ":" + test, ""),
                         "style 'full', because the commands come from another library"));
    const Outcome shown = program();
    EXPECT_EQ(shown.code, 1) << shown.text;
    EXPECT_TRUE(contains(shown.text, "the failure shows"));
    EXPECT_EQ(program(gl).code, 0);
    fs::remove(folder_ / ("results-" + implementation + ".json"));
  }
  if (count == 0) GTEST_SKIP() << "neither OSMesa nor EGL here";
}

// The C program contains the commands of the capture. Uses a known failure of Mesa, if it is installed.
TEST_F(Reproduce, WhatACaptureSaw) {
  const std::string test = "Evaluation.NothingWithoutVertexMap/MAP1_NORMAL/EvalCoord1f";
  const Outcome run = evalcts({"run", "--implementation", "osmesa", "--filter", test, "--depth", "quick",
                               "--output", folder_.string(), "--baseline", "none"});
  // There is no result if OSMesa is missing, or does not start under sanitizers.
  const json known = test_named(results("osmesa"), test);
  if (known.is_null() || as_text(known["verdict"]) != "fail") GTEST_SKIP() << run.text;
  write_and_build(test);
  const Outcome shown = program();
  EXPECT_EQ(shown.code, 1) << shown.text;
  EXPECT_TRUE(contains(shown.text, "normal.x of vertex 0: expected 0.6"));
}

// The judge of this test rejects observations that show less than the test asked for. Uses a known failure of
// Mesa, if it is installed.
TEST_F(Reproduce, ATestWithAJudgeOfItsOwn) {
  const std::string test = "Points.LastIsExact/2-D_U";
  const Outcome run = evalcts({"run", "--implementation", "egl", "--filter", test, "--output",
                               folder_.string(), "--baseline", "none"});
  const json known = test_named(results("egl"), test);
  if (known.is_null() || as_text(known["verdict"]) != "fail") GTEST_SKIP() << run.text;
  write_and_build(test);
  EXPECT_EQ(program().code, 1);
}

// The commands that are recorded with a failure work unmodified.
TEST_F(Reproduce, RerunIsRight) {
  ASSERT_EQ(drill("lenient", {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_*_f", "--seed", "7"}).code, 1);
  const json before = test_named(results("drill"), "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f");
  const Outcome again =
      start({"/bin/sh", "-c", before["rerun"].get<std::string>() + " --output " + folder_.string()});
  EXPECT_EQ(again.code, 1) << again.text;
  ASSERT_EQ(results("drill")["tests"].size(), 1u);
  const json after = results("drill")["tests"][0];
  EXPECT_EQ(after["seed"], 7);
  EXPECT_EQ(after["message"], before["message"]);
  EXPECT_TRUE(contains(before["debug"], "gdb --args "));
  const Outcome debugged =
      start({"/bin/sh", "-c", before["debug"].get<std::string>().substr(std::string("gdb --args ").size())});
  EXPECT_EQ(debugged.code, 1);
  EXPECT_TRUE(contains(debugged.text, "1 FAILED TEST"));
}

// A result file of unknown origin must not be able to choose files to write, options or paths, or to control
// the terminal.
TEST_F(Reproduce, ResultsAreNotTrusted) {
  ASSERT_EQ(drill("lenient", {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_*_f"}).code, 1);
  const json good = results("drill");
  const fs::path elsewhere = folder_ / "elsewhere";
  const auto answer = [&](const json& changed) {
    std::ofstream(folder_ / "results-drill.json") << changed;
    return evalcts({"reproduce", "StrideBelowK", "--run", folder_.string()});
  };
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--events", elsewhere},
                                               {"--reproduce", elsewhere},
                                               {"--seed", "--events=" + elsewhere.string()},
                                               {"--gtest_output=xml:" + elsewhere.string(), "x"},
                                               {"--depth"}}) {
    json changed = good;
    for (const std::string& word : more) changed["suite_command"].push_back(word);
    const Outcome outcome = answer(changed);
    EXPECT_EQ(outcome.code, 2) << more[0];
    EXPECT_TRUE(contains(outcome.text, "suite_command: "));
    EXPECT_FALSE(fs::exists(elsewhere)) << more[0];
  }
  json changed = good;
  for (const std::string& word : {std::string("--worker"), "touch " + elsewhere.string() + ";"})
    changed["suite_command"].push_back(word);
  EXPECT_EQ(answer(changed).code, 2);
  EXPECT_FALSE(fs::exists(elsewhere));
  changed = good;
  changed["implementation"]["captures"] = {{{"name", "a,--events"}, {"available", true}}};
  EXPECT_EQ(answer(changed).code, 2);
  for (const char* member : {"timeout", "tests", "implementation", "suite_command"}) {
    changed = good;
    changed[member] = "something else";
    EXPECT_EQ(answer(changed).code, 2) << member;
  }
  changed = good;
  for (json& test : changed["tests"])
    test["name"] = "../../StrideBelowK\x1b[2J" + test["name"].get<std::string>();
  const Outcome outcome = answer(changed);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_FALSE(contains(outcome.text, "\x1b"));
}

TEST_F(Reproduce, WrongUseSaysWhatToDo) {
  const auto answer = [&](const std::string& failure) {
    return evalcts({"reproduce", failure, "--run", folder_.string()});
  };
  EXPECT_EQ(answer("x").code, 2);
  EXPECT_TRUE(contains(answer("x").text, "contains no results"));
  drill("lenient", {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_*"});
  EXPECT_EQ(answer("no such test").code, 2);
  EXPECT_TRUE(contains(answer("no such test").text, "drill:Map1Errors.StrideBelowK/MAP1_VERTEX_3_f"));
  EXPECT_TRUE(contains(answer("Map1Errors.StrideBelowK/MAP1_VERTEX_4_f").text, "did not fail in that run"));
  setenv("EVALCTS_DRILL", "nothing", 1);
  const Outcome passes = answer("drill:Map1Errors.StrideBelowK/MAP1_VERTEX_3_f");
  EXPECT_EQ(passes.code, 2);
  EXPECT_TRUE(contains(passes.text, "passes now"));
  std::ofstream(folder_ / "results-broken.json") << "{";
  EXPECT_TRUE(contains(answer("x").text, "results-broken.json holds no results"));
  EXPECT_EQ(evalcts({"reproduce"}).code, 2);
}

}  // namespace
}  // namespace evalcts
