// Variations seen in old software GLs and in layers over other APIs: explicit vertices are wrong in the same
// way, or little can be observed.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "rules.h"

namespace evalcts::faults::poor_libraries {
namespace {

constexpr std::string_view kImplementation = "dropin";

const Entries kVertices = Vertex2f | Vertex2d | Entries(Vertex3f) | Vertex3d | Vertex4f | Vertex4d |
                          Vertex2fv | Vertex3fv | Vertex4fv | Vertex2dv | Vertex3dv | Vertex4dv;

void discard_errors(Call&) {
  while (unmodified.GetError() != GL_NO_ERROR) continue;
}

// --- Explicit vertices are wrong as well -------------------------------------------------------------------

VARIATION(EdgeFlagLost, "", "behind vertices, the query of EDGE_FLAG answers garbage",
          after(kVertices, set(kFlag, 1)), after(kPoints1 | EvalMesh1, maps_vertices(1), set(kFlag, 1)),
          after(kPoints2 | EvalMesh2, maps_vertices(2), set(kFlag, 1)),
          before(EdgeFlag | EdgeFlagv, set(kFlag, 0)),
          after(kGet, kName == GL_EDGE_FLAG && kFlag && !kInside, put(0, 173)));

VARIATION(CurrentColorOf8Bits, "", "the current colour is answered with 8 bits for each component",
          after(GetFloatv | GetDoublev, kName == GL_CURRENT_COLOR && !kInside, [](Call& c) {
            for (std::size_t i = 0; i < 4; ++i) c.write(i, std::floor(c.read(i) * 255) / 255);
          }));

// The error of End outside of a primitive is raised by the next of these commands. Lists may leave primitives
// open.
const Place kMayBeOpen = kept(0);
VARIATION(LateErrors, "", "the error of End outside of a primitive is raised by a later command",
          instead(End, !kMayBeOpen && !kListMode, set(kFlag, 1)), after(End, set(kMayBeOpen, 0)),
          before(Begin | kSwitches | kMaps | kMapGrids | kMeshes | kGet, kFlag && !kListMode,
                 {call(End), set(kFlag, 0)}),
          after(Begin | Entries(CallList) | CallLists, set(kMayBeOpen, 1)));

VARIATION(RasterTextureLost, "",
          "behind explicit vertices, the texture coordinates of the raster position are answered wrongly",
          after(kVertices, set(kFlag, 1)), after(kPoints | kMeshes, set(kFlag, 0)),
          after(GetFloatv, kName == GL_CURRENT_RASTER_TEXTURE_COORDS && kFlag && !kInside,
                answer({0, 0, 0, 0})));

VARIATION(ErrorsOfListsLost, "", "the commands of a display list raise no errors",
          before(EndList, set(kFlag, kListMode == GL_COMPILE_AND_EXECUTE)),
          after(EndList, kFlag, discard_errors),
          after(Entries(CallList) | CallLists, !kInside, discard_errors),
          after(GetError, kListMode == GL_COMPILE_AND_EXECUTE, set(kResult, GL_NO_ERROR)));

VARIATION(NormalOutsideOfPrimitives, "",
          "Normal raises INVALID_OPERATION outside of Begin and End, and has no effect there",
          instead(Normal3f | Normal3d | Entries(Normal3fv) | Normal3dv, !kInside && !kListMode,
                  error_now(GL_INVALID_OPERATION)));

VARIATION(AttributeStackNotInLists, "", "PushAttrib and PopAttrib are not compiled into lists",
          skip(PushAttrib | PopAttrib, kListMode));

VARIATION(NotANumberKills, "", "a vertex that is not finite ends the process",
          before(kVertices | kEvalCoords, [](Call& c) {
            for (const double number : c.numbers)
              if (!std::isfinite(number)) std::abort();
            for (std::size_t i = 0;
                 c.pointer && i < (c.entry == EvalCoord1fv || c.entry == EvalCoord1dv ? 1 : 2); ++i)
              if (!std::isfinite(c.read(i))) std::abort();
          }));

}  // namespace
}  // namespace evalcts::faults::poor_libraries
