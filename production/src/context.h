// The evaluator part of the GL's state machine.
#pragma once

#include <array>
#include <cstdint>

#include <glevaluator.h>

#include "production/src/allocator.h"
#include "production/src/map.h"
#include "production/src/parameter.h"
#include "production/src/plan.h"
#include "production/src/row.h"
#include "production/src/target.h"

namespace glev {

// What PushAttrib(EVAL_BIT) would save: copyable, without the map specifications (GL table 23.40).
struct EvalAttributes {
  // [dimension - 1]
  std::array<std::array<bool, kSlots>, 2> enabled{};
  std::array<std::array<Grid, 2>, 2> grid;  // u, v; one-dimensional maps have no use for v
  bool auto_normal = false;
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
  explicit glev_context(const glev::Allocator& allocator);
  ~glev_context();
  glev_context(const glev_context&) = delete;
  glev_context& operator=(const glev_context&) = delete;

  const glev::Allocator& allocator() const { return allocator_; }

  void RecordError(glev_enum error) {
    if (error_ == GLEV_NO_ERROR) error_ = error;
  }
  glev_enum GetError();

  // u, and for dimension 2 v.
  template <class Real>
  void DefineMap(int dimension, glev_enum target, const std::array<glev::MapDirection<Real>, 2>& directions,
                 const Real* points);
  template <class Number>
  void GetMap(glev_enum target, glev_enum query, Number* v);
  void SetEnabled(glev_enum cap, bool enabled);
  bool IsEnabled(glev_enum cap);
  void SetGrid(int dimension, const std::array<glev::Grid, 2>& grid);
  void EvalCoord(int dimension, double u, double v);
  void EvalPoint(int dimension, glev_int i, glev_int j);
  void EvalMesh1(glev_enum mode, glev_int i1, glev_int i2);
  void EvalMesh2(glev_enum mode, glev_int i1, glev_int i2, glev_int j1, glev_int j2);

  void Begin(glev_enum mode);
  void End();
  void Vertex(const std::array<float, 4>& position);
  void Color(const std::array<float, 4>& color);
  void Normal(const std::array<float, 3>& normal);
  void Index(float index) { current_.index = index; }
  void EdgeFlag(bool flag) { current_.edge_flag = flag ? GLEV_TRUE : GLEV_FALSE; }
  void MultiTexCoord(glev_enum texture, const std::array<float, 4>& texcoord);
  void ActiveTexture(glev_enum texture);

  template <class Number>
  void Get(glev_enum pname, Number* v);
  const char* GetString(glev_enum name);

  glev_result SetSink(const glev_sink* sink);

  // The plan of the maps as they are now, without a reference of its own for the caller. Null without memory.
  glev_plan* CurrentPlan(int dimension);

 private:
  // True, and INVALID_OPERATION recorded, between Begin and End.
  bool RefusedInPrimitive();
  // The flag a capability stands for; null if there is none.
  bool* FindFlag(glev_enum cap);
  // count 0 if there is no such state.
  glev::StateValues FindState(glev_enum pname);
  void DropPlan(int dimension);
  // The plan to draw with; null if there is no vertex map, or, with the error, no memory.
  const glev_plan* PlanToDraw(int dimension);
  // The evaluated vertex at u of the row.
  template <class Argument>
  void EmitRow(const glev::Row& row, const Argument& u);
  template <class Argument>
  void EvaluateAt(int dimension, const Argument& u, const Argument& v);
  // A primitive of a mesh: what is drawn by `body`, between Begin and End.
  template <class Body>
  void MeshPrimitive(glev_enum mode, const Body& body);
  void Emit(const glev_vertex& vertex) const;

  glev::Allocator allocator_;
  glev_enum error_ = GLEV_NO_ERROR;
  std::array<std::array<glev::Map, glev::kSlots>, 2> maps_;  // [dimension - 1]
  glev::EvalAttributes eval_;
  std::array<glev_plan*, 2> plans_{};  // [dimension - 1]; null when out of date
  glev_vertex current_{};              // current values; position is not state
  unsigned active_unit_ = 0;
  bool in_primitive_ = false;
  bool in_mesh_ = false;  // the primitive is a mesh's, not for a callback to end
  glev_sink sink_{};
};
