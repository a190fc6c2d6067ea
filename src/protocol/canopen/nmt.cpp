#include "interpolated_motion_driver/protocol/canopen/nmt.h"

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"

namespace interpolated_motion::canopen {

std::string_view to_text(NodeState state) {
  switch (state) {
    case NodeState::BootUp:
      return "boot-up";
    case NodeState::Stopped:
      return "stopped";
    case NodeState::Operational:
      return "operational";
    case NodeState::PreOperational:
      return "pre-operational";
    case NodeState::Unknown:
      break;
  }
  return "unknown";
}

Frame nmt_frame(NmtCommand command, std::uint8_t node) {
  Frame frame;
  frame.id = cob_id::kNmt;
  frame.length = 2;
  frame.data[0] = static_cast<std::uint8_t>(command);
  frame.data[1] = node;
  return frame;
}

std::optional<NmtOrder> decode_nmt(const Frame& frame) {
  if (frame.remote || frame.extended || frame.length != 2 || frame.id != cob_id::kNmt) return std::nullopt;
  const auto command = static_cast<NmtCommand>(frame.data[0]);
  if (to_text(command).empty()) return std::nullopt;
  return NmtOrder{command, frame.data[1]};
}

std::string_view to_text(NmtCommand command) {
  switch (command) {
    case NmtCommand::Start:
      return "start";
    case NmtCommand::Stop:
      return "stop";
    case NmtCommand::EnterPreOperational:
      return "enter pre-operational";
    case NmtCommand::ResetNode:
      return "reset node";
    case NmtCommand::ResetCommunication:
      return "reset communication";
  }
  return {};
}

Frame heartbeat_frame(std::uint8_t node, NodeState state) {
  Frame frame;
  frame.id = cob_id::heartbeat(node);
  frame.length = 1;
  frame.data[0] = static_cast<std::uint8_t>(state);
  return frame;
}

std::optional<NodeState> decode_heartbeat(const Frame& frame) {
  if (frame.remote || frame.length != 1) return std::nullopt;
  switch (frame.data[0] & 0x7F) {
    case 0x00:
      return NodeState::BootUp;
    case 0x04:
      return NodeState::Stopped;
    case 0x05:
      return NodeState::Operational;
    case 0x7F:
      return NodeState::PreOperational;
    default:
      return NodeState::Unknown;
  }
}

}  // namespace interpolated_motion::canopen
