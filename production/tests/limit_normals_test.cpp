// Tests the limits of normals on edges that are a single point: they are near the normals next to the edge,
// and keep the documented error bound, with 600 binary digits as the oracle.
#include <cmath>

#include "exact.h"
#include "nets.h"

namespace glev_tests {
namespace {

class LimitNormals : public ::testing::Test {
 protected:
  // Returns a patch whose edge at one end of a direction is a single point.
  Net choose_pole(int direction, bool is_last, int most_order) {
    Net net;
    net.order = {chance_.whole(2, most_order), chance_.whole(2, most_order)};
    net.components = chance_.whole(3, 4);
    net.count = 1;
    net.is_double = true;
    if (chance_.whole(0, 2) == 0) net.domain = {2, -1, 0, 4};
    for (int i = 0; i < net.order[0]; ++i) {
      for (int j = 0; j < net.order[1]; ++j) {
        const int across = direction == 0 ? i : j, last = net.order[static_cast<std::size_t>(direction)] - 1;
        const bool is_pole = across == (is_last ? last : 0);
        const double apart = 0.25 * chance_.next_double();
        net.values.insert(net.values.end(), {is_pole ? 1 : i + apart, is_pole ? 2 : j - apart,
                                             is_pole ? 0 : 0.5 * (i + 2) * (j - 3) + apart});
        if (net.components == 4) net.values.push_back(is_pole ? 1.5 : 1 + 0.25 * chance_.next_double());
      }
    }
    return net;
  }

  Chance chance_;
};

// Makes each edge a single point in turn, and compares its normals with those of arguments next to the edge.
TEST_F(LimitNormals, AreThoseNextToTheEdge) {
  for (int k = 0; k < 200; ++k) {
    const int direction = chance_.whole(0, 1);
    const bool is_last = chance_.whole(0, 1) == 1;
    const Net net = choose_pole(direction, is_last, 5);
    const auto [u1, u2, v1, v2] = net.domain;
    const auto at = [](double first, double last, double t) {
      return t == 1 ? last : first + t * (last - first);
    };
    // Five points on the edge, or next to it.
    const std::vector<glev_uint> numbers(5, 0);
    const auto normals_at = [&]<class Real>(Real, double off, bool limits) {
      std::vector<double> u, v;
      for (int i = 0; i <= 4; ++i) {
        const double along = i / 4.0, across = is_last ? 1 - off : off;
        u.push_back(at(net.domain[0], net.domain[1], direction == 0 ? across : along));
        v.push_back(at(net.domain[2], net.domain[3], direction == 0 ? along : across));
      }
      glev_patch_grid grid = glevaluator::make_scattered_grid<double>(numbers, u, v);
      grid.limit_normals = limits;
      const auto normals = net.evaluate<Real>(grid, GLEV_ATTRIBUTE_NORMAL, 5);
      return std::vector<double>(normals.begin(), normals.end());
    };
    EXPECT_EQ(normals_at(double{}, 0, false), std::vector<double>(15));
    const std::vector<double> limits =
                                  k % 2 == 0 ? normals_at(double{}, 0, true) : normals_at(float{}, 0, true),
                              inside = normals_at(double{}, 0x1p-24, true);
    EXPECT_EQ(inside, normals_at(double{}, 0x1p-24, false));
    for (std::size_t e = 0; e < 15; ++e)
      ASSERT_NEAR(limits[e], inside[e], 2e-5)
          << "case " << k << ", value " << e << ", direction " << direction;
    // Uniform grids and lists have the same normals.
    std::vector<double> u, v;
    for (int i = 0; i <= 4; ++i) u.push_back(at(u1, u2, i / 4.0)), v.push_back(at(v1, v2, i / 4.0));
    for (glev_patch_grid grid :
         {glevaluator::make_uniform_grid(4, 4), glevaluator::make_list_grid<double>(u, v)}) {
      grid.limit_normals = GLEV_TRUE;
      const Floats results = net.evaluate(grid, GLEV_ATTRIBUTE_NORMAL, 25);
      for (std::size_t e = 0; e < 5; ++e) {
        const std::size_t edge = is_last ? 4 : 0, point = direction == 0 ? 5 * e + edge : 5 * edge + e;
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_EQ(results[3 * point + c], static_cast<float>(limits[3 * e + c]))
              << "case " << k << ", point " << e;
      }
    }
  }
}

// All control points are equal, or the limit needs derivatives of higher order.
TEST_F(LimitNormals, ThatAreNotDeterminedAreZero) {
  for (double z : {0.0, 1.0}) {
    Net net;
    net.count = 1;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) net.values.insert(net.values.end(), {0, 0, j * z});
    }
    glev_patch_grid grid = glevaluator::make_uniform_grid(2, 2);
    grid.limit_normals = GLEV_TRUE;
    EXPECT_EQ(net.evaluate(grid, GLEV_ATTRIBUTE_NORMAL, 9), Floats(27));
  }
}

// ---- The error bound

struct Limit {
  WideVector normal;
  Wide ratio;  // |m| / |majorant|, as documented at limit_normals
};

// Returns the exact limit of the normal at position t along the edge, computed from the mixed derivative of
// the surface and the derivative across the edge.
Limit exact_limit(const Net& net, int direction, bool is_last, const Wide& t) {
  const auto components = static_cast<std::size_t>(net.components);
  const int other = 1 - direction;
  const int m = net.order[1];
  std::array<Wide, 4> p = {0, 0, 0, 1}, across{}, mixed{};
  std::array<double, 4> largest_p = {0, 0, 0, 1}, largest{};
  for (std::size_t k = 0; k < components; ++k) {
    const auto point = [&](int i, int j) {
      return net.values[static_cast<std::size_t>(i * m + j) * components + k];
    };
    for (const int derivatives : {0, 1, 2}) {
      std::array<std::vector<Wide>, 2> basis;
      const Wide end = is_last ? 1 : 0;
      basis[static_cast<std::size_t>(direction)] = bernstein<Wide>(
          net.order[static_cast<std::size_t>(direction)], end, 1 - end, derivatives > 0 ? 1 : 0);
      basis[static_cast<std::size_t>(other)] =
          bernstein<Wide>(net.order[static_cast<std::size_t>(other)], t, 1 - t, derivatives > 1 ? 1 : 0);
      Wide& sum = derivatives == 0 ? p[k] : derivatives == 1 ? across[k] : mixed[k];
      sum = tensor(basis[0], basis[1], net.values, net.components, static_cast<int>(k)).value;
    }
    for (int i = 0; i < net.order[static_cast<std::size_t>(other)]; ++i) {
      const int last = net.order[static_cast<std::size_t>(direction)] - 1, edge = is_last ? last : 0,
                next = is_last ? last - 1 : 1;
      const double on = direction == 0 ? point(edge, i) : point(i, edge),
                   off = direction == 0 ? point(next, i) : point(i, next);
      largest_p[k] = std::max(largest_p[k], std::fabs(on));
      largest[k] = std::max(largest[k], std::fabs(off - on));
    }
  }
  WideVector a, b, most;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = p[3] * mixed[k] - mixed[3] * p[k];
    b[k] = p[3] * across[k] - across[3] * p[k];
    most[k] = Wide(largest_p[3]) * largest[k] + Wide(largest[3]) * largest_p[k];
  }
  if (is_last == (direction == 1)) std::swap(a, b);
  const WideVector product = cross_product(a, b);
  // Differences along the edge are at most twice those across it.
  WideVector majorant;
  const int scale = net.order[static_cast<std::size_t>(direction)] - 1,
            degree = net.order[static_cast<std::size_t>(other)] - 1;
  for (std::size_t k = 0; k < 3; ++k)
    majorant[k] = Wide(4 * scale * scale * degree) * most[(k + 1) % 3] * most[(k + 2) % 3];
  Limit limit;
  const Wide length = length_of(product);
  limit.ratio = length / length_of(majorant);
  for (std::size_t k = 0; k < 3; ++k) limit.normal[k] = product[k] / length;
  return limit;
}

TEST_F(LimitNormals, KeepTheirBound) {
  double worst = 0, least = 1;
  for (int k = 0; k < 400; ++k) {
    const int direction = k % 2;
    const bool is_last = k % 4 >= 2;
    const Net net = choose_pole(direction, is_last, k % 10 == 0 ? 16 : 5);
    const auto [u1, u2, v1, v2] = net.domain;
    // Arguments along the edge, and its position.
    std::vector<double> along, across = {direction == 0 ? (is_last ? u2 : u1) : (is_last ? v2 : v1)};
    const double first = direction == 0 ? v1 : u1, last = direction == 0 ? v2 : u2;
    for (int i = 0; i < 9; ++i) along.push_back(first + chance_.next_double() * (last - first));
    along[0] = first, along[1] = last;
    glev_patch_grid grid = direction == 0 ? glevaluator::make_list_grid<double>(across, along)
                                          : glevaluator::make_list_grid<double>(along, across);
    grid.limit_normals = GLEV_TRUE;
    const Floats results = net.evaluate(grid, GLEV_ATTRIBUTE_NORMAL, along.size());
    for (std::size_t e = 0; e < along.size(); ++e) {
      const Wide t = (Wide(along[e]) - first) / (Wide(last) - first);
      const Limit limit = exact_limit(net, direction, is_last, t);
      if (limit.ratio < 0x1p-12) continue;
      least = std::min(least, limit.ratio.convert_to<double>());
      for (std::size_t c = 0; c < 3; ++c) {
        const auto error = abs(results[3 * e + c] - limit.normal[c]).convert_to<double>();
        ASSERT_LE(error, 0x1p-25 + 0x1p-30)
            << "case " << k << ", direction " << direction << ", element " << e;
        worst = std::max(worst, error);
      }
    }
  }
  EXPECT_GT(worst, 0x1p-27);  // rounded to float
  EXPECT_LT(least, 0x1p-8);   // not only well-conditioned cases
}

}  // namespace
}  // namespace glev_tests
