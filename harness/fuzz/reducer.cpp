// Implements Reducer: recognises known programs first, then shrinks the program.
#include "reducer.h"

#include <algorithm>
#include <set>
#include <utility>

#include <evalcts/fuzz/normal_form.h>
#include <evalcts/gl/display_lists.h>
#include <evalcts/gl/roles.h>
#include <evalcts/gl/tokens.h>
#include "excerpt.h"
#include "legal.h"
#include "shrink.h"

namespace evalcts::fuzz {
namespace {

using gl::EntryPoint;

constexpr int kInShared = 5;  // attempts in the shared context for each attempt in a fresh context

// Returns the stem of the command, by which programs are compared. Commands that set current values have one
// stem, and so have those that enable or disable AUTO_NORMAL.
std::string comparison_stem(const gl::Command& command) {
  if ((command.entry == EntryPoint::Enable || command.entry == EntryPoint::Disable) &&
      gl::integer_of(command, 0) == GL_AUTO_NORMAL)
    return "AUTO_NORMAL";
  return gl::role_of(command.entry) == gl::Role::kCurrentValue ? "current value" : gl::stem_of(command.entry);
}

std::set<std::string> stems_of(const gl::Case& program) {
  std::set<std::string> stems;
  for (const gl::Command& command : program.commands()) stems.insert(comparison_stem(command));
  return stems;
}

gl::Case without_stem(const gl::Case& program, const std::string& stem) {
  gl::Case without(program.identity());
  for (const gl::Command& command : program.commands())
    if (comparison_stem(command) != stem) without.add(command);
  return without;
}

bool calls_missing_list(const gl::Case& program) {
  std::set<std::int64_t> defined;
  std::int64_t open = 0;
  return std::ranges::any_of(program.commands(), [&](const gl::Command& command) {
    const std::int64_t list = gl::integer_of(command, 0);
    if (command.entry == EntryPoint::EndList) defined.insert(open);
    if (command.entry == EntryPoint::NewList) open = list;
    return command.entry == EntryPoint::CallList && !defined.contains(list);
  });
}

// Returns false if a mesh or grid point is drawn over an initial grid: no MapGrid of its dimension is before
// it.
bool keeps_to_grids(const gl::Case& program) {
  std::set<int> with_grid;
  return std::ranges::all_of(program.commands(), [&](const gl::Command& command) {
    const gl::Role role = gl::role_of(command.entry);
    const int dimension = gl::dimension_of(command.entry);
    if (role == gl::Role::kMapGrid) with_grid.insert(dimension);
    return (role != gl::Role::kEvalMesh && role != gl::Role::kEvalPoint) || with_grid.contains(dimension);
  });
}

// Returns false if an enabled map is evaluated before it is defined, which uses the initial map.
bool keeps_to_maps(const gl::Case& program) {
  std::set<std::int64_t> enabled, defined;
  return std::ranges::all_of(program.commands(), [&](const gl::Command& command) {
    const std::int64_t name = gl::integer_of(command, 0);
    if (command.entry == EntryPoint::Enable) enabled.insert(name);
    if (command.entry == EntryPoint::Disable) enabled.erase(name);
    if (gl::role_of(command.entry) == gl::Role::kMap) defined.insert(name);
    return !gl::is_evaluation(command.entry) || std::ranges::all_of(enabled, [&](std::int64_t cap) {
      return gl::components_of(static_cast<GLenum>(cap)) == 0 || defined.contains(cap);
    });
  });
}

// Returns the program without all commands of each stem, without the pairs of commands that only make sense
// together, and without display lists. Maps stay, because evaluation without them uses the initial maps.
std::vector<gl::Case> parts_of(const gl::Case& program) {
  std::vector<gl::Case> parts;
  const std::set<std::string> stems = stems_of(program);
  for (const std::string& stem : stems)
    if (stem != "Map1" && stem != "Map2") parts.push_back(without_stem(program, stem));
  for (const auto& [opening, closing] : {std::pair{"Begin", "End"}, {"PushAttrib", "PopAttrib"}})
    if (stems.contains(opening)) parts.push_back(without_stem(without_stem(program, opening), closing));
  if (gl::uses_lists(program)) parts.push_back(gl::without_lists(program));
  return parts;
}

bool has_rejected_command(const Specified& specified) {
  return std::ranges::any_of(specified.errors, [](const auto& errors) { return !errors.empty(); });
}

}  // namespace

std::optional<gl::Case> with_stems_of(const gl::Case& minimal, const gl::Case& program) {
  const std::set<std::string> stems = stems_of(minimal);
  gl::Case reduced(program.identity());
  for (const gl::Command& command : program.commands())
    if (stems.contains(comparison_stem(command))) reduced.add(command);
  return stems_of(reduced) == stems ? std::optional(reduced) : std::nullopt;
}

bool is_explained_by(const gl::Case& minimal, const gl::Case& program, const Specified& specified,
                     const InterestingnessTest& is_interesting) {
  const std::set<std::string> stems = stems_of(minimal);
  gl::Case accepted(program.identity());
  for (std::size_t i = 0; i < program.commands().size(); ++i)
    if (stems.contains("GetError") || specified.errors[i].empty()) accepted.add(program.commands()[i]);
  const std::optional<gl::Case> reduced = with_stems_of(minimal, accepted);
  return reduced && is_interesting(*reduced) && std::ranges::none_of(stems, [&](const std::string& stem) {
           return is_interesting(without_stem(*reduced, stem));
         });
}

Alikeness::Alikeness(const gl::Case& program)
    : keeps_to_grids_(keeps_to_grids(program)),
      keeps_to_maps_(keeps_to_maps(program)),
      calls_missing_list_(calls_missing_list(program)) {}

bool Alikeness::holds_for(const gl::Case& candidate, InitialMaps initial_maps) const {
  return (calls_missing_list_ || !calls_missing_list(candidate)) &&
         (!keeps_to_grids_ || keeps_to_grids(candidate)) &&
         (!keeps_to_maps_ || initial_maps == InitialMaps::kAllowed || keeps_to_maps(candidate));
}

Reducer::Reducer(const Subject& subject, SharedContext* shared, int most_attempts, Hooks hooks)
    : subject_(subject),
      shared_(shared),
      table_(subject.implementation->create_context()->table()),
      max_order_(subject.info.max_order()),
      most_attempts_(most_attempts),
      hooks_(std::move(hooks)) {
  for (const KnownProgram& program : known_programs())
    if (!program.record.difference.is_death())
      known_.push_back(
          {&program, program.program, program.record.difference, program.cause(max_order_), false, {}});
  // Bugs of the same product are likelier, and smaller programs recognise more.
  known_.sort([&](const Known& a, const Known& b) {
    const auto rank = [&](const Known& known) {
      const std::string& product = find_known_bug(known.record->bug)->affects.product;
      return std::pair(subject_.info.version.find(product) == std::string::npos,
                       known.program.commands().size());
    };
    return rank(a) < rank(b);
  });
}

Reducer::Judge Reducer::fresh() const {
  return
      [this](const gl::Case& program, const Specified& specified, Outcomes outcomes, Attributes attributes) {
        return judge_program(subject_, program, specified, outcomes, attributes);
      };
}

Reducer::Judge Reducer::in_shared() const {
  return
      [this](const gl::Case& program, const Specified& specified, Outcomes outcomes, Attributes attributes) {
        return shared_->judge_aside(program, specified, outcomes, attributes);
      };
}

std::optional<Finding> Reducer::difference_of(const gl::Case& candidate, const Difference& difference,
                                              const Judge& judge) const {
  if (is_over() ||
      with_what_exists(subject_.info, table_, candidate).commands().size() < candidate.commands().size())
    return {};
  const std::optional<Specified> specified = specify_if_defined(candidate, max_order_);
  if (!specified) return {};
  if (hooks_.try_start && !hooks_.try_start(candidate)) {
    ++not_started_;
    return {};
  }
  const Judged judged =
      judge(candidate, *specified, outcomes_of(difference.kind), attributes_of(difference.kind));
  const auto found = std::ranges::find_if(
      judged.failures, [&](const Failure& failure) { return failure.difference.is_like(difference); });
  return found == judged.failures.end() ? std::nullopt : std::optional(Finding{candidate, *found});
}

std::optional<Finding> Reducer::find(const gl::Case& program, const Difference& difference) const {
  std::optional<Finding> found = difference_of(program, difference, fresh());
  if (hooks_.finish) hooks_.finish();
  return found;
}

bool Reducer::is_minimal(const gl::Case& program, const Difference& difference) const {
  const auto shows = [&](const gl::Case& part) {
    if (shared() && !difference_of(part, difference, in_shared())) return false;
    return difference_of(part, difference, fresh()).has_value();
  };
  const std::vector<gl::Case> parts = parts_of(program);
  return std::ranges::none_of(parts, shows);
}

const Finding* Reducer::finding_of(Known& known) {
  if (known.was_run || !known.record) return known.finding ? &*known.finding : nullptr;
  if (is_over()) return nullptr;
  const std::size_t not_started = not_started_;
  std::optional<Finding> found = find(known.program, known.difference);
  const bool is_shown = found && known.record->is_shown_by(found->failure) &&
                        is_minimal(known.program, found->failure.difference);
  if (is_over() || not_started_ != not_started) return nullptr;  // not all programs have run
  known.was_run = true;
  if (!is_shown) return nullptr;
  name_finding(*found, max_order_);
  found->known = known.record->bug;
  known.finding = std::move(found);
  return &*known.finding;
}

const Finding* Reducer::explanation(const gl::Case& program, const Difference& difference,
                                    bool tries_shared) {
  const Judge judge = tries_shared ? in_shared() : fresh();
  const Alikeness alikeness(program);
  for (const gl::Case& form : forms_of(program)) {
    const std::optional<Specified> specified = specify_if_defined(form, max_order_);
    if (!specified) continue;
    for (Known& known : known_) {
      if ((known.was_run && !known.finding) || !known.difference.is_like(difference)) continue;
      // The programs of the register are short, and many of them define no map.
      const auto initial_maps =
          known.record ? Alikeness::InitialMaps::kAllowed : Alikeness::InitialMaps::kNot;
      const InterestingnessTest is_interesting = [&](const gl::Case& candidate) {
        return alikeness.holds_for(candidate, initial_maps) && difference_of(candidate, difference, judge);
      };
      if (is_explained_by(known.program, form, *specified, is_interesting))
        if (const Finding* const finding = finding_of(known)) return finding;
    }
  }
  return nullptr;
}

std::optional<Finding> Reducer::recognise(const gl::Case& program, const Difference& difference) {
  if (!shared() || vertices_of(program) > kMostVertices) return {};
  const Finding* const known = explanation(program, difference, true);
  if (hooks_.finish) hooks_.finish();
  return known ? std::optional(*known) : std::nullopt;
}

std::optional<Finding> Reducer::prove(const std::string& bug) {
  for (const KnownProgram& program : known_programs())
    for (Known& known : known_)
      if (program.bug == bug && known.record == &program) {
        const Finding* const finding = finding_of(known);
        if (hooks_.finish) hooks_.finish();
        if (finding) return *finding;
      }
  return {};
}

void Reducer::name(Finding& finding) {
  name_finding(finding, max_order_);
  if (is_over()) return;  // it is perhaps not minimal
  for (Known& known : known_) {
    const std::string &relation = known.difference.relation, &found = finding.failure.difference.relation;
    if (!known.record || known.cause != finding.cause || (!relation.empty() && relation != found)) continue;
    if (const Finding* const other = finding_of(known)) {
      finding = *other;
      return;
    }
  }
  ++new_findings_;
  known_.push_front({nullptr, finding.program, finding.failure.difference, finding.cause, true, finding});
}

std::optional<Finding> Reducer::reduce(const gl::Case& program, const Difference& difference) {
  const bool is_large = vertices_of(program) > kMostVertices;
  // A part may differ in another way than the whole program, unless the difference is complete.
  const bool is_complete = !difference.place.empty() || !difference.relation.empty();
  std::optional<Finding> found;
  if (!is_large || !is_complete) found = find(program, difference);
  if (is_large && (found || is_complete)) {
    // Each run of a program that draws very much takes long. It has the bug of an earlier one if the same
    // commands alone show it (whether it needs each of them is not tried); otherwise a part of it is reduced.
    const Alikeness alikeness(program);
    const Difference wanted = found ? difference.completed_by(found->failure.difference) : difference;
    for (const Known& known : known_)
      if (known.finding && known.difference.is_like(wanted))
        if (const auto part = with_stems_of(known.program, program); part && alikeness.holds_for(*part))
          if (find(*part, wanted)) return known.finding;
    excerpt_of(program, [&](const gl::Case& part) {
      std::optional<Finding> of_part = difference_of(part, wanted, fresh());
      if (of_part) found = of_part;
      return of_part.has_value();
    });
    if (!found) found = find(program, difference);
  }
  if (hooks_.finish) hooks_.finish();
  return found ? std::optional(reduce(*std::move(found))) : std::nullopt;
}

Finding Reducer::reduce(Finding finding) {
  const Alikeness alikeness(finding.program);
  Difference difference = finding.failure.difference;
  // A candidate that still shows the difference takes the place of the finding.
  const InterestingnessTest keep_if_interesting = [&](const gl::Case& candidate) {
    if (!alikeness.holds_for(candidate)) return false;
    std::optional<Finding> found = difference_of(candidate, difference, fresh());
    if (!found) return false;
    finding = *std::move(found);
    difference = difference.completed_by(finding.failure.difference);
    return true;
  };
  const InterestingnessTest is_interesting_in_shared = [&](const gl::Case& candidate) {
    return alikeness.holds_for(candidate) &&
           difference_of(candidate, difference,
                         [&](const gl::Case& program, const Specified& specified, Outcomes outcomes,
                             Attributes attributes) {
                           return shared_->judge(program, specified, outcomes, attributes);
                         });
  };
  const auto finish = [&] {
    if (hooks_.finish) hooks_.finish();
    return finding;
  };
  const auto smaller = [&](const gl::Case&) {
    if (!hooks_.smaller) return;
    Finding named = finding;
    name_finding(named, max_order_);
    hooks_.smaller(named);
  };
  smaller(finding.program);  // in case the library dies during the reduction
  // A difference that shows without display lists as well is no bug of lists.
  if (gl::uses_lists(finding.program)) keep_if_interesting(gl::without_lists(finding.program));
  // Most differences have a known cause. The shared context quickly shows which one it may be.
  const bool uses_shared = shared() && vertices_of(finding.program) <= kMostVertices;
  if (const Finding* const known = explanation(finding.program, difference, uses_shared)) {
    finding = *known;
    return finish();
  }
  for (const std::string& stem : stems_of(finding.program))
    keep_if_interesting(without_stem(finding.program, stem));
  // The program is first shrunk in the shared context, where runs are cheap, so that few runs in fresh
  // contexts remain.
  if (uses_shared && is_interesting_in_shared(finding.program))
    keep_if_interesting(shrink(finding.program, is_interesting_in_shared, kInShared * most_attempts_));
  // Each run of a program that draws very much takes long, so it gets fewer attempts.
  const std::int64_t size = std::max<std::int64_t>(vertices_of(finding.program) / kMostVertices, 1);
  // The result is in `finding`: keep_if_interesting has kept the smallest program.
  shrink(finding.program, keep_if_interesting,
         most_attempts_ / static_cast<int>(std::min<std::int64_t>(size, most_attempts_)), smaller);
  // If a command that has to be rejected raises no error or a wrong one, this is closer to the cause than its
  // effects.
  const std::optional<Specified> specified = specify_if_defined(finding.program, max_order_);
  if (difference.kind != Difference::kError && specified && has_rejected_command(*specified))
    if (std::optional<Finding> error = difference_of(finding.program, {Difference::kError, "", ""}, fresh()))
      return reduce(*std::move(error));
  name(finding);
  return finish();
}

}  // namespace evalcts::fuzz
