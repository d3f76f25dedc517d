// Makes maps for the vectors.
#pragma once

#include <reference/map.h>

#include <functional>

#include "dice.h"

namespace evalcts::vectors {

using reference::Map;
using reference::Rational;
using Direction = reference::Map::Direction;

// The type of a map, "f" or "d": all its numbers are binary32 or binary64.
enum class Type { kSingle, kReal };
inline constexpr Type kTypes[] = {Type::kSingle, Type::kReal};

// Returns the number of significant bits of the type.
int bits_of(Type type);
// Returns x rounded to the nearest number of the type.
double rounded(const Rational& x, Type type);
// The first and last argument of a domain or grid. rounded() returns both rounded to the type.
using Ends = std::pair<double, double>;
Ends rounded(const Ends& ends, Type type);
// Returns a + part * (b - a) rounded to the type.
double between(double a, double b, const Rational& part, Type type);
// Returns the number of the type adjacent to x in the direction of `towards`.
double next_after(double x, double towards, Type type);

// A function that returns component c of R_ij.
using ValueOf = std::function<double(int i, int j, int c)>;
Map curve(GLenum target, const Direction& u, const std::function<double(int i, int c)>& value);
Map surface(GLenum target, const Direction& u, const Direction& v, const ValueOf& value);

// Control values of one component, by the index of their point.
using Values = std::vector<double>;
// Return a curve, or a surface (v varies fastest), of target INDEX, which has one component.
Map index_curve(double u1, double u2, const Values& values);
Map index_surface(const Direction& u, const Direction& v, const Values& values);

// Returns a multiple of 1/16 of magnitude up to 8.
double simple(Dice& dice);
// Returns a number with all significant bits of the type and a magnitude from 2^-3 to 2^4.
double full(Dice& dice, Type type);
// Returns a number with a magnitude from 2^least to 2^(most + 1) and all bits that the type has there.
double of_magnitude(Dice& dice, Type type, int least, int most);

// Returns the Bernstein coefficients on [0, 1] of (t - r_1) * ... * (t - r_n).
std::vector<Rational> with_roots(const std::vector<Rational>& roots);

}  // namespace evalcts::vectors
