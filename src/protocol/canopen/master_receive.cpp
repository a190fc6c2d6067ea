#include <utility>

#include "interpolated_motion_driver/protocol/canopen/master.h"

namespace interpolated_motion::canopen {

void Master::on_frame(const ReceivedFrame& received) {
  advance(received.time);
  load_.add(received.frame, received.time);
  if (received.own) return on_own_frame(received);
  if (received.frame.extended) return foreign_.count(UnexpectedFrame::ExtendedFrame, received);
  if (received.frame.remote) return foreign_.count(UnexpectedFrame::RemoteFrame, received);
  on_foreign_frame(received);
}

void Master::on_own_frame(const ReceivedFrame& received) {
  const Frame& frame = received.frame;
  if (frame.extended || frame.remote) return;
  const CobIdMeaning meaning = classify(frame.id);
  if (meaning.service == Service::Sync) confirm_sync(received.time);
  if (meaning.service == Service::Rpdo && nodes_[meaning.node]) {
    NodeLink::Confirmed& confirmed = nodes_[meaning.node]->confirmed_[NodeLink::slot(meaning.pdo)];
    confirmed.last = received.time;
    ++confirmed.count;
  }
}

/// With another SYNC given to the transport meanwhile, a drive may latch that one before the time stamp
/// comes.
void Master::confirm_sync(HostTime time) {
  last_sync_time_ = time;
  ++syncs_confirmed_;
  for (NodeLink* node : in_order_) node->sync_answers_.on_sync();
  if (timed_sync_ != kNever) sync_timing_.confirm(std::exchange(timed_sync_, kNever), time);
  const bool is_last = std::exchange(syncs_since_confirmation_, 0) == 1;
  time_stamp_.reset();
  const int period = parameters_.time_stamp_period;
  if (period == 0 || syncs_confirmed_ % static_cast<std::uint64_t>(period) != 0) return;
  if (is_last) time_stamp_ = time_stamp_frame(parameters_.own_node_id, time);
}

void Master::on_foreign_frame(const ReceivedFrame& received) {
  const CobIdMeaning meaning = classify(received.frame.id);
  switch (meaning.service) {
    case Service::Unknown:
    case Service::Lss:
      return foreign_.count(UnexpectedFrame::UnknownCobId, received);
    case Service::Nmt:
    case Service::Sync:
    case Service::Time:
    case Service::Rpdo:
    case Service::SdoRequest:
      return on_other_master(meaning, received);
    case Service::Emcy:
    case Service::Tpdo:
    case Service::SdoResponse:
    case Service::Heartbeat:
      break;
  }
  if (meaning.node == parameters_.own_node_id) return on_other_master(meaning, received);
  if (!nodes_[meaning.node]) return foreign_.count(UnexpectedFrame::UnconfiguredNode, received);
  deliver(*nodes_[meaning.node], meaning, received);
}

/// Nodes that are not ours may have a master of their own. A time of day is of no matter unless this host
/// sets the drives' clocks: they would take the other's time as well.
void Master::on_other_master(const CobIdMeaning& meaning, const ReceivedFrame& received) {
  foreign_.count(UnexpectedFrame::OtherMaster, received);
  const bool has_addressee = meaning.service == Service::Rpdo || meaning.service == Service::SdoRequest;
  const bool is_ours = meaning.node == parameters_.own_node_id || find_node(meaning.node) != nullptr;
  const bool sets_clocks = parameters_.time_stamp_period > 0;
  if ((meaning.service == Service::Time && !sets_clocks) || (has_addressee && !is_ours)) return;
  foreign_.note_master(received);
  if (meaning.service == Service::SdoRequest && nodes_[meaning.node])
    nodes_[meaning.node]->sdo_answers_.on_request(received.frame);
  if (meaning.service != Service::Nmt) return;
  const auto order = decode_nmt(received.frame);
  for (NodeLink* node : in_order_) {
    if (order && (order->node == kAllNodes || order->node == node->id_)) node->foreign_nmt_ = order->command;
  }
}

void Master::deliver(NodeLink& node, const CobIdMeaning& meaning, const ReceivedFrame& received) {
  if (meaning.service == Service::Emcy) return deliver_emcy(node, received);
  if (meaning.service == Service::SdoResponse) {
    node.sdo_answers_.on_answer(received.frame);
    return node.sdo_.on_frame(received.frame, received.time);
  }
  if (meaning.service == Service::Heartbeat) {
    const auto state = decode_heartbeat(received.frame);
    if (!state) return foreign_.count(UnexpectedFrame::Malformed, received);
    return node.heartbeat_.on_heartbeat(*state, received.time);
  }
  if (valid_pdo_number(meaning.pdo)) node.sync_answers_.on_tpdo(meaning.pdo);
  if (node.tpdo_handler_) node.tpdo_handler_(meaning.pdo, received.frame, received.time);
}

void Master::deliver_emcy(NodeLink& node, const ReceivedFrame& received) {
  const auto emcy = decode_emcy(received.frame, received.time);
  if (!emcy) return foreign_.count(UnexpectedFrame::Malformed, received);
  if (!node.emergencies_.push_over_oldest(*emcy)) ++node.emergencies_lost_;
}

std::string Master::unexpected_text(UnexpectedFrame cause) const {
  const std::string text = foreign_.unexpected_text(cause);
  return text.empty() ? text : bus_name_ + ": " + text;
}

}  // namespace interpolated_motion::canopen
