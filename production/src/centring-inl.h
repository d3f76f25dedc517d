// Bernstein coefficients of low degree to coefficients of the powers of x = t - s. Included inside a
// namespace, without a guard: by patch_kernels.cpp once for each instruction set, whose options a template
// must be compiled with.

// Converts the coefficients of one direction, `step` apart, in place: R_i C(n,i) (1-x)^(n-i) (1+x)^i / 2^n,
// with at most n + 1 roundings. Value is a number, a point or a vector, with sums, differences and products
// with a double; the bits do not depend on which of these it is.
template <class Value>
inline void centre_along(int n, int step, Value* points) {
  if (n == 0) return;
  Value &first = points[0], &last = points[n * step];
  const Value ends = first + last, slope = last - first;
  if (n == 1) {
    first = ends * 0.5;
    last = slope * 0.5;
  } else if (n == 2) {
    Value& middle = points[step];
    const Value twice = middle * 2;
    first = (ends + twice) * 0.25;
    middle = slope * 0.5;
    last = (ends - twice) * 0.25;
  } else if (n == 3) {
    Value &second = points[step], &third = points[2 * step];
    const Value middle = (second + third) * 3, tilt = third - second;
    first = (ends + middle) * 0.125;
    second = (slope + tilt) * 3 * 0.125;
    third = (ends * 3 - middle) * 0.125;
    last = (slope - tilt * 3) * 0.125;
  }
}
