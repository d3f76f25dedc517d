// Writes map1_eval.json and map2_eval.json, and defines what their themes share.
#include "eval.h"

#include "kinds.h"

namespace evalcts::vectors {

namespace curves {

Map some_curve(Dice& dice, GLenum target, const Direction& u) {
  return curve(target, u, [&](int, int) { return simple(dice); });
}

Map full_curve(Dice& dice, GLenum target, const Direction& u, Type type) {
  return curve(target, u, [&](int, int) { return full(dice, type); });
}

GLenum small_target(int i) {
  constexpr GLenum kTargets[] = {GL_MAP1_INDEX, GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2};
  return kTargets[i % 3];
}

}  // namespace curves

namespace surfaces {

Map some_surface(Dice& dice, GLenum target, const Direction& u, const Direction& v) {
  return surface(target, u, v, [&](int, int, int) { return simple(dice); });
}

Map full_surface(Dice& dice, GLenum target, const Direction& u, const Direction& v, Type type) {
  return surface(target, u, v, [&](int, int, int) { return full(dice, type); });
}

GLenum any_target(int i) { return gl::kMap2Targets[static_cast<std::size_t>(i) % 9]; }

GLenum small_target(int i) { return i % 2 == 0 ? GL_MAP2_INDEX : GL_MAP2_TEXTURE_COORD_2; }

Json inside_case(Dice& dice, const Map& map, Type type, Detail detail) {
  const double u = inside(dice, map.u, type);
  const double v = inside(dice, map.v, type);
  return value_case({map, type, at(u), at(v)}, detail);
}

}  // namespace surfaces

Document map1_eval() {
  Document document("map1_eval", "Values of one-dimensional maps (Map1f, Map1d, EvalCoord1).");
  curves::ordinary(document);
  curves::full_precision(document);
  curves::high_orders(document);
  curves::order_one(document);
  curves::domains(document);
  curves::ends(document);
  curves::near_ends(document);
  curves::outside(document);
  curves::double_only(document);
  curves::magnitudes(document);
  curves::overflow(document);
  curves::underflow(document);
  curves::extreme_arguments(document);
  curves::float_ties(document);
  curves::double_ties(document);
  curves::cancellation(document);
  curves::special_nets(document);
  curves::rational(document);
  curves::hardest(document);
  curves::high_orders_of_targets(document);
  return document;
}

Document map2_eval() {
  Document document("map2_eval", "Values of two-dimensional maps (Map2f, Map2d, EvalCoord2).");
  surfaces::ordinary(document);
  surfaces::every_target(document);
  surfaces::every_order(document);
  surfaces::high_orders(document);
  surfaces::full_precision(document);
  surfaces::order_one(document);
  surfaces::domains(document);
  surfaces::edges(document);
  surfaces::outside(document);
  surfaces::double_only(document);
  surfaces::magnitudes(document);
  surfaces::ties(document);
  surfaces::cancellation(document);
  surfaces::special_nets(document);
  surfaces::rational(document);
  surfaces::highest_orders(document);
  return document;
}

}  // namespace evalcts::vectors
