// Tasks of the program glevaluator_rounding, and their results as JSON.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace rounding {

struct Task {
  std::string kind;                  // "check", "sweep" or "digest"
  std::uint64_t values = 0;          // of each class (check), or of all maps (digest)
  float from = 0, to = 1;            // interval of a sweep
  std::string filter = "*";          // pattern of the classes
  std::vector<std::string> targets;  // instruction sets
  std::uint32_t seed = 1;
  std::uint64_t shard = 1, shards = 1;  // items shard - 1, shard - 1 + shards, ... of each class

  bool operator==(const Task&) const = default;
};

// The result of some items of a class. Results of different items can be added in any order.
struct Result {
  std::uint64_t values = 0, wrong = 0;
  std::uint64_t digest = 0;  // sum of a hash of the index and the bits of each value, modulo 2^64
  std::uint64_t first_item = UINT64_MAX;
  std::string first_wrong;  // the first wrong value of the first item that has one

  void add(const Result& other) {
    values += other.values;
    wrong += other.wrong;
    digest += other.digest;
    if (other.first_item >= first_item) return;
    first_item = other.first_item;
    first_wrong = other.first_wrong;
  }
};

// An error of the user; the message says what to do.
struct WrongUse : std::runtime_error {
  using std::runtime_error::runtime_error;
};

nlohmann::json to_json(const Task& task, const std::map<std::string, Result>& results);

// Returns the result of the whole task from the results of all of its shards. Throws WrongUse.
nlohmann::json merged(const std::vector<std::string>& files);

// Prints the result, and returns the exit code.
int print(const nlohmann::json& result);

}  // namespace rounding
