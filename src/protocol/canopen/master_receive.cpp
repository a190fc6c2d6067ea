#include <fmt/format.h>

#include <utility>

#include "interpolated_motion_driver/protocol/canopen/frame_text.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"

namespace interpolated_motion::canopen {
namespace {

const char* name_of(UnexpectedFrame cause) {
  switch (cause) {
    case UnexpectedFrame::UnknownCobId:
      return "with an unknown COB-ID";
    case UnexpectedFrame::RemoteFrame:
      return "sent as remote request";
    case UnexpectedFrame::ExtendedFrame:
      return "with a 29-bit identifier";
    case UnexpectedFrame::UnconfiguredNode:
      return "of nodes that are not configured";
    case UnexpectedFrame::OtherMaster:
      return "of another master on this bus";
    case UnexpectedFrame::Malformed:
      return "of a wrong length";
  }
  return "";
}

}  // namespace

void Master::on_frame(const ReceivedFrame& received) {
  advance(received.time);
  load_.add(received.frame, received.time);
  if (received.own) return on_own_frame(received);
  if (received.frame.extended) return count(UnexpectedFrame::ExtendedFrame, received);
  if (received.frame.remote) return count(UnexpectedFrame::RemoteFrame, received);
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
      return count(UnexpectedFrame::UnknownCobId, received);
    case Service::Nmt:
    case Service::Sync:
    case Service::Time:
    case Service::Rpdo:
    case Service::SdoRequest:
      return count(UnexpectedFrame::OtherMaster, received);
    case Service::Emcy:
    case Service::Tpdo:
    case Service::SdoResponse:
    case Service::Heartbeat:
      break;
  }
  if (meaning.node == parameters_.own_node_id) return count(UnexpectedFrame::OtherMaster, received);
  if (!nodes_[meaning.node]) return count(UnexpectedFrame::UnconfiguredNode, received);
  deliver(*nodes_[meaning.node], meaning, received);
}

void Master::deliver(NodeLink& node, const CobIdMeaning& meaning, const ReceivedFrame& received) {
  if (meaning.service == Service::Emcy) return deliver_emcy(node, received);
  if (meaning.service == Service::SdoResponse) return node.sdo_.on_frame(received.frame, received.time);
  if (meaning.service == Service::Heartbeat) {
    const auto state = decode_heartbeat(received.frame);
    if (!state) return count(UnexpectedFrame::Malformed, received);
    return node.heartbeat_.on_heartbeat(*state, received.time);
  }
  if (valid_pdo_number(meaning.pdo)) node.sync_answers_.on_tpdo(meaning.pdo);
  if (node.tpdo_handler_) node.tpdo_handler_(meaning.pdo, received.frame, received.time);
}

void Master::deliver_emcy(NodeLink& node, const ReceivedFrame& received) {
  const auto emcy = decode_emcy(received.frame, received.time);
  if (!emcy) return count(UnexpectedFrame::Malformed, received);
  if (!node.emergencies_.push_over_oldest(*emcy)) ++node.emergencies_lost_;
}

void Master::count(UnexpectedFrame cause, const ReceivedFrame& received) {
  UnexpectedFrames& frames = unexpected_[static_cast<std::size_t>(cause)];
  ++frames.count;
  frames.last = received.frame;
  frames.time = received.time;
}

const UnexpectedFrames& Master::unexpected(UnexpectedFrame cause) const {
  return unexpected_[static_cast<std::size_t>(cause)];
}

std::string Master::unexpected_text(UnexpectedFrame cause) const {
  const UnexpectedFrames& frames = unexpected(cause);
  if (frames.count == 0) return {};
  const std::string what = frames.last.extended ? "" : describe_cob_id(frames.last.id) + ", ";
  return fmt::format("{}: {} frame{} {}, last: {}{}", bus_name_, frames.count, frames.count == 1 ? "" : "s",
                     name_of(cause), what, to_string(frames.last));
}

}  // namespace interpolated_motion::canopen
