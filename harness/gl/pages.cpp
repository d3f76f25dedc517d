// Maps pages, with the functions of POSIX or of Windows.
#include "pages.h"

#ifdef _WIN32
#include <windows.h>
#else
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <new>

namespace evalcts::gl {

#ifdef _WIN32

std::size_t page_size() {
  static const std::size_t kSize = [] {
    SYSTEM_INFO info{};
    GetSystemInfo(&info);
    return static_cast<std::size_t>(info.dwPageSize);
  }();
  return kSize;
}

std::byte* map_pages(std::size_t count) {
  void* const memory = VirtualAlloc(nullptr, (count + 2) * page_size(), MEM_RESERVE, PAGE_NOACCESS);
  if (!memory) throw std::bad_alloc();
  std::byte* const first = static_cast<std::byte*>(memory) + page_size();
  if (count > 0 && !VirtualAlloc(first, count * page_size(), MEM_COMMIT, PAGE_READWRITE))
    throw std::bad_alloc();
  return first;
}

void unmap_pages(std::byte* first, std::size_t) { VirtualFree(first - page_size(), 0, MEM_RELEASE); }

void protect_pages(std::byte* first, std::size_t count) {
  DWORD before = 0;
  VirtualProtect(first, count * page_size(), PAGE_NOACCESS, &before);
}

#else

std::size_t page_size() {
  static const auto kSize = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return kSize;
}

std::byte* map_pages(std::size_t count) {
  void* const memory =
      mmap(nullptr, (count + 2) * page_size(), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  std::byte* const first = static_cast<std::byte*>(memory) + page_size();
  // Fails if the process has too many mappings.
  if (mprotect(first, count * page_size(), PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
  return first;
}

void unmap_pages(std::byte* first, std::size_t count) {
  munmap(first - page_size(), (count + 2) * page_size());
}

void protect_pages(std::byte* first, std::size_t count) { mprotect(first, count * page_size(), PROT_NONE); }

#endif

}  // namespace evalcts::gl
