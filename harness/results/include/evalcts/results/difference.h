// The identity of a difference: what was observed, where, and how it differs from the specification. It stays
// the same while a program is reduced, so that a reduction cannot slip to another bug.
#pragma once

#include <optional>
#include <string>

namespace evalcts {

struct Difference {
  // Kinds of observations other than attributes of vertices ("position", "color", "normal", "texture
  // coordinate").
  static constexpr const char* kAnswer = "answer";      // of a query
  static constexpr const char* kError = "error";        // an answer of GetError
  static constexpr const char* kVertices = "vertices";  // their number, or how they form primitives
  static constexpr const char* kOrder = "order";        // of the points, lines or quads of a mesh
  static constexpr const char* kCrash = "crash";
  static constexpr const char* kHang = "hang";
  // Places of attributes: what has to supply the value.
  static constexpr const char* kMap = "map";
  static constexpr const char* kAutomaticNormal = "AUTO_NORMAL";
  static constexpr const char* kEvaluatedVertex = "evaluated vertex";
  static constexpr const char* kExplicitVertex = "explicit vertex";
  // The relation of an answer that is due to be the largest or smallest integer.
  static constexpr const char* kSaturated = "saturated";

  std::string kind;  // empty: what was observed is not a difference of one program
  // For errors and answers: the stem of the command, and the broken rule or what is asked for, "Map stride
  // too small" or "GetMap COEFF".
  std::string place;
  std::string relation;  // "missing GL_INVALID_VALUE", "more" vertices, a value that is "near" or "far"

  bool operator==(const Difference&) const = default;
  // Returns true for crashes and hangs.
  bool is_death() const { return kind == kCrash || kind == kHang; }
  // Returns true if all parts that both have agree. A display list hides which of its commands raises an
  // error, and not every rule and relation can be named.
  bool is_like(const Difference& other) const;
  // Returns this difference with the parts of the other one in place of those that are missing.
  Difference completed_by(const Difference& other) const;
  std::string text() const;  // "answer; GetMap COEFF; far"
};

// Inverse of text(). Returns none if the text is not a difference.
std::optional<Difference> parse_difference(const std::string& text);

// Returns the kind of the observation that Failure::what names: "position" for "position.x of vertex 3",
// "vertices" for "number of vertices", "error" for "glGetError", "answer" for "glGetMapfv". What stands in
// front of ": " does not count. Returns an empty text for other observations.
std::string kind_of(const std::string& what);

// Returns the relation of a captured number to the expected interval: "near" if it is at most 0.01 away, or
// 1 % of a larger number; otherwise "far". The relation of NaN is "not a number".
std::string relation_of(double captured, double lowest, double highest);
// Returns the relation of two error codes: "missing GL_INVALID_VALUE", "spurious GL_INVALID_VALUE" or
// "GL_INVALID_VALUE instead of GL_INVALID_ENUM".
std::string relation_of_errors(const std::string& captured, const std::string& expected);

}  // namespace evalcts
