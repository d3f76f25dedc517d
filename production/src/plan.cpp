#include "production/src/plan.h"

#include <new>

namespace {

using glev::Allocator, glev::Attribute, glev::Grid, glev::kAttributes, glev::kCacheLine, glev::kSlots,
    glev::kSlotTable, glev::Map;

// The highest enabled slot of the attribute, -1 if none is.
int WinningSlot(Attribute attribute, std::span<const bool, kSlots> enabled) {
  const auto [first, last] = glev::SlotsOf(attribute);
  for (int slot = last; slot >= first; --slot) {
    if (enabled[slot]) return slot;
  }
  return -1;
}

constexpr std::size_t RoundUp(std::size_t bytes) {
  return (bytes + kCacheLine - 1) / kCacheLine * kCacheLine;
}

}  // namespace

glev_plan* glev_plan::Create1(const Allocator& allocator, std::span<const Map, kSlots> maps,
                              std::span<const bool, kSlots> enabled, const Grid& grid) {
  std::array<int, kAttributes> winners;
  std::size_t bytes = RoundUp(sizeof(glev_plan));
  for (int a = 0; a < kAttributes; ++a) {
    winners[a] = WinningSlot(static_cast<Attribute>(a), enabled);
    if (winners[a] < 0) continue;
    bytes += RoundUp(sizeof(double) * maps[winners[a]].order(0) * kSlotTable[winners[a]].components);
  }

  void* memory = allocator.Allocate(bytes, kCacheLine);
  if (memory == nullptr) return nullptr;
  auto* plan = new (memory) glev_plan(allocator, bytes, grid);

  auto* block = static_cast<std::byte*>(memory) + RoundUp(sizeof(glev_plan));
  for (int a = 0; a < kAttributes; ++a) {
    if (winners[a] < 0) continue;
    const int slot = winners[a];
    const Map& map = maps[slot];
    const int components = kSlotTable[slot].components;
    auto* scaled = reinterpret_cast<double*>(block);
    glev::ScaleByBinomials(map.points(slot), map.order(0), components, scaled);
    plan->curves_[a] = {map.order(0) - 1, components, map.domain(0), scaled};
    block += RoundUp(sizeof(double) * map.order(0) * components);
  }
  return plan;
}

void glev_plan::Release() const {
  if (references_.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  const Allocator allocator = allocator_;
  const std::size_t bytes = bytes_;
  this->~glev_plan();
  allocator.Release(const_cast<glev_plan*>(this), bytes, kCacheLine);
}
