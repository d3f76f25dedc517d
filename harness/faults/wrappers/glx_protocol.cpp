// Faults against section 25 of the requirements: requests that an indirect GLX client sends, and replies that
// it reads. A rule that replaces a command by another one makes the client send another request.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "grid_steps.h"

namespace evalcts::faults::glx_protocol {
namespace {

constexpr std::string_view kImplementation = "glx-indirect";

// Index of the last value of the control points. Queries only the order.
const Value kLastCoefficient = [](Call& c) {
  GLint order[2] = {1, 1};
  unmodified.GetMapiv(c.target(), GL_ORDER, order);
  return order[0] * order[1] * gl::components_of(c.target()) - 1;
};

// --- Requests ----------------------------------------------------------------------------------------------

FAULT(GridSentAsDoubles, "EV-GLX-OPCODES", "MapGrid1f travels as MapGrid1d",
      instead(MapGrid1f, call(MapGrid1d, {kSegments, kU1, kU2})));
FAULT(EvalPointSentAsMesh, "EV-GLX-OPCODES", "EvalPoint1 travels as EvalMesh1 of one point",
      instead(EvalPoint1, call(EvalMesh1, {GL_POINT, kI, kI})));
FAULT(Mesh2SwapsRanges, "EV-GLX-OPCODES", "EvalMesh2 travels with j before i",
      before(EvalMesh2, {swap(kI1, kJ1), swap(kI2, kJ2)}));
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
FAULT(ScalarPairSentAsDoubles, "EV-GLX-SCALAR", "EvalCoord2f travels as EvalCoord2dv",
      instead(EvalCoord2f, call(EvalCoord2d, {kU, kV})));
FAULT(ScalarPairSwapped, "EV-GLX-SCALAR", "EvalCoord2d travels as EvalCoord2dv of (v, u)",
      before(EvalCoord2d, swap(kU, kV)));

// --- Points ------------------------------------------------------------------------------------------------

FAULT(PaddedPointsSentAsTheyAre, "EV-GLX-MAP1-PACK",
      "where the stride of Map1f is above k the values are sent from the first on, padding and all",
      before(Map1f, is_map1(kTarget), set(kStride, min(kStride, kComponents))));
FAULT(LastPointOfMap1dLost, "EV-GLX-MAP1-PACK",
      "where the stride of Map1d is above k the last point is sent as the one before it",
      before(Map1d, kStride > kComponents && kOrder >= 2, change_points([](Net& net) {
               std::copy_n(net.point(net.rows - 2), net.components, net.point(net.rows - 1));
             })));
FAULT(DomainOfMap1Sorted, "EV-GLX-MAP1-PACK", "Map1d sends the smaller end of the domain first",
      before(Map1d, kU1 > kU2, swap(kU1, kU2)));
FAULT(NetSentColumnByColumn, "EV-GLX-MAP2-PACK", "Map2f sends its points with u running faster",
      before(Map2f, change_points([](Net& net) { net = net.transposed(); })));
FAULT(VMajorNetSentAsItLies, "EV-GLX-MAP2-PACK",
      "a net of Map2d that is packed the other way round is sent as it lies in memory",
      before(Map2d, is_map2(kTarget) && kStride == kComponents && kVStride == kComponents * kOrder,
             {set(kStride, kComponents* kVOrder), set(kVStride, kComponents)}));
FAULT(OverlappingNetSentPacked, "EV-GLX-MAP2-PACK",
      "where the strides of Map2f are equal ustride is taken for k * vorder",
      before(Map2f, kStride == kVStride && kOrder > 1 && kVOrder > 1, change_points([](Net& net, Call& c) {
               const int stride = c.integer('s'), last = (net.rows - 1 + net.columns - 1) * stride;
               for (int i = 0; i < net.rows; ++i)
                 for (int j = 0; j < net.columns; ++j)
                   for (int k = 0; k < net.components; ++k)
                     net.point(i, j)[k] =
                         c.read(static_cast<std::size_t>(std::min((i * net.columns + j) * stride, last) + k));
             })));
FAULT(LargeNetOneRowShort, "EV-GLX-LARGE", "a net of Map2d of more than 16 rows is sent without the last",
      before(Map2d, kOrder > 16, set(kOrder, kOrder - 1)));
FAULT(LargePartRepeated, "EV-GLX-LARGE", "of a large Map2f the second part has the values of the first",
      before(Map2f, kOrder* kVOrder > 256, change_points([](Net& net) {
               const std::ptrdiff_t part = std::ssize(net.values) / 4;
               std::copy_n(net.values.begin(), part, net.values.begin() + part);
             })));
FAULT(CommandAfterLargeLost, "EV-GLX-LARGE", "the first MapGrid1f after a large map is not sent",
      after(kMap2, set(kFlag, kOrder* kVOrder > 256)), instead(MapGrid1f, kFlag, set(kFlag, 0)));

// --- Grids -------------------------------------------------------------------------------------------------

FAULT(GridOfDescendingEndsTurned, "EV-GLX-MAPGRID", "MapGrid1d sends the smaller end first",
      before(MapGrid1d, kU1 > kU2, swap(kU1, kU2)));
FAULT(Grid2fDirectionsSwapped, "EV-GLX-MAPGRID", "MapGrid2f sends v before u",
      before(MapGrid2f, {swap(kSegments, kVSegments), swap(kU1, kV1), swap(kU2, kV2)}));
FAULT(Grid2dSegmentsSwapped, "EV-GLX-MAPGRID", "MapGrid2d sends vn before un",
      before(MapGrid2d, swap(kSegments, kVSegments)));

// --- Errors ------------------------------------------------------------------------------------------------

FAULT(UnknownTargetNotSent, "EV-GLX-ERRONEOUS", "Map1f with an unknown target does nothing",
      skip(Map1f, !is_map1(kTarget)));
FAULT(UnknownTargetTakenForAStride, "EV-GLX-ERRONEOUS",
      "the client takes an unknown target of Map2 for a stride that is too small",
      instead(kMap2, !is_map2(kTarget), call(MapGrid1f, {0, 0, 1})));
FAULT(NegativeOrderSentAsOne, "EV-GLX-ERRONEOUS",
      "a Map2d of a negative vorder is sent as one of order 1 with its points",
      before(Map2d, set(kVOrder, max(kVOrder, 1))));
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
FAULT(SmallStrideSentPacked, "EV-GLX-STRIDE-CLIENT", "Map1f sends a stride below k as packed points",
      before(Map1f, set(kStride, max(kStride, kComponents))));
FAULT(SmallVStrideNotChecked, "EV-GLX-STRIDE-CLIENT", "the client checks ustride and not vstride",
      before(kMap2, set(kVStride, max(kVStride, kComponents))));
FAULT(SmallStrideReportedTwice, "EV-GLX-STRIDE-CLIENT",
      "a stride of Map1d below k is an error of the client and once more of the server",
      after(Map1d, kStride < kComponents, set(kFlag, 1)),
      after(GetError, kResult == GL_NO_ERROR && kFlag, {set(kFlag, 0), set(kResult, GL_INVALID_VALUE)}));
FAULT(SmallUStrideDefinesAllTheSame, "EV-GLX-STRIDE-CLIENT",
      "Map2f with a ustride below k raises the error and sends the map",
      after(Map2f, kStride<kComponents && kOrder> 0 && kVOrder > 0, {set(kStride, 3), kGo}));

// --- Replies -----------------------------------------------------------------------------------------------

// The header of a reply holds a single value; several values follow the header.
FAULT(ReplyOfOneValueIgnored, "EV-GLX-GETMAP-REPLY", "GetMapiv does not write the value of a reply of one",
      around(GetMapiv, kQuery == GL_ORDER && is_map1(kTarget), set(kNumber, element(0)), put(0, kNumber)));
FAULT(ReplyOfOneDoubleIsFloat, "EV-GLX-GETMAP-REPLY",
      "of a reply of one double GetMapdv takes the first four bytes for a float",
      after(GetMapdv, kTarget == GL_MAP1_INDEX && kQuery != GL_DOMAIN, [](Call& c) {
        GLfloat half = 0;
        std::memcpy(&half, c.pointer, sizeof half);
        c.write(0, double{half});
      }));
FAULT(ReplyOneValueLong, "EV-GLX-GETMAP-REPLY", "GetMapfv writes one value more than the reply has",
      after(GetMapfv, kQuery == GL_DOMAIN, put(choose(is_map2(kTarget), 4, 2), 0)));
FAULT(ReplyLastValueLost, "EV-GLX-GETMAP-REPLY", "GetMapfv does not write the last of several points",
      before(GetMapfv, kQuery == GL_COEFF, set(kCount, kLastCoefficient)),
      around(GetMapfv, kQuery == GL_COEFF && kCount > 0, set(kNumber, element(kCount)),
             put(kCount, kNumber)));

// --- The same result ---------------------------------------------------------------------------------------

FAULT(IndirectSurfacesWithoutColors, "EV-GLX-SAMERESULT", "colours of surfaces are not drawn indirectly",
      skip(Enable, kName == GL_MAP2_COLOR_4));
FAULT(IndirectArgumentsRounded, "EV-GLX-SAMERESULT", "EvalCoord1f is sent with one bit behind the point",
      before(EvalCoord1f, set(kU, [](Call& c) { return std::nearbyint(c.argument('u') * 2) / 2; })));
FAULT(IndirectMeshDrawsFirstRow, "EV-GLX-SAMERESULT", "of EvalMesh2 the first row alone is drawn indirectly",
      before(EvalMesh2, set(kJ2, kJ1)));
FAULT(IndirectGridIsInitial, "EV-GLX-SAMERESULT", "EvalPoint1 has the initial grid indirectly",
      instead(EvalPoint1, call(EvalCoord1f, {kI})));
FAULT(IndirectVIsZero, "EV-GLX-SAMERESULT", "v of EvalCoord2f is not drawn indirectly",
      before(EvalCoord2f, set(kV, 0)));

}  // namespace
}  // namespace evalcts::faults::glx_protocol
