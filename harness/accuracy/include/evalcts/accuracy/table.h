// Rows of the accuracy table: one implementation, one target, one class of maps.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/accuracy/errors.h>
#include <evalcts/accuracy/subject.h>

namespace evalcts::accuracy {

// Curves and surfaces of several orders with each kind of data that float maps can hold.
std::vector<Class> table_classes();

struct RowRequest {
  Class what;
  std::string target;
  std::uint64_t values = 0;  // at least
  std::uint32_t seed = 1;
  std::optional<Domain> domain = std::nullopt;  // in the place of that of the class
};

// A map of the class without control points, over the domain of the request.
Map map_of(const RowRequest& request);

// So many at a time; fewer of large maps, so that there are many of them.
std::size_t arguments_of_a_map(const Class& what);

// Random maps of the class over [0,1]; fifteen of sixteen arguments are multiples of 2^-24 from 0 to 1, all
// equally likely, the others multiples of 1/16. The same maps and arguments for every subject. Throws
// NotObservable. Ends early when `stop` becomes true.
Errors measure(Subject& subject, const RowRequest& request, const std::atomic<bool>& stop);

// One result of the subject, for a target of as many components as it likes: all of them are the same.
float replay(Subject& subject, const std::string& target, const Input& input);

// The bits of the value: "0x3fc00000".
std::string bits(float value);

}  // namespace evalcts::accuracy
