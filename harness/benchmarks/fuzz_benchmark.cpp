// Benchmarks of random programs: commands per second that are generated, specified, run and judged on one
// core.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include <evalcts/backends/reused_context.h>
#include <evalcts/fuzz/finding.h>
#include <evalcts/fuzz/random_program.h>

namespace evalcts::fuzz {
namespace {

constexpr std::uint32_t kSeed = 1, kPrograms = 50;
constexpr int kMostOrder = 30;

// Generates programs, which runs each of them on the executable specification.
void Write(benchmark::State& state) {
  const auto length = static_cast<int>(state.range(0));
  std::uint64_t commands = 0;
  for (auto _ : state)
    for (std::uint32_t number = 0; number < kPrograms; ++number)
      commands += random_specified_program(kSeed, number, length, kMostOrder).program.commands().size();
  state.counters["commands"] = benchmark::Counter(static_cast<double>(commands), benchmark::Counter::kIsRate);
}

bool has_lists(const gl::Case& program) {
  return std::ranges::any_of(program.commands(), [](const gl::Command& command) {
    return command.entry == gl::EntryPoint::NewList || command.entry == gl::EntryPoint::CallList;
  });
}

// Runs and judges programs without a difference, because a difference costs hundreds of further runs.
// Display lists are left out for implementations on which they crash. Programs run in fresh contexts or in
// one shared context.
void Judge(benchmark::State& state, const char* name, bool with_lists, bool fresh) {
  std::unique_ptr<Implementation> implementation;
  Subject subject;
  try {
    implementation = open_implementation({.name = name});
    subject.implementation = implementation.get();
    subject.info = inquire(*implementation);
  } catch (const CannotStart& why) {
    return state.SkipWithError(why.what());
  }
  Captures captures(*implementation, subject.info);
  subject.captures = &captures;
  const int max_order = subject.info.max_order();
  std::vector<SpecifiedProgram> programs;
  for (std::uint32_t number = 0; programs.size() < kPrograms; ++number) {
    SpecifiedProgram program =
        random_specified_program(kSeed, number, static_cast<int>(state.range(0)), max_order);
    if (!with_lists && has_lists(program.program)) continue;
    if (judge_program(subject, program.program, program.specified).failures.empty())
      programs.push_back(std::move(program));
  }
  captures.prove_all();
  std::unique_ptr<Implementation> shared;
  if (!fresh) {
    shared = reuse_context(*implementation, subject.info, Programs::kKept);
    subject.implementation = shared.get();
  }
  if (!fresh)  // a warm-up, after which the library has all data that it keeps for a program
    for (const SpecifiedProgram& program : programs)
      judge_program(subject, program.program, program.specified);
  std::uint64_t commands = 0;
  for (auto _ : state)
    for (const SpecifiedProgram& program : programs) {
      benchmark::DoNotOptimize(judge_program(subject, program.program, program.specified));
      commands += program.program.commands().size();
    }
  state.counters["commands"] = benchmark::Counter(static_cast<double>(commands), benchmark::Counter::kIsRate);
}

BENCHMARK(Write)->Arg(120)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Judge, production, "production", true, true)->Arg(120)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Judge, osmesa, "osmesa", false, true)->Arg(120)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Judge, osmesa_in_one_context, "osmesa", false, false)
    ->Arg(20)
    ->Arg(120)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace evalcts::fuzz
