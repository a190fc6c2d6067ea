#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "interpolated_motion_driver/protocol/canopen/bus_load.h"
#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/emcy.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/nmt.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_answers.h"

namespace interpolated_motion::commissioning {

/// What one node id has been heard to say.
struct NodeTraffic {
  std::uint64_t frames = 0;                 ///< TPDO, SDO response, EMCY and heartbeat
  std::optional<canopen::NodeState> state;  ///< of its last heartbeat or boot-up message
  std::optional<canopen::Emcy> emergency;   ///< its last
  canopen::SdoAnswers sdo_answers;          ///< more than requests: two devices have this id
};

/// Who is on a CAN bus, by listening to it.
class BusTraffic {
 public:
  /// `bitrate` in bit/s, above 0: for the load.
  explicit BusTraffic(std::uint32_t bitrate) : load_(bitrate) {}

  /// A frame of this host is about to go out.
  void on_sending(const canopen::Frame& frame);
  /// A frame seen on the bus, of others or of this host.
  void on_frame(const canopen::ReceivedFrame& received);

  /// Frames of others.
  std::uint64_t frames() const { return frames_; }
  /// What node `id`, 1..127, has said.
  const NodeTraffic& node(std::uint8_t id) const { return nodes_[id]; }
  /// Somebody else sends what only a master does: NMT, SYNC, TIME, RPDOs or SDO requests.
  bool other_master() const { return !commands_.empty(); }
  /// The node id of a master that sends heartbeats along with the rest is not known; what it sends is:
  /// "SYNC (100 frames), RPDO 1 of node 3 (12 frames)". Empty where there is none.
  std::string master_text() const;
  /// 0..1, of the last second.
  double load(HostTime now) const { return load_.load(now); }

 private:
  void on_node_frame(const canopen::CobIdMeaning& meaning, const canopen::ReceivedFrame& received);

  canopen::BusLoad load_;
  std::uint64_t frames_ = 0;
  std::array<NodeTraffic, canopen::kMaxNodeId + 1> nodes_{};
  std::map<std::uint32_t, std::uint64_t> commands_;  ///< COB-IDs of another master, and how many of each
};

}  // namespace interpolated_motion::commissioning
