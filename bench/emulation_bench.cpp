#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/emulation/world.h"

// How much faster than real time emulated EPOS drives run. "samples/s" counts the 1 ms samples of all drives.
namespace interpolated_motion {
namespace {

using emulation::EposDrive;
using emulation::EposParameters;
using emulation::World;

constexpr std::uint8_t kRecordTime = 10;            // ms
constexpr int kPrefill = 40;                        // records
constexpr HostDuration kStep = host_duration(0.1);  // virtual time of one iteration
constexpr double kAmplitude = 5000.0;               // qc
constexpr double kFrequency = 0.5;                  // Hz
constexpr double kTurn = 6.283185307179586;
constexpr double kQcPerMsOfRpm = 2000.0 / 60000.0;

canopen::Frame frame(std::uint32_t id, std::initializer_list<unsigned> bytes) {
  canopen::Frame result;
  result.id = id;
  for (const unsigned byte : bytes) result.data[result.length++] = static_cast<std::uint8_t>(byte);
  return result;
}

/// A host that keeps the buffers of its drives filled by time alone, and asks nothing back.
class Host {
 public:
  Host(World& world, int drives) : world_(world), bus_(world.can_bus("can0")), drives_(drives) {}

  void bring_up() {
    run(host_duration(0.25));
    for (unsigned id = 1; id <= static_cast<unsigned>(drives_); ++id) {
      write(id, {0x23, 0x00, 0x14, 1, 0x00 + id, 0x02, 0x00, 0x80});
      write(id, {0x2F, 0x00, 0x16, 0, 0});
      write(id, {0x23, 0x00, 0x16, 1, 0x40, 0x00, 0xC1, 0x20});
      write(id, {0x2F, 0x00, 0x16, 0, 1});
      write(id, {0x23, 0x00, 0x14, 1, 0x00 + id, 0x02, 0x00, 0x00});
      for (unsigned pdo = 1; pdo <= 2; ++pdo) {
        write(id, {0x2F, 0x00 + pdo, 0x18, 2, 1});
        write(id, {0x23, 0x00 + pdo, 0x18, 1, 0x80 + id, 0x02 + pdo - 1, 0x00, 0x40});
      }
      write(id, {0x2F, 0x60, 0x60, 0, 7});
      write(id, {0x2B, 0x40, 0x60, 0, 0x06, 0});
      write(id, {0x2B, 0x40, 0x60, 0, 0x0F, 0});
      write(id, {0x2F, 0xC4, 0x60, 6, 1});
    }
    send(frame(0x000, {1, 0}));
    for (int i = 0; i < kPrefill; ++i) {
      feed();
      run(host_duration(0.001));
    }
    for (unsigned id = 1; id <= static_cast<unsigned>(drives_); ++id)
      write(id, {0x2B, 0x40, 0x60, 0, 0x1F, 0});
  }

  void run(HostDuration length) {
    const HostTime end = world_.now() + length;
    while (world_.now() < end) {
      world_.advance(end);
      while (bus_.receive()) ++received_;
    }
  }

  void stream(HostDuration length) {
    for (HostDuration done{0}; done < length; done += std::chrono::milliseconds(kRecordTime)) {
      feed();
      send(frame(0x080, {}));
      run(std::chrono::milliseconds(kRecordTime));
    }
  }

 private:
  void send(const canopen::Frame& f) { bus_.send(f, world_.now()); }

  void write(unsigned id, std::initializer_list<unsigned> bytes) {
    canopen::Frame f = frame(0x600 + id, bytes);
    f.length = 8;
    send(f);
    run(host_duration(0.003));
  }

  void feed() {
    ++record_;
    const double phase = kTurn * kFrequency * record_ * kRecordTime * 1e-3;
    const auto position = static_cast<unsigned>(std::lround(kAmplitude * (1.0 - std::cos(phase))));
    const double speed = kAmplitude * std::sin(phase) * kTurn * kFrequency * 1e-3 / kQcPerMsOfRpm;
    const auto velocity = static_cast<unsigned>(std::lround(speed));
    for (unsigned id = 1; id <= static_cast<unsigned>(drives_); ++id) {
      send(frame(0x200 + id, {position & 0xFF, position >> 8 & 0xFF, position >> 16 & 0xFF, position >> 24,
                              velocity & 0xFF, velocity >> 8 & 0xFF, velocity >> 16 & 0xFF, kRecordTime}));
    }
  }

  World& world_;
  transport::CanBus& bus_;
  int drives_;
  int record_ = 0;
  std::uint64_t received_ = 0;
};

void report(benchmark::State& state, World& world, HostTime start, double drives) {
  const double simulated = seconds(world.now() - start);
  state.counters["samples/s"] = benchmark::Counter(simulated * 1000.0 * drives, benchmark::Counter::kIsRate);
  state.counters["x_real_time"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
}

void idle_drives(benchmark::State& state) {
  World world;
  auto& bus = world.add_can_bus("can0", 1'000'000);
  for (int id = 1; id <= state.range(0); ++id) {
    EposParameters parameters;
    parameters.node_id = static_cast<std::uint8_t>(id);
    world.add<EposDrive>(bus, parameters);
  }
  Host host(world, static_cast<int>(state.range(0)));
  host.run(host_duration(0.3));
  const HostTime start = world.now();
  for (auto _ : state) host.run(kStep);
  report(state, world, start, static_cast<double>(state.range(0)));
}
BENCHMARK(idle_drives)->Arg(1)->Arg(6);

/// Moving drives: 100 records/s each, a SYNC each 10 ms and two synchronous PDOs of each drive with it.
void streaming_drives(benchmark::State& state) {
  World world;
  auto& bus = world.add_can_bus("can0", 1'000'000);
  std::vector<EposDrive*> drives;
  for (int id = 1; id <= state.range(0); ++id) {
    EposParameters parameters;
    parameters.node_id = static_cast<std::uint8_t>(id);
    drives.push_back(&world.add<EposDrive>(bus, parameters));
  }
  Host host(world, static_cast<int>(state.range(0)));
  host.bring_up();
  const HostTime start = world.now();
  const std::uint64_t frames = bus.statistics().frames;
  for (auto _ : state) host.stream(kStep);
  report(state, world, start, static_cast<double>(state.range(0)));
  const double simulated = seconds(world.now() - start);
  state.counters["frames_per_s"] = static_cast<double>(bus.statistics().frames - frames) / simulated;
  for (const EposDrive* drive : drives) {
    if (drive->counters().emergencies > 0) state.SkipWithError("a drive has gone into fault");
  }
}
BENCHMARK(streaming_drives)->Arg(1)->Arg(6);

}  // namespace
}  // namespace interpolated_motion
