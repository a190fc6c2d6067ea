#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::canopen {

/// NMT commands (CiA 301, 7.2.8.3.1). The values are those on the wire.
enum class NmtCommand : std::uint8_t {
  Start = 1,
  Stop = 2,
  EnterPreOperational = 128,
  ResetNode = 129,           ///< the drive boots anew, all objects take their stored values
  ResetCommunication = 130,  ///< only the communication objects (0x1000..0x1FFF) do
};

/// State a node tells in its heartbeat (CiA 301, 7.2.8.3.2.2). PDOs flow in Operational only; SDO, SYNC and
/// EMCY in PreOperational and Operational; in Stopped only NMT and heartbeat.
enum class NodeState : std::uint8_t {
  BootUp = 0x00,
  Stopped = 0x04,
  Operational = 0x05,
  PreOperational = 0x7F,
  Unknown = 0xFF,  ///< not on the wire: nothing heard so far, or a value CiA 301 does not know
};

/// "operational", "pre-operational", ...
std::string_view to_text(NodeState state);

/// NMT command to one node, 1..127, or to all (`kAllNodes`).
Frame nmt_frame(NmtCommand command, std::uint8_t node);

/// An NMT command, and to which node: 1..127, or `kAllNodes`.
struct NmtOrder {
  NmtCommand command = NmtCommand::Start;
  std::uint8_t node = 0;
};

/// The command in an NMT frame; empty where the frame is none or the command is not one of the above.
std::optional<NmtOrder> decode_nmt(const Frame& frame);

/// "start", "enter pre-operational", ...; empty for a value that is none of the above.
std::string_view to_text(NmtCommand command);

/// Heartbeat of `node` in `state`.
Frame heartbeat_frame(std::uint8_t node, NodeState state);

/// State in a heartbeat or boot-up frame; bit 7, the toggle of node guarding, is masked. Empty when the frame
/// is a remote frame or not one byte long.
std::optional<NodeState> decode_heartbeat(const Frame& frame);

}  // namespace interpolated_motion::canopen
