// The lists of contexts that share them, by name.
#include <pthread.h>

#include "lists.h"

namespace glev::dropin {
namespace {

// The first element that is not less than `name`, in an array sorted by `name_of`.
template <class T, class NameOf>
std::size_t LowerBoundIn(Array<T>& sorted, GLuint name, const NameOf& name_of) {
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
  static pthread_mutex_t mutex;  // of all groups
};
pthread_mutex_t Group::Lock::mutex = PTHREAD_MUTEX_INITIALIZER;

Group* Group::Create() {
  void* const memory = std::malloc(sizeof(Group));
  return memory != nullptr ? new (memory) Group() : nullptr;
}

void Group::Retain() {
  const Lock lock;
  ++references_;
}

// The driver's lists go with its last context.
void Group::Release() {
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

std::size_t Group::LowerBound(GLuint name) {
  return LowerBoundIn(lists_, name, [](const List* list) { return list->name; });
}

std::size_t Group::PlaceOfSegment(GLuint name) {
  return LowerBoundIn(segments_, name, [](GLuint segment) { return segment; });
}

List* Group::Find(GLuint name) {
  const Lock lock;
  const std::size_t place = LowerBound(name);
  if (place == lists_.size() || lists_[place]->name != name) return nullptr;
  ++lists_[place]->references;
  return lists_[place];
}

Primitive Group::PrimitiveOf(GLuint name) {
  const Lock lock;
  const std::size_t place = LowerBound(name);
  if (place == lists_.size() || lists_[place]->name != name) return Primitive::kUnchanged;
  return lists_[place]->primitive;
}

bool Group::IsEmpty() {
  const Lock lock;
  return lists_.size() == 0;
}

// With the lock held.
void Group::Drop(List* list) {
  if (--list->references > 0) return;
  for (const GLuint segment : list->segments) {
    Gl().DeleteLists(segment, 1);
    const std::size_t place = PlaceOfSegment(segment);
    if (place < segments_.size() && segments_[place] == segment) segments_.Erase(place);
  }
  list->~List();
  std::free(list);
}

void Group::ReleaseList(List* list) {
  const Lock lock;
  Drop(list);
}

void Group::Define(List* list) {
  const Lock lock;
  const std::size_t place = LowerBound(list->name);
  if (place < lists_.size() && lists_[place]->name == list->name) {
    Drop(lists_[place]);
    lists_[place] = list;
  } else if (!lists_.Insert(place, list)) {
    Drop(list);
  }
}

void Group::Delete(GLuint first, GLuint last) {
  const Lock lock;
  const std::size_t begin = LowerBound(first);
  std::size_t end = begin;
  while (end < lists_.size() && lists_[end]->name <= last) Drop(lists_[end++]);
  lists_.Erase(begin, end - begin);
}

GLuint Group::NewSegment() {
  const Lock lock;
  while (Gl().IsList(next_segment_)) ++next_segment_;
  segments_.Insert(segments_.size(), next_segment_);
  return next_segment_++;
}

bool Group::IsSegment(GLuint name) {
  const Lock lock;
  const std::size_t place = PlaceOfSegment(name);
  return place < segments_.size() && segments_[place] == name;
}

}  // namespace glev::dropin
