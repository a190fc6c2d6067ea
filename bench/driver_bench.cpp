#include <cstdint>

#include <benchmark/benchmark.h>

#include "hardware/scenario.h"

namespace interpolated_motion {
namespace {

/// The whole driver with six emulated drives plays the six-axis goal in virtual time. `x real time` is
/// virtual seconds per second of the processor, `frames/s` counts frames of both directions.
void play_six_axis_goal(benchmark::State& state) {
  double virtual_seconds = 0.0;
  std::uint64_t frames = 0;
  const auto goal = test::load_goal(test::goal_file("six_axis_toppra_100ms_pva.yaml"));
  for (auto _ : state) {
    state.PauseTiming();
    test::Scenario scenario;
    scenario.run_until_state(motion::GroupState::Idle);
    const auto frames_before = scenario.snapshot().buses[0];
    const HostTime start = scenario.now();
    state.ResumeTiming();
    const auto accepted = scenario.submit(goal);
    scenario.result_of(accepted.value().id);
    state.PauseTiming();
    const auto after = scenario.snapshot().buses[0];
    frames +=
        after.frames_sent + after.frames_received - frames_before.frames_sent - frames_before.frames_received;
    virtual_seconds += seconds(scenario.now() - start);
    state.ResumeTiming();
  }
  state.counters["x real time"] = benchmark::Counter(virtual_seconds, benchmark::Counter::kIsRate);
  state.counters["frames/s"] = benchmark::Counter(static_cast<double>(frames), benchmark::Counter::kIsRate);
}
BENCHMARK(play_six_axis_goal)->Unit(benchmark::kMillisecond);

/// Six enabled joints at rest.
void hold_still(benchmark::State& state) {
  test::Scenario scenario;
  scenario.run_until_state(motion::GroupState::Idle);
  for (auto _ : state) scenario.run(1.0);
  state.counters["x real time"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(hold_still)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace interpolated_motion
