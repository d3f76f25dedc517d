// Display lists (GL §21.4): the commands that make, call and delete them.
#include <algorithm>
#include <cstring>
#include <limits>
#include <new>

#include "context.h"
#include "list_offsets.h"
#include "mutation_point.h"

using glev::DisplayList;
using glev::Record;

namespace {

// Returns the error of the arguments, independently of state; NO_ERROR if there is none.
glev_enum find_call_lists_error(glev_int count, glev_enum type, const void* offsets) {
  if (count < 0) return GLEV_INVALID_VALUE;
  if (glev::bytes_of_offset(type) == 0) return GLEV_INVALID_ENUM;
  return count > 0 && offsets == nullptr ? GLEV_INVALID_VALUE : GLEV_NO_ERROR;
}

}  // namespace

bool glev_context::is_rejected_with_lists() {
  if (is_rejected_in_primitive()) return true;
  if (callbacks_ > 0) record_error(GLEV_INVALID_OPERATION);
  return callbacks_ > 0;
}

// ---- Making lists

void glev_context::new_list(glev_uint list, glev_enum mode) {
  if (list == 0) return record_error(GLEV_INVALID_VALUE);
  if (mode != GLEV_COMPILE && mode != GLEV_COMPILE_AND_EXECUTE) return record_error(GLEV_INVALID_ENUM);
  if (is_rejected_with_lists()) return;
  if (open_.mode != 0) return record_error(GLEV_INVALID_OPERATION);
  open_.name = list;
  open_.mode = mode;
}

void glev_context::end_list() {
  if (is_rejected_with_lists()) return;
  if (open_.mode == 0) return record_error(GLEV_INVALID_OPERATION);
  if (open_.broken || !lists_.define(allocator_, open_.name, open_.list)) {
    open_.list.free(allocator_);
    record_error(GLEV_OUT_OF_MEMORY);
  }
  open_ = {};
}

void glev_context::issue_call_lists(glev_int count, glev_enum type, const void* offsets) {
  if (is_compiling()) {
    const glev_enum error = find_call_lists_error(count, type, offsets);
    if (error != GLEV_NO_ERROR) {
      compile(glev::listed<&glev_context::record_error>(error));
    } else {
      const std::uint64_t bytes = static_cast<std::uint64_t>(count) * glev::bytes_of_offset(type);
      void* memory =
          compile([=](glev_context& gl, const void* copy) { gl.call_lists(count, type, copy); }, bytes);
      if (memory != nullptr && bytes != 0) std::memcpy(memory, offsets, bytes);
    }
    if (open_.mode == GLEV_COMPILE) return;
  }
  call_lists(count, type, offsets);
}

// ---- Calling lists

void glev_context::call_list(glev_uint name) {
  if (list_depth_ == glev::kMaxListNesting) return;
  const DisplayList* found = lists_.find(name);
  if (found == nullptr) return;
  const DisplayList list = *found;  // not deleted during the call, see is_rejected_with_lists
  ++list_depth_;
  GLEV_HERE(list_begins);
  for (const std::byte* place = list.begin(); place != list.end();) {
    const auto& record = *std::launder(reinterpret_cast<const Record*>(place));
    const std::byte* payload = place + sizeof(Record);
    record.run(*this, payload);
    GLEV_HERE(after_listed_command);
    place = payload + record.bytes;
  }
  GLEV_HERE(list_ends);
  --list_depth_;
}

void glev_context::call_lists(glev_int count, glev_enum type, const void* offsets) {
  const glev_enum error = find_call_lists_error(count, type, offsets);
  if (error != GLEV_NO_ERROR) return record_error(error);
  const std::size_t step = glev::bytes_of_offset(type);
  const auto* bytes = static_cast<const unsigned char*>(offsets);
  for (glev_int i = 0; i < count; ++i, bytes += step) call_list(list_base_ + glev::offset_at(type, bytes));
}

void glev_context::list_base(glev_uint base) {
  if (!is_rejected_in_primitive()) list_base_ = base;
}

// ---- Names

glev_uint glev_context::gen_lists(glev_int range) {
  if (range < 0) {
    record_error(GLEV_INVALID_VALUE);
    return 0;
  }
  if (is_rejected_with_lists() || range == 0) return 0;
  glev_uint first;
  if (lists_.reserve(allocator_, static_cast<glev_uint>(range), open_.name, &first)) return first;
  record_error(GLEV_OUT_OF_MEMORY);
  return 0;
}

bool glev_context::is_list(glev_uint list) {
  return !is_rejected_in_primitive() && lists_.find(list) != nullptr;
}

void glev_context::delete_lists(glev_uint list, glev_int range) {
  if (range < 0) return record_error(GLEV_INVALID_VALUE);
  if (is_rejected_with_lists() || range == 0) return;
  const glev_uint most = std::numeric_limits<glev_uint>::max() - list;
  const glev_uint last = list + std::min(static_cast<glev_uint>(range) - 1, most);
  if (!lists_.delete_names(allocator_, list, last)) record_error(GLEV_OUT_OF_MEMORY);
}
