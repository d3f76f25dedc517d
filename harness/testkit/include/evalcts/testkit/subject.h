// Defines the subject of all tests of a process, and the objects that the tests share.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include <evalcts/backends/implementation.h>
#include <evalcts/backends/reused_context.h>
#include <evalcts/capture/capture.h>
#include <evalcts/gl/case.h>
#include <evalcts/results/depth.h>
#include <evalcts/testkit/topologies.h>

namespace evalcts {

class Reproduction;

struct Subject {
  Implementation* implementation = nullptr;
  // True if all cases share a context, whose state is restored in between, and what does not pass runs again
  // in fresh contexts, which decide.
  bool is_warm = false;
  // For tests in fresh contexts: the warm context, where the controls of failing cases may run; may be null.
  WarmContext* warm = nullptr;
  ImplementationInfo info;
  Captures* captures = nullptr;
  Depth depth = Depth::kFull;
  std::uint32_t seed = 1;
  std::set<std::string> omitted_calls;               // texts of gl::call_text(), see Test::append_optional
  std::map<std::string, std::string> readings;       // the readings that the user chose, by ambiguous passage
  std::function<void(const gl::Case&)> before_case;  // called before each case; may be empty
  Reproduction* reproduction = nullptr;              // set if the first failure is written as a C program
  std::shared_ptr<Topologies> topologies = std::make_shared<Topologies>();
};

}  // namespace evalcts
