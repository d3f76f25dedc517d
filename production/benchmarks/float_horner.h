// "float Horner": the method of GL libraries. Horner's scheme for Bernstein polynomials in float, with
// incrementally computed binomial coefficients, and order and number of components known only at run time. It
// evaluates point by point and reuses nothing. Normals use de Casteljau's construction. This code is compiled
// like a library: optimized, for any machine of the architecture.
#pragma once

#include <glevaluator.h>

#include "workload.h"

namespace evalcts::bench {

// Evaluates a curve over [0,1]. Control point i begins at points[i * components].
void horner_curve(const float* points, int order, int components, float u, float* result);
// Evaluates a surface over [0,1] x [0,1]. Control point (i, j), i in the direction of u, begins at
// points[(j * u_order + i) * components].
void horner_surface(const float* points, int u_order, int v_order, int components, float u, float v,
                    float* result);
// Evaluates a surface as above, and its derivatives, up to positive factors. Orders must be at least 2.
void de_casteljau_surface(const float* points, int u_order, int v_order, int components, float u, float v,
                          float* result, float* along_u, float* along_v);

// The minimal work of EvalCoord in a library: one vertex map, one sink.
struct Immediate {
  const float* points;
  int order, components;
  float u1 = 0, v1 = 0, u_scale = 1, v_scale = 1;  // start and 1 / width of the domain
  glev_sink sink;
  glev_vertex vertex;
};
void horner_eval_coord1(Immediate& context, float u);
void horner_eval_coord2(Immediate& context, float u, float v);

// The loops over the arguments of a workload.
void horner_points(const Curve& curve, float* results);
void horner_rows(const Mesh& mesh, int row, int rows, float* results);

}  // namespace evalcts::bench
