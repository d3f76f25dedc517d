// Section 21: the attribute stack and several contexts.
#include <array>

#include "around.h"
#include "forms.h"

namespace evalcts::faults::attribute_stack {
namespace {

// --- Levels of the stack -----------------------------------------------------------------------------------

// What a fault remembers at PushAttrib comes back at the PopAttrib of the same level: `keep` returns the
// values, `bring_back` sees the mask, and, after PopAttrib, these. None of it in lists.
constexpr std::size_t kLevel = 8;  // the mask and up to seven values

using Kept = std::array<double, kLevel - 1>;

template <class Keep, class BringBack>
void at_each_level(Injection& in, Keep, BringBack) {
  in.gl.NewList = [](GLuint list, GLenum mode) {
    sound.NewList(list, mode);
    memory.flag = true;
  };
  in.gl.EndList = [] {
    sound.EndList();
    memory.flag = false;
  };
  in.gl.PushAttrib = [](GLbitfield mask) {
    if (!memory.flag) {
      const Kept kept = Keep{}();
      memory.numbers.push_back(mask);
      memory.numbers.insert(memory.numbers.end(), kept.begin(), kept.end());
    }
    sound.PushAttrib(mask);
  };
  in.gl.PopAttrib = [] {
    if (memory.flag || memory.numbers.empty()) return sound.PopAttrib();
    const Kept changed = Keep{}();
    sound.PopAttrib();
    const auto level = memory.numbers.end() - kLevel;
    Kept kept;
    std::copy(level + 1, memory.numbers.end(), kept.begin());
    const auto mask = static_cast<GLbitfield>(*level);
    memory.numbers.erase(level, memory.numbers.end());
    BringBack{}(mask, kept, changed);
  };
}

// One enable for the faults below.
template <GLenum cap>
Kept keep_enable() {
  return {is_on(cap) ? 1.0 : 0.0};
}
// Those whose mask fits stay as they were changed.
template <GLenum cap, class Fits>
void not_restored(Injection& in, Fits) {
  at_each_level(
      in, [] { return keep_enable<cap>(); },
      [](GLbitfield mask, const Kept&, const Kept& changed) {
        if (Fits{}(mask)) set(cap, changed[0] != 0);
      });
}
// Those whose mask fits come back, though they should not.
template <GLenum cap, class Fits>
void restored(Injection& in, Fits) {
  at_each_level(
      in, [] { return keep_enable<cap>(); },
      [](GLbitfield mask, const Kept& kept, const Kept&) {
        if (Fits{}(mask)) set(cap, kept[0] != 0);
      });
}

bool has_eval_only(GLbitfield mask) { return (mask & GL_EVAL_BIT) && !(mask & GL_ENABLE_BIT); }
bool has_enable_only(GLbitfield mask) { return (mask & GL_ENABLE_BIT) && !(mask & GL_EVAL_BIT); }
bool has_neither(GLbitfield mask) { return !(mask & (GL_ENABLE_BIT | GL_EVAL_BIT)); }

Kept keep_grid1() {
  double domain[2] = {};
  sound.GetDoublev(GL_MAP1_GRID_DOMAIN, domain);
  return {static_cast<double>(integer(GL_MAP1_GRID_SEGMENTS)), domain[0], domain[1]};
}
void set_grid1(const Kept& grid) { sound.MapGrid1d(static_cast<GLint>(grid[0]), grid[1], grid[2]); }

Kept keep_grid2() {
  GLint segments[2] = {};
  double domain[4] = {};
  sound.GetIntegerv(GL_MAP2_GRID_SEGMENTS, segments);
  sound.GetDoublev(GL_MAP2_GRID_DOMAIN, domain);
  return {static_cast<double>(segments[0]),
          static_cast<double>(segments[1]),
          domain[0],
          domain[1],
          domain[2],
          domain[3]};
}
void set_grid2(const Kept& grid) {
  sound.MapGrid2d(static_cast<GLint>(grid[0]), grid[2], grid[3], static_cast<GLint>(grid[1]), grid[4],
                  grid[5]);
}

// --- EVAL_BIT ----------------------------------------------------------------------------------------------

EVALCTS_FAULT(EvalBitForgetsAutoNormal, production, must, "EV-ATTRIB-EVALBIT",
              "EVAL_BIT restores AUTO_NORMAL only together with ENABLE_BIT") {
  not_restored<GL_AUTO_NORMAL>(in, [](GLbitfield mask) { return has_eval_only(mask); });
}

EVALCTS_FAULT(EvalBitForgetsLastMap, production, must, "EV-ATTRIB-EVALBIT",
              "EVAL_BIT does not restore the enable of MAP2_VERTEX_4") {
  not_restored<GL_MAP2_VERTEX_4>(in, [](GLbitfield mask) { return has_eval_only(mask); });
}

EVALCTS_FAULT(EvalBitForgetsSegmentsOfV, production, must, "EV-ATTRIB-EVALBIT",
              "EVAL_BIT does not restore the number of segments in v") {
  at_each_level(
      in, [] { return keep_grid2(); },
      [](GLbitfield mask, const Kept&, const Kept& changed) {
        if (!(mask & GL_EVAL_BIT)) return;
        Kept grid = keep_grid2();
        grid[1] = changed[1];
        set_grid2(grid);
      });
}

EVALCTS_FAULT(EvalBitForgetsSecondEndOfU, production, must, "EV-ATTRIB-EVALBIT",
              "EVAL_BIT does not restore u2 of the grid of one dimension") {
  at_each_level(
      in, [] { return keep_grid1(); },
      [](GLbitfield mask, const Kept&, const Kept& changed) {
        if (!(mask & GL_EVAL_BIT)) return;
        Kept grid = keep_grid1();
        grid[2] = changed[2];
        set_grid1(grid);
      });
}

EVALCTS_FAULT(PushResetsGrid, production, must, "EV-ATTRIB-EVALBIT",
              "after PushAttrib(EVAL_BIT) the grid of one dimension is the initial one until PopAttrib") {
  in.gl.PushAttrib = [](GLbitfield mask) {
    sound.PushAttrib(mask);
    if (mask & GL_EVAL_BIT) sound.MapGrid1d(1, 0, 1);
  };
}

EVALCTS_FAULT(PushTurnsAutoNormalOff, production, must, "EV-ATTRIB-ENABLEBIT",
              "after PushAttrib(ENABLE_BIT) AUTO_NORMAL is off until PopAttrib") {
  in.gl.PushAttrib = [](GLbitfield mask) {
    sound.PushAttrib(mask);
    if (has_enable_only(mask)) sound.Disable(GL_AUTO_NORMAL);
  };
}

EVALCTS_FAULT(EnableBitHidesEvalBit, production, must, "EV-ATTRIB-EVALBIT",
              "of EVAL_BIT and ENABLE_BIT together the latter counts: the grid of two dimensions stays") {
  at_each_level(
      in, [] { return keep_grid2(); },
      [](GLbitfield mask, const Kept&, const Kept& changed) {
        if (mask == (GL_EVAL_BIT | GL_ENABLE_BIT)) set_grid2(changed);
      });
}

EVALCTS_FAULT(PopOnlyEnables, production, must, "EV-ATTRIB-EVALBIT EV-ATTRIB-ENABLEBIT",
              "PopAttrib enables MAP1_INDEX again where it was on, but does not disable it") {
  at_each_level(
      in, [] { return keep_enable<GL_MAP1_INDEX>(); },
      [](GLbitfield, const Kept&, const Kept& changed) {
        if (changed[0] != 0) sound.Enable(GL_MAP1_INDEX);
      });
}

// --- ENABLE_BIT --------------------------------------------------------------------------------------------

EVALCTS_FAULT(EnableBitForgetsAutoNormal, production, must, "EV-ATTRIB-ENABLEBIT",
              "ENABLE_BIT does not cover AUTO_NORMAL, as in GL 1.0") {
  not_restored<GL_AUTO_NORMAL>(in, [](GLbitfield mask) { return has_enable_only(mask); });
}

EVALCTS_FAULT(EnableBitForgetsMap2Normal, production, must, "EV-ATTRIB-ENABLEBIT",
              "ENABLE_BIT does not cover MAP2_NORMAL") {
  not_restored<GL_MAP2_NORMAL>(in, [](GLbitfield mask) { return has_enable_only(mask); });
}

EVALCTS_FAULT(EnableBitRestoresSegments, production, must, "EV-ATTRIB-ENABLEBIT-NOGRID",
              "ENABLE_BIT restores the number of segments of the grid of one dimension") {
  at_each_level(
      in, [] { return keep_grid1(); },
      [](GLbitfield mask, const Kept& kept, const Kept&) {
        if (!has_enable_only(mask)) return;
        Kept grid = keep_grid1();
        grid[0] = kept[0];
        set_grid1(grid);
      });
}

// --- Maps --------------------------------------------------------------------------------------------------

EVALCTS_FAULT(EvalBitRestoresDomain, production, must, "EV-ATTRIB-NOMAPS",
              "EVAL_BIT restores the domain of MAP1_VERTEX_3") {
  at_each_level(
      in,
      [] {
        Kept domain{};
        sound.GetMapdv(GL_MAP1_VERTEX_3, GL_DOMAIN, domain.data());
        return domain;
      },
      [](GLbitfield mask, const Kept& kept, const Kept&) {
        if (!(mask & GL_EVAL_BIT)) return;
        GLint order = 0;
        sound.GetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, &order);
        std::vector<double> points(static_cast<std::size_t>(3 * order));
        sound.GetMapdv(GL_MAP1_VERTEX_3, GL_COEFF, points.data());
        sound.Map1d(GL_MAP1_VERTEX_3, kept[0], kept[1], 3, order, points.data());
      });
}

EVALCTS_FAULT(PushTakesIndexMapAway, production, must, "EV-ATTRIB-NOMAPS",
              "PushAttrib(EVAL_BIT) leaves MAP1_INDEX as it is initially") {
  in.gl.PushAttrib = [](GLbitfield mask) {
    const double one = 1;
    sound.PushAttrib(mask);
    if (mask == GL_EVAL_BIT) sound.Map1d(GL_MAP1_INDEX, 0, 1, 1, 1, &one);
  };
}

EVALCTS_FAULT(AllBitsResetSmallMaps, production, must, "EV-ATTRIB-NOMAPS",
              "after PushAttrib of all groups the definition of MAP2_INDEX is lost") {
  at_each_level(
      in, [] { return Kept{}; },
      [](GLbitfield mask, const Kept&, const Kept&) {
        const double one = 1;
        if (mask == 0xFFFFFFFFu) sound.Map2d(GL_MAP2_INDEX, 0, 1, 1, 1, 0, 1, 1, 1, &one);
      });
}

// --- ALL_ATTRIB_BITS ---------------------------------------------------------------------------------------

EVALCTS_FAULT(AllBitsWithoutEval, production, must, "EV-ATTRIB-ALL",
              "0xFFFFFFFF does not mean the group of evaluators") {
  in.gl.PushAttrib = [](GLbitfield mask) {
    sound.PushAttrib(mask == 0xFFFFFFFFu ? mask & ~static_cast<GLbitfield>(GL_EVAL_BIT) : mask);
  };
}

EVALCTS_FAULT(AllBitsOf10AreCurrentOnly, production, must, "EV-ATTRIB-ALL",
              "with the ALL_ATTRIB_BITS of GL 1.0 the grid of two dimensions is not restored") {
  at_each_level(
      in, [] { return keep_grid2(); },
      [](GLbitfield mask, const Kept&, const Kept& changed) {
        if (mask == 0x000FFFFFu) set_grid2(changed);
      });
}

// --- Other groups ------------------------------------------------------------------------------------------

EVALCTS_FAULT(TransformBitRestoresAutoNormal, production, must, "EV-ATTRIB-OTHERBITS",
              "AUTO_NORMAL is in the group of NORMALIZE") {
  restored<GL_AUTO_NORMAL>(in,
                           [](GLbitfield mask) { return (mask & GL_TRANSFORM_BIT) && has_neither(mask); });
}

EVALCTS_FAULT(TextureBitRestoresTextureMap, production, must, "EV-ATTRIB-OTHERBITS",
              "MAP2_TEXTURE_COORD_2 is in the group of textures") {
  restored<GL_MAP2_TEXTURE_COORD_2>(
      in, [](GLbitfield mask) { return (mask & GL_TEXTURE_BIT) && has_neither(mask); });
}

EVALCTS_FAULT(NoBitRestoresGrid, production, must, "EV-ATTRIB-OTHERBITS",
              "PushAttrib(0) saves the grid of two dimensions") {
  at_each_level(
      in, [] { return keep_grid2(); },
      [](GLbitfield mask, const Kept& kept, const Kept&) {
        if (mask == 0) set_grid2(kept);
      });
}

EVALCTS_FAULT(HintBitRestoresIndexMap, production, must, "EV-ATTRIB-OTHERBITS",
              "HINT_BIT restores the enable of MAP1_INDEX") {
  restored<GL_MAP1_INDEX>(in, [](GLbitfield mask) { return mask == GL_HINT_BIT; });
}

// --- Nesting -----------------------------------------------------------------------------------------------

EVALCTS_FAULT(OneSlotForTheGrid, production, must, "EV-ATTRIB-NEST",
              "the grid is saved in one place for all levels: each PopAttrib brings back the last saved") {
  in.gl.PushAttrib = [](GLbitfield mask) {
    if (mask & GL_EVAL_BIT) {
      const Kept grid = keep_grid1();
      memory.numbers.assign(grid.begin(), grid.end());
    }
    sound.PushAttrib(mask);
  };
  in.gl.PopAttrib = [] {
    sound.PopAttrib();
    Kept grid{};
    if (memory.numbers.size() != grid.size()) return;
    std::copy(memory.numbers.begin(), memory.numbers.end(), grid.begin());
    set_grid1(grid);
  };
}

EVALCTS_FAULT(OneSlotForEnables, production, must, "EV-ATTRIB-NEST",
              "ENABLE_BIT saves MAP2_NORMAL in one place for all levels") {
  in.gl.PushAttrib = [](GLbitfield mask) {
    if (has_enable_only(mask)) memory.flag = is_on(GL_MAP2_NORMAL);
    sound.PushAttrib(mask);
    memory.numbers.push_back(mask);
  };
  in.gl.PopAttrib = [] {
    sound.PopAttrib();
    if (memory.numbers.empty()) return;
    if (has_enable_only(static_cast<GLbitfield>(memory.numbers.back()))) set(GL_MAP2_NORMAL, memory.flag);
    memory.numbers.pop_back();
  };
}

EVALCTS_FAULT(NinthLevelOverwritesEighth, production, must, "EV-ATTRIB-NEST",
              "the ninth level of the stack takes the place of the eighth") {
  at_each_level(
      in, [] { return keep_grid1(); },
      [](GLbitfield, const Kept& kept, const Kept&) {
        const std::size_t level = memory.numbers.size() / kLevel + 1;
        if (level == 9) memory.counts[9] = static_cast<long>(kept[0]);
        if (level != 8 || !memory.counts.contains(9)) return;
        Kept grid = keep_grid1();
        grid[0] = static_cast<double>(memory.counts[9]);
        set_grid1(grid);
      });
}

EVALCTS_FAULT(InnerPopRestoresOuterEnables, production, must, "EV-ATTRIB-NEST",
              "a level without evaluators restores AUTO_NORMAL of the level around it") {
  at_each_level(
      in, [] { return keep_enable<GL_AUTO_NORMAL>(); },
      [](GLbitfield mask, const Kept&, const Kept&) {
        if (!has_neither(mask) || memory.numbers.empty()) return;
        set(GL_AUTO_NORMAL, memory.numbers[memory.numbers.size() - kLevel + 1] != 0);
      });
}

// --- Contexts ----------------------------------------------------------------------------------------------

// body(number, first time, switch): `switch` makes the context current.
template <class Body>
void at_other_context(Injection& in, Body) {
  in.gl.OtherContextEVALCTS = [](GLuint number) {
    Body{}(number, number != 0 && memory.counts[number]++ == 0,
           [number] { sound.OtherContextEVALCTS(number); });
  };
  in.gl.SharingContextEVALCTS = [](GLuint number) {
    Body{}(number, number != 0 && memory.counts[number]++ == 0,
           [number] { sound.SharingContextEVALCTS(number); });
  };
}

EVALCTS_FAULT(NewContextInheritsGrid, production, must, "EV-CTX-FRESH",
              "a new context begins with the grid of the one that was current") {
  at_other_context(in, [](GLuint, bool first, auto make_current) {
    const Kept grid = keep_grid2();
    make_current();
    if (first) set_grid2(grid);
  });
}

EVALCTS_FAULT(NewContextInheritsAutoNormal, production, must, "EV-CTX-FRESH",
              "a new context begins with AUTO_NORMAL as it is elsewhere") {
  at_other_context(in, [](GLuint, bool first, auto make_current) {
    const bool on = is_on(GL_AUTO_NORMAL);
    make_current();
    if (first) set(GL_AUTO_NORMAL, on);
  });
}

EVALCTS_FAULT(SharingContextInheritsMap, osmesa, must, "EV-CTX-FRESH",
              "a new context that shares objects begins with MAP1_INDEX as it is defined elsewhere") {
  in.gl.SharingContextEVALCTS = [](GLuint number) {
    GLint order = 0;
    double domain[2] = {}, points[64];
    sound.GetMapiv(GL_MAP1_INDEX, GL_ORDER, &order);
    sound.GetMapdv(GL_MAP1_INDEX, GL_DOMAIN, domain);
    sound.GetMapdv(GL_MAP1_INDEX, GL_COEFF, points);
    sound.SharingContextEVALCTS(number);
    sound.Map1d(GL_MAP1_INDEX, domain[0], domain[1], 1, order, points);
  };
}

EVALCTS_FAULT(ContextsShareGrid, production, must, "EV-CTX-PRIVATE",
              "all contexts have the grid of one dimension together") {
  at_other_context(in, [](GLuint, bool, auto make_current) {
    const Kept grid = keep_grid1();
    make_current();
    set_grid1(grid);
  });
}

EVALCTS_FAULT(ContextsShareEnable, production, must, "EV-CTX-PRIVATE",
              "all contexts have the enable of MAP2_TEXTURE_COORD_4 together") {
  at_other_context(in, [](GLuint, bool, auto make_current) {
    const bool on = is_on(GL_MAP2_TEXTURE_COORD_4);
    make_current();
    set(GL_MAP2_TEXTURE_COORD_4, on);
  });
}

EVALCTS_FAULT(SharingContextsShareAutoNormal, osmesa, must, "EV-CTX-PRIVATE",
              "contexts that share objects have AUTO_NORMAL together") {
  in.gl.SharingContextEVALCTS = [](GLuint number) {
    sound.SharingContextEVALCTS(number);
    memory.flag = true;
  };
  in.gl.OtherContextEVALCTS = [](GLuint number) {
    const bool on = is_on(GL_AUTO_NORMAL);
    sound.OtherContextEVALCTS(number);
    if (memory.flag && number < 2) set(GL_AUTO_NORMAL, on);
  };
}

EVALCTS_FAULT(ContextsShareDomain, production, must, "EV-CTX-PRIVATE",
              "a second context has the domain of MAP2_COLOR_4 of the first") {
  at_other_context(in, [](GLuint, bool, auto make_current) {
    GLdouble domain[4];
    sound.GetMapdv(GL_MAP2_COLOR_4, GL_DOMAIN, domain);
    make_current();
    GLint order[2];
    std::vector<double> points(64 * 64 * 4);
    sound.GetMapiv(GL_MAP2_COLOR_4, GL_ORDER, order);
    sound.GetMapdv(GL_MAP2_COLOR_4, GL_COEFF, points.data());
    sound.Map2d(GL_MAP2_COLOR_4, domain[0], domain[1], 4 * order[1], order[0], domain[2], domain[3], 4,
                order[1], points.data());
  });
}

EVALCTS_FAULT(ContextsShareControlPoints, production, must, "EV-CTX-PRIVATE",
              "the control points of MAP1_NORMAL are one array for all contexts") {
  at_other_context(in, [](GLuint, bool, auto make_current) {
    GLint order = 0, here = 0;
    std::vector<double> points(256), own(256);
    double domain[2];
    sound.GetMapiv(GL_MAP1_NORMAL, GL_ORDER, &order);
    sound.GetMapdv(GL_MAP1_NORMAL, GL_COEFF, points.data());
    make_current();
    sound.GetMapiv(GL_MAP1_NORMAL, GL_ORDER, &here);
    sound.GetMapdv(GL_MAP1_NORMAL, GL_DOMAIN, domain);
    sound.GetMapdv(GL_MAP1_NORMAL, GL_COEFF, own.data());
    std::copy_n(points.begin(), 3 * std::min(order, here), own.begin());
    sound.Map1d(GL_MAP1_NORMAL, domain[0], domain[1], 3, here, own.data());
  });
}

EVALCTS_FAULT(SharedListDefinesInItsMaker, osmesa, must, "EV-CTX-PRIVATE",
              "a shared list defines maps in the context that made it") {
  in.gl.SharingContextEVALCTS = [](GLuint number) {
    sound.SharingContextEVALCTS(number);
    memory.count = number;
  };
  in.gl.OtherContextEVALCTS = [](GLuint number) {
    sound.OtherContextEVALCTS(number);
    memory.flag = number == 0 && memory.count != 0;
  };
  in.gl.CallList = [](GLuint list) {
    if (memory.flag) sound.OtherContextEVALCTS(static_cast<GLuint>(memory.count));
    sound.CallList(list);
    if (memory.flag) sound.OtherContextEVALCTS(0);
  };
}

EVALCTS_FAULT(ThirdSwitchLosesEnable, production, must, "EV-CTX-SWITCH",
              "MAP2_TEXTURE_COORD_1 is off when a context is current for the fourth time") {
  at_other_context(in, [](GLuint number, bool, auto make_current) {
    make_current();
    if (number == 0 && ++memory.count == 3) sound.Disable(GL_MAP2_TEXTURE_COORD_1);
  });
}

EVALCTS_FAULT(SwitchLosesAutoNormal, production, must, "EV-CTX-SWITCH",
              "AUTO_NORMAL is off when the first context is current again") {
  at_other_context(in, [](GLuint number, bool, auto make_current) {
    make_current();
    if (number == 0) sound.Disable(GL_AUTO_NORMAL);
  });
}

EVALCTS_FAULT(SwitchRevertsGridDomain, production, must, "EV-CTX-SWITCH",
              "the ends of the grid in v are (0, 1) when the first context is current again") {
  at_other_context(in, [](GLuint number, bool, auto make_current) {
    make_current();
    Kept grid = keep_grid2();
    grid[4] = 0, grid[5] = 1;
    if (number == 0) set_grid2(grid);
  });
}

EVALCTS_FAULT(SwitchKeepsOldPlan, osmesa, must, "EV-CTX-SWITCH",
              "back in the first context the colours of curves are those of the current colour") {
  at_other_context(in, [](GLuint number, bool, auto make_current) {
    make_current();
    memory.flag = number == 0;
  });
  in.gl.Begin = [](GLenum mode) {
    if (memory.flag) sound.Disable(GL_MAP1_COLOR_4);
    sound.Begin(mode);
  };
}

}  // namespace
}  // namespace evalcts::faults::attribute_stack
