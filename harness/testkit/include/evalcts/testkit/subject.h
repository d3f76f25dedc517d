// The subject of all tests of a process, and the objects that they share.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include <evalcts/backends/implementation.h>
#include <evalcts/capture/capture.h>
#include <evalcts/gl/case.h>
#include <evalcts/results/depth.h>
#include <evalcts/testkit/topologies.h>

namespace evalcts {

class Reproduction;

struct Subject {
  Implementation* implementation = nullptr;
  ImplementationInfo info;
  Captures* captures = nullptr;
  Depth depth = Depth::kFull;
  std::uint32_t seed = 1;
  std::set<std::string> crashing_calls;              // as gl::call_text writes them, see append_optional
  std::map<std::string, std::string> readings;       // of ambiguous text that are asked for, by its name
  std::function<void(const gl::Case&)> before_case;  // may be empty
  Reproduction* reproduction = nullptr;              // null unless a C program of the first failure is wanted
  std::shared_ptr<Topologies> topologies = std::make_shared<Topologies>();
};

}  // namespace evalcts
