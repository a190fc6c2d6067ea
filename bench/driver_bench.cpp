#include <cstdint>

#include <benchmark/benchmark.h>

#include "hardware/scenario.h"

namespace interpolated_motion {
namespace {

std::uint64_t traffic(test::Scenario& scenario) {
  std::uint64_t all = 0;
  for (const auto& bus : scenario.snapshot().buses) all += bus.frames_sent + bus.frames_received;
  return all;
}

/// The whole driver with six emulated drives plays the six-axis goal in virtual time, the encoding of the
/// goal included. `x real time` is virtual seconds per second of the processor, `frames/s` counts frames, or
/// lines of text, of both directions.
void play_six_axis_goal(benchmark::State& state, const YAML::Node& arm) {
  double virtual_seconds = 0.0;
  std::uint64_t frames = 0;
  const auto goal = test::load_goal(test::goal_file("six_axis_toppra_100ms_pva.yaml"));
  for (auto _ : state) {
    state.PauseTiming();
    test::Scenario scenario(arm);
    scenario.run_until_state(motion::GroupState::Idle);
    const std::uint64_t frames_before = traffic(scenario);
    const HostTime start = scenario.now();
    state.ResumeTiming();
    const auto accepted = scenario.submit(goal);
    const auto result = scenario.result_of(accepted.value().id);
    state.PauseTiming();
    if (result.outcome != motion::GoalOutcome::Succeeded) state.SkipWithError(result.text.c_str());
    frames += traffic(scenario) - frames_before;
    virtual_seconds += seconds(scenario.now() - start);
    state.ResumeTiming();
  }
  state.counters["x real time"] = benchmark::Counter(virtual_seconds, benchmark::Counter::kIsRate);
  state.counters["frames/s"] = benchmark::Counter(static_cast<double>(frames), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(play_six_axis_goal, epos, test::six_axis())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(play_six_axis_goal, silverlode, test::six_axis_silverlode())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(play_six_axis_goal, mixed, test::six_axis_mixed())->Unit(benchmark::kMillisecond);

/// Six enabled joints at rest.
void hold_still(benchmark::State& state, const YAML::Node& arm) {
  test::Scenario scenario(arm);
  scenario.run_until_state(motion::GroupState::Idle);
  for (auto _ : state) scenario.run(1.0);
  state.counters["x real time"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(hold_still, epos, test::six_axis())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hold_still, silverlode, test::six_axis_silverlode())->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace interpolated_motion
