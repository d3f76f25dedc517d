// The evaluator part of the state machine of the GL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>

#include <glevaluator.h>

#include "allocator.h"
#include "attributes.h"
#include "current_vertex.h"
#include "display_list.h"
#include "list_table.h"
#include "map.h"
#include "mutation_point.h"
#include "parameter.h"
#include "plan.h"
#include "target.h"

namespace glev {

inline constexpr int kMaxListNesting = 64;

// The list between NewList and EndList.
struct OpenList {
  glev_uint name = 0;  // name and mode are 0 if no list is open
  glev_enum mode = 0;
  bool broken = false;  // there was no memory for a command
  DisplayList list;
};

// The answer to a Get: up to four values of state.
struct StateValues {
  int count;
  std::array<double, 4> values;
  bool normalized = false;  // a colour or normal, see convert()
};

// Returns a command of a list, which calls a method of the context.
template <auto kMethod, class... Arguments>
auto listed(const Arguments&... arguments) {
  return [arguments...](glev_context& gl, const void*) { (gl.*kMethod)(arguments...); };
}

template <class Command>
void run_listed(glev_context& gl, const std::byte* payload) {
  (*std::launder(reinterpret_cast<const Command*>(payload)))(
      gl, payload + round_up_to_list_unit(sizeof(Command)));
}

}  // namespace glev

// The methods are the commands, independently of the form of their arguments (f, d, v). Errors that depend on
// arguments alone have precedence over those that depend on state (GL §2.3.1).
struct glev_context {
 public:
  glev_context(const glev::Allocator& allocator, const glev::Kernels* kernels);
  ~glev_context();
  glev_context(const glev_context&) = delete;
  glev_context& operator=(const glev_context&) = delete;

  const glev::Allocator& allocator() const { return allocator_; }

  void record_error(glev_enum error) {
    if (error_ == GLEV_NO_ERROR) error_ = error;
  }
  glev_enum get_error();

  // Compiles a command into the open list, executes it, or both.
  template <auto kMethod, class... Arguments>
  void issue(const Arguments&... arguments) {
    if (GLEV_AT(compiles, is_compiling())) {
      compile(glev::listed<kMethod>(arguments...));
      if (GLEV_AT(compiles_only, open_.mode == GLEV_COMPILE)) return;
    }
    (this->*kMethod)(arguments...);
  }
  // Do what issue() does for the two commands with arrays, which are read immediately.
  template <class Real>
  void issue_define_map(int dimension, glev_enum target, const std::array<glev::MapDirection, 2>& directions,
                        const Real* points);
  void issue_call_lists(glev_int count, glev_enum type, const void* offsets);

  // Defines a map. `directions`: u, and v for dimension 2.
  template <class Real>
  void define_map(int dimension, glev_enum target, const std::array<glev::MapDirection, 2>& directions,
                  const Real* points);
  // Writes at most `bytes` bytes to v.
  template <class Number>
  void get_map(glev_enum target, glev_enum query, std::int64_t bytes, Number* v);
  void set_enabled(glev_enum cap, bool enabled);
  bool is_enabled(glev_enum cap);
  void set_grid(int dimension, const std::array<glev::Grid, 2>& grid);
  void eval_coord(int dimension, double u, double v);
  // A fast path of eval_coord() for consecutive calls between Begin and End. Returns false, and does nothing,
  // if it does not apply.
  bool eval_directly(int dimension, double u, double v);
  void eval_point(int dimension, glev_int i, glev_int j);
  void eval_mesh1(glev_enum mode, glev_int i1, glev_int i2);
  void eval_mesh2(glev_enum mode, glev_int i1, glev_int i2, glev_int j1, glev_int j2);

  void begin(glev_enum mode);
  void end();
  void vertex(const std::array<float, 4>& position);
  void color(const std::array<float, 4>& color);
  void normal(const std::array<float, 3>& normal);
  void index(float index) { current_.change().index = index; }
  void edge_flag(bool flag) { current_.change().edge_flag = flag ? GLEV_TRUE : GLEV_FALSE; }
  void multi_tex_coord(glev_enum texture, const std::array<float, 4>& texcoord);
  void active_texture(glev_enum texture);

  void push_attrib(glev_bitfield mask);
  void pop_attrib();

  void new_list(glev_uint list, glev_enum mode);
  void end_list();
  void call_list(glev_uint list);
  void call_lists(glev_int count, glev_enum type, const void* offsets);
  void list_base(glev_uint base);
  glev_uint gen_lists(glev_int range);
  bool is_list(glev_uint list);
  void delete_lists(glev_uint list, glev_int range);

  // Flush and Finish only check for errors, because no commands are ever pending.
  void flush() { is_rejected_in_primitive(); }

  template <class Number>
  void get(glev_enum pname, Number* v);
  const char* get_string(glev_enum name);

  glev_result set_sink(const glev_sink* sink);

  // Returns the plan of the current maps, without adding a reference; null if there is no memory.
  glev_plan* current_plan(int dimension);

 private:
  // Between Begin and End, records INVALID_OPERATION and returns true.
  bool is_rejected_in_primitive();
  // Between Begin and End and within callbacks, records INVALID_OPERATION and returns true, because lists
  // must not change while one may be executing.
  bool is_rejected_with_lists();
  // Commands of a callback are not compiled, because the callback issues them again when the list is
  // executed.
  bool is_compiling() const { return open_.mode != 0 && callbacks_ == 0; }
  // Appends a command to the open list, with an array of `bytes` bytes for the caller to fill, which is
  // returned. The command is called with the context and the array. If there is no memory, marks the list as
  // broken and returns null.
  template <class Command>
  void* compile(const Command& command, std::uint64_t bytes = 0);
  // Returns the flag of a capability; null if there is none.
  bool* find_flag(glev_enum cap);
  // Returns the values of a state variable; count 0 if there is no such variable.
  glev::StateValues find_state(glev_enum pname);
  void drop_plan(int dimension);
  // Returns true if eval_directly() may evaluate the next call.
  bool is_direct(const glev_plan& plan) const;
  // Returns the plan to draw with; null if there is no vertex map. If there is no memory, records the error
  // and returns null.
  const glev_plan* plan_to_draw(int dimension);
  template <class Fill>
  void emit_staged(const glev_plan& plan, const Fill& fill);
  void emit_within(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v,
                   const glev::NormalRow* row);
  // Emits the vertex at (u, v). `row` is at v, or null if the plan has no automatic normals.
  void emit_at(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v,
               const glev::NormalRow* row);
  void put(const float (&values)[4], glev::Attribute attribute, glev_vertex* vertex) const;
  void evaluate_into(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v,
                     const glev::NormalRow* row, glev_vertex* vertex) const;
  void evaluate_with_normal(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v);
  void evaluate_at(int dimension, const glev::GridArgument& u, const glev::GridArgument& v);
  // Draws a primitive of a mesh: begin, body(), end.
  template <class Body>
  void mesh_primitive(glev_enum mode, const Body& body);
  void draw_mesh(int dimension, glev_enum mode, std::int64_t i1, std::int64_t i2, std::int64_t j1,
                 std::int64_t j2);
  void emit(const glev_vertex& vertex) { call_sink(sink_.vertex, &vertex); }
  template <class Callback, class... Arguments>
  void call_sink(Callback callback, Arguments... arguments) {
    if (callback == nullptr) return;
    ++callbacks_;
    callback(sink_.user, arguments...);
    --callbacks_;
  }

  glev::Allocator allocator_;
  const glev::Kernels* kernels_;
  glev_enum error_ = GLEV_NO_ERROR;
  std::array<std::array<glev::Map, glev::kSlots>, 2> maps_;  // [dimension - 1]
  glev::EvalAttributes eval_;
  std::array<glev_plan*, 2> plans_{};  // [dimension - 1]; null if out of date
  glev::CurrentVertex current_;
  unsigned active_unit_ = 0;
  bool in_primitive_ = false;
  bool in_mesh_ = false;                      // the primitive belongs to a mesh; callbacks must not end it
  bool in_default_environment_ = false;       // at the start of the primitive
  std::array<const glev_plan*, 2> direct_{};  // [dimension - 1]; plan of eval_directly(), or null
  glev_sink sink_{};
  int callbacks_ = 0;  // number of callbacks being executed
  int attrib_depth_ = 0;
  std::array<glev::SavedAttributes, glev::kAttribStackDepth> attribs_;
  glev::ListTable lists_;
  glev::OpenList open_;
  glev_uint list_base_ = 0;
  int list_depth_ = 0;  // number of lists being executed
};

inline bool glev_context::eval_directly(int dimension, double u, double v) {
  const glev_plan* plan = direct_[dimension - 1];
  if (plan == nullptr || callbacks_ != 0) return false;
  glev_vertex* vertex = current_.find_staged_for(plan);
  if (vertex == nullptr || !plan->direct()(*plan, u, v, vertex->position)) return false;
  emit(*vertex);
  return true;
}

template <class Command>
void* glev_context::compile(const Command& command, std::uint64_t bytes) {
  static_assert(std::is_trivially_copyable_v<Command> && alignof(Command) <= glev::kListUnit);
  constexpr std::uint64_t kSize = glev::round_up_to_list_unit(sizeof(Command));
  if (open_.broken) return nullptr;
  std::byte* payload = open_.list.append(allocator_, glev::run_listed<Command>, kSize + bytes);
  if (payload == nullptr) {
    open_.broken = true;
    record_error(GLEV_OUT_OF_MEMORY);
    return nullptr;
  }
  new (payload) Command(command);
  return payload + kSize;
}
