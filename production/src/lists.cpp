// Display lists (GL §21.4): the commands that make, call and delete them.
#include <algorithm>
#include <cstring>
#include <limits>
#include <new>

#include "command.h"
#include "context.h"
#include "list_offsets.h"

using glev::DisplayList;
using glev::Opcode;
using glev::Record;

namespace {

// The error of the arguments alone, NO_ERROR if there is none.
glev_enum FindCallListsError(glev_int count, glev_enum type, const void* offsets) {
  if (count < 0) return GLEV_INVALID_VALUE;
  if (glev::BytesOfOffset(type) == 0) return GLEV_INVALID_ENUM;
  return count > 0 && offsets == nullptr ? GLEV_INVALID_VALUE : GLEV_NO_ERROR;
}

template <class Command>
void Run(glev_context& gl, const std::byte* payload) {
  const auto& command = *std::launder(reinterpret_cast<const Command*>(payload));
  if constexpr (requires { command.Run(gl, payload); }) {
    command.Run(gl, payload + glev::RoundUpToListUnit(sizeof(Command)));
  } else {
    command.Run(gl);
  }
}

void Run(glev_context& gl, Opcode opcode, const std::byte* payload) {
  switch (opcode) {
    case Opcode::kError:
      return Run<glev::ErrorCommand>(gl, payload);
    case Opcode::kDefineMap:
      return Run<glev::DefineMapCommand>(gl, payload);
    case Opcode::kSetEnabled:
      return Run<glev::SetEnabledCommand>(gl, payload);
    case Opcode::kSetGrid:
      return Run<glev::SetGridCommand>(gl, payload);
    case Opcode::kEvalCoord:
      return Run<glev::EvalCoordCommand>(gl, payload);
    case Opcode::kEvalPoint:
      return Run<glev::EvalPointCommand>(gl, payload);
    case Opcode::kEvalMesh1:
      return Run<glev::EvalMesh1Command>(gl, payload);
    case Opcode::kEvalMesh2:
      return Run<glev::EvalMesh2Command>(gl, payload);
    case Opcode::kBegin:
      return Run<glev::BeginCommand>(gl, payload);
    case Opcode::kEnd:
      return Run<glev::EndCommand>(gl, payload);
    case Opcode::kVertex:
      return Run<glev::VertexCommand>(gl, payload);
    case Opcode::kColor:
      return Run<glev::ColorCommand>(gl, payload);
    case Opcode::kNormal:
      return Run<glev::NormalCommand>(gl, payload);
    case Opcode::kIndex:
      return Run<glev::IndexCommand>(gl, payload);
    case Opcode::kEdgeFlag:
      return Run<glev::EdgeFlagCommand>(gl, payload);
    case Opcode::kMultiTexCoord:
      return Run<glev::MultiTexCoordCommand>(gl, payload);
    case Opcode::kActiveTexture:
      return Run<glev::ActiveTextureCommand>(gl, payload);
    case Opcode::kPushAttrib:
      return Run<glev::PushAttribCommand>(gl, payload);
    case Opcode::kPopAttrib:
      return Run<glev::PopAttribCommand>(gl, payload);
    case Opcode::kCallList:
      return Run<glev::CallListCommand>(gl, payload);
    case Opcode::kCallLists:
      return Run<glev::CallListsCommand>(gl, payload);
    case Opcode::kListBase:
      return Run<glev::ListBaseCommand>(gl, payload);
  }
}

}  // namespace

bool glev_context::RefusedWithLists() {
  if (RefusedInPrimitive()) return true;
  if (callbacks_ > 0) RecordError(GLEV_INVALID_OPERATION);
  return callbacks_ > 0;
}

// ---- Making lists

void glev_context::NewList(glev_uint list, glev_enum mode) {
  if (list == 0) return RecordError(GLEV_INVALID_VALUE);
  if (mode != GLEV_COMPILE && mode != GLEV_COMPILE_AND_EXECUTE) return RecordError(GLEV_INVALID_ENUM);
  if (RefusedWithLists()) return;
  if (open_.mode != 0) return RecordError(GLEV_INVALID_OPERATION);
  open_.name = list;
  open_.mode = mode;
}

void glev_context::EndList() {
  if (RefusedWithLists()) return;
  if (open_.mode == 0) return RecordError(GLEV_INVALID_OPERATION);
  if (open_.broken || !lists_.Define(allocator_, open_.name, open_.list)) {
    open_.list.Free(allocator_);
    RecordError(GLEV_OUT_OF_MEMORY);
  }
  open_ = {};
}

void glev_context::IssueCallLists(glev_int count, glev_enum type, const void* offsets) {
  if (IsCompiling()) {
    const glev_enum error = FindCallListsError(count, type, offsets);
    if (error != GLEV_NO_ERROR) {
      Compile(glev::ErrorCommand{error});
    } else {
      const std::uint64_t bytes = static_cast<std::uint64_t>(count) * glev::BytesOfOffset(type);
      void* memory = Compile(glev::CallListsCommand{count, type}, bytes);
      if (memory != nullptr && bytes != 0) std::memcpy(memory, offsets, bytes);
    }
    if (open_.mode == GLEV_COMPILE) return;
  }
  CallLists(count, type, offsets);
}

// ---- Calling lists

void glev_context::CallList(glev_uint name) {
  if (list_depth_ == glev::kMaxListNesting) return;
  const DisplayList* found = lists_.Find(name);
  if (found == nullptr) return;
  const DisplayList list = *found;  // stays until the end: see RefusedWithLists
  ++list_depth_;
  for (const std::byte* place = list.begin(); place != list.end();) {
    const auto& record = *std::launder(reinterpret_cast<const Record*>(place));
    const std::byte* payload = place + sizeof(Record);
    Run(*this, record.opcode, payload);
    place = payload + record.units * glev::kListUnit;
  }
  --list_depth_;
}

void glev_context::CallLists(glev_int count, glev_enum type, const void* offsets) {
  const glev_enum error = FindCallListsError(count, type, offsets);
  if (error != GLEV_NO_ERROR) return RecordError(error);
  const std::size_t step = glev::BytesOfOffset(type);
  const auto* bytes = static_cast<const unsigned char*>(offsets);
  for (glev_int i = 0; i < count; ++i, bytes += step) CallList(list_base_ + glev::OffsetAt(type, bytes));
}

void glev_context::ListBase(glev_uint base) {
  if (!RefusedInPrimitive()) list_base_ = base;
}

// ---- Names

glev_uint glev_context::GenLists(glev_int range) {
  if (range < 0) {
    RecordError(GLEV_INVALID_VALUE);
    return 0;
  }
  if (RefusedWithLists() || range == 0) return 0;
  glev_uint first;
  if (lists_.Reserve(allocator_, static_cast<glev_uint>(range), open_.name, &first)) return first;
  RecordError(GLEV_OUT_OF_MEMORY);
  return 0;
}

bool glev_context::IsList(glev_uint list) { return !RefusedInPrimitive() && lists_.Find(list) != nullptr; }

void glev_context::DeleteLists(glev_uint list, glev_int range) {
  if (range < 0) return RecordError(GLEV_INVALID_VALUE);
  if (RefusedWithLists() || range == 0) return;
  const glev_uint most = std::numeric_limits<glev_uint>::max() - list;
  const glev_uint last = list + std::min(static_cast<glev_uint>(range) - 1, most);
  if (!lists_.Delete(allocator_, list, last)) RecordError(GLEV_OUT_OF_MEMORY);
}
