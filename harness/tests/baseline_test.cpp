#include "harness/runner/baseline.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace evalcts {
namespace {

using nlohmann::json;
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

  Baseline find(const json& implementation, const std::string& pass = {}) const {
    return Baseline::best_fit(Baseline::read_all(folder_), implementation, pass);
  }

  static json test(const std::string& name, const std::string& verdict,
                   const std::vector<std::string>& mismatches = {}) {
    return {{"name", name},          {"verdict", verdict},
            {"message", "m"},        {"mismatches", mismatches},
            {"baseline_reason", ""}, {"expected_by_baseline", false}};
  }
  static json record(const std::vector<json>& tests) {
    return {{"implementation",
             {{"vendor", "Mesa/X.org"}, {"renderer", "llvmpipe (LLVM 15)"}, {"version", "4.5 Mesa 22.3.6"}}},
            {"depth", "quick"},
            {"seed", 1},
            {"tests", tests}};
  }

  static constexpr const char* kHeader = "# vendor: Mesa\n# renderer: llvmpipe\n# version: Mesa 22.3\n\n";
  fs::path folder_;
};

TEST_F(Baselines, KnownFailuresAreExpectedWithTheirReason) {
  write("m-fails.txt",
        std::string(kHeader) +
            "# GL 2.1 5.1: the current colour\n# is lost\nA.B,Fail\nA.C,Crash\n\n# other\nA.D,Fail\n");
  json result = record({test("A.B", "fail"), test("A.C", "crash"), test("A.D", "pass"), test("A.E", "fail"),
                        test("A.F", "pass")});
  const Baseline baseline = find(result["implementation"]);
  ASSERT_EQ(baseline.name(), "m");
  baseline.apply(result);
  const json& tests = result["tests"];
  EXPECT_EQ(tests[0]["expected_by_baseline"], true);
  EXPECT_EQ(as_text(tests[0]["baseline_reason"]), "GL 2.1 5.1: the current colour is lost");
  EXPECT_EQ(tests[1]["expected_by_baseline"], true);
  EXPECT_EQ(tests[2]["expected_by_baseline"], false);  // an unexpected pass
  EXPECT_EQ(as_text(tests[2]["baseline_reason"]), "other");
  EXPECT_EQ(tests[3]["expected_by_baseline"], false);
  EXPECT_EQ(tests[4]["baseline_reason"].get<std::string>(), "");
  EXPECT_EQ(as_text(result["baseline"]), "m");
}

TEST_F(Baselines, AnotherStatusIsUnexpected) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  json result = record({test("A.B", "crash")});
  find(result["implementation"]).apply(result);
  EXPECT_EQ(result["tests"][0]["expected_by_baseline"], false);
}

TEST_F(Baselines, OneMoreFailingValueIsUnexpected) {
  json result = record({test("A.B", "fail", {"case 1: x", "case 2: y"})});
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  write("m-signatures.txt", "A.B,quick," + signature_of(result["tests"][0]) + "\n");
  const Baseline baseline = Baseline::read(folder_, "m");
  json same = result;
  baseline.apply(same);
  EXPECT_EQ(same["tests"][0]["expected_by_baseline"], true);

  json more = record({test("A.B", "fail", {"case 1: x", "case 2: y", "case 3: z"})});
  baseline.apply(more);
  EXPECT_EQ(more["tests"][0]["expected_by_baseline"], false);
  EXPECT_NE(more["tests"][0]["message"].get<std::string>().find("other cases"), std::string::npos);

  json deeper = more;  // a depth without a signature is not compared
  deeper["depth"] = "thorough";
  baseline.apply(deeper);
  EXPECT_EQ(deeper["tests"][0]["expected_by_baseline"], true);
}

TEST_F(Baselines, OthersAreNotMeant) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  EXPECT_EQ(find({{"vendor", "NVIDIA"}, {"renderer", "llvmpipe"}, {"version", "Mesa 22.3"}}).name(), "");
  EXPECT_EQ(find({{"vendor", "Mesa"}, {"renderer", "llvmpipe"}, {"version", "Mesa 23.0"}}).name(), "");
  EXPECT_TRUE(Baseline::read_all(folder_ / "absent").empty());
  EXPECT_EQ(Baseline::best_fit({}, {}).name(), "");
}

TEST_F(Baselines, StaleEntriesAreNamed) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\nA.Gone,Fail\n");
  const json tests = {{"tests", {{{"name", "A.B"}}}}};
  EXPECT_EQ(Baseline::read(folder_, "m").stale_entries(tests), std::vector<std::string>{"A.Gone"});
}

TEST_F(Baselines, BadFilesAreRefusedWithFileAndLine) {
  for (const std::string body : {"A.B,Fail\n", "# reason\nA.B\n", "# reason\nA.B,Sometimes\n",
                                 "# reason\nA.B,Fail,x\n", "# reason\nA.B,Fail\nA.B,Fail\n"}) {
    write("m-fails.txt", kHeader + body);
    try {
      Baseline::read(folder_, "m");
      ADD_FAILURE() << body;
    } catch (const BadBaseline& error) {
      EXPECT_NE(std::string(error.what()).find("m-fails.txt:"), std::string::npos);
    }
  }
  write("m-fails.txt", "# reason\nA.B,Fail\n");  // no header
  EXPECT_THROW(Baseline::read(folder_, "m"), BadBaseline);
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  write("m-signatures.txt", "A.C,quick,1\n");
  EXPECT_THROW(Baseline::read(folder_, "m"), BadBaseline);
  EXPECT_THROW(Baseline::read(folder_, "absent"), BadBaseline);
}

TEST_F(Baselines, SkipsAndFlakesAreRegularExpressionsWithReasons) {
  write("m-fails.txt", kHeader);
  write("m-skips.txt", "# hangs\n# the machine\nB/x$\n^C\\.\n");
  write("m-flakes.txt", "# now and then\n^A\\.\n");
  const Baseline baseline = Baseline::read(folder_, "m");
  ASSERT_NE(baseline.skip("A.B/x"), nullptr);
  EXPECT_EQ(baseline.skip("A.B/x")->reason, "hangs the machine");
  EXPECT_NE(baseline.skip("C.D"), nullptr);
  EXPECT_EQ(baseline.skip("A.B/xy"), nullptr);
  json result = record({test("A.B", "fail"), test("A.C", "crash"), test("A.D", "timeout"),
                        test("A.E", "pass"), test("B.A", "fail")});
  baseline.apply(result);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(result["tests"][i]["expected_by_baseline"], true);
    EXPECT_EQ(as_text(result["tests"][i]["baseline_reason"]), "flaky: now and then");
  }
  EXPECT_EQ(result["tests"][3]["baseline_reason"].get<std::string>(), "");
  EXPECT_EQ(result["tests"][4]["expected_by_baseline"], false);
  const json tests = {{"tests", {{{"name", "A.B"}}, {{"name", "C.D"}}}}};
  EXPECT_EQ(baseline.stale_entries(tests), std::vector<std::string>{"B/x$ (in the skips)"});

  // Renewing leaves both alone and gives flaky tests no entry.
  baseline.renewed(result, "m").write(folder_);
  const Baseline after = Baseline::read(folder_, "m");
  EXPECT_EQ(after.entries().count("A.B"), 0u);
  EXPECT_EQ(after.entries().count("B.A"), 1u);
  EXPECT_NE(after.skip("C.D"), nullptr);
}

TEST_F(Baselines, BadPatternsAreRefusedWithFileAndLine) {
  write("m-fails.txt", kHeader);
  const std::pair<const char*, const char*> bad[] = {
      {"# reason\nA\n\n# reason\n(\n", ":5: '(' is no regular"},
      {"A\n", ":1: an entry needs its reason"},
      {"# reason\n\nA\n", ":3: an entry needs its reason"}};
  for (const std::string file : {"m-skips.txt", "m-flakes.txt"}) {
    for (const auto& [text, message] : bad) {
      write(file, text);
      try {
        Baseline::read_all(folder_);
        ADD_FAILURE() << text;
      } catch (const BadBaseline& error) {
        EXPECT_NE(std::string(error.what()).find(file + message), std::string::npos) << error.what();
      }
    }
    fs::remove(folder_ / file);
  }
  write("other-skips.txt", "# reason\nA\n");
  EXPECT_THROW(Baseline::read_all(folder_), BadBaseline);  // for what?
}

TEST_F(Baselines, TheMoreSpecificHeaderIsMeant) {
  const std::string start = "# vendor: Mesa\n# renderer: llvmpipe\n# version: Mesa 22.3\n";
  write("a-fails.txt", start);
  write("b-fails.txt", start + "# implementation: osmesa\n");
  write("c-fails.txt", start + "# pass: reuse-context\n");
  json implementation = record({})["implementation"];
  EXPECT_EQ(find(implementation).name(), "a");
  implementation["kind"] = "osmesa";
  EXPECT_EQ(find(implementation).name(), "b");
  EXPECT_EQ(find(implementation, "reuse-context").name(), "c");
  implementation["kind"] = "egl";
  EXPECT_EQ(find(implementation).name(), "a");
  write("d-fails.txt", "# vendor: Mesa\n# renderer: llvmpipe\n# version: Mesa 22.3.6\n");
  EXPECT_EQ(find(implementation).name(), "d");
  write("d-fails.txt", start + "# pass: third\n");
  EXPECT_THROW(Baseline::read_all(folder_), BadBaseline);
}

TEST_F(Baselines, SignaturesBelongToTheFirstSeed) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  write("m-signatures.txt", "A.B,quick,1-1\n");
  json result = record({test("A.B", "fail", {"x"})});
  result["seed"] = 2;
  Baseline::read(folder_, "m").renewed(result, "m").write(folder_);
  EXPECT_EQ(Baseline::read(folder_, "m").entries().at("A.B").signatures.at("quick"), "1-1");
  std::ifstream file(folder_ / "m-signatures.txt");
  EXPECT_NE(std::string(std::istreambuf_iterator<char>(file), {}).find("seed 1"), std::string::npos);
}

// What fails with fresh contexts belongs into the other baseline.
TEST_F(Baselines, OfTheSecondPassHoldOnlyWhatIsNews) {
  json result = record({test("A.B", "fail", {"x"}), test("A.C", "fail", {"y"})});
  result["pass"] = "reuse-context";
  result["tests"][0]["also_in_fresh_context"] = true;
  result["tests"][0]["expected_by_baseline"] = true;
  Baseline().renewed(result, "m.reuse-context").write(folder_);
  const Baseline baseline = find(result["implementation"], "reuse-context");
  EXPECT_EQ(baseline.name(), "m.reuse-context");
  EXPECT_EQ(baseline.entries().size(), 1u);
  EXPECT_EQ(baseline.entries().count("A.C"), 1u);
  EXPECT_EQ(find(result["implementation"]).name(), "");
}

TEST_F(Baselines, RenewedOnesKeepReasonsAndReadBack) {
  write("m-fails.txt", std::string(kHeader) +
                           "# a reason that is long enough to be wrapped when it is written, because "
                           "it has many words in it\nA.B,Fail\n\n# fixed by now\nA.C,Fail\n");
  const json result = record({test("A.B", "fail", {"x"}), test("A.C", "pass"), test("A.D", "timeout")});
  const Baseline before = Baseline::read(folder_, "m");
  before.renewed(result, "ignored").write(folder_);
  const Baseline after = Baseline::read(folder_, "m");
  ASSERT_EQ(after.entries().size(), 2u);
  EXPECT_EQ(after.entries().at("A.B").reason, before.entries().at("A.B").reason);
  EXPECT_EQ(after.entries().at("A.B").signatures.at("quick"), signature_of(result["tests"][0]));
  EXPECT_EQ(after.entries().at("A.D").status, "Timeout");
  EXPECT_TRUE(after.fits(result["implementation"]));
}

}  // namespace
}  // namespace evalcts
