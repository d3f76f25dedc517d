// Faults in connected primitives and meshes that are longer than a vertex buffer.
#include "rules.h"

namespace evalcts::faults::long_primitives {
namespace {

FAULT(NormalLostEvery4096Vertices, "EV-CUR-NORMAL",
      "every 4096th evaluated vertex of a primitive leaves its normal as the current one",
      before(Begin, set(kCount, 0)),
      after(kPoints, {set(kCount, kCount + 1), when(kCount % 4096 == 0, call(Normal3f, {0, 0, 1}))}));
FAULT(TexCoordLostEvery4096Vertices, "EV-CUR-NEXTVERTEX EV-COORD-MIX",
      "the first Vertex after 4096 evaluated vertices of a primitive has the texture coordinates (0,0,0,1)",
      before(Begin, set(kCount, 0)), before(kPoints, set(kCount, kCount + 1)),
      before(Vertex3f, kCount > 4096, {set(kCount, 0), call(TexCoord4f, {0, 0, 0, 1})}));

// Gives the first vertex of each further buffer of `buffer` vertices the colour of the
// primitive's first vertex.
void take_color_of_the_first(ObservedPrimitive& primitive, std::size_t buffer) {
  for (std::size_t i = buffer; i < primitive.vertices.size(); i += buffer)
    primitive.vertices[i].color = primitive.vertices[0].color;
}
FAULT(ColorOfTheFirstEvery32768Vertices, "EV-COORD-PRIMS EV-COORD-ASIF",
      "every 32768th vertex of a primitive has the colour of the first one",
      change_primitives([](ObservedPrimitive& primitive) { take_color_of_the_first(primitive, 32768); }));
FAULT(NormalDroppedBeyond16384Vertices, "EV-MESH1-LINE EV-MESH2-LINE EV-MESH2-FILL",
      "vertices of a mesh have the normal (0,0,1) from the 16384th on", before(kMeshes, set(kFlag, 1)),
      before(Begin, set(kFlag, 0)), change_output(kFlag, [](Primitives& primitives) {
        for (ObservedPrimitive& primitive : primitives)
          for (std::size_t i = 16384; i < primitive.vertices.size(); ++i)
            primitive.vertices[i].normal = {0, 0, 1};
      }));

}  // namespace
}  // namespace evalcts::faults::long_primitives
