#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/bus_load.h"
#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/foreign_traffic.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/heartbeat.h"
#include "interpolated_motion_driver/protocol/canopen/nmt.h"
#include "interpolated_motion_driver/protocol/canopen/node_link.h"
#include "interpolated_motion_driver/protocol/canopen/pacer.h"
#include "interpolated_motion_driver/protocol/canopen/ring.h"
#include "interpolated_motion_driver/protocol/canopen/sync.h"
#include "interpolated_motion_driver/protocol/canopen/sync_timing.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

struct MasterParameters {
  std::uint8_t own_node_id = 127;                         ///< 1..127, of the heartbeat the drives watch
  HostDuration heartbeat_period = HostDuration::zero();   ///< of this host; zero: none is sent
  HostDuration heartbeat_timeout = HostDuration::zero();  ///< of the nodes; zero: not monitored
  HostDuration sync_period = HostDuration::zero();        ///< zero: SYNC on request only
  bool isochronous = false;  ///< SYNC is the time base of drives, see below; needs a sync_period
  /// An isochronous SYNC that is later than this is left out, 0..`sync_period`; zero, and what is more than
  /// half a period: later than half a period.
  HostDuration sync_tolerance = HostDuration::zero();
  int time_stamp_period = 0;  ///< every so many SYNCs are followed by their time stamp, 0..1000; 0: none
  std::uint32_t bitrate = 1'000'000;   ///< bit/s, 10000..1000000
  double max_bulk_load = 0.6;          ///< share of the bus for bulk frames, 0.01..1
  int bulk_burst = 4;                  ///< bulk frames that may go back to back, 1..64
  SdoParameters sdo;                   ///< of the SDO clients
  std::size_t control_capacity = 256;  ///< frames, 16..65536
  std::size_t bulk_capacity = 128;     ///< frames of each node, 1..65536
  std::size_t emcy_capacity = 16;      ///< messages of each node, 1..65536
  /// How long the bus must have been without another master before this one sends anything.
  HostDuration listen = HostDuration::zero();
  bool alone = true;  ///< no other master is allowed on the bus; false: it is not looked for
};

/// The CANopen master of one bus, sans-IO: received frames go in with `on_frame`, frames to send come out of
/// `peek_outgoing`/`pop_outgoing`, time is given. After construction and `add_node` nothing is allocated per
/// frame (SDO transfers of more than 8 bytes excepted).
///
/// With `time_stamp_period` the drives are told when SYNC was on the bus, so that they can set their clocks
/// by it (object 0x1013). A time stamp goes before everything else that waits, since a drive takes it for
/// that of the last SYNC; it is left out when the next SYNC is under way already.
///
/// A periodic SYNC is left out while the one before is still on its way to the bus or an answer to it has not
/// come (NodeLink::set_sync_answer): a quarter of `heartbeat_timeout` at most, three periods at most for an
/// answer. So a bus that has stood still goes on with one SYNC, not with all those due meanwhile, and an
/// answer that comes late, from a slow drive or over a full bus, is not taken for the answer to a later SYNC:
/// it would put a drive's old position to a new instant.
///
/// An `isochronous` bus has drives that take one setpoint per SYNC and interpolate between two of them. A
/// SYNC off its grid would make them take a setpoint at a wrong instant: there is none on request (the next
/// periodic one serves), and none waits for another. One that the host is late with by more than
/// `sync_tolerance` is left out: drives go on along their polynomial for one period, and a late one would
/// shift the grid that they interpolate on. Not two in a row, and none that a node needs
/// (NodeLink::set_needs_sync); but one that is late by more than half a period, by the host or on a bus that
/// does not take it, is left out always. sync_timing() tells which; what was sent to be taken with one of
/// them is not taken.
///
/// Nothing is sent before the bus has been listened to for `listen`, and while another master is heard there:
/// SYNC and heartbeat begin when it is quiet, and whoever has something to say asks foreign().quiet() before.
/// Once it has begun to talk a master goes on, whoever else comes.
///
/// Three priorities. This host's heartbeat waits for nothing but a periodic SYNC, whose instant counts, and
/// its time stamp: whatever else there is to send, the drives must not take this host for dead. Control
/// frames (NMT, SYNC, RPDOs, SDO) leave in the order they were made. Bulk frames (`NodeLink::send_record`)
/// leave when no control frame waits, node after node in turn, paced so that they take at most
/// `max_bulk_load` of the bit rate, each counted as 135 bits, the worst case: RPDO identifiers beat those of
/// SDO and heartbeat, so an unpaced prefill would starve them.
class Master {
 public:
  /// `bus_name` is used in texts. Throws std::invalid_argument with parameter, value and range.
  explicit Master(std::string bus_name, MasterParameters parameters = {});
  ~Master();
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;

  /// Adds a node, 1..127, neither own nor added before; throws std::invalid_argument otherwise.
  NodeLink& add_node(std::uint8_t id);
  /// The node, or nullptr when it was not added.
  NodeLink* find_node(std::uint8_t id) { return id <= kMaxNodeId ? nodes_[id].get() : nullptr; }

  /// As given to the constructor.
  const std::string& bus_name() const { return bus_name_; }
  const MasterParameters& parameters() const { return parameters_; }

  /// A frame seen on the bus, of another node or of this host. TPDO handlers are called from here.
  void on_frame(const ReceivedFrame& received);

  /// Does what time demands: SYNC, heartbeat, time-outs of SDO and of the nodes' heartbeats. Hand over the
  /// frames received until `now` before, so that an answer which is there already prevents its time-out.
  void poll(HostTime now);

  /// When `poll`, or `peek_outgoing` for a paced frame, must be called next. Frames that may go already set
  /// no deadline: offer them to the transport after every call that may have queued some, and again when it
  /// has room.
  HostTime next_deadline() const;

  /// The frame to send next, or nullptr. Valid until the next call of any function of the master or its
  /// nodes.
  const Frame* peek_outgoing(HostTime now);
  /// The transport has taken the frame that `peek_outgoing` returned just before.
  void pop_outgoing(HostTime now);

  /// NMT command to one node or to `kAllNodes`. False when the control queue is full.
  bool send_nmt(NmtCommand command, std::uint8_t node);
  /// One SYNC, behind every control frame queued so far (SDO requests started so far included); on an
  /// isochronous bus the next periodic one; none while this master listens. False when the control queue is
  /// full.
  bool request_sync(HostTime now);

  /// Drops everything that waits to be sent, control and bulk frames. For a bus that was down: a controlword
  /// of then must not reach a drive now. SDO transfers that lose a frame so end with their time-out.
  void clear_outgoing();

  /// End of this host's last SYNC on the bus (the epoch before the first), and how many there were.
  HostTime last_sync_time() const { return last_sync_time_; }
  std::uint64_t syncs_confirmed() const { return syncs_confirmed_; }
  /// When the next periodic SYNC is due; `kNever` when there are none, and before the first `poll`.
  HostTime next_sync_due() const { return sync_.next_deadline(); }
  /// How late periodic SYNCs have been on the bus.
  const SyncTiming& sync_timing() const { return sync_timing_; }

  /// Time stamps given to the transport.
  std::uint64_t time_stamps_sent() const { return time_stamps_; }

  /// Control frames not yet given to the transport.
  std::size_t pending_control() const { return control_.size() + (heartbeat_due_ ? 1U : 0U); }
  /// Control frames refused because the queue was full.
  std::uint64_t control_overflows() const { return control_overflows_; }

  /// Share of the bus in use, own and others' frames, see `BusLoad`.
  double bus_load(HostTime now) const { return load_.load(now); }
  /// As of the latest time this master was given.
  double bus_load() const { return load_.load(now_); }

  /// What others say on the bus.
  const ForeignTraffic& foreign() const { return foreign_; }
  /// "can0: 3 frames of nodes that are not configured, last: TPDO 1 of node 9, 189#3702"; empty when there
  /// were none.
  std::string unexpected_text(UnexpectedFrame cause) const;

 private:
  friend class NodeLink;
  enum class Kind : std::uint8_t { Other, PeriodicSync, RequestedSync, Sdo };
  struct ControlFrame {
    Frame frame;              ///< as it is to be sent
    Kind kind = Kind::Other;  ///< what is to be noted when the transport takes it
    std::uint8_t node = 0;    ///< whose SDO it is; 0: no SDO
    HostTime due{};           ///< of a periodic SYNC
  };
  enum class Peeked : std::uint8_t { None, TimeStamp, Heartbeat, Control, Bulk };

  bool queue_control(const Frame& frame, Kind kind = Kind::Other, std::uint8_t node = 0);
  bool push_control(const ControlFrame& frame);
  void collect_sdo();
  void advance(HostTime now);
  NodeLink* next_bulk_node();
  void release_control();
  void queue_periodic_sync();
  bool waits_for_last_sync();
  void drop_late_sync(HostTime now);
  void confirm_sync(HostTime time);

  void on_own_frame(const ReceivedFrame& received);
  void on_foreign_frame(const ReceivedFrame& received);
  void deliver(NodeLink& node, const CobIdMeaning& meaning, const ReceivedFrame& received);
  void deliver_emcy(NodeLink& node, const ReceivedFrame& received);
  void poll_nodes(HostTime now);
  void on_other_master(const CobIdMeaning& meaning, const ReceivedFrame& received);

  std::string bus_name_;
  MasterParameters parameters_;
  std::array<std::unique_ptr<NodeLink>, kMaxNodeId + 1> nodes_;
  std::vector<NodeLink*> in_order_;  ///< the nodes as they were added
  std::size_t bulk_turn_ = 0;        ///< index into `in_order_` of the node whose bulk frame goes next
  HostTime now_{};                   ///< latest time given

  Ring<ControlFrame> control_;
  Pacer pacer_;
  Peeked peeked_ = Peeked::None;
  bool periodic_sync_queued_ = false;
  std::optional<Frame> heartbeat_due_;  ///< waits to be sent
  std::uint64_t control_overflows_ = 0;

  HeartbeatProducer heartbeat_;
  SyncProducer sync_;
  SyncTiming sync_timing_;
  HostTime timed_sync_ = kNever;  ///< when the periodic SYNC that is on its way was due; kNever: none is
  HostTime sync_given_{};         ///< when the transport took the last SYNC
  HostTime last_sync_time_{};
  std::uint64_t syncs_confirmed_ = 0;
  int syncs_since_confirmation_ = 0;  ///< given to the transport since the last confirmation of one
  std::optional<Frame> time_stamp_;   ///< of the last SYNC, waits to be sent
  std::uint64_t time_stamps_ = 0;
  BusLoad load_;
  ForeignTraffic foreign_;
};

}  // namespace interpolated_motion::canopen
