#include "interpolated_motion_driver/protocol/canopen/heartbeat.h"

namespace interpolated_motion::canopen {

HeartbeatConsumer::HeartbeatConsumer(HostDuration timeout) : timeout_(timeout) {}

void HeartbeatConsumer::set_timeout(HostDuration timeout) { timeout_ = timeout; }

void HeartbeatConsumer::on_heartbeat(NodeState state, HostTime time) {
  last_heard_ = time;
  lost_ = false;
  if (state == NodeState::BootUp) {
    monitoring_ = false;
    events_.push_over_oldest(HeartbeatEvent::BootUp);
  } else if (!monitoring_) {
    monitoring_ = true;
    events_.push_over_oldest(HeartbeatEvent::Started);
  } else if (state != state_) {
    events_.push_over_oldest(HeartbeatEvent::StateChanged);
  }
  state_ = state;
}

void HeartbeatConsumer::poll(HostTime now) {
  if (now < next_deadline()) return;
  monitoring_ = false;
  lost_ = true;
  state_ = NodeState::Unknown;
  events_.push_over_oldest(HeartbeatEvent::Lost);
}

HeartbeatProducer::HeartbeatProducer(std::uint8_t node, HostDuration period)
    : frame_(heartbeat_frame(node, NodeState::Operational)), period_(period) {}

std::optional<Frame> HeartbeatProducer::poll(HostTime now) {
  if (period_ <= HostDuration::zero()) return std::nullopt;
  if (next_ != kNever && now < next_) return std::nullopt;
  next_ = now + period_;
  return frame_;
}

}  // namespace interpolated_motion::canopen
