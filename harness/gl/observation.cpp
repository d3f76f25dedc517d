// Names attributes in messages, and determines kinds of primitives.
#include <evalcts/gl/observation.h>

#include <utility>

namespace evalcts {

std::string describe(Attributes attributes) {
  constexpr std::pair<Attribute, const char*> kNames[] = {
      {kPosition, "position"},
      {kColor, "colour"},
      {kNormal, "normal"},
      {kTextureCoordinate0, "texture coordinates of unit 0"},
      {kTextureCoordinatesOther, "texture coordinates of units 1 and up"},
      {kUnitNormal, "normals without a vertex shader"},
      {kShaderNormal, "normals with a vertex shader"}};
  std::string text;
  for (const auto& [attribute, name] : kNames)
    if (attributes & attribute) text += (text.empty() ? "" : ", ") + std::string(name);
  return text.empty() ? "nothing" : text;
}

Attributes attribute_of(GLenum target) {
  switch (target) {
    case GL_MAP1_VERTEX_3:
    case GL_MAP2_VERTEX_3:
    case GL_MAP1_VERTEX_4:
    case GL_MAP2_VERTEX_4:
      return kPosition;
    case GL_MAP1_COLOR_4:
    case GL_MAP2_COLOR_4:
      return kColor;
    case GL_MAP1_NORMAL:
    case GL_MAP2_NORMAL:
      return kNormal;
    case GL_MAP1_INDEX:
    case GL_MAP2_INDEX:
      throw NotObservable("INDEX maps show in colour-index contexts only");
    default:
      return kTextureCoordinate0;
  }
}

PrimitiveKind kind_of(GLenum mode) {
  switch (mode) {
    case GL_POINTS:
      return kPoints;
    case GL_LINES:
    case GL_LINE_STRIP:
    case GL_LINE_LOOP:
      return kLines;
    default:
      return kPolygons;
  }
}

std::size_t Observation::vertex_count() const {
  std::size_t count = 0;
  for (const ObservedPrimitive& primitive : primitives) count += primitive.vertices.size();
  return count;
}

}  // namespace evalcts
