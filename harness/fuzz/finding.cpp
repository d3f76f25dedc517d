// Judges programs as tests without a name.
#include <evalcts/fuzz/finding.h>

#include <fmt/format.h>

#include <stdexcept>

namespace evalcts::fuzz {

gl::Case with_what_exists(const ImplementationInfo& info, const gl::Table& table, const gl::Case& program) {
  const auto is_declared = [&](const gl::Command& command) {
    return !info.declaration || undeclared_part(*info.declaration, command).empty();
  };
  gl::Case left(program.identity());
  for (const gl::Command& command : program.commands())
    if (gl::has(table, command.entry) && is_declared(command)) left.add(command);
  return left;
}

Judged judge_program(const Subject& subject, const gl::Case& program, const Specified& specified,
                     Outcomes outcomes, Attributes attributes) {
  TestRecord record;
  // The name determines if other captures check the first one (Schedule::is_cross_checked), which repetitions
  // do not need.
  record.name = outcomes == Outcomes::kAll ? program.identity() : "a smaller version";
  Test test(subject, record);
  test.run([&](Test& t) { t.judge_specified(program, specified, outcomes, attributes); });
  if (record.verdict == Verdict::kInternalError)
    throw std::logic_error(fmt::format("{}: {}", program.identity(), record.message));
  if (record.verdict == Verdict::kFail) return {record.failures, true, true};
  const bool passed = record.verdict == Verdict::kPass;
  return {{}, passed, passed && record.unobserved.empty()};
}

Outcomes outcomes_of(const std::string& kind) {
  return kind == Difference::kOrder                                  ? Outcomes::kOrder
         : kind == Difference::kAnswer || kind == Difference::kError ? Outcomes::kAnswers
                                                                     : Outcomes::kVertices;
}

Attributes attributes_of(const std::string& kind) {
  return kind == "position"             ? Attributes{kPosition}
         : kind == "color"              ? Attributes{kColor}
         : kind == "normal"             ? Attributes{kNormal}
         : kind == "texture coordinate" ? Attributes{kTextureCoordinate0 | kTextureCoordinatesOther}
                                        : Attributes{kAllAttributes};
}

}  // namespace evalcts::fuzz
