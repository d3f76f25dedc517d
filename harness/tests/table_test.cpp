// Tests the names under which the commands of a library are looked up.
#include <evalcts/gl/table.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

namespace evalcts::gl {
namespace {

// Returns a fake address that identifies the name.
void* address_for(const char* name) {
  static std::set<std::string> names;
  return const_cast<std::string*>(&*names.insert(name).first);
}

template <class Command>
std::string name_behind(Command* command) {
  return command ? *reinterpret_cast<const std::string*>(command) : std::string();
}

const AddressOf kMakesUpAnything = address_for;

TEST(Table, AsksForTheExtensionOfAnOldVersion) {
  const Table old = load_table({kMakesUpAnything}, parse_advertised("1.2.1 old", "GL_ARB_multitexture GL_X"));
  EXPECT_EQ(name_behind(old.ActiveTexture), "glActiveTextureARB");
  EXPECT_EQ(name_behind(old.MultiTexCoord4dv), "glMultiTexCoord4dvARB");
  EXPECT_EQ(name_behind(old.BindBuffer), "glBindBuffer");  // not advertised
  EXPECT_EQ(name_behind(old.Map1f), "glMap1f");

  const Table later = load_table({kMakesUpAnything}, parse_advertised("1.3", "GL_ARB_multitexture"));
  EXPECT_EQ(name_behind(later.ActiveTexture), "glActiveTexture");
}

TEST(Table, KnowsLongerNamesOfOtherExtensions) {
  const Advertised both =
      parse_advertised("2.1 Mesa", "GL_ARB_vertex_buffer_object GL_EXT_transform_feedback");
  const Table table = load_table({kMakesUpAnything}, both);
  EXPECT_EQ(name_behind(table.BindBuffer), "glBindBuffer");
  EXPECT_EQ(name_behind(table.BindBufferBase), "glBindBufferBaseEXT");
}

TEST(Table, FallsBackToTheExtension) {
  const AddressOf exports_arb_only = [](const char* name) {
    return std::string(name) == "glActiveTextureARB" ? address_for(name) : nullptr;
  };
  EXPECT_EQ(name_behind(load_table({exports_arb_only}).ActiveTexture), "glActiveTextureARB");
  // An exported symbol has precedence over an address that a source may return for any name.
  EXPECT_EQ(name_behind(load_table({exports_arb_only, kMakesUpAnything}).ActiveTexture),
            "glActiveTextureARB");
  EXPECT_EQ(name_behind(load_table({kMakesUpAnything}).OtherContextEVALCTS), "");
}

TEST(Advertised, ParsesVersions) {
  EXPECT_EQ(parse_advertised("4.5 (Compatibility Profile) Mesa 22.3.6", "").version, 45);
  EXPECT_EQ(parse_advertised("2.1.2 NVIDIA", "").version, 21);
  EXPECT_EQ(parse_advertised("OpenGL ES 3.2", "").version, 0);
  EXPECT_EQ(parse_advertised("", "").version, 0);
}

}  // namespace
}  // namespace evalcts::gl
