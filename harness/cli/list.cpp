#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "harness/cli/catalogue.h"
#include "harness/cli/commands.h"
#include "harness/implementations/implementation.h"
#include "harness/runner/child_process.h"
#include "harness/runner/runner.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;

// Asked in a child: libraries do not share a process well.
bool can_start(const std::string& name) {
  ChildProcess child({places().suite_program.string(), "--implementation", name, "--describe"}, "");
  const auto ending = child.wait(30);
  return ending && !ending->signalled && ending->value == 0;
}

json implementations() {
  json all = json::array();
  for (const ImplementationKind& kind : implementation_kinds()) {
    const bool available = can_start(kind.name);
    json entry = {
        {"name", kind.name}, {"what", kind.what}, {"available", available}, {"package", kind.package}};
    if (!available)
      entry["reason"] = kind.package.empty()
                            ? "it does not start; run it to see why"
                            : "package " + kind.package + " is not installed, or has no evaluators";
    all.push_back(entry);
  }
  return all;
}

}  // namespace

int list(const std::string& what, bool as_json) {
  if (what == "implementations") {
    const json all = implementations();
    if (as_json) {
      std::cout << json{{"implementations", all}}.dump(1) << "\n";
    } else {
      for (const json& entry : all)
        std::cout << fmt::format("{:<12} {:<14} {}\n", entry["name"].get<std::string>(),
                                 entry["available"].get<bool>() ? "available" : "not available",
                                 entry["available"].get<bool>() ? entry["what"].get<std::string>()
                                                                : entry["reason"].get<std::string>());
    }
  } else if (what == "requirements") {
    if (as_json) {
      std::cout << catalogue().dump(1) << "\n";
    } else {
      for (const json& requirement : catalogue()["requirements"])
        std::cout << fmt::format("{:<28} {}\n", requirement["id"].get<std::string>(),
                                 requirement["text"].get<std::string>());
    }
  } else {
    const json tests = list_tests(places().suite_program);
    if (as_json) {
      std::cout << tests.dump(1) << "\n";
    } else {
      for (const json& test : tests["tests"])
        std::cout << fmt::format("{:<60} {}\n", test["name"].get<std::string>(),
                                 fmt::join(test["requirements"].get<std::vector<std::string>>(), " "));
    }
  }
  return kNothingUnexpected;
}

}  // namespace evalcts::cli
