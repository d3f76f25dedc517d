// Checks that `production` rounds correctly: compares its results on random maps and arguments with those of
// the oracle, bit for bit.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/accuracy/samples.h>

namespace evalcts::rounding {

// A class of samples is a pair of orders and a kind of data. classes() returns those that are checked.
using accuracy::Class;
std::vector<Class> classes();

// The oracle: the proven filter followed by the exact route, or the exact route alone.
enum class Oracle { kFilter, kExact };

struct Request {
  Class what;
  Oracle oracle = Oracle::kFilter;
  std::uint64_t samples = 0;  // the least number of values
  std::uint32_t seed = 1;
  int jobs = 1;
  std::vector<std::string> targets;  // instruction sets, each of which evaluates all samples; empty: all sets
};

// The outcome of a check. `first_wrong` describes the first wrong value: map, argument, delivery, expected
// value and result, with numbers as hexadecimal floats.
struct Outcome {
  std::uint64_t samples = 0;  // values compared, each for all instruction sets and deliveries
  std::uint64_t exact = 0;    // part of `samples` that the exact route decided
  std::uint64_t wrong = 0;
  std::string first_wrong;
};

// Checks random samples of the class. The samples do not depend on the number of jobs. Ends early when `stop`
// becomes true. Throws std::invalid_argument if the machine does not support an instruction set.
Outcome check(const Request& request, const std::atomic<bool>& stop);

// Checks one random curve of the class at every float from 0 to 1, on the first instruction set of the
// request or, if it names none, on the best one. Ignores `samples` of the request. Calls `progress` with the
// fraction that is done, from any thread.
Outcome sweep(const Request& request, const std::atomic<bool>& stop,
              const std::function<void(double done)>& progress);

}  // namespace evalcts::rounding
