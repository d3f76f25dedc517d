// Implements excerpts: programs with only some of the drawing commands, or with shorter ranges of meshes.
#include "excerpt.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <evalcts/gl/roles.h>

namespace evalcts::fuzz {
namespace {

using gl::Command;
using gl::EntryPoint;

constexpr std::size_t kMostExcerpts = 12;  // number of excerpts that are tried
constexpr std::int64_t kLeastToHalve = 8;  // shorter meshes and grids (in steps) are not halved

std::int64_t emitted_by(const Command& command) {
  const auto points = [&](std::size_t first) {
    return std::max<std::int64_t>(gl::integer_of(command, first + 1) - gl::integer_of(command, first) + 1, 0);
  };
  if (command.entry == EntryPoint::EvalMesh1) return points(1);
  if (command.entry == EntryPoint::EvalMesh2) return points(1) * points(3);
  return gl::emits_vertex(command.entry);
}

// A range of commands from Begin to End, or a mesh.
struct Drawing {
  std::size_t first = 0, last = 0;
  std::int64_t vertices = 0;
};

std::vector<Drawing> drawings_of(const gl::Case& program) {
  std::vector<Drawing> drawings;
  std::optional<Drawing> open;
  for (std::size_t i = 0; i < program.commands().size(); ++i) {
    const Command& command = program.commands()[i];
    if (command.entry == EntryPoint::Begin && !open) open = {i, i, 0};
    if (open) {
      open->vertices += emitted_by(command);
      open->last = i;
      if (command.entry != EntryPoint::End) continue;
      drawings.push_back(*open);
      open.reset();
    } else if (emitted_by(command) > 0) {
      drawings.push_back({i, i, emitted_by(command)});
    }
  }
  return drawings;
}

// Divides the drawings into successive ranges of at most kMostVertices vertices or one drawing.
std::vector<std::pair<std::size_t, std::size_t>> windows_of(const std::vector<Drawing>& drawings) {
  std::vector<std::pair<std::size_t, std::size_t>> windows;
  for (std::size_t begin = 0, end = 0; begin < drawings.size(); begin = end) {
    std::int64_t vertices = 0;
    do vertices += drawings[end++].vertices;
    while (end < drawings.size() && vertices + drawings[end].vertices <= kMostVertices);
    windows.emplace_back(begin, end);
  }
  return windows;
}

// Returns the program without the drawings before `begin` and from `end` on.
gl::Case with_drawings(const gl::Case& program, const std::vector<Drawing>& drawings, std::size_t begin,
                       std::size_t end) {
  gl::Case part(program.identity());
  std::size_t next = 0;
  for (std::size_t i = 0; i < program.commands().size(); ++i) {
    while (next < drawings.size() && drawings[next].last < i) ++next;
    const bool is_drawing = next < drawings.size() && drawings[next].first <= i;
    if (!is_drawing || (begin <= next && next < end)) part.add(program.commands()[i]);
  }
  return part;
}

// Returns the program with each long range of a mesh changed by the function. If `halves_grids`, grids get
// half as many steps.
template <class Change>
gl::Case with_ranges(const gl::Case& program, bool halves_grids, const Change& change) {
  gl::Case changed(program.identity());
  for (Command command : program.commands()) {
    const auto change_range = [&](std::size_t first) {
      auto* begin = std::get_if<std::int64_t>(&command.arguments[first]);
      auto* end = std::get_if<std::int64_t>(&command.arguments[first + 1]);
      if (begin && end && *end - *begin >= kLeastToHalve) change(*begin, *end);
    };
    const auto halve = [&](std::size_t i) {
      auto* steps = std::get_if<std::int64_t>(&command.arguments[i]);
      if (halves_grids && steps && *steps >= kLeastToHalve) *steps /= 2;
    };
    const gl::Role role = gl::role_of(command.entry);
    if (role == gl::Role::kEvalMesh) change_range(1);
    if (command.entry == EntryPoint::EvalMesh2) change_range(3);
    if (role == gl::Role::kMapGrid) halve(0);
    if (role == gl::Role::kMapGrid && gl::dimension_of(command.entry) == 2) halve(3);
    changed.add(std::move(command));
  }
  return changed;
}

enum class Half { kFirst, kSecond };

// Returns the program with half of the commands between each Begin and End that emit vertices.
gl::Case with_primitives(const gl::Case& program, Half half) {
  gl::Case changed(program.identity());
  const std::vector<Drawing> drawings = drawings_of(program);
  std::size_t next = 0;
  for (std::size_t i = 0; i < program.commands().size(); ++i) {
    while (next < drawings.size() && drawings[next].last < i) ++next;
    const bool is_inside = next < drawings.size() && drawings[next].first < i && i < drawings[next].last &&
                           drawings[next].vertices >= kLeastToHalve;
    const bool is_in_first = is_inside && i < (drawings[next].first + drawings[next].last) / 2;
    if (!is_inside || is_in_first == (half == Half::kFirst)) changed.add(program.commands()[i]);
  }
  return changed;
}

gl::Case with_drawings_halved(gl::Case program, const InterestingnessTest& is_interesting) {
  for (bool again = true; again && vertices_of(program) > kMostVertices / 4;) {
    again = false;
    for (const gl::Case& half :
         {with_primitives(program, Half::kFirst), with_primitives(program, Half::kSecond),
          with_ranges(program, true, [](std::int64_t&begin, std::int64_t&end) { begin /= 2, end /= 2; }),
          with_ranges(program, false,
                      [](std::int64_t&begin, std::int64_t&end) { end = begin + (end - begin) / 2; }),
          with_ranges(program, false,
                      [](std::int64_t&begin, std::int64_t&end) { begin += (end - begin) / 2; })}) {
      if (vertices_of(half) >= vertices_of(program) || !is_interesting(half)) continue;
      program = half;
      again = true;
      break;
    }
  }
  return program;
}

}  // namespace

std::int64_t vertices_of(const gl::Case& program) {
  std::int64_t vertices = 0;
  for (const Command& command : program.commands()) vertices += emitted_by(command);
  return vertices;
}

gl::Case excerpt_of(const gl::Case& program, const InterestingnessTest& is_interesting) {
  const std::vector<Drawing> drawings = drawings_of(program);
  const std::vector<std::pair<std::size_t, std::size_t>> windows = windows_of(drawings);
  // The tried windows are distributed evenly over the program.
  const std::size_t count = std::min(windows.size(), kMostExcerpts);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [begin, end] = windows[count == 1 ? 0 : i * (windows.size() - 1) / (count - 1)];
    const gl::Case part = with_drawings(program, drawings, begin, end);
    if (is_interesting(part)) return with_drawings_halved(part, is_interesting);
  }
  return program;
}

}  // namespace evalcts::fuzz
