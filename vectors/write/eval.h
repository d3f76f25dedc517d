// Sections of map1_eval.json and map2_eval.json: values of curves and surfaces. eval.cpp combines them.
#pragma once

#include <evalcts/gl/tokens.h>
#include "document.h"
#include "values.h"

namespace evalcts::vectors {

// Each function with a document adds its themes to it.
namespace curves {

// Return curves of simple() numbers, or of full() ones.
Map some_curve(Dice& dice, GLenum target, const Direction& u);
Map full_curve(Dice& dice, GLenum target, const Direction& u, Type type);
// Returns a target with one or two components, for cases whose size grows with the order.
GLenum small_target(int i);

void ordinary(Document& document);
void full_precision(Document& document);
void high_orders(Document& document);
void high_orders_of_targets(Document& document);
void order_one(Document& document);
void domains(Document& document);
void ends(Document& document);
void near_ends(Document& document);
void outside(Document& document);
void double_only(Document& document);
void magnitudes(Document& document);
void overflow(Document& document);
void underflow(Document& document);
void extreme_arguments(Document& document);
void float_ties(Document& document);
void double_ties(Document& document);
void cancellation(Document& document);
void special_nets(Document& document);
void rational(Document& document);
void hardest(Document& document);

}  // namespace curves

namespace surfaces {

Map some_surface(Dice& dice, GLenum target, const Direction& u, const Direction& v);
Map full_surface(Dice& dice, GLenum target, const Direction& u, const Direction& v, Type type);
GLenum any_target(int i);
// Returns a target with few components, for cases with many control points.
GLenum small_target(int i);
// Returns a case at inside() arguments of the map.
Json inside_case(Dice& dice, const Map& map, Type type, Detail detail = Detail::kNone);

void ordinary(Document& document);
void every_target(Document& document);
void every_order(Document& document);
void high_orders(Document& document);
void highest_orders(Document& document);
void full_precision(Document& document);
void order_one(Document& document);
void domains(Document& document);
void edges(Document& document);
void outside(Document& document);
void double_only(Document& document);
void magnitudes(Document& document);
void ties(Document& document);
void cancellation(Document& document);
void special_nets(Document& document);
void rational(Document& document);

}  // namespace surfaces

}  // namespace evalcts::vectors
