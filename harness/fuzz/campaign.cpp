#include <evalcts/fuzz/campaign.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <fstream>
#include <set>
#include <stdexcept>

#include <evalcts/backends/reused_context.h>
#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/random_program.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/display_lists.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/gl/tokens.h>
#include "legal.h"
#include "shrink.h"

namespace evalcts::fuzz {
namespace {

using gl::EntryPoint;
using Clock = std::chrono::steady_clock;

constexpr auto kReportEvery = std::chrono::milliseconds(500);
constexpr double kGrace = 30;              // seconds after the end for a program that is being made smaller
constexpr std::uint64_t kFreshEvery = 16;  // one program of so many has a context of its own
constexpr std::size_t kMostHistory = 8;    // programs
constexpr int kInShared = 5;               // attempts for one in a fresh context

// "position.x of vertex 3" -> "position". Vertices too many or too few show in their number where all are
// points, else in the primitives.
constexpr char kPrimitives[] = "primitives";
std::string kind_of(const std::string& what) {
  const std::string kind = what.substr(0, what.find_first_of(". "));
  return kind == "number" ? kPrimitives : kind;
}

// "glMap1fv" -> "Map1": the form of the arguments does not make a cause.
std::string without_form(std::string name) {
  name = name.substr(2);
  for (const std::string_view stem :
       {"GetMap", "GetnMap", "MapGrid1", "MapGrid2", "Map1", "Map2", "EvalCoord1", "EvalCoord2", "Vertex"})
    if (name.starts_with(stem)) return std::string(stem);
  for (const std::string_view stem : {"MultiTexCoord", "TexCoord", "Color", "Normal", "Index", "EdgeFlag"})
    if (name.starts_with(stem)) return "current value";
  if (name == "GetFloatv" || name == "GetIntegerv" || name == "GetDoublev" || name == "GetBooleanv")
    return "Get";
  return name;
}

// The word for a command in a cause.
std::string word_of(const gl::Command& command) {
  const auto* cap = command.arguments.empty() ? nullptr : std::get_if<std::int64_t>(&command.arguments[0]);
  return cap && *cap == GL_AUTO_NORMAL ? "AUTO_NORMAL"
                                       : without_form(std::string(gl::name_of(command.entry)));
}

std::set<std::string> words_of(const gl::Case& program) {
  std::set<std::string> words;
  for (const gl::Command& command : program.commands()) words.insert(word_of(command));
  return words;
}

gl::Case without_word(const gl::Case& program, const std::string& word) {
  gl::Case without(program.identity());
  for (const gl::Command& command : program.commands())
    if (word_of(command) != word) without.add(command);
  return without;
}

bool uses(const gl::Case& program, EntryPoint entry) {
  return std::ranges::any_of(program.commands(),
                             [&](const gl::Command& command) { return command.entry == entry; });
}
bool uses_stem(const gl::Case& program, std::string_view stem) {
  return std::ranges::any_of(program.commands(), [&](const gl::Command& command) {
    return without_form(std::string(gl::name_of(command.entry))) == stem;
  });
}

bool has_argument(const gl::Case& program, EntryPoint entry, std::size_t position, std::int64_t wanted) {
  return std::ranges::any_of(program.commands(), [&](const gl::Command& command) {
    if (command.entry != entry || command.arguments.size() <= position) return false;
    const auto* value = std::get_if<std::int64_t>(&command.arguments[position]);
    return value && *value == wanted;
  });
}

// Whether it evaluates where no map makes vertices.
bool evaluates_without_vertices(const gl::Case& program) {
  const auto enables = [&](GLenum cap) { return has_argument(program, EntryPoint::Enable, 0, cap); };
  return (uses_stem(program, "EvalCoord1") && !enables(GL_MAP1_VERTEX_3) && !enables(GL_MAP1_VERTEX_4)) ||
         (uses_stem(program, "EvalCoord2") && !enables(GL_MAP2_VERTEX_3) && !enables(GL_MAP2_VERTEX_4));
}

bool calls_in_a_list(const gl::Case& program) {
  bool open = false;
  for (const gl::Command& command : program.commands()) {
    if (command.entry == EntryPoint::NewList) open = true;
    if (command.entry == EntryPoint::EndList) open = false;
    if (open && command.entry == EntryPoint::CallList) return true;
  }
  return false;
}

}  // namespace

gl::Case with_what_exists(const ImplementationInfo& info, const gl::Table& table, const gl::Case& program) {
  const auto is_declared = [&](const gl::Command& command) {
    return !info.declaration || undeclared_part(*info.declaration, command).empty();
  };
  gl::Case left(program.identity());
  for (const gl::Command& command : program.commands())
    if (gl::has(table, command.entry) && is_declared(command)) left.add(command);
  return left;
}

std::string cause_of(const gl::Case& program, const std::string& what) {
  return fmt::format("{}: {}", fmt::join(words_of(program), ", "), kind_of(what));
}

std::string requirement_of(const gl::Case& program, const std::string& what) {
  const std::string kind = kind_of(what);
  const bool two = uses_stem(program, "Map2") && !uses_stem(program, "Map1");
  const bool list = uses(program, EntryPoint::NewList);
  if (kind == "crash" || kind == "timeout") {
    if (!list) return "EV-NUM-SPECIAL-SAFE";
    return calls_in_a_list(program) ? "EV-DL-NESTED" : "EV-DL-EXECUTE";
  }
  if (kind.starts_with("glGetMap")) return two ? "EV-GETMAP-COEFF2" : "EV-GETMAP-COEFF1";
  if (kind == "glIsEnabled") return "EV-EN-GETS";
  if (kind == "glGetError" && list) return "EV-DL-ERR-ALL";
  if (kind == "glGetError") return two ? "EV-MAP2-ERR-NOEFFECT" : "EV-MAP1-ERR-NOEFFECT";
  if (has_argument(program, EntryPoint::NewList, 1, GL_COMPILE_AND_EXECUTE)) return "EV-DL-COMPEXEC";
  if (evaluates_without_vertices(program))
    return has_argument(program, EntryPoint::Enable, 0, GL_AUTO_NORMAL) ? "EV-AUTON-NOVERTEX"
                                                                        : "EV-COORD-NOVERTEX";
  if (list) return "EV-DL-EXECUTE";
  if (kind == "position" && has_argument(program, EntryPoint::Enable, 0, GL_AUTO_NORMAL))
    return "EV-AUTON-SAMEVERTEX";
  if (uses(program, EntryPoint::PopAttrib)) return "EV-ATTRIB-EVALBIT";
  if (has_argument(program, EntryPoint::GetFloatv, 0, GL_CURRENT_NORMAL))
    return has_argument(program, EntryPoint::Enable, 0, GL_AUTO_NORMAL) ? "EV-AUTON-CURRENT"
                                                                        : "EV-CUR-NORMAL";
  if (has_argument(program, EntryPoint::GetFloatv, 0, GL_CURRENT_TEXTURE_COORDS)) return "EV-CUR-TEX";
  if (kind.starts_with("glGet")) return "EV-CUR-COLOR";
  if (kind != "position" && kind != kPrimitives)
    return uses_stem(program, "Vertex") ? "EV-CUR-NEXTVERTEX" : "EV-COORD-CURRENT";
  if (uses(program, EntryPoint::EvalMesh1)) return "EV-MESH1-COORDS";
  if (uses(program, EntryPoint::EvalMesh2)) return "EV-MESH2-COORDS";
  return "EV-COORD-ASIF";
}

std::optional<gl::Case> reduced_to(const std::string& cause, const gl::Case& program,
                                   const Specified& specified,
                                   const std::function<bool(const gl::Case&)>& still) {
  const std::string words = ", " + cause.substr(0, cause.find(": ")) + ", ";
  const auto has_word = [&](const std::string& word) {
    return words.find(", " + word + ", ") != std::string::npos;
  };
  const bool errors = has_word("GetError");
  gl::Case reduced(program.identity());
  for (std::size_t i = 0; i < program.commands().size(); ++i) {
    const gl::Command& command = program.commands()[i];
    if (has_word(word_of(command)) && (errors || specified.errors[i].empty())) reduced.add(command);
  }
  const std::set<std::string> needed = words_of(reduced);
  if (fmt::format(", {}, ", fmt::join(needed, ", ")) != words || !still(reduced)) return std::nullopt;
  for (const std::string& word : needed)
    if (still(without_word(reduced, word))) return std::nullopt;
  return reduced;
}

namespace {

// The program without commands that define, enable or ask for maps and grids.
gl::Case without_maps(const gl::Case& program) {
  const auto is_about_maps = [](const gl::Command& command) {
    if (gl::name_of(command.entry).find("Map") != std::string_view::npos) return true;
    if (command.entry != EntryPoint::Enable && command.entry != EntryPoint::Disable &&
        command.entry != EntryPoint::IsEnabled)
      return false;
    const auto* cap = std::get_if<std::int64_t>(&command.arguments[0]);
    return cap && (*cap == GL_AUTO_NORMAL || gl::components_of(static_cast<GLenum>(*cap)) > 0);
  };
  gl::Case left(program.identity());
  for (const gl::Command& command : program.commands())
    if (!is_about_maps(command)) left.add(command);
  return left;
}

}  // namespace

gl::Case without_evaluators(const gl::Case& program) {
  return without_maps(gl::with_explicit_vertices(program));
}

std::vector<gl::Case> controls_without_evaluators(const gl::Case& program) {
  std::vector<gl::Case> controls = {without_evaluators(program),
                                    without_maps(gl::with_explicit_commands(program))};
  if (gl::uses_lists(program)) controls.push_back(without_maps(gl::with_calls_of_no_list(program)));
  return controls;
}

Judged judge_program(const Subject& subject, const gl::Case& program, const Specified& specified, Look look) {
  TestRecord record;
  // Of some names the other captures check the first: not of what is only looked at again.
  record.name = look == Look::all ? program.identity() : "a smaller version";
  Test test(subject, record);
  test.run([&](Test& t) { expect_as_specified(t, program, specified, look); });
  if (record.verdict == Verdict::kInternalError)
    throw std::logic_error(fmt::format("{}: {}", program.identity(), record.message));
  const bool passed = record.verdict == Verdict::kPass;
  if (record.verdict != Verdict::kFail) return {{}, passed, passed && record.unobserved.empty()};
  const Failure& failure = record.failures.front();
  return {Finding{program, failure, cause_of(program, failure.what), requirement_of(program, failure.what)}};
}

namespace {

// Drops definitions of maps of higher orders: not known to be accepted, and not known to be rejected.
gl::Case without_orders_above(const gl::Case& program, int limit) {
  gl::Case left(program.identity());
  for (const gl::Command& command : program.commands())
    if (gl::largest_order(command) <= limit) left.add(command);
  return left;
}

// One context for many programs, beside the fresh ones of others.
class SharedContext {
 public:
  // Null where the implementation makes no such contexts, or none is needed: a sink is as fast without.
  static std::unique_ptr<SharedContext> of(const Subject& fresh) {
    const std::unique_ptr<Context> one = fresh.implementation->create_beside();
    return one && !one->has_sink() ? std::make_unique<SharedContext>(fresh) : nullptr;
  }

  explicit SharedContext(const Subject& fresh) : beside_(*fresh.implementation), subject_(fresh) { renew(); }

  Judged judge(const gl::Case& program, const Specified& specified, Look look = Look::all) {
    history_.push_back(program);
    if (history_.size() > kMostHistory + 1) history_.pop_front();
    return judge_program(subject_, program, specified, look);
  }

  // The program that was judged last, behind so many that were played before it; empty where there were less.
  gl::Case behind(std::size_t count) const {
    gl::Case joint(history_.back().identity());
    if (count >= history_.size()) return joint;
    for (std::size_t i = history_.size() - 1 - count; i < history_.size(); ++i) joint.append(history_[i]);
    return joint;
  }

  void renew() {
    reused_ = nullptr;
    reused_ = reuse_context(beside_, subject_.info, Programs::kept);
    subject_.implementation = reused_.get();
    history_.clear();
  }

 private:
  // Current again whenever something is played: the first of each case is what restores its state.
  class BesideContext final : public Context {
   public:
    explicit BesideContext(std::unique_ptr<Context> inner) : inner_(std::move(inner)) {}
    const gl::Table& table() const override { return inner_->table(); }
    gl::Trace play(const gl::Case& script) override {
      inner_->make_current();
      return inner_->play(script);
    }

   private:
    std::unique_ptr<Context> inner_;
  };
  class Beside final : public Implementation {
   public:
    explicit Beside(Implementation& inner) : inner_(inner) {}
    std::string name() const override { return inner_.name(); }
    std::string library() const override { return inner_.library(); }
    std::unique_ptr<Context> create_context() override {
      std::unique_ptr<Context> context = inner_.create_beside();
      if (!context) throw CannotStart("there is no room for another context");
      return std::make_unique<BesideContext>(std::move(context));
    }

   private:
    Implementation& inner_;
  };

  Beside beside_;
  Subject subject_;
  std::unique_ptr<Implementation> reused_;
  std::deque<gl::Case> history_;
};

class Player {
 public:
  using Report = std::function<void(const CampaignEvent&)>;

  Player(const Subject& subject, const Campaign& campaign, const Report& report)
      : subject_(subject),
        campaign_(campaign),
        report_(report),
        table_(subject.implementation->create_context()->table()),
        max_order_(subject.info.max_order()),
        knows_limit_(max_order_ == subject.info.max_eval_order),
        causes_(campaign.known),
        shared_(campaign.fresh_contexts ? nullptr : SharedContext::of(subject)) {
    // A cause that needs fewer commands comes first: where both show, it is the one.
    std::ranges::stable_sort(causes_, {}, &std::string::size);
  }

  void play() {
    report_(CampaignStarted{max_order_});
    for (std::uint32_t number = campaign_.first; goes_on(); number += campaign_.step) {
      report_(TestStarted{fmt::format("program {}", number)});
      play(number);
      report_progress_now_and_then();
    }
    report_progress();
  }

 private:
  bool goes_on() const { return !is_over(0) && !(campaign_.programs && programs_ >= *campaign_.programs); }
  // Whether the time has been over for so many seconds.
  bool is_over(double seconds) const {
    return campaign_.seconds > 0 &&
           std::chrono::duration<double>(Clock::now() - begin_).count() >= campaign_.seconds + seconds;
  }

  void report_progress_now_and_then() {
    if (Clock::now() - reported_ > kReportEvery) report_progress();
  }

  void report_progress() {
    report_(CampaignProgress{programs_, judged_, in_full_, commands_, not_repeated_});
    reported_ = Clock::now();
  }

  void play(std::uint32_t number) {
    auto [program, specified] = random_specified_program(subject_.seed, number, campaign_.length, max_order_);
    ++programs_;
    gl::Case left = with_what_exists(subject_.info, table_, program);
    if (!knows_limit_) left = without_orders_above(left, max_order_);
    if (left.commands().size() < program.commands().size()) {
      std::optional<Specified> of_left = specify_if_defined(left, max_order_);
      if (!of_left) return;
      program = std::move(left);
      specified = *std::move(of_left);
    }
    const bool shares = shared_ && programs_ % kFreshEvery != 0;
    const Judged outcome =
        shares ? shared_->judge(program, specified) : judge_program(subject_, program, specified);
    judged_ += outcome.judged;
    in_full_ += outcome.in_full;
    commands_ += program.commands().size();
    std::optional<Finding> found = outcome.finding;
    if (found && shares) found = repeated(program, specified);
    if (!found) return;
    const gl::Case shown = found->program;
    const Finding finding = explain(shown, *std::move(found));
    report_(FindingMade{number, finding});
  }

  // What differed in the shared context, in a fresh one: the program, or it behind some that were played
  // there before.
  std::optional<Finding> repeated(const gl::Case& program, const Specified& specified) {
    if (std::optional<Finding> alone = judge_program(subject_, program, specified).finding) return alone;
    std::optional<Finding> found;
    for (std::size_t count = 1; count <= kMostHistory && !found; count *= 2) {
      const gl::Case joint = shared_->behind(count);
      const std::optional<Specified> of_joint = specify_if_defined(joint, max_order_);
      if (of_joint && !joint.commands().empty() && takes_off(joint))
        found = judge_program(subject_, joint, *of_joint).finding;
    }
    landed();
    not_repeated_ += !found;
    shared_->renew();  // what no call restores is not as in a fresh one
    return found;
  }

  // What shows the cause of the difference, as small as can be where the cause is new.
  Finding explain(const gl::Case& program, Finding finding) {
    const std::string kind = kind_of(finding.failure.what);
    // What differs is an answer or a vertex: only that is looked at again.
    const Look look = kind.starts_with("gl") ? Look::answers : Look::vertices;
    std::string wanted = kind;
    const auto look_at = [&](const gl::Case& candidate, const auto& judge) -> std::optional<Finding> {
      report_progress_now_and_then();  // and shows that it goes on
      if (is_over(kGrace) ||
          with_what_exists(subject_.info, table_, candidate).commands().size() < candidate.commands().size())
        return {};
      const std::optional<Specified> of_candidate = specify_if_defined(candidate, max_order_);
      if (!of_candidate || !takes_off(candidate)) return {};
      std::optional<Finding> found = judge(candidate, *of_candidate).finding;
      return found && kind_of(found->failure.what) == wanted ? std::move(found) : std::nullopt;
    };
    bool outside = false;
    const auto still = [&](const gl::Case& candidate) {
      std::optional<Finding> found = look_at(candidate, [&](const gl::Case& c, const Specified& specified) {
        return judge_program(subject_, c, specified, look);
      });
      if (!found) return false;
      finding = *std::move(found);
      finding.outside_evaluators = outside;
      return true;
    };
    const auto still_in_shared = [&](const gl::Case& candidate) {
      return look_at(candidate,
                     [&](const gl::Case& c, const Specified& specified) {
                       return shared_->judge(c, specified, look);
                     })
          .has_value();
    };
    // Most differences are of a cause that has been seen: the commands of that alone show it then. Which one
    // it can be, is soon known in the shared context.
    const std::vector<gl::Case> forms = forms_of(program);
    const auto is_known = [&](bool in_shared) {
      for (const gl::Case& form : forms) {
        const std::optional<Specified> of_form = specify_if_defined(form, max_order_);
        for (const std::string& cause : causes_)
          if (of_form && cause.ends_with(": " + wanted) &&
              (!in_shared || reduced_to(cause, form, *of_form, still_in_shared)) &&
              reduced_to(cause, form, *of_form, still)) {
            finding.cause = cause;
            return true;
          }
      }
      return false;
    };
    bool known = (shared_ && is_known(true)) || is_known(false);
    if (!known && look == Look::vertices && kind != kPrimitives) {
      // Where vertices are lost and others come twice, their number is right and nothing else of them.
      wanted = kPrimitives;
      known = is_known(false);
      wanted = kind;
    }
    if (known) {
      landed();
      return finding;
    }
    const auto smaller = [&](const gl::Case&) { report_(FindingShrank{finding}); };
    // Where it goes wrong with the control as well, that stands for it, whose cause names no evaluation: it
    // cannot hide what only that shows.
    gl::Case shown = program;
    const auto shows_outside = [&](const gl::Case& control) {
      outside = true;
      return outside = still(control);
    };
    int most = campaign_.most_attempts;
    if (shows_outside(without_evaluators(program))) {
      shown = finding.program;
      most /= 4;  // nobody has to debug that
    }
    smaller(shown);  // so that it is not lost where the library dies on the way
    for (const std::string& word : words_of(shown))
      if (still(without_word(shown, word))) shown = finding.program;
    // All the way in the shared context first, where a program costs little: from there it is short in fresh
    // ones. Not where it leads to programs that the library dies in.
    if (shared_ && campaign_.deadly.empty() && still_in_shared(shown)) {
      const gl::Case small = shrink(shown, still_in_shared, kInShared * most);
      if (still(small)) shown = small;
    }
    shrink(shown, still, most, smaller);
    if (!outside) shows_outside(without_evaluators(gl::Case(finding.program)));
    causes_.push_back(finding.cause);
    landed();
    return finding;
  }

  // Leaves word of the program that is played next. False where the library has died in it before.
  bool takes_off(const gl::Case& candidate) const {
    if (campaign_.in_flight.empty()) return true;
    const std::string text = gl::to_text(candidate);
    if (std::ranges::count(campaign_.deadly, text) > 0) return false;
    std::ofstream(campaign_.in_flight) << text;
    return true;
  }
  void landed() const {
    if (!campaign_.in_flight.empty()) std::ofstream(campaign_.in_flight).flush();
  }

  const Subject& subject_;
  const Campaign& campaign_;
  const Report& report_;
  const gl::Table table_;
  const int max_order_;
  const bool knows_limit_;  // orders above max_order_ are rejected
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point reported_ = begin_;
  std::uint64_t programs_ = 0, judged_ = 0, in_full_ = 0, commands_ = 0, not_repeated_ = 0;
  std::vector<std::string> causes_;        // that have been seen
  std::unique_ptr<SharedContext> shared_;  // may be null
};

}  // namespace

void play(const Subject& subject, const Campaign& campaign,
          const std::function<void(const CampaignEvent&)>& report) {
  Player(subject, campaign, report).play();
}

}  // namespace evalcts::fuzz
