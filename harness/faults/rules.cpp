// Evaluates the conditions and steps of rules during a call.
#include "rules.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace evalcts::faults {
namespace {

// Returns a new place that no other rule uses.
Place fresh_place() {
  const auto number = std::make_shared<double>(0);
  return {[=](Call&) { return *number; }, [=](Call&, double x) { *number = x; }};
}

std::size_t index(double value) { return static_cast<std::size_t>(value); }

// Returns the answers to GetMap, or Get of a grid, in double precision.
std::vector<double> exact_answers(Call& call) {
  if (!(kGetMap | kGetnMap).contain(call.entry)) {
    const GLenum name = token(call.argument('e'));
    if (name < GL_MAP1_GRID_DOMAIN || name > GL_MAP2_GRID_SEGMENTS) return {};
    std::vector<double> values(4);
    unmodified.GetDoublev(name, values.data());
    values.resize(name == GL_MAP2_GRID_DOMAIN ? 4 : name == GL_MAP1_GRID_SEGMENTS ? 1 : 2);
    return values;
  }
  if (!is_map1_target(call.target()) && !is_map2_target(call.target())) return {};
  const Map map = current_map(call.target());
  const bool curve = is_map1_target(map.target);
  if (call.argument('q') == GL_COEFF) return map.net.values;
  std::vector<double> values = {map.u1, map.u2, map.v1, map.v2};
  if (call.argument('q') == GL_ORDER)
    values = {static_cast<double>(map.net.rows), static_cast<double>(map.net.columns)};
  if (curve) values.resize(values.size() / 2);
  return values;
}

}  // namespace

// --- Arguments and memory ----------------------------------------------------------------------------------

Place argument(char letter) {
  return {[=](Call& c) { return c.argument(letter); }, [=](Call& c, double x) { c.argument(letter) = x; }};
}
Place remembered(Value key) {
  return {unary(key, [](double k) { return running_layer().numbers[k]; }),
          [=](Call& c, double x) { running_layer().numbers[key(c)] = x; }};
}
// Uses negative keys, which differ from all tokens.
Value keep(std::initializer_list<Value> values) {
  Value all = 0;
  int i = 0;
  for (const Value& value : values) all = sequence({all, set(kept(i++), value)});
  return all;
}
Value keep_state(GLenum pname) {
  return keep({real_state(pname), real_state(pname, 1), real_state(pname, 2), real_state(pname, 3)});
}
std::vector<Value> kept_values(int count) {
  std::vector<Value> values;
  for (int i = 0; i < count; ++i) values.push_back(kept(i));
  return values;
}

// --- State -------------------------------------------------------------------------------------------------

Value enabled(Value cap) {
  return unary(cap, [](double c) { return unmodified.IsEnabled(token(c)); });
}
Value state(Value pname, int i) {
  return unary(pname, [i](double name) {
    GLint values[16] = {};
    unmodified.GetIntegerv(token(name), values);
    return values[i];
  });
}
Value real_state(Value pname, int i) {
  return unary(pname, [i](double name) {
    GLdouble values[16] = {};
    unmodified.GetDoublev(token(name), values);
    return values[i];
  });
}
Value noted_on(Value cap) {
  return unary(cap, [](double c) { return tracked().enabled[token(c)]; });
}
Value maps_vertices(Value dimension) {
  return unary(dimension, [](double d) { return tracked().has_vertex_map(static_cast<int>(d)); });
}
Value evaluates() {
  return enabled(GL_MAP1_VERTEX_3) || enabled(GL_MAP1_VERTEX_4) || enabled(GL_MAP2_VERTEX_3) ||
         enabled(GL_MAP2_VERTEX_4);
}
Value has_buffer(Value target) {
  return unary(target, [](double t) { return tracked().buffers[token(t)]; });
}
Value grid2(int i) {
  return i % 3 == 0 ? state(GL_MAP2_GRID_SEGMENTS, i / 3) : real_state(GL_MAP2_GRID_DOMAIN, i - 1 - i / 3);
}
Value is_texture_map(Value name) {
  return (name >= GL_MAP1_TEXTURE_COORD_1 && name <= GL_MAP1_TEXTURE_COORD_4) ||
         (name >= GL_MAP2_TEXTURE_COORD_1 && name <= GL_MAP2_TEXTURE_COORD_4);
}

// --- Operations --------------------------------------------------------------------------------------------

Value operator%(Value a, Value b) {
  return binary(a, b,
                [](double x, double y) { return static_cast<long long>(x) % static_cast<long long>(y); });
}
Value operator&(Value a, Value b) {
  return binary(a, b,
                [](double x, double y) { return static_cast<long long>(x) & static_cast<long long>(y); });
}
Value operator&&(Value a, Value b) {
  return [=](Call& c) { return a.holds(c) && b.holds(c); };
}
Value operator||(Value a, Value b) {
  return [=](Call& c) { return a.holds(c) || b.holds(c); };
}
Value operator!(Value a) {
  return [=](Call& c) { return !a.holds(c); };
}
Value min(Value a, Value b) {
  return binary(a, b, [](double x, double y) { return std::min(x, y); });
}
Value max(Value a, Value b) {
  return binary(a, b, [](double x, double y) { return std::max(x, y); });
}
Value abs(Value a) {
  return unary(a, [](double x) { return std::abs(x); });
}
Value round(Value a) {
  return unary(a, [](double x) { return std::round(x); });
}
Value is_negative_zero(Value a) {
  return unary(a, [](double x) { return x == 0 && std::signbit(x); });
}
Value is_subnormal(Value a) {
  return unary(a, [](double x) { return std::fpclassify(static_cast<float>(x)) == FP_SUBNORMAL; });
}
Value next_float(Value a, double towards) {
  return unary(
      a, [towards](double x) { return std::nextafter(static_cast<float>(x), static_cast<float>(towards)); });
}
Value in_bits(Value a, int bits) {
  const double range = std::ldexp(1, bits);
  return unary(a, [range](double x) {
    const double low = x - range * std::floor(x / range);
    return low < range / 2 ? low : low - range;
  });
}
double with_precision(double a, int bits) {
  int exponent = 0;
  const double significand = std::frexp(a, &exponent);
  return std::ldexp(std::round(std::ldexp(significand, bits)), exponent - bits);
}
Value with_precision(Value a, int bits) {
  return unary(a, [bits](double x) { return with_precision(x, bits); });
}
Value to_float(Value a) {
  return unary(a, [](double x) { return static_cast<float>(x); });
}
Value choose(Value condition, Value yes, Value no) {
  return [=](Call& c) { return condition.holds(c) ? yes(c) : no(c); };
}
Value swapped(Value name, GLenum one, GLenum other) {
  return choose(name == one, other, choose(name == other, one, name));
}
Value element(Value i) {
  return [=](Call& c) { return c.read(index(i(c))); };
}

// --- Steps -------------------------------------------------------------------------------------------------

Steps::Steps(std::initializer_list<Value> steps)
    : all([list = std::vector<Value>(steps)](Call& c) {
        for (const Value& step : list) step(c);
      }) {}

Value set(Place place, Value value) {
  return [=](Call& c) { place.assign(c, value(c)); };
}
Value put(Value i, Value value) {
  return [=](Call& c) { c.write(index(i(c)), value(c)); };
}
Value exchange(Value i, Value j) {
  return [=](Call& c) {
    const double first = c.read(index(i(c)));
    c.write(index(i(c)), c.read(index(j(c))));
    c.write(index(j(c)), first);
  };
}
Value answer(std::vector<Value> values) {
  return [=](Call& c) {
    for (std::size_t i = 0; i < values.size(); ++i) c.write(i, values[i](c));
  };
}
Value swap(Place one, Place other) {
  return [=](Call& c) {
    const double first = one(c);
    one.assign(c, other(c));
    other.assign(c, first);
  };
}

Value error(GLenum kind) {
  if (kind == GL_INVALID_ENUM) return call(Enable, {0});
  if (kind == GL_INVALID_VALUE) return call(MapGrid1f, {0, 0, 1});
  return [](Call&) {
    GLint unused = 0;
    unmodified.GetnMapiv(GL_MAP1_INDEX, GL_ORDER, 0, &unused);
  };
}
Value error_inside() { return call(Begin, {GL_POINTS}); }
Value error_now(GLenum kind) {
  if (kind == GL_INVALID_VALUE) return call(GenLists, {-1});  // GenLists is never compiled
  if (kind == GL_INVALID_OPERATION) return call(EndList);     // must not be used while a list is open
  return [](Call&) {
    GLint unused[4];
    unmodified.GetMapiv(0, GL_ORDER, unused);
  };
}
Value replace_error(GLenum kind, GLenum by) {
  return [=](Call& c) {
    GLenum seen = unmodified.GetError();
    if (seen == kind) seen = by;
    if (seen != GL_NO_ERROR) error_now(seen)(c);
  };
}

Value call(gl::EntryPoint entry, std::vector<Value> arguments) {
  return [=](Call& c) {
    Call other;
    other.entry = entry;
    for (std::size_t i = 0; i < arguments.size(); ++i) other.numbers[i] = arguments[i](c);
    other.go_original();
    return other.result;
  };
}
Value loop(Place counter, Value first, Value last, Steps steps, int step) {
  return [=](Call& c) {
    const double end = last(c);
    for (double i = first(c); step > 0 ? i <= end : i >= end; i += step) {
      counter.assign(c, i);
      steps.all(c);
    }
  };
}
Value primitive(Value mode, Steps steps) { return sequence({call(Begin, {mode}), steps, call(End)}); }

Value hold() {
  return [](Call& c) {
    Call& held = running_layer().held.emplace_back(c);
    if (!c.storage.empty()) held.pointer = held.storage.data();
  };
}
Value release() {
  return [](Call&) {
    for (Call& call : std::exchange(running_layer().held, {})) call.go_original();
  };
}
Value drop() {
  return [](Call&) { running_layer().held.clear(); };
}

namespace {

template <class Change>
Value change_net(Change change) {
  return [=](Call& c) {
    if (!c.is_legal()) return;
    Net net = c.net();
    change(net, c);
    c.set_net(net);
  };
}

}  // namespace

Value change_points(void (*change)(Net& net)) {
  return change_net([=](Net& net, Call&) { change(net); });
}
Value change_points(void (*change)(Net& net, Call& call)) { return change_net(change); }
Value change_values(double (*change)(double value)) {
  return change_net([=](Net& net, Call&) { std::ranges::transform(net.values, net.values.begin(), change); });
}
Value swap_components(int one, int other) {
  return change_net([=](Net& net, Call&) {
    for (int i = 0; i < net.rows; ++i)
      for (int j = 0; j < net.columns; ++j) std::swap(net.point(i, j)[one], net.point(i, j)[other]);
  });
}
Value repeat_points(Value condition) {
  return change_net([=](Net& net, Call& c) {
    if (condition.holds(c) && remembered_list().size() == net.values.size())
      net.values = remembered_list();
    else
      remembered_list() = net.values;
  });
}
Value define(GLenum target, std::initializer_list<double> points) {
  Map map{target, 0, 1, 0, 1, {gl::components_of(target), 1, 1, points}};
  (is_map1_target(target) ? map.net.rows : map.net.columns) =
      static_cast<int>(points.size()) / map.net.components;
  return [map](Call&) { map.define(); };
}
Value redefine(Value target, void (*change)(Map& map, Call& call)) {
  return [=](Call& c) {
    Map map = current_map(token(target(c)));
    change(map, c);
    map.define();
  };
}

Value answers() {
  return [](Call& c) { return exact_answers(c).size(); };
}
Value change_answers(double (*change)(double exact, double answered)) {
  return [=](Call& c) {
    for (std::size_t i = 0; const double exact : exact_answers(c)) {
      c.write(i, change(exact, c.read(i)));
      ++i;
    }
  };
}

// --- State that can be saved -------------------------------------------------------------------------------

State enable_of(GLenum cap) {
  return [cap]() -> Restore {
    const bool on = unmodified.IsEnabled(cap);
    return [=] { on ? unmodified.Enable(cap) : unmodified.Disable(cap); };
  };
}
State map_of(GLenum target) {
  return [target]() -> Restore { return [map = current_map(target)] { map.define(); }; };
}
State setting(gl::EntryPoint command, std::initializer_list<Value> arguments) {
  return [command, list = std::vector<Value>(arguments)]() -> Restore {
    Call setter;
    setter.entry = command;
    Call none;
    for (std::size_t i = 0; i < list.size(); ++i) setter.numbers[i] = list[i](none);
    return [=] { Call(setter).go_original(); };
  };
}
State grid2_state() {
  return setting(MapGrid2d, {grid2(0), grid2(1), grid2(2), grid2(3), grid2(4), grid2(5)});
}
State current(gl::EntryPoint command, GLenum pname) {
  return setting(command,
                 {real_state(pname), real_state(pname, 1), real_state(pname, 2), real_state(pname, 3)});
}

// --- Rules -------------------------------------------------------------------------------------------------

Rules::Rules(std::initializer_list<Rules> several) {
  for (const Rules& one : several) all.insert(all.end(), one.all.begin(), one.all.end());
}

Rule before(const Entries& entries, Value condition, Steps steps) {
  return {entries, condition, sequence({steps, kGo})};
}
Rule after(const Entries& entries, Value condition, Steps steps) {
  return {entries, condition, steps, Rule::Kind::kLate};
}

Rules around(const Entries& entries, Value condition, Steps first, Steps last) {
  Rule rule{entries, condition, sequence({first, kGo, last})};
  if (!entries.contain(Begin)) return rule;
  rule.entries.all.reset(static_cast<std::size_t>(Begin));
  const Place begun = fresh_place();
  return {rule, before(Begin, condition, {set(begun, 1), first}), after(End, begun, {set(begun, 0), last})};
}
Rules without(const Entries& entries, Value condition, GLenum cap) {
  return around(entries, condition && enabled(cap), disable(cap), enable(cap));
}
Rules with(const Entries& entries, Value condition, GLenum cap) {
  return around(entries, condition && !enabled(cap), enable(cap), disable(cap));
}
Rules keeping(const Entries& entries, Value condition, const State& state, Steps steps) {
  const auto restore = std::make_shared<Restore>();
  return around(entries, condition, {[=](Call&) { *restore = state(); }, steps},
                [=](Call&) { (*restore)(); });
}
Rules on_unit_0(const Entries& entries, Value condition) {
  return around(entries, condition && kUnit != GL_TEXTURE0, call(ActiveTexture, {GL_TEXTURE0}),
                call(ActiveTexture, {kUnit}));
}
Rules only_if(GLenum cap, Value condition) {
  return after(kSwitches, is_map(kName) || kName == GL_AUTO_NORMAL,
               switch_to(cap, noted_on(cap) && condition));
}
Rules swap_targets(GLenum one, GLenum other) {
  return {before(kMaps | kGetMap, set(kTarget, swapped(kTarget, one, other))),
          before(kGet | kSwitches | IsEnabled, set(kName, swapped(kName, one, other)))};
}

Rules not_restored(const State& state, Value condition) {
  return keeping(PopAttrib, kListMode == 0 && kLevel > 0 && condition, state);
}
Rules restored(const State& state, Value condition) {
  const auto levels = std::make_shared<std::vector<Restore>>();
  return {before(PushAttrib, kListMode == 0, [=](Call&) { levels->push_back(state()); }),
          after(PopAttrib, kListMode == 0 && kLevel > 0, [=](Call& c) {
            if (condition.holds(c)) levels->back()();
            levels->pop_back();
          })};
}

Rules change_output(Value condition, std::function<void(Primitives&)> change) {
  return Rule{.entries = {}, .condition = condition, .step = 0, .emitted = std::move(change)};
}
Rules change_all_vertices(std::function<void(ObservedVertex&)> change) {
  return change_output(true, [=](Primitives& all) {
    for (ObservedPrimitive& primitive : all) std::ranges::for_each(primitive.vertices, change);
  });
}
Rules change_primitives(std::function<void(ObservedPrimitive&)> change) {
  const Place evaluated = fresh_place();
  return {before(kPoints | kMeshes, set(evaluated, 1)),
          change_output(evaluated, [=](Primitives& all) { std::ranges::for_each(all, change); })};
}
Rules change_vertices(void (*change)(ObservedVertex& vertex)) {
  return change_primitives(
      [=](ObservedPrimitive& primitive) { std::ranges::for_each(primitive.vertices, change); });
}
Rules change_pairs(void (*change)(ObservedVertex& now, const ObservedVertex& before), std::size_t from) {
  return change_primitives([=](ObservedPrimitive& primitive) {
    for (std::size_t i = primitive.vertices.size(); i-- > from;)
      change(primitive.vertices[i], primitive.vertices[i - 1]);
  });
}

}  // namespace evalcts::faults
