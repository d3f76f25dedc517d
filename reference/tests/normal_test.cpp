#include <gtest/gtest.h>
#include <reference/normal.h>
#include <vector>
namespace evalcts::reference {
namespace {
TEST(NormalVector, PointsUpFromAPlane) {
  const std::vector<double> p{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};  // [i][j] : x = i, y = j
  std::vector<Surface> s;
  for (int c = 0; c < 3; ++c) s.push_back({&p[c], 6, 3, 2, 2, 0, 1, 0, 1});
  const Argument u = Argument::coordinate(0.25), v = Argument::coordinate(0.75);
  EXPECT_EQ(normal_vector(s, u, v), (Vector{0, 0, 1}));
  const NormalAcceptance a = normal_acceptance(s, u, v);
  EXPECT_TRUE(a.must_applies);
  ASSERT_TRUE(a.bound);
  std::cout << *a.bound << " " << *a.vector_bound << "\n";
  EXPECT_TRUE(is_within({0, 0, 1}, a.m, *a.bound, false));
  EXPECT_FALSE(is_within({0, 0.01f, 1}, a.m, *a.bound, false));
  EXPECT_EQ(rounded_unit_vector({3, 4, 0}), (std::array<float, 3>{0.6f, 0.8f, 0}));
}
}  // namespace
}  // namespace evalcts::reference
