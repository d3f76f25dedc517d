/* An evaluator to be judged: `evalcts vectors emit | bezier | evalcts vectors check`. De Casteljau's
   construction in double precision; it leaves normals out. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char* next;
static double number(void) { return strtod(next, &next); }

/* The argument, or the point of a grid. */
static double coordinate(int is_grid) {
  double x = number();
  if (is_grid) {
    double segments = x, first = number(), last = number(), index = number();
    x = index == segments ? last : index * ((last - first) / segments) + first;
  }
  return x;
}

/* The point at t of `order` points of k values that lie `stride` apart; it takes the place of the first. */
static void construct(double* points, int order, int stride, int k, double s, double t) {
  for (int last = order - 1; last > 0; --last)
    for (int i = 0; i < last; ++i)
      for (int c = 0; c < k; ++c)
        points[i * stride + c] = s * points[i * stride + c] + t * points[(i + 1) * stride + c];
}

int main(void) {
  static char line[1 << 20];
  static double points[64 * 64 * 4];
  while (fgets(line, sizeof line, stdin)) {
    char* kind = strtok(line, " ");
    char* id = strtok(NULL, " ");
    strtok(NULL, " "); /* f or d */
    next = strtok(NULL, "\n");
    if (strstr(kind, "normal")) {
      printf("%s skip\n", id);
      continue;
    }
    int two = kind[strlen(kind) - 1] == '2', is_grid = kind[0] == 'g';
    int k = (int)number(), uorder = (int)number(), vorder = two ? (int)number() : 1;
    double u1 = number(), u2 = number(), v1 = two ? number() : 0, v2 = two ? number() : 1;
    double u = coordinate(is_grid), v = two ? coordinate(is_grid) : 0;
    for (int i = 0; i < uorder * vorder * k; ++i) points[i] = number();
    for (int i = 0; i < uorder; ++i)
      construct(points + i * vorder * k, vorder, k, k, (v2 - v) / (v2 - v1), (v - v1) / (v2 - v1));
    construct(points, uorder, vorder * k, k, (u2 - u) / (u2 - u1), (u - u1) / (u2 - u1));
    printf("%s", id);
    for (int c = 0; c < k; ++c) printf(" %a", points[c]);
    printf("\n");
  }
  return 0;
}
