#include "interpolated_motion_driver/node/sample_files.h"

#include <cinttypes>
#include <cstdio>
#include <memory>

namespace interpolated_motion::node {

std::vector<hardware::DemandSample> read_sample_file(const std::string& path) {
  std::vector<hardware::DemandSample> samples;
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "r"), close);
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
