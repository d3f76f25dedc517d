// Finds patterns of test names: an exact cover by generalised names, the pattern that matches most names
// first.
#include <evalcts/results/test_patterns.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <tuple>

namespace evalcts {
namespace {

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), FNM_NOESCAPE) == 0;
}

// Returns "Map1State.Stride" for "Map1State.Stride/MAP1_INDEX_f".
std::string function_of(const std::string& name) { return name.substr(0, name.find('/')); }

// Returns more and more general forms of a part of a name: "EvalCoord1d", "EvalCoord1*", "*".
std::vector<std::string> forms_of(const std::string& part) {
  std::vector<std::string> forms = {part};
  for (const std::string stem : {"EvalCoord1", "EvalCoord2", "EvalPoint", "EvalMesh", "MAP1_", "MAP2_"})
    if (part.starts_with(stem)) forms.push_back(stem + "*");
  for (const std::string form : {"_f", "_d"})
    if (part.ends_with(form)) forms.push_back("*" + form);
  forms.emplace_back("*");
  return forms;
}

// Returns all general forms of a name. A pattern that ends in several parts of any name ends in one *.
std::set<std::string> forms_of_name(const std::string& name) {
  std::istringstream parts(name);
  std::string part;
  std::getline(parts, part, '/');
  std::vector<std::string> forms = {part};
  while (std::getline(parts, part, '/')) {
    std::vector<std::string> longer;
    for (const std::string& form : forms)
      for (const std::string& last : forms_of(part)) longer.push_back(form + "/" + last);
    forms = std::move(longer);
  }
  std::set<std::string> all;
  for (std::string form : forms) {
    all.insert(form);
    while (form.ends_with("/*")) {
      form.resize(form.size() - 2);
      all.insert(form + "*");
    }
  }
  return all;
}

// The same for tests of one function.
std::vector<std::string> patterns_of_function(const std::vector<std::string>& names,
                                              const std::vector<std::string>& others) {
  std::map<std::string, std::set<std::string>> matched;  // by pattern
  for (const std::string& name : names)
    for (const std::string& form : forms_of_name(name)) matched[form];
  std::erase_if(matched, [&](const auto& each) {
    return std::ranges::any_of(others, [&](const std::string& other) { return matches(each.first, other); });
  });
  for (auto& [pattern, own] : matched)
    for (const std::string& name : names)
      if (matches(pattern, name)) own.insert(name);
  std::vector<std::string> patterns;
  std::set<std::string> left(names.begin(), names.end());
  while (!left.empty()) {
    // The most specific one of the patterns that match most of these names.
    using Rank = std::tuple<std::ptrdiff_t, std::ptrdiff_t, std::size_t>;
    const auto rank = [&](const auto& each) {
      return Rank{
          std::ranges::count_if(each.second, [&](const std::string& name) { return left.contains(name); }),
          -std::ranges::count(each.first, '*'), each.first.size()};
    };
    const auto best = std::ranges::max_element(matched, {}, rank);
    patterns.push_back(best->first);
    for (const std::string& name : best->second) left.erase(name);
  }
  return patterns;
}

}  // namespace

std::vector<std::string> tests_of(const std::string& pattern, const std::vector<std::string>& tests) {
  const std::string beginning = pattern.substr(0, pattern.find('*'));
  std::vector<std::string> matched;
  for (auto test = std::ranges::lower_bound(tests, beginning);
       test != tests.end() && test->starts_with(beginning); ++test)
    if (matches(pattern, *test)) matched.push_back(*test);
  return matched;
}

std::vector<std::string> patterns_for(const std::set<std::string>& names,
                                      const std::set<std::string>& others) {
  std::map<std::string, std::vector<std::string>> own, of_others;  // by function
  for (const std::string& name : names) own[function_of(name)].push_back(name);
  for (const std::string& name : others) of_others[function_of(name)].push_back(name);
  std::vector<std::string> patterns;
  for (const auto& [function, of_function] : own) {
    // A pattern without a further part also matches functions whose names begin in the same way.
    std::vector<std::string> avoided;
    for (const auto& [other, of_other] : of_others)
      if (other.starts_with(function)) avoided.insert(avoided.end(), of_other.begin(), of_other.end());
    for (const auto& [other, of_other] : own)
      if (other != function && other.starts_with(function))
        avoided.insert(avoided.end(), of_other.begin(), of_other.end());
    for (std::string& pattern : patterns_of_function(of_function, avoided))
      patterns.push_back(std::move(pattern));
  }
  std::ranges::sort(patterns);
  return patterns;
}

}  // namespace evalcts
