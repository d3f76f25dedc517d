// A digest: one number that identifies the results of very many evaluations.
#pragma once

#include <atomic>
#include <cstdint>

#include <evalcts/accuracy/stream.h>

namespace evalcts::accuracy {

// Returns a 64-bit hash of x by the finalizer of splitmix64 (Steele, Lea, Flood, "Fast splittable
// pseudorandom number generators", 2014).
std::uint64_t mixed(std::uint64_t x);

struct DigestRequest {
  std::uint64_t values = 0;
  std::uint32_t seed = 1;
  int threads = 1;  // used if each thread may have its own stream
};

// Returns the sum, modulo 2^64, of a hash of the index and the bits of each of the first `values` results.
// The maps are random curves and surfaces of all targets, of orders 1 to 30 and all kinds of data; the
// arguments lie inside and near the domain. Every other map is evaluated by a stream of source.make_other
// unless that is empty. The digest depends only on `values`, `seed` and the results. It is meaningless if
// `stop` has become true. Throws NotObservable, CannotStart.
std::uint64_t digest(const StreamSource& source, const DigestRequest& request, const std::atomic<bool>& stop);

}  // namespace evalcts::accuracy
