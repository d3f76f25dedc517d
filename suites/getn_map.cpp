// Section 18 of the requirements: GetnMap, which takes the size of the array (ARB_robustness, GL 4.5).
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "checked_case.h"
#include "dimensions.h"

namespace evalcts::suite_getn_map {
namespace {

// A form of GetnMap, with the GetMap command with which it has to agree. `room`: number of elements of the
// array; `bytes`: the size that is passed to the command.
struct Getter {
  const char* name;
  std::size_t element;
  gl::Ref (*getn)(gl::Case&, GLenum target, GLenum query, GLsizei bytes, std::size_t room);
  gl::Ref (*get)(gl::Case&, GLenum target, GLenum query, std::size_t room);
};
constexpr Getter kGetters[] = {
    {"GetnMapfv", sizeof(GLfloat),
     [](gl::Case& c, GLenum target, GLenum query, GLsizei bytes, std::size_t room) {
       return c.GetnMapfv(target, query, bytes, gl::out<GLfloat>(room));
     },
     evalcts::kGetters[0].get},
    {"GetnMapdv", sizeof(GLdouble),
     [](gl::Case& c, GLenum target, GLenum query, GLsizei bytes, std::size_t room) {
       return c.GetnMapdv(target, query, bytes, gl::out<GLdouble>(room));
     },
     evalcts::kGetters[1].get},
    {"GetnMapiv", sizeof(GLint),
     [](gl::Case& c, GLenum target, GLenum query, GLsizei bytes, std::size_t room) {
       return c.GetnMapiv(target, query, bytes, gl::out<GLint>(room));
     },
     evalcts::kGetters[2].get}};

struct Answer {
  GLenum target;
  GLenum query;
  std::size_t values;
};

// Room for all answers of these tests, and for those of a wrong implementation.
constexpr std::size_t kRoom = 64;

// Returns the queries of all targets of the dimension with their numbers of values, for the maps of
// with_maps().
std::vector<Answer> answers(bool two) {
  std::vector<Answer> all;
  for (const GLenum target : targets(two)) {
    const int points = (two ? 2 * 4 : 3) * gl::components_of(target);
    all.push_back({target, GL_ORDER, two ? 2u : 1u});
    all.push_back({target, GL_DOMAIN, two ? 4u : 2u});
    all.push_back({target, GL_COEFF, static_cast<std::size_t>(points)});
  }
  return all;
}

CheckedCase with_maps(Test& t, bool two, const std::string& identity) {
  t.require(4, 5, "GL_ARB_robustness");
  CheckedCase c(t, identity);
  for (const GLenum target : targets(two)) define(c, random_map(t, target, two ? Orders{2, 4} : Orders{3}));
  return c;
}

GLsizei bytes_of(const Getter& getter, const Answer& answer) {
  return static_cast<GLsizei>(answer.values * getter.element);
}

// Expects the query to raise one of these errors and to write nothing.
void expect_rejected(Test& t, const Getter& getter, const std::string& identity, GLenum target, GLenum query,
                     GLsizei bytes, std::initializer_list<GLenum> errors, bool inside = false) {
  gl::Case c = with_maps(t, kCurves, identity);
  if (inside) c.Begin(GL_POLYGON);
  const gl::Ref get = getter.getn(c, target, query, bytes, kRoom);
  if (inside) c.End();
  expect_query_rejected(t, c, get, errors);
}

std::string named(GLenum target, GLenum query) {
  return gl::token_name(target) + " " + gl::token_name(query);
}

// The same for all two-dimensional targets and queries, with each of the sizes in bytes.
void expect_sizes_rejected2(Test& t, const Getter& getter, const std::string& identity,
                            std::vector<GLsizei> (*sizes)(GLsizei exact, GLsizei element), GLenum error,
                            GLenum other_error) {
  CheckedCase c = with_maps(t, kSurfaces, identity);
  for (const Answer& answer : answers(kSurfaces))
    for (const GLsizei bytes : sizes(bytes_of(getter, answer), static_cast<GLsizei>(getter.element))) {
      const gl::Ref get = getter.getn(c, answer.target, answer.query, bytes, kRoom);
      c.expect_error(error, other_error);
      c.expect([=](CheckedTrace& checked) { checked.expect_nothing_written(get); });
    }
  c.check();
}

EVALCTS_TEST_PAIR(GetnMap.SameAsGetMap, GetnMap.SameAsGetMap2, kMust, "EV-GETN-SAME", combine(kGetters))
(Test& t, bool two, const Getter& getter) {
  CheckedCase c = with_maps(
      t, two, fmt::format("every target and query, room to spare{}", two ? ", two dimensions" : ""));
  for (const Answer& answer : answers(two))
    for (const GLsizei bytes :
         {static_cast<GLsizei>(kRoom * getter.element), std::numeric_limits<GLsizei>::max()}) {
      const gl::Ref get = getter.get(c, answer.target, answer.query, kRoom);
      const gl::Ref getn = getter.getn(c, answer.target, answer.query, bytes, kRoom);
      c.expect([=](CheckedTrace& checked) {
        // Otherwise two queries that write nothing would pass.
        checked.expect(checked.trace().written(get) > 0, get, "the query of the control writes nothing",
                       "an answer", "nothing");
        checked.expect_same(get, getn);
      });
    }
  c.check();
};

EVALCTS_TEST_PAIR(GetnMap.ExactSizeIsEnough, GetnMap.ExactSizeIsEnough2, kMust, "EV-GETN-BYTES",
                  combine(kGetters))
(Test& t, bool two, const Getter& getter) {
  CheckedCase c = with_maps(t, two,
                            fmt::format("every target and query, exactly as many bytes as the answer has{}",
                                        two ? ", two dimensions" : ""));
  for (const Answer& answer : answers(two)) {
    const gl::Ref get = getter.get(c, answer.target, answer.query, answer.values);
    const gl::Ref getn = getter.getn(c, answer.target, answer.query, bytes_of(getter, answer), answer.values);
    c.expect_no_error();
    c.expect_same(get, getn);
  }
  c.check();
};

EVALCTS_TEST(GetnMap, TooSmall, kMust, "EV-GETN-SMALL", combine(kGetters))
(Test& t, const Getter& getter) {
  for (const Answer& answer : answers(kCurves)) {
    const GLsizei exact = bytes_of(getter, answer);
    for (const GLsizei bytes : {exact - 1, exact - static_cast<GLsizei>(getter.element), 0})
      expect_rejected(t, getter,
                      fmt::format("{} {} of {} bytes", named(answer.target, answer.query), bytes, exact),
                      answer.target, answer.query, bytes, {GL_INVALID_OPERATION});
  }
};

EVALCTS_TEST(GetnMap, TooSmall2, kMust, "EV-GETN-SMALL", combine(kGetters))
(Test& t, const Getter& getter) {
  expect_sizes_rejected2(
      t, getter, "one byte, one value, all of them too few, for every target and query",
      [](GLsizei exact, GLsizei element) {
        return std::vector<GLsizei>{exact - 1, exact - element, 0};
      },
      GL_INVALID_OPERATION, GL_INVALID_OPERATION);
};

EVALCTS_TEST(GetnMap, NegativeSize, kMust, "EV-GETN-NEGATIVE", combine(kGetters))
(Test& t, const Getter& getter) {
  for (const Answer& answer : answers(kCurves))
    for (const GLsizei bytes : {-1, -1000})
      expect_rejected(t, getter, fmt::format("{} {} bytes", named(answer.target, answer.query), bytes),
                      answer.target, answer.query, bytes, {GL_INVALID_VALUE, GL_INVALID_OPERATION});
};

EVALCTS_TEST(GetnMap, NegativeSize2, kMust, "EV-GETN-NEGATIVE", combine(kGetters))
(Test& t, const Getter& getter) {
  expect_sizes_rejected2(
      t, getter, "-1 and -1000 bytes, for every target and query",
      [](GLsizei, GLsizei) {
        return std::vector<GLsizei>{-1, -1000};
      },
      GL_INVALID_VALUE, GL_INVALID_OPERATION);
};

EVALCTS_TEST(GetnMap, ErrorsOfGetMap, kMust, "EV-GETN-ERRORS", combine(kGetters))
(Test& t, const Getter& getter) {
  const auto bytes = static_cast<GLsizei>(kRoom * getter.element);
  for (const GLenum target : {0u, 0x0D8Fu, 0x0D99u, 0x10D97u, 0x10DB0u, static_cast<GLenum>(GL_AUTO_NORMAL)})
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN})
      expect_rejected(t, getter, named(target, query), target, query, bytes, {GL_INVALID_ENUM});
  for (const GLenum query : {0u, 0x0A03u, 0x0B01u, static_cast<GLenum>(GL_MAX_EVAL_ORDER)})
    expect_rejected(t, getter, named(GL_MAP1_VERTEX_3, query), GL_MAP1_VERTEX_3, query, bytes,
                    {GL_INVALID_ENUM});
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3, GL_MAP2_COLOR_4})
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN})
      expect_rejected(t, getter, named(target, query) + " between Begin and End", target, query, bytes,
                      {GL_INVALID_OPERATION}, true);
};

}  // namespace
}  // namespace evalcts::suite_getn_map
