// Finds and leaves out queries that an implementation rejects, because their errors would be taken for errors
// of the command under test.
#pragma once

#include <memory>
#include <set>
#include <span>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// The state of grids, and other state that tests query: MAX_EVAL_ORDER and state outside evaluators.
inline constexpr GLenum kGridQueries[] = {GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN,
                                          GL_MAP2_GRID_SEGMENTS};
inline constexpr GLenum kOtherQueries[] = {GL_MAX_EVAL_ORDER,     GL_CURRENT_COLOR,
                                           GL_CURRENT_NORMAL,     GL_CURRENT_TEXTURE_COORDS,
                                           GL_CURRENT_INDEX,      GL_CURRENT_SECONDARY_COLOR,
                                           GL_CURRENT_FOG_COORD,  GL_CURRENT_RASTER_POSITION,
                                           GL_EDGE_FLAG,          GL_ACTIVE_TEXTURE,
                                           GL_COLOR_CLEAR_VALUE,  GL_LIST_BASE,
                                           GL_LIST_INDEX,         GL_LIST_MODE,
                                           GL_MATRIX_MODE,        GL_RENDER_MODE,
                                           GL_ATTRIB_STACK_DEPTH, GL_MAX_ATTRIB_STACK_DEPTH,
                                           GL_MAX_LIST_NESTING,   GL_SHADE_MODEL,
                                           GL_POINT_SIZE,         GL_LINE_WIDTH,
                                           GL_FOG_MODE,           GL_VIEWPORT};

// Returns the forms of Get and the names for which they raise an error in a fresh context.
std::set<RejectedQuery> find_rejected_queries(Implementation& implementation, std::span<const GLenum> names);

// Returns those of kGridQueries that raise an error or write nothing in a fresh context, in one of the forms
// that tests use: GetFloatv for domains, GetFloatv and GetIntegerv for segments.
std::set<GLenum> find_unanswered_grid_queries(Implementation& implementation);

// Wraps an implementation so that outside Begin and End, these queries do nothing. At most one such
// implementation may exist at a time.
std::unique_ptr<Implementation> without_queries(std::unique_ptr<Implementation> inner,
                                                const std::set<RejectedQuery>& queries);

}  // namespace evalcts
