// Topologies of captures: each takes primitives apart in a way of its own, which is learned from explicit
// vertices and kept, because it is always the same.
#pragma once

#include <map>
#include <string>
#include <utility>

#include <evalcts/backends/implementation.h>
#include <evalcts/capture/capture.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/judge/topology.h>

namespace evalcts {

class Topologies {
 public:
  // Returns how `capture` shows the primitives of the prediction. Throws NotObservable if it does not show
  // them with explicit vertices, either.
  Topology find(const Prediction& prediction, const Capture& capture, Implementation& implementation);

 private:
  std::map<std::pair<std::string, Shape>, Topology> known_;  // by the capture's name and what is drawn
};

}  // namespace evalcts
