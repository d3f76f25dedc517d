// "float Horner": what GL libraries do. Horner's scheme for Bernstein polynomials in float, the binomials by
// their recurrence, order and number of components known at run time only; point by point, nothing used
// twice. Where there are normals, de Casteljau's construction. Compiled as libraries are: optimized, for any
// machine of its kind.
#pragma once

#include <glevaluator.h>

#include "workload.h"

namespace evalcts::bench {

// Points over [0,1]: control point i begins at points[i * components].
void horner_curve(const float* points, int order, int components, float u, float* result);
// Control point (i, j), i in the direction of u, begins at points[(j * u_order + i) * components].
void horner_surface(const float* points, int u_order, int v_order, int components, float u, float v,
                    float* result);
// With the derivatives up to positive factors. Orders of at least 2.
void de_casteljau_surface(const float* points, int u_order, int v_order, int components, float u, float v,
                          float* result, float* along_u, float* along_v);

// The least that a library does in EvalCoord: one vertex map, one sink.
struct Immediate {
  const float* points;
  int order, components;
  float u1 = 0, v1 = 0, u_scale = 1, v_scale = 1;  // of the domain
  glev_sink sink;
  glev_vertex vertex;
};
void horner_eval_coord1(Immediate& context, float u);
void horner_eval_coord2(Immediate& context, float u, float v);

// The loops over a workload.
void horner_points(const Curve& curve, float* results);
void horner_rows(const Mesh& mesh, int row, int rows, float* results);

}  // namespace evalcts::bench
