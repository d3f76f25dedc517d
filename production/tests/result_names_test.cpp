// Tests of the names of results and errors, against the declarations in glevaluator.h.
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "fixture.h"

namespace glev_tests {
namespace {

using Names = std::map<unsigned, std::string>;

// Calls add(name, number) for the declarations of the header that begin with `first`: enumerators and macros.
template <class Add>
void for_declarations(const std::string& first, const Add& add) {
  std::ifstream header(GLEV_HEADER);
  for (std::string line; std::getline(header, line);) {
    if (!line.starts_with(first)) continue;
    std::istringstream words(line.substr(first.find("GLEV_")));
    std::string name, number;
    words >> name >> number;
    if (number == "=") words >> number;
    add(name, number);
  }
}
unsigned value_of(const std::string& number) { return static_cast<unsigned>(std::stoul(number, nullptr, 0)); }

// `name_of` returns the name of a number.
template <class NameOf>
void expect_names(const Names& declared, const char* unknown, const NameOf& name_of) {
  for (unsigned number = 0; number < 0x2000; ++number) {
    const auto found = declared.find(number);
    ASSERT_EQ(name_of(number), found != declared.end() ? found->second : unknown) << number;
  }
  EXPECT_STREQ(name_of(0xFFFFFFFF), unknown);
}

TEST(ResultNames, EveryResultHasItsName) {
  Names declared;
  for (const char* const first : {"  GLEV_SUCCESS", "  GLEV_ERROR_"}) {
    for_declarations(first, [&](const std::string& name, const std::string& number) {
      declared.emplace(value_of(number), name);
    });
  }
  ASSERT_EQ(declared.size(), 9u);
  expect_names(declared, "unknown result", [](unsigned number) {
    glev_result result;
    std::memcpy(&result, &number, sizeof result);
    return glevGetResultString(result);
  });
}

TEST(ResultNames, EveryErrorHasItsName) {
  Names declared;
  for_declarations("#define GLEV_", [&](const std::string& name, const std::string& number) {
    const bool is_error = number == "0" || (number.starts_with("0x05") && number.size() == 6);
    if (is_error && name != "GLEV_FALSE") declared.emplace(value_of(number), name);
  });
  ASSERT_EQ(declared.size(), 7u);
  expect_names(declared, "unknown error", glevGetErrorString);
}

}  // namespace
}  // namespace glev_tests
