// A growing array that does not need the C++ run time.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <type_traits>

namespace glev::dropin {

template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Array() = default;
  ~Array() { std::free(data_); }
  Array(const Array&) = delete;
  Array& operator=(const Array&) = delete;

  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  void clear() { size_ = 0; }

  // Appends `count` elements for the caller to fill, and returns the first of them. Returns null, and changes
  // nothing, if there is no memory.
  T* grow(std::size_t count) {
    if (size_ + count > capacity_) {
      const std::size_t capacity = (size_ + count) + (size_ + count) / 2;
      void* const data = std::realloc(data_, capacity * kBytes);
      if (data == nullptr) return nullptr;
      data_ = static_cast<T*>(data);
      capacity_ = capacity;
    }
    size_ += count;
    return data_ + size_ - count;
  }
  bool insert(std::size_t place, const T& value) {
    if (grow(1) == nullptr) return false;
    std::memmove(data_ + place + 1, data_ + place, (size_ - 1 - place) * kBytes);
    data_[place] = value;
    return true;
  }
  void erase(std::size_t place, std::size_t count = 1) {
    if (count == 0) return;  // an empty array has no address
    std::memmove(data_ + place, data_ + place + count, (size_ - place - count) * kBytes);
    size_ -= count;
  }
  void swap(Array& other) {
    T* const data = data_;
    const std::size_t size = size_, capacity = capacity_;
    data_ = other.data_, size_ = other.size_, capacity_ = other.capacity_;
    other.data_ = data, other.size_ = size, other.capacity_ = capacity;
  }

 private:
  // T may be a pointer, and kBytes is a constant despite the warning.
  // NOLINTNEXTLINE(bugprone-sizeof-expression,bugprone-dynamic-static-initializers)
  static constexpr std::size_t kBytes = sizeof(T);

  T* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace glev::dropin
