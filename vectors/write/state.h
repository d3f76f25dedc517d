// Commands that the sequences of state.json share (state.cpp, state_lists.cpp, state_meshes.cpp).
#pragma once

#include <functional>

#include "document.h"
#include "sequences.h"

namespace evalcts::vectors::states {

inline constexpr Shown kPositions{};
inline constexpr Shown kEverything{.color = true, .normal = true, .texture_units = 1};

// Returns the one-dimensional target itself, or the two-dimensional target of the same name.
GLenum target_of(bool two, GLenum map1_target);
// Returns a map with small numbers that depend on the target, so that no two targets have the same values.
Map some_map(GLenum target, int order = 2);
void define_and_enable(gl::Case& c, GLenum target, Type type = Type::kSingle);

// Sets the current values that a map can replace.
void current_values(gl::Case& c);

// evaluate() appends EvalCoord1f or EvalCoord2f, draw() a point of it.
void evaluate(gl::Case& c, bool two, double u = 0.25, double v = 0.75);
void draw(gl::Case& c, bool two, double u = 0.25, double v = 0.75);

// Adds one case to a theme.
void add(Theme& theme, const Shown& shown, const std::function<void(gl::Case&)>& what,
         const Names& requirements = {});

// The themes of display lists.
void lists(Document& document);
// Points and meshes at the exact ends of grids.
void exact_ends(Document& document);
// Meshes of thousands of points.
void long_meshes(Document& document);
void steep_meshes(Document& document);
// Meshes and the state that they must leave alone.
void meshes_keep_state(Document& document);

}  // namespace evalcts::vectors::states
