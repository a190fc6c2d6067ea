#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "../test/encoding/goal_paths.h"
#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"
#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"

namespace interpolated_motion::encoding {
namespace {

PvtEncoding six_axis_encoding(double velocity_unit_rpm, double bound_counts) {
  PvtEncoding encoding;
  encoding.joint = "joint";
  encoding.transmission = {2000, 100, 1, 0.0};
  encoding.velocity_unit_rpm = velocity_unit_rpm;
  encoding.bound_counts = bound_counts;
  encoding.max_motor_rpm = 6000;
  encoding.max_motor_acceleration = 40000;
  return encoding;
}

/// All six axes of a goal of 6.7 s, certificates included. Arguments: velocity unit in 1/1000 rpm, bound in
/// counts.
void encode_six_axes(benchmark::State& state) {
  const auto paths =
      testing::goal_paths(std::string(IMD_SOURCE_DIR) + "/config/goals/six_axis_toppra_100ms_pva.yaml");
  const PvtEncoding encoding =
      six_axis_encoding(static_cast<double>(state.range(0)) / 1000, static_cast<double>(state.range(1)));
  std::size_t records = 0;
  for (auto _ : state) {
    records = 0;
    for (const trajectory::Path& path : paths) {
      const double start = encoding.transmission.counts(path.sample(path.start_time()).position);
      const auto stream = encode_pvt(path, encoding, static_cast<std::int32_t>(std::lround(start)));
      if (!stream) {
        state.SkipWithError(stream.error().text.c_str());
        return;
      }
      records += stream.value().records.size();
    }
  }
  state.counters["records"] = static_cast<double>(records);
  state.counters["records_per_axis"] = static_cast<double>(records) / static_cast<double>(paths.size());
}
BENCHMARK(encode_six_axes)
    ->ArgNames({"unit_mrpm", "bound"})
    ->Args({1000, 1})
    ->Args({100, 1})
    ->Args({1, 1})
    ->Args({1000, 5})
    ->Args({1, 5})
    ->Unit(benchmark::kMillisecond);

/// Cost per second of path of an encoder that runs along for ten minutes.
void encode_ten_minutes(benchmark::State& state) {
  std::vector<double> times;
  std::vector<testing::End> ends;
  for (int i = 0; i <= 600; ++i) {
    times.push_back(i);
    ends.push_back({i % 2 == 0 ? 0.0 : 1.0, 0.0, 0.0});
  }
  const auto path = testing::path_through(times, ends, true);
  const PvtEncoding encoding = six_axis_encoding(1, 1);
  std::size_t records = 0;
  for (auto _ : state) records = encode_pvt(path, encoding, 0).value().records.size();
  state.counters["records"] = static_cast<double>(records);
}
BENCHMARK(encode_ten_minutes)->Unit(benchmark::kMillisecond);

/// All six axes of the same goal as IMS segments, certificates included. Argument: bound in counts.
void encode_six_ims_axes(benchmark::State& state) {
  const auto paths =
      testing::goal_paths(std::string(IMD_SOURCE_DIR) + "/config/goals/six_axis_toppra_100ms_pva.yaml");
  ImsEncoding encoding;
  encoding.joint = "joint";
  encoding.transmission = {4000, 50, 1, 0.0};
  encoding.bound_counts = static_cast<double>(state.range(0));
  encoding.max_motor_rpm = 4000;
  encoding.max_motor_acceleration = 40000;
  std::size_t segments = 0;
  for (auto _ : state) {
    segments = 0;
    for (const trajectory::Path& path : paths) {
      const double start = encoding.transmission.counts(path.sample(path.start_time()).position);
      const auto stream = encode_ims(path, encoding, static_cast<std::int32_t>(std::lround(start)));
      if (!stream) {
        state.SkipWithError(stream.error().text.c_str());
        return;
      }
      segments += stream.value().segments.size();
    }
  }
  state.counters["segments"] = static_cast<double>(segments);
  state.counters["segments_per_axis"] = static_cast<double>(segments) / static_cast<double>(paths.size());
}
BENCHMARK(encode_six_ims_axes)->ArgName("bound")->Arg(1)->Arg(2)->Arg(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace interpolated_motion::encoding
