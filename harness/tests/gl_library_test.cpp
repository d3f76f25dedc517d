// Tests contexts of real GL libraries, if they are installed.
#include <malloc.h>

#include <csignal>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include <evalcts/backends/gl_environment.h>
#include <evalcts/backends/implementation.h>
#include <evalcts/results/files.h>
#include <evalcts/runner/worker.h>
#include <evalcts_provider.h>
#include "backends/shared_library.h"
#include "program.h"

namespace evalcts {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kFewTests =
    "InitialState.O*:InitialState.Grid*:GetnMap.*:Map1Values.Ends/MAP1_*_4/EvalCoord1f:"
    "Map1Errors.StrideBelowK/*_f";

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
    const json list = parse_json(evalcts({"list", "implementations", "--json"}).text);
    for (const json& entry : list["implementations"])
      if (as_text(entry["name"]) == name) return entry["available"];
    return false;
  }

  // Checks that all tests passed, and that all captures but the sink are available.
  void expect_judged(const Outcome& outcome, const std::string& name) {
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    const json result = results(name);
    ASSERT_EQ(as_text(result["status"]), "complete") << outcome.text;
    EXPECT_GT(result["summary"].value("pass", 0), 10) << outcome.text;
    EXPECT_EQ(result["summary"].size(), 1u) << result["summary"];
    for (const json& capture : result["implementation"]["captures"])
      EXPECT_EQ(capture["available"], as_text(capture["name"]) != "Sink") << capture;
  }
};

TEST_F(GlLibrary, OSMesaContexts) {
  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  expect_judged(run({"--context", "osmesa"}), "library");
  expect_judged(run({"--context", OSMESA_PROVIDER}), "library");
  expect_judged(run({"--context", "osmesa", "--library", "libOSMesa.so.8", "--name", "same"}), "same");
  // Commands of the dependencies of a library do not count as its own.
  const Outcome outcome = run({"--context", "osmesa", "--library", "libGLU.so.1"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.text, "glGetString"));
}

// The message of the dynamic loader that a provider returns is printed unmodified, and the provider of the
// examples keeps it. The provider is changed to open a library that does not exist.
TEST_F(GlLibrary, ReasonOfAProvider) {
  const fs::path provider = folder_ / "provider.so";
  std::string file = read_file(OSMESA_PROVIDER);
  const std::string name = "libOSMesa.so.8", absent = "libAbsent.so.8";
  for (std::size_t at; (at = file.find(name)) != std::string::npos;) file.replace(at, name.size(), absent);
  std::ofstream(provider) << file;
  const std::string reason = absent + ": cannot open shared object file";
  const Outcome outcome = run({"--context", provider});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.text, provider.string() + " cannot create a context: " + reason));

  const SharedLibrary library(provider);
  const auto* interface = library.find_as<decltype(&evalcts_provider_open)>("evalcts_provider_open")();
  EXPECT_EQ(interface->create(), nullptr);
  EXPECT_EQ(library.find("no_such_symbol"), nullptr);
  EXPECT_TRUE(contains(interface->error(), reason));
}

// Contexts are the library's own if it exports the functions of --context: of a copy of the system's library,
// everything comes from the copy.
TEST_F(GlLibrary, ContextsOfTheLibraryItself) {
  const std::tuple<const char*, const char*, const char*> all[] = {{"osmesa", "osmesa", "libOSMesa.so.8"},
                                                                   {"egl", "egl-surfaceless", "libEGL.so.1"}};
  bool any = false;
  for (const auto& [implementation, context, name] : all) {
    if (!available(implementation)) continue;
    any = true;
    SCOPED_TRACE(context);
    const std::string system = fs::canonical(SharedLibrary(name).path());
    const std::string copy = fs::canonical(folder_) / name;
    fs::copy_file(system, copy);
    const Outcome outcome = run({"--context", context, "--library", copy, "--name", "copy"});
    expect_judged(outcome, "copy");
    EXPECT_FALSE(contains(outcome.text, "contexts of "));
    const json judged = results("copy")["implementation"];
    EXPECT_EQ(as_text(judged["library"]), copy);
    EXPECT_FALSE(judged.contains("context_library"));
    for (const json& file : judged["files"]) EXPECT_NE(fs::canonical(as_text(file)), system);
  }
  if (!any) GTEST_SKIP() << "neither OSMesa nor EGL here";
}

// Tests of real libraries that draw without a window system.
class OffScreenLibraries : public GlLibrary, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    if (!available(GetParam())) GTEST_SKIP() << GetParam() << " is not available";
  }
};

INSTANTIATE_TEST_SUITE_P(, OffScreenLibraries, testing::Values("osmesa", "egl"),
                         [](const auto& tested) { return std::string(tested.param); });

// Values measured through captures are equal, bit for bit, to those of a replay.
TEST_P(OffScreenLibraries, ErrorsAreMeasuredAndReplayed) {
  const Outcome outcome =
      evalcts({"ulp", "--implementation", GetParam(), "--values", "700", "--target", "vertex_4", "--target",
               "texture_coord_1", "--filter", "curve/6/ordinary:surface/4x4/lines", "--output", folder_});
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const json entry = parse_json(read_file(folder_ / "ulp.json"))["implementations"][0];
  EXPECT_EQ(as_text(entry["status"]), "complete");
  ASSERT_EQ(entry["rows"].size(), 4u);
  for (const json& row : entry["rows"]) {
    ASSERT_TRUE(row.contains("worst_ulp")) << row;
    EXPECT_EQ(as_text(row["capture"]), "TransformFeedback");
    EXPECT_GT(row["not_correctly_rounded"].get<int>(), 100) << "float arithmetic";
    EXPECT_LT(row["max_condition_aware"].get<double>(), 60) << "float arithmetic";
    const Outcome again = start(row["worst_ulp"]["replay"].get<std::vector<std::string>>());
    EXPECT_EQ(again.code, 0);
    EXPECT_TRUE(contains(again.text, row["worst_ulp"]["got"]["bits"]));
  }
}

// Failures that the baseline explains by a known bug belong to this bug, and only three of them are reduced.
TEST_P(OffScreenLibraries, KnownFailuresBelongToTheBugOfTheBaseline) {
  reduces_failures_ = true;
  const Outcome outcome = evalcts({"run", "--implementation", GetParam(), "--filter",
                                   "GetMap.IntegersSaturate/*", "--output", folder_.string()});
  const json result = results(GetParam());
  if (!contains(as_text(result["implementation"]["version"]), "Mesa"))
    GTEST_SKIP() << GetParam() << " is not Mesa's";
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  ASSERT_EQ(result["bugs"].size(), 1u) << result["bugs"];
  EXPECT_EQ(as_text(result["bugs"][0]["known"]), "mesa-getmap-saturation");
  EXPECT_EQ(result["bugs"][0]["tests"].size(), 9u);
  EXPECT_EQ(as_text(result["bugs_note"]),
            "the baseline attributes 9 of 9 failures to known bugs; these were not reduced");
  // Its ID names it everywhere.
  const std::string id = "mesa-getmap-saturation", folder = folder_.string();
  EXPECT_EQ(evalcts({"reproduce", id, "--run", folder, "--output", folder + "/program.c"}).code, 0);
  EXPECT_TRUE(
      contains(evalcts({"bugs", "--issue", id, folder}).text, ": 9 of its tests fail because of this"));
  EXPECT_EQ(evalcts({"check", id, "--implementation", GetParam()}).code, 1);
}

// Known bugs have short programs, which compile without warnings.
TEST_P(OffScreenLibraries, ShortProgramsHaveAtMost60Lines) {
  reduces_failures_ = true;
  evalcts({"run", "--implementation", GetParam(), "--depth", "quick", "--filter", "Findings.*", "--output",
           folder_.string()});
  const std::string file = (folder_ / "short.c").string();
  const std::vector<std::string> libraries = GetParam() == std::string("osmesa")
                                                 ? std::vector<std::string>{"-lOSMesa"}
                                                 : std::vector<std::string>{"-lEGL", "-lGL"};
  const json result = results(GetParam());
  for (const json& bug : result["bugs"]) {
    if (as_text(bug["known"]).empty()) continue;
    const std::string id = bug["id"].get<std::string>();
    const Outcome written =
        evalcts({"reproduce", id, "--style", "short", "--run", folder_.string(), "--output", file});
    if (written.code != 0) continue;  // it needs the full style
    const std::string text = read_file(file);
    EXPECT_LE(std::ranges::count(text, '\n'), 60) << text;
    std::vector<std::string> compiler = {
        "/usr/bin/env", "cc", "-Wall", "-Wextra", "-Werror", "-o", (folder_ / "short").string(), file};
    compiler.insert(compiler.end(), libraries.begin(), libraries.end());
    const Outcome built = start(compiler);
    EXPECT_EQ(built.code, 0) << id << built.text;
    const Outcome shown = start({"/usr/bin/env", "timeout", "20", (folder_ / "short").string()});
    EXPECT_NE(shown.code, 0) << id << shown.text;
    EXPECT_NE(shown.code, 2) << id << shown.text;
  }
}

// Restored state hides bugs of the initial state and of long primitives, so tests of these use fresh
// contexts.
TEST_P(OffScreenLibraries, TheWarmContextChangesNoVerdict) {
  const auto verdicts = [&](std::vector<std::string> more) {
    more.insert(more.end(),
                {"run", "--implementation", GetParam(), "--depth", "quick", "--baseline", "none", "--retry",
                 "0", "--filter",
                 "InitialState.*:Findings.Mesh*:CurrentValues.Color/*:LongPrimitives.MixedWithVertex/*:"
                 "Contexts.*:Map1Errors.StrideBelowK/*",
                 "--output", folder_.string()});
    std::rotate(more.begin(), std::ranges::find(more, "run"), more.end());
    evalcts(more);
    std::map<std::string, std::string> all;
    const json result = results(GetParam());
    for (const json& test : result["tests"])
      all[std::string(as_text(test["name"]))] = as_text(test["verdict"]);
    return all;
  };
  const auto fresh = verdicts({"--fresh"});
  EXPECT_GT(fresh.size(), 50u);
  EXPECT_EQ(verdicts({}), fresh);
}

TEST_F(GlLibrary, EglContexts) {
  if (!available("egl")) GTEST_SKIP() << "no EGL here";
  expect_judged(run({"--implementation", "egl"}), "egl");
  expect_judged(run({"--library", "libEGL.so.1"}), "library");
}

// Features that an EGL may leave out, and features that are required: EVALCTS_DRILL of drill_egl.cpp.
TEST_F(GlLibrary, EglThatOffersLess) {
  if (!available("egl")) GTEST_SKIP() << "no EGL here";
  for (const char* lacking : {"surfaceless", "pbuffers", "profile", "commands"}) {
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
      {"configurations", "no EGL configuration supports OpenGL"},
      {"framebuffers", "glGenFramebuffers is missing"},
      {"compatibility", "evaluators have no effect in this context"}};
  for (const auto& [lacking, reason] : cases) {
    setenv("EVALCTS_DRILL", lacking, 1);
    const Outcome outcome = run({"--library", DRILL_EGL});
    EXPECT_EQ(outcome.code, 2) << lacking;
    EXPECT_TRUE(contains(outcome.text, reason));
  }
}

TEST_F(GlLibrary, EglTakesThePlaceOfOSMesa) {
  if (!available("egl")) GTEST_SKIP() << "no EGL here";
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so"}) std::ofstream(folder_ / name) << "no library\n";
  setenv("LD_LIBRARY_PATH", folder_.c_str(), 1);
  const Outcome outcome = run({});
  EXPECT_TRUE(contains(outcome.text, "osmesa does not start (cannot load 'libOSMesa.so.8': "));
  expect_judged(outcome, "egl");
  EXPECT_FALSE(fs::exists(folder_ / "results-osmesa.json"));
}

// Sets an environment variable until the end of its scope.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

TEST_F(GlLibrary, LibraryThatCannotBeLoaded) {
  const auto reason = [](const std::string& name) -> std::string {
    try {
      const SharedLibrary library(name);
      return "it was loaded";
    } catch (const CannotStart& error) {
      return error.what();
    }
  };
  const auto says = [&](const fs::path& name, const std::string& expected) {
    const std::string message = reason(name);
    EXPECT_TRUE(contains(message, expected));
    EXPECT_TRUE(message.starts_with("cannot load '" + name.string() + "': ")) << message;
  };
  says(folder_ / "absent.so", "no such file");
  says(folder_, "it is a directory");
  says("libabsent.so.1", "the dynamic loader finds no library of this name");
  std::ofstream(folder_ / "text.so") << "GROUP ( /usr/lib/libGL.so.1 ) is a script of the linker\n";
  says(folder_ / "text.so", "it does not begin with an ELF header");
  // The beginning of a library for SPARC, which is big-endian.
  std::string head("\177ELF\2\2\1\0\0\0\0\0\0\0\0\0\0\3\0\53", 20);
  std::ofstream(folder_ / "sparc.so") << head << std::string(100, '\0');
  says(folder_ / "sparc.so", "it is built for ELF machine 43 (64-bit), but this evalcts is built for ");

  const std::string in_folder = "cd '" + folder_.string() + "' && ";
  const Outcome built =
      start({"/bin/sh", "-c",
             in_folder + "echo 'int one(void) { return 1; }' > one.c && "
                         "cc -shared -fPIC -o libone.so one.c && "
                         "echo 'int one(void); int two(void) { return one() + 1; }' > two.c && "
                         "cc -shared -fPIC -o two.so two.c -L. -lone && rm libone.so"});
  if (built.code != 0) GTEST_SKIP() << "no C compiler here: " << built.text;
  says(folder_ / "two.so", "it depends on libone.so, which the dynamic loader does not find");
}

// If another driver is loaded than the environment requests, the summary and the results state it.
TEST_F(GlLibrary, OtherDriverThanAskedFor) {
  const std::string llvmpipe = "llvmpipe (LLVM 15.0.6, 256 bits)";
  EXPECT_EQ(describe_other_driver(llvmpipe), "");
  for (const auto& [wanted, renderer, is_other] :
       std::initializer_list<std::tuple<const char*, std::string, bool>>{
           {"llvmpipe", llvmpipe, false},
           {"softpipe", llvmpipe, true},
           {"misspelt", llvmpipe, true},
           {"swrast", llvmpipe, false},
           {"softpipe", "NVIDIA H200/PCIe/SSE2", true},
           {"zink", "zink Vulkan 1.3(" + llvmpipe + ")", false},
           {"llvmpipe", "zink Vulkan 1.3(" + llvmpipe + ")", true},
           {"iris", "Mesa Intel(R) UHD Graphics 770 (ADL-S GT1)", false},
           {"iris", llvmpipe, true}}) {
    const Variable variable("GALLIUM_DRIVER", wanted);
    EXPECT_EQ(!describe_other_driver(renderer).empty(), is_other) << wanted << ", " << renderer;
  }

  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  // OSMesa does not read this variable.
  const Variable variable("MESA_LOADER_DRIVER_OVERRIDE", "zink");
  const Outcome outcome = run({"--implementation", "osmesa"});
  EXPECT_TRUE(contains(outcome.text, "note: MESA_LOADER_DRIVER_OVERRIDE=zink asks for another driver"));
  EXPECT_TRUE(
      as_text(results("osmesa")["implementation"]["note"]).starts_with("MESA_LOADER_DRIVER_OVERRIDE"));
}

TEST_F(GlLibrary, DriverOfTheEnvironmentIsJudged) {
  if (!available("egl")) GTEST_SKIP() << "no EGL here";
  const Variable software("LIBGL_ALWAYS_SOFTWARE", "1");
  const std::string suite = fs::path(EVALCTS_PROGRAM).parent_path() / "evalcts-suite";
  for (const char* const driver : {"softpipe", "zink"}) {
    const Variable variable("GALLIUM_DRIVER", driver);
    std::string reason;
    const std::optional<Description> description =
        ask<Description>({suite, "--implementation", "egl"}, {"describe", "describe"}, reason);
    if (!description) GTEST_SKIP() << "no " << driver << " here: " << reason;
    const ImplementationRecord& implementation = description->implementation;
    if (!implementation.note.empty()) GTEST_SKIP() << implementation.note;
    EXPECT_TRUE(implementation.renderer.starts_with(driver)) << implementation.renderer;
    EXPECT_GE(implementation.files.size(), 2u) << "libEGL and a driver";
    EXPECT_EQ(std::ranges::any_of(
                  implementation.files,
                  [](const std::string& file) { return file.find("libvulkan") != std::string::npos; }),
              driver == std::string("zink"));
  }
}

// The reason names the variable that points a GL to a missing driver, and includes what the GL printed.
TEST_F(GlLibrary, DriverThatCannotBeLoaded) {
  const auto run_with = [&](const char* variable, const std::string& value, const char* implementation) {
    const Variable set(variable, value);
    return run({"--implementation", implementation});
  };
  const auto expect_named = [](const Outcome& outcome, const std::string& text) {
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(contains(outcome.text, text));
  };
  if (available("osmesa")) {
    const Outcome outcome = run_with("GALLIUM_DRIVER", "misspelt", "osmesa");
    expect_named(outcome, "the environment sets GALLIUM_DRIVER='misspelt'");
    expect_named(outcome, "log-osmesa.txt");
  }
  if (!available("egl")) GTEST_SKIP() << "no EGL here";
  run({"--implementation", "egl"});
  const std::string version = results("egl")["implementation"]["version"];
  if (version.find("Mesa") == std::string::npos) GTEST_SKIP() << "EGL is not Mesa: " << version;
  Outcome outcome = run_with("GALLIUM_DRIVER", "misspelt", "egl");
  expect_named(outcome, "the environment sets GALLIUM_DRIVER='misspelt'");
  expect_named(outcome, "the library printed \"");
  expect_named(outcome, "failed to create dri2 screen");
  expect_named(outcome, "log-egl.txt");

  // Mesa without libglvnd reads no vendor files.
  const std::string absent = (folder_ / "absent").string();
  outcome = run_with("__EGL_VENDOR_LIBRARY_FILENAMES", absent, "egl");
  if (outcome.code != 0) {
    expect_named(outcome, "no such file '" + absent + "'");
    const fs::path vendor = folder_ / "vendor.json";
    std::ofstream(vendor) << R"({"file_format_version": "1.0.0", "ICD": {"library_path": "/absent.so"}})";
    expect_named(run_with("__EGL_VENDOR_LIBRARY_FILENAMES", vendor, "egl"),
                 "the EGL of '" + vendor.string() + "' is not used: cannot load '/absent.so': no such file");
  }
  // Mesa 25.0 does not read this variable any more, 22.3 does.
  outcome = run_with("LIBGL_DRIVERS_PATH", folder_, "egl");
  if (outcome.code != 0) {
    expect_named(outcome, "no *_dri.so in '" + folder_.string() + "'");
    expect_named(outcome, "MESA-LOADER: failed to open swrast");
    expect_named(run_with("LIBGL_DRIVERS_PATH", absent, "egl"), "no such directory '" + absent + "'");
  }
}

// A layer over OpenGL ES is loaded while an ES context is current, and has one context.
TEST_F(GlLibrary, LayerOverGles2) {
  if (!available("egl")) GTEST_SKIP() << "no EGL here";
  const std::vector<std::string> arguments = {"run",           "--library", DRILL_LAYER,          "--depth",
                                              "thorough",      "--filter",  "Map1State.Stride/*", "--output",
                                              folder_.string()};
  const auto with_context = [&](const char* context) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--context", context, "--allow-unobserved"});
    return evalcts(all);
  };
  const Outcome outcome = with_context("egl-gles2");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_GT(results("library")["summary"].value("pass", 0), 10) << outcome.text;
  EXPECT_TRUE(contains(outcome.text.substr(0, outcome.text.find('\n')), "contexts of "));
  EXPECT_TRUE(contains(as_text(results("library")["implementation"]["context_library"]), "libEGL"));
  EXPECT_EQ(with_context("egl-surfaceless").code, 2);  // a context of desktop GL is current

  setenv("EVALCTS_DRILL", "terminate", 1);  // the layer terminates the display of the contexts
  const Outcome terminated = with_context("egl-gles2");
  unsetenv("EVALCTS_DRILL");
  EXPECT_EQ(terminated.code, 0) << terminated.text;
  EXPECT_GT(results("library")["summary"].value("pass", 0), 10) << terminated.text;
  EXPECT_FALSE(results("library")["summary"].contains("internal-error")) << terminated.text;

  // OpenGL ES itself has no evaluators.
  try {
    const SharedLibrary library("libGLESv2.so.2");
  } catch (const CannotStart& error) {
    GTEST_SKIP() << error.what();
  }
  const Outcome es = run({"--context", "egl-gles2", "--library", "libGLESv2.so.2"});
  EXPECT_EQ(es.code, 2);
  EXPECT_TRUE(contains(es.text, "no evaluators"));
}

// No available library supports maps of vertex attributes. The tests pass on a provider that stands in for
// one.
TEST_F(GlLibrary, MapsOfVertexAttributes) {
  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  for (const std::string drill : {"", "homogeneous"}) {
    SCOPED_TRACE(drill);
    setenv("EVALCTS_DRILL", drill.c_str(), 1);
    const auto all = verdicts({"--context", NV_VERTEX_PROGRAM_PROVIDER}, "NvVertexProgram.*");
    EXPECT_EQ(all.size(), 13u);
    for (const auto& [name, verdict] : all)
      EXPECT_EQ(verdict, name == "NvVertexProgram.AutoNormal" && !drill.empty() ? "fail" : "pass") << name;
  }
  unsetenv("EVALCTS_DRILL");
}

// INDEX maps, which have an effect only in colour-index contexts, are judged in contexts of a provider
// (EVALCTS_DRILL of color_index.cpp).
TEST_F(GlLibrary, IndexMapsInColorIndexContexts) {
  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  const std::pair<const char*, const char*> drills[] = {{"", "pass"},
                                                        {"coarse", "pass"},
                                                        {"sticky", "fail"},
                                                        {"rgba", "not-observable"},
                                                        {"few", "not-observable"}};
  for (const auto& [how, verdict] : drills) {
    SCOPED_TRACE(how);
    setenv("EVALCTS_DRILL", how, 1);
    const auto all = verdicts({"--context", COLOR_INDEX_PROVIDER}, "Attributes.IndexInColorIndexMode*");
    EXPECT_FALSE(all.empty());
    for (const auto& [name, found] : all) EXPECT_EQ(found, verdict) << name;
  }
  unsetenv("EVALCTS_DRILL");
}

// The run is completed even for extremely bad libraries (EVALCTS_DRILL of degraded_osmesa.cpp).
TEST_F(GlLibrary, DegradedLibrariesAreJudgedToTheEnd) {
  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  for (const char* how : {"half", "low", "high", "silent", "noisy", "crashes"}) {
    SCOPED_TRACE(how);
    setenv("EVALCTS_DRILL", how, 1);
    const Outcome outcome = evalcts(
        {"run", "--context", DEGRADED_PROVIDER, "--name", "degraded", "--output", folder_.string(), "--depth",
         "quick", "--retry", "0", "--filter",
         "InitialState.O*:InitialState.Grid*:Api.EntryPoint2/Map2d:Map1Errors.OrderTooHigh/MAP1_VERTEX_3_f:"
         "Precedence.AllSubsets/*"});
    // If explicit vertices raise errors as well, evaluators are not at fault.
    EXPECT_EQ(outcome.code, how == std::string("noisy") ? 2 : 1) << outcome.text;
    const json result = results("degraded");
    EXPECT_EQ(as_text(result["status"]), "complete") << outcome.text;
    EXPECT_FALSE(result["summary"].contains("internal-error")) << result["summary"];
    EXPECT_GT(result["tests"].size(), 10u);
    EXPECT_EQ(result["summary"].contains("crash"), how == std::string("crashes")) << result["summary"];
  }
  unsetenv("EVALCTS_DRILL");
}

// If one form of GetMap is missing, the tests judge the other forms and name the missing one as not observed.
TEST_F(GlLibrary, MissingFormsOfGetMapAreNotObserved) {
  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  for (const std::string missing : {"glGetMapiv", "glGetMapfv"}) {
    SCOPED_TRACE(missing);
    setenv("EVALCTS_DRILL", missing.c_str(), 1);
    const Outcome outcome =
        evalcts({"run", "--context", DEGRADED_PROVIDER, "--name", "degraded", "--output", folder_.string(),
                 "--depth", "quick", "--filter",
                 "InitialState.OrderOf*:GetMap2.ChangesNothing:DisplayLists.EveryQueryInAnOpenList/*"});
    unsetenv("EVALCTS_DRILL");
    const json result = results("degraded");
    EXPECT_EQ(result["tests"].size(), 5u) << outcome.text;
    for (const json& test : result["tests"]) {
      EXPECT_EQ(as_text(test["verdict"]), "pass") << test;
      EXPECT_TRUE(contains(test.value("unobserved", ""), missing + " (missing)")) << test;
    }
  }
}

// Evaluators are at fault only if explicit vertices in the same lists are correct. The filter names a test
// for each way in which tests judge observations.
TEST_F(GlLibrary, ListsInWhichAllVerticesGoWrong) {
  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  const std::pair<const char*, const char*> drills[] = {
      {"", "pass"}, {"evaluated", "fail"}, {"lists", "not-observable"}};
  for (const auto& [how, verdict] : drills) {
    SCOPED_TRACE(how);
    setenv("EVALCTS_DRILL", how, 1);
    const auto all =
        verdicts({"--context", DEGRADED_PROVIDER, "--depth", "quick"},
                 "Map1Values.Ends/MAP1_VERTEX_3/EvalCoord1f/Split"  // exact names run at any depth
                 ":DisplayLists.CalledTwiceSameBits/1-D:DisplayLists.CalledTwiceSameBits/2-D"
                 ":Evaluation.RepeatedCallSameBits/MAP1_VERTEX_4/EvalCoord1f/Split"
                 ":Metamorphic.ReversedCurve/Nested"
                 ":ShaderAttributes.GenericZero/MAP1_VERTEX_3/EvalCoord1f/Executed"
                 ":ShaderAttributes.GenericZero/MAP1_VERTEX_4/EvalCoord1f/Executed");
    EXPECT_EQ(all.size(), 7u);
    for (const auto& [name, found] : all) EXPECT_EQ(found, verdict) << name;
  }
}

// A library whose lists lose Begin accepts all commands behind it, not only those of the evaluators.
TEST_F(GlLibrary, ListsThatLoseBegin) {
  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  const Variable drill("EVALCTS_DRILL", "begin");
  const Outcome outcome = evalcts(
      {"run", "--context", DEGRADED_PROVIDER, "--name", "degraded", "--output", folder_.string(), "--filter",
       "Map1Errors.BetweenBeginAndEnd/MAP1_VERTEX_3_f/Compiled:Grids.BetweenBeginAndEnd/f/Compiled"});
  const json result = results("degraded");
  EXPECT_EQ(result["tests"].size(), 2u) << outcome.text;
  for (const json& test : result["tests"])
    EXPECT_TRUE(contains(as_text(test["message"]), "CULL_FACE")) << test;
}

// A bug in front of Mesa is not called a known bug of Mesa that concerns the same commands.
TEST_F(GlLibrary, OtherBugsAreNotCalledKnown) {
  if (!available("osmesa")) GTEST_SKIP() << "no OSMesa here";
  reduces_failures_ = true;
  const std::string saturation = "GetMap.IntegersSaturate/MAP1_INDEX";
  const std::pair<const char*, std::string> drills[] = {
      {"short-answers", saturation + ":GetMap.OrderDomainAndPoints*"},
      {"short-meshes", saturation + ":Mesh2.Points:Mesh2.Lines:Mesh2.SubRange/*"}};
  for (const auto& [how, filter] : drills) {
    const Variable drill("EVALCTS_DRILL", how);
    const Outcome outcome =
        evalcts({"run", "--context", DEGRADED_PROVIDER, "--name", "degraded", "--output", folder_.string(),
                 "--baseline", "none", "--depth", "quick", "--filter", filter});
    const json result = results("degraded");
    ASSERT_GE(result.value("bugs", json()).size(), 2u) << outcome.text;
    for (const json& bug : result["bugs"]) {
      const bool is_of_mesa = bug.at("tests") == json{saturation};
      EXPECT_EQ(bug.value("known", ""), is_of_mesa ? "mesa-getmap-saturation" : "") << bug;
    }
  }
}

// Tests of GLX. DISPLAY is not set, so each process starts its own X server.
class GlxLibrary : public GlLibrary {
 protected:
  GlxLibrary() {
    unsetenv("DISPLAY");
    path_ = std::getenv("PATH");
  }
  ~GlxLibrary() override { setenv("PATH", path_.c_str(), 1); }

  // Makes a script that PATH finds before the real Xvfb. It contains `lines`, then `exec Xvfb arguments`.
  void put_before_xvfb(const std::string& lines, const std::string& arguments = "\"$@\"") {
    std::ofstream(folder_ / "Xvfb") << "#!/bin/sh\nPATH='" << path_ << "'\n"
                                    << lines << "\nexec Xvfb " << arguments << "\n";
    fs::permissions(folder_ / "Xvfb", fs::perms::owner_all);
    setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
  }

  std::string path_;
};

TEST_F(GlxLibrary, Direct) {
  if (!available("glx")) GTEST_SKIP() << "no GLX or no Xvfb here";
  expect_judged(run({"--implementation", "glx"}), "glx");
  setenv("DISPLAY", ":54321", 1);  // no server has this display
  const std::string test = "Map1Errors.StrideBelowK/MAP1_COLOR_4_f";
  const std::map<std::string, std::string> passes = {{test, "pass"}};
  EXPECT_EQ(verdicts({"--library", "libGL.so.1"}, test), passes);
  unsetenv("DISPLAY");
}

TEST_F(GlxLibrary, Indirect) {
  if (!available("glx-indirect")) GTEST_SKIP() << "no indirect rendering here";
  const Outcome outcome = run({"--implementation", "glx-indirect", "--baseline", "none"});
  const json result = results("glx-indirect");
  ASSERT_EQ(as_text(result["status"]), "complete") << outcome.text;
  EXPECT_TRUE(result["implementation"]["version"].get<std::string>().starts_with("1.")) << outcome.text;
  EXPECT_GT(result["summary"].value("pass", 0), 4) << outcome.text;
  const std::set<std::string> allowed = {"pass", "not-supported"};  // GetnMap is not in the protocol
  for (const auto& [verdict, tests] : result["summary"].items())
    EXPECT_TRUE(allowed.contains(verdict)) << outcome.text;
  for (const json& capture : result["implementation"]["captures"]) {
    const bool are_pixels = as_text(capture["name"]) == "Pixels";
    EXPECT_EQ(capture["available"], are_pixels || as_text(capture["name"]) == "FeedbackBuffer") << capture;
    if (are_pixels) {
      EXPECT_EQ(as_text(capture["shows"]), "inexactly colour") << capture;
    }
  }
}

// The requests of the client are recorded on their way to the server.
TEST_F(GlxLibrary, RequestsAreRecorded) {
  if (!available("glx-indirect")) GTEST_SKIP() << "no indirect rendering here";
  const Outcome outcome = evalcts({"run", "--implementation", "glx-indirect", "--output", folder_.string(),
                                   "--filter", "GlxProtocol.*:-GlxProtocol.EmptyReplies/*", "--verbose"});
  const json result = results("glx-indirect");
  EXPECT_EQ(as_text(result["status"]), "complete") << outcome.text;
  EXPECT_GT(result["summary"].value("pass", 0), 50) << outcome.text;
  // On a busy machine, Mesa's protocol code fails occasionally, but never twice in the same test.
  for (const json& test : result["tests"])
    EXPECT_TRUE(as_text(test["verdict"]) == "pass" || test.value("/again/verdict"_json_pointer, "") == "pass")
        << outcome.text;
}

TEST_F(GlxLibrary, SaysWhyItDoesNotStart) {
  if (!available("glx")) GTEST_SKIP() << "no GLX or no Xvfb here";
  const auto fails = [&](const char* name, const char* reason) {
    const Outcome outcome = run({"--implementation", name});
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_TRUE(contains(outcome.text, reason));
  };
  put_before_xvfb("", "\"$@\" -iglx");
  fails("glx-indirect", "Xvfb cannot create indirect contexts: ");
  put_before_xvfb("", "\"$@\" -extension GLX");
  fails("glx", "Xvfb has GLX 0.0; 1.3 is needed");
  put_before_xvfb("", "-nonsense");
  fails("glx", "Unrecognized option: -nonsense");
  setenv("PATH", folder_.c_str(), 1);
  fs::remove(folder_ / "Xvfb");
  fails("glx", "Xvfb is not installed (package xvfb)");
}

// The X server ends in whatever way the suite ends, even if the server ignores signals.
TEST_F(GlxLibrary, LeavesNoServerBehind) {
  if (!available("glx")) GTEST_SKIP() << "no GLX or no Xvfb here";
  const fs::path noted = folder_ / "server";
  put_before_xvfb("echo $$ >'" + noted.string() + ".new' && mv '" + noted.string() + ".new' '" +
                  noted.string() + "'");
  const std::string suite = fs::path(EVALCTS_PROGRAM).parent_path() / "evalcts-suite";
  // Returns the path of the socket that a client has connected to; empty if there is none yet.
  const auto socket_of = [](pid_t server) {
    std::error_code gone;
    bool has_client = false;
    fs::path found;
    std::set<std::string> inodes;
    for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(server) + "/fd", gone))
      inodes.insert(fs::read_symlink(entry.path(), gone).string());
    std::ifstream sockets("/proc/net/unix");
    for (std::string line; std::getline(sockets, line);) {
      std::istringstream words(line);
      std::string state, inode, path;
      for (int i = 0; i < 6; ++i) words >> state;
      if (!(words >> inode >> path) || !inodes.contains("socket:[" + inode + "]")) continue;
      if (path.starts_with("/tmp/.X11-unix/")) found = path;
      // A connection has the name of the socket, which may be the one without a file.
      has_client = has_client || (state == "03" && contains(path, "/tmp/.X11-unix/"));
    }
    return has_client ? found : fs::path();
  };
  const auto within_a_minute = [](const auto& condition) {
    for (int i = 0; i < 1200 && !condition(); ++i) usleep(50'000);
    return condition();
  };
  enum class End { kRegular, kKilled, kKilledWithoutInit };
  for (const End end : {End::kRegular, End::kKilled, End::kKilledWithoutInit}) {
    const bool killed = end != End::kRegular;
    if (end == End::kKilledWithoutInit) adopt_orphans();  // as 'evalcts run' does
    fs::remove(noted);
    std::vector<std::string> command = {suite, "--implementation", "glx"};
    if (!killed) command.emplace_back("--gtest_filter=Api.*");
    ChildProcess child(command, "");
    pid_t server = 0;
    ASSERT_TRUE(within_a_minute([&] { return bool(std::ifstream(noted) >> server); }));
    fs::path socket;
    if (killed) {
      ASSERT_TRUE(within_a_minute([&] { return !(socket = socket_of(server)).empty(); }));
      kill(server, SIGSTOP);
      kill(child.id(), SIGKILL);
    }
    ASSERT_TRUE(child.wait(60));
    EXPECT_TRUE(within_a_minute([&] { return kill(server, 0) != 0; })) << "the server is still there";
    EXPECT_TRUE(socket.empty() || within_a_minute([&] { return !fs::exists(socket); })) << socket;
  }
}

// A context that is not freed takes megabytes, and a run creates tens of thousands.
class GlLibraryLeaks : public GlLibrary, public testing::WithParamInterface<const char*> {};

TEST_P(GlLibraryLeaks, ContextsAreFreed) {
  // Availability is determined in another process, because an Xvfb without indirect rendering
  // ends its clients.
  if (!available(GetParam())) GTEST_SKIP() << GetParam() << " is not available";
  ImplementationOptions options;
  options.name = GetParam();
  const std::unique_ptr<Implementation> library = open_implementation(options);
  const auto in_use = [] { return mallinfo2().uordblks; };
  for (int i = 0; i < 50; ++i) library->create_context();
  const std::size_t before = in_use();
  for (int i = 0; i < 200; ++i) library->create_context();
  EXPECT_LT(in_use(), before + (4u << 20));
}

INSTANTIATE_TEST_SUITE_P(, GlLibraryLeaks, testing::Values("egl", "glx", "glx-indirect"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase(name, '-');
                           return name;
                         });

// --- a Mesa that is not the system's ---

class MesaBuild : public ProgramTest {
 protected:
  // Copies the files of the system's Mesa to a folder; false if `egl` does not run on Mesa here.
  bool copy_mesa() {
    evalcts({"run", "--implementation", "egl", "--filter", "Map1State.Stride/MAP1_INDEX_f", "--output",
             folder_.string()});
    const json files = results("egl")["implementation"]["files"];
    for (const json& file : files) {
      const std::filesystem::path path = std::string(as_text(file));
      const std::string name = path.filename().string();
      if (name.starts_with("libEGL.so") || name.starts_with("libGL")) continue;  // libglvnd
      std::filesystem::copy_file(std::filesystem::canonical(path), build() / name);
      // Up to Mesa 24.3, its other libraries load this one.
      const std::filesystem::path glapi = path.parent_path() / "libglapi.so.0";
      if (std::filesystem::exists(glapi))
        std::filesystem::copy_file(glapi, build() / "libglapi.so.0",
                                   std::filesystem::copy_options::overwrite_existing);
    }
    return std::filesystem::exists(build() / "libEGL_mesa.so.0");
  }
  std::filesystem::path build() const {
    const std::filesystem::path folder = folder_ / "mesa";
    std::filesystem::create_directories(folder);
    return folder;
  }
  Outcome check(const std::filesystem::path& folder) {
    return evalcts({"check", "Map1State.Stride/MAP1_INDEX_f", "--mesa-build", folder.string()});
  }
  Outcome ulp(std::vector<std::string> input) {
    input.insert(input.begin(), {"ulp", "--mesa-build", build().string(), "--output", folder_.string()});
    return evalcts(input);
  }
};

TEST_F(MesaBuild, ReplacesTheSystems) {
  if (!copy_mesa()) GTEST_SKIP() << "no Mesa with libglvnd here";
  EXPECT_EQ(check(build()).code, 0);
  evalcts({"run", "--mesa-build", build().string(), "--filter", "Map1State.Stride/MAP1_INDEX_f", "--output",
           folder_.string()});
  const std::string files = results("egl")["implementation"]["files"].dump();
  EXPECT_TRUE(contains(files, (build() / "libEGL_mesa.so.0").string())) << files;
  const Outcome input = ulp({"--orders", "2", "--points=0,1", "--at", "0.5"});
  EXPECT_TRUE(contains(input.text, "egl, vertex_3: 0x1p-1 (0x3f000000)")) << input.text;
  EXPECT_EQ(ulp({"--filter", "curve/2/lines", "--values", "10"}).code, 0);
  const json entry = json_of("ulp.json")["implementations"][0];
  EXPECT_EQ(as_text(entry["status"]), "complete") << entry;
  EXPECT_TRUE(contains(entry["rows"][0]["worst_ulp"]["replay"].dump(), "--mesa-build")) << entry;
  // The C program of a known bug.
  const auto check_example = [&] {
    return evalcts({"check", "mesa-mesh-triangle-strips", "--mesa-build", build().string()});
  };
  EXPECT_TRUE(contains(check_example().text, "the example of mesa-mesh-triangle-strips with "));
  const std::filesystem::path driver = build() / "swrast_dri.so";
  if (!std::filesystem::exists(driver)) return;  // Mesa 24.2 and newer has one library for all drivers

  std::filesystem::rename(driver, build() / "libgallium_dri.so");  // as in a folder without an installation
  EXPECT_EQ(check(build()).code, 0);

  std::filesystem::remove(build() / "libgallium_dri.so");
  const Outcome without_drivers = check(build());
  EXPECT_EQ(without_drivers.code, 125);
  EXPECT_TRUE(contains(without_drivers.text, "swrast_dri.so' was loaded, which is not in '"))
      << without_drivers.text;
  const Outcome example = check_example();
  EXPECT_EQ(example.code, 125) << example.text;
  EXPECT_EQ(ulp({"--filter", "curve/2/lines", "--values", "10"}).code, 2);
}

TEST_F(MesaBuild, IsRejectedIfItHasNoMesa) {
  for (const std::filesystem::path& folder : {build(), folder_ / "absent"}) {
    const Outcome outcome = check(folder);
    EXPECT_EQ(outcome.code, 125);
    EXPECT_TRUE(contains(outcome.text, "name the folder that meson built or installed Mesa into"))
        << outcome.text;
  }
  EXPECT_EQ(ulp({"--orders", "2", "--points=0,1", "--at", "0.5"}).code, 2);
}

}  // namespace
}  // namespace evalcts
