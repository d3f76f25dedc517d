// Whatever floating-point environment the caller has, results have the same bits, and it is the same
// afterwards, flags included.
#include <cfenv>
#include <functional>
#include <limits>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "batches.h"

namespace glev_tests {
namespace {

struct Environment {
  const char* name;
  int rounding = FE_TONEAREST;
  unsigned sse_control = 0x1F80;  // all exceptions masked
  bool has_traps = false;
};

constexpr Environment kDefaultEnvironment = {"default"};
constexpr Environment kHostileEnvironments[] = {
    {"upward", FE_UPWARD},
    {"downward", FE_DOWNWARD},
    {"toward zero", FE_TOWARDZERO},
#if defined(__SSE2__)
    {"flush to zero", FE_TONEAREST, 0x9F80},
    {"denormals are zero", FE_TONEAREST, 0x1FC0},
    {"both", FE_TONEAREST, 0x9FC0},
    {"both and upward", FE_UPWARD, 0x9FC0},
    {"all traps", FE_TONEAREST, 0x0000},
    {"all traps and flags of old", FE_TONEAREST, 0x1F80 | 0x3F},
#endif
#if defined(__GLIBC__)
    {"traps of the C library", FE_DOWNWARD, 0x1F80, true},
#endif
};

// Control and flags.
struct Registers {
  int rounding = 0, flags = 0;
  unsigned sse = 0;
  bool operator==(const Registers&) const = default;
};

Registers ReadRegisters() {
  Registers registers = {std::fegetround(), std::fetestexcept(FE_ALL_EXCEPT)};
#if defined(__SSE2__)
  registers.sse = _mm_getcsr();
#endif
  return registers;
}

// Nothing else that computes with reals may happen while it lives.
class In {
 public:
  explicit In(const Environment& environment) {
    std::feholdexcept(&before_);
#if defined(__SSE2__)
    _mm_setcsr(environment.sse_control);
#endif
    if (environment.rounding != FE_TONEAREST) std::fesetround(environment.rounding);
#if defined(__GLIBC__)
    if (environment.has_traps) feenableexcept(FE_ALL_EXCEPT);
#endif
  }
  In(const In&) = delete;
  In& operator=(const In&) = delete;
  ~In() { std::fesetenv(&before_); }

 private:
  std::fenv_t before_;
};

// Data that round in every way: ties, subnormal results, overflow, cancellation.
struct Data {
  std::vector<float> points, u, v;
  std::vector<double> wide_points, wide_u;
};

Data ChooseData() {
  Chance chance;
  Data data;
  constexpr float kLeast = std::numeric_limits<float>::denorm_min();
  for (int i = 0; i < 4 * 64; ++i) {
    data.points.push_back(chance.OneOf({chance.Between(-2, 2), chance.Between(-2, 2), chance.Between(-2, 2),
                                        static_cast<float>(chance.Whole(-3, 3)), kLeast * 12345, -1e-39F,
                                        std::numeric_limits<float>::min()}));
    data.wide_points.push_back(
        chance.OneOf({chance.Double(), 0x1p-1074 * chance.Whole(1, 1 << 30), -0x1p-1030}));
  }
  for (int i = 0; i < 45; ++i) {
    data.u.push_back(chance.OneOf({chance.Float(), chance.Float(), 0.5F, 1e-40F, -kLeast, 1.5F, 0.0F}));
    data.v.push_back(chance.OneOf({chance.Float(), chance.Float(), 0.25F, 3e-39F, 1.0F}));
    data.wide_u.push_back(chance.OneOf({chance.Double(), 0x1p-1074, 0x1p-1030, 3.0}));
  }
  return data;
}

// Everything that the library does with reals, each call by itself.
class Work {
 public:
  explicit Work(const Data& data) : data_(data) {}

  // Calls after which the environment is another, and vertices that another one than the caller's came with.
  int changed = 0, unlike_the_callers = 0;
  std::vector<Floats> floats;
  std::vector<std::vector<double>> doubles;
  std::vector<glev_vertex> vertices;

  void Do() {
    callers_ = ReadRegisters();
    const glev_sink sink = {sizeof sink, this, nullptr,
                            [](void* user, const glev_vertex* vertex) {
                              auto* self = static_cast<Work*>(user);
                              self->vertices.push_back(*vertex);
                              self->unlike_the_callers += ReadRegisters() != self->callers_;
                            },
                            nullptr};
    Call([&] { glevCreateContext(nullptr, &gl_); });
    glevSetSink(gl_, &sink);
    DefineFloatMaps();
    for (bool automatic : {false, true}) {
      (automatic ? glevEnable : glevDisable)(gl_, GLEV_AUTO_NORMAL);
      Evaluate();
    }
    DefineDoubleMaps();
    Evaluate();
    Lists();
    Query();
    glevDestroyContext(gl_);
  }

 private:
  template <class Function>
  void Call(const Function& function) {
    const Registers before = ReadRegisters();
    function();
    changed += ReadRegisters() != before;
  }

  void DefineFloatMaps() {
    const float* const points = data_.points.data();
    Call([&] { glevMap1f(gl_, GLEV_MAP1_VERTEX_3, 0, 1, 3, 6, points); });
    Call([&] { glevMap1f(gl_, GLEV_MAP1_COLOR_4, 1e-40F, -1e-39F, 4, 4, points); });
    Call([&] { glevMap1f(gl_, GLEV_MAP1_TEXTURE_COORD_2, 0, 0x1p-149F, 2, 9, points); });
    Call([&] { glevMap2f(gl_, GLEV_MAP2_VERTEX_4, 0, 1, 16, 4, 0, 1, 4, 4, points); });
    Call([&] { glevMap2f(gl_, GLEV_MAP2_COLOR_4, 0, 1e-40F, 12, 3, 0, 1, 4, 3, points); });
    Call([&] { glevMap2f(gl_, GLEV_MAP2_NORMAL, 0, 1, 30, 2, -0.3F, 1.7F, 3, 10, points); });
    for (glev_enum target : {GLEV_MAP1_VERTEX_3, GLEV_MAP1_COLOR_4, GLEV_MAP1_TEXTURE_COORD_2,
                             GLEV_MAP2_VERTEX_4, GLEV_MAP2_COLOR_4, GLEV_MAP2_NORMAL})
      Call([&] { glevEnable(gl_, target); });
    Call([&] { glevMapGrid1f(gl_, 7, 0, 0.9F); });
    Call([&] { glevMapGrid2f(gl_, 8, 1e-39F, 1, 3, 0, 1e-40F); });
  }

  void DefineDoubleMaps() {
    const double* const points = data_.wide_points.data();
    Call([&] { glevMap1d(gl_, GLEV_MAP1_VERTEX_3, 0, 0x1p-1070, 3, 6, points); });
    Call([&] { glevMap2d(gl_, GLEV_MAP2_VERTEX_4, 0, 1, 16, 4, 0x1p-1073, 0, 4, 4, points); });
    Call([&] { glevMapGrid1d(gl_, 5, 0x1p-1074, 0x1p-1069); });
    Call([&] { glevMapGrid2d(gl_, 5, 0, 1, 3, 0, 0x1p-1072); });
  }

  void Evaluate() {
    Call([&] { glevBegin(gl_, GLEV_POINTS); });
    for (std::size_t i = 0; i < data_.u.size(); ++i) {
      Call([&] { glevEvalCoord1f(gl_, data_.u[i]); });
      Call([&] { glevEvalCoord1fv(gl_, &data_.u[i]); });
      Call([&] { glevEvalCoord1d(gl_, data_.wide_u[i]); });
      Call([&] { glevEvalCoord2f(gl_, data_.u[i], data_.v[i]); });
      const float uv[] = {data_.u[i], data_.v[i]};
      Call([&] { glevEvalCoord2fv(gl_, uv); });
      Call([&] { glevEvalPoint2(gl_, static_cast<int>(i) - 5, static_cast<int>(i) / 5); });
    }
    Call([&] { glevEnd(gl_); });
    Call([&] { glevEvalMesh1(gl_, GLEV_LINE, -1, 8); });
    Call([&] { glevEvalMesh2(gl_, GLEV_POINT, -1, 9, 0, 3); });
    Call([&] { glevEvalMesh2(gl_, GLEV_LINE, 0, 2, -1, 1); });
    Call([&] { glevEvalMesh2(gl_, GLEV_FILL, 0, 2, 0, 4); });
    glev_plan *curve = nullptr, *surface = nullptr;
    const glev_plan_info one = {sizeof one, 1}, two = {sizeof two, 2};
    Call([&] { glevCreatePlan(gl_, &one, &curve); });
    Call([&] { glevCreatePlan(gl_, &two, &surface); });
    for (glev_attribute attribute : kEveryAttribute) {
      for (glev_precision precision : {GLEV_CORRECTLY_ROUNDED, GLEV_FAST}) {
        if (glevGetPlanComponents(curve, attribute) != 0) {
          Call([&] { floats.push_back(Scattered(curve, attribute, data_.u, {}, precision)); });
          Call([&] { floats.push_back(Scattered(curve, attribute, data_.wide_u, {}, precision)); });
          Call([&] { doubles.push_back(Scattered<double>(curve, attribute, data_.u)); });
          Call([&] { floats.push_back(OfGrid(curve, attribute, {-1, 30}, precision)); });
        }
        if (glevGetPlanComponents(surface, attribute) != 0) {
          Call([&] { floats.push_back(Scattered(surface, attribute, data_.u, data_.v, precision)); });
          Call([&] { doubles.push_back(Scattered<double>(surface, attribute, data_.u, data_.v)); });
          Call([&] { floats.push_back(OfGrid(surface, attribute, {0, 8, 0, 3}, precision)); });
          Call([&] { floats.push_back(OfGrid(surface, attribute, {-3, 18, -1, 5}, precision)); });
          Call([&] { doubles.push_back(OfGrid<double>(surface, attribute, {0, 8, 0, 3})); });
        }
      }
    }
    glevReleasePlan(curve);
    glevReleasePlan(surface);
  }

  void Lists() {
    Call([&] { glevNewList(gl_, 1, GLEV_COMPILE); });
    DefineDoubleMaps();
    DefineFloatMaps();
    Call([&] { glevBegin(gl_, GLEV_POINTS); });
    Call([&] { glevEvalCoord1f(gl_, 1e-39F); });
    Call([&] { glevEnd(gl_); });
    Call([&] { glevEvalMesh2(gl_, GLEV_FILL, 0, 2, 0, 4); });
    Call([&] { glevEndList(gl_); });
    Call([&] { glevCallList(gl_, 1); });
  }

  void Query() {
    // A grid that differs by a subnormal number is another one.
    glevMapGrid1d(gl_, 4, 0, 1);
    glevMap1f(gl_, GLEV_MAP1_VERTEX_3, 0, 0x1p-149F, 3, 6, data_.points.data());
    Call([&] { glevPushAttrib(gl_, GLEV_EVAL_BIT); });
    Call([&] { glevMapGrid1d(gl_, 4, 0x1p-1040, 1); });
    Call([&] { glevEvalMesh1(gl_, GLEV_POINT, 0, 0); });
    Call([&] { glevPopAttrib(gl_); });
    Call([&] { glevEvalMesh1(gl_, GLEV_POINT, 0, 0); });
    Floats domain(2), points(6 * 3);
    Call([&] { glevGetMapfv(gl_, GLEV_MAP1_VERTEX_3, GLEV_DOMAIN, domain.data()); });
    Call([&] { glevGetMapfv(gl_, GLEV_MAP1_VERTEX_3, GLEV_COEFF, points.data()); });
    Floats grid(2);
    glevMapGrid1d(gl_, 4, 1.0 / 3, 1e-40);
    Call([&] { glevGetFloatv(gl_, GLEV_MAP1_GRID_DOMAIN, grid.data()); });
    for (const Floats& values : {domain, points, grid}) floats.push_back(values);
  }

  const Data& data_;
  glev_context* gl_ = nullptr;
  Registers callers_;
};

template <class Lists>
auto BitsOfAll(const Lists& lists) {
  std::vector<std::vector<std::uint64_t>> bits;
  for (const auto& list : lists) bits.push_back(BitsOf(list));
  return bits;
}

TEST(HostileEnvironment, ChangesNoBitAndIsNotChanged) {
  const Data data = ChooseData();
  Work usual(data);
  {
    const In environment(kDefaultEnvironment);
    usual.Do();
  }
  EXPECT_EQ(usual.vertices.size() > 500, true);
  for (const Environment& hostile : kHostileEnvironments) {
    Work work(data);
    Registers before, after;
    {
      const In environment(hostile);
      before = ReadRegisters();
      work.Do();
      after = ReadRegisters();
    }
    EXPECT_TRUE(before == after) << hostile.name;
    EXPECT_EQ(work.changed, 0) << hostile.name;
    EXPECT_EQ(work.unlike_the_callers, 0) << hostile.name;
    const auto floats = BitsOfAll(work.floats), usual_floats = BitsOfAll(usual.floats);
    for (std::size_t i = 0; i < floats.size(); ++i)
      EXPECT_EQ(floats[i], usual_floats[i]) << hostile.name << " " << i;
    EXPECT_EQ(BitsOfAll(work.doubles), BitsOfAll(usual.doubles)) << hostile.name;
    ASSERT_EQ(work.vertices.size(), usual.vertices.size()) << hostile.name;
    std::size_t different = 0;
    for (std::size_t i = 0; i < work.vertices.size(); ++i) {
      for (glev_attribute attribute : kEveryAttribute)
        different += BitsOf(AttributeOf(work.vertices[i], attribute)) !=
                     BitsOf(AttributeOf(usual.vertices[i], attribute));
    }
    EXPECT_EQ(different, 0u) << hostile.name;
  }
}

}  // namespace
}  // namespace glev_tests
