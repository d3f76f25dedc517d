// Section 25 of the requirements: the requests that indirect GLX sends for evaluator commands, and the
// replies.
#include <fmt/format.h>

#include <stdexcept>

#include <evalcts/testkit/registration.h>

#include "glx_requests.h"
#include "rejection.h"

namespace evalcts::suite_glx_protocol {
namespace {

constexpr std::size_t kRoom = 1 << 16;  // bytes; enough for the requests of small commands

// Returns the evaluator commands among the recorded requests; if these are malformed, none, and the test
// fails.
std::vector<SentCommand> sent_commands(CheckedTrace& checked, gl::Ref recorded, std::size_t room = kRoom) {
  const auto size = static_cast<std::size_t>(checked.trace().result(recorded));
  if (size > room) throw std::logic_error("the requests do not fit");
  Bytes requests = checked.trace().values<GLubyte>(recorded);
  requests.resize(size);
  try {
    return evaluator_commands(requests);
  } catch (const std::runtime_error& malformed) {
    checked.expect(false, recorded, "malformed requests", "whole requests", malformed.what());
    return {};
  }
}

gl::Ref recorded_requests(gl::Case& c, std::size_t room = kRoom) {
  return c.RecordedRequestsEVALCTS(static_cast<GLsizei>(room), gl::out<GLubyte>(room));
}

// Runs the calls and expects them to send exactly these evaluator commands.
void expect_sent(Test& t, const std::string& identity, const Calls& issue,
                 const std::vector<SentCommand>& expected, std::size_t room = kRoom) {
  gl::Case c(identity);
  c.RecordRequestsEVALCTS();
  issue(c);
  const gl::Ref error = c.GetError();
  const gl::Ref recorded = recorded_requests(c, room);
  CheckedTrace checked = t.play(c);
  checked.expect_no_error(error);
  const std::vector<SentCommand> sent = sent_commands(checked, recorded, room);
  checked.expect(sent == expected, recorded, "wrong requests", in_words(expected), in_words(sent));
}

struct Command {
  const char* name;
  Calls issue;
  unsigned opcode;
  Bytes parameters;
};

void expect_sent(Test& t, const Command& command, bool rendering = true) {
  expect_sent(t, command.name, command.issue, {{command.opcode, rendering, false, command.parameters}});
}

constexpr double kU = -0.375, kV = 1.25;  // exact in single precision

const std::vector<float> kUf = {static_cast<float>(kU)},
                         kUVf = {static_cast<float>(kU), static_cast<float>(kV)};
const std::vector<double> kUd = {kU}, kUVd = {kU, kV};

// The commands that may be sent, with small arguments. No vertex map is enabled, so they draw nothing.
const std::vector<Command>& commands() {
  static const std::vector<Command> kAll = [] {
    const Wire u1 = Wire().float64(kU), u1f = Wire().float32(kUf[0]);
    std::vector<Command> c;
    const auto map1 = make_map1(GL_MAP1_TEXTURE_COORD_2, 0.5, 2, 2, {0.25, -0.75});
    const Map map2 = make_map2(GL_MAP2_TEXTURE_COORD_2, 1, 1, {0.25, -0.75});
    c.push_back(
        {"Map1d", [=](gl::Case& s) { define(s, map1, true); }, 143,
         Wire().reals({0.5, 2}, true).card32(map1.target).int32(1).reals({0.25, -0.75}, true).bytes()});
    c.push_back(
        {"Map1f", [=](gl::Case& s) { define(s, map1, false); }, 144,
         Wire().card32(map1.target).reals({0.5, 2}, false).int32(1).reals({0.25, -0.75}, false).bytes()});
    c.push_back({"Map2d", [=](gl::Case& s) { define(s, map2, true); }, 145,
                 Wire()
                     .reals({0, 1, 0, 1}, true)
                     .card32(map2.target)
                     .int32(1)
                     .int32(1)
                     .reals({0.25, -0.75}, true)
                     .bytes()});
    c.push_back({"Map2f", [=](gl::Case& s) { define(s, map2, false); }, 146,
                 Wire()
                     .card32(map2.target)
                     .reals({0, 1}, false)
                     .int32(1)
                     .reals({0, 1}, false)
                     .int32(1)
                     .reals({0.25, -0.75}, false)
                     .bytes()});
    c.push_back({"MapGrid1d", [](gl::Case& s) { s.MapGrid1d(7, 0.5, -3.0); }, 147,
                 Wire().reals({0.5, -3}, true).int32(7).bytes()});
    c.push_back({"MapGrid1f", [](gl::Case& s) { s.MapGrid1f(7, 0.5f, -3.0f); }, 148,
                 Wire().int32(7).reals({0.5, -3}, false).bytes()});
    c.push_back({"MapGrid2d", [](gl::Case& s) { s.MapGrid2d(7, 0.5, -3.0, 9, 2.0, 4.0); }, 149,
                 Wire().reals({0.5, -3, 2, 4}, true).int32(7).int32(9).bytes()});
    c.push_back({"MapGrid2f", [](gl::Case& s) { s.MapGrid2f(7, 0.5f, -3.0f, 9, 2.0f, 4.0f); }, 150,
                 Wire().int32(7).reals({0.5, -3}, false).int32(9).reals({2, 4}, false).bytes()});
    c.push_back(
        {"EvalCoord1dv", [](gl::Case& s) { s.EvalCoord1dv(kUd); }, 151, Wire().reals(kUd, true).bytes()});
    c.push_back(
        {"EvalCoord1fv", [](gl::Case& s) { s.EvalCoord1fv(kUf); }, 152, Wire().reals(kUd, false).bytes()});
    c.push_back(
        {"EvalCoord2dv", [](gl::Case& s) { s.EvalCoord2dv(kUVd); }, 153, Wire().reals(kUVd, true).bytes()});
    c.push_back(
        {"EvalCoord2fv", [](gl::Case& s) { s.EvalCoord2fv(kUVf); }, 154, Wire().reals(kUVd, false).bytes()});
    c.push_back({"EvalMesh1", [](gl::Case& s) { s.EvalMesh1(GL_LINE, -1, 2); }, 155,
                 Wire().card32(GL_LINE).int32(-1).int32(2).bytes()});
    c.push_back({"EvalPoint1", [](gl::Case& s) { s.EvalPoint1(-5); }, 156, Wire().int32(-5).bytes()});
    c.push_back({"EvalMesh2", [](gl::Case& s) { s.EvalMesh2(GL_POINT, -1, 2, 3, 5); }, 157,
                 Wire().card32(GL_POINT).int32(-1).int32(2).int32(3).int32(5).bytes()});
    c.push_back(
        {"EvalPoint2", [](gl::Case& s) { s.EvalPoint2(-5, 8); }, 158, Wire().int32(-5).int32(8).bytes()});
    return c;
  }();
  return kAll;
}

const std::vector<Command>& grids() {
  static const std::vector<Command> kAll(commands().begin() + 4, commands().begin() + 8);
  return kAll;
}

// Scalar forms, which are sent as the vector forms.
const std::vector<Command>& scalar_forms() {
  static const std::vector<Command> kAll = {
      {"EvalCoord1d", [](gl::Case& s) { s.EvalCoord1d(kU); }, 151, Wire().reals(kUd, true).bytes()},
      {"EvalCoord1f", [](gl::Case& s) { s.EvalCoord1f(kUf[0]); }, 152, Wire().reals(kUd, false).bytes()},
      {"EvalCoord2d", [](gl::Case& s) { s.EvalCoord2d(kU, kV); }, 153, Wire().reals(kUVd, true).bytes()},
      {"EvalCoord2f", [](gl::Case& s) { s.EvalCoord2f(kUVf[0], kUVf[1]); }, 154,
       Wire().reals(kUVd, false).bytes()}};
  return kAll;
}

const std::vector<Command>& queries() {
  const auto asks = [](GLenum target, GLenum query) { return Wire().card32(target).card32(query).bytes(); };
  static const std::vector<Command> kAll = {
      {"GetMapdv", [](gl::Case& s) { s.GetMapdv(GL_MAP1_COLOR_4, GL_COEFF, gl::out<GLdouble>(4)); }, 120,
       asks(GL_MAP1_COLOR_4, GL_COEFF)},
      {"GetMapfv", [](gl::Case& s) { s.GetMapfv(GL_MAP2_VERTEX_3, GL_DOMAIN, gl::out<GLfloat>(4)); }, 121,
       asks(GL_MAP2_VERTEX_3, GL_DOMAIN)},
      {"GetMapiv", [](gl::Case& s) { s.GetMapiv(GL_MAP1_NORMAL, GL_ORDER, gl::out<GLint>(1)); }, 122,
       asks(GL_MAP1_NORMAL, GL_ORDER)}};
  return kAll;
}

SentCommand sent_map(const Map& map, bool doubles) {
  Wire wire;
  if (doubles) {
    wire.reals(map.domain(), true).card32(map.target).int32(map.uorder);
  } else {
    wire.card32(map.target).reals({map.u1, map.u2}, false).int32(map.uorder);
    if (map.two) wire.reals({map.v1, map.v2}, false);
  }
  if (map.two) wire.int32(map.vorder);
  const unsigned opcode = (map.two ? 145 : 143) + (doubles ? 0 : 1);
  return {opcode, true, false, wire.reals(map.coefficients(), doubles).bytes()};
}

EVALCTS_TEST(GlxProtocol, Opcodes, kMust, "EV-GLX-OPCODES", combine(commands()))
(Test& t, const Command& command) { expect_sent(t, command); };

EVALCTS_TEST(GlxProtocol, ScalarForms, kMust, "EV-GLX-SCALAR", combine(scalar_forms()))
(Test& t, const Command& command) { expect_sent(t, command); };

EVALCTS_TEST(GlxProtocol, Grids, kMust, "EV-GLX-MAPGRID", combine(grids()))
(Test& t, const Command& command) { expect_sent(t, command); };

EVALCTS_TEST(GlxProtocol, Queries, kMust, "EV-GLX-SINGLES", combine(queries()))
(Test& t, const Command& command) { expect_sent(t, command, false); };

EVALCTS_TEST(GlxProtocol, PointsOfMap1, kMust, "EV-GLX-MAP1-PACK", combine(gl::kMap1Targets))
(Test& t, GLenum target) {
  for (const Form& form : existing_forms(t, {kCurves}))
    for (const int padding : {0, 3}) {
      const Map map = over(random_map(t, target, 4, gl::components_of(target) + padding), {5, -2.25});
      expect_sent(t, fmt::format("Map1{}, stride k+{}", form.name, padding),
                  [&](gl::Case& c) { define(c, map, form.doubles); }, {sent_map(map, form.doubles)});
    }
};

EVALCTS_TEST(GlxProtocol, PointsOfMap2, kMust, "EV-GLX-MAP2-PACK", combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  for (const Form& form : existing_forms(t, {kSurfaces}))
    for (const Layout& layout : kLayouts)
      for (const Orders& orders : {Orders{2, 3}, {3, 2}, {4, 1}}) {
        const Map map = over(random_map(t, target, orders, layout), {5, -2.25}, {-1, 0.5});
        expect_sent(t, fmt::format("Map2{}, {}x{}, {}", form.name, orders.u, orders.v, layout.name),
                    [&](gl::Case& c) { define(c, map, form.doubles); }, {sent_map(map, form.doubles)});
      }
};

// Maps that may be too large for one request arrive as the same command.
EVALCTS_TEST(GlxProtocol, LargeMaps, kMust, "EV-GLX-LARGE")
(Test& t) {
  const int most = t.max_order();
  for (const Form& form : existing_forms(t))
    for (const int padding : {0, 1}) {  // clients may send points without padding directly from the array
      const auto room = kRoom + static_cast<std::size_t>(most * most) * 4 * sizeof(double) * 2;
      const Map curve = random_map(t, GL_MAP1_VERTEX_4, most, 4 + padding);
      const Map surface = random_map(t, GL_MAP2_VERTEX_4, {most, most}, (4 + padding) * most, 4 + padding);
      expect_sent(
          t, fmt::format("Map1{}, Map{} of order {}, stride k+{}", form.name, form.name, most, padding),
          [&](gl::Case& c) {
            define(c, curve, form.doubles);
            define(c, surface, form.doubles);
            c.MapGrid1f(7, 0.5f, -3.0f);
          },
          {sent_map(curve, form.doubles),
           sent_map(surface, form.doubles),
           {148, true, false, grids()[1].parameters}},
          room);
    }
};

// Returns a definition of a bad map, which the protocol calls erroneous, by the command with which the name
// begins.
NamedCalls bad_map(const char* name, GLenum target, int ustride, int uorder, int vstride = 1,
                   int vorder = 1) {
  const bool two = name[3] == '2', doubles = name[4] == 'd';
  const std::vector<double> points(64);
  return {name, defining({target, 0, 1, 0, 1, ustride, vstride, uorder, vorder, points, two}, doubles)};
}

const std::vector<NamedCalls>& erroneous_maps() {
  static const std::vector<NamedCalls> kAll = {
      bad_map("Map1f/TARGET", GL_MAP2_VERTEX_3, 3, 2),
      bad_map("Map1d/TARGET", GL_VERTEX_ARRAY, 3, 2),
      bad_map("Map2f/TARGET", GL_MAP1_VERTEX_3, 3, 2, 6, 2),
      bad_map("Map2d/TARGET", GL_VERTEX_ARRAY, 3, 2, 6, 2),
      bad_map("Map1f/ORDER", GL_MAP1_VERTEX_3, 3, 0),
      bad_map("Map1d/ORDER", GL_MAP1_VERTEX_3, 3, -1),
      bad_map("Map2f/UORDER", GL_MAP2_VERTEX_3, 3, 0, 6, 2),
      bad_map("Map2d/VORDER", GL_MAP2_VERTEX_3, 3, 2, 6, -4),
      bad_map("Map1f/NEGATIVE_ORDER", GL_MAP1_VERTEX_3, 3, -2),
      bad_map("Map1d/ORDER_0", GL_MAP1_VERTEX_3, 3, 0),
      bad_map("Map2f/VORDER", GL_MAP2_VERTEX_3, 3, 2, 6, 0),
      bad_map("Map2f/NEGATIVE_UORDER", GL_MAP2_VERTEX_3, 3, -1, 6, 2),
      bad_map("Map2d/UORDER", GL_MAP2_VERTEX_3, 3, -3, 6, 2),
      bad_map("Map2d/BOTH_ORDERS", GL_MAP2_VERTEX_3, 3, -2, 6, -2)};
  return kAll;
}

const std::vector<NamedCalls>& small_strides() {
  static const std::vector<NamedCalls> kAll = {bad_map("Map1f", GL_MAP1_VERTEX_3, 2, 2),
                                               bad_map("Map1d", GL_MAP1_VERTEX_3, 2, 2),
                                               bad_map("Map2f/USTRIDE", GL_MAP2_VERTEX_3, 2, 2, 6, 2),
                                               bad_map("Map2d/VSTRIDE", GL_MAP2_VERTEX_3, 6, 2, 2, 2),
                                               bad_map("Map2f/VSTRIDE", GL_MAP2_VERTEX_3, 6, 2, 2, 2),
                                               bad_map("Map2d/USTRIDE", GL_MAP2_VERTEX_3, 2, 2, 6, 2),
                                               bad_map("Map1f/STRIDE_0", GL_MAP1_COLOR_4, 0, 2),
                                               bad_map("Map1d/ORDER_1", GL_MAP1_VERTEX_4, 3, 1),
                                               bad_map("Map2f/ORDER_1", GL_MAP2_NORMAL, 2, 1, 0, 1),
                                               bad_map("Map1d/NEGATIVE", GL_MAP1_INDEX, -1, 2)};
  return kAll;
}

// Judges the error and that the state does not change.
void judge_erroneous(Test& t, const NamedCalls& bad) {
  judge_rejected(t, bad.name, {[&](gl::Case& c) {
                   c.RecordRequestsEVALCTS();  // available only if rendering is indirect
                   bad.issue(c);
                   recorded_requests(c);
                 }});
}

// Expects an erroneous command that is sent at all to have no points after its other parameters.
void expect_no_points(Test& t, const NamedCalls& bad) {
  gl::Case c(fmt::format("{}: no points are sent", bad.name));
  c.RecordRequestsEVALCTS();
  bad.issue(c);
  c.GetError();
  const gl::Ref recorded = recorded_requests(c);
  CheckedTrace checked = t.play(c);
  const auto small = [](unsigned opcode) -> std::size_t {
    return opcode == 143 ? 24 : opcode == 144 ? 16 : opcode == 145 ? 44 : 28;
  };
  for (const SentCommand& command : sent_commands(checked, recorded))
    checked.expect(command.parameters.size() == small(command.opcode), recorded,
                   "an erroneous command with points",
                   fmt::format("{} bytes, or no command", small(command.opcode)), in_words({command}));
}

EVALCTS_TEST(GlxProtocol, ErroneousMaps, kMust, "EV-GLX-ERRONEOUS", combine(erroneous_maps()))
(Test& t, const NamedCalls& bad) {
  judge_erroneous(t, bad);
  expect_no_points(t, bad);
};

EVALCTS_TEST(GlxProtocol, SmallStrides, kMust, "EV-GLX-STRIDE-CLIENT", combine(small_strides()))
(Test& t, const NamedCalls& bad) { judge_erroneous(t, bad); };

// Begins a case with commands that need indirect rendering.
void begin_indirect(gl::Case& c) {
  c.RecordRequestsEVALCTS();
  c.MapGrid1f(7, 0.5f, -3.0f);
  recorded_requests(c);
}

// Replies of one and of several values. There is a guard after each array.
EVALCTS_TEST(GlxProtocol, Replies, kMust, "EV-GLX-GETMAP-REPLY", combine(kGetters))
(Test& t, const Getter& form) {
  const std::vector<double> points = {3, -5, 2, 7, 11, -13, 1, 4};
  gl::Case c("orders, domains and points");
  begin_indirect(c);
  const Map index = make_map1(GL_MAP1_INDEX, {9});
  const Map surface = make_map2(GL_MAP2_TEXTURE_COORD_2, 2, 2, points);
  for (const Map& map : {index, surface}) {
    define(c, map);
    form.get(c, map.target, GL_ORDER, map.orders().size());
    form.get(c, map.target, GL_COEFF, map.coefficients().size());
    form.get(c, map.target, GL_DOMAIN, map.domain().size());
  }
  t.judge(c);
};

// A query that raises an error does not write to the array, and the next query is answered correctly.
EVALCTS_TEST(GlxProtocol, EmptyReplies, kMust, "EV-GLX-GETMAP-REPLY", combine(kGetters))
(Test& t, const Getter& form) {
  gl::Case c("a bad query, a bad target");
  begin_indirect(c);
  c.GetError();
  form.get(c, GL_MAP1_VERTEX_3, GL_MAP_COLOR, 8);
  c.GetError();
  form.get(c, GL_MAP_COLOR, GL_ORDER, 8);
  c.GetError();
  form.get(c, GL_MAP1_VERTEX_3, GL_ORDER, 1);
  t.judge(c);
};

// Indirect rendering draws the same as direct rendering. All other suites test that as well; this test makes
// sure that rendering is indirect.
EVALCTS_TEST(GlxProtocol, SameResult, kMust, "EV-GLX-SAMERESULT")
(Test& t) {
  expect_sent(t, commands().front());  // available only if rendering is indirect
  for (const bool two : {false, true}) {
    gl::Case c(two ? "a surface" : "a curve");
    for (const GLenum target : kinds_of(two)[0].targets)
      define_and_enable(c, random_map(t, target, two ? Orders{3, 2} : Orders{4}));
    evaluate_all(c, two, {{0, 0.375}, {0.25, 0.375}, {1, 0.375}});
    two ? c.MapGrid2f(4, 0.0f, 1.0f, 2, 1.0f, 0.5f) : c.MapGrid1f(4, 1.0f, 0.25f);
    eval_mesh(c, two, GL_POINT, 1, two ? 2 : 3, 0, 1);
    c.Begin(GL_POINTS);
    for (const GLint i : {0, 3}) eval_point(c, two, i, 1);
    c.End();
    t.judge_vertices(c, kPosition | kColor | kTextureCoordinate0);
  }
};

}  // namespace
}  // namespace evalcts::suite_glx_protocol
