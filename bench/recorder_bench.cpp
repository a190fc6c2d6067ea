#include <benchmark/benchmark.h>

#include <string>

#include "interpolated_motion_driver/recording/flight_recorder.h"

namespace interpolated_motion::recording {
namespace {

Subject subject() {
  Subject subject;
  subject.joints = {"joint1"};
  subject.buses = {"can0", "can1"};
  return subject;
}

/// One CAN frame of 8 bytes, 8000 a second: a saturated bus of 1 Mbit/s, so that old frames are forgotten.
void record_frame(benchmark::State& state) {
  FlightRecorder recorder({}, subject(), HostTime{});
  const std::string bus = "can1";
  canopen::ReceivedFrame frame;
  frame.frame.length = 8;
  for (auto _ : state) {
    frame.time += std::chrono::microseconds(125);
    recorder.frame(bus, frame);
  }
}
BENCHMARK(record_frame);

/// The copy that a file is made of, of a ring that a saturated bus has filled.
void copy_recording(benchmark::State& state) {
  FlightRecorder recorder({}, subject(), HostTime{});
  canopen::ReceivedFrame frame;
  frame.frame.length = 8;
  for (; frame.time < HostTime{} + std::chrono::seconds(20); frame.time += std::chrono::microseconds(125))
    recorder.frame("can0", frame);
  for (auto _ : state) benchmark::DoNotOptimize(recorder.recording(frame.time));
  state.counters["bytes"] = static_cast<double>(recorder.used());
}
BENCHMARK(copy_recording)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace interpolated_motion::recording
