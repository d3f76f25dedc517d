// Display lists of the drop-in library: what they are made of, and which there are.
#pragma once

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

#include "array.h"
#include "gl_below.h"

namespace glev::dropin {

class Context;

// The current values that maps can stand in for.
enum Attribute { kColor, kNormal, kTexCoord, kAttributeCount };

// The command that set a current value, to bring it back by the same one: no conversion is done twice.
struct Setter {
  void (*send)(const void* values);  // null: not known
  alignas(8) unsigned char values[32];

  void apply() const {
    if (send != nullptr) send(values);
  }
};

// The effect of a list on Begin/End.
enum class Primitive { kUnchanged, kOpen, kClosed };

// The effects of a driver's list, as far as they matter here. It holds no command of evaluators.
struct Summary {
  Primitive primitive;
  Setter last[kAttributeCount];
  // PopAttrib that match no PushAttrib of the list come first.
  unsigned pops, pushes;
  GLbitfield pushed[16];

  void reset() { std::memset(static_cast<void*>(this), 0, sizeof *this); }
  bool is_empty() const;
};

// Every part of a list begins at a multiple of this.
inline constexpr std::size_t kCodeUnit = 16;
constexpr std::size_t round_up_to_code_unit(std::size_t bytes) {
  return (bytes + kCodeUnit - 1) / kCodeUnit * kCodeUnit;
}

// The commands of a display list in order. Where no command of evaluators stands in it, that is one driver's
// list of the same name; else driver's lists of other names, with the commands of evaluators between them.
class Code {
 public:
  // `operation` can be copied as bytes, and is called with a Context& and what stands behind it: `bytes`
  // bytes for the caller to fill. Null without memory.
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
  // Runs the commands that were appended at or after `begin`, a former size().
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
  Primitive primitive = Primitive::kUnchanged;  // lists that it calls included, as they were
  Code code;
  Array<GLuint> segments;  // names of driver's lists that stand for nothing else
};

// The lists of contexts that share them. A list that is not here is the driver's, and does nothing of note.
class Group {
 public:
  static Group* create();
  void retain();
  void release();

  // A list with one more reference; null where there is none.
  List* find(GLuint name);
  bool is_empty();
  void release_list(List* list);
  Primitive primitive_of(GLuint name);
  // Takes the place of the list of that name.
  void define(List* list);
  void delete_lists(GLuint first, GLuint last);
  // A name for a driver's list that no program will come upon.
  GLuint new_segment();
  bool is_segment(GLuint name);

 private:
  class Lock;
  Group() = default;
  std::size_t lower_bound(GLuint name);
  std::size_t place_of_segment(GLuint name);
  void drop(List* list);

  unsigned references_ = 1;
  Array<List*> lists_;      // by name
  Array<GLuint> segments_;  // sorted
  GLuint next_segment_ = 0x7e000000;
};

// The list between NewList and EndList.
struct OpenList {
  bool open = false;
  GLuint name = 0;
  GLenum mode = 0;
  GLuint segment = 0;  // the driver's list that is open now
  bool driver_is_open = false;
  bool begins_elsewhere = false;                // its first driver's list has not its name
  Summary summary;                              // of that
  Primitive primitive = Primitive::kUnchanged;  // of all before it
  Code code;
  Array<GLuint> segments;
  // Between Begin and End the GL closes no list, so where a list is executed while it is compiled, its
  // primitives are compiled first, and executed at End.
  bool deferring = false;
  std::size_t deferred = 0;  // where the primitive begins in the code
  std::size_t recorded = 0;  // where the last operation begins
};

}  // namespace glev::dropin
