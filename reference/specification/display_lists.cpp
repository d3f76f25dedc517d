// Display lists (GL 2.1 section 5.4). NewList, EndList, GenLists, IsList and DeleteLists are never compiled.

#include <reference/specification.h>
#include <algorithm>

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

namespace evalcts::reference {
namespace {

constexpr GLsizei kMostGenerated = 65536;

// The types of the offsets of CallLists are consecutive tokens.
bool is_offset_type(GLenum type) { return type >= GL_BYTE && type <= GL_4_BYTES; }

template <typename T>
GLuint element(const void* lists, std::ptrdiff_t i) {
  return static_cast<GLuint>(static_cast<const T*>(lists)[i]);
}

// Truncates a float. A float outside the range of names may give any name.
template <>
GLuint element<GLfloat>(const void* lists, std::ptrdiff_t i) {
  const double value = static_cast<const GLfloat*>(lists)[i];
  return static_cast<GLuint>(static_cast<std::int64_t>(std::fmax(-0x1p32, std::fmin(value, 0x1p32))));
}

// Returns an element of several bytes, the most significant byte first.
GLuint element_of_bytes(const void* lists, std::ptrdiff_t i, int size) {
  GLuint value = 0;
  for (int byte = 0; byte < size; ++byte) value = 256 * value + element<GLubyte>(lists, i * size + byte);
  return value;
}

// Returns the i-th offset, modulo 2^32.
GLuint offset(GLenum type, const void* lists, std::ptrdiff_t i) {
  switch (type) {
    case GL_BYTE:
      return element<GLbyte>(lists, i);
    case GL_UNSIGNED_BYTE:
      return element<GLubyte>(lists, i);
    case GL_SHORT:
      return element<GLshort>(lists, i);
    case GL_UNSIGNED_SHORT:
      return element<GLushort>(lists, i);
    case GL_INT:
      return element<GLint>(lists, i);
    case GL_UNSIGNED_INT:
      return element<GLuint>(lists, i);
    case GL_FLOAT:
      return element<GLfloat>(lists, i);
    case GL_2_BYTES:
      return element_of_bytes(lists, i, 2);
    case GL_3_BYTES:
      return element_of_bytes(lists, i, 3);
    default:
      return element_of_bytes(lists, i, 4);
  }
}

}  // namespace

void Specification::NewList(GLuint list, GLenum mode) {
  const bool is_mode = mode == GL_COMPILE || mode == GL_COMPILE_AND_EXECUTE;
  if (reject_if({{inside(), GL_INVALID_OPERATION},
                 {list == 0, GL_INVALID_VALUE},
                 {!is_mode, GL_INVALID_ENUM},
                 {construction_.has_value(), GL_INVALID_OPERATION}})) {
    return;
  }
  construction_ = Construction{list, mode, {}};
}

// EndList raises an error between an executed Begin and its End, too, and leaves the list open (glNewList
// page; the list of section 2.6.3 does not mention it). A compiled Begin does not count.
void Specification::EndList() {
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {!construction_, GL_INVALID_OPERATION}})) return;
  Construction complete = *std::exchange(construction_, std::nullopt);
  lists_[complete.name] = std::move(complete.list);
}

// ---- Execution ----

void Specification::execute(const std::vector<GLuint>& names) {
  if (list_depth_ == kMaxListNesting) return;
  ++list_depth_;
  std::vector<GLenum> errors;  // an implementation may keep several codes
  std::size_t raised = 0;
  for (const GLuint name : names) {
    const auto list = lists_.find(name);
    if (list == lists_.end()) continue;
    for (const Command& command : list->second) {  // an error does not end the list (EV-DL-ERR-CONTINUE)
      command(*this);
      raised += raised_errors_;
      for (const GLenum error : permitted_errors_)
        if (std::ranges::count(errors, error) == 0) errors.push_back(error);
    }
  }
  --list_depth_;
  permitted_errors_ = std::move(errors);
  raised_errors_ = raised;
}

// CallList(0) has no effect, because no list has the name 0 (glCallList page).
void Specification::CallList(GLuint list) {
  if (compiled(&Specification::CallList, list)) return;
  reject_if({});
  execute({list});
}

void Specification::CallLists(GLsizei n, GLenum type, const void* lists) {
  std::vector<GLuint> offsets;
  if (is_offset_type(type) && lists != nullptr) {
    for (std::ptrdiff_t i = 0; i < n; ++i) offsets.push_back(offset(type, lists, i));
  }
  call_lists({{n < 0, GL_INVALID_VALUE}, {!is_offset_type(type), GL_INVALID_ENUM}}, offsets);
}

void Specification::call_lists(Objections objections, std::vector<GLuint> offsets) {
  if (compiled(&Specification::call_lists, objections, offsets)) return;
  if (reject_if(objections)) return;
  for (GLuint& offset : offsets) offset += attributes_.list_base;
  execute(offsets);
}

void Specification::ListBase(GLuint base) {
  if (compiled(&Specification::ListBase, base)) return;
  if (reject_if({{inside(), GL_INVALID_OPERATION}})) return;
  attributes_.list_base = base;
}

// ---- Names ----

GLuint Specification::GenLists(GLsizei range) {
  if (reject_if({{inside(), GL_INVALID_OPERATION},
                 {range < 0, GL_INVALID_VALUE},
                 {range > kMostGenerated, GL_OUT_OF_MEMORY}}) ||
      range == 0) {
    return 0;
  }
  std::set<std::int64_t> used;
  for (const auto& [name, list] : lists_) used.insert(name);
  if (construction_) used.insert(construction_->name);
  std::int64_t first = 1;
  for (const std::int64_t name : used) {
    if (name >= first + range) break;
    first = name + 1;
  }
  if (first + range - 1 > std::numeric_limits<GLuint>::max()) return 0;
  for (GLsizei i = 0; i < range; ++i) lists_[static_cast<GLuint>(first + i)] = {};  // empty lists
  return static_cast<GLuint>(first);
}

GLboolean Specification::IsList(GLuint list) {
  if (reject_if({{inside(), GL_INVALID_OPERATION}})) return GL_FALSE;
  return lists_.contains(list) ? GL_TRUE : GL_FALSE;
}

void Specification::DeleteLists(GLuint list, GLsizei range) {
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {range < 0, GL_INVALID_VALUE}})) return;
  std::erase_if(lists_, [=](const auto& entry) {
    return entry.first >= list && entry.first - list < static_cast<GLuint>(range);
  });
}

}  // namespace evalcts::reference
