// One map, evaluated at very many values of one argument, with as little as possible between the evaluator
// and whoever takes the results.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <evalcts/accuracy/swept_map.h>
#include <evalcts/backends/implementation.h>

namespace evalcts::accuracy {

class Stream {
 public:
  virtual ~Stream() = default;
  // All components of the first argument, then those of the next; at most kLongest arguments. Throws
  // NotObservable.
  virtual void evaluate(std::span<const float> u, std::span<float> results) = 0;

  static constexpr std::size_t kLongest = 1u << 16;
};

struct StreamSource {
  ImplementationInfo info;
  // True if each thread may have a stream of its own; otherwise one thread makes a single one and uses it.
  bool for_threads = false;
  // Throws CannotStart, NotObservable.
  std::function<std::unique_ptr<Stream>(const SweptMap& map)> make;
};

// Throws CannotStart: no such implementation, or none that gives results at arguments of all kinds.
StreamSource stream_source(const ImplementationOptions& options);

// libglevaluator on one of its instruction sets; empty: the best one. Throws CannotStart.
StreamSource production_source(const std::string& instruction_set);

}  // namespace evalcts::accuracy
