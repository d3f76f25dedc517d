#include "rules.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "map_calls.h"

namespace evalcts::faults {
namespace {

using Op = Value::Op;

std::vector<Value> kept{Value(0)};  // the operands of expressions; 0 is none
std::vector<Rule> active;
std::map<double, double> keyed_memory;

short keep(Value value) {
  kept.push_back(value);
  return static_cast<short>(kept.size() - 1);
}
Value unary(Op op, Value a) { return {op, keep(a)}; }
Value binary(Op op, Value a, Value b) {
  const short first = keep(a);
  return {op, first, keep(b)};
}

double evaluate(Value value, Call& call);

// --- Calls -------------------------------------------------------------------------------------------------

template <class T>
char element_of() {
  using Element = std::remove_const_t<std::remove_pointer_t<T>>;
  if constexpr (std::is_same_v<Element, GLfloat>) return 'f';
  if constexpr (std::is_same_v<Element, GLdouble>) return 'd';
  if constexpr (std::is_same_v<Element, GLboolean>) return 'b';
  return 'i';
}

constexpr bool is_coordinate_vector(gl::EntryPoint entry) {
  return entry == EvalCoord1fv || entry == EvalCoord1dv || entry == EvalCoord2fv || entry == EvalCoord2dv;
}

template <class T>
void take(Call& call, std::size_t i, T value) {
  if constexpr (std::is_arithmetic_v<T>) {
    call.numbers[i] = static_cast<double>(value);
  } else if constexpr (std::is_pointer_v<T>) {
    call.pointer = (void*)value;
    call.element = element_of<T>();
  }
}
template <class T>
T give(Call& call, std::size_t i) {
  if constexpr (std::is_arithmetic_v<T>) return static_cast<T>(call.numbers[i]);
  if constexpr (std::is_pointer_v<T>) return (T)call.pointer;
  return T{};
}

// The wrapper of an entry point, and its original with the arguments of a call.
template <gl::EntryPoint kEntry, auto kMember, class Signature>
struct Wrapper;
template <gl::EntryPoint kEntry, auto kMember, class R, class... A>
struct Wrapper<kEntry, kMember, R (*)(A...)> {
  static R run(A... arguments) {
    Call call;
    call.entry = kEntry;
    std::size_t i = 0;
    (take(call, i++, arguments), ...);
    if constexpr (is_coordinate_vector(kEntry)) {
      call.numbers = {call.read(0), kEntry == EvalCoord2fv || kEntry == EvalCoord2dv ? call.read(1) : 0};
    }
    call.go();
    if constexpr (std::is_arithmetic_v<R>) return static_cast<R>(call.result);
    if constexpr (std::is_pointer_v<R>) return R{};
  }
  static void install(gl::Table& table) { table.*kMember = run; }
  static void original(Call& call) {
    if constexpr (is_coordinate_vector(kEntry)) {
      using Real = std::remove_const_t<std::remove_pointer_t<std::common_type_t<A...>>>;
      const Real values[2] = {static_cast<Real>(call.numbers[0]), static_cast<Real>(call.numbers[1])};
      (sound.*kMember)(values);
    } else {
      invoke(call, std::index_sequence_for<A...>{});
    }
  }
  template <std::size_t... kI>
  static void invoke(Call& call, std::index_sequence<kI...>) {
    if constexpr (std::is_arithmetic_v<R>)
      call.result = static_cast<double>((sound.*kMember)(give<A>(call, kI)...));
    else
      (sound.*kMember)(give<A>(call, kI)...);
  }
};

struct Command {
  void (*install)(gl::Table&);
  void (*original)(Call&);
  std::string_view name;
};
const std::array<Command, gl::kEntryPointCount> commands{{
#define GL_ENTRY(name, kinds)                                           \
  {Wrapper<name, &gl::Table::name, decltype(gl::Table::name)>::install, \
   Wrapper<name, &gl::Table::name, decltype(gl::Table::name)>::original, #name},
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
}};
const Command& command(gl::EntryPoint entry) { return commands[static_cast<std::size_t>(entry)]; }

// The letters of the arguments of families of entry points, by the beginning of their names.
constexpr std::pair<std::string_view, std::string_view> kLetters[] = {{"MapGrid1", "gab"},
                                                                      {"MapGrid2", "gabhcd"},
                                                                      {"Map1", "tabso"},
                                                                      {"Map2", "tabsocdwp"},
                                                                      {"EvalCoord", "uv"},
                                                                      {"EvalPoint", "ij"},
                                                                      {"EvalMesh", "mikjl"},
                                                                      {"GetMap", "tq"},
                                                                      {"GetnMap", "tqn"},
                                                                      {"Begin", "m"},
                                                                      {"", "e"}};

double memory_cell(const Value& cell) {
  return cell.number == 0   ? static_cast<double>(memory.flag)
         : cell.number == 1 ? static_cast<double>(memory.count)
                            : memory.number;
}

void assign(const Value& place, double value, Call& call) {
  if (place.op == Op::argument) {
    call.argument(static_cast<char>(place.number)) = value;
  } else if (place.op == Op::result) {
    call.result = value;
  } else if (place.op == Op::remembered) {
    keyed_memory[evaluate(kept[place.a], call)] = value;
  } else if (place.number == 0) {
    memory.flag = value != 0;
  } else if (place.number == 1) {
    memory.count = static_cast<long>(value);
  } else {
    memory.number = value;
  }
}

double invoke(const Value& step, Call& call) {
  Call other;
  other.entry = static_cast<gl::EntryPoint>(static_cast<int>(step.number));
  for (short i = 0; i < step.b; ++i)
    other.numbers[static_cast<std::size_t>(i)] = evaluate(kept[static_cast<std::size_t>(step.a + i)], call);
  command(other.entry).original(other);
  return other.result;
}

// Operations that need the context of the call instead of operands.
double evaluate_state(Op op, Call& call) {
  switch (op) {
    case Op::inside:
      return is_inside();
    case Op::open_mode:
      return open_mode();
    case Op::unit:
      return watched.unit;
    case Op::list_mode:
      return watched.list_mode;
    case Op::result:
      return call.result;
    case Op::is_legal:
      return call.is_legal();
    case Op::components:
      return gl::components_of(call.target());
    case Op::is_float:
      return call.element == 'f' || command(call.entry).name.back() == 'f';
    case Op::go:
      call.go();
      return 1;
    default:
      throw std::logic_error("rules.cpp: unknown operation");
  }
}

double evaluate_unary(Op op, double a, Call& call) {
  const auto token = static_cast<GLenum>(a);
  switch (op) {
    case Op::negation:
      return a == 0;
    case Op::round:
      return std::round(a);
    case Op::magnitude:
      return std::abs(a);
    case Op::element:
      return call.read(static_cast<std::size_t>(a));
    case Op::remembered:
      return keyed_memory[a];
    case Op::is_on:
      return sound.IsEnabled(token);
    case Op::integer: {
      GLint values[16] = {};
      sound.GetIntegerv(token, values);
      return values[0];
    }
    case Op::noted_on:
      return is_noted_on(token);
    case Op::has_vertex_map:
      return has_vertex_map(static_cast<int>(a));
    case Op::is_map1:
      return faults::is_map1(token);
    case Op::is_map2:
      return faults::is_map2(token);
    case Op::buffer:
      return watched.buffers[token];
    case Op::error:
      leave_error(token);
      return 0;
    default:
      return evaluate_state(op, call);
  }
}

double evaluate_binary(const Value& value, Call& call) {
  const double a = evaluate(kept[value.a], call);
  if (value.op == Op::both) return a != 0 && evaluate(kept[value.b], call) != 0;
  if (value.op == Op::either) return a != 0 || evaluate(kept[value.b], call) != 0;
  if (value.op == Op::choice) return evaluate(kept[a != 0 ? value.b : value.c], call);
  const double b = evaluate(kept[value.b], call);
  switch (value.op) {
    case Op::sum:
      return a + b;
    case Op::difference:
      return a - b;
    case Op::product:
      return a * b;
    case Op::quotient:
      return a / b;
    case Op::remainder:
      return static_cast<double>(static_cast<long long>(a) % static_cast<long long>(b));
    case Op::bit_and:
      return static_cast<double>(static_cast<long long>(a) & static_cast<long long>(b));
    case Op::equal:
      return a == b;
    case Op::less:
      return a < b;
    case Op::put:
      call.write(static_cast<std::size_t>(a), b);
      return 0;
    case Op::exchange: {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      const double first = call.read(i);
      call.write(i, call.read(j));
      call.write(j, first);
      return 0;
    }
    default:
      throw std::logic_error("rules.cpp: unknown operation");
  }
}

double evaluate(Value value, Call& call) {
  switch (value.op) {
    case Op::number:
      return value.number;
    case Op::argument:
      return call.argument(static_cast<char>(value.number));
    case Op::cell:
      return memory_cell(value);
    case Op::function:
      return value.function(call);
    case Op::set:
      assign(kept[value.a], evaluate(kept[value.b], call), call);
      return 0;
    case Op::swap: {
      const double first = evaluate(kept[value.a], call);
      assign(kept[value.a], evaluate(kept[value.b], call), call);
      assign(kept[value.b], first, call);
      return 0;
    }
    case Op::call:
      return invoke(value, call);
    case Op::sequence:
      for (short i = 0; i < value.b; ++i) evaluate(kept[static_cast<std::size_t>(value.a + i)], call);
      return 0;
    default:
      if (value.b != 0) return evaluate_binary(value, call);
      return evaluate_unary(value.op, value.a != 0 ? evaluate(kept[value.a], call) : 0, call);
  }
}

Value list(Op op, std::initializer_list<Value> values, double number = 0) {
  const auto first = static_cast<short>(kept.size());
  kept.insert(kept.end(), values.begin(), values.end());
  return {op, first, static_cast<short>(values.size()), 0, number};
}

}  // namespace

void Call::go() {
  const std::size_t before = next;
  const auto rule =
      std::find_if(active.begin() + static_cast<std::ptrdiff_t>(next), active.end(), [&](const Rule& r) {
        return std::find(r.entries.all.begin(), r.entries.all.begin() + r.entries.count, entry) !=
               r.entries.all.begin() + r.entries.count;
      });
  if (rule == active.end()) return command(entry).original(*this);
  next = static_cast<std::size_t>(rule - active.begin()) + 1;
  const Rule now = *rule;
  if (now.late) go();
  if (evaluate(now.condition, *this) != 0)
    evaluate(now.step, *this);
  else if (!now.late)
    go();
  next = before;
}

double& Call::argument(char letter) {
  if (letter >= '0' && letter <= '9') return numbers[static_cast<std::size_t>(letter - '0')];
  const auto family = std::ranges::find_if(
      kLetters, [&](const auto& one) { return command(entry).name.starts_with(one.first); });
  const std::size_t i = family->second.find(letter);
  if (i == std::string_view::npos)
    throw std::logic_error(std::string(command(entry).name) + " has no argument '" + letter + "'");
  return numbers[i];
}

double Call::read(std::size_t i) const {
  if (element == 'f') return static_cast<const GLfloat*>(pointer)[i];
  if (element == 'd') return static_cast<const GLdouble*>(pointer)[i];
  if (element == 'b') return static_cast<const GLboolean*>(pointer)[i];
  return static_cast<const GLint*>(pointer)[i];
}
void Call::write(std::size_t i, double value) {
  if (element == 'f')
    static_cast<GLfloat*>(pointer)[i] = static_cast<GLfloat>(value);
  else if (element == 'd')
    static_cast<GLdouble*>(pointer)[i] = value;
  else if (element == 'b')
    static_cast<GLboolean*>(pointer)[i] = static_cast<GLboolean>(value);
  else
    static_cast<GLint*>(pointer)[i] = static_cast<GLint>(value);
}

bool Call::is_legal() {
  const bool curve = entry == Map1f || entry == Map1d;
  const auto legal = [&](char order, char stride, char first, char last) {
    return legal_order(static_cast<GLint>(argument(order))) &&
           argument(stride) >= gl::components_of(target()) && argument(first) != argument(last);
  };
  return (curve ? faults::is_map1(target()) : faults::is_map2(target())) && legal('o', 's', 'a', 'b') &&
         (curve || legal('p', 'w', 'c', 'd'));
}

std::vector<double> Call::points() {
  const bool curve = entry == Map1f || entry == Map1d;
  const double rows = argument('o'), columns = curve ? 1 : argument('p');
  std::vector<double> all;
  for (double i = 0; i < rows; ++i)
    for (double j = 0; j < columns; ++j)
      for (int k = 0; k < gl::components_of(target()); ++k)
        all.push_back(
            read(static_cast<std::size_t>(i * argument('s') + (curve ? 0 : j * argument('w')) + k)));
  return all;
}
void Call::set_points(const std::vector<double>& points) {
  const bool curve = entry == Map1f || entry == Map1d;
  const int k = gl::components_of(target());
  storage = points;
  pointer = storage.data();
  for (std::size_t i = 0; i < points.size(); ++i) write(i, points[i]);
  if (!curve) argument('w') = k;
  argument('s') = curve ? k : k * argument('p');
}

Value remembered(Value key) { return unary(Op::remembered, key); }
Value enabled(Value cap) { return unary(Op::is_on, cap); }
Value state(Value pname) { return unary(Op::integer, pname); }
Value noted_on(Value cap) { return unary(Op::noted_on, cap); }
Value maps_vertices(Value dimension) { return unary(Op::has_vertex_map, dimension); }
Value is_map1(Value token) { return unary(Op::is_map1, token); }
Value is_map2(Value token) { return unary(Op::is_map2, token); }
Value is_map(Value token) { return is_map1(token) || is_map2(token); }
Value is_texture_map(Value token) {
  return (token >= GL_MAP1_TEXTURE_COORD_1 && token <= GL_MAP1_TEXTURE_COORD_4) ||
         (token >= GL_MAP2_TEXTURE_COORD_1 && token <= GL_MAP2_TEXTURE_COORD_4);
}
Value has_buffer(Value target) { return unary(Op::buffer, target); }

Value operator+(Value a, Value b) { return binary(Op::sum, a, b); }
Value operator-(Value a, Value b) { return binary(Op::difference, a, b); }
Value operator-(Value a) { return Value(0) - a; }
Value operator*(Value a, Value b) { return binary(Op::product, a, b); }
Value operator/(Value a, Value b) { return binary(Op::quotient, a, b); }
Value operator%(Value a, Value b) { return binary(Op::remainder, a, b); }
Value operator&(Value a, Value b) { return binary(Op::bit_and, a, b); }
Value operator==(Value a, Value b) { return binary(Op::equal, a, b); }
Value operator!=(Value a, Value b) { return !(a == b); }
Value operator<(Value a, Value b) { return binary(Op::less, a, b); }
Value operator>(Value a, Value b) { return b < a; }
Value operator<=(Value a, Value b) { return a < b || a == b; }
Value operator>=(Value a, Value b) { return b <= a; }
Value operator&&(Value a, Value b) { return binary(Op::both, a, b); }
Value operator||(Value a, Value b) { return binary(Op::either, a, b); }
Value operator!(Value a) { return unary(Op::negation, a); }
Value min(Value a, Value b) { return choose(b < a, b, a); }
Value max(Value a, Value b) { return choose(a < b, b, a); }
Value abs(Value a) { return unary(Op::magnitude, a); }
Value round(Value a) { return unary(Op::round, a); }
Value choose(Value condition, Value yes, Value no) {
  const short first = keep(condition), second = keep(yes);
  return {Op::choice, first, second, keep(no)};
}
Value element(Value i) { return unary(Op::element, i); }
Value lambda(Function function) {
  Value value{Op::function, 0};
  value.function = function;
  return value;
}

Value set(Value place, Value value) { return binary(Op::set, place, value); }
Value put(Value i, Value value) { return binary(Op::put, i, value); }
Value exchange(Value i, Value j) { return binary(Op::exchange, i, j); }
Value swap(Value one, Value other) { return binary(Op::swap, one, other); }
Value error(GLenum kind) { return unary(Op::error, kind); }
Value call(gl::EntryPoint entry, std::initializer_list<Value> arguments) {
  return list(Op::call, arguments, static_cast<int>(entry));
}
Value sequence(std::initializer_list<Value> steps) { return list(Op::sequence, steps); }
Value when(Value condition, Value step) { return choose(condition, step, 0); }

Rule before(const Entries& entries, Value condition, Value step) {
  return {entries, condition, sequence({step, kGo})};
}
Rule after(const Entries& entries, Value condition, Value step) { return {entries, condition, step, true}; }
Rule around(const Entries& entries, Value condition, Value first, Value last) {
  return {entries, condition, sequence({first, kGo, last})};
}
Rule instead(const Entries& entries, Value condition, Value step) { return {entries, condition, step}; }
Rule skip(const Entries& entries, Value condition) { return {entries, condition, 0}; }
Rule without(const Entries& entries, Value condition, GLenum cap) {
  return around(entries, condition && enabled(cap), call(Disable, {cap}), call(Enable, {cap}));
}
Rule on_unit_0(const Entries& entries, Value condition) {
  return around(entries, condition && kUnit != GL_TEXTURE0, call(ActiveTexture, {GL_TEXTURE0}),
                call(ActiveTexture, {kUnit}));
}

void apply(Injection& in, std::initializer_list<Rule> rules) {
  for (const Rule& rule : rules) {
    active.push_back(rule);
    for (std::size_t i = 0; i < rule.entries.count; ++i) command(rule.entries.all[i]).install(in.gl);
  }
}

void forget_rules() {
  kept.assign(1, Value(0));
  active.clear();
  keyed_memory.clear();
}

}  // namespace evalcts::faults
