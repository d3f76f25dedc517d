// Tests that results have the same bits in every floating-point environment of the caller, and that the
// environment, flags included, does not change.
#include <cfenv>
#include <functional>
#include <limits>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "batches.h"

namespace glev_tests {
namespace {

// The control register of the processor, with its flags if they are in the same register.
#if defined(__SSE2__)
constexpr unsigned kDefaultControl = 0x1F80;  // all exceptions masked
unsigned read_control() { return _mm_getcsr(); }
void write_control(unsigned value) { _mm_setcsr(value); }
#elif defined(__aarch64__)
constexpr unsigned kDefaultControl = 0;
unsigned read_control() {
  std::uint64_t value;
  asm volatile("mrs %0, fpcr" : "=r"(value));
  return static_cast<unsigned>(value);
}
void write_control(unsigned value) { asm volatile("msr fpcr, %0" : : "r"(std::uint64_t{value}) : "memory"); }
#else
constexpr unsigned kDefaultControl = 0;
unsigned read_control() { return 0; }
void write_control(unsigned) {}
#endif

struct Environment {
  const char* name;
  int rounding = FE_TONEAREST;
  unsigned control = kDefaultControl;
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
#elif defined(__aarch64__)
    {"flush to zero", FE_TONEAREST, 1 << 24},
    {"default NaN", FE_TONEAREST, 1 << 25},
    {"both and upward", FE_UPWARD, 3 << 24},
#endif
#if defined(__GLIBC__)
    {"traps of the C library", FE_DOWNWARD, kDefaultControl, true},
#endif
};

// The control and flag registers.
struct Registers {
  int rounding, flags;
  unsigned control;
  bool operator==(const Registers&) const = default;
};

Registers read_registers() { return {std::fegetround(), std::fetestexcept(FE_ALL_EXCEPT), read_control()}; }

// Sets an environment during its lifetime. Other floating-point computations must not run meanwhile.
class In {
 public:
  explicit In(const Environment& environment) {
    std::feholdexcept(&before_);
    write_control(environment.control);
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

// Data with all kinds of rounding: ties, subnormal results, overflow, cancellation.
struct Data {
  std::vector<float> points, u, v;
  std::vector<double> wide_points, wide_u;
};

Data choose_data() {
  Chance chance;
  Data data;
  constexpr float kLeast = std::numeric_limits<float>::denorm_min();
  for (int i = 0; i < 4 * 64; ++i) {
    data.points.push_back(chance.one_of({chance.between(-2, 2), chance.between(-2, 2), chance.between(-2, 2),
                                         static_cast<float>(chance.whole(-3, 3)), kLeast * 12345, -1e-39F,
                                         std::numeric_limits<float>::min()}));
    data.wide_points.push_back(
        chance.one_of({chance.next_double(), 0x1p-1074 * chance.whole(1, 1 << 30), -0x1p-1030}));
  }
  for (int i = 0; i < 45; ++i) {
    data.u.push_back(
        chance.one_of({chance.next_float(), chance.next_float(), 0.5F, 1e-40F, -kLeast, 1.5F, 0.0F}));
    data.v.push_back(chance.one_of({chance.next_float(), chance.next_float(), 0.25F, 3e-39F, 1.0F}));
    data.wide_u.push_back(chance.one_of({chance.next_double(), 0x1p-1074, 0x1p-1030, 3.0}));
  }
  return data;
}

// Makes all calls of the library that compute with floating-point numbers, and keeps their results.
class Work {
 public:
  explicit Work(const Data& data) : data_(data) {}

  // Number of calls that changed the environment, and of vertices that were sent in another environment than
  // the caller's.
  int changed = 0, unlike_the_callers = 0;
  std::vector<Floats> floats;
  std::vector<std::vector<double>> doubles;
  std::vector<glev_vertex> vertices;

  void run_all() {
    callers_ = read_registers();
    const glev_sink sink = {sizeof sink, this, nullptr,
                            [](void* user, const glev_vertex* vertex) {
                              auto* self = static_cast<Work*>(user);
                              self->vertices.push_back(*vertex);
                              self->unlike_the_callers += read_registers() != self->callers_;
                            },
                            nullptr};
    call([&] { glevCreateContext(nullptr, &gl_); });
    glevSetSink(gl_, &sink);
    define_float_maps();
    for (bool automatic : {false, true}) {
      (automatic ? glevEnable : glevDisable)(gl_, GLEV_AUTO_NORMAL);
      evaluate();
    }
    define_double_maps();
    evaluate();
    run_lists();
    run_queries();
    glevDestroyContext(gl_);
  }

 private:
  template <class Function>
  void call(const Function& function) {
    const Registers before = read_registers();
    function();
    changed += read_registers() != before;
  }

  void define_float_maps() {
    const float* const points = data_.points.data();
    call([&] { glevMap1f(gl_, GLEV_MAP1_VERTEX_3, 0, 1, 3, 6, points); });
    call([&] { glevMap1f(gl_, GLEV_MAP1_COLOR_4, 1e-40F, -1e-39F, 4, 4, points); });
    call([&] { glevMap1f(gl_, GLEV_MAP1_TEXTURE_COORD_2, 0, 0x1p-149F, 2, 9, points); });
    call([&] { glevMap2f(gl_, GLEV_MAP2_VERTEX_4, 0, 1, 16, 4, 0, 1, 4, 4, points); });
    call([&] { glevMap2f(gl_, GLEV_MAP2_COLOR_4, 0, 1e-40F, 12, 3, 0, 1, 4, 3, points); });
    call([&] { glevMap2f(gl_, GLEV_MAP2_NORMAL, 0, 1, 30, 2, -0.3F, 1.7F, 3, 10, points); });
    for (glev_enum target : {GLEV_MAP1_VERTEX_3, GLEV_MAP1_COLOR_4, GLEV_MAP1_TEXTURE_COORD_2,
                             GLEV_MAP2_VERTEX_4, GLEV_MAP2_COLOR_4, GLEV_MAP2_NORMAL})
      call([&] { glevEnable(gl_, target); });
    call([&] { glevMapGrid1f(gl_, 7, 0, 0.9F); });
    call([&] { glevMapGrid2f(gl_, 8, 1e-39F, 1, 3, 0, 1e-40F); });
  }

  void define_double_maps() {
    const double* const points = data_.wide_points.data();
    call([&] { glevMap1d(gl_, GLEV_MAP1_VERTEX_3, 0, 0x1p-1070, 3, 6, points); });
    call([&] { glevMap2d(gl_, GLEV_MAP2_VERTEX_4, 0, 1, 16, 4, 0x1p-1073, 0, 4, 4, points); });
    call([&] { glevMapGrid1d(gl_, 5, 0x1p-1074, 0x1p-1069); });
    call([&] { glevMapGrid2d(gl_, 5, 0, 1, 3, 0, 0x1p-1072); });
  }

  void evaluate() {
    call([&] { glevBegin(gl_, GLEV_POINTS); });
    for (std::size_t i = 0; i < data_.u.size(); ++i) {
      call([&] { glevEvalCoord1f(gl_, data_.u[i]); });
      call([&] { glevEvalCoord1fv(gl_, &data_.u[i]); });
      call([&] { glevEvalCoord1d(gl_, data_.wide_u[i]); });
      call([&] { glevEvalCoord2f(gl_, data_.u[i], data_.v[i]); });
      const float uv[] = {data_.u[i], data_.v[i]};
      call([&] { glevEvalCoord2fv(gl_, uv); });
      call([&] { glevEvalPoint2(gl_, static_cast<int>(i) - 5, static_cast<int>(i) / 5); });
    }
    call([&] { glevEnd(gl_); });
    call([&] { glevEvalMesh1(gl_, GLEV_LINE, -1, 8); });
    call([&] { glevEvalMesh2(gl_, GLEV_POINT, -1, 9, 0, 3); });
    call([&] { glevEvalMesh2(gl_, GLEV_LINE, 0, 2, -1, 1); });
    call([&] { glevEvalMesh2(gl_, GLEV_FILL, 0, 2, 0, 4); });
    glev_plan *curve = nullptr, *surface = nullptr;
    const glev_plan_info one = {sizeof one, 1}, two = {sizeof two, 2};
    call([&] { glevCreatePlan(gl_, &one, &curve); });
    call([&] { glevCreatePlan(gl_, &two, &surface); });
    for (glev_attribute attribute : kEveryAttribute) {
      for (glev_precision precision : {GLEV_CORRECTLY_ROUNDED, GLEV_FAST}) {
        if (glevGetPlanComponents(curve, attribute) != 0) {
          call([&] { floats.push_back(evaluate_scattered(curve, attribute, data_.u, {}, precision)); });
          call([&] { floats.push_back(evaluate_scattered(curve, attribute, data_.wide_u, {}, precision)); });
          call([&] { doubles.push_back(evaluate_scattered<double>(curve, attribute, data_.u)); });
          call([&] { floats.push_back(evaluate_grid(curve, attribute, {-1, 30}, precision)); });
        }
        if (glevGetPlanComponents(surface, attribute) != 0) {
          call(
              [&] { floats.push_back(evaluate_scattered(surface, attribute, data_.u, data_.v, precision)); });
          call([&] { doubles.push_back(evaluate_scattered<double>(surface, attribute, data_.u, data_.v)); });
          call([&] { floats.push_back(evaluate_grid(surface, attribute, {0, 8, 0, 3}, precision)); });
          call([&] { floats.push_back(evaluate_grid(surface, attribute, {-3, 18, -1, 5}, precision)); });
          call([&] { doubles.push_back(evaluate_grid<double>(surface, attribute, {0, 8, 0, 3})); });
        }
      }
    }
    glevReleasePlan(curve);
    glevReleasePlan(surface);
  }

  void run_lists() {
    call([&] { glevNewList(gl_, 1, GLEV_COMPILE); });
    define_double_maps();
    define_float_maps();
    call([&] { glevBegin(gl_, GLEV_POINTS); });
    call([&] { glevEvalCoord1f(gl_, 1e-39F); });
    call([&] { glevEnd(gl_); });
    call([&] { glevEvalMesh2(gl_, GLEV_FILL, 0, 2, 0, 4); });
    call([&] { glevEndList(gl_); });
    call([&] { glevCallList(gl_, 1); });
  }

  void run_queries() {
    // A grid that differs from the domain by a subnormal number does not span it.
    glevMapGrid1d(gl_, 4, 0, 1);
    glevMap1f(gl_, GLEV_MAP1_VERTEX_3, 0, 0x1p-149F, 3, 6, data_.points.data());
    call([&] { glevPushAttrib(gl_, GLEV_EVAL_BIT); });
    call([&] { glevMapGrid1d(gl_, 4, 0x1p-1040, 1); });
    call([&] { glevEvalMesh1(gl_, GLEV_POINT, 0, 0); });
    call([&] { glevPopAttrib(gl_); });
    call([&] { glevEvalMesh1(gl_, GLEV_POINT, 0, 0); });
    Floats domain(2), points(6 * 3);
    call([&] { glevGetMapfv(gl_, GLEV_MAP1_VERTEX_3, GLEV_DOMAIN, domain.data()); });
    call([&] { glevGetMapfv(gl_, GLEV_MAP1_VERTEX_3, GLEV_COEFF, points.data()); });
    Floats grid(2);
    glevMapGrid1d(gl_, 4, 1.0 / 3, 1e-40);
    call([&] { glevGetFloatv(gl_, GLEV_MAP1_GRID_DOMAIN, grid.data()); });
    for (const Floats& values : {domain, points, grid}) floats.push_back(values);
  }

  const Data& data_;
  glev_context* gl_ = nullptr;
  Registers callers_{};
};

template <class Lists>
auto bits_of_all(const Lists& lists) {
  std::vector<std::vector<std::uint64_t>> bits;
  for (const auto& list : lists) bits.push_back(bits_of(list));
  return bits;
}

TEST(HostileEnvironment, ChangesNoBitAndIsNotChanged) {
  const Data data = choose_data();
  Work usual(data);
  {
    const In environment(kDefaultEnvironment);
    usual.run_all();
  }
  EXPECT_EQ(usual.vertices.size() > 500, true);
  for (const Environment& hostile : kHostileEnvironments) {
    Work work(data);
    Registers before{}, after{};
    {
      const In environment(hostile);
      before = read_registers();
      work.run_all();
      after = read_registers();
    }
    EXPECT_TRUE(before == after) << hostile.name;
    EXPECT_EQ(work.changed, 0) << hostile.name;
    EXPECT_EQ(work.unlike_the_callers, 0) << hostile.name;
    const auto floats = bits_of_all(work.floats), usual_floats = bits_of_all(usual.floats);
    for (std::size_t i = 0; i < floats.size(); ++i)
      EXPECT_EQ(floats[i], usual_floats[i]) << hostile.name << " " << i;
    EXPECT_EQ(bits_of_all(work.doubles), bits_of_all(usual.doubles)) << hostile.name;
    ASSERT_EQ(work.vertices.size(), usual.vertices.size()) << hostile.name;
    std::size_t different = 0;
    for (std::size_t i = 0; i < work.vertices.size(); ++i) {
      for (glev_attribute attribute : kEveryAttribute)
        different += bits_of(attribute_of(work.vertices[i], attribute)) !=
                     bits_of(attribute_of(usual.vertices[i], attribute));
    }
    EXPECT_EQ(different, 0u) << hostile.name;
  }
}

}  // namespace
}  // namespace glev_tests
