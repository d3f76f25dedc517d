// Tests GetnMap, which respects the size of the array.
#include <algorithm>

#include "fixture.h"

namespace glev_tests {
namespace {

struct Query {
  glev_enum target, query;
  int count;
};

class GetnMap : public ContextTest {
 protected:
  GetnMap() {
    for (std::size_t i = 0; i < points_.size(); ++i) points_[i] = 0.75 * static_cast<double>(i) - 3;
    for (const TargetRow& row : target_rows()) {
      const glev_enum map1 = GLEV_MAP1_COLOR_4 + row.offset, map2 = GLEV_MAP2_COLOR_4 + row.offset;
      glevMap1d(gl, map1, 0.5, 2, row.components, 3, points_.data());
      glevMap2d(gl, map2, 0.5, 2, 4 * row.components, 2, -1, 7, row.components, 4, points_.data());
      for (const auto& [target, dimension, points] : {std::tuple{map1, 1, 3}, {map2, 2, 8}}) {
        queries_.push_back({target, GLEV_ORDER, dimension});
        queries_.push_back({target, GLEV_DOMAIN, 2 * dimension});
        queries_.push_back({target, GLEV_COEFF, points * row.components});
      }
    }
    expect_error(GLEV_NO_ERROR);
  }

  template <class Number>
  using Getn = void (*)(glev_context*, glev_enum, glev_enum, glev_int, Number*);
  template <class Number>
  using Get = void (*)(glev_context*, glev_enum, glev_enum, Number*);

  template <class Number>
  void check(Getn<Number> getn, Get<Number> get) {
    for (const Query& query : queries_) {
      const int bytes = query.count * static_cast<int>(sizeof(Number));
      std::vector<Number> expected(query.count);
      get(gl, query.target, query.query, expected.data());
      expected.push_back(-77);
      for (const int size : {bytes, bytes + 1, 1 << 20}) {
        std::vector<Number> got(query.count + 1, -77);
        expect_accepted([&] { getn(gl, query.target, query.query, size, got.data()); });
        EXPECT_EQ(got, expected);
      }
      std::vector<Number> untouched(query.count, -77);
      const auto refuse = [&](glev_enum error, glev_enum target, glev_enum name, int size) {
        expect_rejected(error, [&] { getn(gl, target, name, size, untouched.data()); });
      };
      refuse(GLEV_INVALID_OPERATION, query.target, query.query, bytes - 1);
      refuse(GLEV_INVALID_OPERATION, query.target, query.query, 0);
      refuse(GLEV_INVALID_VALUE, query.target, query.query, -1);
      refuse(GLEV_INVALID_VALUE, query.target, query.query, -2147483647 - 1);
      refuse(GLEV_INVALID_ENUM, 0x0DB9, query.query, bytes);
      refuse(GLEV_INVALID_ENUM, query.target, 0x0A03, bytes);
      expect_rejected(GLEV_INVALID_VALUE, [&] { getn(gl, query.target, query.query, bytes, nullptr); });
      expect_rejected_in_primitive(GLEV_INVALID_OPERATION,
                                   [&] { getn(gl, query.target, query.query, bytes, untouched.data()); });
      EXPECT_EQ(untouched, std::vector<Number>(query.count, -77));
    }
  }

  std::vector<double> points_ = std::vector<double>(64);
  std::vector<Query> queries_;
};

TEST_F(GetnMap, Doubles) { check<double>(glevGetnMapdv, glevGetMapdv); }
TEST_F(GetnMap, Floats) { check<float>(glevGetnMapfv, glevGetMapfv); }
TEST_F(GetnMap, Integers) { check<int>(glevGetnMapiv, glevGetMapiv); }

}  // namespace
}  // namespace glev_tests
