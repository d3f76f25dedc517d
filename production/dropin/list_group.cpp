// The display lists of contexts that share lists, by name.
#include <pthread.h>

#include "lists.h"

namespace glev::dropin {
namespace {

// Returns the first element that is not less than `name` in an array sorted by `name_of`.
template <class T, class NameOf>
std::size_t lower_bound_in(Array<T>& sorted, GLuint name, const NameOf& name_of) {
  std::size_t first = 0, last = sorted.size();
  while (first < last) {
    const std::size_t middle = (first + last) / 2;
    if (name_of(sorted[middle]) < name)
      first = middle + 1;
    else
      last = middle;
  }
  return first;
}

}  // namespace

class Group::Lock {
 public:
  Lock() { pthread_mutex_lock(&mutex); }
  ~Lock() { pthread_mutex_unlock(&mutex); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  static pthread_mutex_t mutex;  // protects all groups
};
pthread_mutex_t Group::Lock::mutex = PTHREAD_MUTEX_INITIALIZER;

Group* Group::create() {
  void* const memory = std::malloc(sizeof(Group));
  return memory != nullptr ? new (memory) Group() : nullptr;
}

void Group::retain() {
  const Lock lock;
  ++references_;
}

// The driver deletes its own lists with its last context.
void Group::release() {
  {
    const Lock lock;
    if (--references_ > 0) return;
  }
  for (List* const list : lists_) {
    list->~List();
    std::free(list);
  }
  this->~Group();
  std::free(this);
}

std::size_t Group::lower_bound(GLuint name) {
  return lower_bound_in(lists_, name, [](const List* list) { return list->name; });
}

std::size_t Group::place_of_segment(GLuint name) {
  return lower_bound_in(segments_, name, [](GLuint segment) { return segment; });
}

List* Group::find(GLuint name) {
  const Lock lock;
  const std::size_t place = lower_bound(name);
  if (place == lists_.size() || lists_[place]->name != name) return nullptr;
  ++lists_[place]->references;
  return lists_[place];
}

Primitive Group::primitive_of(GLuint name) {
  const Lock lock;
  const std::size_t place = lower_bound(name);
  if (place == lists_.size() || lists_[place]->name != name) return Primitive::kUnchanged;
  return lists_[place]->primitive;
}

bool Group::is_empty() {
  const Lock lock;
  return lists_.size() == 0;
}

// Requires the lock.
void Group::drop(List* list) {
  if (--list->references > 0) return;
  for (const GLuint segment : list->segments) {
    gl_below().DeleteLists(segment, 1);
    const std::size_t place = place_of_segment(segment);
    if (place < segments_.size() && segments_[place] == segment) segments_.erase(place);
  }
  list->~List();
  std::free(list);
}

void Group::release_list(List* list) {
  const Lock lock;
  drop(list);
}

void Group::define(List* list) {
  const Lock lock;
  const std::size_t place = lower_bound(list->name);
  if (place < lists_.size() && lists_[place]->name == list->name) {
    drop(lists_[place]);
    lists_[place] = list;
  } else if (!lists_.insert(place, list)) {
    drop(list);
  }
}

void Group::delete_lists(GLuint first, GLuint last) {
  const Lock lock;
  const std::size_t begin = lower_bound(first);
  std::size_t end = begin;
  while (end < lists_.size() && lists_[end]->name <= last) drop(lists_[end++]);
  lists_.erase(begin, end - begin);
}

GLuint Group::new_segment() {
  const Lock lock;
  while (gl_below().IsList(next_segment_)) ++next_segment_;
  segments_.insert(segments_.size(), next_segment_);
  return next_segment_++;
}

bool Group::is_segment(GLuint name) {
  const Lock lock;
  const std::size_t place = place_of_segment(name);
  return place < segments_.size() && segments_[place] == name;
}

}  // namespace glev::dropin
