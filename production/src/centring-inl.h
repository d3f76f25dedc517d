// Converts Bernstein coefficients of low degree to coefficients of the powers of x = t - s. This file has no
// include guard and is included inside a namespace, by patch_kernels.cpp once for each instruction set,
// because templates must be compiled with the options of the instruction set.

// Converts the coefficients of one direction in place: the sum of R_i C(n,i) (1-x)^(n-i) (1+x)^i / 2^n, where
// the R_i are `step` apart, with at most n + 1 roundings. Value is a number, a point or a vector, with sums,
// differences, and products with a double. The bits are the same for each of these types.
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
