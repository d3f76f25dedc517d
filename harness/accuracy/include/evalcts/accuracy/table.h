// Rows of the accuracy table: one implementation, one target, one class of maps.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/accuracy/errors.h>
#include <evalcts/accuracy/subject.h>

namespace evalcts::accuracy {

// Returns the classes of the table: curves and surfaces of several orders, with each kind of data that float
// maps can hold.
std::vector<Class> table_classes();

struct RowRequest {
  Class what;
  std::string target;
  std::uint64_t values = 0;  // the least number of values
  std::uint32_t seed = 1;
  std::optional<Domain> domain = std::nullopt;  // replaces the domain of the class
  // Replaces the segments of the class; a power of two up to 2^24.
  std::optional<int> segments = std::nullopt;
};

// Returns a map for the request, without control points.
Map map_of(const RowRequest& request);

// Returns the number of arguments per map. It is smaller for large maps, so that there are many different
// maps.
std::size_t arguments_of_a_map(const Class& what);

// Measures the errors of random maps of the class. Arguments are fractions of the domain: 15 of 16 are random
// multiples of 2^-24, the others multiples of 1/16; classes with a grid use its points. All subjects get the
// same maps and arguments. Ends early when `stop` becomes true. Throws NotObservable.
Errors measure(Subject& subject, const RowRequest& request, const std::atomic<bool>& stop);

// Evaluates the input again and returns the result. All components of the target get the polynomial of the
// input.
float replay(Subject& subject, const std::string& target, const Input& input);

// Returns the bits of the value as text: "0x3fc00000".
std::string bits(float value);

}  // namespace evalcts::accuracy
