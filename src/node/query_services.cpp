#include "interpolated_motion_driver/node/query_services.h"

#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/node/message_conversion.h"

namespace interpolated_motion::node {

QueryServices::QueryServices(ros::NodeHandle node, HardwareThread& hardware, std::vector<std::string> joints)
    : hardware_(hardware),
      joints_(std::move(joints)),
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

bool QueryServices::motion_report(Report::Request&, Report::Response& response) {
  const auto report = hardware_.call([](auto& hardware, HostTime) { return hardware.report(); });
  if (!report) return false;
  fill_motion_report(*report, response);
  response.message = report->valid ? fmt::format("motion of {:.3f} s", report->duration.count())
                                   : "no goal has moved since the driver started";
  return true;
}

}  // namespace interpolated_motion::node
