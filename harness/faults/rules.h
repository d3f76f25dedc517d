// Defines faults, variations and repairs as data. A rule consists of entry points, a condition and steps:
//
//   FAULT(OrderZeroTaken, "EV-MAP1-ERR-ORDER-LOW", "Map1 takes order 0 as 1",
//         before(kMap1, kOrder == 0, set(kOrder, 1)));
//
// Conditions and steps are expressions (Value), which are evaluated during the call. A lambda that takes the
// Call is an expression, too. The condition may be omitted: before(kMap1, set(kOrder, 1)).
#pragma once

#include <unistd.h>

#include <array>
#include <bitset>
#include <concepts>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

#include <evalcts/gl/tokens.h>
#include "call.h"
#include "layer.h"

namespace evalcts::faults {

// An expression: a number, an argument, an operation on other expressions, or a step with an effect.
class Value {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T> || (std::is_enum_v<T> && std::convertible_to<T, int>)) Value(T number)
      : function_([number](Call&) { return static_cast<double>(number); }) {}
  // Makes an expression from a function of the call. If the function returns void, the value is 0.
  template <class F>
  requires(std::invocable<const F&, Call&> && !std::derived_from<F, Value>) Value(F function) {
    if constexpr (std::is_void_v<std::invoke_result_t<const F&, Call&>>) {
      function_ = [function](Call& call) {
        function(call);
        return 0.0;
      };
    } else {
      function_ = [function](Call& call) { return static_cast<double>(function(call)); };
    }
  }
  double operator()(Call& call) const { return function_(call); }
  // True if the value is not 0.
  bool holds(Call& call) const { return function_(call) != 0; }

 private:
  std::function<double(Call&)> function_;
};

// An expression that can be assigned to.
class Place : public Value {
 public:
  Place(Value value, std::function<void(Call&, double)> assign)
      : Value(std::move(value)), assign_(std::move(assign)) {}
  void assign(Call& call, double value) const { assign_(call, value); }

 private:
  std::function<void(Call&, double)> assign_;
};

// --- Arguments. For Map2, MapGrid2 and EvalMesh2, the names without V or J stand for the arguments of u. ---

Place argument(char letter);
inline const Place kTarget = argument('t'), kU1 = argument('a'), kU2 = argument('b'), kStride = argument('s'),
                   kOrder = argument('o'), kV1 = argument('c'), kV2 = argument('d'), kVStride = argument('w'),
                   kVOrder = argument('p'), kSegments = argument('g'), kVSegments = argument('h'),
                   kMode = argument('m'), kI1 = argument('i'), kI2 = argument('k'), kJ1 = argument('j'),
                   kJ2 = argument('l'), kQuery = argument('q'), kSize = argument('n'), kName = argument('e'),
                   kU = argument('u'), kV = argument('v'), kI = argument('i'), kJ = argument('j');
// The arguments of any other command.
inline const Place kFirst = argument('0'), kSecond = argument('1'), kThird = argument('2'),
                   kFourth = argument('3'), kFifth = argument('4');
inline const Place kResult{[](Call& c) { return c.result; }, [](Call& c, double x) { c.result = x; }};
// The value of the (last) pointer argument.
inline const Value kAddress{[](Call& c) { return reinterpret_cast<std::uintptr_t>(c.pointer); }};
// True if the arguments of Map1 or Map2 are legal.
inline const Value kIsLegal{[](Call& c) { return c.is_legal(); }};
// Number of values of a control point of the target.
inline const Value kComponents{[](Call& c) { return gl::components_of(c.target()); }};

// --- Memory. All of it is 0 in a fresh context. ------------------------------------------------------------

// A number that a rule can store under a key.
Place remembered(Value key);
inline const Place kFlag = remembered(-1), kCount = remembered(-2), kNumber = remembered(-3);
// Counters of loops.
inline const Place kRow = remembered(-4), kColumn = remembered(-5);
// A list of numbers that lambdas can store.
inline std::vector<double>& remembered_list() { return running_layer().list; }
// Number i of an array that rules can store, and the first `count` numbers of this array.
inline Place kept(int i) { return remembered(-100 - i); }
std::vector<Value> kept_values(int count);
// Steps that set kept(0), kept(1), ... to the values, or to the four values that GetDoublev returns.
Value keep(std::initializer_list<Value> values);
Value keep_state(GLenum pname);

// --- Operations --------------------------------------------------------------------------------------------

// Return f(a) and f(a, b).
template <class F>
Value unary(Value a, F f) {
  return [=](Call& c) { return f(a(c)); };
}
template <class F>
Value binary(Value a, Value b, F f) {
  return [=](Call& c) {
    const double first = a(c);
    return f(first, b(c));
  };
}
inline Value operator+(Value a, Value b) { return binary(a, b, std::plus()); }
inline Value operator-(Value a, Value b) { return binary(a, b, std::minus()); }
inline Value operator-(Value a) { return unary(a, std::negate()); }
inline Value operator*(Value a, Value b) { return binary(a, b, std::multiplies()); }
inline Value operator/(Value a, Value b) { return binary(a, b, std::divides()); }
Value operator%(Value a, Value b);
Value operator&(Value a, Value b);
inline Value operator==(Value a, Value b) { return binary(a, b, std::equal_to()); }
inline Value operator!=(Value a, Value b) { return binary(a, b, std::not_equal_to()); }
inline Value operator<(Value a, Value b) { return binary(a, b, std::less()); }
inline Value operator>(Value a, Value b) { return binary(a, b, std::greater()); }
inline Value operator<=(Value a, Value b) { return binary(a, b, std::less_equal()); }
inline Value operator>=(Value a, Value b) { return binary(a, b, std::greater_equal()); }
Value operator&&(Value a, Value b);
Value operator||(Value a, Value b);
Value operator!(Value a);
Value min(Value a, Value b);
Value max(Value a, Value b);
inline Value clamp(Value a, Value low, Value high) { return min(max(a, low), high); }
Value abs(Value a);
Value round(Value a);
Value is_negative_zero(Value a);
Value is_subnormal(Value a);                // in single precision
Value next_float(Value a, double towards);  // the adjacent float in that direction
Value in_bits(Value a, int bits);           // the low bits, as a signed number
Value with_precision(Value a, int bits);    // rounded to a significand of that length
double with_precision(double a, int bits);
Value to_float(Value a);
Value choose(Value condition, Value yes, Value no);
Value swapped(Value token, GLenum one, GLenum other);  // exchanges the two tokens, keeps other values
Value element(Value i);  // element i at the pointer argument: answers of queries, control points

// --- State -------------------------------------------------------------------------------------------------

// State that is known from the calls that reach the layer (see TrackedState), and available everywhere.
inline TrackedState& tracked() { return running_layer().tracked; }
inline const Value kInside{[](Call&) { return tracked().is_inside(); }};
inline const Value kOpenMode{[](Call&) { return tracked().primitive; }};
inline const Value kUnit{[](Call&) { return tracked().unit; }};           // set by the last ActiveTexture
inline const Value kListMode{[](Call&) { return tracked().list_mode; }};  // 0 if no list is open
inline const Value kCompiling{[](Call&) { return tracked().list_mode == GL_COMPILE; }};
inline const Value kThread{[](Call&) { return gettid(); }};      // getpid() is the first thread
inline const Value kKind{[](Call&) { return tracked().kind; }};  // the argument of ContextOfKindEVALCTS
// The argument of the PushAttrib that the next PopAttrib undoes.
inline const Value kLevelMask{[](Call&) { return tracked().masks.empty() ? 0 : tracked().masks.back(); }};
inline const Value kLevel{[](Call&) { return tracked().masks.size(); }};  // depth of the attribute stack
Value noted_on(Value cap);
Value maps_vertices(Value dimension);
Value has_buffer(Value target);

// State that is queried from the GL. Must not be used between Begin and End.
Value enabled(Value cap);
Value evaluates();                         // true if a vertex map of either dimension is enabled
Value state(Value pname, int i = 0);       // element i of the answer of GetIntegerv
Value real_state(Value pname, int i = 0);  // element i of the answer of GetDoublev
// Argument i of the MapGrid1 or MapGrid2 that sets the current grid.
inline Value grid1(int i) {
  return i == 0 ? state(GL_MAP1_GRID_SEGMENTS) : real_state(GL_MAP1_GRID_DOMAIN, i - 1);
}
Value grid2(int i);

inline Value is_map1(Value name) { return name >= GL_MAP1_COLOR_4 && name <= GL_MAP1_VERTEX_4; }
inline Value is_map2(Value name) { return name >= GL_MAP2_COLOR_4 && name <= GL_MAP2_VERTEX_4; }
inline Value is_map(Value name) { return is_map1(name) || is_map2(name); }
Value is_texture_map(Value token);

// --- Steps -------------------------------------------------------------------------------------------------

// One step or several: {set(kI1, 0), set(kI2, 1)}.
struct Steps {
  template <class T>
  requires std::convertible_to<T, Value> Steps(T one) : all(std::move(one)) {}
  Steps(std::initializer_list<Value> steps);
  operator Value() const { return all; }
  Value all;
};
inline Value sequence(std::initializer_list<Value> steps) { return Steps(steps); }
inline Value when(Value condition, Steps steps) { return choose(condition, steps, 0); }
Value set(Place place, Value value);
Value put(Value i, Value value);          // sets element i at the pointer argument
Value exchange(Value i, Value j);         // exchanges two elements at the pointer argument
Value answer(std::vector<Value> values);  // sets the first elements at the pointer argument
Value swap(Place one, Place other);
// Raises an error outside of primitives. While a list is compiled, INVALID_ENUM and INVALID_VALUE are
// compiled into it; INVALID_OPERATION is raised at once.
Value error(GLenum kind);
// Raises INVALID_OPERATION between Begin and End.
Value error_inside();
// Raises an error outside of primitives, at once even while a list is compiled.
Value error_now(GLenum kind);
// Replaces a pending error of the kind by another error, as error_now() does.
Value replace_error(GLenum kind, GLenum by);
Value call(gl::EntryPoint entry, std::vector<Value> arguments = {});  // calls the unmodified command
inline Value enable(Value cap) { return call(Enable, {cap}); }
inline Value disable(Value cap) { return call(Disable, {cap}); }
// Enables or disables.
inline Value switch_to(Value cap, Value on) { return choose(on, enable(cap), disable(cap)); }
// Takes the steps with the counter at first, first + step, ... up to last, or down to last if the
// step is negative.
Value loop(Place counter, Value first, Value last, Steps steps, int step = 1);
Value primitive(Value mode, Steps steps);               // takes the steps between Begin and End
inline const Value kGo{[](Call& call) { call.go(); }};  // continues the call with the current arguments
// Delay calls. The memory that their pointers refer to is not copied.
Value hold();     // keeps a copy of the call
Value release();  // executes the kept calls
Value drop();     // discards the kept calls
// Change the control points of a legal call of Map1 or Map2. Other calls stay unchanged.
Value change_points(void (*change)(Net& net));
Value change_points(void (*change)(Net& net, Call& call));
Value change_values(double (*change)(double value));
Value swap_components(int one, int other);
// Replaces the control points by those of the previous call with this step, if the condition holds and the
// number of points is the same.
Value repeat_points(Value condition);
// Defines a map over [0, 1] with one or more control points. Those of a surface lie along v.
Value define(GLenum target, std::initializer_list<double> points);
// Changes the current definition of a map. take_u(), a possible `change`, sets its domain of u to that
// of the call.
Value redefine(Value target, void (*change)(Map& map, Call& call));
inline void take_u(Map& map, Call& call) {
  map.u1 = call.argument('a');
  map.u2 = call.argument('b');
}
// Number of values that GetMap, GetnMap, or Get of a grid returns.
Value answers();
// For these commands: replaces each returned value by change(exact value, returned value).
Value change_answers(double (*change)(double exact, double answered));

// --- State that can be saved, outside of primitives --------------------------------------------------------

using Restore = std::function<void()>;
// Saves state and returns a function that restores it.
using State = std::function<Restore()>;
State enable_of(GLenum cap);
State map_of(GLenum target);
// The state that a command sets. `arguments` are expressions that query the arguments of the command.
State setting(gl::EntryPoint command, std::initializer_list<Value> arguments);
inline State grid1_state() { return setting(MapGrid1d, {grid1(0), grid1(1), grid1(2)}); }
State grid2_state();
State current(gl::EntryPoint command, GLenum pname);  // for commands such as Color4d

// --- Rules -------------------------------------------------------------------------------------------------

struct Entries {
  std::bitset<gl::kEntryPointCount> all;
  Entries() = default;
  Entries(gl::EntryPoint one) { all.set(static_cast<std::size_t>(one)); }
  bool contain(gl::EntryPoint entry) const { return all.test(static_cast<std::size_t>(entry)); }
};
inline Entries operator|(Entries one, const Entries& other) {
  one.all |= other.all;
  return one;
}
inline Entries operator|(gl::EntryPoint one, gl::EntryPoint other) { return Entries(one) | Entries(other); }
inline const Entries kMap1 = Map1f | Map1d, kMap2 = Map2f | Map2d, kMaps = kMap1 | kMap2,
                     kMapGrid1 = MapGrid1f | MapGrid1d, kMapGrid2 = MapGrid2f | MapGrid2d,
                     kMapGrids = kMapGrid1 | kMapGrid2,
                     kEvalCoord1 = EvalCoord1f | EvalCoord1d | EvalCoord1fv | EvalCoord1dv,
                     kEvalCoord2 = EvalCoord2f | EvalCoord2d | EvalCoord2fv | EvalCoord2dv,
                     kEvalCoords = kEvalCoord1 | kEvalCoord2, kPoints1 = kEvalCoord1 | EvalPoint1,
                     kPoints2 = kEvalCoord2 | EvalPoint2, kPoints = kPoints1 | kPoints2,
                     kMeshes = EvalMesh1 | EvalMesh2, kGetMap = GetMapfv | GetMapdv | Entries(GetMapiv),
                     kGetnMap = GetnMapfv | GetnMapdv | Entries(GetnMapiv),
                     kGet = GetBooleanv | GetIntegerv | Entries(GetFloatv) | GetDoublev,
                     kSwitches = Enable | Disable,
                     kOtherContexts = OtherContextEVALCTS | SharingContextEVALCTS;

using Primitives = std::vector<ObservedPrimitive>;

struct Rule {
  enum class Kind {
    kInstead,   // the step replaces the call
    kProvided,  // the step replaces the call of a command that the implementation may lack
    kLate,      // the step follows the call
    kMissing,   // the commands are missing
    kInitial,   // the step is taken in a fresh context
    kOneState,  // all contexts have one state
  };
  Entries entries;
  Value condition, step;
  Kind kind = Kind::kInstead;
  std::function<void(Primitives&)> emitted{};  // changes the output if the condition holds at that time
};
// One rule or several.
struct Rules {
  Rules(Rule one) : all{std::move(one)} {}
  Rules(std::initializer_list<Rules> several);
  std::vector<Rule> all;
};
// Take the steps before the call, after the call, or instead of the call, if the condition holds.
Rule before(const Entries& entries, Value condition, Steps steps);
inline Rule before(const Entries& entries, Steps steps) { return before(entries, true, steps); }
Rule after(const Entries& entries, Value condition, Steps steps);
inline Rule after(const Entries& entries, Steps steps) { return after(entries, true, steps); }
inline Rule instead(const Entries& entries, Value condition, Steps steps) {
  return {entries, condition, steps};
}
inline Rule instead(const Entries& entries, Steps steps) { return instead(entries, true, steps); }
// Like instead(), also if the implementation lacks the command.
inline Rule provide(const Entries& entries, Steps steps) {
  return {entries, true, steps, Rule::Kind::kProvided};
}
inline Rule skip(const Entries& entries, Value condition) { return {entries, condition, 0}; }
// Removes the commands from the implementation.
inline Rule missing(const Entries& entries) { return {entries, true, 0, Rule::Kind::kMissing}; }
// Gives all contexts one state.
inline Rule one_state() { return {{}, true, 0, Rule::Kind::kOneState}; }
// Takes the steps in a fresh context.
inline Rule initially(Steps steps) { return {{}, true, steps, Rule::Kind::kInitial}; }
// Takes the first steps before the call and the last steps after it. For Begin, the last steps
// follow the End.
Rules around(const Entries& entries, Value condition, Steps first, Steps last);
// Disable or enable the capability during the call.
Rules without(const Entries& entries, Value condition, GLenum cap);
Rules with(const Entries& entries, Value condition, GLenum cap);
// Takes the steps before the call and restores the state after it.
Rules keeping(const Entries& entries, Value condition, const State& state, Steps steps = 0);
// Makes texture unit 0 active during the call.
Rules on_unit_0(const Entries& entries, Value condition);
// After Enable and Disable of any map or of AUTO_NORMAL, `cap` is disabled unless the condition holds.
Rules only_if(GLenum cap, Value condition);
// Exchanges two tokens in all commands that take a map target.
Rules swap_targets(GLenum one, GLenum other);
// PopAttrib does not restore the state although it must, or restores the state although it must not, if the
// condition (usually on kLevelMask) holds. The rules do not apply in lists.
Rules not_restored(const State& state, Value condition);
Rules restored(const State& state, Value condition);
// Changes the output if the condition holds.
Rules change_output(Value condition, std::function<void(Primitives&)> change);
Rules change_all_vertices(std::function<void(ObservedVertex&)> change);
// Change the output of a context that has evaluated: each primitive, each vertex, or each vertex together
// with the previous vertex of its primitive, from the last vertex down to index `from`.
Rules change_primitives(std::function<void(ObservedPrimitive&)> change);
Rules change_vertices(void (*change)(ObservedVertex& vertex));
Rules change_pairs(void (*change)(ObservedVertex& now, const ObservedVertex& before), std::size_t from = 1);

template <std::size_t kSize>
void scale(std::array<float, kSize>& vector, float factor) {
  for (float& x : vector) x *= factor;
}

// Define a change as a row. The name of its implementation is that of the closest kImplementation. A quality
// fault has to be detected by tests of level quality.
inline constexpr std::string_view kImplementation = "production";
#define EVALCTS_CHANGE(name, kind, level, requirements, what, ...)               \
  static const ::evalcts::faults::Registration name##_registration {             \
    {                                                                            \
#name, kind, kImplementation, ::evalcts::Level::level, requirements, what, \
          [] { return Rules{__VA_ARGS__}; }                                      \
    }                                                                            \
  }
#define FAULT(name, requirements, what, ...) \
  EVALCTS_CHANGE(name, kFault, kMust, requirements, what, __VA_ARGS__)
#define QUALITY_FAULT(name, requirements, what, ...) \
  EVALCTS_CHANGE(name, kFault, kQuality, requirements, what, __VA_ARGS__)
#define VARIATION(name, violated, what, ...) \
  EVALCTS_CHANGE(name, kVariation, kMust, violated, what, __VA_ARGS__)

}  // namespace evalcts::faults
