// The functions of "float Horner".
#include "float_horner.h"

namespace evalcts::bench {
namespace {

constexpr int kMaxOrder = 64, kMaxComponents = 4;

// Reciprocals of integers. Divisions would take most of the time.
struct Reciprocals {
  float of[kMaxOrder];
  Reciprocals() : of() {
    for (int i = 1; i < kMaxOrder; ++i) of[i] = 1.0F / static_cast<float>(i);
  }
};
const Reciprocals kReciprocals;

// Runs de Casteljau's construction of `order` points, `stride` apart, in place, until two points are left.
void reduce_to_two(float* points, int order, int stride, int components, float t) {
  const float s = 1 - t;
  for (int left = order - 1; left >= 2; --left) {
    for (int i = 0; i < left; ++i) {
      float* const p = points + i * stride;
      for (int k = 0; k < components; ++k) p[k] = s * p[k] + t * p[stride + k];
    }
  }
}

}  // namespace

[[gnu::noinline]] void horner_curve(const float* points, int order, int components, float u, float* result) {
  if (order == 1) {
    for (int k = 0; k < components; ++k) result[k] = points[k];
    return;
  }
  const float s = 1 - u;
  float binomial = static_cast<float>(order - 1);
  for (int k = 0; k < components; ++k) result[k] = s * points[k] + binomial * u * points[components + k];
  float power = u * u;
  const float* point = points + 2 * components;
  for (int i = 2; i < order; ++i, power *= u, point += components) {
    binomial *= static_cast<float>(order - i);
    binomial *= kReciprocals.of[i];
    const float weight = binomial * power;
    for (int k = 0; k < components; ++k) result[k] = s * result[k] + weight * point[k];
  }
}

// Evaluates the surface in one direction, which gives the control points of a curve in the other direction.
[[gnu::noinline]] void horner_surface(const float* points, int u_order, int v_order, int components, float u,
                                      float v, float* result) {
  float curve[kMaxOrder * kMaxComponents];
  for (int j = 0; j < v_order; ++j)
    horner_curve(points + j * u_order * components, u_order, components, u, curve + j * components);
  horner_curve(curve, v_order, components, v, result);
}

[[gnu::noinline]] void de_casteljau_surface(const float* points, int u_order, int v_order, int components,
                                            float u, float v, float* result, float* along_u, float* along_v) {
  float net[kMaxOrder * kMaxOrder * kMaxComponents];
  const int row = u_order * components;
  for (int i = 0; i < v_order * row; ++i) net[i] = points[i];
  for (int j = 0; j < v_order; ++j) reduce_to_two(net + j * row, u_order, components, components, u);
  for (int i = 0; i < 2; ++i) reduce_to_two(net + i * components, v_order, row, components, v);
  for (int k = 0; k < components; ++k) {
    const float p00 = net[k], p10 = net[components + k], p01 = net[row + k], p11 = net[row + components + k];
    along_u[k] = (1 - v) * (p10 - p00) + v * (p11 - p01);
    along_v[k] = (1 - u) * (p01 - p00) + u * (p11 - p10);
    result[k] = (1 - v) * ((1 - u) * p00 + u * p10) + v * ((1 - u) * p01 + u * p11);
  }
}

[[gnu::noinline]] void horner_eval_coord1(Immediate& context, float u) {
  horner_curve(context.points, context.order, context.components, (u - context.u1) * context.u_scale,
               context.vertex.position);
  context.sink.vertex(context.sink.user, &context.vertex);
}

[[gnu::noinline]] void horner_eval_coord2(Immediate& context, float u, float v) {
  horner_surface(context.points, context.order, context.order, context.components,
                 (u - context.u1) * context.u_scale, (v - context.v1) * context.v_scale,
                 context.vertex.position);
  context.sink.vertex(context.sink.user, &context.vertex);
}

}  // namespace evalcts::bench
