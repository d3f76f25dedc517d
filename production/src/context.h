// The evaluator part of the GL's state machine.
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
#include "normal.h"
#include "parameter.h"
#include "plan.h"
#include "target.h"

namespace glev {

inline constexpr int kMaxListNesting = 64;

// The list between NewList and EndList.
struct OpenList {
  glev_uint name = 0;  // 0 and mode 0: none is open
  glev_enum mode = 0;
  bool broken = false;  // a command found no memory
  DisplayList list;
};

// The answer to a Get: up to four values of state.
struct StateValues {
  int count;
  std::array<double, 4> values;
  bool normalized = false;  // RGBA or normal, see convert()
};

}  // namespace glev

// The methods are the commands, after the form of their arguments (f, d, v) is gone. Errors that depend on
// arguments alone come first, then those that depend on state (GL §2.3.1).
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

  // Takes a command that lists can hold: it goes into the list that is open, it is
  // executed, or both. The commands are those of command.h.
  template <class Command>
  void issue(const Command& command) {
    if (is_compiling()) {
      compile(command);
      if (open_.mode == GLEV_COMPILE) return;
    }
    command.run(*this);
  }
  // The same for the two whose arrays are read at once.
  template <class Real>
  void issue_define_map(int dimension, glev_enum target, const std::array<glev::MapDirection, 2>& directions,
                        const Real* points);
  void issue_call_lists(glev_int count, glev_enum type, const void* offsets);

  // u, and for dimension 2 v.
  template <class Real>
  void define_map(int dimension, glev_enum target, const std::array<glev::MapDirection, 2>& directions,
                  const Real* points);
  // At most `bytes` bytes go to v.
  template <class Number>
  void get_map(glev_enum target, glev_enum query, std::uint64_t bytes, Number* v);
  template <class Number>
  void getn_map(glev_enum target, glev_enum query, glev_int bytes, Number* v);
  void set_enabled(glev_enum cap, bool enabled);
  bool is_enabled(glev_enum cap);
  void set_grid(int dimension, const std::array<glev::Grid, 2>& grid);
  void eval_coord(int dimension, double u, double v);
  // The same in the most frequent case: one call after another between Begin and End. False, and nothing
  // done, elsewhere.
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

  // Flush and Finish: nothing is ever pending.
  void flush() { is_rejected_in_primitive(); }

  template <class Number>
  void get(glev_enum pname, Number* v);
  const char* get_string(glev_enum name);

  glev_result set_sink(const glev_sink* sink);

  // The plan of the maps as they are now, without a reference of its own for the caller. Null without memory.
  glev_plan* current_plan(int dimension);

 private:
  // True, and INVALID_OPERATION recorded, between Begin and End.
  bool is_rejected_in_primitive();
  // The same, also in callbacks: lists stay as they are while one may be executing.
  bool is_rejected_with_lists();
  // Commands of a callback are not compiled: executing the list will make it give them again.
  bool is_compiling() const { return open_.mode != 0 && callbacks_ == 0; }
  // Appends to the open list: the command, and bytes for the caller to fill. Null, with the list broken,
  // without memory.
  template <class Command>
  void* compile(const Command& command, std::uint64_t more_bytes = 0);
  // The flag a capability stands for; null if there is none.
  bool* find_flag(glev_enum cap);
  // count 0 if there is no such state.
  glev::StateValues find_state(glev_enum pname);
  void drop_plan(int dimension);
  // Returns true if the next call may be one of eval_directly.
  bool is_direct(const glev_plan& plan) const;
  // The plan to draw with; null if there is no vertex map, or, with the error, no memory.
  const glev_plan* plan_to_draw(int dimension);
  // The evaluated vertex at u of the row.
  void emit_row(const glev::NormalRow& row, const glev::GridArgument& u);
  // The same at (u, v): row is where v is, or null if nothing of the plan needs one.
  void emit_at(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v,
               const glev::NormalRow* row);
  void emit_within(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v,
                   const glev::NormalRow* row);
  void evaluate_into(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v,
                     const glev::NormalRow* row, glev_vertex* vertex) const;
  void evaluate_with_row(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v);
  static void move_to(const glev::GridArgument& v, glev::NormalRow* row);
  void evaluate_at(int dimension, const glev::GridArgument& u, const glev::GridArgument& v);
  // A primitive of a mesh: what is drawn by `body`, between Begin and End.
  template <class Body>
  void mesh_primitive(glev_enum mode, const Body& body);
  // Meshes of plans with nothing but vertices, of which many are evaluated at a time.
  void mesh_of_vertices(const glev_plan& plan, glev_enum mode, std::int64_t i1, std::int64_t i2,
                        std::int64_t j1, std::int64_t j2);
  // The points from `first` to `last` of row or column `other`.
  void emit_line(const glev_plan& plan, bool is_column, std::int64_t other, std::int64_t first,
                 std::int64_t last);
  void emit_position(const glev_plan& plan, const float (&position)[4]);
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
  std::array<glev_plan*, 2> plans_{};  // [dimension - 1]; null when out of date
  glev::CurrentVertex current_;
  unsigned active_unit_ = 0;
  bool in_primitive_ = false;
  bool in_mesh_ = false;                      // the primitive is a mesh's, not for a callback to end
  bool in_default_environment_ = false;       // when the primitive began
  std::array<const glev_plan*, 2> direct_{};  // [dimension - 1]; what eval_directly evaluates, else null
  glev_sink sink_{};
  int callbacks_ = 0;  // of the sink, being called
  int attrib_depth_ = 0;
  std::array<glev::SavedAttributes, glev::kAttribStackDepth> attribs_;
  glev::ListTable lists_;
  glev::OpenList open_;
  glev_uint list_base_ = 0;
  int list_depth_ = 0;  // lists being executed
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
void* glev_context::compile(const Command& command, std::uint64_t more_bytes) {
  static_assert(std::is_trivially_copyable_v<Command> && alignof(Command) <= glev::kListUnit);
  constexpr std::uint64_t kSize = glev::round_up_to_list_unit(sizeof(Command));
  if (open_.broken) return nullptr;
  std::byte* payload = open_.list.append(allocator_, Command::kOpcode, kSize + more_bytes);
  if (payload == nullptr) {
    open_.broken = true;
    record_error(GLEV_OUT_OF_MEMORY);
    return nullptr;
  }
  new (payload) Command(command);
  return payload + kSize;
}
