// Defines the wrappers that turn calls of entry points into Call objects, and Call objects into calls.
#include "call.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace evalcts::faults {
namespace {

// The letters of the arguments, by the beginning of the command's name. The first match counts.
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
    call.pointers[i] = call.pointer = (void*)value;
    call.last_pointer = i;
    call.element = element_of<T>();
  }
}
template <class T>
T give(Call& call, std::size_t i) {
  if constexpr (std::is_arithmetic_v<T>) return static_cast<T>(call.numbers[i]);
  if constexpr (std::is_pointer_v<T>) return (T)(i == call.last_pointer ? call.pointer : call.pointers[i]);
  return T{};
}

// The wrapper of an entry point (run), and the command with the arguments of a Call (original).
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
    call.enter();
    if constexpr (std::is_arithmetic_v<R>) return static_cast<R>(call.result);
    if constexpr (std::is_pointer_v<R>) return static_cast<R>(call.result_pointer);
  }
  static void install(gl::Table& table) { table.*kMember = run; }
  static void remove(gl::Table& table) { table.*kMember = nullptr; }
  static void original(Call& call) {
    if constexpr (is_coordinate_vector(kEntry)) {
      using Real = std::remove_const_t<std::remove_pointer_t<std::common_type_t<A...>>>;
      const Real values[2] = {static_cast<Real>(call.numbers[0]), static_cast<Real>(call.numbers[1])};
      (innermost.*kMember)(values);
    } else {
      invoke(call, std::index_sequence_for<A...>{});
    }
  }
  template <std::size_t... kI>
  static void invoke(Call& call, std::index_sequence<kI...>) {
    if constexpr (std::is_arithmetic_v<R>)
      call.result = static_cast<double>((innermost.*kMember)(give<A>(call, kI)...));
    else if constexpr (std::is_pointer_v<R>)
      call.result_pointer = (innermost.*kMember)(give<A>(call, kI)...);
    else
      (innermost.*kMember)(give<A>(call, kI)...);
  }
};

struct Command {
  void (*install)(gl::Table&);
  void (*remove)(gl::Table&);
  void (*original)(Call&);
  std::string_view name;
};
template <gl::EntryPoint kEntry, auto kMember>
Command describe(std::string_view name) {
  using Wrapped = Wrapper<kEntry, kMember, std::remove_cvref_t<decltype(innermost.*kMember)>>;
  return {Wrapped::install, Wrapped::remove, Wrapped::original, name};
}
const std::array<Command, gl::kEntryPointCount> kCommands{{
#define GL_ENTRY(name, kinds) describe<name, &gl::Table::name>(#name),
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
}};
const Command& command(gl::EntryPoint entry) { return kCommands[static_cast<std::size_t>(entry)]; }

}  // namespace

Net Net::transposed() const {
  Net other{components, rows, columns, {}};
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) {
      const double* point = &values[static_cast<std::size_t>((i * columns + j) * components)];
      other.values.insert(other.values.end(), point, point + components);
    }
  return other;
}

void Map::define() const {
  const int k = net.components;
  if (is_map2_target(target) || net.columns > 1)
    unmodified.Map2d(target, u1, u2, k * net.columns, net.rows, v1, v2, k, net.columns, net.values.data());
  else
    unmodified.Map1d(target, u1, u2, k, net.rows, net.values.data());
}

Map current_map(GLenum target) {
  GLint order[2] = {1, 1};
  GLdouble domain[4] = {0, 1, 0, 1};
  unmodified.GetMapiv(target, GL_ORDER, order);
  unmodified.GetMapdv(target, GL_DOMAIN, domain);
  Net net{gl::components_of(target), order[0], order[1], {}};
  net.values.resize(static_cast<std::size_t>(net.components * net.rows * net.columns));
  unmodified.GetMapdv(target, GL_COEFF, net.values.data());
  return {target, domain[0], domain[1], domain[2], domain[3], std::move(net)};
}

void install(gl::EntryPoint entry, gl::Table& table) { command(entry).install(table); }
void remove(gl::EntryPoint entry, gl::Table& table) { command(entry).remove(table); }

void call_innermost(Call& call) { command(call.entry).original(call); }

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
  const auto legal = [&](char order, char stride, char first, char last) {
    return argument(order) >= 1 && argument(order) <= kMaxOrder &&
           argument(stride) >= gl::components_of(target()) && argument(first) != argument(last);
  };
  return (is_curve() ? is_map1_target(target()) : is_map2_target(target())) && legal('o', 's', 'a', 'b') &&
         (is_curve() || legal('p', 'w', 'c', 'd'));
}

std::size_t Call::place(int i, int j, int k) {
  return static_cast<std::size_t>(i * argument('s') + (is_curve() ? 0 : j * argument('w')) + k);
}
Net Call::net() {
  Net net{gl::components_of(target()), integer('o'), is_curve() ? 1 : integer('p'), {}};
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j)
      for (int k = 0; k < net.components; ++k) net.values.push_back(read(place(i, j, k)));
  return net;
}
void Call::set_net(const Net& net) {
  if (!is_curve()) argument('w') = net.components;
  argument('s') = net.components * net.columns;
  argument('o') = net.rows;
  set_values(net);
}
void Call::set_values(Net net) {
  storage.resize(place(net.rows - 1, net.columns - 1, net.components));
  pointer = storage.data();
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j)
      for (int k = 0; k < net.components; ++k) write(place(i, j, k), net.point(i, j)[k]);
}

}  // namespace evalcts::faults
