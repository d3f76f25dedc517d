// Faults against section 9 of the requirements: precedence among several enabled maps.
#include <algorithm>

#include "rules.h"

namespace evalcts::faults::precedence {
namespace {

FAULT(LastEnabledVertexMapWins, "EV-PREC-VERTEX EV-PREC-ORDERFREE",
      "VERTEX_3 takes precedence if it was enabled after VERTEX_4",
      after(Enable, kName == GL_MAP1_VERTEX_3 || kName == GL_MAP2_VERTEX_3, disable(kName + 1)));
FAULT(BothVertexMapsDraw, "EV-PREC-VERTEX", "EvalPoint1 draws a vertex for each of two enabled vertex maps",
      after(EvalPoint1, noted_on(GL_MAP1_VERTEX_3) && noted_on(GL_MAP1_VERTEX_4), kGo));
FAULT(Vertex3WinsBesideColors, "EV-PREC-VERTEX", "with a colour map enabled VERTEX_3 goes before VERTEX_4",
      only_if(GL_MAP1_VERTEX_4, !noted_on(GL_MAP1_COLOR_4) || !noted_on(GL_MAP1_VERTEX_3)));
FAULT(EnableReplacesTextureMap, "EV-PREC-TEX EV-PREC-ORDERFREE EV-PREC-FALLBACK",
      "Enable of a texture map switches the others off",
      after(Enable, is_map1(kName) && is_texture_map(kName),
            loop(kCount, GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_4,
                 when(kCount != kName, disable(kCount)))));

// The other pairs of maps are not affected.
FAULT(TextureCoord3BeforeTextureCoord4, "EV-PREC-TEX",
      "TEXTURE_COORD_3 goes before TEXTURE_COORD_4 where 1 and 2 are disabled",
      only_if(GL_MAP1_TEXTURE_COORD_4, !noted_on(GL_MAP1_TEXTURE_COORD_3) ||
                                           noted_on(GL_MAP1_TEXTURE_COORD_1) ||
                                           noted_on(GL_MAP1_TEXTURE_COORD_2)));
FAULT(TextureCoord1GivesS, "EV-PREC-LOSER-IGNORED",
      "TEXTURE_COORD_3 takes its s from the points of TEXTURE_COORD_1, as far as there are",
      before(kMap1, kTarget == GL_MAP1_TEXTURE_COORD_3, change_points([](Net& net) {
               Net narrow = current_map(GL_MAP1_TEXTURE_COORD_1).net;
               for (int i = 0; i < std::min(net.rows, narrow.rows); ++i) *net.point(i) = *narrow.point(i);
             })));
FAULT(FallbackSkipsTextureCoord2, "EV-PREC-FALLBACK",
      "after Disable of TEXTURE_COORD_3 its next is TEXTURE_COORD_1",
      after(Disable, kName == GL_MAP1_TEXTURE_COORD_3 && noted_on(GL_MAP1_TEXTURE_COORD_1),
            disable(GL_MAP1_TEXTURE_COORD_2)));
FAULT(FallbackFromVertex4Lost, "EV-PREC-FALLBACK",
      "Disable of VERTEX_4 of surfaces disables VERTEX_3 where a texture map was enabled",
      after(Disable, kName == GL_MAP2_VERTEX_4, disable(GL_MAP2_VERTEX_3)));
FAULT(ColorSuppressesNormalBesideTexture, "EV-PREC-PERKIND",
      "the normal map of surfaces loses to a colour and a texture map together",
      only_if(GL_MAP2_NORMAL, !noted_on(GL_MAP2_COLOR_4) ||
                                  !(noted_on(GL_MAP2_TEXTURE_COORD_1) || noted_on(GL_MAP2_TEXTURE_COORD_2) ||
                                    noted_on(GL_MAP2_TEXTURE_COORD_3) || noted_on(GL_MAP2_TEXTURE_COORD_4))));
FAULT(UndefinedTextureMapGivesWay, "EV-PREC-NOVALIDITY",
      "a texture map that was never defined is skipped for one that was",
      before(kMap1, kTarget == GL_MAP1_TEXTURE_COORD_4, set(kFlag, 1)),
      skip(Enable, kName == GL_MAP1_TEXTURE_COORD_4 && !kFlag));
FAULT(UndefinedVertexMapGivesWay, "EV-PREC-NOVALIDITY",
      "MAP2_VERTEX_4 takes precedence only after it was defined",
      before(kMap2, kTarget == GL_MAP2_VERTEX_4, set(kFlag, 1)),
      skip(Enable, kName == GL_MAP2_VERTEX_4 && !kFlag));

}  // namespace
}  // namespace evalcts::faults::precedence
