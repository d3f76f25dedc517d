// Contexts of real GL libraries, where these are installed.
#include <malloc.h>

#include <cstdlib>

#include "harness/implementations/implementation.h"
#include "harness/tests/program.h"

namespace evalcts {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kFewTests =
    "InitialState.*:GetnMap.*:Map1Values.Ends/*/EvalCoord1f:Map1Errors.StrideBelowK/*_f";

class GlLibrary : public ProgramTest {
 protected:
  ~GlLibrary() override { unsetenv("LD_LIBRARY_PATH"); }

  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "run");
    for (const char* more : {"--depth", "quick", "--filter", kFewTests, "--output", folder_.c_str()})
      arguments.emplace_back(more);
    return evalcts(arguments);
  }

  bool available(const std::string& name) {
    const json list = json::parse(evalcts({"list", "implementations", "--json"}).text, nullptr, false);
    for (const json& entry : list["implementations"])
      if (entry["name"] == name) return entry["available"];
    return false;
  }

  // All passed, and vertices were captured in both ways that GL offers.
  void expect_judged(const Outcome& outcome, const std::string& name) {
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    const json result = results(name);
    ASSERT_EQ(result["status"], "complete") << outcome.text;
    EXPECT_GT(result["summary"].value("pass", 0), 20) << outcome.text;
    EXPECT_EQ(result["summary"].size(), 1u) << result["summary"];
    for (const json& capture : result["implementation"]["captures"])
      EXPECT_EQ(capture["available"], capture["name"] != "Sink") << capture;
  }
};

TEST_F(GlLibrary, OSMesaContexts) {
  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  expect_judged(run({"--context", "osmesa"}), "library");
  expect_judged(run({"--context", OSMESA_PROVIDER}), "library");
  expect_judged(run({"--context", "osmesa", "--library", "libOSMesa.so.8", "--name", "same"}), "same");
  // What the library only depends on is not its own.
  const Outcome outcome = run({"--context", "osmesa", "--library", "libGLU.so.1"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.text.find("glGetString"), std::string::npos) << outcome.text;
}

TEST_F(GlLibrary, EglContexts) {
  if (!available("egl")) GTEST_SKIP() << "no EGL here";
  expect_judged(run({"--implementation", "egl"}), "egl");
  expect_judged(run({"--library", "libEGL.so.1"}), "library");
}

// What an EGL may do without, and what it may not: EVALCTS_DRILL of drill_egl.cpp.
TEST_F(GlLibrary, EglThatOffersLess) {
  if (!available("egl")) GTEST_SKIP() << "no EGL here";
  for (const char* lacking : {"surfaceless", "profile", "commands"}) {
    SCOPED_TRACE(lacking);
    setenv("EVALCTS_DRILL", lacking, 1);
    expect_judged(run({"--library", DRILL_EGL}), "library");
  }
  setenv("EVALCTS_DRILL", "platforms", 1);
  setenv("EGL_PLATFORM", "surfaceless", 1);
  expect_judged(run({"--library", DRILL_EGL}), "library");
  unsetenv("EGL_PLATFORM");

  const std::pair<const char*, const char*> cases[] = {
      {"opengl", "it has no desktop OpenGL, only OpenGL_ES"},
      {"drivers", "eglInitialize gives EGL_NOT_INITIALIZED"},
      {"framebuffers", "glGenFramebuffers is missing"},
      {"compatibility", "evaluators have no effect in this context"}};
  for (const auto& [lacking, reason] : cases) {
    setenv("EVALCTS_DRILL", lacking, 1);
    const Outcome outcome = run({"--library", DRILL_EGL});
    EXPECT_EQ(outcome.code, 2) << lacking;
    EXPECT_NE(outcome.text.find(reason), std::string::npos) << outcome.text;
  }
}

TEST_F(GlLibrary, EglTakesThePlaceOfOSMesa) {
  if (!available("egl")) GTEST_SKIP() << "no EGL here";
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so"}) std::ofstream(folder_ / name) << "no library\n";
  setenv("LD_LIBRARY_PATH", folder_.c_str(), 1);
  const Outcome outcome = run({});
  EXPECT_NE(outcome.text.find("osmesa does not start (libOSMesa.so.8 is not installed"), std::string::npos)
      << outcome.text;
  expect_judged(outcome, "egl");
  EXPECT_FALSE(fs::exists(folder_ / "results-osmesa.json"));
}

// A context that is not freed costs megabytes, and a run makes tens of thousands.
TEST(GlLibraryLeaks, EglContextsAreFreed) {
  ImplementationOptions options;
  options.name = "egl";
  std::unique_ptr<Implementation> egl;
  try {
    egl = open_implementation(options);
  } catch (const CannotStart& error) {
    GTEST_SKIP() << error.what();
  }
  const auto in_use = [] { return mallinfo2().uordblks; };
  for (int i = 0; i < 50; ++i) egl->create_context();
  const std::size_t before = in_use();
  for (int i = 0; i < 200; ++i) egl->create_context();
  EXPECT_LT(in_use(), before + (4u << 20));
}

}  // namespace
}  // namespace evalcts
