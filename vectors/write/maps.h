// Making maps for the vectors.
#pragma once

#include <reference/map.h>

#include <functional>

#include "dice.h"

namespace evalcts::vectors {

using reference::Map;
using reference::Rational;
using Direction = reference::Map::Direction;

// 'f' or 'd': whether everything about a map is single or double precision.
enum class Type { kSingle, kReal };
inline constexpr Type kTypes[] = {Type::kSingle, Type::kReal};

// The significant bits of the type.
int bits_of(Type type);
// x rounded to the nearest number of the type.
double rounded(const Rational& x, Type type);
// a + part * (b - a), rounded.
double between(double a, double b, const Rational& part, Type type);
// The next number of the type in the direction of `towards`.
double next_after(double x, double towards, Type type);

// Component c of R_ij.
using ValueOf = std::function<double(int i, int j, int c)>;
Map curve(GLenum target, const Direction& u, const std::function<double(int i, int c)>& value);
Map surface(GLenum target, const Direction& u, const Direction& v, const ValueOf& value);

// Control values of one component by the number of their point.
using Values = std::vector<double>;
// A curve or a surface (in rows of v) of target INDEX: the one component says it all.
Map index_curve(double u1, double u2, const Values& values);
Map index_surface(const Direction& u, const Direction& v, const Values& values);

// Small numbers: multiples of 1/16 up to 8.
double simple(Dice& dice);
// All significant bits of the type, of magnitude 2^-3 to 2^4.
double full(Dice& dice, Type type);
// A magnitude from 2^least to 2^(most + 1), with all bits that the type has there.
double of_magnitude(Dice& dice, Type type, int least, int most);

// The Bernstein coefficients on [0, 1] of (t - r_1) * ... * (t - r_n).
std::vector<Rational> with_roots(const std::vector<Rational>& roots);

}  // namespace evalcts::vectors
