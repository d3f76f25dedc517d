#include "harness/fuzz/campaign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>

#include "harness/fuzz/legal.h"
#include "harness/fuzz/random_program.h"
#include "harness/fuzz/shrink.h"
#include "harness/gl/case_json.h"
#include "harness/gl/tokens.h"

namespace evalcts::fuzz {
namespace {

using gl::EntryPoint;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr auto kReportEvery = std::chrono::milliseconds(500);

// "position.x of vertex 3" -> "position".
std::string kind_of(const Failure& failure) {
  return failure.what.substr(0, failure.what.find_first_of(". "));
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

bool uses(const gl::Case& program, EntryPoint entry) {
  return std::ranges::any_of(program.commands(),
                             [&](const gl::Command& command) { return command.entry == entry; });
}
bool uses_stem(const gl::Case& program, std::string_view stem) {
  return std::ranges::any_of(program.commands(), [&](const gl::Command& command) {
    return without_form(std::string(gl::name_of(command.entry))) == stem;
  });
}

// The most special rule that the commands are about.
std::string requirement_of(const gl::Case& program, const Failure& failure) {
  const std::string kind = kind_of(failure);
  const bool two = uses_stem(program, "Map2") && !uses_stem(program, "Map1");
  if (kind.starts_with("glGetMap")) return two ? "EV-GETMAP-COEFF2" : "EV-GETMAP-COEFF1";
  if (kind == "glIsEnabled") return "EV-EN-GETS";
  if (kind == "glGetError") return two ? "EV-MAP2-ERR-NOEFFECT" : "EV-MAP1-ERR-NOEFFECT";
  if (uses(program, EntryPoint::NewList)) return "EV-DL-EXECUTE";
  if (uses(program, EntryPoint::PopAttrib)) return "EV-ATTRIB-EVALBIT";
  if (kind.starts_with("glGet")) return "EV-CUR-COLOR";
  if (uses(program, EntryPoint::EvalMesh1)) return "EV-MESH1-COORDS";
  if (uses(program, EntryPoint::EvalMesh2)) return "EV-MESH2-COORDS";
  return kind == "position" ? "EV-COORD-ASIF" : "EV-COORD-CURRENT";
}

}  // namespace

gl::Case with_commands_of(const gl::Table& table, const gl::Case& program) {
  gl::Case left(program.identity());
  for (const gl::Command& command : program.commands())
    if (gl::has(table, command.entry)) left.add(command);
  return left;
}

std::string cause_of(const gl::Case& program, const std::string& what) {
  std::set<std::string> words;
  for (const gl::Command& command : program.commands()) {
    const std::string word = without_form(std::string(gl::name_of(command.entry)));
    const auto* cap = command.arguments.empty() ? nullptr : std::get_if<std::int64_t>(&command.arguments[0]);
    words.insert(cap && *cap == GL_AUTO_NORMAL ? "AUTO_NORMAL" : word);
  }
  return fmt::format("{}: {}", fmt::join(words, ", "), what);
}

Judged judge_program(const Subject& subject, const gl::Case& program, Look look) {
  Record record;
  record.name = program.identity();
  Test test(subject, record);
  test.run([&](Test& t) { expect_as_specified(t, program, look); });
  if (record.verdict == Verdict::internal_error)
    throw std::logic_error(fmt::format("{}: {}", program.identity(), record.message));
  if (record.verdict != Verdict::fail) return {{}, record.verdict == Verdict::pass};
  const Failure& failure = record.failures.front();
  return {Finding{program, failure, cause_of(program, kind_of(failure)), requirement_of(program, failure)}};
}

json to_json(const Finding& finding) {
  return {{"program", gl::to_json(finding.program)}, {"cause", finding.cause},
          {"requirement", finding.requirement},      {"what", finding.failure.what},
          {"message", finding.failure.message},      {"expected", finding.failure.expected},
          {"captured", finding.failure.captured},    {"calls", finding.failure.calls}};
}

void play(const Subject& subject, const Campaign& campaign, const std::function<void(const json&)>& report) {
  const int max_order = std::clamp(subject.info.max_eval_order, 8, 64);
  report({{"event", "campaign"}, {"max_eval_order", max_order}});
  const Clock::time_point begin = Clock::now();
  Clock::time_point reported = begin;
  const gl::Table table = subject.implementation->create_context()->table();
  std::uint64_t programs = 0, judged = 0, commands = 0;
  const auto progress = [&] {
    report({{"event", "progress"}, {"programs", programs}, {"judged", judged}, {"commands", commands}});
    reported = Clock::now();
  };
  for (std::uint32_t number = campaign.first; !campaign.programs || programs < *campaign.programs;
       number += campaign.step) {
    if (campaign.seconds > 0 &&
        std::chrono::duration<double>(Clock::now() - begin).count() >= campaign.seconds)
      break;
    report({{"event", "start"}, {"name", fmt::format("program {}", number)}});
    const gl::Case program =
        with_commands_of(table, random_program(subject.seed, number, campaign.length, max_order));
    ++programs;
    if (!is_defined(program, max_order)) continue;  // for want of the commands that are missing
    Judged outcome = judge_program(subject, program);
    std::optional<Finding>& finding = outcome.finding;
    judged += outcome.judged;
    commands += program.commands().size();
    if (finding) {
      const std::string kind = kind_of(finding->failure);
      // What differs is an answer or a vertex: only that is looked at again.
      const Look look = kind.starts_with("gl") ? Look::answers : Look::vertices;
      const auto still = [&](const gl::Case& candidate) {
        if (!is_defined(candidate, max_order)) return false;
        std::optional<Finding> found = judge_program(subject, candidate, look).finding;
        if (!found || kind_of(found->failure) != kind) return false;
        finding = std::move(found);
        return true;
      };
      shrink(program, still, campaign.most_attempts, [&](const gl::Case& smaller) {
        report({{"event", "smaller"}, {"program", gl::to_json(smaller)}});
      });
      report({{"event", "finding"}, {"number", number}, {"finding", to_json(*finding)}});
    }
    if (Clock::now() - reported > kReportEvery) progress();
  }
  progress();
}

}  // namespace evalcts::fuzz
