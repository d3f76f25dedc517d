// Faults against section 21 of the requirements: the attribute stack and several contexts.
#include <atomic>
#include <mutex>
#include <thread>

#include "rules.h"

namespace evalcts::faults::attribute_stack {
namespace {

Value is_enable_only(Value mask) { return (mask & GL_ENABLE_BIT) && !(mask & GL_EVAL_BIT); }
const Value kHasNeither = !(kLevelMask & (GL_ENABLE_BIT | GL_EVAL_BIT));

// The domain of a map, which is restored into the current definition.
State domain_of(GLenum target) {
  return [=]() -> Restore {
    return [=, saved = current_map(target)] {
      Map{target, saved.u1, saved.u2, saved.v1, saved.v2, current_map(target).net}.define();
    };
  };
}

// True if the context becomes current for the first time.
const Value kIsNewContext = kFirst && !remembered(kFirst);
Rule note_contexts() { return before(kOtherContexts, set(remembered(kFirst), 1)); }

FAULT(PushResetsGrid, "EV-ATTRIB-EVALBIT",
      "after PushAttrib(EVAL_BIT) the grid of one dimension is the initial one until PopAttrib",
      after(PushAttrib, kFirst& GL_EVAL_BIT, call(MapGrid1d, {1, 0, 1})));
FAULT(PushTurnsAutoNormalOff, "EV-ATTRIB-ENABLEBIT", "PushAttrib(ENABLE_BIT) switches AUTO_NORMAL off",
      after(PushAttrib, is_enable_only(kFirst), disable(GL_AUTO_NORMAL)));
FAULT(EnableBitHidesEvalBit, "EV-ATTRIB-EVALBIT",
      "of EVAL_BIT and ENABLE_BIT together the latter counts: the grid of two dimensions stays",
      not_restored(grid2_state(), kLevelMask == (GL_EVAL_BIT | GL_ENABLE_BIT)));
FAULT(EnableBitRestoresGrid, "EV-ATTRIB-ENABLEBIT-NOGRID", "ENABLE_BIT restores the grid of one dimension",
      restored(grid1_state(), is_enable_only(kLevelMask)));
FAULT(EvalBitRestoresDomain, "EV-ATTRIB-NOMAPS", "EVAL_BIT restores the domain of MAP1_VERTEX_3",
      restored(domain_of(GL_MAP1_VERTEX_3), kLevelMask& GL_EVAL_BIT));
FAULT(PushTakesIndexMapAway, "EV-ATTRIB-NOMAPS", "PushAttrib(EVAL_BIT) leaves MAP1_INDEX as it is initially",
      after(PushAttrib, kFirst == GL_EVAL_BIT, define(GL_MAP1_INDEX, {1})));
FAULT(AllBitsWithoutEval, "EV-ATTRIB-ALL", "0xFFFFFFFF does not mean the group of evaluators",
      before(PushAttrib, kFirst == 0xFFFFFFFFu, set(kFirst, kFirst - GL_EVAL_BIT)));
FAULT(AllBitsOf10AreCurrentOnly, "EV-ATTRIB-ALL",
      "with the ALL_ATTRIB_BITS of GL 1.0 the grid of two dimensions is not restored",
      not_restored(grid2_state(), kLevelMask == 0x000FFFFFu));
FAULT(TextureBitRestoresTextureMap, "EV-ATTRIB-OTHERBITS", "MAP2_TEXTURE_COORD_2 is in the group of textures",
      restored(enable_of(GL_MAP2_TEXTURE_COORD_2), (kLevelMask & GL_TEXTURE_BIT) != 0 && kHasNeither));
FAULT(NoBitRestoresGrid, "EV-ATTRIB-OTHERBITS", "PushAttrib(0) saves the grid of two dimensions",
      restored(grid2_state(), kLevelMask == 0));
FAULT(OneSlotForEnables, "EV-ATTRIB-NEST", "ENABLE_BIT saves MAP2_NORMAL in one place for all levels",
      before(PushAttrib, is_enable_only(kFirst), set(kFlag, enabled(GL_MAP2_NORMAL))),
      after(PopAttrib, kLevel > 0 && is_enable_only(kLevelMask), switch_to(GL_MAP2_NORMAL, kFlag)));
FAULT(ChangesBehindInnerLevelStay, "EV-ATTRIB-NEST",
      "a grid that is set behind a nested level of another group stays when the outer level is popped",
      after(MapGrid1f, kListMode == 0 && kLevel > 1 && kHasNeither, set(kFlag, 1)),
      not_restored(grid1_state(), kFlag && (kLevelMask & GL_EVAL_BIT) != 0));
FAULT(NewContextInheritsGrid, "EV-CTX-FRESH", "a new context has the grid of the one that was current",
      keeping(kOtherContexts, kIsNewContext, grid2_state()), note_contexts());
FAULT(ContextsShareDomain, "EV-CTX-PRIVATE", "a second context has the domain of MAP2_COLOR_4 of the first",
      keeping(kOtherContexts, true, domain_of(GL_MAP2_COLOR_4)));
FAULT(ThirdSwitchLosesEnable, "EV-CTX-SWITCH", "MAP2_TEXTURE_COORD_1 is off after three switches of contexts",
      after(kOtherContexts, kFirst == 0,
            {set(kCount, kCount + 1), when(kCount == 3, disable(GL_MAP2_TEXTURE_COORD_1))}));
FAULT(SwitchLosesAutoNormal, "EV-CTX-SWITCH", "AUTO_NORMAL is off when the first context is current again",
      after(kOtherContexts, kFirst == 0, disable(GL_AUTO_NORMAL)));

// The latest map of each target, with its thread.
struct SharedMaps {
  std::mutex mutex;
  std::map<GLenum, std::pair<pid_t, Map>> latest;
} shared_maps;

FAULT(OtherThreadsEvaluateNothing, "EV-CTX-THREAD", "evaluation in other threads than the first is ignored",
      skip(kPoints | kMeshes, kThread != getpid()));
FAULT(MovedContextLosesMaps, "EV-CTX-THREAD",
      "a context that moves to another thread has initial vertex maps", before(kMaps, set(kNumber, kThread)),
      before(Begin, kNumber&& kNumber != kThread,
             {set(kNumber, kThread), define(GL_MAP1_VERTEX_3, {0, 0, 0}),
              define(GL_MAP2_VERTEX_3, {0, 0, 0})}));
FAULT(ThreadsShareMaps, "EV-CTX-THREAD", "all threads have the maps that one of them has defined last",
      after(kMaps, kIsLegal,
            [](Call& c) {
              const std::scoped_lock lock(shared_maps.mutex);
              shared_maps.latest[c.target()] = {gettid(), current_map(c.target())};
            }),
      before(Begin, [](Call&) {
        std::this_thread::yield();
        const std::scoped_lock lock(shared_maps.mutex);
        for (const auto& [target, of_thread] : shared_maps.latest)
          if (of_thread.first != gettid()) of_thread.second.define();
      }));
FAULT(ThreadsShareArgument, "EV-CTX-THREAD", "EvalCoord keeps u in a variable that all threads share",
      before(kEvalCoords, [](Call& c) {
        static std::atomic<double> u;
        u = c.numbers[0];
        std::this_thread::yield();
        c.numbers[0] = u;
      }));

namespace on_osmesa {
constexpr std::string_view kImplementation = "osmesa";
FAULT(SharingContextInheritsMap, "EV-CTX-FRESH",
      "a new context that shares objects begins with MAP1_INDEX as it is defined elsewhere",
      keeping(SharingContextEVALCTS, true, map_of(GL_MAP1_INDEX)));
FAULT(SharingContextsShareAutoNormal, "EV-CTX-PRIVATE",
      "contexts that share objects have AUTO_NORMAL together", after(SharingContextEVALCTS, set(kFlag, 1)),
      keeping(OtherContextEVALCTS, kFirst < 2 && kFlag, enable_of(GL_AUTO_NORMAL)));
FAULT(SharedListDefinesInItsMaker, "EV-CTX-PRIVATE", "a shared list defines maps in the context that made it",
      after(SharingContextEVALCTS, set(kCount, kFirst)),
      after(OtherContextEVALCTS, set(kFlag, kFirst == 0 && kCount)),
      around(CallList, kFlag, call(OtherContextEVALCTS, {kCount}), call(OtherContextEVALCTS, {0})));
}  // namespace on_osmesa

}  // namespace
}  // namespace evalcts::faults::attribute_stack
