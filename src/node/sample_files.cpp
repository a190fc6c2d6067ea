#include "interpolated_motion_driver/node/sample_files.h"

#include <cinttypes>
#include <cstdio>
#include <stdexcept>

#include "interpolated_motion_driver/command_line/input_file.h"

namespace interpolated_motion::node {

namespace {

/// Null where there is none.
command_line::OpenFile open_if_there(const std::string& path) {
  try {
    return command_line::open_input_file(path);
  } catch (const std::runtime_error&) {
    return nullptr;
  }
}

}  // namespace

std::vector<hardware::DemandSample> read_sample_file(const std::string& path) {
  std::vector<hardware::DemandSample> samples;
  const command_line::OpenFile file = open_if_there(path);
  std::int64_t time = 0;
  hardware::DemandSample sample;
  int interpolating = 0;
  while (file && std::fscanf(file.get(), "%" SCNd64 " %lf %lf %" SCNd32 " %d", &time, &sample.drive_seconds,
                             &sample.demand, &sample.actual, &interpolating) == 5) {
    sample.time = HostTime(HostDuration(time));
    if (interpolating != 0) samples.push_back(sample);
  }
  return samples;
}

}  // namespace interpolated_motion::node
