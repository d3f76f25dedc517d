// Defines all deliveries, and rewrites the commands of a case for each.
#include <evalcts/gl/delivery.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include <evalcts/gl/lift.h>
#include <evalcts/gl/numbers.h>
#include <evalcts/gl/roles.h>
#include "grid.h"

namespace evalcts::gl {
namespace {

// Returns u, or u and v, of an EvalCoord command; empty for other commands.
std::vector<double> coordinates(const Command& command) {
  switch (command.entry) {
    case EntryPoint::EvalCoord1f:
    case EntryPoint::EvalCoord1d:
      return {number(command.arguments[0])};
    case EntryPoint::EvalCoord2f:
    case EntryPoint::EvalCoord2d:
      return {number(command.arguments[0]), number(command.arguments[1])};
    case EntryPoint::EvalCoord1fv:
    case EntryPoint::EvalCoord1dv:
    case EntryPoint::EvalCoord2fv:
    case EntryPoint::EvalCoord2dv:
      return elements(std::get<Input>(command.arguments[0]));
    default:
      return {};
  }
}

Command eval_coord(const std::vector<double>& at, bool doubles, bool arrays) {
  const bool two = at.size() == 2;
  if (arrays) {
    const EntryPoint single = two ? EntryPoint::EvalCoord2fv : EntryPoint::EvalCoord1fv;
    const EntryPoint twice = two ? EntryPoint::EvalCoord2dv : EntryPoint::EvalCoord1dv;
    return {doubles ? twice : single, {reals(at, doubles)}};
  }
  const EntryPoint single = two ? EntryPoint::EvalCoord2f : EntryPoint::EvalCoord1f;
  const EntryPoint twice = two ? EntryPoint::EvalCoord2d : EntryPoint::EvalCoord1d;
  Command command{doubles ? twice : single, {}};
  for (const double coordinate : at) command.arguments.push_back(real(coordinate, doubles));
  return command;
}

// Returns a Map command with floats or doubles.
Command map(const Command& command, bool doubles) {
  const bool two = command.entry == EntryPoint::Map2f || command.entry == EntryPoint::Map2d;
  Command delivered = command;
  delivered.entry = two ? (doubles ? EntryPoint::Map2d : EntryPoint::Map2f)
                        : (doubles ? EntryPoint::Map1d : EntryPoint::Map1f);
  for (Value& argument : delivered.arguments) {
    if (std::holds_alternative<float>(argument) || std::holds_alternative<double>(argument))
      argument = real(number(argument), doubles);
    else if (const auto* points = std::get_if<Input>(&argument))
      argument = reals(*points, doubles);
  }
  return delivered;
}

// Returns true for the Vertex commands, which are useful only between Begin and End.
bool is_vertex(EntryPoint entry) { return role_of(entry) == Role::kVertex; }

// Replaces evaluation at coordinates by evaluation at the points of grids.
class OnGrids {
 public:
  OnGrids(const Case& script, bool meshes) : script_(script), meshes_(meshes) {
    delivered_.script = script.without_commands();
  }

  DeliveredCase apply() {
    while (next_ < commands().size()) {
      if (commands()[next_].entry == EntryPoint::Begin) {
        primitive();
      } else if (const auto at = coordinates(commands()[next_]); !at.empty()) {
        single_point(at);  // outside Begin and End
      } else {
        copy();
      }
    }
    return std::move(delivered_);
  }

 private:
  // One grid for each dimension, all of which contain the same arguments.
  using Grids = std::vector<GridThrough>;

  const std::vector<Command>& commands() const { return script_.commands(); }

  // Adds this command in place of the next command of the case.
  void put(Command command) {
    for (Value& argument : command.arguments)
      if (auto* result = std::get_if<ResultOf>(&argument))
        result->command = delivered_.positions[static_cast<std::size_t>(result->command)];
    delivered_.positions.push_back(delivered_.script.add(std::move(command)).index);
    ++next_;
  }
  void copy() { put(commands()[next_]); }
  // Omits the next command of the case. Its position is that of the last command so far.
  void drop() {
    delivered_.positions.push_back(static_cast<int>(delivered_.script.commands().size()) - 1);
    ++next_;
  }

  void map_grid(const Grids& grids) {
    Command command{grids.size() == 2 ? EntryPoint::MapGrid2f : EntryPoint::MapGrid1f, {}};
    for (const GridThrough& grid : grids) {
      command.arguments.emplace_back(std::int64_t{grid.segments});
      command.arguments.push_back(real(grid.first, false));
      command.arguments.push_back(real(grid.last, false));
    }
    delivered_.script.add(std::move(command));
  }

  static Command eval_point(const Grids& grids, std::size_t i) {
    Command command{grids.size() == 2 ? EntryPoint::EvalPoint2 : EntryPoint::EvalPoint1, {}};
    for (const GridThrough& grid : grids) command.arguments.emplace_back(std::int64_t{grid.indices[i]});
    return command;
  }

  static Command eval_mesh(GLenum mode, const Grids& grids) {
    Command command{grids.size() == 2 ? EntryPoint::EvalMesh2 : EntryPoint::EvalMesh1, {std::int64_t{mode}}};
    for (const GridThrough& grid : grids) {
      command.arguments.emplace_back(std::int64_t{grid.indices.front()});
      command.arguments.emplace_back(std::int64_t{grid.indices.back()});
    }
    return command;
  }

  static std::optional<Grids> grids_through(const std::vector<std::vector<double>>& arguments) {
    Grids grids;
    for (std::size_t dimension = 0; !arguments.empty() && dimension < arguments[0].size(); ++dimension) {
      std::vector<double> values;
      for (const std::vector<double>& at : arguments) values.push_back(at.at(dimension));
      const std::optional<GridThrough> grid = grid_through(values);
      if (!grid) return {};
      grids.push_back(*grid);
    }
    if (grids.empty()) return {};
    return grids;
  }

  // True if the arguments are those of one mesh in its order: one index rises by one, the other is constant.
  static bool is_row(const Grids& grids) {
    std::size_t rising = 0;
    for (const GridThrough& grid : grids) {
      const auto& indices = grid.indices;
      const auto step = [&](int by) {
        return std::ranges::adjacent_find(indices, [by](int a, int b) { return b != a + by; }) ==
               indices.end();
      };
      if (step(0)) continue;
      if (!step(1)) return false;
      ++rising;
    }
    return rising == 1;
  }

  // Returns grids whose first end is the point. Other tests check that the last end is exact, too.
  Grids grids_of_point(const std::vector<double>& at) {
    Grids grids;
    for (const double x : at) {
      const double other = x == 2 ? 3 : 0.5 * x + 1;
      grids.push_back({1 + 2 * (grids_++ % 2), x, other, {0}});
    }
    return grids;
  }

  // Delivers a single point: by a mesh, or outside Begin and End.
  void single_point(const std::vector<double>& at) {
    const Grids grids = grids_of_point(at);
    map_grid(grids);
    put(meshes_ ? eval_mesh(GL_POINT, grids) : eval_point(grids, 0));
  }

  void primitive() {
    const auto mode = static_cast<GLenum>(std::get<std::int64_t>(commands()[next_].arguments[0]));
    std::vector<std::vector<double>> arguments;
    std::size_t end = next_ + 1;
    for (; end < commands().size() && commands()[end].entry != EntryPoint::End; ++end)
      if (auto at = coordinates(commands()[end]); !at.empty()) arguments.push_back(std::move(at));
    if (arguments.empty() || end == commands().size()) return copy();
    const bool only_evaluation = arguments.size() == end - next_ - 1;
    const std::optional<Grids> grids = grids_through(arguments);

    if (meshes_ && mode == GL_LINE_STRIP && only_evaluation && grids && is_row(*grids)) {
      map_grid(*grids);
      drop();
      put(eval_mesh(GL_LINE, *grids));
      while (next_ <= end) drop();
    } else if (meshes_ && mode == GL_POINTS) {
      meshes_of_points(end);
    } else if (!meshes_ && grids) {
      map_grid(*grids);
      for (std::size_t i = 0; next_ <= end;) {
        if (coordinates(commands()[next_]).empty())
          copy();
        else
          put(eval_point(*grids, i++));
      }
    } else if (!meshes_ && mode == GL_POINTS) {
      separate_points(end);
    } else {
      throw std::logic_error(script_.identity() + ": this primitive cannot be delivered by points of a grid");
    }
  }

  // Delivers each evaluated point in its own Begin and End, preceded by a grid.
  void separate_points(std::size_t end) {
    const Command begin = commands()[next_];
    copy();
    while (next_ < end) {
      const auto at = coordinates(commands()[next_]);
      if (at.empty()) {
        copy();
        continue;
      }
      delivered_.script.add({EntryPoint::End, {}});
      const Grids grids = grids_of_point(at);
      map_grid(grids);
      delivered_.script.add(begin);
      put(eval_point(grids, 0));
    }
    copy();
  }

  // Delivers runs of evaluation as meshes. A Vertex between them gets its own Begin and End.
  void meshes_of_points(std::size_t end) {
    const Command begin = commands()[next_];
    drop();
    while (next_ < end) {
      std::vector<std::vector<double>> run;
      for (std::size_t i = next_; i < end; ++i) {
        auto at = coordinates(commands()[i]);
        if (at.empty()) break;
        run.push_back(std::move(at));
      }
      if (run.empty()) {
        const bool vertex = is_vertex(commands()[next_].entry);
        if (vertex) delivered_.script.add(begin);
        copy();
        if (vertex) delivered_.script.add({EntryPoint::End, {}});
        continue;
      }
      const std::optional<Grids> grids = grids_through(run);
      if (grids && run.size() > 1 && is_row(*grids)) {
        map_grid(*grids);
        put(eval_mesh(GL_POINT, *grids));
        for (std::size_t i = 1; i < run.size(); ++i) drop();
      } else {
        for (const std::vector<double>& at : run) single_point(at);
      }
    }
    drop();  // End
  }

  const Case& script_;
  bool meshes_;
  std::size_t next_ = 0;  // index of the next command of the case
  int grids_ = 0;
  DeliveredCase delivered_;
};

DeliveredCase one_for_one(const Case& script, bool doubles, bool arrays) {
  DeliveredCase delivered{script.without_commands(), {}};
  for (const Command& command : script.commands()) {
    const auto at = coordinates(command);
    const gl::Ref ref = delivered.script.add(!at.empty() ? eval_coord(at, doubles, arrays)
                                             : role_of(command.entry) == Role::kMap ? map(command, doubles)
                                                                                    : command);
    delivered.positions.push_back(ref.index);
  }
  return delivered;
}

DeliveredCase unchanged(const Case& script) {
  DeliveredCase delivered{script, std::vector<int>(script.commands().size())};
  std::iota(delivered.positions.begin(), delivered.positions.end(), 0);
  return delivered;
}

// Returns the given deliveries and, for each form of display lists, some of them through this form, chosen
// such that every evaluation command is compiled and every form contains floats and doubles.
std::vector<Delivery> with_lists(const std::vector<Delivery>& deliveries) {
  struct Way {
    Lists lists;
    const char* name;
    std::vector<std::string> evaluated;  // suffixes of the names of the deliveries
  };
  static const std::vector<Way> kWays = {
      {Lists::kCompiled, "Compiled", {"1fv", "1d", "Point1", "Mesh1", "2dv", "2f"}},
      {Lists::kExecuted, "Executed", {"1f", "1dv", "2d", "Mesh2"}},
      {Lists::kNested, "Nested", {"1f", "1d", "2fv", "2d", "Point2"}},
      {Lists::kRepeated, "Repeated", {"1f", "1d", "2f", "2d"}},
      {Lists::kSplit, "Split", {"1f", "1d", "2f", "2d"}}};
  std::vector<Delivery> all = deliveries;
  for (const Way& way : kWays)
    for (const Delivery& delivery : deliveries)
      for (const std::string& end : way.evaluated)
        if (delivery.name.ends_with(end)) {
          all.push_back(delivery);
          all.back().name += std::string("/") + way.name;
          all.back().lists = way.lists;
        }
  return all;
}

}  // namespace

DeliveredCase Delivery::apply(const Case& script) const {
  if (lists != Lists::kNone) {
    Delivery without_lists = *this;
    without_lists.lists = Lists::kNone;
    const DeliveredCase delivered = without_lists.apply(script);
    DeliveredCase listed = through_lists(delivered.script, lists);
    std::vector<int> positions;
    for (const int position : delivered.positions)
      positions.push_back(position < 0 ? position : listed.positions.at(static_cast<std::size_t>(position)));
    return {std::move(listed.script), std::move(positions)};
  }
  if (lifted) {
    Delivery unlifted = *this;
    unlifted.lifted = false;
    return unlifted.apply(lift(script, along_v));
  }
  switch (evaluation) {
    case Evaluation::kAsWritten:
      return unchanged(script);
    case Evaluation::kPoint:
      return OnGrids(script, false).apply();
    case Evaluation::kMesh:
      return OnGrids(script, true).apply();
    default:
      return one_for_one(script, doubles, evaluation == Evaluation::kArray);
  }
}

bool Delivery::is_plain() const {
  return lists == Lists::kNone &&
         (evaluation == Evaluation::kAsWritten || (evaluation == Evaluation::kCoordinates && !doubles));
}

const std::vector<Delivery>& curve_deliveries() {
  using enum Delivery::Evaluation;
  static const std::vector<Delivery> kAll =
      with_lists({{"EvalCoord1f", kCoordinates},
                  {"EvalCoord1fv", kArray},
                  {.name = "EvalCoord1d", .evaluation = kCoordinates, .doubles = true},
                  {.name = "EvalCoord1dv", .evaluation = kArray, .doubles = true},
                  {"EvalPoint1", kPoint},
                  {"EvalMesh1", kMesh},
                  {"EvalCoord2f", kCoordinates, false, true, false},
                  {"EvalCoord2fv", kArray, false, true, true},
                  {"EvalCoord2d", kCoordinates, true, true, true},
                  {"EvalCoord2dv", kArray, true, true, false},
                  {"EvalPoint2", kPoint, false, true, true},
                  {"EvalMesh2", kMesh, false, true, false}});
  return kAll;
}

const std::vector<Delivery>& surface_deliveries() {
  static const std::vector<Delivery> kAll = [] {
    std::vector<Delivery> two = curve_deliveries();
    std::erase_if(two, [](const Delivery& delivery) { return !delivery.lifted; });
    for (Delivery& delivery : two) delivery.lifted = false;
    return two;
  }();
  return kAll;
}

const std::vector<Delivery>& list_deliveries() {
  static const std::vector<Delivery> kAll = {{},
                                             {.name = "Compiled", .lists = Lists::kCompiled},
                                             {.name = "Executed", .lists = Lists::kExecuted},
                                             {.name = "Nested", .lists = Lists::kNested},
                                             {.name = "Repeated", .lists = Lists::kRepeated},
                                             {.name = "Split", .lists = Lists::kSplit}};
  return kAll;
}

std::vector<Delivery> sparing(std::vector<Delivery> deliveries) {
  for (Delivery& delivery : deliveries) delivery.sparing = true;
  return deliveries;
}

std::vector<Delivery> without(unsigned traits, const std::vector<Delivery>& deliveries) {
  using enum Delivery::Evaluation;
  const auto has = [](const Delivery& delivery, unsigned trait) {
    switch (trait) {
      case kMeshes:
        return delivery.evaluation == kMesh;
      case kGrids:
        return delivery.evaluation == kMesh || delivery.evaluation == kPoint;
      case kArrays:
        return delivery.evaluation == kArray;
      case kLists:
        return delivery.lists != Lists::kNone;
      default:
        return delivery.lists == Lists::kRepeated;
    }
  };
  std::vector<Delivery> kept = deliveries;
  for (const unsigned trait : {kMeshes, kGrids, kArrays, kLists, kRepetition})
    if (traits & trait) std::erase_if(kept, [&](const Delivery& delivery) { return has(delivery, trait); });
  return kept;
}

}  // namespace evalcts::gl
