// Faults against sections 3 and 4 of the requirements: the state and the values of maps.
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "rules.h"

namespace evalcts::faults::maps {
namespace {

// Difference between a MAP2 token and the MAP1 token of the same kind.
constexpr GLenum kFrom1To2 = GL_MAP2_COLOR_4 - GL_MAP1_COLOR_4;

// Makes Map1 or Map2 keep the pointer of a call if the condition holds, and read the points again at the
// commands `later`.
Rules read_late(const Entries& maps, Value condition, const Entries& later) {
  return {after(maps, {drop(), when(kIsLegal && condition, hold())}), before(later, release())};
}

Value transpose() {
  return change_points([](Net& net) { net = net.transposed(); });
}

// Keeps memory until the process ends.
template <std::size_t bytes>
void keep_memory(Call&) {
  static std::vector<std::unique_ptr<std::array<char, bytes>>> kept;
  kept.push_back(std::make_unique<std::array<char, bytes>>());
}

FAULT(EvaluationsAreCounted, "EV-CTX-UNBOUNDED", "EvalCoord does nothing from the hundred-thousandth call on",
      before(kEvalCoords, set(kCount, kCount + 1)), skip(kEvalCoords, kCount > 100000));
FAULT(MapsInLateListsAreLost, "EV-CTX-UNBOUNDED", "maps are not compiled into lists from the 257th on",
      before(NewList, set(kCount, kCount + 1)), skip(kMaps, kListMode&& kCount > 256));
QUALITY_FAULT(MapsAreKept, "EV-CTX-UNBOUNDED", "each Map1 and Map2 keeps 256 bytes of memory for good",
              after(kMaps, keep_memory<256>));
QUALITY_FAULT(ListsWithMapsAreKept, "EV-CTX-UNBOUNDED",
              "each list with a map keeps 256 bytes of memory for good", before(NewList, set(kFlag, 0)),
              before(kMaps, kListMode, set(kFlag, 1)), after(EndList, kFlag, keep_memory<256>));
QUALITY_FAULT(ContextsWithMapsAreKept, "EV-CTX-UNBOUNDED",
              "each context with a map keeps 16 KiB of memory for good",
              before(kMaps, !kFlag, keep_memory<16384>), before(kMaps, set(kFlag, 1)));
FAULT(MapsAreCounted, "EV-CTX-UNBOUNDED", "Map1 and Map2 do nothing from the thousandth call on",
      before(kMaps, set(kCount, kCount + 1)), skip(kMaps, kCount > 1000));
FAULT(UpperEndAvoided, "EV-MAP1-ZEROPOW", "u2 is evaluated just below, at 0.999, so that 0^0 is never needed",
      before(kMap1, {set(kFlag, 1), keep({kU1, kU2})}),
      before(EvalCoord1d, kU == kept(1) && kFlag, set(kU, kU - 0.001 * (kU - kept(0)))));
FAULT(ReversedDomainSorted, "EV-MAP1-REVERSED EV-GETMAP-DOMAIN1", "Map1d sorts the ends of a domain",
      before(Map1d, kU1 > kU2, swap(kU1, kU2)));
FAULT(ClampedAboveInDoubles, "EV-MAP1-EXTRAPOLATE", "EvalCoord1d clamps u to the upper end of the domain",
      before(kMap1, {set(kFlag, 1), set(kNumber, max(kU1, kU2))}),
      before(EvalCoord1d, kFlag, set(kU, min(kU, kNumber))));
FAULT(OrderOneStartsAfterPadding, "EV-MAP1-ORDER-ONE EV-MAP1-PADDING",
      "the single point of a map of order 1 is taken from the end of its block",
      before(kMap1, kOrder == 1, change_points([](Net& net, Call& c) {
               for (int k = 0; k < net.components; ++k)
                 net.point(0)[k] = c.read(static_cast<std::size_t>(c.integer('s') - net.components + k));
             })));
FAULT(BlueFirstInDoubles, "EV-MAP1-COMPORDER", "Map1d takes the values of a colour in the order B,G,R,A",
      before(Map1d, kTarget == GL_MAP1_COLOR_4, swap_components(0, 2)));
FAULT(QBeforeR, "EV-MAP1-COMPORDER", "TEXTURE_COORD_4 maps are read in the order s,t,q,r",
      before(kMap1, kTarget == GL_MAP1_TEXTURE_COORD_4, swap_components(2, 3)));
FAULT(LargestColorMapRefused, "EV-MAP1-ORDER-ALL", "a map of more than 255 values raises INVALID_VALUE",
      before(kMap1, kOrder* kComponents > 255 && kIsLegal, set(kOrder, 0)));
FAULT(OddOrdersOfNormalsRoundedUp, "EV-MAP1-ORDER-ALL",
      "Map1d keeps NORMAL maps of odd orders above 8 with the order above",
      before(Map1d, kTarget == GL_MAP1_NORMAL && kOrder >= 9 && kOrder % 2 == 1, change_points([](Net& net) {
               net.values.resize(net.values.size() + 3);
               ++net.rows;
             })));
FAULT(NormalHasFourValues, "EV-MAP1-K EV-MAP1-STRIDE-MIN", "the stride of MAP1_NORMAL has to be 4 at least",
      before(kMap1, kTarget == GL_MAP1_NORMAL && kStride == 3, set(kStride, 0)));
FAULT(Texture3AnsweredAsFour, "EV-MAP1-K", "COEFF of MAP1_TEXTURE_COORD_3 answers one value too many",
      after(GetMapfv, kTarget == GL_MAP1_TEXTURE_COORD_3 && kQuery == GL_COEFF, put(answers(), 1)));
FAULT(StrideInOneByte, "EV-MAP1-STRIDE", "the stride is kept in a byte: 257 becomes 1",
      before(kMap1, kStride % 256 >= kComponents && kIsLegal, set(kStride, kStride % 256)));
FAULT(DoubleStrideInFloats, "EV-MAP1-STRIDE", "Map1d counts even strides of 2k or more in floats",
      before(Map1d, kStride % 2 == 0 && kStride / 2 >= kComponents, set(kStride, kStride / 2)));
FAULT(PaddingTimesZero, "EV-MAP1-PADDING EV-MAP2-PADDING",
      "the value behind each point but the last is added to it with weight zero",
      before(kMaps, kStride > kComponents && (is_map1(kTarget) || kVStride > kComponents),
             change_points([](Net& net, Call& c) {
               for (int i = 0; i < net.rows; ++i)
                 for (int j = 0; j < net.columns; ++j)
                   if (i + 1 < net.rows || j + 1 < net.columns)
                     *net.point(i, j) += 0 * c.read(c.place(i, j, net.components));
             })));
FAULT(TightTexture1Refused, "EV-MAP1-STRIDE-MIN", "MAP1_TEXTURE_COORD_1 rejects stride 1 above order 1",
      before(kMap1, kTarget == GL_MAP1_TEXTURE_COORD_1 && kStride == 1 && kOrder > 1, set(kStride, 0)));
FAULT(SinglePointReadLate, "EV-MAP1-COPY",
      "Map1d of order 1 keeps the pointer until the map is queried or a primitive begins",
      read_late(Map1d, kOrder == 1, kGetMap | Begin));
FAULT(PackedPointsNotCopied, "EV-MAP1-COPY", "Map1d keeps the pointer to points that need no packing",
      read_late(Map1d, kStride == kComponents, kGetMap));
FAULT(SamePointerNotReadAgain, "EV-MAP1-REPLACE EV-MAP1-LIVE",
      "Map1 of the same target, order and pointer as the last one reads no points",
      before(kMap1, kIsLegal,
             {set(kFlag, kNumber == kAddress && kept(0) == kTarget && kept(1) == kOrder),
              set(kNumber, kAddress), keep({kTarget, kOrder}), repeat_points(kFlag)}));
FAULT(OrderNeverShrinks, "EV-MAP1-REPLACE", "GetMapiv answers the largest order that MAP1_INDEX ever had",
      before(kMap1, kTarget == GL_MAP1_INDEX && kIsLegal, set(kCount, max(kCount, kOrder))),
      after(GetMapiv, kTarget == GL_MAP1_INDEX && kQuery == GL_ORDER && kCount, put(0, kCount)));
FAULT(TextureMapsShareDomain, "EV-MAP1-INDEP", "MAP1_TEXTURE_COORD_1 takes the domain of other texture maps",
      after(kMap1, kTarget > GL_MAP1_TEXTURE_COORD_1 && kIsLegal && kTarget <= GL_MAP1_TEXTURE_COORD_4,
            redefine(GL_MAP1_TEXTURE_COORD_1, take_u)));
FAULT(VertexMapsShareStorage, "EV-MAP1-INDEP", "Map1 of VERTEX_4 overwrites the first value of VERTEX_3",
      after(kMap1, kTarget == GL_MAP1_VERTEX_4 && kIsLegal,
            redefine(GL_MAP1_VERTEX_3, [](Map& map, Call& c) { map.net.values[0] = c.read(0); })));
FAULT(FlatMap2IsMap1, "EV-MAP1-VS-MAP2/2-D", "a Map2 of vorder 1 defines the map of curves as well",
      after(kMap2, kVOrder == 1 && kIsLegal, [](Call& c) {
        Map{c.target() - kFrom1To2, c.argument('a'), c.argument('b'), 0, 1, c.net()}.define();
      }));
FAULT(Map1SetsConstantNamesake, "EV-MAP1-VS-MAP2/1-D",
      "a Map1 of order 1 sets the point of the two-dimensional namesake, if that is constant",
      after(kMap1, kOrder == 1 && kIsLegal, redefine(kTarget + kFrom1To2, [](Map& map, Call& c) {
              if (map.net.rows * map.net.columns == 1) map.net.values = c.net().values;
            })));
FAULT(Vertex4SwitchesVertex3Off, "EV-MAP1-NOENABLE", "Map1 of VERTEX_4 disables VERTEX_3",
      after(kMap1, kTarget == GL_MAP1_VERTEX_4 && kIsLegal, disable(GL_MAP1_VERTEX_3)));
FAULT(ReversedClampedAbove, "EV-MAP1-EXTRAPOLATE", "u is clamped to the upper end of a reversed domain",
      before(kMap1, {set(kFlag, kU1 > kU2), set(kNumber, kU1)}),
      before(EvalCoord1f, kFlag, set(kU, min(kU, kNumber))));
FAULT(SymmetricDomainTakenForUnit, "EV-MAP1-DOMAIN", "a domain from -a to a is taken for one from 0 to a",
      before(kMap1, kU1 == -kU2 && kU2 > 0, set(kU1, 0)));
FAULT(RowsTakenAsAdjacent, "EV-MAP2-ADDRESS EV-MAP2-PADDING",
      "ustride is ignored while it is larger than a packed row of v",
      before(kMap2, kStride > kVOrder * kVStride && kIsLegal && kVOrder > 2,
             set(kStride, kVOrder* kVStride)));
FAULT(EqualStridesRefused, "EV-MAP2-STRIDE-FREE", "equal strides of a net raise INVALID_VALUE",
      before(kMap2, kStride == kVStride && kIsLegal && kOrder > 1 && kVOrder > 1, set(kStride, 0)));
FAULT(VStrideInSixteenBits, "EV-MAP2-STRIDE-FREE EV-MAP2-ADDRESS", "vstride is kept in 16 bits",
      before(kMap2, kVStride % 65536 >= kComponents && kIsLegal, set(kVStride, kVStride % 65536)));
FAULT(VStrideOfDoublesInFloats, "EV-MAP2-STRIDE-UNITS", "Map2d counts an even vstride above k in floats",
      before(Map2d, kVStride % 2 == 0 && kIsLegal && kVStride / 2 >= kComponents,
             set(kVStride, kVStride / 2)));
FAULT(UStrideOfDoublesInFloats, "EV-MAP2-STRIDE-UNITS", "Map2d counts an even ustride above k in floats",
      before(Map2d, kStride % 2 == 0 && kIsLegal && kStride / 2 >= kComponents, set(kStride, kStride / 2)));
FAULT(ReversedVSorted, "EV-MAP2-REVERSED", "Map2f sorts the ends of v",
      before(Map2f, kV1 > kV2, swap(kV1, kV2)));
FAULT(VClampedBeyondCorners, "EV-MAP2-EXTRAPOLATE", "where u is outside, v is clamped to its interval",
      before(kMap2, kTarget >= GL_MAP2_VERTEX_3,
             {set(kFlag, 1), keep({min(kU1, kU2), max(kU1, kU2), min(kV1, kV2), max(kV1, kV2)})}),
      before(kEvalCoord2, kFlag && (kU < kept(0) || kU > kept(1)), set(kV, clamp(kV, kept(2), kept(3)))));
FAULT(UClampedFromBelow, "EV-MAP2-EXTRAPOLATE", "EvalCoord2d takes a negative u over a unit interval as 0",
      before(kMap2, set(kFlag, kU1 == 0 && kU2 == 1)), before(EvalCoord2d, kFlag, set(kU, max(kU, 0))));
FAULT(WideNetsTransposed, "EV-MAP2-ASYM", "a net with uorder below vorder is read with the row length of u",
      before(kMap2, kOrder < kVOrder, transpose()));
FAULT(ColorsOfOrderOneInUDrift, "EV-MAP2-ORDER-ONE",
      "the last color of a map of uorder 1 and vorder 3 or more is that before it",
      before(kMap2, kTarget == GL_MAP2_COLOR_4 && kOrder == 1 && kVOrder >= 3, change_points([](Net& net) {
               std::copy_n(net.point(0, net.columns - 2), net.components, net.point(0, net.columns - 1));
             })));
FAULT(LargestNetRefused, "EV-MAP2-ORDER-ALL", "a net of 4096 points raises INVALID_VALUE",
      before(kMap2, kOrder* kVOrder > 4095 && kIsLegal, set(kOrder, 0)));
FAULT(LongRowsOfNormalsRefused, "EV-MAP2-ORDER-ALL", "Map2d takes no NORMAL net of one longest row",
      before(Map2d, kTarget == GL_MAP2_NORMAL && kOrder == 1 && kVOrder == kMaxOrder, set(kOrder, 0)));
FAULT(Color2TakesThreeInU, "EV-MAP2-K EV-MAP2-ERR-USTRIDE", "Map2 of COLOR_4 is content with a ustride of 3",
      before(kMap2, kTarget == GL_MAP2_COLOR_4 && kStride == 3, set(kStride, 4)));
FAULT(IndexAnsweredAsTexture2, "EV-MAP2-K", "COEFF of MAP2_INDEX answers two values a point",
      after(kGetMap, kTarget == GL_MAP2_INDEX && kQuery == GL_COEFF,
            loop(kCount, answers(), 2 * answers() - 1, put(kCount, 0))));
FAULT(LargeNetReadLate, "EV-MAP2-COPY", "Map2f keeps the pointer to a large net until it is queried",
      read_late(Map2f, kOrder* kVOrder > 1000, kGetMap));
FAULT(PackedNetReadWhenDrawn, "EV-MAP2-COPY", "Map2f keeps the pointer to a packed net until the next Begin",
      read_late(Map2f, kVStride == kComponents && kStride == kComponents * kVOrder, Begin));
FAULT(Map2EnablesFirstDefinition, "EV-MAP2-NOENABLE", "the first Map2d of INDEX enables it",
      after(Map2d, kTarget == GL_MAP2_INDEX && !kFlag, {set(kFlag, 1), enable(GL_MAP2_INDEX)}));
FAULT(FirstDefinitionDisables, "EV-MAP1-NOENABLE EV-MAP2-NOENABLE",
      "the first definition of a texture map disables it",
      after(kMaps, is_texture_map(kTarget) && kIsLegal && !remembered(kTarget),
            {set(remembered(kTarget), 1), disable(kTarget)}));
FAULT(OrderQueryCached, "EV-MAP2-REPLACE", "GetMapiv answers the vorder that it answered last for the uorder",
      after(GetMapiv, kQuery == GL_ORDER && is_map2(kTarget),
            {set(kNumber, 100 * kTarget + element(0)),
             when(!remembered(kNumber), set(remembered(kNumber), element(1))), put(1, remembered(kNumber))}));
FAULT(SecondColumnWeighsLess, "EV-MAP2-SEPARABLE",
      "the second weight of v is a hundredth too small, and so the weights do not add up to 1",
      before(kMap2, kVOrder >= 3, change_points([](Net& net) {
               for (int i = 0; i < net.rows; ++i)
                 for (int k = 0; k < net.components; ++k) net.point(i, 1)[k] *= 0.99;
             })));

namespace on_osmesa {
constexpr std::string_view kImplementation = "osmesa";
FAULT(PixelsSkippedBeforePoints, "EV-MAP1-NOPIXELSTORE", "with UNPACK_SKIP_PIXELS Map1d reads zeros",
      before(PixelStorei, kFirst == GL_UNPACK_SKIP_PIXELS, set(kFlag, kSecond)),
      before(Map1d, kFlag, change_values([](double) { return 0.0; })));
FAULT(AlignedPointsRefused, "EV-MAP1-NOPIXELSTORE",
      "Map1f with an odd stride and UNPACK_ALIGNMENT 8 raises INVALID_OPERATION",
      before(PixelStorei, kFirst == GL_UNPACK_ALIGNMENT, set(kFlag, kSecond == 8)),
      instead(Map1f, kStride % 2 == 1 && kFlag, error(GL_INVALID_OPERATION)));
FAULT(PointsFromArrayBuffer, "EV-MAP1-NOBUFFER", "with an ARRAY_BUFFER bound Map1 reads zeros from it",
      before(kMap1, has_buffer(GL_ARRAY_BUFFER), change_values([](double) { return 0.0; })));
FAULT(UnpackBufferRefusesMap1d, "EV-MAP1-NOBUFFER",
      "with a PIXEL_UNPACK_BUFFER bound Map1d does nothing but raise INVALID_OPERATION",
      instead(Map1d, has_buffer(GL_PIXEL_UNPACK_BUFFER), error(GL_INVALID_OPERATION)));
}  // namespace on_osmesa

}  // namespace
}  // namespace evalcts::faults::maps
