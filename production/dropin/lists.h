// The display lists of the drop-in library: their contents, the lists of a share group, and the open list.
#pragma once

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

#include "array.h"
#include "gl_below.h"

namespace glev::dropin {

class Context;

// The current values that maps can replace.
enum Attribute { kColor, kNormal, kTexCoord, kAttributeCount };

// The command that set a current value. The value is restored by the same command, so that it is not
// converted twice.
struct Setter {
  void (*send)(const void* values);  // null if unknown
  alignas(8) unsigned char values[32];

  void apply() const {
    if (send != nullptr) send(values);
  }
};

// The effect of a list on Begin/End.
enum class Primitive { kUnchanged, kOpen, kClosed };

// The effects of a driver's list that this library must track. The list contains no commands of evaluators.
struct Summary {
  Primitive primitive;
  Setter last[kAttributeCount];
  // Numbers of PopAttrib without a PushAttrib in the list, and of later PushAttrib without a PopAttrib.
  unsigned pops, pushes;
  GLbitfield pushed[16];

  void reset() { std::memset(static_cast<void*>(this), 0, sizeof *this); }
  bool is_empty() const;
};

// The alignment of every part of a list.
inline constexpr std::size_t kCodeUnit = 16;
constexpr std::size_t round_up_to_code_unit(std::size_t bytes) {
  return (bytes + kCodeUnit - 1) / kCodeUnit * kCodeUnit;
}

// The commands of a display list in order. A list without commands of evaluators is one driver's list of the
// same name. Otherwise it consists of driver's lists with other names and the commands of evaluators between
// them.
class Code {
 public:
  // Appends an operation, which must be trivially copyable and is called with a Context& and a pointer to the
  // `bytes` bytes that follow it. Returns these bytes for the caller to fill; null if there is no memory.
  template <class Operation>
  unsigned char* append(const Operation& operation, std::size_t bytes = 0) {
    static_assert(std::is_trivially_copyable_v<Operation> && alignof(Operation) <= kCodeUnit);
    constexpr std::size_t kSize = round_up_to_code_unit(sizeof(Operation));
    unsigned char* const place = bytes_.grow(kHeader + kSize + round_up_to_code_unit(bytes));
    if (place == nullptr) return nullptr;
    const Header header = {[](Context& context, const unsigned char* payload) {
                             (*reinterpret_cast<const Operation*>(payload))(context, payload + kSize);
                           },
                           kSize + round_up_to_code_unit(bytes)};
    std::memcpy(place, &header, sizeof header);
    new (place + kHeader) Operation(operation);
    return place + kHeader + kSize;
  }
  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return size() == 0; }
  // Runs the commands from `begin`, an earlier size(), on.
  void run(Context& context, std::size_t begin) {
    while (begin < bytes_.size()) {
      Header header;
      std::memcpy(&header, &bytes_[begin], sizeof header);
      header.run(context, &bytes_[begin] + kHeader);
      begin += kHeader + header.size;
    }
  }
  void swap(Code& other) { bytes_.swap(other.bytes_); }
  void clear() { bytes_.clear(); }

 private:
  struct Header {
    void (*run)(Context&, const unsigned char* payload);
    std::size_t size;
  };
  static constexpr std::size_t kHeader = round_up_to_code_unit(sizeof(Header));

  Array<unsigned char> bytes_;
};

struct List {
  GLuint name = 0;
  unsigned references = 1;
  Primitive primitive = Primitive::kUnchanged;  // includes called lists, as they were at compilation
  Code code;
  Array<GLuint> segments;  // names of driver's lists that belong to this list
};

// The lists of contexts that share lists. Lists that are not in the group belong to the driver alone and have
// no effects that must be tracked.
class Group {
 public:
  static Group* create();
  void retain();
  void release();

  // Returns a list with one more reference; null if there is none.
  List* find(GLuint name);
  bool is_empty();
  void release_list(List* list);
  Primitive primitive_of(GLuint name);
  // Adds a list, and replaces an earlier list of the same name.
  void define(List* list);
  void delete_lists(GLuint first, GLuint last);
  // Returns an unused, very large name for a driver's list.
  GLuint new_segment();
  bool is_segment(GLuint name);

 private:
  class Lock;
  Group() = default;
  std::size_t lower_bound(GLuint name);
  std::size_t place_of_segment(GLuint name);
  void drop(List* list);

  unsigned references_ = 1;
  Array<List*> lists_;      // sorted by name
  Array<GLuint> segments_;  // sorted
  GLuint next_segment_ = 0x7e000000;
};

// The list between NewList and EndList.
struct OpenList {
  bool open = false;
  GLuint name = 0;
  GLenum mode = 0;
  GLuint segment = 0;  // name of the list that is open in the driver
  bool driver_is_open = false;
  bool begins_elsewhere = false;                // the first list in the driver has another name
  Summary summary;                              // summary of the list that is open in the driver
  Primitive primitive = Primitive::kUnchanged;  // effect of all commands before it
  Code code;
  Array<GLuint> segments;
  // The GL does not close lists between Begin and End. Therefore, with COMPILE_AND_EXECUTE, a primitive is
  // only compiled first and executed at End.
  bool deferring = false;
  std::size_t deferred = 0;  // position of the primitive in the code
  std::size_t recorded = 0;  // position of the last operation in the code
};

}  // namespace glev::dropin
