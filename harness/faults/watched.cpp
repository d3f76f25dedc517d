// Implements the wrappers that track primitives, lists, enables, the texture unit, pushed attribute groups
// and bound buffers.
#include "watched.h"

namespace evalcts::faults {
namespace {

gl::Table behind;  // the wrapped commands

}  // namespace

void watch(gl::Table& table) {
  watched = {};
  behind = table;
  table.Begin = [](GLenum mode) {
    behind.Begin(mode);
    watched.primitive = mode;
  };
  table.End = [] {
    watched.primitive = kNoPrimitive;
    behind.End();
  };
  table.Enable = [](GLenum cap) {
    watched.enabled[cap] = true;
    behind.Enable(cap);
  };
  table.Disable = [](GLenum cap) {
    watched.enabled[cap] = false;
    behind.Disable(cap);
  };
  table.ActiveTexture = [](GLenum unit) {
    behind.ActiveTexture(unit);
    watched.unit = unit;
  };
  table.NewList = [](GLuint list, GLenum mode) {
    behind.NewList(list, mode);
    watched.list_mode = mode;
  };
  table.EndList = [] {
    behind.EndList();
    watched.list_mode = 0;
  };
  table.PushAttrib = [](GLbitfield mask) {
    behind.PushAttrib(mask);
    if (watched.list_mode == 0) watched.masks.push_back(mask);
  };
  table.PopAttrib = [] {
    behind.PopAttrib();
    if (watched.list_mode == 0 && !watched.masks.empty()) watched.masks.pop_back();
  };
  table.ContextOfKindEVALCTS = [](GLuint context, GLuint kind) {
    behind.ContextOfKindEVALCTS(context, kind);
    watched.kind = kind;
  };
  table.BindBuffer = [](GLenum target, GLuint buffer) {
    watched.buffers[target] = buffer;
    behind.BindBuffer(target, buffer);
  };
  // A missing command stays missing.
#define GL_ENTRY(name, kinds) \
  if (!behind.name) table.name = nullptr;
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
}

}  // namespace evalcts::faults
