// Runs programs that are not aware of the drop-in library, with it and without it, and compares their
// vertices.
#include <glevaluator.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "client.h"

namespace {

using Vertex = std::array<float, 4>;
// The output of a program: titles, each followed by lines of up to four numbers.
using Printed = std::map<std::string, std::vector<Vertex>>;

struct Finished {
  int status = -1;
  std::string output;  // standard output and standard error
};

Finished run_shell(const std::string& command) {
  Finished finished;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return finished;
  char buffer[4096];
  while (const std::size_t count = fread(buffer, 1, sizeof buffer, pipe))
    finished.output.append(buffer, count);
  finished.status = pclose(pipe);
  return finished;
}

Printed play(const std::string& command) {
  const Finished finished = run_shell(command);
  EXPECT_EQ(finished.status, 0) << command << "\n" << finished.output;
  Printed printed;
  std::string title;
  std::istringstream lines(finished.output);
  for (std::string line; std::getline(lines, line);) {
    Vertex v{};
    char* end = line.data();
    std::size_t count = 0;
    for (const char* begin = line.c_str(); count < 4; ++count, begin = end) {
      v[count] = std::strtof(begin, &end);
      if (end == begin) break;
    }
    if (count == 0)
      title = line;
    else
      printed[title].push_back(v);
  }
  return printed;
}

const std::string kPreload = "LD_PRELOAD=" DROPIN " ";

// --- The expected values, correctly rounded by libglevaluator

class Expected {
 public:
  Expected() {
    glevCreateContext(nullptr, &gl_);
    const glev_sink sink = {sizeof sink, &vertices_, nullptr,
                            [](void* user, const glev_vertex* vertex) {
                              Vertex v;
                              std::copy_n(vertex->texcoord[0], 4, v.begin());
                              static_cast<std::vector<Vertex>*>(user)->push_back(v);
                            },
                            nullptr};
    glevSetSink(gl_, &sink);
    std::vector<float> points;
    for (int i = 0; i < 4 * kUOrder * kVOrder; ++i) points.push_back(client_point(i));
    glevMap1f(gl_, GLEV_MAP1_TEXTURE_COORD_4, kDomain[0], kDomain[1], 4, kOrder, points.data());
    glevMap2f(gl_, GLEV_MAP2_TEXTURE_COORD_4, kDomain[0], kDomain[1], 4 * kVOrder, kUOrder, kDomain[2],
              kDomain[3], 4, kVOrder, points.data());
    for (const glev_enum cap :
         {GLEV_MAP1_TEXTURE_COORD_4, GLEV_MAP1_VERTEX_3, GLEV_MAP2_TEXTURE_COORD_4, GLEV_MAP2_VERTEX_3})
      glevEnable(gl_, cap);
    glevMapGrid2f(gl_, kSegments, kDomain[0], kDomain[1], 2, kDomain[2], kDomain[3]);
  }
  ~Expected() { glevDestroyContext(gl_); }
  Expected(const Expected&) = delete;
  Expected& operator=(const Expected&) = delete;

  std::vector<Vertex> expected_curve() {
    vertices_.clear();
    glevBegin(gl_, GLEV_POINTS);
    for (int i = 0; i < kArguments; ++i) glevEvalCoord1f(gl_, client_argument(i));
    glevEnd(gl_);
    return vertices_;
  }
  std::vector<Vertex> expected_surface() {
    vertices_.clear();
    glevEvalMesh2(gl_, GLEV_POINT, 0, kSegments, 0, 2);
    return vertices_;
  }

 private:
  glev_context* gl_ = nullptr;
  std::vector<Vertex> vertices_;
};

void expect_ours(Printed printed) {
  Expected expected;
  EXPECT_EQ(printed["curve"], expected.expected_curve());
  EXPECT_EQ(printed["surface"], expected.expected_surface());
  EXPECT_EQ(printed["listed curve"], expected.expected_curve());
  EXPECT_EQ(printed["current"], (std::vector<Vertex>{{0.25f, 0.5f, 0, 1}, {0.5f, 0.75f, 1, 1}}));
  EXPECT_EQ(printed["error"], std::vector<Vertex>{{}});
}

TEST(Dropin, Preloaded) { expect_ours(play(kPreload + CLIENT)); }
TEST(Dropin, CommandsLookedUp) { expect_ours(play(kPreload + CLIENT + " lookup")); }
TEST(Dropin, LinkedInFront) { expect_ours(play(LINKED_CLIENT)); }

// Shows that the test above can fail: without the library, the values are different.
TEST(Dropin, WithoutItTheValuesAreOthers) {
  Expected expected;
  EXPECT_NE(play(CLIENT)["curve"], expected.expected_curve());
}

TEST(Dropin, SaysWhatIsMissing) {
  const Finished finished = run_shell("GLEVALUATOR_GL=./no-such-library.so " + kPreload + CLIENT);
  EXPECT_NE(finished.status, 0);
  EXPECT_NE(finished.output.find("GLEVALUATOR_GL"), std::string::npos) << finished.output;
  EXPECT_NE(finished.output.find("no-such-library"), std::string::npos) << finished.output;
}

// The library does not affect programs that do not draw.
TEST(Dropin, OtherProgramsAreNotDisturbed) {
  const Finished finished = run_shell(kPreload + "cat /dev/null");
  EXPECT_EQ(finished.status, 0);
  EXPECT_EQ(finished.output, "");
}

#ifdef NURBS_CLIENT

// Returns an upper bound of the error of a conforming evaluator (EV-NUM-ACCURACY) for orders n + 1 and m + 1
// (m = 0: a curve), arguments in the domain, and control points of magnitude 1.
double allowed_error(int n, int m) {
  const double eps = 10738.0 / (1 << 30);
  const int k = m > 0 ? n * m + 5 * (n + m) + 4 : 5 * n + 4;
  const double x = k * eps;
  return (1 + x + x * x) * std::pow(1 + 16 * eps, n + m) - 1;
}

bool is_near(const Vertex& a, const Vertex& b, double bound) {
  for (std::size_t k = 0; k < 4; ++k)
    if (!(std::abs(a[k] - b[k]) <= bound)) return false;
  return true;
}

// Compares vertices in blocks of `block` vertices. A quadrilateral may be split along either diagonal.
void expect_same(const std::vector<Vertex>& got, const std::vector<Vertex>& expected, std::size_t block,
                 double bound) {
  ASSERT_GT(got.size(), 0u);
  ASSERT_EQ(got.size(), expected.size());
  ASSERT_EQ(got.size() % block, 0u);
  for (std::size_t i = 0; i < got.size(); ++i) {
    const auto first = static_cast<std::ptrdiff_t>(i - i % block);
    const auto last = first + static_cast<std::ptrdiff_t>(block);
    const auto is_in = [&](const Vertex& v, const std::vector<Vertex>& all) {
      return std::any_of(all.begin() + first, all.begin() + last,
                         [&](const Vertex& other) { return is_near(v, other, bound); });
    };
    ASSERT_TRUE(is_in(got[i], expected)) << i;
    ASSERT_TRUE(is_in(expected[i], got)) << i;
  }
}

std::string read_picture(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  const std::size_t header = std::string("P6\n256 256\n255\n").size();
  return text.str().size() > header ? text.str().substr(header) : "";
}

class Nurbs : public testing::Test {
 protected:
  Printed with_ = play(kPreload + NURBS_CLIENT " " + picture_with());
  Printed without_ = play(std::string(NURBS_CLIENT " ") + picture_without());
  static std::string picture_with() { return testing::TempDir() + "nurbs-with.ppm"; }
  static std::string picture_without() { return testing::TempDir() + "nurbs-without.ppm"; }
};

TEST_F(Nurbs, VerticesAndPictureOfGlu) {
  // Both results may have errors. No control point is larger than 1.
  expect_same(with_["curve"], without_["curve"], 1, 2 * allowed_error(3, 0));
  expect_same(with_["surface"], without_["surface"], 6, 2 * allowed_error(3, 3));
  EXPECT_NE(with_["curve"], without_["curve"]);  // the library was used
  EXPECT_EQ(with_["error"], without_["error"]);

  const std::string with = read_picture(picture_with()), without = read_picture(picture_without());
  ASSERT_EQ(with.size(), 3u * 256 * 256);
  ASSERT_EQ(without.size(), with.size());
  std::size_t drawn = 0, differing = 0;
  int largest = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    const int difference =
        std::abs(static_cast<unsigned char>(with[i]) - static_cast<unsigned char>(without[i]));
    drawn += with[i] != 0;
    differing += difference > 2;
    largest = std::max(largest, difference);
  }
  // Without the library, quadrilaterals are split along the other diagonal, so colours inside differ
  // slightly.
  EXPECT_GT(drawn, with.size() / 4);
  EXPECT_LT(differing, with.size() / 200);
  EXPECT_LE(largest, 16);
}

#endif

}  // namespace
