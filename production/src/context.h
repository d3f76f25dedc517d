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
  bool normalized = false;  // RGBA or normal, see Convert
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

  void RecordError(glev_enum error) {
    if (error_ == GLEV_NO_ERROR) error_ = error;
  }
  glev_enum GetError();

  // What a command that lists can hold does when it is given: it goes into the list that is open, it is
  // executed, or both. The commands are those of command.h.
  template <class Command>
  void Issue(const Command& command) {
    if (IsCompiling()) {
      Compile(command);
      if (open_.mode == GLEV_COMPILE) return;
    }
    command.Run(*this);
  }
  // The same for the two whose arrays are read at once.
  template <class Real>
  void IssueDefineMap(int dimension, glev_enum target, const std::array<glev::MapDirection, 2>& directions,
                      const Real* points);
  void IssueCallLists(glev_int count, glev_enum type, const void* offsets);

  // u, and for dimension 2 v.
  template <class Real>
  void DefineMap(int dimension, glev_enum target, const std::array<glev::MapDirection, 2>& directions,
                 const Real* points);
  // At most `bytes` bytes go to v.
  template <class Number>
  void GetMap(glev_enum target, glev_enum query, std::uint64_t bytes, Number* v);
  template <class Number>
  void GetnMap(glev_enum target, glev_enum query, glev_int bytes, Number* v);
  void SetEnabled(glev_enum cap, bool enabled);
  bool IsEnabled(glev_enum cap);
  void SetGrid(int dimension, const std::array<glev::Grid, 2>& grid);
  void EvalCoord(int dimension, double u, double v);
  // The same in the most frequent case: one call after another between Begin and End. False, and nothing
  // done, elsewhere.
  bool EvalDirectly(int dimension, double u, double v);
  void EvalPoint(int dimension, glev_int i, glev_int j);
  void EvalMesh1(glev_enum mode, glev_int i1, glev_int i2);
  void EvalMesh2(glev_enum mode, glev_int i1, glev_int i2, glev_int j1, glev_int j2);

  void Begin(glev_enum mode);
  void End();
  void Vertex(const std::array<float, 4>& position);
  void Color(const std::array<float, 4>& color);
  void Normal(const std::array<float, 3>& normal);
  void Index(float index) { current_.Change().index = index; }
  void EdgeFlag(bool flag) { current_.Change().edge_flag = flag ? GLEV_TRUE : GLEV_FALSE; }
  void MultiTexCoord(glev_enum texture, const std::array<float, 4>& texcoord);
  void ActiveTexture(glev_enum texture);

  void PushAttrib(glev_bitfield mask);
  void PopAttrib();

  void NewList(glev_uint list, glev_enum mode);
  void EndList();
  void CallList(glev_uint list);
  void CallLists(glev_int count, glev_enum type, const void* offsets);
  void ListBase(glev_uint base);
  glev_uint GenLists(glev_int range);
  bool IsList(glev_uint list);
  void DeleteLists(glev_uint list, glev_int range);

  // Flush and Finish: nothing is ever pending.
  void Flush() { RefusedInPrimitive(); }

  template <class Number>
  void Get(glev_enum pname, Number* v);
  const char* GetString(glev_enum name);

  glev_result SetSink(const glev_sink* sink);

  // The plan of the maps as they are now, without a reference of its own for the caller. Null without memory.
  glev_plan* CurrentPlan(int dimension);

 private:
  // True, and INVALID_OPERATION recorded, between Begin and End.
  bool RefusedInPrimitive();
  // The same, also in callbacks: lists stay as they are while one may be executing.
  bool RefusedWithLists();
  // Commands of a callback are not compiled: executing the list will make it give them again.
  bool IsCompiling() const { return open_.mode != 0 && callbacks_ == 0; }
  // Appends to the open list: the command, and bytes for the caller to fill. Null, with the list broken,
  // without memory.
  template <class Command>
  void* Compile(const Command& command, std::uint64_t more_bytes = 0);
  // The flag a capability stands for; null if there is none.
  bool* FindFlag(glev_enum cap);
  // count 0 if there is no such state.
  glev::StateValues FindState(glev_enum pname);
  void DropPlan(int dimension);
  // Whether the next call may be one of EvalDirectly.
  bool IsDirect(const glev_plan& plan) const;
  // The plan to draw with; null if there is no vertex map, or, with the error, no memory.
  const glev_plan* PlanToDraw(int dimension);
  // The evaluated vertex at u of the row.
  void EmitRow(const glev::NormalRow& row, const glev::GridArgument& u);
  // The same at (u, v): row is where v is, or null if nothing of the plan needs one.
  void EmitAt(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v,
              const glev::NormalRow* row);
  void EmitWithin(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v,
                  const glev::NormalRow* row);
  void EvaluateInto(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v,
                    const glev::NormalRow* row, glev_vertex* vertex) const;
  void EvaluateWithRow(const glev_plan& plan, const glev::GridArgument& u, const glev::GridArgument& v);
  static void MoveTo(const glev::GridArgument& v, glev::NormalRow* row);
  void EvaluateAt(int dimension, const glev::GridArgument& u, const glev::GridArgument& v);
  // A primitive of a mesh: what is drawn by `body`, between Begin and End.
  template <class Body>
  void MeshPrimitive(glev_enum mode, const Body& body);
  void Emit(const glev_vertex& vertex) { CallSink(sink_.vertex, &vertex); }
  template <class Callback, class... Arguments>
  void CallSink(Callback callback, Arguments... arguments) {
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
  std::array<const glev_plan*, 2> direct_{};  // [dimension - 1]; what EvalDirectly evaluates, else null
  glev_sink sink_{};
  int callbacks_ = 0;  // of the sink, being called
  int attrib_depth_ = 0;
  std::array<glev::SavedAttributes, glev::kAttribStackDepth> attribs_;
  glev::ListTable lists_;
  glev::OpenList open_;
  glev_uint list_base_ = 0;
  int list_depth_ = 0;  // lists being executed
};

inline bool glev_context::EvalDirectly(int dimension, double u, double v) {
  const glev_plan* plan = direct_[dimension - 1];
  if (plan == nullptr || callbacks_ != 0) return false;
  glev_vertex* vertex = current_.FindStagedFor(plan);
  if (vertex == nullptr || !plan->direct()(*plan, u, v, vertex->position)) return false;
  Emit(*vertex);
  return true;
}

template <class Command>
void* glev_context::Compile(const Command& command, std::uint64_t more_bytes) {
  static_assert(std::is_trivially_copyable_v<Command> && alignof(Command) <= glev::kListUnit);
  constexpr std::uint64_t kSize = glev::RoundUpToListUnit(sizeof(Command));
  if (open_.broken) return nullptr;
  std::byte* payload = open_.list.Append(allocator_, Command::kOpcode, kSize + more_bytes);
  if (payload == nullptr) {
    open_.broken = true;
    RecordError(GLEV_OUT_OF_MEMORY);
    return nullptr;
  }
  new (payload) Command(command);
  return payload + kSize;
}
