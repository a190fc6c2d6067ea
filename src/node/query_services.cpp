#include "interpolated_motion_driver/node/query_services.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/node/message_conversion.h"
#include "interpolated_motion_driver/node/sample_files.h"

namespace interpolated_motion::node {
namespace {

/// Samples handed to the bus thread at a time, which has other things to do: some 0.2 ms.
constexpr std::size_t kSamplesAtATime = 1000;

}  // namespace

QueryServices::QueryServices(ros::NodeHandle node, HardwareThread& hardware, std::vector<std::string> joints,
                             std::string samples_folder)
    : hardware_(hardware),
      joints_(std::move(joints)),
      samples_folder_(std::move(samples_folder)),
      query_state_(node.advertiseService("query_state", &QueryServices::query_state, this)),
      motion_report_(node.advertiseService("motion_report", &QueryServices::motion_report, this)) {}

bool QueryServices::query_state(Query::Request& request, Query::Response& response) {
  using States = std::vector<trajectory::State>;
  const auto states =
      hardware_.call([time = to_host_time(request.time)](auto& hardware, HostTime) -> std::optional<States> {
        States sampled;
        if (!hardware.query(time, sampled)) return std::nullopt;
        return sampled;
      });
  if (!states || !*states) return false;
  response.name = joints_;
  for (const trajectory::State& state : **states) {
    response.position.push_back(state.position);
    response.velocity.push_back(state.velocity);
    response.acceleration.push_back(state.acceleration);
  }
  return true;
}

void QueryServices::hand_over_samples(std::size_t joint) {
  const auto samples = read_sample_file(samples_folder_ + "/" + joints_[joint]);
  if (samples.empty()) return;
  hardware_.post([joint](auto& hardware, HostTime) { hardware.forget_samples(joint); });
  for (std::size_t begin = 0; begin < samples.size(); begin += kSamplesAtATime) {
    const std::size_t end = std::min(samples.size(), begin + kSamplesAtATime);
    hardware_.call([&samples, joint, begin, end](auto& hardware, HostTime) {
      for (std::size_t i = begin; i < end; ++i) hardware.add_sample(joint, samples[i]);
      return true;
    });
  }
}

bool QueryServices::motion_report(Report::Request&, Report::Response& response) {
  for (std::size_t joint = 0; joint < joints_.size() && !samples_folder_.empty(); ++joint)
    hand_over_samples(joint);
  const auto report = hardware_.call([](auto& hardware, HostTime) { return hardware.report(); });
  if (!report) return false;
  fill_motion_report(*report, response);
  response.message = report->valid ? fmt::format("motion of {:.3f} s", report->duration.count())
                                   : "no goal has moved since the driver started";
  return true;
}

}  // namespace interpolated_motion::node
