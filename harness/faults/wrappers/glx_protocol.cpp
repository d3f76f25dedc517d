// Faults against section 25 of the requirements: requests that an indirect GLX client sends, and replies that
// it reads. A rule that replaces a command by another one makes the client send another request.
#include <cmath>

#include "rules.h"

namespace evalcts::faults::glx_protocol {
namespace {

constexpr std::string_view kImplementation = "glx-indirect";

FAULT(EvalPointSentAsMesh, "EV-GLX-OPCODES", "EvalPoint1 travels as EvalMesh1 of one point",
      instead(EvalPoint1, call(EvalMesh1, {GL_POINT, kI, kI})));
FAULT(NegativePointsNotSent, "EV-GLX-OPCODES", "EvalPoint2 with a negative index is not sent",
      skip(EvalPoint2, kI < 0 || kJ < 0));
FAULT(GetMapivThroughFloats, "EV-GLX-SINGLES", "GetMapiv asks for floats and converts them",
      instead(GetMapiv, [](Call& c) {
        std::array<GLfloat, 256> values{};
        unmodified.GetMapfv(c.target(), static_cast<GLenum>(c.argument('q')), values.data());
        c.write(0, std::trunc(values[0]));
      }));
FAULT(GetMapdvAsksOrderFirst, "EV-GLX-SINGLES", "GetMapdv asks for the order before the points",
      before(GetMapdv, kQuery == GL_COEFF, [](Call& c) {
        GLint order[2];
        unmodified.GetMapiv(c.target(), GL_ORDER, order);
      }));
FAULT(ScalarDoubleSentAsFloat, "EV-GLX-SCALAR", "EvalCoord1d travels as EvalCoord1fv",
      instead(EvalCoord1d, call(EvalCoord1f, {kU})));
FAULT(ScalarPairSwapped, "EV-GLX-SCALAR", "EvalCoord2d travels as EvalCoord2dv of (v, u)",
      before(EvalCoord2d, swap(kU, kV)));
FAULT(PaddedPointsSentAsTheyAre, "EV-GLX-MAP1-PACK",
      "where the stride of Map1f is above k the values are sent from the first on, padding and all",
      before(Map1f, is_map1(kTarget), set(kStride, min(kStride, kComponents))));
FAULT(DomainOfMap1Sorted, "EV-GLX-MAP1-PACK", "Map1d sends the smaller end of the domain first",
      before(Map1d, kU1 > kU2, swap(kU1, kU2)));
FAULT(NetSentColumnByColumn, "EV-GLX-MAP2-PACK", "Map2f sends its points with u running faster",
      before(Map2f, change_points([](Net& net) { net = net.transposed(); })));
FAULT(VMajorNetSentAsItLies, "EV-GLX-MAP2-PACK",
      "a net of Map2d that is packed the other way round is sent as it lies in memory",
      before(Map2d, is_map2(kTarget) && kStride == kComponents && kVStride == kComponents * kOrder,
             {set(kStride, kComponents* kVOrder), set(kVStride, kComponents)}));
FAULT(LargeNetOneRowShort, "EV-GLX-LARGE", "a net of Map2d of more than 16 rows is sent without the last",
      before(Map2d, kOrder > 16, set(kOrder, kOrder - 1)));
FAULT(CommandAfterLargeLost, "EV-GLX-LARGE", "the first MapGrid1f after a large map is not sent",
      after(kMap2, set(kFlag, kOrder* kVOrder > 256)), instead(MapGrid1f, kFlag, set(kFlag, 0)));
FAULT(GridOfDescendingEndsTurned, "EV-GLX-MAPGRID", "MapGrid1d sends the smaller end first",
      before(MapGrid1d, kU1 > kU2, swap(kU1, kU2)));
FAULT(Grid2dSegmentsSwapped, "EV-GLX-MAPGRID", "MapGrid2d sends vn before un",
      before(MapGrid2d, swap(kSegments, kVSegments)));
FAULT(ZeroVOrderNotSent, "EV-GLX-ERRONEOUS", "a Map2f of vorder 0 does nothing", skip(Map2f, kVOrder == 0));
FAULT(NegativeOrderOfMap1fIsInvalidEnum, "EV-GLX-ERRONEOUS",
      "a Map1f of a negative order raises INVALID_ENUM", before(Map1f, kOrder < 0, set(kTarget, 0)));
FAULT(NegativeUOrderOfMap2dNotSent, "EV-GLX-ERRONEOUS", "a Map2d of a negative uorder does nothing",
      skip(Map2d, kOrder < 0));
FAULT(SmallVStrideOfMap2fNotChecked, "EV-GLX-STRIDE-CLIENT", "vstride of Map2f is not checked",
      before(Map2f, set(kVStride, max(kVStride, kComponents))));
FAULT(ZeroStrideMeansPacked, "EV-GLX-STRIDE-CLIENT", "stride 0 of Map1f means packed points",
      before(Map1f, kStride == 0, set(kStride, kComponents)));
FAULT(StrideOfOnePointNotChecked, "EV-GLX-STRIDE-CLIENT", "the stride of a Map1d of order 1 is not checked",
      before(Map1d, kOrder == 1, set(kStride, max(kStride, kComponents))));

// The header of a reply holds a single value; several values follow the header.
FAULT(ReplyOfOneValueIgnored, "EV-GLX-GETMAP-REPLY", "GetMapiv does not write the value of a reply of one",
      around(GetMapiv, kQuery == GL_ORDER && is_map1(kTarget), set(kNumber, element(0)), put(0, kNumber)));
FAULT(ReplyOneValueLong, "EV-GLX-GETMAP-REPLY", "GetMapfv writes one value more than the reply has",
      after(GetMapfv, kQuery == GL_DOMAIN, put(choose(is_map2(kTarget), 4, 2), 0)));
FAULT(IndirectMeshDrawsFirstRow, "EV-GLX-SAMERESULT", "of EvalMesh2 the first row alone is drawn indirectly",
      before(EvalMesh2, set(kJ2, kJ1)));
FAULT(IndirectGridIsInitial, "EV-GLX-SAMERESULT", "EvalPoint1 has the initial grid indirectly",
      instead(EvalPoint1, call(EvalCoord1f, {kI})));

}  // namespace
}  // namespace evalcts::faults::glx_protocol
