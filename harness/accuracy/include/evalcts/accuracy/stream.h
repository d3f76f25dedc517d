// Streams: one map evaluated at very many values of one argument, with as little overhead as possible.
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
  // Evaluates the map at at most kLongest arguments. `results` receives all components of the first argument,
  // then those of the next. Throws NotObservable.
  virtual void evaluate(std::span<const float> u, std::span<float> results) = 0;

  static constexpr std::size_t kLongest = 1u << 16;
};

struct StreamSource {
  ImplementationInfo info;
  // True if each thread may have its own stream. Otherwise one thread must make and use a single stream.
  bool for_threads = false;
  // Throws CannotStart, NotObservable.
  std::function<std::unique_ptr<Stream>(const SweptMap& map)> make;
  // Makes streams with the same results by other calls; empty if there are none.
  std::function<std::unique_ptr<Stream>(const SweptMap& map)> make_other;
};

// Throws CannotStart if there is no such implementation or it cannot evaluate every argument.
StreamSource stream_source(const ImplementationOptions& options);

// Returns streams of libglevaluator on an instruction set, by batches and by patches; an empty name selects
// the best one. Throws CannotStart.
StreamSource production_source(const std::string& instruction_set);

}  // namespace evalcts::accuracy
