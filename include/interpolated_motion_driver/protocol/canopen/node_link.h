#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/emcy.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/heartbeat.h"
#include "interpolated_motion_driver/protocol/canopen/nmt.h"
#include "interpolated_motion_driver/protocol/canopen/ring.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_answers.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_client.h"
#include "interpolated_motion_driver/protocol/canopen/sync_answers.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

class Master;

/// Receives the TPDOs of a node, 1..4. Called from `Master::on_frame`; may send, may not add nodes.
using TpdoHandler = std::function<void(int pdo_number, const Frame& frame, HostTime time)>;

/// One node of a bus as the master talks to it: its SDO client, its heartbeat, its emergencies, its PDOs.
/// Owned by the master and as long-lived; obtained from `Master::add_node`.
class NodeLink {
 public:
  NodeLink(const NodeLink&) = delete;
  NodeLink& operator=(const NodeLink&) = delete;

  /// Node id, 1..127.
  std::uint8_t id() const { return id_; }
  /// "can0 node 3", for texts.
  std::string name() const;

  /// Object access, and the watch over the node's heartbeat; they live as long as the node.
  SdoClient& sdo() { return sdo_; }
  const SdoClient& sdo() const { return sdo_; }
  const SdoAnswers& sdo_answers() const { return sdo_answers_; }
  HeartbeatConsumer& heartbeat() { return heartbeat_; }
  const HeartbeatConsumer& heartbeat() const { return heartbeat_; }

  /// Oldest emergency message not yet taken.
  std::optional<Emcy> take_emcy() { return emergencies_.take(); }
  /// Emergency messages forgotten because the queue was full; the oldest goes first.
  std::uint64_t emergencies_lost() const { return emergencies_lost_; }

  /// Sets who receives the TPDOs. To be set once, before frames flow; the receiver must outlive the bus
  /// traffic.
  void set_tpdo_handler(TpdoHandler handler) { tpdo_handler_ = std::move(handler); }

  /// TPDO `n` (1..4) is the answer of this node to every SYNC: the master then knows to which one, since it
  /// waits for all answers before the next periodic SYNC. To be set once, before frames flow.
  void set_sync_answer(int n) { sync_answers_.expect(n); }

  /// While the node needs to be led by what comes with SYNC, none is left out for being a little late
  /// (MasterParameters::sync_tolerance).
  void set_needs_sync(bool needs) { needs_sync_ = needs; }

  /// NMT command to this node, in the control queue. False when the queue is full.
  bool send_nmt(NmtCommand command);

  /// The last NMT command that another master has sent to this node since the last call.
  std::optional<NmtCommand> take_foreign_nmt() { return std::exchange(foreign_nmt_, std::nullopt); }

  /// Puts RPDO `n` (1..4) of `length` (0..8) bytes into the control queue, behind everything queued before.
  /// False, and nothing queued, when the queue is full or an argument out of range.
  bool send_rpdo(int n, const std::uint8_t* data, std::uint8_t length);

  /// Puts RPDO `n` into this node's bulk queue: it goes out paced, when no control frame waits. For
  /// interpolation data records. False as above.
  bool send_record(int n, const std::uint8_t* data, std::uint8_t length);

  /// Bulk frames not yet given to the transport.
  std::size_t pending_records() const { return records_.size(); }
  /// How many of them may wait.
  std::size_t record_capacity() const { return records_.capacity(); }
  /// Drops them: they never reach the bus.
  void clear_records() { records_.clear(); }

  /// Frames of RPDO `n` (1..4) confirmed by the bus, of either queue, and the time of the last one's end.
  std::uint64_t rpdos_confirmed(int n) const { return confirmed_[slot(n)].count; }
  HostTime last_rpdo_time(int n) const { return confirmed_[slot(n)].last; }

 private:
  friend class Master;
  struct Confirmed {
    std::uint64_t count = 0;  ///< since the node was added
    HostTime last{};          ///< end of the last one on the bus; the epoch: none yet
  };

  NodeLink(Master& master, std::uint8_t id);
  static std::size_t slot(int n) { return static_cast<std::size_t>(n - 1); }

  Master& master_;
  std::uint8_t id_;
  SdoClient sdo_;
  SdoAnswers sdo_answers_;
  bool sdo_frame_queued_ = false;  ///< one SDO frame of a node at a time stands in the control queue
  HeartbeatConsumer heartbeat_;
  std::optional<NmtCommand> foreign_nmt_;
  Ring<Emcy> emergencies_;
  std::uint64_t emergencies_lost_ = 0;
  TpdoHandler tpdo_handler_;
  SyncAnswers sync_answers_;
  bool needs_sync_ = false;
  Ring<Frame> records_;
  std::array<Confirmed, kPdosOfNode> confirmed_{};
};

}  // namespace interpolated_motion::canopen
