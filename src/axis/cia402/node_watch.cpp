#include "interpolated_motion_driver/axis/cia402/node_watch.h"

#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/canopen/frame_text.h"

namespace interpolated_motion::axis {

using canopen::HeartbeatEvent;
using canopen::NmtCommand;
using canopen::NodeState;

namespace {

/// A heartbeat of before the start command may still have been on its way.
constexpr HostDuration kInFlight = std::chrono::milliseconds(50);

/// Answers that nobody has asked for, which show that there are two devices.
constexpr std::uint64_t kProof = 3;

NodeState state_after(NmtCommand command) {
  switch (command) {
    case NmtCommand::Start:
      return NodeState::Operational;
    case NmtCommand::Stop:
      return NodeState::Stopped;
    case NmtCommand::EnterPreOperational:
      return NodeState::PreOperational;
    default:
      return NodeState::Unknown;
  }
}

}  // namespace

void NodeWatch::forget() {
  while (node_.heartbeat().take_event()) continue;
  node_.take_foreign_nmt();
  state_ = NodeState::Unknown;
  order_.reset();
  expected_ = false;
  forgotten_ = heard_ = master_.foreign().of_master();
  surplus_ = node_.sdo_answers().surplus();
}

void NodeWatch::expect_operational(HostTime now) {
  state_ = NodeState::Operational;
  started_ = now;
  expected_ = true;
}

// What is known best comes first: who did it, then what the drive says, then who else is there.
std::optional<NodeEvent> NodeWatch::next() {
  if (const auto event = take_order()) return event;
  if (const auto event = take_heartbeat()) return event;
  if (has_left_operational()) return NodeEvent::NotOperational;
  if (node_.sdo_answers().surplus() >= surplus_ + kProof) {
    surplus_ = node_.sdo_answers().surplus();
    return NodeEvent::TwoDevices;
  }
  const std::uint64_t heard = master_.foreign().of_master();
  if (heard == std::exchange(heard_, heard)) return std::nullopt;
  return NodeEvent::OtherMaster;
}

std::optional<NodeEvent> NodeWatch::take_order() {
  const auto order = node_.take_foreign_nmt();
  if (!order || *order == NmtCommand::Start) return std::nullopt;
  order_ = order;
  state_ = state_after(*order);
  expected_ = false;
  return NodeEvent::NotOperational;
}

std::optional<NodeEvent> NodeWatch::take_heartbeat() {
  while (const auto event = node_.heartbeat().take_event()) {
    silent_ = *event == HeartbeatEvent::Lost;
    if (silent_) return NodeEvent::Silent;
    if (*event != HeartbeatEvent::BootUp) continue;
    state_ = NodeState::PreOperational;
    expected_ = false;
    return NodeEvent::Restarted;
  }
  return std::nullopt;
}

bool NodeWatch::has_left_operational() {
  const NodeState said = node_.heartbeat().state();
  const bool other = said == NodeState::PreOperational || said == NodeState::Stopped;
  if (!expected_ || !other || node_.heartbeat().last_heard() <= started_ + kInFlight) return false;
  state_ = said;
  expected_ = false;
  return true;
}

std::string NodeWatch::text(NodeEvent event, const std::string& lost) const {
  switch (event) {
    case NodeEvent::Silent:
      return fmt::format("no heartbeat from the drive for {:.2f} s: it is off, disconnected or stuck",
                         seconds(heartbeat_timeout_));
    case NodeEvent::Restarted:
      return "the drive has restarted (boot-up message): it lost its power or was reset, and with it " + lost;
    case NodeEvent::NotOperational:
      return not_operational_text();
    case NodeEvent::TwoDevices:
      return fmt::format(
          "two devices answer as node {}. Give one of them another node id (switches on the drive, or its "
          "settings) and node_id in the configuration",
          node_.id());
    case NodeEvent::OtherMaster:
      break;
  }
  const canopen::ForeignTraffic& foreign = master_.foreign();
  if (foreign.master_sets_clocks()) {
    return fmt::format(
        "another node on {} sends the time of day ({}), by which drives set the clock of their motion that "
        "this host sets as well. End that, or set clock_discipline of this bus to false",
        master_.bus_name(), foreign.master_text());
  }
  return fmt::format(
      "another master is on {}: it has sent {}, and can command this drive as well. End it; where it is "
      "harmless, set other_masters of this bus to allow",
      master_.bus_name(), foreign.master_text());
}

std::string NodeWatch::not_operational_text() const {
  if (!order_) {
    return fmt::format(
        "the drive was put in {} by another node (NMT), or went there by itself: so its heartbeat says. It "
        "takes no PDOs there",
        canopen::to_text(state_));
  }
  const bool reset = state_ == NodeState::Unknown || state_ == NodeState::BootUp;
  const std::string what = reset ? "reset" : fmt::format("put in {}", canopen::to_text(state_after(*order_)));
  return fmt::format("the drive was {} by another node (NMT command \"{}\"). It takes no PDOs any more", what,
                     canopen::to_text(*order_));
}

}  // namespace interpolated_motion::axis
