// Reads the calls of a trace of apitrace, in the order of their returns. The format is that of versions 4 to
// 6 of lib/trace/trace_format.hpp of apitrace: blocks that Snappy has compressed, and in them events, whose
// names are written at their first use only.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace evalcts::lab {

// Thrown if a file is not a trace that can be read. what() says what to do.
struct BadTrace : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns true if the file begins like a trace of apitrace.
bool is_trace(const std::filesystem::path& file);

struct TraceValue {
  enum class Kind {
    kNull,
    kInteger,  // also a boolean, an enumerant or a mask of bits
    kReal,
    kBytes,  // memory without a type
    kArray,
    kPointer,  // an address, in `integer`
    kOther     // a string or a structure
  };
  Kind kind = Kind::kNull;
  std::int64_t integer = 0;
  double real = 0;
  std::string bytes = {};
  std::vector<TraceValue> elements = {};
};

struct TraceCall {
  std::uint64_t number = 0;
  std::uint32_t thread = 0;
  std::string name;
  std::vector<TraceValue> arguments;
  std::optional<TraceValue> result;
  bool is_fake = false;  // made by apitrace, not by the program
};

class TraceReader {
 public:
  // Throws BadTrace.
  explicit TraceReader(const std::filesystem::path& file);

  // The path of the traced program; empty if the trace does not name it.
  const std::string& program() const { return program_; }
  // Returns the next call; nothing at the end of the file. Calls that did not return come last. Throws
  // BadTrace if the file is damaged.
  std::optional<TraceCall> next();
  // True if the file ends within a block or within the description of a call.
  bool is_cut() const { return is_cut_; }

 private:
  struct EndOfFile {};
  bool read_block();
  int byte();
  std::uint64_t number();
  std::int64_t signed_number();
  std::string text();
  template <class T>
  T real();
  TraceValue value(int depth = 0);
  void read_details(TraceCall& call);
  void skip_frame_of_stack();
  // Returns true at the first use of a signature.
  static bool is_new(std::set<std::uint64_t>& seen, std::uint64_t signature) {
    return seen.insert(signature).second;
  }

  std::ifstream stream_;
  std::uint64_t left_ = 0;  // bytes of the file behind the block
  std::string block_;
  std::size_t place_ = 0;  // in the block
  std::string program_;
  std::vector<std::string> functions_;  // names by signature
  std::vector<std::size_t> members_;    // numbers of members of structures by signature
  std::set<std::uint64_t> enums_, masks_, frames_;
  std::uint64_t calls_ = 0;
  std::size_t elements_ = 0;       // of the arrays and structures of a call so far
  std::deque<TraceCall> pending_;  // calls that have not returned
  bool is_cut_ = false;
};

}  // namespace evalcts::lab
