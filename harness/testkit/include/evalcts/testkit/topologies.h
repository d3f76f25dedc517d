// Determines the topologies of captures. Each capture splits primitives in its own way, which is learned from
// explicit vertices. The result is kept, because it is always the same.
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
  // Returns the topology in which `capture` shows the primitives of the prediction. Throws NotObservable if
  // the capture does not show these primitives with explicit vertices, either.
  Topology find(const Prediction& prediction, const Capture& capture, Implementation& implementation);

 private:
  std::map<std::pair<std::string, Shape>, Topology> known_;  // by the name of the capture and the primitives
};

}  // namespace evalcts
