// Tests reading, applying and updating baselines, and the known bugs in them.
#include <evalcts/results/baseline.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include <evalcts/results/files.h>

#include "contains.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;

class Baselines : public testing::Test {
 protected:
  Baselines() : folder_(fs::path(testing::TempDir()) / ("baselines-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Baselines() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  BaselineChoice choice(const std::string& chosen = {}) const {
    return {.files = BaselineFiles::read_all(folder_), .name = chosen};
  }
  Baseline find(const ImplementationRecord& implementation, Pass pass = Pass::kFreshContexts,
                const std::string& chosen = {}) const {
    return {choice(chosen), implementation, pass};
  }
  // Returns the baseline in the files called `name`, regardless of its header.
  Baseline read(const std::string& name) const {
    return find(record({}).implementation, Pass::kFreshContexts, name);
  }

  static TestRecord test(const std::string& name, Verdict verdict,
                         const std::vector<std::string>& mismatches = {}) {
    TestRecord out;
    out.name = name;
    out.verdict = verdict;
    out.message = "m";
    out.mismatches = mismatches;
    return out;
  }
  static RunResult record(const std::vector<TestRecord>& tests) {
    RunResult out;
    out.implementation = implementation("Mesa/X.org", "llvmpipe (LLVM 15)", "4.5 Mesa 22.3.6");
    out.depth = Depth::kQuick;
    out.seed = 1;
    out.tests = tests;
    return out;
  }
  static ImplementationRecord implementation(const std::string& vendor, const std::string& renderer,
                                             const std::string& version, const std::string& kind = {}) {
    ImplementationRecord out;
    out.vendor = vendor;
    out.renderer = renderer;
    out.version = version;
    out.kind = kind;
    return out;
  }
  static std::vector<ListedTest> listed(const std::vector<std::string>& names) {
    std::vector<ListedTest> out;
    for (const std::string& name : names) out.push_back({.name = name, .requirements = {}});
    return out;
  }

  // Applies the baseline to a run of all tests.
  static void apply(const Baseline& baseline, RunResult& result) {
    std::vector<std::string> names;
    for (const TestRecord& test : result.tests) names.push_back(test.name);
    baseline.apply(result, listed(names));
  }

  static constexpr const char* kHeader = "# vendor: Mesa\n# renderer: llvmpipe\n# version: Mesa 22.3\n\n";
  fs::path folder_;
};

TEST_F(Baselines, KnownFailuresAreExpectedWithTheirReason) {
  write("m-fails.txt",
        std::string(kHeader) +
            "# GL 2.1 5.1: the current colour\n# is lost\nA.B,Fail\nA.C,Crash\n\n# other\nA.D,Fail\n");
  RunResult result =
      record({test("A.B", Verdict::kFail), test("A.C", Verdict::kCrash), test("A.D", Verdict::kPass),
              test("A.E", Verdict::kFail), test("A.F", Verdict::kPass)});
  const Baseline baseline = find(result.implementation);
  ASSERT_EQ(baseline.name(), "m");
  apply(baseline, result);
  const std::vector<TestRecord>& tests = result.tests;
  EXPECT_TRUE(tests[0].expected_by_baseline);
  EXPECT_EQ(tests[0].baseline_reason, "GL 2.1 5.1: the current colour is lost");
  EXPECT_TRUE(tests[1].expected_by_baseline);
  EXPECT_FALSE(tests[2].expected_by_baseline);  // an unexpected pass
  EXPECT_EQ(tests[2].baseline_reason, "other");
  EXPECT_FALSE(tests[3].expected_by_baseline);
  EXPECT_EQ(tests[4].baseline_reason, "");
  EXPECT_EQ(result.baseline, "m");
}

TEST_F(Baselines, AnotherStatusIsUnexpected) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  RunResult result = record({test("A.B", Verdict::kCrash)});
  apply(find(result.implementation), result);
  EXPECT_FALSE(result.tests[0].expected_by_baseline);
}

TEST_F(Baselines, OneMoreFailingValueIsUnexpected) {
  RunResult result = record({test("A.B", Verdict::kFail, {"case 1: x", "case 2: y"})});
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  write("m-signatures.txt", "A.B,quick," + result.tests[0].signature() + "\n");
  const Baseline baseline = read("m");
  RunResult same = result;
  apply(baseline, same);
  EXPECT_TRUE(same.tests[0].expected_by_baseline);

  RunResult more = record({test("A.B", Verdict::kFail, {"case 1: x", "case 2: y", "case 3: z"})});
  apply(baseline, more);
  EXPECT_FALSE(more.tests[0].expected_by_baseline);
  EXPECT_TRUE(contains(more.tests[0].message, "other cases"));

  RunResult deeper = more;  // there is no signature for this depth, so the failing cases are not compared
  deeper.depth = Depth::kThorough;
  apply(baseline, deeper);
  EXPECT_TRUE(deeper.tests[0].expected_by_baseline);
}

TEST_F(Baselines, OthersAreNotMeant) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  EXPECT_EQ(find(implementation("NVIDIA", "llvmpipe", "Mesa 22.3")).name(), "");
  EXPECT_EQ(find(implementation("Mesa", "llvmpipe", "Mesa 23.0")).name(), "");
  EXPECT_TRUE(BaselineFiles::read_all(folder_ / "absent").empty());
  EXPECT_EQ(Baseline().name(), "");
}

TEST_F(Baselines, StaleEntriesAreNamed) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\nA.Gone,Fail\n");
  const std::vector<ListedTest> tests = listed({"A.B"});
  EXPECT_EQ(read("m").stale_entries(tests), std::vector<std::string>{"A.Gone"});
}

TEST_F(Baselines, BadFilesAreRefusedWithFileAndLine) {
  for (const std::string body : {"A.B,Fail\n", "# reason\nA.B\n", "# reason\nA.B,Sometimes\n",
                                 "# reason\nA.B,Fail,x\n", "# reason\nA.B,Fail\nA.B,Fail\n"}) {
    write("m-fails.txt", kHeader + body);
    try {
      read("m");
      ADD_FAILURE() << body;
    } catch (const BadBaseline& error) {
      EXPECT_TRUE(contains(error.what(), "m-fails.txt:"));
    }
  }
  write("m-fails.txt", "# reason\nA.B,Fail\n");  // no header
  EXPECT_THROW(read("m"), BadBaseline);
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  write("m-signatures.txt", "A.B,quick\n");
  EXPECT_THROW(read("m"), BadBaseline);
  EXPECT_THROW(read("absent"), BadBaseline);
}

// If an entry is deleted, its signature has no effect. It is named, and the next --write-baseline removes it.
TEST_F(Baselines, SignaturesWithoutEntryAreIgnored) {
  const std::string fails = std::string(kHeader) + "# reason\nA.B,Fail\n";
  write("m-fails.txt", fails + "A.C,Fail\n");
  write("m-signatures.txt", "A.B,quick,1-b\nA.C,quick,1-c\n");
  EXPECT_EQ(read("m").unused_signatures(), std::vector<std::string>{});
  write("m-fails.txt", fails);
  RunResult result = record({test("A.C", Verdict::kFail, {"x"})});
  apply(read("m"), result);
  EXPECT_FALSE(result.tests[0].expected_by_baseline);
  EXPECT_EQ(result.tests[0].message, "m");
  EXPECT_EQ(read("m").unused_signatures(), std::vector<std::string>{"A.C"});
  EXPECT_EQ(read("m").stale_entries(listed({"A.B", "A.C"})), std::vector<std::string>{});
  read("m").renewed(record({}), choice("m"), "").write(folder_);
  EXPECT_EQ(BaselineFiles::read(folder_, "m").signatures.size(), 1u);
}

// --- Patterns

TEST_F(Baselines, PatternsPermitFailures) {
  EXPECT_TRUE(stands_for("A.B/*", "A.B/EvalCoord1d/Nested"));
  EXPECT_TRUE(stands_for("A.@(B|C)/Eval*[12]d", "A.C/EvalCoord1d"));
  EXPECT_FALSE(stands_for("A.@(B|C)/Eval*[12]d", "A.D/EvalCoord1d"));
  EXPECT_FALSE(stands_for("A.B", "A.B/EvalCoord1d"));
  write("m-fails.txt",
        std::string(kHeader) +
            "# reason\nA.B/EvalCoord1*,Fail\nA.Gone/*,Fail\n\n# other\nA.B/EvalCoord1f,Crash\n");
  write("m-signatures.txt", "A.B*,quick,2-b\nA.D*,quick,1-d\n");
  RunResult result =
      record({test("A.B/EvalCoord1d", Verdict::kFail), test("A.B/EvalCoord1f", Verdict::kCrash),
              test("A.B/EvalCoord1dv", Verdict::kPass), test("A.B/EvalCoord2d", Verdict::kFail)});
  for (TestRecord& test : result.tests) test.signature_of_all = "2-b";
  apply(read("m"), result);
  EXPECT_TRUE(result.tests[0].expected_by_baseline);
  EXPECT_EQ(result.tests[1].baseline_reason, "other") << "an entry for one test takes precedence";
  EXPECT_FALSE(result.tests[2].is_unexpected_pass()) << "another test of the pattern fails";
  EXPECT_FALSE(result.tests[3].expected_by_baseline);
  EXPECT_EQ(read("m").stale_entries(listed({"A.B/EvalCoord1d", "A.B/EvalCoord1f"})),
            std::vector<std::string>{"A.Gone/*"});
  EXPECT_EQ(read("m").unused_signatures(), std::vector<std::string>{"A.D*"});
}

// A pass is unexpected if all tests of its pattern were run and pass.
TEST_F(Baselines, APatternWithoutFailuresIsUnexpected) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B/*,Fail\n");
  RunResult result = record({test("A.B/x", Verdict::kPass), test("A.B/y", Verdict::kPass)});
  RunResult part = result;
  read("m").apply(part, listed({"A.B/x", "A.B/y", "A.B/z"}));
  EXPECT_FALSE(part.tests[0].is_unexpected_pass()) << "one of its tests was not run";
  apply(read("m"), result);
  EXPECT_TRUE(result.tests[0].is_unexpected_pass());
  EXPECT_TRUE(result.tests[1].is_unexpected_pass());
}

TEST_F(Baselines, PassTakesATestOutOfAPattern) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.D/*,Fail\n\n# mended\nA.D/X,Pass\n");
  RunResult result = record({test("A.D/X", Verdict::kFail), test("A.D/Y", Verdict::kFail)});
  apply(read("m"), result);
  EXPECT_FALSE(result.tests[0].expected_by_baseline);
  EXPECT_TRUE(result.tests[1].expected_by_baseline);
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.D/Y,Fail\n\n# mended\nA.D/X,Pass\n");
  EXPECT_EQ(read("m").stale_entries(listed({"A.D/X", "A.D/Y"})),
            std::vector<std::string>{"A.D/X (Pass, but no failure is expected)"});
}

TEST_F(Baselines, SkipsAndFlakesAreRegularExpressionsWithReasons) {
  write("m-fails.txt", kHeader);
  write("m-skips.txt", "# hangs\n# the machine\nB/x$\n^C\\.\n");
  write("m-flakes.txt", "# now and then\n^A\\.\n");
  const Baseline baseline = read("m");
  EXPECT_EQ(baseline.skip("A.B/x"), "hangs the machine");
  EXPECT_TRUE(baseline.skip("C.D"));
  EXPECT_FALSE(baseline.skip("A.B/xy"));
  RunResult result =
      record({test("A.B", Verdict::kFail), test("A.C", Verdict::kCrash), test("A.D", Verdict::kTimeout),
              test("A.E", Verdict::kPass), test("B.A", Verdict::kFail)});
  apply(baseline, result);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(result.tests[i].expected_by_baseline);
    EXPECT_EQ(result.tests[i].baseline_reason, "flaky: now and then");
  }
  EXPECT_EQ(result.tests[3].baseline_reason, "");
  EXPECT_FALSE(result.tests[4].expected_by_baseline);
  const std::vector<ListedTest> tests = listed({"A.B", "C.D"});
  EXPECT_EQ(baseline.stale_entries(tests), std::vector<std::string>{"B/x$ (in the skips)"});

  // Renewing changes neither skips nor flakes, and gives flaky tests no entry.
  baseline.renewed(result, choice(), "ignored").write(folder_);
  const Baseline after = read("m");
  EXPECT_EQ(after.files()->entries.count("A.B"), 0u);
  EXPECT_EQ(after.files()->entries.count("B.A"), 1u);
  EXPECT_TRUE(after.skip("C.D"));
}

TEST_F(Baselines, BadPatternsAreRefusedWithFileAndLine) {
  write("m-fails.txt", kHeader);
  const std::pair<const char*, const char*> bad[] = {
      {"# reason\nA\n\n# reason\n(\n", ":5: '(' is not a regular"},
      {"A\n", ":1: an entry needs its reason"},
      {"# reason\n\nA\n", ":3: an entry needs its reason"}};
  for (const std::string file : {"m-skips.txt", "m-flakes.txt"}) {
    for (const auto& [text, message] : bad) {
      write(file, text);
      try {
        BaselineFiles::read_all(folder_);
        ADD_FAILURE() << text;
      } catch (const BadBaseline& error) {
        EXPECT_TRUE(contains(error.what(), file + message));
      }
    }
    fs::remove(folder_ / file);
  }
  write("other-skips.txt", "# reason\nA\n");
  EXPECT_THROW(BaselineFiles::read_all(folder_), BadBaseline);  // no field names an implementation
}

TEST_F(Baselines, TheMoreSpecificHeaderIsMeant) {
  const std::string start = "# vendor: Mesa\n# renderer: llvmpipe\n# version: Mesa 22.3\n";
  write("a-fails.txt", start);
  write("b-fails.txt", start + "# implementation: osmesa\n");
  write("c-fails.txt", start + "# pass: reuse-context\n");
  ImplementationRecord implementation = record({}).implementation;
  const auto name = [&](Pass pass = Pass::kFreshContexts) {
    const Baseline baseline = find(implementation, pass);
    return baseline.files() ? baseline.files()->name : "none";
  };
  EXPECT_EQ(name(), "a");
  implementation.kind = "osmesa";
  EXPECT_EQ(name(), "b");
  EXPECT_EQ(name(Pass::kReuseContext), "c");
  implementation.kind = "egl";
  EXPECT_EQ(name(), "a");
  write("d-fails.txt", "# vendor: Mesa\n# renderer: llvmpipe\n# version: Mesa 22.3.6\n");
  EXPECT_EQ(name(), "d");
  write("d-fails.txt", start + "# pass: third\n");
  EXPECT_THROW(BaselineFiles::read_all(folder_), BadBaseline);
}

TEST_F(Baselines, SignaturesBelongToTheFirstSeed) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  RunResult result = record({test("A.B", Verdict::kFail, {"x"})});
  result.seed = 2;
  read("m").renewed(result, choice("m"), "").write(folder_);
  EXPECT_TRUE(read("m").files()->signatures.empty());
  EXPECT_TRUE(contains(read_file(folder_ / "m-signatures.txt"), "seed 1"));
  write("m-signatures.txt", "A.B,quick,1-1\n");
  apply(read("m"), result);
  EXPECT_TRUE(result.tests[0].expected_by_baseline);
}

// A test that also fails in fresh contexts belongs into the baseline of the first pass.
TEST_F(Baselines, OfTheSecondPassHoldOnlyWhatIsNews) {
  RunResult result = record({test("A.B", Verdict::kFail, {"x"}), test("A.C", Verdict::kFail, {"y"})});
  result.pass = Pass::kReuseContext;
  result.tests[0].also_in_fresh_context = true;
  result.tests[0].expected_by_baseline = true;
  Baseline().renewed(result, {}, "m.reuse-context").write(folder_);
  const Baseline baseline = find(result.implementation, Pass::kReuseContext);
  EXPECT_EQ(baseline.name(), "m.reuse-context");
  EXPECT_EQ(baseline.files()->entries.size(), 1u);
  EXPECT_EQ(baseline.files()->entries.count("A.C"), 1u);
  EXPECT_EQ(find(result.implementation).name(), "");
}

TEST_F(Baselines, RenewedOnesKeepReasonsAndReadBack) {
  write("m-fails.txt",
        std::string(kHeader) +
            "# bug: some-bug.\n# a reason that is long enough to be wrapped when it is "
            "written, because it has many words in it\nA.B,Fail\n\n# fixed by now\nA.C,Fail\n");
  const RunResult result = record(
      {test("A.B", Verdict::kFail, {"x"}), test("A.C", Verdict::kPass), test("A.D", Verdict::kTimeout)});
  const Baseline before = read("m");
  before.renewed(result, choice("m"), "ignored").write(folder_);
  const Baseline after_all = read("m");
  const BaselineFiles& after = *after_all.files();
  ASSERT_EQ(after.entries.size(), 2u);
  EXPECT_EQ(after.entries.at("A.B").reason, before.files()->entries.at("A.B").reason);
  EXPECT_EQ(after.signatures.at("A.B").at("quick"), result.tests[0].signature());
  EXPECT_EQ(after.entries.at("A.D").status, "Timeout");
  EXPECT_TRUE(contains(read_file(folder_ / "m-fails.txt"), "\n# bug: some-bug.\n# a reason that"));
  EXPECT_EQ(find(result.implementation).name(), "m");
}

// A reason may look like a line of the header.
TEST_F(Baselines, TheHeaderEndsAtAnEmptyLine) {
  write("m-fails.txt", std::string(kHeader) + "# pass: of the second queue\n# vendor: us\nA.B,Fail\n");
  EXPECT_EQ(read("m").files()->entries.at("A.B").reason, "pass: of the second queue vendor: us");
  EXPECT_EQ(read("m").files()->header.vendor, "Mesa");
}

// Without a reason of the user, a new entry has what the run found out.
TEST_F(Baselines, NewEntriesNameTheirBugAndItsClause) {
  RunResult result = record({test("A.B", Verdict::kFail, {"x"}), test("A.C", Verdict::kFail, {"x"}),
                             test("A.D", Verdict::kFail, {"x"}), test("A.E", Verdict::kFail, {"x"})});
  Bug bug;
  bug.id = "EV-MAP1-COPY-1234";
  bug.title = "points are not copied";
  bug.clause = "GL 2.1 5.1";
  bug.tests = {"A.B"};
  result.bugs = {bug};
  bug.known = "mesa-a";
  bug.tests = {"A.C"};
  result.bugs.push_back(bug);
  result.tests[2].requirements = {RequirementId("EV-MAP1-COPY")};
  write("m-fails.txt", std::string(kHeader) + "# not traced to a bug yet\nA.B,Fail\n\n# mine\nA.C,Fail\n");
  const auto reason = [](const BaselineFiles& files, const std::string& name) {
    return files.entries.at(name).reason;
  };
  const BaselineFiles fresh = Baseline().renewed(result, {}, "new");
  EXPECT_EQ(reason(fresh, "A.B"), "bug: EV-MAP1-COPY-1234. points are not copied [GL 2.1 5.1]");
  EXPECT_EQ(reason(fresh, "A.C"), "bug: mesa-a. points are not copied [GL 2.1 5.1]");
  EXPECT_EQ(fresh.entries.at("A.C").bug(), "mesa-a");
  EXPECT_TRUE(reason(fresh, "A.D").starts_with("EV-MAP1-COPY [glMap1 page")) << reason(fresh, "A.D");
  EXPECT_EQ(reason(fresh, "A.E"), "not traced to a bug yet");
  const BaselineFiles again = read("m").renewed(result, choice("m"), "");
  EXPECT_EQ(reason(again, "A.B"), reason(fresh, "A.B")) << "the reason was not known before";
  EXPECT_EQ(reason(again, "A.C"), "mine");
  EXPECT_EQ(reason(read("m").renewed(result, choice("m"), "", "issue 1"), "A.C"), "issue 1");
}

// New files must not replace files of the same name whose header does not fit.
TEST_F(Baselines, NewOnesDoNotReplaceOthers) {
  write("m-fails.txt", "# version: Mesa 20.3\n\n# found by hand\nA.B,Fail\n");
  const RunResult result = record({test("A.C", Verdict::kFail, {"x"})});
  const Baseline none = find(result.implementation);
  ASSERT_EQ(none.name(), "");
  try {
    none.renewed(result, choice(), "m");
    ADD_FAILURE();
  } catch (const BadBaseline& error) {
    EXPECT_TRUE(contains(error.what(), "m-fails.txt is for other implementations (version: Mesa 20.3)"));
    EXPECT_TRUE(contains(error.what(), "--baseline FOLDER/m"));
  }
  EXPECT_EQ(none.renewed(result, choice(), "new").entries.size(), 1u);
  EXPECT_EQ(read("m").renewed(result, choice("m"), "m").entries.size(), 2u);
}

TEST_F(Baselines, AChosenOneIsUsedWhateverItsHeaderSays) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  const ImplementationRecord other = implementation("somebody", "Radeon", "1.4 somebody's GL 2.0");
  EXPECT_EQ(find(other).name(), "");
  EXPECT_EQ(find(other, Pass::kFreshContexts, "m").name(), "m");
  EXPECT_EQ(find(other, Pass::kReuseContext, "m").name(), "");
  EXPECT_THROW(find(other, Pass::kFreshContexts, "absent"), BadBaseline);
}

// --- known bugs

class KnownBugsInBaselines : public Baselines {
 protected:
  KnownBugsInBaselines() {
    KnownBug bug;
    bug.id = "mesa-a";
    bug.title = "A is wrong";
    bug.affects = {"Mesa", "20.3", "26.2", "", "", {}, {}};
    bug.tests = {{{}, "Fail", {"A.@(B|Longer|Alternatives)*", "A.C"}},
                 {{.renderer = "softpipe"}, "Crash", {"A.S"}},
                 {{.implementations = {"glx"}}, "Skip", {"A.G"}},
                 {{}, "Flaky", {"A.F"}}};
    bugs_.push_back(bug);
    bug.id = "mesa-b";
    bug.tests = {{{}, "Fail", {"A.B/List"}}};
    bugs_.push_back(bug);
    record_.implementation.kind = "egl";
    record_.depth = Depth::kThorough;  // failing cases are not compared
  }

  Baseline of(const std::string& renderer, const std::string& version, const std::string& kind = "egl",
              const BaselineChoice& choice = {}) const {
    return {choice, implementation("Mesa", renderer, version, kind), Pass::kFreshContexts, bugs_};
  }
  Baseline of_record(const BaselineChoice& choice = {}) const {
    return {choice, record_.implementation, Pass::kFreshContexts, bugs_};
  }

  std::vector<KnownBug> bugs_;
  RunResult record_ = record({});
};

TEST_F(KnownBugsInBaselines, AreExpectedInTheAffectedVersionsAndNewerOnes) {
  EXPECT_EQ(of("llvmpipe", "4.5 Mesa 20.3.5").name(), "mesa");
  EXPECT_EQ(of("llvmpipe", "4.5 Mesa 27.0.0").name(), "mesa");
  EXPECT_EQ(of("llvmpipe", "4.5 Mesa 20.2.6").name(), "");
  EXPECT_EQ(of("NVIDIA", "4.6.0 NVIDIA 580.1").name(), "");
  EXPECT_EQ(of("llvmpipe", "4.5 Mesa 25.0.0", "dropin").name(), "") << "it has its own evaluators";
  EXPECT_EQ(of("llvmpipe", "4.5 Mesa 25.0.0", "egl", {.known_bugs = false}).name(), "");
  EXPECT_TRUE(of("llvmpipe", "4.5 Mesa 25.0.0", "glx").skip("A.G"));
  EXPECT_FALSE(of("llvmpipe", "4.5 Mesa 25.0.0").skip("A.G"));
  const TestRecord crash = test("A.S", Verdict::kCrash);
  EXPECT_TRUE(of("softpipe", "4.5 Mesa 25.0.0").knows(crash, Depth::kQuick, 1));
  EXPECT_FALSE(of("llvmpipe", "4.5 Mesa 25.0.0").knows(crash, Depth::kQuick, 1));
}

// At quick and full depth, one more failing value is unexpected.
TEST_F(KnownBugsInBaselines, HaveKnownFailingCases) {
  const std::string function = "GetMap.IntegersSaturate";
  bugs_[0].tests = {{{}, "Fail", {function + "/*"}}};
  TestRecord failing = test(function + "/MAP1_INDEX", Verdict::kFail);
  failing.signature_of_all = *known_signatures("mesa", function).begin();
  EXPECT_TRUE(of_record().knows(failing, Depth::kQuick, 1));
  failing.signature_of_all = "5-0000000000000000";
  EXPECT_FALSE(of_record().knows(failing, Depth::kQuick, 1));
  EXPECT_TRUE(of_record().knows(failing, Depth::kQuick, 2));
  EXPECT_TRUE(of_record().knows(failing, Depth::kThorough, 1));
}

TEST_F(KnownBugsInBaselines, AreNamedTheMostSpecificFirst) {
  record_.tests = {test("A.B/List", Verdict::kFail), test("A.B", Verdict::kPass),
                   test("A.F", Verdict::kTimeout), test("A.C", Verdict::kCrash)};
  apply(of_record(), record_);
  EXPECT_EQ(record_.tests[0].known_bugs, (std::vector<std::string>{"mesa-b", "mesa-a"}));
  EXPECT_EQ(record_.tests[0].baseline_reason, "mesa-b: A is wrong");
  EXPECT_FALSE(record_.tests[1].is_unexpected_pass());
  EXPECT_TRUE(record_.tests[2].expected_by_baseline);
  EXPECT_EQ(record_.tests[2].known_bugs, std::vector<std::string>{"mesa-a"});
  EXPECT_FALSE(record_.tests[3].expected_by_baseline) << "another status";
}

TEST_F(KnownBugsInBaselines, OfWhichNothingFailsAreUnexpectedPasses) {
  record_.tests = {test("A.B", Verdict::kPass), test("A.B/List", Verdict::kPass),
                   test("A.C", Verdict::kFail)};
  apply(of_record(), record_);
  EXPECT_FALSE(record_.tests[0].is_unexpected_pass()) << "another test of mesa-a fails";
  EXPECT_TRUE(record_.tests[1].is_unexpected_pass()) << "the only test of mesa-b";
}

// A line of the user adds a failure, or takes one back.
TEST_F(KnownBugsInBaselines, TheUserAddsAndTakesBack) {
  write("m-fails.txt", std::string(kHeader) + "# mended here\nA.C,Pass\n\n# bug: mesa-b. ours\nA.N,Fail\n");
  record_.tests = {test("A.C", Verdict::kFail), test("A.N", Verdict::kFail), test("A.B", Verdict::kFail)};
  const Baseline baseline = of_record(choice());
  EXPECT_EQ(baseline.name(), "mesa with m");
  apply(baseline, record_);
  EXPECT_FALSE(record_.tests[0].expected_by_baseline);
  EXPECT_EQ(record_.tests[1].known_bugs, std::vector<std::string>{"mesa-b"});
  EXPECT_TRUE(record_.tests[2].expected_by_baseline);
  EXPECT_EQ(baseline.stale_entries(listed({"A.C", "A.N"})), std::vector<std::string>{});
}

// Only failures that are not known anyway get an entry.
TEST_F(KnownBugsInBaselines, RenewedFilesHoldTheDifferences) {
  write("m-fails.txt", std::string(kHeader) + "# must pass\nA.C,Pass\n\n# old\nA.O,Fail\nA.U,Fail\n");
  record_.tests = {test("A.B", Verdict::kFail, {"x"}), test("A.C", Verdict::kPass),
                   test("A.N", Verdict::kFail, {"y"}), test("A.O", Verdict::kPass),
                   test("A.U", Verdict::kNotObservable)};
  of_record(choice()).renewed(record_, choice(), "").write(folder_);
  const BaselineFiles files = BaselineFiles::read(folder_, "m");
  std::vector<std::string> entries;
  for (const auto& [test, entry] : files.entries) entries.push_back(test + "," + entry.status);
  EXPECT_EQ(entries, (std::vector<std::string>{"A.C,Pass", "A.N,Fail", "A.U,Fail"}));
  EXPECT_EQ(files.signatures.size(), 1u);
  apply(of_record(choice()), record_);
  for (const TestRecord& test : record_.tests) EXPECT_FALSE(test.is_unexpected()) << test.name;
}

// --- versions

TEST(VersionRanges, CompareTheComponentsOfTheirBounds) {
  struct Case {
    const char* range;
    const char* version;
    bool contained;
  };
  for (const auto& [range, version, contained] : {
           Case{"Mesa 20.3 to 24.3", "4.5 (Compatibility Profile) Mesa 24.3.9", true},
           {"Mesa 20.3 to 24.3", "3.1 Mesa 20.3.5", true},
           {"Mesa 20.3 to 24.3", "4.5 Mesa 25.0.0", false},
           {"Mesa 20.3 to 24.3", "4.5 Mesa 20.2.6", false},
           {"Mesa 20.3 to 24.3", "4.5 Mesa 9.0", false},  // compared as numbers
           {"Mesa 25.0 or newer", "4.6 (Compatibility Profile) Mesa 26.3.0-devel (git-0123456789)", true},
           {"Mesa 25.0 or newer", "4.6 Mesa 24.99", false},
           {"Mesa 25.0 or newer", "4.6.0 NVIDIA 580.159.04", false},
           {"Mesa 22.3 or older", "1.4 (4.5 Mesa 22.3.6)", true},
           {"Mesa 22.3 or older", "4.5 Mesa 23.0.0", false},
           {"Mesa 22.3", "4.5 Mesa 22.3.6", true},
           {"Mesa 22.3.6", "4.5 Mesa 22.3.5", false},
           {"NVIDIA 580", "4.6.0 NVIDIA 580.159.04", true},
           {"Mesa 25.0 or newer", "Mesa", false},
       })
    EXPECT_EQ(VersionRange(range).contains(version), contained) << range << ": " << version;
  EXPECT_TRUE(VersionRange().contains("anything"));
  for (const char* bad : {"Mesa or newer", "Mesa 20 to x", "Mesa to 20.3", "20.3 to 24.3"})
    EXPECT_THROW(VersionRange{bad}, std::invalid_argument) << bad;
}

}  // namespace
}  // namespace evalcts
