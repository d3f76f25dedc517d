// Section 18 of the requirements: GetnMap, which takes the size of the array (ARB_robustness, GL 4.5).
#include <limits>
#include <utility>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "maps.h"

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

gl::Case with_maps(Test& t, bool two, const std::string& identity) {
  t.require(4, 5, "GL_ARB_robustness");
  gl::Case c(identity);
  for (const GLenum target : targets(two)) define(c, random_map(t, target, two ? Orders{2, 4} : Orders{3}));
  return c;
}

GLsizei bytes_of(const Getter& getter, const Answer& answer) {
  return static_cast<GLsizei>(answer.values * getter.element);
}

// Judges queries of all targets of the dimension with each of these sizes in bytes.
void judge_sizes(Test& t, bool two, const Getter& getter, const std::string& identity,
                 std::vector<GLsizei> (*sizes)(GLsizei exact, GLsizei element)) {
  gl::Case c = with_maps(t, two, identity);
  for (const Answer& answer : answers(two))
    for (const GLsizei bytes : sizes(bytes_of(getter, answer), static_cast<GLsizei>(getter.element))) {
      getter.getn(c, answer.target, answer.query, bytes, kRoom);
      c.GetError();
      c.GetError();
    }
  t.judge(c);
}

// This test compares two answers, and does not let the specification judge them, because other tests judge
// those of GetMap.
EVALCTS_TEST_PAIR(GetnMap.SameAsGetMap, GetnMap.SameAsGetMap2, kMust, "EV-GETN-SAME", combine(kGetters))
(Test& t, bool two, const Getter& getter) {
  gl::Case c = with_maps(t, two, "every target and query, room to spare");
  std::vector<std::pair<gl::Ref, gl::Ref>> pairs;
  for (const Answer& answer : answers(two))
    for (const GLsizei bytes :
         {static_cast<GLsizei>(kRoom * getter.element), std::numeric_limits<GLsizei>::max()}) {
      const gl::Ref get = getter.get(c, answer.target, answer.query, kRoom);
      pairs.emplace_back(get, getter.getn(c, answer.target, answer.query, bytes, kRoom));
    }
  CheckedTrace checked = t.play(c);
  for (const auto& [get, getn] : pairs) {
    // Otherwise two queries that write nothing would pass.
    checked.expect(checked.trace().written(get) > 0, get, "the query of the control writes nothing",
                   "an answer", "nothing");
    checked.expect_same(get, getn);
  }
};

EVALCTS_TEST_PAIR(GetnMap.ExactSizeIsEnough, GetnMap.ExactSizeIsEnough2, kMust, "EV-GETN-BYTES",
                  combine(kGetters))
(Test& t, bool two, const Getter& getter) {
  gl::Case c = with_maps(t, two, "every target and query, exactly as many bytes as the answer has");
  for (const Answer& answer : answers(two)) {
    getter.getn(c, answer.target, answer.query, bytes_of(getter, answer), answer.values);
    c.GetError();
  }
  t.judge(c);
};

EVALCTS_TEST_PAIR(GetnMap.TooSmall, GetnMap.TooSmall2, kMust, "EV-GETN-SMALL", combine(kGetters))
(Test& t, bool two, const Getter& getter) {
  judge_sizes(t, two, getter, "one byte, one value, all of them too few, for every target and query",
              [](GLsizei exact, GLsizei element) {
                return std::vector<GLsizei>{exact - 1, exact - element, 0};
              });
};

EVALCTS_TEST_PAIR(GetnMap.NegativeSize, GetnMap.NegativeSize2, kMust, "EV-GETN-NEGATIVE", combine(kGetters))
(Test& t, bool two, const Getter& getter) {
  judge_sizes(t, two, getter, "-1 and -1000 bytes, for every target and query", [](GLsizei, GLsizei) {
    return std::vector<GLsizei>{-1, -1000};
  });
};

EVALCTS_TEST(GetnMap, ErrorsOfGetMap, kMust, "EV-GETN-ERRORS", combine(kGetters))
(Test& t, const Getter& getter) {
  const auto bytes = static_cast<GLsizei>(kRoom * getter.element);
  gl::Case c = with_maps(t, kCurves, "invalid targets, invalid queries, between Begin and End");
  const auto query = [&](GLenum target, GLenum name) {
    getter.getn(c, target, name, bytes, kRoom);
    c.GetError();
    c.GetError();
  };
  for (const GLenum target : {0u, 0x0D8Fu, 0x0D99u, 0x10D97u, 0x10DB0u, static_cast<GLenum>(GL_AUTO_NORMAL)})
    for (const GLenum name : {GL_COEFF, GL_ORDER, GL_DOMAIN}) query(target, name);
  for (const GLenum name : {0u, 0x0A03u, 0x0B01u, static_cast<GLenum>(GL_MAX_EVAL_ORDER)})
    query(GL_MAP1_VERTEX_3, name);
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3, GL_MAP2_COLOR_4})
    for (const GLenum name : {GL_COEFF, GL_ORDER, GL_DOMAIN}) {
      c.Begin(GL_POLYGON);
      getter.getn(c, target, name, bytes, kRoom);
      c.End();
      c.GetError();
      c.GetError();
    }
  t.judge(c);
};

}  // namespace
}  // namespace evalcts::suite_getn_map
