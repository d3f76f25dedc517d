// The weights t^i s^(n-i) of a polynomial of degree n.
#if defined(GLEVALUATOR_WEIGHTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_WEIGHTS_INL_H_
#undef GLEVALUATOR_WEIGHTS_INL_H_
#else
#define GLEVALUATOR_WEIGHTS_INL_H_
#endif

#include <cstddef>

#include "target.h"
#include "vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

HWY_INLINE void weights_of(int degree, Vector s, Vector t, Vector* weights) {
  weights[0] = hn::Set(kDoubles, 1);
  for (int i = 1; i <= degree; ++i) weights[i] = hn::Mul(weights[i - 1], t);
  Vector power = s;
  for (int i = degree - 1; i >= 0; --i, power = hn::Mul(power, s)) weights[i] = hn::Mul(weights[i], power);
}

// Stores the weights of kLanes columns. Those of each i are `padded` apart.
HWY_INLINE void store_weights(int degree, Vector s, Vector t, std::size_t padded, double* weights) {
  Vector column[kMaxOrder];
  weights_of(degree, s, t, column);
  for (int i = 0; i <= degree; ++i) hn::Store(column[i], kDoubles, weights + i * padded);
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_WEIGHTS_INL_H_
