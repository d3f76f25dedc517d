// Writes errors.json: errors of commands, and that rejected commands change nothing.
#include <limits>

#include <evalcts/gl/targets.h>
#include <evalcts/gl/tokens.h>
#include "errors.h"
#include "kinds.h"
#include "sequences.h"

namespace evalcts::vectors {
namespace {

constexpr GLint kLeast = std::numeric_limits<GLint>::min(), kMost = std::numeric_limits<GLint>::max();
constexpr const char* kLimit = "max-order-64";

int k_of(GLenum target) { return gl::components_of(target); }

// The arguments of a map of either dimension. All are legal; a case changes some of them.
struct Arguments {
  GLenum target;
  int k = k_of(target);
  double u1 = 0, u2 = 1, v1 = 0, v2 = 1;
  int ustride = k, uorder = 2, vstride = k, vorder = 2;
  Values points = numbered(64, 100);
};

void issue(gl::Case& c, Type type, bool two, const Arguments& a) {
  if (two)
    map2(c, type, a.target, a.u1, a.u2, a.ustride, a.uorder, a.v1, a.v2, a.vstride, a.vorder, a.points);
  else
    map1(c, type, a.target, a.u1, a.u2, a.ustride, a.uorder, a.points);
}

// before() defines a legal map of 3, or 3 by 2, points; after() queries it.
void before(gl::Case& c, GLenum target) {
  const int k = k_of(target);
  if (reference::is_map2_target(target))
    define(c, Type::kSingle, {target, {3, 2, 5}, {2, -1, 3}, numbered(6 * k)});
  else
    define(c, Type::kSingle, {target, {3, 2, 5}, {}, numbered(3 * k)});
}
void after(gl::Case& c, GLenum target) {
  query_all(c, target, (reference::is_map2_target(target) ? 6 : 3) * k_of(target));
}

constexpr std::span<const GLenum> targets(bool two) {
  return two ? std::span<const GLenum>(gl::kMap2Targets) : std::span<const GLenum>(gl::kMap1Targets);
}

std::string dimension(bool two) { return two ? "2" : "1"; }
std::string rule(bool two, const std::string& name) { return "EV-MAP" + dimension(two) + "-" + name; }

// Adds a theme for each error rule of Map1 or Map2, with every target and with both types in turn.
class MapErrors {
 public:
  MapErrors(Document& document, bool two) : document_(document), two_(two) {}

  void add_all() {
    add_targets();
    add_values();
    if (two_) add_values_of_v();
    add_places();
    add_several();
    add_legal();
  }
  void add_later_themes() {
    if (two_) add_stride_of_one_column();
    add_compiled();
  }

 private:
  std::string named(const std::string& name) const { return "map" + dimension(two_) + "-" + name; }
  Theme theme(const std::string& name, const std::string& meaning, const std::string& requirement) const {
    return Theme(document_, named(name), meaning, {rule(two_, requirement), rule(two_, "ERR-NOEFFECT")});
  }
  // Adds a case whose arguments `change` makes illegal.
  void spoil(Theme& into, GLenum target, const std::function<void(Arguments&)>& change,
             const Names& requirements = {}, const Names& flags = {}) {
    gl::Case c;
    before(c, target);
    Arguments arguments{target};
    change(arguments);
    issue(c, kTypes[turn_++ % 2], two_, arguments);
    after(c, target);
    into.add(sequence(c), requirements, flags);
  }

  void add_targets() {
    Theme target_theme =
        theme("target", "invalid targets for this command, those of the other dimension first", "ERR-TARGET");
    std::vector<GLenum> wrong(targets(!two_).begin(), targets(!two_).end());
    const GLenum first = targets(two_).front(), last = targets(two_).back();
    wrong.insert(wrong.end(), {0, first - 1, last + 1, GL_TEXTURE_2D, GL_AUTO_NORMAL, GL_COEFF});
    for (const GLenum bad : wrong) {
      gl::Case c;
      before(c, last);
      Arguments arguments{bad, 4};
      issue(c, kTypes[turn_++ % 2], two_, arguments);
      after(c, last);
      target_theme.add(sequence(c));
    }
  }

  void add_values() {
    Theme low = theme(two_ ? "uorder-low" : "order-low", "order (or uorder) below 1",
                      two_ ? "ERR-UORDER" : "ERR-ORDER-LOW");
    Theme high = theme(two_ ? "uorder-high" : "order-high", "order (or uorder) above the largest",
                       two_ ? "ERR-UORDER" : "ERR-ORDER-HIGH");
    Theme stride =
        theme(two_ ? "ustride" : "stride", "stride (or ustride) below the number of values of a point",
              two_ ? "ERR-USTRIDE" : "ERR-STRIDE");
    Theme domain = theme(two_ ? "udomain" : "domain", "u1 = u2", two_ ? "ERR-UDOMAIN" : "ERR-DOMAIN");
    for (const GLenum target : targets(two_)) {
      const int k = k_of(target);
      for (const int order : {0, -1, kLeast}) spoil(low, target, [&](Arguments& a) { a.uorder = order; });
      if (k == 1)
        spoil(high, target,
              [&](Arguments& a) {
                a.uorder = 65;
                a.vorder = 1;
                a.points = numbered(65);
              },
              {}, {kLimit});
      for (const int bad : {k - 1, 0, -1}) spoil(stride, target, [&](Arguments& a) { a.ustride = bad; });
      spoil(
          stride, target,
          [&](Arguments& a) {
            a.uorder = 1;
            a.ustride = k - 1;
          },
          two_ ? Names() : Names{"EV-MAP1-ERR-STRIDE-ORDER1"});
      for (const double end : {0.0, 1.0, -2.5})
        spoil(domain, target, [&](Arguments& a) { a.u1 = a.u2 = end; });
    }
    spoil(domain, targets(two_).back(), [](Arguments& a) {
      a.u1 = 0.0;
      a.u2 = -0.0;
    });
  }

  void add_values_of_v() {
    Theme vlow = theme("vorder-low", "vorder below 1", "ERR-VORDER");
    Theme vhigh = theme("vorder-high", "vorder above the largest", "ERR-VORDER");
    Theme vstride = theme("vstride", "vstride below the number of values of a point", "ERR-VSTRIDE");
    Theme vdomain = theme("vdomain", "v1 = v2", "ERR-VDOMAIN");
    for (const GLenum target : targets(two_)) {
      const int k = k_of(target);
      for (const int order : {0, -1}) spoil(vlow, target, [&](Arguments& a) { a.vorder = order; });
      if (k == 1)
        spoil(vhigh, target,
              [&](Arguments& a) {
                a.uorder = 1;
                a.vorder = 65;
                a.points = numbered(65);
              },
              {}, {kLimit});
      for (const int bad : {k - 1, 0, -1}) spoil(vstride, target, [&](Arguments& a) { a.vstride = bad; });
      spoil(vdomain, target, [&](Arguments& a) { a.v1 = a.v2 = 3; });
    }
  }

  // Strides of order 1, with which nothing is read, are errors as well.
  void add_stride_of_one_column() {
    Theme column =
        theme("vstride-order1", "vorder 1, vstride below the number of values of a point", "ERR-VSTRIDE");
    for (const GLenum target : targets(two_))
      for (const int uorder : {1, 2})
        for (const int bad : {k_of(target) - 1, -k_of(target)})
          spoil(column, target, [&](Arguments& a) {
            a.uorder = uorder;
            a.vorder = 1;
            a.vstride = bad;
          });
  }

  // Adds calls between Begin and End, and calls while another texture unit is active.
  void add_places() {
    Theme inside = theme("begin-end", "between Begin and End", "ERR-BEGINEND");
    Theme unit = theme("active-texture", "another texture unit than 0 is active, whatever the target",
                       "ERR-ACTIVETEX");
    for (const GLenum target : targets(two_)) {
      const Type type = kTypes[turn_++ % 2];
      gl::Case c;
      before(c, target);
      c.Begin(GL_POINTS);
      issue(c, type, two_, {target});
      c.End();
      after(c, target);
      inside.add(sequence(c));

      gl::Case d;
      before(d, target);
      d.ActiveTexture(GL_TEXTURE1);
      issue(d, type, two_, {target});
      after(d, target);
      d.ActiveTexture(GL_TEXTURE0);
      issue(d, type, two_, {target});
      query_all(d, target, (two_ ? 4 : 2) * k_of(target));
      unit.add(sequence(d));
    }
  }

  // Adds calls with two errors at a time.
  void add_several() {
    const GLenum last = targets(two_).back();
    Theme several(document_, named("several"), "several errors apply: any one of their codes is required",
                  {"EV-MAP-ERR-ANY", rule(two_, "ERR-NOEFFECT")});
    const std::vector<std::pair<std::string, std::function<void(Arguments&)>>> kReasons = {
        {"ERR-TARGET", [](Arguments& a) { a.target = GL_TEXTURE_2D; }},
        {two_ ? "ERR-UORDER" : "ERR-ORDER-LOW", [](Arguments& a) { a.uorder = 0; }},
        {two_ ? "ERR-USTRIDE" : "ERR-STRIDE", [](Arguments& a) { a.ustride = 0; }},
        {two_ ? "ERR-UDOMAIN" : "ERR-DOMAIN", [](Arguments& a) { a.u1 = a.u2; }},
        {"ERR-ACTIVETEX", {}},
        {"ERR-BEGINEND", {}}};
    for (std::size_t i = 0; i < kReasons.size(); ++i)
      for (std::size_t j = i + 1; j < kReasons.size(); ++j) {
        gl::Case c;
        before(c, last);
        Arguments arguments{last};
        for (const auto& [name, change] : {kReasons[i], kReasons[j]}) {
          if (change) change(arguments);
          if (name == "ERR-ACTIVETEX") c.ActiveTexture(GL_TEXTURE1);
        }
        const bool is_inside = kReasons[j].first == "ERR-BEGINEND";
        if (is_inside) c.Begin(GL_POINTS);
        issue(c, kTypes[turn_++ % 2], two_, arguments);
        if (is_inside) c.End();
        after(c, last);
        several.add(sequence(c), {rule(two_, kReasons[i].first), rule(two_, kReasons[j].first)});
      }
  }

  void add_legal() {
    Theme legal(document_, named("legal"), "unusual, and no error", {"EV-MAP-NOERR-OTHER"});
    const std::function<void(Arguments&)> kUnusual[] = {[](Arguments& a) { a.ustride = 17; },
                                                        [](Arguments& a) { std::swap(a.u1, a.u2); },
                                                        [](Arguments& a) { a.u1 = -1e6; },
                                                        [](Arguments& a) { a.u2 = 0x1p100; },
                                                        [](Arguments& a) { a.points = Values(64, -0.0); },
                                                        [](Arguments& a) { a.points = Values(64, 0x1p-149); },
                                                        [](Arguments& a) { a.points = Values(64, 7); },
                                                        [](Arguments& a) { a.vstride = 9; },
                                                        [](Arguments& a) { std::swap(a.v1, a.v2); }};
    for (std::size_t i = 0; i < (two_ ? 9u : 7u); ++i)
      for (const Type type : kTypes) {
        const GLenum target = targets(two_)[(2 * i + (type == Type::kReal)) % 9];
        gl::Case c;
        Arguments arguments{target};
        kUnusual[i](arguments);
        issue(c, type, two_, arguments);
        query_all(c, target, (two_ ? 4 : 2) * k_of(target));
        legal.add(sequence(c));
      }
  }

  // Adds a display list for each condition. The command after the rejected one has to be executed.
  void add_compiled() {
    Theme compiled = Theme(document_, named("compiled"),
                           "a compiled map with each error: raised by the call of the list, which goes on",
                           {"EV-DL-ERR-ALL", "EV-DL-ERR-LATE", "EV-DL-ERR-CONTINUE"});
    struct Condition {
      const char* rule;
      std::function<void(Arguments&)> spoil;
      Names flags = {};
    };
    std::vector<Condition> conditions = {
        {"ERR-TARGET", [](Arguments& a) { a.target = GL_TEXTURE_2D; }},
        {two_ ? "ERR-UORDER" : "ERR-ORDER-LOW", [](Arguments& a) { a.uorder = 0; }},
        {two_ ? "ERR-USTRIDE" : "ERR-STRIDE", [](Arguments& a) { a.ustride = a.k - 1; }},
        {two_ ? "ERR-USTRIDE" : "ERR-STRIDE", [](Arguments& a) { a.ustride = 0; }},
        {two_ ? "ERR-UDOMAIN" : "ERR-DOMAIN", [](Arguments& a) { a.u1 = a.u2; }},
        {"ERR-ACTIVETEX", {}}};
    if (two_) {
      conditions.push_back({"ERR-VORDER", [](Arguments& a) { a.vorder = 0; }});
      conditions.push_back({"ERR-VSTRIDE", [](Arguments& a) { a.vstride = a.k - 1; }});
      conditions.push_back({"ERR-VDOMAIN", [](Arguments& a) { a.v1 = a.v2; }});
    }
    for (const GLenum mode : {GL_COMPILE, GL_COMPILE_AND_EXECUTE})
      for (const Condition& condition : conditions) {
        const GLenum target = targets(two_)[static_cast<std::size_t>(turn_) % 9];
        gl::Case c;
        before(c, target);
        Arguments arguments{target};
        if (condition.spoil)
          condition.spoil(arguments);
        else
          c.ActiveTexture(GL_TEXTURE1);
        c.NewList(1, mode);
        issue(c, kTypes[turn_++ % 2], two_, arguments);
        c.MapGrid1f(9, 2, 3);
        c.EndList();
        after(c, target);
        c.CallList(1);
        after(c, target);
        c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
        compiled.add(sequence(c), {rule(two_, condition.rule)}, condition.flags);
      }
  }

  Document& document_;
  bool two_;
  int turn_ = 0;
};

// --- Queries

void queries(Document& document) {
  Theme target(document, "getmap-target", "GetMap of an invalid target: nothing is written",
               {"EV-GETMAP-ERR-TARGET", "EV-GETMAP-ERR-NOWRITE"});
  Theme query(document, "getmap-query",
              "GetMap of a query other than COEFF, ORDER and DOMAIN: nothing is written",
              {"EV-GETMAP-ERR-QUERY", "EV-GETMAP-ERR-NOWRITE"});
  Theme inside(document, "getmap-begin-end", "GetMap between Begin and End: nothing is written",
               {"EV-GETMAP-ERR-BEGINEND", "EV-GETMAP-ERR-NOWRITE"});
  const auto ask = [](gl::Case& c, int form, GLenum of, GLenum what) {
    if (form == 0) c.GetMapfv(of, what, gl::out<GLfloat>(8));
    if (form == 1) c.GetMapdv(of, what, gl::out<GLdouble>(8));
    if (form == 2) c.GetMapiv(of, what, gl::out<GLint>(8));
  };
  for (int form = 0; form < 3; ++form) {
    for (const GLenum bad :
         {GLenum{0}, GLenum{GL_TEXTURE_2D}, GLenum{GL_AUTO_NORMAL}, GLenum{GL_MAP1_COLOR_4 - 1},
          GLenum{GL_MAP1_VERTEX_4 + 1}, GLenum{GL_MAP2_VERTEX_4 + 1}}) {
      gl::Case c;
      ask(c, form, bad, GL_COEFF);
      ask(c, form, GL_MAP1_VERTEX_4, GL_COEFF);
      target.add(sequence(c));
    }
    for (const GLenum bad :
         {GLenum{0}, GLenum{0x0A03}, GLenum{GL_MAX_EVAL_ORDER}, GLenum{GL_MAP1_VERTEX_3}}) {
      gl::Case c;
      ask(c, form, GL_MAP2_VERTEX_4, bad);
      ask(c, form, GL_MAP1_INDEX, bad);
      query.add(sequence(c));
    }
    for (const GLenum what : {GL_COEFF, GL_ORDER, GL_DOMAIN}) {
      gl::Case c;
      c.Begin(GL_TRIANGLES);
      ask(c, form, GL_MAP2_COLOR_4, what);
      c.End();
      inside.add(sequence(c));
    }
  }

  document.explain("robustness", "needs GetnMap (ARB_robustness or GL 4.5)");
  const Names flags = {"robustness"};
  Theme small(document, "getnmap-small", "GetnMap with a byte too few, or none: nothing is written",
              {"EV-GETN-SMALL"});
  Theme exact(document, "getnmap-exact", "GetnMap with just enough bytes", {"EV-GETN-BYTES", "EV-GETN-SAME"});
  Theme negative(document, "getnmap-negative", "GetnMap with a negative size: two texts, two codes",
                 {"EV-GETN-NEGATIVE"});
  Theme refused(document, "getnmap-refused", "GetnMap with the errors of GetMap", {"EV-GETN-ERRORS"});
  for (int form = 0; form < 3; ++form) {
    const int bytes = form == 1 ? 8 : 4;
    const auto ask_n = [&](gl::Case& c, GLenum of, GLenum what, int size) {
      if (form == 0) c.GetnMapfv(of, what, size, gl::out<GLfloat>(24));
      if (form == 1) c.GetnMapdv(of, what, size, gl::out<GLdouble>(24));
      if (form == 2) c.GetnMapiv(of, what, size, gl::out<GLint>(24));
    };
    // The specification leaves integer answers for colours and normals open (C-GETMAPIV-NORM).
    const std::tuple<GLenum, GLenum, int> kAnswers[] = {
        {form == 2 ? GL_MAP1_VERTEX_4 : GL_MAP1_COLOR_4, GL_COEFF, 12},
        {form == 2 ? GL_MAP2_VERTEX_3 : GL_MAP2_NORMAL, GL_COEFF, 18},
        {GL_MAP1_INDEX, GL_ORDER, 1},
        {GL_MAP2_INDEX, GL_ORDER, 2},
        {GL_MAP1_INDEX, GL_DOMAIN, 2},
        {GL_MAP2_INDEX, GL_DOMAIN, 4}};
    for (const auto& [of, what, count] : kAnswers) {
      const auto add = [&, of = of, what = what](Theme& theme, int size) {
        gl::Case c;
        before(c, of);
        ask_n(c, of, what, size);
        theme.add(sequence(c), {}, flags);
      };
      add(exact, count * bytes);
      add(small, count * bytes - 1);
      if (what == GL_COEFF) add(small, 0);
      if (what == GL_COEFF) add(exact, 1000);
      if (what == GL_ORDER) add(negative, -1);
    }
    gl::Case c;
    ask_n(c, GL_TEXTURE_2D, GL_COEFF, 96);
    ask_n(c, GL_MAP1_INDEX, GL_TEXTURE_2D, 96);
    c.Begin(GL_POINTS);
    ask_n(c, GL_MAP1_INDEX, GL_ORDER, 96);
    c.End();
    refused.add(sequence(c), {}, flags);
  }
}

// --- Other state

void add(Theme& theme, const std::function<void(gl::Case&)>& what) {
  gl::Case c;
  what(c);
  theme.add(sequence(c));
}

void enables_and_queries(Document& document) {
  Theme caps(document, "enable-begin-end",
             "Enable, Disable and IsEnabled between Begin and End: they do nothing", {"EV-EN-BEGINEND"});
  for (const GLenum cap : gl::all_caps()) {
    add(caps, [&](gl::Case& c) {
      c.Begin(GL_POINTS);
      c.Enable(cap);
      c.IsEnabled(cap);
      c.End();
      c.IsEnabled(cap);
      c.Enable(cap);
      c.Begin(GL_POINTS);
      c.Disable(cap);
      c.End();
      c.IsEnabled(cap);
    });
  }

  Theme gets(document, "get-begin-end", "queries of grids, enables and limits between Begin and End",
             {"EV-GET-ERR-BEGINEND"});
  for (const GLenum name : {GL_MAP1_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS, GL_MAP1_VERTEX_3, GL_AUTO_NORMAL}) {
    add(gets, [&](gl::Case& c) {
      c.Begin(GL_POINTS);
      c.GetFloatv(name, gl::out<GLfloat>(4));
      c.End();
    });
    add(gets, [&](gl::Case& c) {
      c.Begin(GL_POINTS);
      c.GetIntegerv(name, gl::out<GLint>(4));
      c.GetDoublev(name, gl::out<GLdouble>(4));
      c.GetBooleanv(name, gl::out<GLboolean>(4));
      c.End();
    });
  }
}

void primitives_and_units(Document& document) {
  Theme begin(document, "begin-end", "Begin and End themselves, and what is legal between them",
              {"EV-BE-ALLOWED", "EV-COORD-INBEGIN", "EV-COORD-NOERR"});
  add(begin, [](gl::Case& c) { c.End(); });
  // The values directly above GL_POLYGON are modes of later versions.
  for (const GLenum mode : {GL_POLYGON + 20, GL_TEXTURE_2D}) add(begin, [&](gl::Case& c) { c.Begin(mode); });
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode)
    add(begin, [&](gl::Case& c) {
      c.Begin(mode);
      c.Begin(GL_POINTS);
      c.End();
      c.End();
    });
  for (const double u : {0.0, -1e30, 3e38, 0x1p-149})
    add(begin, [&](gl::Case& c) {
      c.Begin(GL_POINTS);
      c.EvalCoord1f(u);
      c.EvalCoord2d(u, -u);
      c.EvalPoint1(kLeast);
      c.EvalPoint2(kMost, kLeast);
      c.End();
    });

  Theme unit(document, "active-texture", "ActiveTexture of an invalid unit, and between Begin and End",
             {"EV-EXT-MT-RULE"});
  add(unit, [](gl::Case& c) { c.ActiveTexture(GL_TEXTURE_2D); });
  add(unit, [](gl::Case& c) { c.ActiveTexture(0); });
  add(unit, [](gl::Case& c) {
    c.Begin(GL_POINTS);
    c.ActiveTexture(GL_TEXTURE1);
    c.End();
    define(c, Type::kSingle, {GL_MAP1_INDEX, {2, 0, 1}, {}, {1, 2}});
    query_all(c, GL_MAP1_INDEX, 2);
  });
}

// Adds display lists with the errors of commands other than maps.
void compiled_errors(Document& document) {
  Theme theme(
      document, "compiled",
      "compiled grids, meshes and evaluation with each error: raised by the call of the list, which goes on",
      {"EV-DL-ERR-ALL", "EV-DL-ERR-LATE", "EV-DL-ERR-CONTINUE"});
  const std::vector<std::pair<const char*, std::function<void(gl::Case&)>>> kConditions = {
      {"EV-GRID-ERR-N", [](gl::Case& c) { c.MapGrid1f(0, 0, 1); }},
      {"EV-GRID-ERR-N", [](gl::Case& c) { c.MapGrid1d(-5, 0, 1); }},
      {"EV-GRID-ERR-UN", [](gl::Case& c) { c.MapGrid2f(0, 0, 1, 2, 0, 1); }},
      {"EV-GRID-ERR-VN", [](gl::Case& c) { c.MapGrid2d(2, 0, 1, -1, 0, 1); }},
      {"EV-MESH1-ERR-MODE", [](gl::Case& c) { c.EvalMesh1(GL_FILL, 0, 1); }},
      {"EV-MESH1-ERR-MODE", [](gl::Case& c) { c.EvalMesh1(GL_LINES, 0, 1); }},
      {"EV-MESH2-ERR-MODE", [](gl::Case& c) { c.EvalMesh2(GL_QUADS, 0, 1, 0, 1); }},
      {"EV-MESH2-ERR-MODE", [](gl::Case& c) { c.EvalMesh2(GL_POINT - 1, 0, 1, 0, 1); }},
      {"EV-MESH1-ERR-BEGINEND",
       [](gl::Case& c) {
         c.Begin(GL_POINTS);
         c.EvalMesh1(GL_POINT, 0, 1);
         c.EvalCoord1f(0.5f);
         c.End();
       }},
      {"EV-GRID-ERR-BEGINEND",
       [](gl::Case& c) {
         c.Begin(GL_POINTS);
         c.MapGrid2f(3, 0, 1, 3, 0, 1);
         c.EvalCoord2f(0.5f, 0.25f);
         c.End();
       }},
      {"EV-MAP1-ERR-BEGINEND", [](gl::Case& c) {
         c.Begin(GL_POINTS);
         define(c, Type::kSingle, {GL_MAP1_VERTEX_3, {1, 0, 1}, {}, numbered(3, 50)});
         c.EvalCoord1f(0.5f);
         c.End();
       }}};
  for (const GLenum mode : {GL_COMPILE, GL_COMPILE_AND_EXECUTE})
    for (const auto& [requirement, fail] : kConditions) {
      gl::Case c;
      errors_of::ready(c);
      c.NewList(1, mode);
      fail(c);
      c.Enable(GL_AUTO_NORMAL);
      c.EndList();
      c.IsEnabled(GL_AUTO_NORMAL);
      c.CallList(1);
      c.IsEnabled(GL_AUTO_NORMAL);
      query_grids(c);
      query_all(c, GL_MAP1_VERTEX_3, 6);
      theme.add(sequence(c), {requirement});
    }
}

void lists_and_stacks(Document& document) {
  Theme lists(document, "lists",
              "errors of display lists: of commands when they are executed, not when compiled",
              {"EV-DL-ERR-LATE", "EV-DL-ERR-CONTINUE"});
  add(lists, [](gl::Case& c) { c.NewList(0, GL_COMPILE); });
  add(lists, [](gl::Case& c) { c.NewList(1, GL_TEXTURE_2D); });
  add(lists, [](gl::Case& c) { c.EndList(); });
  add(lists, [](gl::Case& c) {
    c.NewList(1, GL_COMPILE);
    c.NewList(2, GL_COMPILE);
    c.EndList();
  });
  for (const GLenum mode : {GL_COMPILE, GL_COMPILE_AND_EXECUTE})
    for (const bool two : {false, true})
      add(lists, [&](gl::Case& c) {
        const GLenum target = two ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3;
        before(c, target);
        c.NewList(1, mode);
        Arguments bad{target};
        bad.u1 = bad.u2;
        issue(c, Type::kSingle, two, bad);
        c.Enable(target);
        c.EndList();
        c.IsEnabled(target);
        c.CallList(1);
        c.IsEnabled(target);
        after(c, target);
      });
  add(lists, [](gl::Case& c) {
    c.NewList(1, GL_COMPILE);
    c.MapGrid1f(-1, 0, 1);
    c.EndList();
    c.CallList(1);
    query_grids(c);
  });
  add(lists, [](gl::Case& c) {
    c.NewList(1, GL_COMPILE);
    c.EvalMesh2(GL_LINES, 0, 1, 0, 1);
    c.EndList();
    c.CallList(1);
  });
  add(lists, [](gl::Case& c) {
    c.Begin(GL_POINTS);
    c.NewList(1, GL_COMPILE);
    c.EndList();
    c.End();
  });

  Theme stack(document, "attribute-stack", "PopAttrib of an empty stack, PushAttrib between Begin and End",
              {"EV-ATTRIB-NEST"});
  add(stack, [](gl::Case& c) { c.PopAttrib(); });
  add(stack, [](gl::Case& c) {
    c.PushAttrib(GL_EVAL_BIT);
    c.PopAttrib();
    c.PopAttrib();
  });
  add(stack, [](gl::Case& c) {
    c.Begin(GL_POINTS);
    c.PushAttrib(GL_EVAL_BIT);
    c.End();
    c.PopAttrib();
  });
}

}  // namespace

Document errors() {
  Document document("errors",
                    "Which errors commands raise, and that a command which raises one does nothing else.");
  document.explain(kLimit, "only where MAX_EVAL_ORDER is 64 or less");
  MapErrors map1(document, false), map2(document, true);
  map1.add_all();
  map2.add_all();
  errors_of::grids(document);
  errors_of::meshes(document);
  queries(document);
  enables_and_queries(document);
  primitives_and_units(document);
  lists_and_stacks(document);
  map1.add_later_themes();
  map2.add_later_themes();
  compiled_errors(document);
  return document;
}

}  // namespace evalcts::vectors
