// The evaluator part of the GL's state machine.
#pragma once

#include <array>

#include <glevaluator.h>

#include "production/src/allocator.h"
#include "production/src/map.h"
#include "production/src/parameter.h"
#include "production/src/plan.h"
#include "production/src/target.h"

namespace glev {

// What PushAttrib(EVAL_BIT) would save: copyable, without the map specifications (GL table 23.40).
struct EvalAttributes {
  std::array<bool, kSlots> map1_enabled{};
  std::array<bool, kSlots> map2_enabled{};
  bool auto_normal = false;
  Grid grid1;
  std::array<Grid, 2> grid2;  // u, v
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

  template <class Real>
  void Map1(glev_enum target, Real u1, Real u2, glev_int stride, glev_int order, const Real* points);
  template <class Number>
  void GetMap(glev_enum target, glev_enum query, Number* v);
  void SetEnabled(glev_enum cap, bool enabled);
  bool IsEnabled(glev_enum cap);
  void EvalCoord1(double u);

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
  glev_plan* CurrentPlan1();

 private:
  // True, and INVALID_OPERATION recorded, between Begin and End.
  bool RefusedInPrimitive();
  // The flag a capability stands for; null if there is none.
  bool* FindFlag(glev_enum cap);
  // count 0 if there is no such state.
  glev::StateValues FindState(glev_enum pname);
  void DropPlan1();
  void Emit(const glev_vertex& vertex) const;

  glev::Allocator allocator_;
  glev_enum error_ = GLEV_NO_ERROR;
  std::array<glev::Map, glev::kSlots> maps1_, maps2_;
  glev::EvalAttributes eval_;
  glev_plan* plan1_ = nullptr;  // null when out of date
  glev_vertex current_{};       // current values; position is not state
  unsigned active_unit_ = 0;
  bool in_primitive_ = false;
  glev_sink sink_{};
};
