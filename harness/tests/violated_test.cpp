// Tests the violated requirements of failing tests, and that tests announce the case that runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include <evalcts/results/test_record.h>
#include <evalcts/testkit/test.h>
#include "altered.h"

namespace evalcts {
namespace {

using Ids = std::vector<RequirementId>;
using Body = std::function<void(evalcts::Test&)>;

// Returns the record of a test of these requirements on production with some entry points replaced.
TestRecord record_of(void (*alter)(gl::Table&), const Ids& requirements, const Body& body,
                     bool is_warm = false) {
  Altered altered(alter);
  CapturedSubject subject(altered);
  subject.is_warm = is_warm;
  TestRecord record;
  record.name = "Violated.Sample";
  record.requirements = requirements;
  evalcts::Test test(subject, record);
  test.run(body);
  return record;
}

// Returns a case with a map of positions and without a map of colours.
gl::Case curve() {
  gl::Case c("curve");
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<float>{0, 0, 0, 1, 2, 3});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.End();
  return c;
}

void evaluation_that_sets_the_color(gl::Table& table) {
  table.EvalCoord1f = [](GLfloat u) {
    Altered::original.Color4f(0.25f, 0.25f, 0.25f, 1);
    Altered::original.EvalCoord1f(u);
  };
}

void evaluation_elsewhere(gl::Table& table) {
  table.EvalCoord1f = [](GLfloat u) { Altered::original.EvalCoord1f(u + 0.25f); };
}

// Evaluates at another argument between NewList of this mode and EndList.
template <GLenum kMode>
void wrong_in_lists(gl::Table& table) {
  static bool is_open = false;
  is_open = false;
  table.NewList = [](GLuint list, GLenum mode) {
    is_open = mode == kMode;
    Altered::original.NewList(list, mode);
  };
  table.EndList = [] {
    is_open = false;
    Altered::original.EndList();
  };
  table.EvalCoord1f = [](GLfloat u) { Altered::original.EvalCoord1f(is_open ? u + 0.25f : u); };
}

TEST(Violated, AllRequirementsOfATestThatDoesNotTellThemApart) {
  const TestRecord record = record_of(evaluation_that_sets_the_color, {"EV-A", "EV-B"}, [](evalcts::Test& t) {
    t.judge_vertices(curve(), kPosition | kColor);
  });
  EXPECT_EQ(record.verdict, Verdict::kFail) << record.message;
  EXPECT_EQ(record.blamed(), (Ids{"EV-A", "EV-B"}));
  EXPECT_EQ(record.hidden(), Ids{});
}

TEST(Violated, CurrentValuesHaveARuleOfTheirOwn) {
  const Body body = [](evalcts::Test& t) { t.judge_vertices(curve(), kPosition | kColor); };
  TestRecord record = record_of(evaluation_that_sets_the_color, {"EV-PREC-TEX"}, body);
  EXPECT_EQ(record.blamed(), Ids{"EV-COORD-CURRENT"});
  EXPECT_EQ(record.hidden(), Ids{"EV-PREC-TEX"});
  record = record_of(evaluation_that_sets_the_color, {"EV-PREC-TEX", "EV-A"}, body);
  EXPECT_EQ(record.blamed(), Ids{"EV-A"});
  // Values that a map supplies are the subject of the test.
  record = record_of(evaluation_elsewhere, {"EV-PREC-TEX"}, body);
  EXPECT_EQ(record.blamed(), Ids{"EV-PREC-TEX"});
}

// A patch in the plane y = z with AUTO_NORMAL; with weights, one w is 2.
gl::Case patch(bool with_weights) {
  const GLfloat w = with_weights ? 2.0f : 1.0f;
  gl::Case c("patch");
  c.Map2f(GL_MAP2_VERTEX_4, 0, 1, 8, 2, 0, 1, 4, 2,
          std::vector<float>{0, 0, 0, 1, 0, 1, 1, 1, 1, 0, 0, 1, w, w, w, w});
  c.Enable(GL_MAP2_VERTEX_4);
  c.Enable(GL_AUTO_NORMAL);
  c.Begin(GL_POINTS);
  c.EvalCoord2f(0.5f, 0.5f);
  c.End();
  return c;
}

// A test of what AUTO_NORMAL must not do judges normals as well, but their values have other requirements.
TEST(Violated, AutomaticNormalsHaveRulesOfTheirOwn) {
  const auto no_automatic_normals = [](gl::Table& table) {
    table.Enable = [](GLenum cap) {
      if (cap != GL_AUTO_NORMAL) Altered::original.Enable(cap);
    };
  };
  for (const auto& [with_weights, owner] :
       {std::pair{false, "EV-AUTON-CURVED"}, std::pair{true, "EV-AUTON-RATIONAL"}}) {
    const Body body = [with_weights = with_weights](evalcts::Test& t) {
      t.judge_vertices(patch(with_weights), kPosition);
    };
    const TestRecord record = record_of(no_automatic_normals, {"EV-AUTON-DEGENERATE"}, body);
    EXPECT_EQ(record.verdict, Verdict::kFail) << record.message;
    EXPECT_EQ(record.blamed(), Ids{owner});
    EXPECT_EQ(record.hidden(), Ids{"EV-AUTON-DEGENERATE"});
    EXPECT_EQ(record_of(no_automatic_normals, {"EV-AUTON-UNIT"}, body).blamed(), Ids{"EV-AUTON-UNIT"});
  }
}

TEST(Violated, ExpectationsDecideRequirements) {
  const TestRecord record = record_of(
      [](gl::Table& table) {
        table.IsEnabled = [](GLenum cap) -> GLboolean {
          return cap == GL_MAP1_INDEX || Altered::original.IsEnabled(cap);
        };
      },
      {"EV-A", "EV-B"},
      [](evalcts::Test& t) {
        gl::Case c("enables");
        const gl::Ref index = c.IsEnabled(GL_MAP1_INDEX), normal = c.IsEnabled(GL_MAP1_NORMAL);
        CheckedTrace checked = t.play(c);
        t.decide({"EV-A"});
        checked.expect_result(index, 0);
        t.decide({"EV-B"});
        checked.expect_result(normal, 0);
      });
  EXPECT_EQ(record.blamed(), Ids{"EV-A"});
  EXPECT_EQ(record.hidden(), Ids{"EV-B"});
}

// --- Judged by the executable specification -------------------------------------------------------------

gl::Case enables() {
  gl::Case c("enables");
  c.Enable(GL_MAP1_INDEX);
  c.Begin(GL_POINTS);
  c.IsEnabled(GL_MAP1_INDEX);
  c.End();
  c.GetError();
  c.IsEnabled(GL_MAP1_INDEX);
  return c;
}

bool between_begin_and_end = false;
// IsEnabled of the evaluators' state, or of all state, is no error between Begin and End.
template <bool kAllState>
void lenient_queries(gl::Table& table) {
  between_begin_and_end = false;
  table.Begin = [](GLenum mode) {
    between_begin_and_end = true;
    Altered::original.Begin(mode);
  };
  table.End = [] {
    between_begin_and_end = false;
    Altered::original.End();
  };
  table.IsEnabled = [](GLenum cap) -> GLboolean {
    if (between_begin_and_end && (kAllState || cap == GL_MAP1_INDEX)) return GL_FALSE;
    return Altered::original.IsEnabled(cap);
  };
}

TEST(Judged, AnswersAndErrorsOfTheSpecificationAreDue) {
  const Body body = [](evalcts::Test& t) { t.judge(enables()); };
  EXPECT_EQ(record_of([](gl::Table&) {}, {"EV-A"}, body).verdict, Verdict::kPass);
  const TestRecord answer = record_of(
      [](gl::Table& table) {
        table.IsEnabled = [](GLenum cap) -> GLboolean {
          Altered::original.IsEnabled(cap);
          return GL_FALSE;
        };
      },
      {"EV-A"}, body);
  EXPECT_EQ(answer.verdict, Verdict::kFail) << answer.message;
  const TestRecord error = record_of(lenient_queries<false>, {"EV-A"}, body);
  EXPECT_EQ(error.verdict, Verdict::kFail) << error.message;
  EXPECT_TRUE(error.message.starts_with("missing error")) << error.message;
}

TEST(Judged, FailuresViolateWhatTheTestHasDecided) {
  const Body body = [](evalcts::Test& t) {
    t.decide({"EV-A"});
    t.judge(enables());
  };
  const TestRecord record = record_of(lenient_queries<false>, {"EV-A", "EV-B"}, body);
  EXPECT_EQ(record.blamed(), Ids{"EV-A"}) << record.message;
}

TEST(Judged, ErrorsBetweenBeginAndEndAreDueOnlyIfOtherQueriesRaiseThem) {
  const TestRecord record =
      record_of(lenient_queries<true>, {"EV-A"}, [](evalcts::Test& t) { t.judge(enables()); });
  EXPECT_EQ(record.verdict, Verdict::kNotObservable) << record.message;
}

// The errors that are missing make a control run. A crash of the library in the rest of the case would be one
// of the case again.
TEST(Judged, TheCaseIsAnnouncedAgainAfterAControl) {
  Altered altered(lenient_queries<false>);
  CapturedSubject subject(altered);
  std::vector<std::string> announced;
  subject.before_case = [&](const gl::Case& script) { announced.push_back(script.identity()); };
  TestRecord record;
  record.name = "Judged.Sample";
  record.requirements = {"EV-A"};
  evalcts::Test test(subject, record);
  test.run([](evalcts::Test& t) { t.judge_answers(enables()); });
  ASSERT_EQ(announced.size(), 3u);
  EXPECT_EQ(announced[0], "enables");
  EXPECT_NE(announced[1], "enables");
  EXPECT_EQ(announced[2], "enables");
}

// A rejected definition between two snapshots, and a query of its orders.
gl::Case rejected(evalcts::Test& t) {
  gl::Case c("rejected");
  const auto snapshot = [&] { t.compare_only({c.IsEnabled(GL_MAP1_INDEX)}); };
  snapshot();
  c.Map1f(GL_MAP1_INDEX, 0, 1, 1, 0, std::vector<float>{1});
  c.GetError();
  snapshot();
  return c;
}
const Body kRejected = [](evalcts::Test& t) { t.judge_answers(rejected(t)); };

// Map1 enables the map, also if it is rejected.
void enabling_maps(gl::Table& table) {
  table.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    Altered::original.Map1f(target, u1, u2, stride, order, points);
    Altered::original.Enable(target);
  };
}
void silent_errors(gl::Table& table) {
  table.GetError = []() -> GLenum {
    Altered::original.GetError();
    return GL_NO_ERROR;
  };
}
// Answers the wrong value, always the same.
void wrong_enables(gl::Table& table) {
  table.IsEnabled = [](GLenum cap) -> GLboolean {
    Altered::original.IsEnabled(cap);
    return GL_TRUE;
  };
}

TEST(Blame, EffectsOfRejectedCommandsAndErrorsHaveTheirRequirements) {
  const Ids both = {"EV-A-ERR-ORDER", "EV-A-ERR-NOEFFECT"};
  EXPECT_EQ(record_of([](gl::Table&) {}, both, kRejected).verdict, Verdict::kPass);
  EXPECT_EQ(record_of(enabling_maps, both, kRejected).blamed(), Ids{"EV-A-ERR-NOEFFECT"});
  EXPECT_EQ(record_of(silent_errors, both, kRejected).blamed(), Ids{"EV-A-ERR-ORDER"});
}

TEST(Blame, EffectsOfCommandsThatAreNotRejectedAreNoWonder) {
  const auto alter = [](gl::Table& table) {
    enabling_maps(table);
    silent_errors(table);
  };
  EXPECT_EQ(record_of(alter, {"EV-A-ERR-ORDER", "EV-A-ERR-NOEFFECT"}, kRejected).blamed(),
            Ids{"EV-A-ERR-ORDER"});
}

TEST(Blame, SnapshotsAreComparedOnly) {
  EXPECT_EQ(record_of(wrong_enables, {"EV-A"}, kRejected).verdict, Verdict::kPass);
  const Body judged = [](evalcts::Test& t) {
    gl::Case c("asked");
    c.IsEnabled(GL_MAP1_INDEX);
    t.judge(c);
  };
  EXPECT_EQ(record_of(wrong_enables, {"EV-A"}, judged).verdict, Verdict::kFail);
}

// Queries of colours as integers, which may be rounded or mapped to the whole range.
template <GLint kAnswer>
void answers_of_colors(gl::Table& table) {
  table.GetMapiv = [](GLenum, GLenum, GLint* values) { std::fill(values, values + 4, kAnswer); };
}

TEST(Judged, EveryPermittedAnswerIsAccepted) {
  const Body body = [](evalcts::Test& t) {
    gl::Case c("initial colour");
    c.GetMapiv(GL_MAP1_COLOR_4, GL_COEFF, gl::out<GLint>(4));
    t.judge(c);
  };
  EXPECT_EQ(record_of(answers_of_colors<1>, {"EV-A"}, body).verdict, Verdict::kPass);
  EXPECT_EQ(record_of(answers_of_colors<2147483647>, {"EV-A"}, body).verdict, Verdict::kPass);
  const TestRecord wrong = record_of(answers_of_colors<2>, {"EV-A"}, body);
  EXPECT_EQ(wrong.verdict, Verdict::kFail);
  EXPECT_TRUE(wrong.message.ends_with("answers {2, 2, 2, 2}, expected {1, 1, 1, 1}")) << wrong.message;
}

// --- Display lists ---------------------------------------------------------------------------------------

// If a test goes through display lists, the requirement of the form of lists follows its own requirements.
TEST(Violated, ListsAreBlamedOnlyIfTheirCommandsAreRightWithoutOne) {
  const auto in_lists = [](gl::Lists lists, void (*alter)(gl::Table&), const char* of_list) {
    return record_of(alter, {"EV-A", of_list}, [lists](evalcts::Test& t) {
      gl::Delivery delivery;
      delivery.lists = lists;
      t.deliver_by(delivery);
      t.judge_vertices(curve(), kPosition);
    });
  };
  EXPECT_EQ(in_lists(gl::Lists::kCompiled, evaluation_elsewhere, "EV-DL-EXECUTE").blamed(), Ids{"EV-A"});
  EXPECT_EQ(in_lists(gl::Lists::kSplit, evaluation_elsewhere, "EV-DL-SPLIT").blamed(), Ids{"EV-A"});
  EXPECT_EQ(in_lists(gl::Lists::kCompiled, wrong_in_lists<GL_COMPILE>, "EV-DL-EXECUTE").blamed(),
            Ids{"EV-DL-EXECUTE"});
  // A mistake in the simplest kind of list does not violate the requirements of the other kinds.
  EXPECT_EQ(in_lists(gl::Lists::kNested, wrong_in_lists<GL_COMPILE>, "EV-DL-NESTED").blamed(),
            Ids{"EV-DL-EXECUTE"});
  EXPECT_EQ(in_lists(gl::Lists::kExecuted, wrong_in_lists<GL_COMPILE_AND_EXECUTE>, "EV-DL-COMPEXEC").blamed(),
            Ids{"EV-DL-COMPEXEC"});
}

// --- Missing commands ------------------------------------------------------------------------------------

void without_doubles(gl::Table& table) { table.Map1d = nullptr; }
void without_grid_queries(gl::Table& table) {
  static GLenum error = GL_NO_ERROR;
  table.GetFloatv = [](GLenum name, GLfloat* values) {
    if (name == GL_MAP1_GRID_DOMAIN)
      error = GL_INVALID_ENUM;
    else
      Altered::original.GetFloatv(name, values);
  };
  table.GetError = [] {
    const GLenum own = std::exchange(error, static_cast<GLenum>(GL_NO_ERROR));
    return own == GL_NO_ERROR ? Altered::original.GetError() : own;
  };
}

// A failure ends a test in a warm context by an exception. Tests that catch such exceptions must not pass.
TEST(WarmContexts, DoNotPassATestThatCatchesItsFailure) {
  const Body body = [](evalcts::Test& t) {
    try {
      t.judge_vertices(curve(), kPosition);
    } catch (const NotObservable&) {
    }
  };
  EXPECT_EQ(record_of(evaluation_elsewhere, {"EV-A"}, body, true).verdict, Verdict::kNotObservable);
  EXPECT_EQ(record_of([](gl::Table&) {}, {"EV-A"}, body, true).verdict, Verdict::kPass);
}

TEST(MissingCommands, TestThatDoesWithoutOnePassesInPart) {
  const Body body = [](evalcts::Test& t) {
    EXPECT_TRUE(t.can_call(gl::EntryPoint::Map1f));
    EXPECT_FALSE(t.can_call(gl::EntryPoint::Map1d));
    EXPECT_FALSE(t.can_call(gl::EntryPoint::Map1d));
    t.judge_vertices(curve(), kPosition);
  };
  const TestRecord record = record_of(without_doubles, {"EV-A"}, body);
  EXPECT_EQ(record.verdict, Verdict::kPass) << record.message;
  EXPECT_EQ(record.unobserved, "glMap1d (missing)");
}

TEST(MissingCommands, TestThatDoesNotNeedThemPassesInFull) {
  const TestRecord record = record_of(without_doubles, {"EV-A"}, [](evalcts::Test& t) {
    EXPECT_TRUE(t.can_call(gl::EntryPoint::Map1f));
    t.judge_vertices(curve(), kPosition);
  });
  EXPECT_EQ(record.verdict, Verdict::kPass) << record.message;
  EXPECT_EQ(record.unobserved, "");
}

TEST(MissingCommands, TestOfNothingElseIsNotObservable) {
  const TestRecord record = record_of(without_doubles, {"EV-A"}, [](evalcts::Test& t) {
    if (t.can_call(gl::EntryPoint::Map1d)) t.judge_vertices(curve(), kPosition);
  });
  EXPECT_EQ(record.verdict, Verdict::kNotObservable);
  EXPECT_EQ(record.message, "glMap1d (missing)");
}

TEST(MissingCommands, FailureInTheRestIsAFailure) {
  const auto alter = [](gl::Table& table) {
    without_doubles(table);
    evaluation_elsewhere(table);
  };
  const TestRecord record = record_of(alter, {"EV-A"}, [](evalcts::Test& t) {
    EXPECT_FALSE(t.can_call(gl::EntryPoint::Map1d));
    t.judge_vertices(curve(), kPosition);
  });
  EXPECT_EQ(record.verdict, Verdict::kFail);
  EXPECT_EQ(record.unobserved, "glMap1d (missing)");
}

TEST(MissingCommands, RejectedQueriesOfGridsCountAsMissing) {
  const TestRecord record = record_of(without_grid_queries, {"EV-A"}, [](evalcts::Test& t) {
    EXPECT_TRUE(t.can_query_grid(GL_MAP1_GRID_SEGMENTS));
    EXPECT_FALSE(t.can_query_grid(GL_MAP1_GRID_DOMAIN));
    t.judge_vertices(curve(), kPosition);
  });
  EXPECT_EQ(record.verdict, Verdict::kPass) << record.message;
  EXPECT_EQ(record.unobserved, "GL_MAP1_GRID_DOMAIN (the query is rejected)");
}

// A query that only one form of Get answers is missing as well, because tests use several forms.
TEST(MissingCommands, QueriesOfGridsWithoutAnswerCountAsMissing) {
  const auto alter = [](gl::Table& table) {
    table.GetIntegerv = [](GLenum name, GLint* values) {
      if (name != GL_MAP2_GRID_SEGMENTS) Altered::original.GetIntegerv(name, values);
    };
  };
  const TestRecord record = record_of(alter, {"EV-A"}, [](evalcts::Test& t) {
    EXPECT_TRUE(t.can_query_grid(GL_MAP1_GRID_SEGMENTS));
    EXPECT_FALSE(t.can_query_grid(GL_MAP2_GRID_SEGMENTS));
    t.judge_vertices(curve(), kPosition);
  });
  EXPECT_EQ(record.verdict, Verdict::kPass) << record.message;
}

}  // namespace
}  // namespace evalcts
