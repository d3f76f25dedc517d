// Tests sweeps: comparison with the exact route value by value, digests, shards, resumption, and the command.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <limits>
#include <thread>

#include <reference/bernstein_form.h>
#include <reference/rounding.h>

#include <evalcts/accuracy/checkpoint.h>
#include <evalcts/accuracy/exact_line.h>
#include <evalcts/accuracy/table.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/vectors/json_schema.h>
#include "program.h"

namespace evalcts::accuracy {
namespace {

using nlohmann::json;

const std::atomic<bool> kNever = false;

SweepState swept(const SweepTask& task, const StreamSource& source, int threads = 2) {
  SweepState state{BlockSet(task.blocks()), {}};
  sweep(task, source, threads, state, kNever, [](const SweepState&) {});
  return state;
}

bool operator==(const SweepResult::Largest& a, const SweepResult::Largest& b) {
  return a.error == b.error && a.number == b.number &&
         std::bit_cast<std::uint32_t>(a.got) == std::bit_cast<std::uint32_t>(b.got);
}

void expect_same(const SweepResult& a, const SweepResult& b) {
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.decided_exactly, b.decided_exactly);
  EXPECT_EQ(a.not_correctly_rounded, b.not_correctly_rounded);
  EXPECT_EQ(a.not_finite, b.not_finite);
  EXPECT_EQ(a.zeros, b.zeros);
  EXPECT_EQ(a.zeros_wrong, b.zeros_wrong);
  EXPECT_EQ(a.histogram, b.histogram);
  EXPECT_TRUE(a.ulp == b.ulp);
  EXPECT_TRUE(a.condition_aware == b.condition_aware);
  EXPECT_EQ(a.digest, b.digest);
}

TEST(ExactLine, RoundsAsTheExactRouteDoes) {
  Random random(20240611, 0);
  int lines = 0;
  for (int trial = 0; trial < 400; ++trial) {
    // Chooses the first and the last point, and points between them if these are floats.
    const bool integers = random.once_in(2);
    const auto end = [&] {
      return integers ? static_cast<double>(random.below(2000)) - 1000
                      : static_cast<double>(static_cast<float>(
                            random.scaled(-1, 1, static_cast<int>(random.below(40)) - 20)));
    };
    const double first = end(), last = random.once_in(9) ? first : end();
    const std::vector<double> points = {first, (first + last) / 2, last};
    if (static_cast<double>(static_cast<float>(points[1])) != points[1]) continue;
    const auto line = ExactLine::of(points);
    if (!line) continue;
    ++lines;
    const reference::BernsteinForm exact(reference::Curve{points.data(), 1, 3, 0, 1});
    for (int i = 0; i < 200; ++i) {
      const float u = i < 10 ? static_cast<float>(i - 5) / 4
                             : static_cast<float>(random.scaled(-1, 1, -static_cast<int>(random.below(150))));
      if (std::abs(u) > line->reach()) continue;
      ASSERT_EQ(line->to_float(u), exact.to_float(reference::Argument::coordinate(u)))
          << first << " " << last << " " << u;
    }
  }
  EXPECT_GT(lines, 100);
}

// The exact value is close to a tie of floats, and would become the tie if it were first rounded to double.
TEST(ExactLine, IsNotRoundedTwice) {
  const std::vector<double> points = {1 + 0x1p-23, 2 - 0x1p-20 + 0x1p-23};
  const auto line = ExactLine::of(points);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->to_float(0x1p-24F * (1 + 0x1p-20F)), 1 + 0x1p-23F);
}

TEST(ExactLine, IsOnlyOfLines) {
  const auto reach = [](const std::vector<double>& points) { return ExactLine::of(points).value().reach(); };
  for (const std::vector<double>& line : {std::vector<double>{0, 1, 2, 3}, {5}, {5, 5, 5}})
    EXPECT_TRUE(std::isinf(reach(line)));
  for (const std::vector<double>& curve :
       {std::vector<double>{0, 1, 2, 4}, {0, 0x1.000002p0, 2}, {1, 1, 2}, {0, 1, 0}, {0, 1, 4, 9}}) {
    EXPECT_LT(reach(curve), 0x1p-11) << curve[1];
    EXPECT_GT(reach(curve), 0x1p-40) << curve[1];
  }
  EXPECT_FALSE(ExactLine::of({0, 0, 1})) << "nothing but a rest";
  EXPECT_FALSE(ExactLine::of({1, 0x1p-40})) << "no short difference";
  EXPECT_FALSE(ExactLine::of({1, 0x1p-140})) << "no difference in double";
}

// Near zero, most values for small integers as control points are so close to a tie that only the exact value
// shows on which side they are.
TEST(ExactLine, KnowsTheSideNearZero) {
  Random random(20240612, 0);
  int tried = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> points(3 + random.below(4));
    for (double& point : points) point = static_cast<double>(random.below(19)) - 9;
    if (random.once_in(3)) points[1] = points[0];  // slope 0 at the start
    if (random.once_in(3)) points[0] = 0;
    const auto line = ExactLine::of(points);
    if (!line || std::isinf(line->reach())) continue;
    ++tried;
    const reference::BernsteinForm exact(
        reference::Curve{points.data(), 1, static_cast<int>(points.size()), 0, 1});
    const auto reach = static_cast<float>(line->reach());
    for (int i = 0; i < 100; ++i) {
      auto u = static_cast<float>(random.scaled(-1, 1, -static_cast<int>(random.below(148))));
      if (i == 0) u = reach;
      if (i == 1) u = -reach;
      if (i == 2) u = std::nextafter(reach, 0.0F);
      if (i > 50) u *= reach;
      if (std::abs(u) > reach) continue;
      ASSERT_EQ(std::bit_cast<std::uint32_t>(line->to_float(u)),
                std::bit_cast<std::uint32_t>(exact.to_float(reference::Argument::coordinate(u))))
          << testing::PrintToString(points) << " " << u;
    }
  }
  EXPECT_GT(tried, 150);
}

TEST(FloatNumbers, AreInOrder) {
  EXPECT_EQ(number_of(0.0F), 0);
  EXPECT_EQ(number_of(-0.0F), 0);
  EXPECT_EQ(number_of(0x1p-149F), 1);
  EXPECT_EQ(number_of(-0x1p-149F), -1);
  EXPECT_EQ(number_of(1.0F) + 1, 1065353217) << "floats from 0 to 1";
  for (const float x : {0.0F, 1.5F, -1.5F, 0x1p-130F, std::numeric_limits<float>::max()}) {
    EXPECT_EQ(float_of(number_of(x)), x);
    EXPECT_EQ(number_of(std::nextafter(x, -INFINITY)), number_of(x) - 1);
  }
}

// The counts of a sweep are equal to those of the exact route, applied to each argument.
TEST(Sweep, CountsWhatTheExactRouteCounts) {
  struct Trial {
    const char* name;
    std::vector<double> points;
    float from, to;
  };
  for (const Trial& trial : {Trial{"sum-float", {0.125, 0.75, -0.5, 0.875}, 0.3F, 0.302F},
                             {"horner-float", {1, -1, 1, -1}, 0.4999F, 0.5001F},
                             {"casteljau-float", {0, 1, 2, 3}, 0.3F, 0.3005F},
                             {"sum-float", {3, 2, 1, 0}, 0.99999F, 1.00001F},
                             {"sum-double", {0, 0x1p-140, 0}, 0, 0x1p-147F},
                             {"sum-float", {0, 0x1p-130, -0x1p-130}, 0.66F, 0.6605F},
                             {"horner-float", {0x1.fp127, 0x1.ep127, 0x1.fp127}, -0.01F, -0.00995F},
                             {"horner-float", {1, -1, 1, -1, 1, -1, 1, -1, 1, -1}, 0.49995F, 0.50005F},
                             {"casteljau-float", {3, 1, 4, 1, 5}, -0x1p-140F, 0x1p-140F}}) {
    const SweepTask task{trial.points, trial.from, trial.to};
    const SweepResult got = swept(task, stream_source({trial.name})).result;
    Errors want;
    Input input{static_cast<int>(trial.points.size()), 1, false, trial.points};
    const std::unique_ptr<Subject> subject = make_textbook(trial.name);
    std::uint64_t wrong_finite = 0;
    for (std::int64_t n = number_of(trial.from); n <= number_of(trial.to); ++n) {
      input.u = float_of(n);
      const reference::Evaluation exact =
          reference::evaluate_with_magnitude(input.surface(), input.argument_u(), input.argument_v());
      const float result = replay(*subject, "texture_coord_1", input);
      want.add(result, exact, input);
      if (!exact.value.is_zero() && std::isfinite(result) && result != reference::round_to_float(exact.value))
        ++wrong_finite;
    }
    SCOPED_TRACE(std::string(trial.name) + " at " + std::to_string(trial.from));
    EXPECT_EQ(got.values, want.values + want.zeros + want.without_terms);
    EXPECT_EQ(got.not_correctly_rounded, want.not_correctly_rounded);
    EXPECT_EQ(got.not_finite, want.not_finite);
    EXPECT_EQ(got.zeros, want.zeros + want.without_terms);
    EXPECT_EQ(got.zeros_wrong, want.zeros_wrong + want.without_terms_wrong);
    std::uint64_t in_bins = 0;
    for (std::size_t bin = 1; bin < Errors::kBins; ++bin) {
      EXPECT_LE(got.histogram[bin], want.histogram[bin]);
      in_bins += got.histogram[bin];
    }
    EXPECT_EQ(in_bins + got.histogram[0], wrong_finite);
    for (std::size_t bin = 2; bin < Errors::kBins; ++bin) EXPECT_EQ(got.histogram[bin], want.histogram[bin]);
    if (want.not_correctly_rounded == 0) {
      EXPECT_EQ(got.ulp.error, 0);
      continue;
    }
    EXPECT_TRUE(got.ulp.error == want.ulp.error || got.ulp.error > want.ulp.error * (1 - 1e-8))
        << got.ulp.error << " " << want.ulp.error;
    EXPECT_LE(got.ulp.error, want.ulp.error);
    // `want` also includes correctly rounded results, whose errors are small.
    EXPECT_LE(got.condition_aware.error, want.condition_aware.error);
    if (want.condition_aware.got != want.condition_aware.right) {
      EXPECT_GT(got.condition_aware.error, want.condition_aware.error * (1 - 1e-8));
    }
  }
}

// Sweeps surfaces along either argument, all targets, and each component separately.
TEST(Sweep, GoesAlongAnyMap) {
  Random random(7, 0);
  int reduced = 0;
  for (const std::string& target : target_names())
    for (const char* along : {"curve", "u", "v"})
      for (const float other : {0.5F, 0.3F}) {
        SweptMap what;
        what.target = target;
        what.two_dimensional = along != std::string("curve");
        if (!what.two_dimensional && other == 0.3F) continue;
        what.map.uorder = 3;
        what.map.vorder = what.two_dimensional ? 4 : 1;
        what.map.components = gl::components_of(target_of(target, what.two_dimensional));
        draw_points(what.map, {3, what.two_dimensional ? 4 : 0, "ordinary"}, random);
        what.along_v = along == std::string("v");
        what.other = what.two_dimensional ? other : 0;
        SCOPED_TRACE(target + " " + along);
        const SweepTask task{what, 0.7F, 0.70003F};
        const SweepResult got = swept(task, stream_source({"sum-float"})).result;
        Errors want;
        const auto subject = make_textbook("sum-float");
        for (int k = 0; k < what.map.components; ++k) {
          Input input{3, what.map.vorder, what.two_dimensional, {}};
          for (std::size_t i = k; i < what.map.points.size(); i += what.map.components)
            input.points.push_back(what.map.points[i]);
          const reference::BernsteinForm exact(input.surface());
          for (std::int64_t n = number_of(task.from); n <= number_of(task.to); n += 1) {
            input.u = what.along_v ? other : float_of(n);
            input.v = what.along_v ? float_of(n) : what.other;
            want.add(replay(*subject, "texture_coord_1", input),
                     exact.evaluate_with_magnitude(input.argument_u(), input.argument_v()), input);
          }
        }
        EXPECT_EQ(got.values, want.values);
        EXPECT_EQ(got.not_correctly_rounded, want.not_correctly_rounded);
        EXPECT_NEAR(got.ulp.error, want.ulp.error, want.ulp.error * 1e-8);
        EXPECT_NEAR(got.condition_aware.error, want.condition_aware.error, want.condition_aware.error * 1e-8);
        EXPECT_LT(got.ulp.component, what.map.components);
        for (std::size_t bin = 2; bin < Errors::kBins; ++bin)
          EXPECT_EQ(got.histogram[bin], want.histogram[bin]);
        const SweepResult right = swept(task, stream_source({"production"})).result;
        EXPECT_EQ(right.values, want.values);
        EXPECT_EQ(right.not_correctly_rounded, 0u);
        ++reduced;
      }
  EXPECT_EQ(reduced, 8 * 5);
}

TEST(Sweep, IsTheSameInThreadsAndShards) {
  const std::vector<double> points = {0.125, 0.75, -0.5, 0.875};
  for (const char* name : {"sum-float", "production"}) {
    const StreamSource source = stream_source({name});
    const SweepTask task{points, 0.4F, 0.43F};
    ASSERT_GT(task.blocks(), 7);
    const SweepState whole = swept(task, source, 1);
    EXPECT_EQ(whole.result.not_correctly_rounded == 0, std::string(name) == "production");
    expect_same(swept(task, source, 3).result, whole.result);
    StreamSource fed = source;  // a source in which one thread evaluates and the others judge
    fed.for_threads = false;
    expect_same(swept(task, fed, 2).result, whole.result);
    SweepResult sum;
    for (std::int64_t shard = 0; shard < 3; ++shard) {
      const SweepState part = swept({points, task.from, task.to, shard, 3}, source);
      EXPECT_EQ(part.done.size(), (SweepTask{points, task.from, task.to, shard, 3}.blocks_of_shard()));
      sum.add(part.result);
    }
    expect_same(sum, whole.result);
  }
}

// The result does not depend on the order of the parts.
TEST(Sweep, OfEqualErrorsKeepsTheLeastArgument) {
  const SweepResult::Largest early{2.5, 7, 1}, late{2.5, 9, 2}, small{1, 3, 3};
  for (const auto& order : {std::vector{early, late, small}, {small, late, early}, {late, early, small}}) {
    SweepResult::Largest largest;
    for (const SweepResult::Largest& one : order) largest.keep(one);
    EXPECT_TRUE(largest == early);
  }
}

TEST(Sweep, DigestTellsResultsApart) {
  const SweepTask task{{0.125, 0.75, -0.5, 0.875}, 0.4F, 0.401F};
  const auto digest = [&](const char* name) { return swept(task, stream_source({name})).result.digest; };
  EXPECT_EQ(digest("production"), digest("sum-double")) << "both are right everywhere";
  EXPECT_NE(digest("production"), digest("sum-float"));
  // The same result of another argument gives another digest.
  const auto at = [](float u) { return swept({{1, 1}, u, u}, stream_source({"sum-double"})).result.digest; };
  EXPECT_NE(at(0.25F), at(0.5F));
}

// A sweep ends if a thread cannot evaluate.
TEST(Sweep, EndsWithTheFirstProblem) {
  StreamSource source;
  struct Broken final : Stream {
    void evaluate(std::span<const float>, std::span<float>) override { throw NotObservable("broken"); }
  };
  source.make = [](const SweptMap&) { return std::make_unique<Broken>(); };
  for (const bool for_threads : {false, true}) {
    source.for_threads = for_threads;
    EXPECT_THROW(swept({{1, 2}, 0.25F, 0.5F}, source), NotObservable);
  }
}

class Checkpoints : public ProgramTest {
 protected:
  const SweepTask task_{{0.125, 0.75, -0.5, 0.875}, 0.4F, 0.43F};
  const StreamSource source_ = stream_source({"sum-float"});
  const SweepIdentity identity_ = identity_of(task_, source_.info);
  std::filesystem::path file() const { return folder_ / "sweep.json"; }
  std::string content() const { return read_file(file()); }
};

TEST_F(Checkpoints, HoldAllOfAState) {
  SweepState state{BlockSet(task_.blocks()), {}};
  std::atomic<bool> stop = false;
  // Stops the sweep after two blocks, because it reports only every second and at the end.
  StreamSource slow = source_;
  std::atomic<int> evaluated = 0;
  class Counting final : public Stream {
   public:
    Counting(std::unique_ptr<Stream> inner, std::atomic<int>& count, std::atomic<bool>& end)
        : inner_(std::move(inner)), count_(count), end_(end) {}
    void evaluate(std::span<const float> u, std::span<float> results) override {
      inner_->evaluate(u, results);
      if (++count_ == 2) end_ = true;
    }

   private:
    std::unique_ptr<Stream> inner_;
    std::atomic<int>& count_;
    std::atomic<bool>& end_;
  };
  slow.make = [&](const SweptMap& map) {
    return std::make_unique<Counting>(source_.make(map), evaluated, stop);
  };
  sweep(task_, slow, 1, state, stop, [](const SweepState&) {});
  ASSERT_EQ(state.done.size(), 2);
  write_checkpoint(file(), {identity_, state, 1.5});
  Checkpoint resumed = read_checkpoint(file(), identity_);
  EXPECT_EQ(resumed.seconds, 1.5);
  EXPECT_EQ(resumed.state.done.ranges(), state.done.ranges());
  expect_same(resumed.state.result, state.result);
  sweep(task_, source_, 2, resumed.state, kNever, [](const SweepState&) {});
  expect_same(resumed.state.result, swept(task_, source_).result);
  EXPECT_EQ(resumed.state.done.size(), task_.blocks());
}

TEST_F(Checkpoints, ThatAreDamagedAreRefused) {
  write_checkpoint(file(), {identity_, swept(task_, source_), 1});
  const std::string whole = content();
  ASSERT_NO_THROW(read_checkpoint(file(), identity_));
  const auto complaint = [&](const std::string& text) -> std::string {
    std::ofstream(file()) << text;
    try {
      read_checkpoint(file(), identity_);
    } catch (const BadCheckpoint& problem) {
      EXPECT_EQ(content(), text) << "left as it is";
      return problem.what();
    }
    return "none";
  };
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, whole.size() / 2, whole.size() - 10})
    EXPECT_TRUE(contains(complaint(whole.substr(0, length)), "damaged (incomplete JSON)")) << length;
  std::string changed = whole;
  changed.replace(changed.find("\"values\": ") + 10, 1, "9");
  if (changed == whole) changed.replace(changed.find("\"values\": ") + 10, 1, "8");
  EXPECT_TRUE(contains(complaint(changed), "damaged (its checksum is wrong)"));
  EXPECT_TRUE(contains(complaint("[1, 2]"), "damaged"));
}

TEST_F(Checkpoints, OfAnotherSweepAreRefused) {
  write_checkpoint(file(), {identity_, swept(task_, source_), 1});
  const auto complaint = [&](const SweepTask& task, const ImplementationInfo& info) -> std::string {
    try {
      read_checkpoint(file(), identity_of(task, info));
    } catch (const BadCheckpoint& problem) {
      return problem.what();
    }
    return "none";
  };
  SweepTask other = task_;
  other.map.map.points[2] = 1;
  EXPECT_TRUE(contains(complaint(other, source_.info), "its points is"));
  other = task_;
  other.to = 0.44F;
  EXPECT_TRUE(contains(complaint(other, source_.info), "its interval is"));
  other = task_;
  other.shards = 2;
  EXPECT_TRUE(contains(complaint(other, source_.info), "its shard is \"1/1\", not \"1/2\""));
  ImplementationInfo info = source_.info;
  info.version = "another";
  EXPECT_TRUE(contains(complaint(task_, info), "its implementation is"));
}

class SweepCommand : public ProgramTest {
 protected:
  std::vector<std::string> command(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"ulp", "--sweep",  "--implementation", "sum-float", "--orders",
                                    "4",   "--points", "1,-1,2,0.5",       "--output",  folder_};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static std::string complaints(const json& file) {
    std::ifstream schema(SWEEP_SCHEMA);
    return JsonSchema(json::parse(schema)).complaint(file);
  }
};

TEST_F(SweepCommand, GoesOnAfterItWasKilled) {
  const std::string file = folder_ / "sweep.json";
  const std::vector<std::string> arguments =
      command({"--from", "0.25", "--to", "1", "--checkpoint", file, "--jobs", "1"});
  std::vector<std::string> killed = arguments;
  killed.insert(killed.begin(), EVALCTS_PROGRAM);
  {
    ChildProcess child(killed, "");
    for (int i = 0; i < 1500 && !std::filesystem::exists(file); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    kill(child.id(), SIGKILL);
    child.wait(60);
  }
  ASSERT_TRUE(std::filesystem::exists(file));
  const json before = json_of("sweep.json");
  EXPECT_EQ(complaints(before), "");
  const Outcome outcome = evalcts(arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "blocks were done before"));
  const json after = json_of("sweep.json");
  EXPECT_EQ(complaints(after), "");
  EXPECT_EQ(as_text(after["status"]), "complete");
  EXPECT_EQ(after["proven"], true);
  EXPECT_EQ(after["result"]["values"], 2 * (1 << 23) + 1);

  const Outcome again = evalcts(arguments);
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_EQ(json_of("sweep.json"), after) << "nothing is left to do";

  // The whole interval, without interruption.
  ASSERT_EQ(evalcts(command({"--from", "0.25", "--to", "1", "--checkpoint", file + ".whole"})).code, 0);
  EXPECT_EQ(json_of("sweep.json.whole")["result"], after["result"]);
  EXPECT_EQ(evalcts(command({"--from", "0.5", "--checkpoint", file})).code, 2) << "another interval";
  EXPECT_EQ(json_of("sweep.json"), after);
}

TEST_F(SweepCommand, WorstInputsAreReplayed) {
  const std::string file = folder_ / "sweep.json";
  ASSERT_EQ(evalcts(command({"--from", "0.5", "--to", "0.55", "--checkpoint", file})).code, 0);
  const json worst = json_of("sweep.json")["result"]["worst_ulp"];
  const Outcome again = evalcts({"ulp", "--implementation", "sum-float", "--orders", "4", "--points",
                                 "1,-1,2,0.5", "--at", worst["at"].get<std::string>()});
  EXPECT_TRUE(contains(again.text, worst["got"]["bits"])) << again.text << worst;
  EXPECT_TRUE(contains(again.text, worst["right"]["bits"])) << again.text << worst;
}

TEST_F(SweepCommand, ShardsAreMerged) {
  const std::vector<std::string> interval = {"--from", "0.4", "--to", "0.43", "--checkpoint"};
  const auto sweep = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), interval.begin(), interval.end());
    more.push_back(folder_ / name);
    EXPECT_EQ(evalcts(command(more)).code, 0);
  };
  sweep("whole", {});
  sweep("1", {"--shard", "1/2"});
  sweep("2", {"--shard", "2/2"});
  EXPECT_EQ(json_of("1")["proven"], false);
  const auto merge = [&](const std::vector<std::string>& names, const std::string& into) {
    std::vector<std::string> arguments = {"ulp", "--checkpoint", folder_ / into, "--merge"};
    for (const std::string& name : names) arguments.push_back(folder_ / name);
    return evalcts(arguments);
  };
  const Outcome outcome = merge({"2", "1"}, "merged");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  json merged = json_of("merged"), whole = json_of("whole");
  EXPECT_EQ(complaints(merged), "");
  EXPECT_EQ(merged["proven"], true);
  for (json* file : {&merged, &whole}) {
    file->erase("seconds");
    file->erase("checksum");
  }
  EXPECT_EQ(merged, whole);
  EXPECT_EQ(merge({"1", "2"}, "merged").code, 2) << "it is there already";

  const auto rejected = [&](const std::vector<std::string>& names) {
    const Outcome rejection = merge(names, "not-made");
    EXPECT_EQ(rejection.code, 2) << rejection.text;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "not-made"));
    return rejection.text;
  };
  EXPECT_TRUE(contains(rejected({"1"}), "shards are missing: 2/2"));
  EXPECT_TRUE(contains(rejected({"1", "1"}), "is shard 1/2 a second time"));
  EXPECT_TRUE(contains(rejected({"1", "whole"}), "is shard 1/1, but the others are of 2"));
  EXPECT_TRUE(contains(rejected({"1", "nowhere"}), "is damaged (incomplete JSON)"));
  std::ofstream(folder_ / "half") << std::ifstream(folder_ / "2").rdbuf();
  std::filesystem::resize_file(folder_ / "half", 300);
  EXPECT_TRUE(contains(rejected({"1", "half"}), "is damaged"));
  sweep("other", {"--shard", "2/2", "--target", "normal"});
  EXPECT_TRUE(contains(rejected({"1", "other"}), "is of another sweep: its points is"));
}

TEST_F(SweepCommand, GoesAlongSurfaces) {
  const std::string file = folder_ / "sweep.json";
  const std::vector<std::string> surface = {"ulp",
                                            "--sweep",
                                            "--implementation",
                                            "sum-float",
                                            "--orders",
                                            "2,3",
                                            "--points",
                                            "1,-1,2,3,-2,0.5,1,4,-3,2,0,1",
                                            "--from",
                                            "0.5",
                                            "--to",
                                            "0.501",
                                            "--checkpoint",
                                            file};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), surface.begin(), surface.end());
    return evalcts(more);
  };
  EXPECT_EQ(with({}).code, 2) << "where does the other argument stand?";
  EXPECT_EQ(with({"--u", "0.5", "--v", "0.5"}).code, 2);
  EXPECT_EQ(with({"--v", "0.5", "--target", "normal"}).code, 2) << "two components, not three";
  const Outcome outcome = with({"--u", "0.3"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const json result = json_of("sweep.json");
  EXPECT_EQ(complaints(result), "");
  EXPECT_EQ(as_text(result["map"]["target"]), "texture_coord_2");
  EXPECT_EQ(as_text(result["map"]["swept"]), "v");
  EXPECT_EQ(with({"--v", "0.3"}).code, 2) << "another sweep";
  // The command that is printed with the largest error evaluates it again.
  const json worst = result["result"]["worst_ulp"];
  const std::size_t line = outcome.text.find("  " EVALCTS_PROGRAM " ulp --implementation sum-float");
  ASSERT_NE(line, std::string::npos) << outcome.text;
  const std::string again = outcome.text.substr(line, outcome.text.find('\n', line) - line);
  EXPECT_TRUE(contains(start({"/bin/sh", "-c", again}).text, worst["got"]["bits"])) << again;
}

#ifdef MPIEXEC
// Sweeps by mpirun give the same bits for any number of processes, even after one of them was killed.
class SweepOfProcesses : public SweepCommand {
 protected:
  static constexpr const char* kTo = "0.4375";
  std::vector<std::string> by_mpirun(const std::string& processes, const std::string& file,
                                     const char* to = kTo) {
    for (const char* variable : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"})
      setenv(variable, "1", 1);
    std::vector<std::string> all = {MPIEXEC, "--oversubscribe", "-n", processes, EVALCTS_PROGRAM};
    const std::vector<std::string> own =
        command({"--from", "0.375", "--to", to, "--checkpoint", folder_ / file});
    all.insert(all.end(), own.begin(), own.end());
    return all;
  }
};

TEST_F(SweepOfProcesses, GivesWhatOneGives) {
  ASSERT_EQ(evalcts(command({"--from", "0.375", "--to", kTo, "--checkpoint", folder_ / "one"})).code, 0);
  for (const char* processes : {"2", "4"}) {
    const Outcome outcome = start(by_mpirun(processes, processes));
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_TRUE(contains(outcome.text, std::string(", ") + processes + " processes"));
    EXPECT_EQ(json_of(processes)["result"], json_of("one")["result"]);
    EXPECT_EQ(as_text(json_of(processes)["status"]), "complete");
  }
  const Outcome again = start(by_mpirun("2", "2"));
  EXPECT_EQ(again.code, 0) << "nothing is left to do: " << again.text;
  EXPECT_EQ(start(by_mpirun("2", "2", "0.51")).code, 2) << "another sweep's file";
}

TEST_F(SweepOfProcesses, GoesOnAfterOneWasKilled) {
  // Returns the processes with this rank in this job; other jobs may run at the same time.
  const auto ranks = [&](const char* number) {
    std::vector<pid_t> found;
    for (const auto& process : std::filesystem::directory_iterator("/proc")) {
      const std::string variables = read_file(process.path() / "environ");
      const std::string words = read_file(process.path() / "cmdline");
      if (variables.find(std::string("OMPI_COMM_WORLD_RANK=") + number + '\0') != std::string::npos &&
          words.find(folder_.string()) != std::string::npos)
        found.push_back(static_cast<pid_t>(std::stol(process.path().filename())));
    }
    return found;
  };
  // Tries longer intervals if the sweep ends before a process can be killed.
  const char* to = nullptr;
  for (const char* const longer : {"0x1p2", "0x1p8", "0x1p32"}) {
    to = longer;
    std::filesystem::remove(folder_ / "sweep.json");
    ChildProcess child(by_mpirun("2", "sweep.json", to), (folder_ / "killed.log").string());
    for (int i = 0; i < 1500 && !std::filesystem::exists(folder_ / "sweep.json"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    for (const pid_t rank : ranks("1")) kill(rank, SIGKILL);
    const auto ending = child.wait(60);
    ASSERT_TRUE(ending) << "the job ends with its process";
    if (as_text(json_of("sweep.json")["status"]) == "complete") continue;
    EXPECT_NE(ending->value, 0);
    break;
  }
  const json before = json_of("sweep.json");
  EXPECT_EQ(as_text(before["status"]), "unfinished");
  ASSERT_GT(before["blocks_done"].size(), 0u);
  const Outcome outcome = start(by_mpirun("2", "sweep.json", to));
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "blocks were done before"));
  EXPECT_EQ(as_text(json_of("sweep.json")["status"]), "complete");
  ASSERT_EQ(evalcts(command({"--from", "0.375", "--to", to, "--checkpoint", folder_ / "one"})).code, 0);
  EXPECT_EQ(json_of("sweep.json")["result"], json_of("one")["result"]);
}

TEST_F(SweepOfProcesses, SaysOnceWhatIsWrong) {
  std::vector<std::string> arguments = by_mpirun("2", "sweep.json");
  *std::find(arguments.begin(), arguments.end(), "sum-float") = "production-fast";
  Outcome outcome = start(arguments);
  EXPECT_EQ(outcome.code, 2) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "production-fast evaluates grids only"));
  EXPECT_EQ(outcome.text.find("evalcts: "), outcome.text.rfind("evalcts: "));
}
#endif

TEST_F(SweepCommand, WrongUseIsTwo) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--at", "0.5"},
                                               {"--from", "1", "--to", "0.5"},
                                               {"--from", "nan"},
                                               {"--to", "inf"},
                                               {"--shard", "3/2"},
                                               {"--target", "normal", "--target", "color_4"},
                                               {"--v", "0.5"},
                                               {"--implementation", "production"},
                                               {"--checkpoint", "/proc/nowhere/sweep.json"}})
    EXPECT_EQ(evalcts(command(more)).code, 2) << more.front();
  EXPECT_EQ(evalcts({"ulp", "--sweep", "--implementation", "sum-float"}).code, 2);
  EXPECT_EQ(
      evalcts({"ulp", "--sweep", "--implementation", "production-fast", "--orders", "1", "--points", "1"})
          .code,
      2);
  EXPECT_EQ(
      evalcts({"ulp", "--sweep", "--implementation", "sum-float", "--orders", "2,2", "--points", "1,2,3,4"})
          .code,
      2);
}

}  // namespace
}  // namespace evalcts::accuracy
