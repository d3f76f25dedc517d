// The hash function FNV-1a. Hashes of names give each test a seed that is independent of other tests, and
// hashes of mismatches make signatures.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

namespace evalcts {

// Returns the hash, of 32 or 64 bits. To hash a text in parts, pass the hash of the parts so far as `hash`.
template <class Bits>
constexpr Bits fnv1a(std::string_view text,
                     Bits hash = static_cast<Bits>(sizeof(Bits) == 4 ? 2166136261u : 14695981039346656037u)) {
  static_assert(std::is_same_v<Bits, std::uint32_t> || std::is_same_v<Bits, std::uint64_t>);
  constexpr auto kPrime = static_cast<Bits>(sizeof(Bits) == 4 ? 16777619u : 1099511628211u);
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  return hash;
}

}  // namespace evalcts
