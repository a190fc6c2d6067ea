#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/emulation/world.h"

// How much faster than real time emulated SilverDust drives run. "ticks/s" counts the 120 us servo ticks of
// all drives.
namespace interpolated_motion {
namespace {

using emulation::SilverDust;
using emulation::SilverDustParameters;
using emulation::World;

constexpr int kFirstAddress = 16;
constexpr HostDuration kSegment = std::chrono::milliseconds(240);  // 2000 ticks
constexpr double kTicksPerSecond = 1e6 / 120.0;

/// A host that keeps the queues of its drives filled with segments that go back and forth.
class Host {
 public:
  Host(World& world, int drives) : world_(world), line_(world.serial_line("line0")), drives_(drives) {}

  void bring_up() {
    all(" 11 17 0\r");
    all(" 11 19 1073742\r");
    all(" 254\r");
    for (int i = 0; i < 4; ++i) feed();
    all(" 253 0 0\r");
  }

  void run(HostDuration length) {
    const HostTime end = world_.now() + length;
    while (world_.now() < end) {
      world_.advance(end);
      while (line_.receive()) ++received_;
    }
  }

  void stream() {
    const HostTime end = world_.now() + kSegment;
    feed();
    run(end - world_.now());
  }

 private:
  void all(const std::string& command) {
    for (int i = 0; i < drives_; ++i) {
      line_.send("@" + std::to_string(kFirstAddress + i) + command, world_.now());
      run(host_duration(0.015));
    }
  }

  void feed() {
    // Two segments forward and two back, each with 1000 ticks of ramp: at rest between the directions.
    static const std::vector<std::string> segments = {
        " 25 2000 1073741824 1073742 536870912\r", " 25 2000 1073741824 1073742 0\r",
        " 25 2000 -1073741824 1073742 536870912\r", " 25 2000 -1073741824 1073742 0\r"};
    all(segments[next_++ % segments.size()]);
  }

  World& world_;
  transport::SerialLine& line_;
  int drives_;
  std::size_t next_ = 0;
  std::uint64_t received_ = 0;
};

struct SetUp {
  explicit SetUp(int count, bool observed = false) {
    transport::SerialLineParameters line_parameters;
    line_parameters.baud = 115'200;
    auto& line = world.add_serial_line("line0", line_parameters);
    for (int i = 0; i < count; ++i) {
      SilverDustParameters parameters;
      parameters.address = kFirstAddress + i;
      drives.push_back(&world.add<SilverDust>(line, parameters));
      if (observed) {
        drives.back()->set_sample_observer(
            [this](const emulation::SilverDustSample& sample) { sum += sample.demand; });
      }
    }
  }

  World world;
  std::vector<SilverDust*> drives;
  double sum = 0.0;
};

void report(benchmark::State& state, const World& world, HostTime start) {
  const double simulated = seconds(world.now() - start);
  const double ticks = simulated * kTicksPerSecond * static_cast<double>(state.range(0));
  state.counters["ticks/s"] = benchmark::Counter(ticks, benchmark::Counter::kIsRate);
  state.counters["x_real_time"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
}

void idle_silverdusts(benchmark::State& state) {
  SetUp setup(static_cast<int>(state.range(0)));
  Host host(setup.world, static_cast<int>(state.range(0)));
  const HostTime start = setup.world.now();
  for (auto _ : state) host.run(std::chrono::milliseconds(100));
  report(state, setup.world, start);
}
BENCHMARK(idle_silverdusts)->Arg(6);

void stream(benchmark::State& state, bool observed) {
  SetUp setup(static_cast<int>(state.range(0)), observed);
  Host host(setup.world, static_cast<int>(state.range(0)));
  host.bring_up();
  const HostTime start = setup.world.now();
  for (auto _ : state) host.stream();
  report(state, setup.world, start);
  benchmark::DoNotOptimize(setup.sum);
  for (const SilverDust* drive : setup.drives) {
    if (drive->counters().underruns > 0) state.SkipWithError("a drive has run out of segments");
  }
}

void streaming_silverdusts(benchmark::State& state) { stream(state, false); }
BENCHMARK(streaming_silverdusts)->Arg(1)->Arg(6);

void observed_silverdusts(benchmark::State& state) { stream(state, true); }
BENCHMARK(observed_silverdusts)->Arg(1)->Arg(6);

}  // namespace
}  // namespace interpolated_motion
