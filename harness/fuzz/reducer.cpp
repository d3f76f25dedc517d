// Implements Reducer: tries the commands of known causes first, then shrinks the program.
#include "reducer.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <evalcts/gl/display_lists.h>
#include <evalcts/gl/explicit_vertices.h>

#include "causes.h"
#include "excerpt.h"
#include "legal.h"
#include "shrink.h"

namespace evalcts::fuzz {
namespace {

constexpr int kInShared = 5;  // attempts in the shared context for each attempt in a fresh context

}  // namespace

Reducer::Reducer(const Subject& subject, SharedContext* shared, std::vector<std::string> causes,
                 int most_attempts, Hooks hooks)
    : subject_(subject),
      shared_(shared),
      table_(subject.implementation->create_context()->table()),
      max_order_(subject.info.max_order()),
      causes_(std::move(causes)),
      most_attempts_(most_attempts),
      hooks_(std::move(hooks)) {
  // Causes with fewer commands come first, because they take precedence if several apply.
  std::ranges::stable_sort(causes_, {}, &std::string::size);
}

std::optional<Finding> Reducer::difference_of(const gl::Case& candidate, const std::string& wanted,
                                              const Judge& judge) const {
  if (hooks_.alive) hooks_.alive();
  if ((hooks_.is_over && hooks_.is_over()) ||
      with_what_exists(subject_.info, table_, candidate).commands().size() < candidate.commands().size())
    return {};
  const std::optional<Specified> of_candidate = specify_if_defined(candidate, max_order_);
  if (!of_candidate || (hooks_.try_start && !hooks_.try_start(candidate))) return {};
  std::optional<Finding> found = judge(candidate, *of_candidate).finding;
  return found && kind_of(found->failure.what) == wanted ? std::move(found) : std::nullopt;
}

std::optional<std::string> Reducer::first_cause(const gl::Case& program, const std::string& wanted,
                                                const Applies& applies) const {
  for (const gl::Case& form : forms_of(program)) {
    const std::optional<Specified> of_form = specify_if_defined(form, max_order_);
    for (const std::string& cause : causes_)
      if (of_form && cause.ends_with(": " + wanted) && applies(cause, form, *of_form)) return cause;
  }
  return {};
}

std::optional<Finding> Reducer::recognise(const gl::Case& program, const Finding& finding) {
  if (!shared_ || vertices_of(program) > kMostVertices) return {};
  const std::string kind = kind_of(finding.failure.what);
  std::optional<Finding> recognised;
  const auto still = [&](const gl::Case& candidate) {
    std::optional<Finding> found =
        difference_of(candidate, kind, [&](const gl::Case& c, const Specified& specified) {
          return shared_->judge_aside(c, specified, outcomes_of(kind));
        });
    if (found) recognised = *found;
    return found.has_value();
  };
  const std::optional<std::string> cause = first_cause(
      program, kind, [&](const std::string& known, const gl::Case& form, const Specified& of_form) {
        return reduced_to(known, form, of_form, still).has_value();
      });
  if (hooks_.finish) hooks_.finish();
  if (!cause) return {};
  recognised->cause = *cause;
  return recognised;
}

Finding Reducer::explain(gl::Case program, Finding finding, bool careful, bool tried) {
  const std::string kind = kind_of(finding.failure.what);
  const Outcomes outcomes = outcomes_of(kind);
  std::string wanted = kind;
  bool outside = false;
  const auto still = [&](const gl::Case& candidate) {
    std::optional<Finding> found =
        difference_of(candidate, wanted, [&](const gl::Case& c, const Specified& specified) {
          return judge_program(subject_, c, specified, outcomes);
        });
    if (!found) return false;
    finding = *std::move(found);
    finding.outside_evaluators = outside;
    return true;
  };
  const auto still_in_shared = [&](const gl::Case& candidate) {
    return difference_of(candidate, wanted,
                         [&](const gl::Case& c, const Specified& specified) {
                           return shared_->judge(c, specified, outcomes);
                         })
        .has_value();
  };
  const auto finish = [&] {
    if (hooks_.finish) hooks_.finish();
    return finding;
  };
  // A difference that shows without display lists as well is no bug of lists.
  if (gl::uses_lists(program) && still(gl::without_lists(program))) {
    program = finding.program;
    tried = false;
  }
  // Most differences have a known cause, so the commands of known causes are tried first. The shared context
  // quickly shows which cause it may be.
  const auto is_known = [&](bool in_shared) {
    const std::optional<std::string> known = first_cause(
        program, wanted, [&](const std::string& cause, const gl::Case& form, const Specified& of_form) {
          // The shared context has shown that each word is necessary, so one repetition in a
          // fresh context suffices.
          const std::optional<gl::Case> reduced = in_shared
                                                      ? reduced_to(cause, form, of_form, still_in_shared)
                                                      : reduced_to(cause, form, of_form, still);
          return reduced && (!in_shared || still(*reduced));
        });
    if (known) finding.cause = *known;
    return known.has_value();
  };
  // Each run of a program that draws very much takes long, so it gets fewer attempts.
  const std::int64_t size = std::max<std::int64_t>(vertices_of(program) / kMostVertices, 1);
  const bool is_cheap_in_shared = shared_ && size == 1;
  bool known = (is_cheap_in_shared && !tried && is_known(true)) || is_known(false);
  if (!known && outcomes == Outcomes::kVertices && kind != kPrimitives) {
    // If some vertices are lost and others are drawn twice, the difference may show as a wrong attribute,
    // although the cause is a known one of the kind `primitives`.
    wanted = kPrimitives;
    known = is_known(false);
    wanted = kind;
  }
  if (known) return finish();
  const auto smaller = [&](const gl::Case&) {
    if (hooks_.smaller) hooks_.smaller(finding);
  };
  // If the control fails as well, it replaces the program. Its cause contains no evaluation, so it does not
  // hide bugs that only evaluation shows.
  gl::Case shown = program;
  const auto shows_outside = [&](const gl::Case& control) {
    outside = true;
    return outside = still(control);
  };
  int most = most_attempts_ / static_cast<int>(std::min<std::int64_t>(size, most_attempts_));
  if (shows_outside(gl::with_explicit_vertices(program))) {
    shown = finding.program;
    most /= 4;  // a bug outside of evaluators need not be minimal
  }
  smaller(shown);  // reports the program now, in case the library dies during the reduction
  for (const std::string& word : words_of(shown))
    if (still(without_word(shown, word))) shown = finding.program;
  // The program is first shrunk in the shared context, where runs are cheap, so that few runs in fresh
  // contexts remain.
  if (is_cheap_in_shared && !careful && still_in_shared(shown)) {
    const gl::Case small = shrink(shown, still_in_shared, kInShared * most);
    if (still(small)) shown = small;
  }
  shrink(shown, still, most, smaller);
  if (!outside) shows_outside(gl::with_explicit_vertices(gl::Case(finding.program)));
  causes_.push_back(finding.cause);
  return finish();
}

}  // namespace evalcts::fuzz
