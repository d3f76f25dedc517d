// Tests of the names of results and errors, against the declarations in glevaluator.h.
#include <cstring>
#include <fstream>
#include <regex>
#include <string>

#include "fixture.h"

namespace glev_tests {
namespace {

// Returns the names that the header declares with numbers, by number. `pattern` captures name and number.
std::map<unsigned, std::string> declared_names(const char* pattern) {
  std::map<unsigned, std::string> names;
  const std::regex declaration(pattern);
  std::ifstream header(GLEV_HEADER);
  for (std::string line; std::getline(header, line);) {
    std::smatch match;
    if (std::regex_search(line, match, declaration))
      names.emplace(static_cast<unsigned>(std::stoul(match[2], nullptr, 0)), match[1]);
  }
  return names;
}

// `name_of` returns the name of a number.
template <class NameOf>
void expect_names(const std::map<unsigned, std::string>& declared, const char* unknown,
                  const NameOf& name_of) {
  for (unsigned number = 0; number < 0x2000; ++number) {
    const auto found = declared.find(number);
    ASSERT_EQ(name_of(number), found != declared.end() ? found->second : unknown) << number;
  }
  EXPECT_STREQ(name_of(0xFFFFFFFF), unknown);
}

TEST(ResultNames, EveryResultHasItsName) {
  const auto declared = declared_names("^  (GLEV_(?:SUCCESS|ERROR_[A-Z_]+)) = ([0-9]+)");
  ASSERT_EQ(declared.size(), 9u);
  expect_names(declared, "unknown result", [](unsigned number) {
    glev_result result;
    std::memcpy(&result, &number, sizeof result);
    return glevGetResultString(result);
  });
}

TEST(ResultNames, EveryErrorHasItsName) {
  const auto declared = declared_names("^#define (GLEV_(?!FALSE)[A-Z_]+) (0|0x05[0-9]{2})$");
  ASSERT_EQ(declared.size(), 7u);
  expect_names(declared, "unknown error", glevGetErrorString);
}

}  // namespace
}  // namespace glev_tests
