// One polynomial of one variable, evaluated at very many arguments, with as little as possible between the
// evaluator and whoever takes the results.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "harness/implementations/implementation.h"

namespace evalcts::accuracy {

class Stream {
 public:
  virtual ~Stream() = default;
  // As many results as arguments, of which there are at most kLongest. Throws NotObservable.
  virtual void evaluate(std::span<const float> u, std::span<float> results) = 0;

  static constexpr std::size_t kLongest = 1u << 16;
};

struct StreamSource {
  ImplementationInfo info;
  // Whether each thread may have a stream of its own; otherwise one thread makes a single one and uses it.
  bool for_threads = false;
  // The polynomial over [0,1] with these control points, as a map of TEXTURE_COORD_1. Throws CannotStart,
  // NotObservable.
  std::function<std::unique_ptr<Stream>(const std::vector<double>& points)> make;
};

// Throws CannotStart: no such implementation, or none that gives results at arguments of all kinds.
StreamSource stream_source(const ImplementationOptions& options);

}  // namespace evalcts::accuracy
