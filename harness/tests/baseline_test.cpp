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
  const Baseline baseline = Baseline::find(folder_, result["implementation"]);
  ASSERT_EQ(baseline.name(), "m");
  baseline.apply(result);
  const json& tests = result["tests"];
  EXPECT_EQ(tests[0]["expected_by_baseline"], true);
  EXPECT_EQ(tests[0]["baseline_reason"], "GL 2.1 5.1: the current colour is lost");
  EXPECT_EQ(tests[1]["expected_by_baseline"], true);
  EXPECT_EQ(tests[2]["expected_by_baseline"], false);  // an unexpected pass
  EXPECT_EQ(tests[2]["baseline_reason"], "other");
  EXPECT_EQ(tests[3]["expected_by_baseline"], false);
  EXPECT_EQ(tests[4]["baseline_reason"], "");
  EXPECT_EQ(result["baseline"], "m");
}

TEST_F(Baselines, AnotherStatusIsUnexpected) {
  write("m-fails.txt", std::string(kHeader) + "# reason\nA.B,Fail\n");
  json result = record({test("A.B", "crash")});
  Baseline::find(folder_, result["implementation"]).apply(result);
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
  EXPECT_EQ(
      Baseline::find(folder_, {{"vendor", "NVIDIA"}, {"renderer", "llvmpipe"}, {"version", "Mesa 22.3"}})
          .name(),
      "");
  EXPECT_EQ(Baseline::find(folder_, {{"vendor", "Mesa"}, {"renderer", "llvmpipe"}, {"version", "Mesa 23.0"}})
                .name(),
            "");
  EXPECT_EQ(Baseline::find(folder_ / "absent", {}).name(), "");
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
