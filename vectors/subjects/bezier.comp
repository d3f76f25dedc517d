#version 310 es
// De Casteljau's construction for bezier_glsl.py: a work group for each case, an invocation for each row of its control
// points, the first of which combines the rows.
precision highp float;
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Integers { int integers[]; };
layout(std430, binding = 1) readonly buffer Floats { float floats[]; };
layout(std430, binding = 2) writeonly buffer Results { float results[]; };
shared vec4 column[64];
vec4 row[64];

float coordinate(int at, int where) {
  int segments = integers[at], index = integers[at + 1];
  float first = floats[where], last = floats[where + 1];
  if (segments == 0 || index == 0) return first;
  return index == segments ? last : float(index) * ((last - first) / float(segments)) + first;
}
vec4 construct(int order, vec2 domain, float u) {
  for (; order > 1; --order)
    for (int i = 1; i < order; ++i)
      row[i - 1] = ((domain.y - u) * row[i - 1] + (u - domain.x) * row[i]) / (domain.y - domain.x);
  return row[0];
}
void main() {
  int at = int(gl_WorkGroupID.x) * 8, where = integers[at + 3], i = int(gl_LocalInvocationIndex);
  int k = integers[at], uorder = integers[at + 1], vorder = integers[at + 2], next = where + 8 + i * vorder * k;
  if (i < uorder) {
    for (int j = 0; j < vorder; ++j)
      for (int c = 0; c < k; ++c) row[j][c] = floats[next++];
    column[i] = construct(vorder, vec2(floats[where + 2], floats[where + 3]), coordinate(at + 6, where + 6));
  }
  barrier();
  if (i > 0) return;
  row = column;
  row[0] = construct(uorder, vec2(floats[where], floats[where + 1]), coordinate(at + 4, where + 4));
  for (int c = 0; c < k; ++c) results[int(gl_WorkGroupID.x) * 4 + c] = row[0][c];
}
