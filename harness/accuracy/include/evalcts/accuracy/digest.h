// One line that stands for very many results.
#pragma once

#include <atomic>
#include <cstdint>

#include <evalcts/accuracy/stream.h>

namespace evalcts::accuracy {

// Returns 64 bits that look like random ones: the finalizer of splitmix64 (Steele, Lea, Flood, "Fast
// splittable pseudorandom number generators", 2014).
std::uint64_t mixed(std::uint64_t x);

struct DigestRequest {
  std::uint64_t values = 0;
  std::uint32_t seed = 1;
  int threads = 1;  // of implementations that have streams for threads
};

// The sum, modulo 2^64, of a hash of the number and the bits of each of the first so many results on random
// maps: curves and surfaces of all targets, of orders to 30, with data of all kinds; arguments of all kinds
// in and around the domain. Depends on values, seed and results alone. Throws NotObservable, CannotStart.
// Means nothing once `stop` has become true.
std::uint64_t digest(const StreamSource& source, const DigestRequest& request, const std::atomic<bool>& stop);

}  // namespace evalcts::accuracy
