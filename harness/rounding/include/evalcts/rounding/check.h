// Is production correctly rounded? Random maps and arguments, its results beside those of the oracle, bit for
// bit.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/accuracy/samples.h>

namespace evalcts::rounding {

// A class of samples: maps of one pair of orders and one kind of data.
using accuracy::Class;
std::vector<Class> classes();

// Against the proven filter with the exact route behind it, or against the exact route alone.
enum class Oracle { kFilter, kExact };

struct Request {
  Class what;
  Oracle oracle = Oracle::kFilter;
  std::uint64_t samples = 0;  // values, at least
  std::uint32_t seed = 1;
  int jobs = 1;
  std::vector<std::string> targets;  // instruction sets, each of which evaluates everything; empty: all
};

// The first wrong value in words: the map, argument, delivery, result and right result, numbers as hex
// floats.
struct Outcome {
  std::uint64_t samples = 0;  // values compared, each for all instruction sets and deliveries
  std::uint64_t exact = 0;    // of these, decided by the exact route
  std::uint64_t wrong = 0;
  std::string first_wrong;
};

// The same samples whatever the number of jobs. Ends early when `stop` becomes true. Throws
// std::invalid_argument for an instruction set that is not here.
Outcome check(const Request& request, const std::atomic<bool>& stop);

// Every float from 0 to 1 as argument of one map of the class, seeded; one instruction set, the best or the
// only one of the request. `samples` of the request does not count.
Outcome sweep(const Request& request, const std::atomic<bool>& stop,
              const std::function<void(double done)>& progress);

}  // namespace evalcts::rounding
