// The file of a recording: it is created, mapped into memory chunk by chunk, and ended.
//
// The kernel writes the mapped memory into the file, even if the process is killed. The file is opened by its
// name for each chunk, because a program may close all descriptors.
#include "recorder.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

#include "real_commands.h"

namespace evalcts::record {

constinit thread_local Writer* writer = nullptr;
std::atomic<bool> is_active{false};
bool is_limited_to_frames = false;
namespace {
std::atomic<std::uint64_t> unwritten_counts[kCounted];  // while nothing is recorded
}
std::atomic<std::atomic<std::uint64_t>*> counts{unwritten_counts};

namespace {

constexpr std::uint64_t kChunkSpace = std::uint64_t{1} << 20;
constexpr std::size_t kContextBytes = 2 + 8 + 8;

pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

// Holds the mutex, and keeps errno as it is for the program.
class Lock {
 public:
  Lock() { pthread_mutex_lock(&mutex); }
  ~Lock() {
    pthread_mutex_unlock(&mutex);
    errno = errno_;
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int errno_ = errno;
};

char base_name[4096];  // of EVALCTS_RECORD
std::uint64_t limit = 0;
std::uint64_t first_frame = 0, last_frame = 0;
std::atomic<std::uint64_t> frames{0}, orders{0};
pthread_key_t thread_end;
Writer* writers = nullptr;  // all

// The file of this process.
struct File {
  char name[sizeof base_name + 16] = {};
  FileHeader* header = nullptr;  // null: there is no file yet
  std::uint64_t size = 0;
  dev_t device = 0;
  ino_t inode = 0;
} file;

void say(const char* what, const char* why) {
  char text[sizeof file.name + 512];
  const int length = std::snprintf(text, sizeof text, "evalcts record: %s%s%s; the recording ends here\n",
                                   what, *why != '\0' ? ": " : "", why);
  if (length > 0 && write(STDERR_FILENO, text, std::min<std::size_t>(length, sizeof text - 1)) < 0) return;
}

// Ends the recording, of which something is missing now.
void cut(const char* what, const char* why = "") {
  if (!is_active.exchange(false)) return;
  if (file.header != nullptr) file.header->is_cut = 1;
  if (counts.load() == nullptr) counts.store(unwritten_counts, std::memory_order_release);
  say(what, why);
}

// Returns the largest size of the file. A process that exceeds the limit of the system would get a signal.
std::uint64_t size_limit() {
  rlimit of_system{};
  return getrlimit(RLIMIT_FSIZE, &of_system) == 0 ? std::min<std::uint64_t>(limit, of_system.rlim_cur)
                                                  : limit;
}

// Makes the file larger by `space` bytes, and maps them into memory. Returns null after an error message.
std::byte* extend(int descriptor, std::uint64_t space) {
  const auto offset = static_cast<off_t>(file.size);
  if (const int error = posix_fallocate(descriptor, offset, static_cast<off_t>(space))) {
    if (ftruncate(descriptor, offset) != 0) errno = error;
    cut(file.name, std::strerror(error));
    return nullptr;
  }
  void* const memory =
      mmap(nullptr, space, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, descriptor, offset);
  if (memory == MAP_FAILED) {
    cut(file.name, std::strerror(errno));
    return nullptr;
  }
  file.size += space;
  return static_cast<std::byte*>(memory);
}

std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + kAlignment - 1) / kAlignment * kAlignment; }

// The JSON text of the header.
class Text {
 public:
  Text() = default;
  ~Text() { std::free(data_); }
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;
  std::string_view view() const { return {data_, size_}; }
  void add(std::string_view text) {
    if (size_ + text.size() > capacity_) {
      capacity_ = 2 * capacity_ + text.size();
      void* const larger = std::realloc(data_, capacity_);
      if (larger == nullptr) std::abort();
      data_ = static_cast<char*>(larger);
    }
    std::memcpy(data_ + size_, text.data(), text.size());
    size_ += text.size();
  }
  // Adds a string; bytes that are not UTF-8 become '?'.
  void add_string(std::string_view text) {
    add("\"");
    while (!text.empty()) {
      const auto byte = static_cast<unsigned char>(text[0]);
      char escape[8];
      std::size_t length = length_of_character(text);
      if (length == 0) {
        add("?");
        length = 1;
      } else if (byte < 0x20 || byte == '"' || byte == '\\' || byte == 0x7F) {
        std::snprintf(escape, sizeof escape, "\\u%04x", byte);
        add(escape);
      } else {
        add({text.data(), length});
      }
      text.remove_prefix(length);
    }
    add("\"");
  }

 private:
  // Returns the length of the first character in UTF-8, or 0 if it is none.
  static std::size_t length_of_character(std::string_view text) {
    const auto byte = [&](std::size_t i) {
      return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const unsigned lead = byte(0);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    for (std::size_t i = 1; i < length; ++i)
      if ((byte(i) & 0xC0) != 0x80) return 0;
    // Overlong forms, surrogates, and what is behind the last code point.
    if ((lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xED && byte(1) >= 0xA0) ||
        (lead == 0xF0 && byte(1) < 0x90) || (lead == 0xF4 && byte(1) >= 0x90))
      return 0;
    return length;
  }
  char* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

// Adds the command line of this process, or the beginning of a very long one.
void add_program(Text& text) {
  char arguments[16384];
  ssize_t length = -1;
  const int descriptor = open("/proc/self/cmdline", O_RDONLY | O_CLOEXEC);
  if (descriptor >= 0) {
    length = read(descriptor, arguments, sizeof arguments);
    close(descriptor);
  }
  std::string_view rest(arguments, length > 0 ? static_cast<std::size_t>(length) : 0);
  for (const char* separator = ""; !rest.empty(); separator = ",") {
    const std::string_view argument(rest.data(), std::min(rest.find('\0'), rest.size()));
    text.add(separator);
    text.add_string(argument);
    rest.remove_prefix(std::min(rest.size(), argument.size() + 1));
  }
}

template <class P>
constexpr char letter() {
  if constexpr (std::is_pointer_v<P>)
    return std::is_const_v<std::remove_pointer_t<P>> ? 'p' : 'o';
  else if constexpr (std::is_floating_point_v<P>)
    return sizeof(P) == sizeof(float) ? 'f' : 'd';
  else
    return 'i';
}

template <class Result, class... P>
void add_command(Text& text, const char* name, Result (*)(P...)) {
  const char letters[] = {':', letter<P>()..., '"', ',', '\0'};
  text.add("\"");
  text.add(name);
  text.add(letters);
}

void add_header(Text& text) {
  text.add(R"({"program":[)");
  add_program(text);
  text.add(R"(],"commands":[)");
#define RECORDED(name, parameters) add_command(text, #name, static_cast<decltype(&::gl##name)>(nullptr));
#include <recorded.def>
#undef RECORDED
  text.add(R"("@context:qq","@destroy:q","@frame:q"],"others":[)");
  for (int i = kAliasesEnd; i < kCountedEnd; ++i) {
    text.add(i == kAliasesEnd ? "\"" : ",\"");
    text.add(kNames[i]);
    text.add("\"");
  }
  text.add("]");
  if (is_limited_to_frames) {
    char range[64];
    std::snprintf(range, sizeof range, R"(,"frames":[%llu,%llu])",
                  static_cast<unsigned long long>(first_frame), static_cast<unsigned long long>(last_frame));
    text.add(range);
  }
  text.add("}");
}

// Creates the file of this process, with the first free of the names NAME, NAME.2, NAME.3 and so on.
void create_file() {
  constexpr int kMostFiles = 10000;
  int descriptor = -1;
  for (int i = 1; i <= kMostFiles && descriptor < 0; ++i) {
    std::snprintf(file.name, sizeof file.name, i == 1 ? "%s" : "%s.%d", base_name, i);
    descriptor = open(file.name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) break;
  }
  struct stat status {};
  if (descriptor < 0 || fstat(descriptor, &status) != 0) {
    cut(file.name, std::strerror(errno));
    if (descriptor >= 0) close(descriptor);
    return;
  }
  file.size = 0;
  file.device = status.st_dev;
  file.inode = status.st_ino;
  Text text;
  add_header(text);
  const std::uint64_t place = (sizeof(FileHeader) + text.view().size() + 7) / 8 * 8;
  const std::uint64_t size = rounded_up(place + kCounted * sizeof(std::uint64_t));
  if (size > size_limit()) cut("the size limit is reached (--limit or ulimit -f)");
  std::byte* const memory = is_active ? extend(descriptor, size) : nullptr;
  close(descriptor);
  if (memory == nullptr) {
    unlink(file.name);
    return;
  }
  std::memcpy(memory + sizeof(FileHeader), text.view().data(), text.view().size());
  file.header = reinterpret_cast<FileHeader*>(memory);
  file.header->size = size;
  file.header->text_length = text.view().size();
  file.header->counts = place;
  std::memcpy(file.header->magic, kMagic, sizeof kMagic);
  static_assert(sizeof(std::atomic<std::uint64_t>) == sizeof(std::uint64_t));
  counts.store(reinterpret_cast<std::atomic<std::uint64_t>*>(memory + place), std::memory_order_release);
}

// Returns the memory of a new chunk with at least so many bytes for records, or null if the recording has
// ended.
Chunk* new_chunk(std::uint64_t bytes, std::uint64_t& space) {
  if (file.header == nullptr && is_active) create_file();
  if (!is_active) return nullptr;
  const std::uint64_t least = rounded_up(sizeof(Chunk) + bytes);
  const std::uint64_t most = size_limit();
  const std::uint64_t left = most > file.size ? (most - file.size) / kAlignment * kAlignment : 0;
  if (least > left) {
    cut("the size limit is reached (--limit or ulimit -f)");
    return nullptr;
  }
  space = std::max(least, std::min(kChunkSpace, left));
  const int descriptor = open(file.name, O_RDWR | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0 || fstat(descriptor, &status) != 0 || status.st_dev != file.device ||
      status.st_ino != file.inode) {
    cut(file.name, descriptor < 0 ? std::strerror(errno) : "another file has this name now");
    if (descriptor >= 0) close(descriptor);
    return nullptr;
  }
  std::byte* const memory = extend(descriptor, space);
  close(descriptor);
  return reinterpret_cast<Chunk*>(memory);
}

std::byte* put_context(std::byte* at, const Writer& of) {
  return put(put(put(at, static_cast<std::uint16_t>(kContextEvent)), of.context), of.order);
}

void put_event(Writer& of, int event, std::uint64_t value) {
  if (std::byte* const at = of.reserve(2 + sizeof value))
    of.commit(put(put(at, static_cast<std::uint16_t>(event)), value));
}

// MAX_EVAL_ORDER of the contexts that were current.
struct KnownContext {
  const void* context;
  std::int64_t max_order;
  KnownContext* following;
};
KnownContext* known_contexts = nullptr;

// Returns a command of the current context, or null.
template <class Function>
Function* loaded(int number) {
  void* address = find_loaded(number);
  // A program may have opened libEGL alone.
  if (address == nullptr)
    if (auto* const get = reinterpret_cast<void* (*)(const char*)>(find_loaded(keglGetProcAddress)))
      address = get(kNames[number]);
  return reinterpret_cast<Function*>(address);
}

// Asks the current context for MAX_EVAL_ORDER. Returns 0 if it has no evaluators. No query is an error in any
// context.
std::int64_t ask_for_max_order() {
  constexpr std::int64_t kLeast = 8;
  auto* const get_string = loaded<decltype(::glGetString)>(kGetString);
  auto* const get_integers = loaded<decltype(::glGetIntegerv)>(kGetIntegerv);
  if (get_string == nullptr || get_integers == nullptr) return kLeast;
  const auto* const text = reinterpret_cast<const char*>(get_string(GL_VERSION));
  int major = 0, minor = 0;
  if (text == nullptr) return kLeast;
  if (std::sscanf(text, "%d.%d", &major, &minor) != 2)
    return std::strstr(text, "OpenGL ES") != nullptr ? 0 : kLeast;
  const int version = 10 * major + minor;
  if (version == 31) return kLeast;  // with and without evaluators
  GLint profile = 0, most = 0;
  if (version >= 32) get_integers(GL_CONTEXT_PROFILE_MASK, &profile);
  if ((profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0) return 0;
  get_integers(GL_MAX_EVAL_ORDER, &most);
  return std::max<std::int64_t>(most, kLeast);
}

std::int64_t max_order_of(const void* context) {
  {
    const Lock lock;
    for (const KnownContext* known = known_contexts; known != nullptr; known = known->following)
      if (known->context == context) return known->max_order;
  }
  const int before = errno;
  const std::int64_t max_order = ask_for_max_order();
  errno = before;
  const Lock lock;
  if (void* const memory = std::malloc(sizeof(KnownContext)))
    known_contexts = new (memory) KnownContext{context, max_order, known_contexts};
  return max_order;
}

// Returns the writer of this thread, which may be that of a thread that has ended.
Writer* writer_of_thread() {
  if (writer != nullptr) return writer;
  const Lock lock;
  Writer* chosen = writers;
  while (chosen != nullptr && !chosen->is_free) chosen = chosen->following;
  if (chosen == nullptr) {
    void* const memory = std::malloc(sizeof(Writer));
    if (memory == nullptr) return nullptr;
    chosen = new (memory) Writer;
    chosen->thread = writers != nullptr ? writers->thread + 1 : 0;
    chosen->following = writers;
    writers = chosen;
  }
  chosen->is_free = false;
  pthread_setspecific(thread_end, chosen);
  writer = chosen;
  return chosen;
}

void begin_context(Writer& of, std::uint64_t context) {
  of.context = context;
  of.order = orders.fetch_add(1) + 1;
  if (of.chunk == nullptr || !is_active) return;
  if (std::byte* const at = of.reserve(kContextBytes)) of.commit(put_context(at, of));
}

void free_writer(Writer& of) {
  of.context = 0;
  of.records = of.is_in_primitive = false;
  of.list_mode = 0;
  of.is_free = true;
}

void end_thread(void* ended) {
  const Lock lock;
  writer = nullptr;
  free_writer(*static_cast<Writer*>(ended));
}

// A child has a file of its own, and must not write into that of its parent.
void after_fork_in_child() {
  for (Writer* each = writers; each != nullptr; each = each->following) {
    if (each->chunk != nullptr) munmap(each->chunk, each->space);
    each->chunk = nullptr;
    each->next = each->end = nullptr;
    if (each != writer) free_writer(*each);
  }
  if (file.header != nullptr) munmap(file.header, file.header->size);
  file.header = nullptr;
  counts.store(is_active ? nullptr : unwritten_counts);
  pthread_mutex_unlock(&mutex);
}

[[gnu::constructor]] void begin() {
  const char* const name = std::getenv("EVALCTS_RECORD");
  if (name == nullptr || *name == '\0' || std::strlen(name) >= sizeof base_name) return;
  std::memcpy(base_name, name, std::strlen(name) + 1);
  const char* const bytes = std::getenv("EVALCTS_RECORD_LIMIT");
  limit = bytes != nullptr ? std::strtoull(bytes, nullptr, 10) : std::uint64_t{1} << 30;
  if (const char* const range = std::getenv("EVALCTS_RECORD_FRAMES")) {
    char* end = nullptr;
    first_frame = std::strtoull(range, &end, 10);
    last_frame = std::strtoull(end + std::strspn(end, "."), nullptr, 10);
    is_limited_to_frames = true;
  }
  if (pthread_key_create(&thread_end, end_thread) != 0) return;
  pthread_atfork([] { pthread_mutex_lock(&mutex); }, [] { pthread_mutex_unlock(&mutex); },
                 after_fork_in_child);
  counts.store(nullptr);
  is_active = true;
}

// Cuts the file behind the last record. Threads that still record get other memory before.
[[gnu::destructor]] void end() {
  const Lock lock;
  is_active = false;
  if (file.header == nullptr) return;
  std::uint64_t size = file.size;
  for (const Writer* each = writers; each != nullptr; each = each->following) {
    if (each->chunk == nullptr) continue;
    if (each->offset + each->space == file.size) size -= static_cast<std::uint64_t>(each->end - each->next);
    void* const memory = mmap(each->chunk, each->space, PROT_READ | PROT_WRITE,
                              MAP_FIXED | MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return;
  }
  struct stat status {};
  if (stat(file.name, &status) == 0 && status.st_dev == file.device && status.st_ino == file.inode &&
      truncate(file.name, static_cast<off_t>(size)) != 0)
    return;
}

}  // namespace

void count_first(int index) {
  {
    const Lock lock;
    if (file.header == nullptr && is_active) create_file();
  }
  counts.load()[index].fetch_add(1, std::memory_order_relaxed);
}

std::byte* Writer::reserve_in_new_chunk(std::size_t bytes) {
  const Lock lock;
  const bool is_first = chunk == nullptr;
  std::uint64_t new_space = 0;
  Chunk* const created = new_chunk(bytes + (is_first ? kContextBytes : 0), new_space);
  if (created == nullptr) return nullptr;
  if (!is_first) munmap(chunk, space);
  chunk = created;
  space = new_space;
  offset = file.size - space;
  chunk->thread = thread;
  chunk->space = space;
  __atomic_store_n(&chunk->magic, kChunkMagic, __ATOMIC_RELEASE);
  next = reinterpret_cast<std::byte*>(chunk + 1);
  end = reinterpret_cast<std::byte*>(chunk) + space;
  if (is_first) commit(put_context(next, *this));
  return next;
}

bool Writer::leaves_out(CommandClass kind) {
  if (list_mode != 0) return false;
  if (!is_in_primitive) {
    const std::uint64_t frame = frames.load(std::memory_order_relaxed);
    is_left_out = frame < first_frame || frame > last_frame;
  }
  return is_left_out && (kind == CommandClass::kDrawing || (kind == CommandClass::kState && is_in_primitive));
}

void note_current(const void* context, bool is_osmesa) {
  if (!is_active || (context == nullptr && writer == nullptr)) return;
  Writer* const current = writer_of_thread();
  if (current == nullptr || current->context == reinterpret_cast<std::uintptr_t>(context)) return;
  current->max_order = context != nullptr ? max_order_of(context) : 0;
  current->records = current->max_order > 0;
  current->ends_frames_by_flush = is_osmesa;
  current->is_in_primitive = false;
  current->list_mode = 0;
  begin_context(*current, reinterpret_cast<std::uintptr_t>(context));
}

void note_destroyed(const void* context) {
  if (!is_active) return;
  {
    const Lock lock;
    for (KnownContext** known = &known_contexts; *known != nullptr; known = &(*known)->following)
      if ((*known)->context == context) {
        KnownContext* const removed = *known;
        *known = removed->following;
        std::free(removed);
        break;
      }
    if (file.header == nullptr) return;
  }
  Writer* const current = writer_of_thread();
  if (current == nullptr) return;
  // The event comes behind those that other threads have written before.
  begin_context(*current, current->context);
  put_event(*current, kDestroyEvent, reinterpret_cast<std::uintptr_t>(context));
}

void note_frame() {
  const std::uint64_t frame = frames.fetch_add(1);
  if (is_active && writer != nullptr && writer->chunk != nullptr) put_event(*writer, kFrameEvent, frame);
}

}  // namespace evalcts::record
