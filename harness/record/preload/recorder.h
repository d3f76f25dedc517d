// Writes the records of this process into its recording (format.h).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <evalcts/record/format.h>
#include "commands.h"

namespace evalcts::record {

// The commands that are recorded outside of the frames of --frames differ.
enum class CommandClass {
  kDrawing,       // vertices, evaluations, Begin and End, and queries: left out
  kCurrentValue,  // always recorded
  kState,         // left out between Begin and End, where they are errors, if these are left out
};

// The records of a thread. If the thread ends, another thread goes on.
struct Writer {
  // Returns space for a record, or null if the recording has ended.
  std::byte* reserve(std::size_t bytes) {
    return __builtin_expect(bytes <= static_cast<std::size_t>(end - next), 1) ? next
                                                                              : reserve_in_new_chunk(bytes);
  }
  // Ends the record, which is in the file now.
  void commit(std::byte* record_end) {
    next = record_end;
    __atomic_store_n(&chunk->length,
                     static_cast<std::uint64_t>(next - reinterpret_cast<std::byte*>(chunk + 1)),
                     __ATOMIC_RELEASE);
  }
  bool leaves_out(CommandClass kind);

  std::byte *next = nullptr, *end = nullptr;  // free space in the chunk
  Chunk* chunk = nullptr;                     // in the file; null: the thread has no records yet
  std::uint64_t offset = 0, space = 0;        // of the chunk in the file, and its size
  std::uint64_t context = 0;                  // the current context
  std::uint64_t order = 0;                    // of its event
  std::int64_t max_order = 0;                 // MAX_EVAL_ORDER of the context; 0: it has no evaluators
  bool records = false;                       // a context that has evaluators is current
  bool ends_frames_by_flush = false;          // it is a context of OSMesa, which does not swap buffers
  bool is_in_primitive = false;               // between Begin and End
  bool is_left_out = false;                   // the frame, or the primitive, is not recorded
  GLenum list_mode = 0;                       // of the display list that is compiled; 0: none
  std::uint32_t thread = 0;                   // its number
  bool is_free = false;                       // the thread has ended
  Writer* following = nullptr;                // in the list of all

 private:
  std::byte* reserve_in_new_chunk(std::size_t bytes);
};

// The writer of this thread; null: no context was current in it.
extern constinit thread_local Writer* writer;

// False before the library is initialised, without EVALCTS_RECORD, and when the recording has ended.
extern std::atomic<bool> is_active;

// The recorded frames, if not all are recorded.
extern bool is_limited_to_frames;

// The numbers of calls of counted commands; null: there is no file yet.
extern std::atomic<std::atomic<std::uint64_t>*> counts;
void count_first(int index);

inline void count(int index) {
  if (std::atomic<std::uint64_t>* const all = counts.load(std::memory_order_acquire))
    all[index].fetch_add(1, std::memory_order_relaxed);
  else
    count_first(index);
}

// Events. The context is 0 if none is current.
void note_current(const void* context, bool is_osmesa);
void note_destroyed(const void* context);
void note_frame();

// Appends numbers to a record.
template <class T>
std::byte* put(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof value);
  return at + sizeof value;
}

// Size of a parameter that is a number. All integers of the recorded commands have 32 bits at most.
template <class P>
inline constexpr std::size_t kFixedSize = std::is_floating_point_v<P> ? sizeof(P) : sizeof(std::uint32_t);

template <class P>
std::byte* put_parameter(std::byte* at, P value) {
  if constexpr (std::is_floating_point_v<P>)
    return put(at, value);
  else
    return put(at, static_cast<std::uint32_t>(value));
}

}  // namespace evalcts::record
