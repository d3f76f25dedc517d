// Computes the digest of the results on random maps.
#include <evalcts/accuracy/digest.h>

#include <algorithm>
#include <bit>
#include <exception>
#include <mutex>
#include <thread>

#include <evalcts/accuracy/subject.h>
#include <evalcts/gl/tokens.h>

namespace evalcts::accuracy {
namespace {

// Number of results of one map. It is a multiple of 1, 2, 3 and 4 components.
constexpr std::uint64_t kOfMap = 1200;

SweptMap random_swept_map(Random& random) {
  static const std::vector<std::string> kTargets = target_names();
  static const char* const kData[] = {"ordinary", "integers", "lines", "cancelling", "wide", "extreme"};
  SweptMap what;
  what.target = kTargets[random.below(kTargets.size())];
  what.two_dimensional = random.once_in(3);
  Map& map = what.map;
  const int most = !what.two_dimensional || random.once_in(16) ? 30 : 8;
  map.uorder = 1 + static_cast<int>(random.below(most));
  map.vorder = what.two_dimensional ? 1 + static_cast<int>(random.below(most)) : 1;
  map.components = gl::components_of(target_of(what.target, what.two_dimensional));
  const Class kind = {map.uorder, what.two_dimensional ? map.vorder : 0,
                      kData[random.below(std::size(kData))]};
  draw_points(map, kind, random);
  what.along_v = what.two_dimensional && random.once_in(2);
  return what;
}

float anywhere(Random& random) {
  switch (random.below(8)) {
    case 0:
      return static_cast<float>(random.below(65)) / 64;
    case 1:
      return static_cast<float>(random.scaled(0, 1, -static_cast<int>(random.below(120))));
    case 2:
      return static_cast<float>(random.between(-0.5, 1.5));
    default:
      return static_cast<float>(random.uniform());
  }
}

std::uint64_t digest_of_map(const StreamSource& source, const DigestRequest& request, std::uint64_t item) {
  Random random(request.seed, item);
  SweptMap map = random_swept_map(random);
  map.other = map.two_dimensional ? anywhere(random) : 0;
  std::vector<float> u(kOfMap / map.map.components), results(kOfMap);
  for (float& x : u) x = anywhere(random);
  const auto& make = source.make_other && item % 2 == 1 ? source.make_other : source.make;
  make(map)->evaluate(u, results);
  const std::uint64_t first = item * kOfMap, count = std::min(kOfMap, request.values - first);
  std::uint64_t sum = 0;
  for (std::uint64_t i = 0; i < count; ++i)
    sum += mixed(mixed(first + i) + std::bit_cast<std::uint32_t>(results[i]));
  return sum;
}

}  // namespace

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

std::uint64_t digest(const StreamSource& source, const DigestRequest& request,
                     const std::atomic<bool>& stop) {
  const std::uint64_t items = (request.values + kOfMap - 1) / kOfMap;
  std::atomic<std::uint64_t> next = 0, sum = 0;
  std::mutex mutex;
  std::exception_ptr problem;
  const auto work_off = [&] {
    try {
      for (std::uint64_t item; !stop && (item = next++) < items;) sum += digest_of_map(source, request, item);
    } catch (...) {
      const std::lock_guard lock(mutex);
      problem = std::current_exception();
      next = items;
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; source.for_threads && i < request.threads; ++i) others.emplace_back(work_off);
  work_off();
  for (std::thread& other : others) other.join();
  if (problem) std::rethrow_exception(problem);
  return sum;
}

}  // namespace evalcts::accuracy
