// Tests that each mutation of mutations.json that names a test of the library is detected by this test. The
// conformance suite detects the others (evalcts faults).
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <ostream>
#include <string>
#include <vector>

namespace {

struct Mutation {
  int number;
  std::string name, requirements, test;
};

void PrintTo(const Mutation& mutation, std::ostream* stream) { *stream << mutation.name; }

std::vector<Mutation> mutations() {
  std::vector<Mutation> all;
#define GLEV_MUTATION(name, level, requirements, what, test) \
  all.push_back({static_cast<int>(all.size()) + 1, #name, requirements, test});
#include <mutations/mutation_list.h>
#undef GLEV_MUTATION
  return all;
}

std::vector<Mutation> mutations_with_test() {
  std::vector<Mutation> chosen = mutations();
  std::erase_if(chosen, [](const Mutation& mutation) { return mutation.test.empty(); });
  return chosen;
}

// Returns the exit status of the tests of the library with a mutation; 124 after two minutes, because
// mutations may loop. The first failed assertion ends the tests.
int status_of(int mutation, const std::string& filter) {
  const std::string command =
      "GLEV_MUTATION=" + std::to_string(mutation) +
      " timeout 120 '" MUTATED_TESTS
      "' --gtest_fail_fast --gtest_throw_on_failure --gtest_brief=1 '--gtest_filter=" +
      filter + "' > /dev/null 2>&1";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

class MutationTest : public testing::TestWithParam<Mutation> {};

TEST_P(MutationTest, IsDetected) {
  const Mutation& mutation = GetParam();
  EXPECT_NE(status_of(mutation.number, mutation.test), 0)
      << mutation.name << ": " << mutation.test << " passes with this mutation, or there is no such test";
}

INSTANTIATE_TEST_SUITE_P(Library, MutationTest, testing::ValuesIn(mutations_with_test()),
                         [](const auto& each) { return each.param.name; });

TEST(Mutations, WithoutOneAllTestsPass) {
  std::string filter;
  for (const Mutation& mutation : mutations_with_test()) filter += mutation.test + ":";
  EXPECT_EQ(status_of(0, filter), 0);
}

TEST(Mutations, HaveARequirementOrATest) {
  for (const Mutation& mutation : mutations())
    EXPECT_FALSE(mutation.requirements.empty() && mutation.test.empty()) << mutation.name;
}

}  // namespace
