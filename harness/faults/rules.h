// Faults as data. A rule names entry points, a condition and the steps that are wrong:
//
//   EVALCTS_RULES(OrderZeroTaken, production, must, "EV-MAP1-ERR-ORDER-LOW", "Map1 takes order 0 as 1",
//                 before(kMap1, kOrder == 0, set(kOrder, 1)));
//
// Conditions and steps are expressions that an interpreter evaluates during the call (see rules.cpp). If no
// expression fits, lambda() calls a function, and EVALCTS_FAULT sets entry points directly.
#pragma once

#include <array>
#include <initializer_list>
#include <vector>

#include "fault.h"
#include "watched.h"

namespace evalcts::faults {

using enum gl::EntryPoint;

// One call of an entry point with a rule, with its arguments as numbers.
struct Call {
  gl::EntryPoint entry{};
  std::array<double, 12> numbers{};
  void* pointer = nullptr;  // the last pointer argument
  char element = ' ';       // the type behind `pointer`: f, d, i (int) or b (boolean)
  double result = 0;
  std::size_t next = 0;         // the rules before this index have been applied
  std::vector<double> storage;  // keeps the points of set_points() alive

  // Calls the original command, or the next rule for it, with the present arguments.
  void go();
  // The argument with that letter (see the constants below).
  double& argument(char letter);
  GLenum target() { return static_cast<GLenum>(argument('t')); }
  // Elements behind the pointer.
  double read(std::size_t i) const;
  void write(std::size_t i, double value);
  // Map1 and Map2: true if the arguments are legal and the points may be read; the points without padding, v
  // fastest; other points, with the strides that they need.
  bool is_legal();
  std::vector<double> points();
  void set_points(const std::vector<double>& points);
};

using Function = double (*)(Call&);

// An expression: a number, an argument, an operation on other expressions, or a step with an effect.
struct Value {
  enum class Op : short;
  Op op;
  short a = 0, b = 0, c = 0;  // operands, as indices of kept expressions
  double number = 0;
  Function function = nullptr;

  constexpr Value(Op op_, short a_, short b_ = 0, short c_ = 0, double number_ = 0)
      : op(op_), a(a_), b(b_), c(c_), number(number_) {}
  constexpr Value(int number);
  constexpr Value(GLenum number);
  constexpr Value(double number);
  constexpr Value(bool number);
};

enum class Value::Op : short {
  number,
  argument,
  cell,
  sum,
  difference,
  product,
  quotient,
  remainder,
  bit_and,
  equal,
  less,
  both,
  either,
  negation,
  choice,
  remembered,
  element,
  function,
  set,
  put,
  exchange,
  swap,
  go,
  call,
  sequence,
  error,
  round,
  magnitude,
  result,
  is_on,
  integer,
  noted_on,
  has_vertex_map,
  is_map1,
  is_map2,
  is_legal,
  components,
  inside,
  open_mode,
  unit,
  list_mode,
  buffer,
  is_float
};

constexpr Value::Value(int n) : op(Op::number), number(n) {}
constexpr Value::Value(GLenum n) : op(Op::number), number(n) {}
constexpr Value::Value(double n) : op(Op::number), number(n) {}
constexpr Value::Value(bool n) : op(Op::number), number(n) {}

// --- Arguments. Those of Map2, MapGrid2 and EvalMesh2 have the names of one dimension for u.
// ----------------

constexpr Value argument(char letter) { return {Value::Op::argument, 0, 0, 0, static_cast<double>(letter)}; }
inline constexpr Value kTarget = argument('t'), kU1 = argument('a'), kU2 = argument('b'),
                       kStride = argument('s'), kOrder = argument('o'), kV1 = argument('c'),
                       kV2 = argument('d'), kVStride = argument('w'), kVOrder = argument('p'),
                       kSegments = argument('g'), kVSegments = argument('h'), kMode = argument('m'),
                       kI1 = argument('i'), kI2 = argument('k'), kJ1 = argument('j'), kJ2 = argument('l'),
                       kQuery = argument('q'), kSize = argument('n'), kName = argument('e'),
                       kU = argument('u'), kV = argument('v'), kI = argument('i'), kJ = argument('j');
// The arguments of any other command.
inline constexpr Value kFirst = argument('0'), kSecond = argument('1'), kThird = argument('2'),
                       kFourth = argument('3');

// --- State
// ---------------------------------------------------------------------------------------------------

inline constexpr Value kInside{Value::Op::inside, 0}, kOpenMode{Value::Op::open_mode, 0},
    kUnit{Value::Op::unit, 0}, kListMode{Value::Op::list_mode, 0}, kResult{Value::Op::result, 0},
    kIsLegal{Value::Op::is_legal, 0}, kComponents{Value::Op::components, 0}, kIsFloat{Value::Op::is_float, 0};
// What rules remember, all 0 in a fresh context.
inline constexpr Value kFlag{Value::Op::cell, 0, 0, 0, 0}, kCount{Value::Op::cell, 0, 0, 0, 1},
    kNumber{Value::Op::cell, 0, 0, 0, 2};

Value remembered(Value key);           // one number for each key
Value enabled(Value cap);              // outside primitives
Value state(Value pname);              // outside primitives
Value noted_on(Value cap);             // by the last Enable or Disable
Value maps_vertices(Value dimension);  // the same
Value is_map1(Value token);
Value is_map2(Value token);
Value is_map(Value token);
Value is_texture_map(Value token);
Value has_buffer(Value target);

// --- Operations
// ----------------------------------------------------------------------------------------------

Value operator+(Value a, Value b);
Value operator-(Value a, Value b);
Value operator-(Value a);
Value operator*(Value a, Value b);
Value operator/(Value a, Value b);
Value operator%(Value a, Value b);
Value operator&(Value a, Value b);
Value operator==(Value a, Value b);
Value operator!=(Value a, Value b);
Value operator<(Value a, Value b);
Value operator>(Value a, Value b);
Value operator<=(Value a, Value b);
Value operator>=(Value a, Value b);
Value operator&&(Value a, Value b);
Value operator||(Value a, Value b);
Value operator!(Value a);
Value min(Value a, Value b);
Value max(Value a, Value b);
Value abs(Value a);
Value round(Value a);
Value choose(Value condition, Value yes, Value no);
Value element(Value i);  // behind the pointer: the answer of a query, the control points
Value lambda(Function function);

// --- Steps
// ---------------------------------------------------------------------------------------------------

Value set(Value place, Value value);  // an argument, what is remembered, or the result
Value put(Value i, Value value);      // behind the pointer
Value exchange(Value i, Value j);     // behind the pointer
Value swap(Value one, Value other);   // two arguments
Value error(GLenum kind);             // leaves one, wherever the call is
Value call(gl::EntryPoint entry, std::initializer_list<Value> arguments = {});  // the original command
Value sequence(std::initializer_list<Value> steps);
Value when(Value condition, Value step);
inline constexpr Value kGo{Value::Op::go, 0};  // the original call, with the present arguments

// --- Rules
// ---------------------------------------------------------------------------------------------------

struct Entries {
  std::array<gl::EntryPoint, 16> all{};
  std::size_t count = 0;
  constexpr Entries(gl::EntryPoint one) : all{one}, count(1) {}
  constexpr Entries operator|(const Entries& other) const {
    Entries both = *this;
    for (std::size_t i = 0; i < other.count; ++i) both.all[both.count++] = other.all[i];
    return both;
  }
};
constexpr Entries operator|(gl::EntryPoint one, gl::EntryPoint other) {
  return Entries(one) | Entries(other);
}
inline constexpr Entries kMap1 = Map1f | Map1d, kMap2 = Map2f | Map2d, kMaps = kMap1 | kMap2,
                         kMapGrid1 = MapGrid1f | MapGrid1d, kMapGrid2 = MapGrid2f | MapGrid2d,
                         kMapGrids = kMapGrid1 | kMapGrid2,
                         kEvalCoord1 = EvalCoord1f | EvalCoord1d | EvalCoord1fv | EvalCoord1dv,
                         kEvalCoord2 = EvalCoord2f | EvalCoord2d | EvalCoord2fv | EvalCoord2dv,
                         kEvalCoords = kEvalCoord1 | kEvalCoord2, kPoints1 = kEvalCoord1 | EvalPoint1,
                         kPoints2 = kEvalCoord2 | EvalPoint2, kPoints = kPoints1 | kPoints2,
                         kMeshes = EvalMesh1 | EvalMesh2, kGetMap = GetMapfv | GetMapdv | Entries(GetMapiv),
                         kGetnMap = GetnMapfv | GetnMapdv | Entries(GetnMapiv),
                         kGet = GetBooleanv | GetIntegerv | Entries(GetFloatv) | GetDoublev,
                         kSwitches = Enable | Disable;

struct Rule {
  Entries entries;
  Value condition, step;
  bool late = false;  // the call comes first, otherwise it is replaced by the step
};
// In all of these, steps are carried out if the condition holds, and only then.
Rule before(const Entries& entries, Value condition, Value step);
Rule after(const Entries& entries, Value condition, Value step);
Rule around(const Entries& entries, Value condition, Value first, Value last);
Rule instead(const Entries& entries, Value condition, Value step);  // of the call
Rule skip(const Entries& entries, Value condition);
// The capability is off during the call.
Rule without(const Entries& entries, Value condition, GLenum cap);
// The call is made with unit 0 active.
Rule on_unit_0(const Entries& entries, Value condition);

void apply(Injection& in, std::initializer_list<Rule> rules);
// To be called before a fault is injected.
void forget_rules();

#define EVALCTS_RULES(name, implementation, level, requirements, what, ...)   \
  static const ::evalcts::faults::FaultRegistration name##_registration {     \
    {                                                                         \
#name, #implementation, ::evalcts::Level::level, requirements, what,    \
          [](::evalcts::faults::Injection & in) { apply(in, {__VA_ARGS__}); } \
    }                                                                         \
  }

}  // namespace evalcts::faults
