// Tests reading, applying, overlaying and updating baselines.
#include <evalcts/results/baseline.h>
#include <evalcts/results/test_patterns.h>

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

  Baseline find(const ImplementationRecord& implementation, Pass pass = Pass::kFreshContexts,
                const std::string& chosen = {}, Depth depth = Depth::kFull) const {
    return Baseline::best_fit(BaselineFiles::read_all(folder_), implementation, pass, chosen, depth);
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
  baseline.apply(result);
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
  find(result.implementation).apply(result);
  EXPECT_FALSE(result.tests[0].expected_by_baseline);
}

TEST_F(Baselines, OneMoreFailingValueIsUnexpected) {
  RunResult result = record({test("A.B", Verdict::kFail, {"case 1: x", "case 2: y"})});
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  write("m-signatures.txt", "A.B,quick," + result.tests[0].signature() + "\n");
  const Baseline baseline = read("m");
  RunResult same = result;
  baseline.apply(same);
  EXPECT_TRUE(same.tests[0].expected_by_baseline);

  RunResult more = record({test("A.B", Verdict::kFail, {"case 1: x", "case 2: y", "case 3: z"})});
  baseline.apply(more);
  EXPECT_FALSE(more.tests[0].expected_by_baseline);
  EXPECT_TRUE(contains(more.tests[0].message, "other cases"));

  RunResult deeper = more;  // there is no signature for this depth, so the failing cases are not compared
  deeper.depth = Depth::kThorough;
  baseline.apply(deeper);
  EXPECT_TRUE(deeper.tests[0].expected_by_baseline);
}

TEST_F(Baselines, OthersAreNotMeant) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  EXPECT_EQ(find(implementation("NVIDIA", "llvmpipe", "Mesa 22.3")).name(), "");
  EXPECT_EQ(find(implementation("Mesa", "llvmpipe", "Mesa 23.0")).name(), "");
  EXPECT_TRUE(BaselineFiles::read_all(folder_ / "absent").empty());
  EXPECT_EQ(Baseline::best_fit({}, {}).name(), "");
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
  read("m").apply(result);
  EXPECT_FALSE(result.tests[0].expected_by_baseline);
  EXPECT_EQ(result.tests[0].message, "m");
  EXPECT_EQ(read("m").unused_signatures(), std::vector<std::string>{"A.C"});
  EXPECT_EQ(read("m").stale_entries(listed({"A.B", "A.C"})), std::vector<std::string>{});
  read("m").renewed(record({}), "m", "").write(folder_);
  EXPECT_EQ(BaselineFiles::read(folder_, "m").signatures.size(), 1u);
}

// --- Patterns

const std::vector<std::string> kTests = {
    "A.B",         "A.B/EvalCoord1d", "A.B/EvalCoord1f", "A.B/EvalCoord2d",
    "A.BC/MAP1_f", "A.D/X",           "A.D/X/Nested",    "A.D/Y/Nested"};

TEST_F(Baselines, PatternsStandForTests) {
  write("m-fails.txt",
        std::string(kHeader) +
            "# reason\nA.B/EvalCoord1*,Fail\nA.Gone/*,Fail\n\n# other\nA.B/EvalCoord1f,Crash\n");
  write("m-signatures.txt", "A.B*,quick,1-b\nA.B/EvalCoord1f,quick,2-f\nA.D*,quick,1-d\n");
  const BaselineFiles files = BaselineFiles::read(folder_, "m").expanded(kTests);
  ASSERT_EQ(files.entries.size(), 3u);
  EXPECT_EQ(files.entries.at("A.B/EvalCoord1d").status, "Fail");
  EXPECT_EQ(files.entries.at("A.B/EvalCoord1f").status, "Crash") << "an entry for one test takes precedence";
  EXPECT_TRUE(files.entries.contains("A.Gone/*")) << "it is stale";
  EXPECT_EQ(files.signatures.at("A.B/EvalCoord1d").at("quick"), "1-b");
  EXPECT_EQ(files.signatures.at("A.B/EvalCoord1f").at("quick"), "2-f");
  EXPECT_FALSE(files.signatures.contains("A.B/EvalCoord2d")) << "it has no entry";
  EXPECT_TRUE(files.signatures.contains("A.D*")) << "it is unused";
}

TEST_F(Baselines, PassTakesATestOutOfAPattern) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.D/*,Fail\n\n# mended\nA.D/X,Pass\n");
  const BaselineFiles files = BaselineFiles::read(folder_, "m").expanded(kTests);
  EXPECT_EQ(files.entries.size(), 2u);
  EXPECT_TRUE(files.entries.contains("A.D/X/Nested"));
  EXPECT_FALSE(files.entries.contains("A.D/X"));
}

TEST_F(Baselines, AreWrittenWithFewPatternsThatMatchNothingElse) {
  BaselineFiles files;
  files.name = "m";
  for (const char* name : {"A.B/EvalCoord1d", "A.B/EvalCoord1f", "A.D/X/Nested", "A.D/Y/Nested"}) {
    files.entries[name] = {"Fail", "reason"};
    files.signatures[name]["quick"] = std::string(name).starts_with("A.B") ? "1-b" : "1-d";
  }
  files.signatures["A.D/X/Nested"]["quick"] = "2-d";
  const BaselineFiles few = files.with_patterns(kTests);
  const auto names = [](const auto& map) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : map) keys.push_back(key);
    return keys;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(few.entries), (Names{"A.B/EvalCoord1*", "A.D/*/Nested"})) << "A.D/X does not fail";
  EXPECT_EQ(names(few.signatures), (Names{"A.B/EvalCoord1*", "A.D/X/Nested", "A.D/Y/Nested"}));
  const BaselineFiles again = few.expanded(kTests);
  EXPECT_EQ(names(again.entries), names(files.entries));
  EXPECT_EQ(again.signatures, files.signatures);
}

TEST(Patterns, DoNotReachIntoFunctionsWithLongerNames) {
  EXPECT_EQ(patterns_for({"A.B", "A.B/X"}, {"A.BC", "A.BC/X"}), (std::vector<std::string>{"A.B", "A.B/X"}));
  EXPECT_EQ(patterns_for({"A.B", "A.B/X"}, {"A.C"}), std::vector<std::string>{"A.B*"});
}

TEST_F(Baselines, SkipsAndFlakesAreRegularExpressionsWithReasons) {
  write("m-fails.txt", kHeader);
  write("m-skips.txt", "# hangs\n# the machine\nB/x$\n^C\\.\n");
  write("m-flakes.txt", "# now and then\n^A\\.\n");
  const Baseline baseline = read("m");
  ASSERT_NE(baseline.skip("A.B/x"), nullptr);
  EXPECT_EQ(baseline.skip("A.B/x")->reason, "hangs the machine");
  EXPECT_NE(baseline.skip("C.D"), nullptr);
  EXPECT_EQ(baseline.skip("A.B/xy"), nullptr);
  RunResult result =
      record({test("A.B", Verdict::kFail), test("A.C", Verdict::kCrash), test("A.D", Verdict::kTimeout),
              test("A.E", Verdict::kPass), test("B.A", Verdict::kFail)});
  baseline.apply(result);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(result.tests[i].expected_by_baseline);
    EXPECT_EQ(result.tests[i].baseline_reason, "flaky: now and then");
  }
  EXPECT_EQ(result.tests[3].baseline_reason, "");
  EXPECT_FALSE(result.tests[4].expected_by_baseline);
  const std::vector<ListedTest> tests = listed({"A.B", "C.D"});
  EXPECT_EQ(baseline.stale_entries(tests), std::vector<std::string>{"B/x$ (in the skips)"});

  // Renewing changes neither skips nor flakes, and gives flaky tests no entry.
  baseline.renewed(result, "", "ignored").write(folder_);
  const Baseline after = read("m");
  EXPECT_EQ(after.entries().count("A.B"), 0u);
  EXPECT_EQ(after.entries().count("B.A"), 1u);
  EXPECT_NE(after.skip("C.D"), nullptr);
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
  EXPECT_EQ(find(implementation).name(), "a");
  implementation.kind = "osmesa";
  EXPECT_EQ(find(implementation).name(), "b");
  EXPECT_EQ(find(implementation, Pass::kReuseContext).name(), "c");
  implementation.kind = "egl";
  EXPECT_EQ(find(implementation).name(), "a");
  write("d-fails.txt", "# vendor: Mesa\n# renderer: llvmpipe\n# version: Mesa 22.3.6\n");
  EXPECT_EQ(find(implementation).name(), "d");
  write("d-fails.txt", start + "# pass: third\n");
  EXPECT_THROW(BaselineFiles::read_all(folder_), BadBaseline);
}

TEST_F(Baselines, SignaturesBelongToTheFirstSeed) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  write("m-signatures.txt", "A.B,quick,1-1\n");
  RunResult result = record({test("A.B", Verdict::kFail, {"x"})});
  result.seed = 2;
  read("m").renewed(result, "m", "").write(folder_);
  EXPECT_EQ(read("m").entries().at("A.B").signatures.at("quick"), "1-1");
  EXPECT_TRUE(contains(read_file(folder_ / "m-signatures.txt"), "seed 1"));
}

// A test that also fails in fresh contexts belongs into the baseline of the first pass.
TEST_F(Baselines, OfTheSecondPassHoldOnlyWhatIsNews) {
  RunResult result = record({test("A.B", Verdict::kFail, {"x"}), test("A.C", Verdict::kFail, {"y"})});
  result.pass = Pass::kReuseContext;
  result.tests[0].also_in_fresh_context = true;
  result.tests[0].expected_by_baseline = true;
  Baseline().renewed(result, "", "m.reuse-context").write(folder_);
  const Baseline baseline = find(result.implementation, Pass::kReuseContext);
  EXPECT_EQ(baseline.name(), "m.reuse-context");
  EXPECT_EQ(baseline.entries().size(), 1u);
  EXPECT_EQ(baseline.entries().count("A.C"), 1u);
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
  before.renewed(result, "", "ignored").write(folder_);
  const Baseline after = read("m");
  ASSERT_EQ(after.entries().size(), 2u);
  EXPECT_EQ(after.entries().at("A.B").reason, before.entries().at("A.B").reason);
  EXPECT_EQ(after.entries().at("A.B").signatures.at("quick"), result.tests[0].signature());
  EXPECT_EQ(after.entries().at("A.D").status, "Timeout");
  EXPECT_TRUE(contains(read_file(folder_ / "m-fails.txt"), "\n# bug: some-bug.\n# a reason that"));
  EXPECT_EQ(find(result.implementation).name(), "m");
}

// New files must not replace files of the same name whose header does not fit.
TEST_F(Baselines, NewOnesDoNotReplaceOthers) {
  write("m-fails.txt", "# version: Mesa 20.3\n\n# found by hand\nA.B,Fail\n");
  const RunResult result = record({test("A.C", Verdict::kFail, {"x"})});
  const std::vector<BaselineFiles> all = BaselineFiles::read_all(folder_);
  const Baseline none = find(result.implementation);
  ASSERT_EQ(none.name(), "");
  try {
    none.renewed(result, "", "m", all);
    ADD_FAILURE();
  } catch (const BadBaseline& error) {
    EXPECT_TRUE(contains(error.what(), "m-fails.txt is for other implementations (version: Mesa 20.3)"));
    EXPECT_TRUE(contains(error.what(), "--baseline FOLDER/m"));
  }
  EXPECT_EQ(none.renewed(result, "", "new", all).entries.size(), 1u);
  EXPECT_EQ(read("m").renewed(result, "m", "m", all).entries.size(), 2u);
}

// --- overlays

class Overlays : public Baselines {
 protected:
  Overlays() {
    write("mesa-fails.txt",
          "# version: Mesa 20.3 or newer\n# implementation: egl, glx\n\n# EV-1\nA.B,Fail\nA.C,Fail\n");
    write("mesa-signatures.txt", "A.B,quick,1-b\nA.C,quick,1-c\n");
    write("mesa.softpipe-fails.txt",
          "# extends: mesa\n# renderer: softpipe\n\n# EV-2\nA.C,Crash\nA.S,Fail\n\n# EV-3: right "
          "here\nA.B,Pass\n");
    write("mesa.softpipe-flakes.txt", "# sometimes\n^F\\.\n");
    write("mesa.old-fails.txt", "# extends: mesa\n# version: Mesa 24.3 or older\n\n# EV-4\nA.Old,Fail\n");
    write("mesa.old-signatures.txt", "A.C,quick,1-old\n");
  }

  static ImplementationRecord mesa(const std::string& renderer, const std::string& version,
                                   const std::string& kind = "egl") {
    return implementation("Mesa", renderer, version, kind);
  }
};

TEST_F(Overlays, AreAddedToTheBaseThatTheyExtend) {
  const Baseline plain = find(mesa("llvmpipe", "4.5 Mesa 25.0.7-2"));
  EXPECT_EQ(plain.name(), "mesa");
  EXPECT_EQ(plain.entries().size(), 2u);
  EXPECT_EQ(plain.entries().at("A.C").signatures.at("quick"), "1-c");

  const Baseline old = find(mesa("llvmpipe", "3.1 Mesa 20.3.5", "glx"));
  EXPECT_EQ(old.name(), "mesa with mesa.old");
  EXPECT_EQ(old.entries().at("A.Old").reason, "EV-4");
  EXPECT_EQ(old.entries().at("A.C").reason, "EV-1");
  EXPECT_EQ(old.entries().at("A.C").signatures.at("quick"), "1-old");

  const Baseline softpipe = find(mesa("softpipe", "4.5 Mesa 25.0.7"));
  EXPECT_EQ(softpipe.name(), "mesa with mesa.softpipe");
  EXPECT_EQ(softpipe.entries().at("A.C").status, "Crash");
  EXPECT_TRUE(
      softpipe.entries().at("A.C").signatures.empty());  // the signatures of the base belong to a fail
  EXPECT_EQ(softpipe.entries().count("A.S"), 1u);
  EXPECT_EQ(softpipe.entries().count("A.B"), 0u);  // withdrawn by the overlay
  EXPECT_NE(softpipe.flake("F.x"), nullptr);

  // Overlays are sorted by specificity, and the longest header is the most specific.
  EXPECT_EQ(find(mesa("softpipe", "3.1 Mesa 20.3.5")).name(), "mesa with mesa.softpipe, mesa.old");

  EXPECT_EQ(find(mesa("llvmpipe", "4.5 Mesa 25.0.7", "dropin")).name(), "");
  EXPECT_EQ(find(mesa("llvmpipe", "4.5 Mesa 20.2.6")).name(), "");
}

TEST_F(Overlays, MayBeForOneDepth) {
  write("mesa.thorough-fails.txt",
        "# extends: mesa\n# renderer: llvmpipe\n# depth: thorough\n\n# EV-5\nA.T,Fail\n");
  const ImplementationRecord llvmpipe = mesa("llvmpipe", "4.5 Mesa 25.0.7-2");
  EXPECT_EQ(find(llvmpipe, Pass::kFreshContexts, {}, Depth::kThorough).name(), "mesa with mesa.thorough");
  EXPECT_EQ(find(llvmpipe, Pass::kFreshContexts, {}, Depth::kFull).name(), "mesa");
  write("mesa.thorough-fails.txt", "# extends: mesa\n# renderer: llvmpipe\n# depth: deep\n");
  EXPECT_THROW(BaselineFiles::read_all(folder_), BadBaseline);
}

TEST_F(Overlays, AChosenOneIsUsedWhateverItsHeaderSays) {
  const ImplementationRecord other = mesa("Radeon", "1.4 somebody's GL 2.0");
  EXPECT_EQ(find(other).name(), "");
  EXPECT_EQ(find(other, Pass::kFreshContexts, "mesa").name(), "mesa");
  EXPECT_EQ(find(other, Pass::kFreshContexts, "mesa.softpipe").name(), "mesa with mesa.softpipe");
  EXPECT_EQ(find(other, Pass::kReuseContext, "mesa").name(), "");
  EXPECT_THROW(find(other, Pass::kFreshContexts, "absent"), BadBaseline);
}

TEST_F(Overlays, BadOverlaysAreRejected) {
  write("m-fails.txt", "# extends: absent\n# renderer: x\n");
  EXPECT_THROW(BaselineFiles::read_all(folder_), BadBaseline);
  write("m-fails.txt", "# extends: mesa.old\n# renderer: x\n");
  EXPECT_THROW(BaselineFiles::read_all(folder_), BadBaseline);
  write("m-fails.txt", "# extends: mesa\n");  // no field names an implementation
  EXPECT_THROW(BaselineFiles::read_all(folder_), BadBaseline);
  write("m-fails.txt", "# version: Mesa or newer\n");
  EXPECT_THROW(BaselineFiles::read_all(folder_), BadBaseline);
  write("m-fails.txt", "# version: Mesa 22.3\n\n# withdraws nothing\nA.B,Pass\n");
  EXPECT_THROW(BaselineFiles::read_all(folder_), BadBaseline);
}

TEST_F(Overlays, EntriesThatWithdrawNothingAreStale) {
  write("mesa.softpipe-fails.txt", "# extends: mesa\n# renderer: softpipe\n\n# EV-3\nA.S,Pass\n");
  const std::vector<ListedTest> tests = listed({"A.B", "A.C", "A.S", "F.x"});
  EXPECT_EQ(find(mesa("softpipe", "4.5 Mesa 25.0.7")).stale_entries(tests),
            std::vector<std::string>{"A.S (Pass in mesa.softpipe, but mesa expects no failure)"});
}

// An entry that an overlay withdraws keeps its signature in the base.
TEST_F(Overlays, SignaturesOfWithdrawnEntriesAreNotStale) {
  const std::vector<ListedTest> tests = listed({"A.B", "A.C", "A.S", "F.x"});
  EXPECT_EQ(find(mesa("softpipe", "4.5 Mesa 25.0.7")).stale_entries(tests), std::vector<std::string>{});
}

// A renewed overlay contains exactly the differences from its base.
TEST_F(Overlays, RenewedOnesHoldTheDifferences) {
  RunResult result = record({test("A.B", Verdict::kFail, {"x"}), test("A.C", Verdict::kPass),
                             test("A.N", Verdict::kFail, {"y"}), test("A.S", Verdict::kPass),
                             test("A.U", Verdict::kNotObservable)});
  result.implementation = mesa("softpipe", "4.5 Mesa 25.0.7");
  const Baseline before = find(result.implementation);
  EXPECT_THROW(before.renewed(result, "", ""), BadBaseline);          // no target, but two parts
  EXPECT_THROW(before.renewed(result, "mesa.old", ""), BadBaseline);  // not a part of this baseline
  before.renewed(result, "mesa.softpipe", "").write(folder_);
  const BaselineFiles files = BaselineFiles::read(folder_, "mesa.softpipe");
  ASSERT_EQ(files.entries.size(), 2u);
  EXPECT_EQ(files.entries.at("A.C").status, "Pass");
  EXPECT_EQ(files.entries.at("A.N").status, "Fail");
  EXPECT_EQ(files.signatures.count("A.B"), 1u);  // the base has an entry, but with other failing cases
  EXPECT_EQ(files.header.renderer, "softpipe");
  EXPECT_EQ(files.header.extends, "mesa");

  find(result.implementation).apply(result);
  EXPECT_EQ(result.baseline, "mesa with mesa.softpipe");
  EXPECT_TRUE(result.tests[0].expected_by_baseline);
  EXPECT_TRUE(result.tests[2].expected_by_baseline);
  for (const int passes : {1, 3}) EXPECT_EQ(result.tests[passes].baseline_reason, "");
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
