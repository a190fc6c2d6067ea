#include "interpolated_motion_driver/protocol/canopen/master.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace interpolated_motion::canopen {
namespace {

constexpr double kWorstCaseBits = 135;  ///< 8 data bytes, 11-bit identifier; see `worst_case_bits`

template <class Value>
void check_range(const std::string& bus, const char* parameter, Value value, Value low, Value high) {
  if (value >= low && value <= high) return;
  throw std::invalid_argument(fmt::format("{}: {} = {} is not in {}..{}", bus, parameter, value, low, high));
}

void check_period(const std::string& bus, const char* parameter, HostDuration value) {
  constexpr HostDuration kLongest = std::chrono::hours(1);
  if (value >= HostDuration::zero() && value <= kLongest) return;
  throw std::invalid_argument(
      fmt::format("{}: {} = {} s is not in 0..{} s", bus, parameter, seconds(value), seconds(kLongest)));
}

void check_sync_tolerance(const std::string& bus, const MasterParameters& p) {
  if (p.sync_tolerance >= HostDuration::zero() && p.sync_tolerance <= p.sync_period) return;
  throw std::invalid_argument(fmt::format("{}: sync_tolerance = {} s is not in 0..{} s (sync_period)", bus,
                                          seconds(p.sync_tolerance), seconds(p.sync_period)));
}

MasterParameters checked(const std::string& bus, const MasterParameters& p) {
  check_range<int>(bus, "own_node_id", p.own_node_id, 1, kMaxNodeId);
  check_period(bus, "heartbeat_period", p.heartbeat_period);
  check_period(bus, "heartbeat_timeout", p.heartbeat_timeout);
  check_period(bus, "sync_period", p.sync_period);
  check_period(bus, "listen", p.listen);
  if (p.isochronous && p.sync_period == HostDuration::zero()) {
    throw std::invalid_argument(fmt::format("{}: sync_period = 0 s, an isochronous bus needs one", bus));
  }
  check_sync_tolerance(bus, p);
  check_range(bus, "time_stamp_period", p.time_stamp_period, 0, 1000);
  check_range<std::uint32_t>(bus, "bitrate", p.bitrate, 10'000, 1'000'000);
  check_range(bus, "max_bulk_load", p.max_bulk_load, 0.01, 1.0);
  check_range(bus, "bulk_burst", p.bulk_burst, 1, 64);
  check_range<std::size_t>(bus, "control_capacity", p.control_capacity, 16, 65536);
  check_range<std::size_t>(bus, "bulk_capacity", p.bulk_capacity, 1, 65536);
  check_range<std::size_t>(bus, "emcy_capacity", p.emcy_capacity, 1, 65536);
  return p;
}

/// Longest that a SYNC is put off while the last one is not on the bus: a bus that stands still for longer is
/// told of by the heartbeats that are missed.
HostDuration sync_patience(const MasterParameters& p) { return p.heartbeat_timeout / 4; }

/// How late the isochronous SYNC may be that is due now; `needed`: by a node.
HostDuration most_late(const MasterParameters& p, const SyncProducer& sync, const SyncTiming& timing,
                       bool needed) {
  const bool again = timing.last_left_out() >= sync.last_due() - p.sync_period;
  const bool is_strict = p.sync_tolerance > HostDuration::zero() && !needed && !again;
  return is_strict ? std::min(p.sync_tolerance, p.sync_period / 2) : p.sync_period / 2;
}

/// Longest that a SYNC is put off while answers to the last one are missing. Of a bus that is not overloaded
/// they come within a period; where they do not come by then, a SYNC or an answer was lost, and without the
/// next one the host knows nothing of any drive.
HostDuration answer_patience(const MasterParameters& p) {
  return std::min(sync_patience(p), 5 * p.sync_period / 2);  // the third one after it leaves
}

/// Time a bulk frame of the worst case takes at the share of the bus that bulk frames may use.
HostDuration bulk_interval(const MasterParameters& p) {
  return HostDuration(std::llround(kWorstCaseBits * 1e9 / (p.max_bulk_load * p.bitrate)));
}

}  // namespace

Master::Master(std::string bus_name, MasterParameters parameters)
    : bus_name_(std::move(bus_name)),
      parameters_(checked(bus_name_, parameters)),
      control_(parameters_.control_capacity),
      pacer_(bulk_interval(parameters_), parameters_.bulk_burst),
      heartbeat_(parameters_.own_node_id, parameters_.heartbeat_period),
      sync_(parameters_.sync_period),
      load_(parameters_.bitrate),
      foreign_(parameters_.listen, parameters_.alone) {}

Master::~Master() = default;

NodeLink& Master::add_node(std::uint8_t id) {
  check_range<int>(bus_name_, "node id", id, 1, kMaxNodeId);
  if (id == parameters_.own_node_id) {
    throw std::invalid_argument(fmt::format("{}: node id {} is this host's own", bus_name_, id));
  }
  if (nodes_[id]) throw std::invalid_argument(fmt::format("{}: node id {} is used twice", bus_name_, id));
  nodes_[id].reset(new NodeLink(*this, id));
  in_order_.push_back(nodes_[id].get());
  return *nodes_[id];
}

void Master::advance(HostTime now) { now_ = std::max(now_, now); }

void Master::poll(HostTime now) {
  advance(now);
  poll_nodes(now);
  if (!foreign_.listen(now)) return;
  if (sync_.poll(now)) queue_periodic_sync();
  if (const auto heartbeat = heartbeat_.poll(now)) heartbeat_due_ = heartbeat;
}

/// Of several isochronous ones that were missed none is sent: what waits in the drives is for the first of
/// them. Nor is one while the bus has not taken the one before, behind which the same waits.
void Master::queue_periodic_sync() {
  const bool needed =
      std::any_of(in_order_.begin(), in_order_.end(), [](const NodeLink* node) { return node->needs_sync_; });
  const bool in_time =
      sync_.missed() == 0 && now_ - sync_.last_due() <= most_late(parameters_, sync_, sync_timing_, needed);
  if (parameters_.isochronous && (!in_time || periodic_sync_queued_))
    return sync_timing_.leave_out(sync_.first_due(), parameters_.sync_period, sync_.missed() + 1);
  if (periodic_sync_queued_ || waits_for_last_sync()) return;
  collect_sdo();
  periodic_sync_queued_ = push_control({sync_frame(), Kind::PeriodicSync, 0, sync_.last_due()});
}

bool Master::waits_for_last_sync() {
  if (parameters_.isochronous) return false;
  if (syncs_since_confirmation_ > 0) return now_ - sync_given_ < sync_patience(parameters_);
  const bool late = now_ - last_sync_time_ >= answer_patience(parameters_);
  bool missing = false;
  for (NodeLink* node : in_order_) {
    if (late) node->sync_answers_.give_up();
    missing = missing || node->sync_answers_.missing();
  }
  return missing;
}

void Master::drop_late_sync(HostTime now) {
  if (!parameters_.isochronous || control_.empty()) return;
  const ControlFrame& next = control_.front();
  if (next.kind != Kind::PeriodicSync || now - next.due <= parameters_.sync_period / 2) return;
  sync_timing_.leave_out(next.due, parameters_.sync_period);
  release_control();
}

void Master::poll_nodes(HostTime now) {
  // Requests made while frames of the past were handled are handed out first: their time-outs start now.
  collect_sdo();
  for (NodeLink* node : in_order_) {
    node->sdo_.poll(now);
    node->heartbeat_.poll(now);
  }
}

HostTime Master::next_deadline() const {
  HostTime next = std::min(heartbeat_.next_deadline(), sync_.next_deadline());
  if (!foreign_.talks()) next = std::min(next, foreign_.quiet_from());
  bool bulk_waits = false;
  for (const NodeLink* node : in_order_) {
    next = std::min({next, node->sdo_.next_deadline(), node->heartbeat_.next_deadline()});
    bulk_waits = bulk_waits || !node->records_.empty();
  }
  if (bulk_waits && pacer_.ready_time() > now_) next = std::min(next, pacer_.ready_time());
  return next;
}

bool Master::send_nmt(NmtCommand command, std::uint8_t node) {
  return queue_control(nmt_frame(command, node));
}

bool Master::request_sync(HostTime now) {
  advance(now);
  if (parameters_.isochronous || !foreign_.talks()) return true;
  return queue_control(sync_frame(), Kind::RequestedSync);
}

bool Master::queue_control(const Frame& frame, Kind kind, std::uint8_t node) {
  collect_sdo();
  return push_control({frame, kind, node, HostTime{}});
}

bool Master::push_control(const ControlFrame& frame) {
  const bool room = control_.push(frame);
  if (!room) ++control_overflows_;
  return room;
}

/// Moves what the SDO clients have to send into the control queue, one frame of each node at a time, so that
/// the segments of a block do not delay other control frames.
void Master::collect_sdo() {
  for (NodeLink* node : in_order_) {
    if (node->sdo_frame_queued_ || !node->sdo_.has_frame() || control_.full()) continue;
    const Frame frame = *node->sdo_.next_frame(now_);
    node->sdo_answers_.on_request(frame);
    node->sdo_frame_queued_ = push_control({frame, Kind::Sdo, node->id_, HostTime{}});
  }
}

const Frame* Master::peek_outgoing(HostTime now) {
  advance(now);
  collect_sdo();
  peeked_ = Peeked::None;
  if (time_stamp_) {
    peeked_ = Peeked::TimeStamp;
    return &*time_stamp_;
  }
  drop_late_sync(now);
  const bool sync_is_next = !control_.empty() && control_.front().kind == Kind::PeriodicSync;
  if (heartbeat_due_ && !sync_is_next) {
    peeked_ = Peeked::Heartbeat;
    return &*heartbeat_due_;
  }
  if (!control_.empty()) {
    peeked_ = Peeked::Control;
    return &control_.front().frame;
  }
  NodeLink* node = pacer_.ready(now) ? next_bulk_node() : nullptr;
  if (node == nullptr) return nullptr;
  peeked_ = Peeked::Bulk;
  return &node->records_.front();
}

void Master::pop_outgoing(HostTime now) {
  advance(now);
  if (peeked_ == Peeked::Heartbeat) heartbeat_due_.reset();
  if (peeked_ == Peeked::TimeStamp) {
    time_stamp_.reset();
    ++time_stamps_;
  }
  if (peeked_ == Peeked::Control) {
    const Kind kind = control_.front().kind;
    if (kind == Kind::PeriodicSync || kind == Kind::RequestedSync) {
      ++syncs_since_confirmation_;
      sync_given_ = now;
      timed_sync_ = kind == Kind::PeriodicSync ? control_.front().due : kNever;
    }
    release_control();
  }
  if (peeked_ == Peeked::Bulk) {
    in_order_[bulk_turn_]->records_.pop();
    bulk_turn_ = (bulk_turn_ + 1) % in_order_.size();
    pacer_.consume(now);
  }
  peeked_ = Peeked::None;
}

void Master::release_control() {
  const ControlFrame& sent = control_.front();
  if (sent.kind == Kind::PeriodicSync) periodic_sync_queued_ = false;
  if (sent.kind == Kind::Sdo) nodes_[sent.node]->sdo_frame_queued_ = false;
  control_.pop();
}

void Master::clear_outgoing() {
  collect_sdo();
  while (!control_.empty()) release_control();
  for (NodeLink* node : in_order_) node->clear_records();
  time_stamp_.reset();
  heartbeat_due_.reset();
  syncs_since_confirmation_ = 0;
  peeked_ = Peeked::None;
  foreign_.deafen();
}

/// The node whose turn it is, or the next after it with a bulk frame; nullptr when none has.
NodeLink* Master::next_bulk_node() {
  for (std::size_t i = 0; i < in_order_.size(); ++i) {
    const std::size_t turn = (bulk_turn_ + i) % in_order_.size();
    if (in_order_[turn]->records_.empty()) continue;
    bulk_turn_ = turn;
    return in_order_[turn];
  }
  return nullptr;
}

}  // namespace interpolated_motion::canopen
