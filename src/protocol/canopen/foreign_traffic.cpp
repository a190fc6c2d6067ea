#include "interpolated_motion_driver/protocol/canopen/foreign_traffic.h"

#include <fmt/format.h>

#include <algorithm>

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/frame_text.h"

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

std::string text_of(const Frame& frame) {
  return (frame.extended ? "" : describe_cob_id(frame.id) + ", ") + to_string(frame);
}

void add(UnexpectedFrames& frames, const ReceivedFrame& received) {
  ++frames.count;
  frames.last = received.frame;
  frames.time = received.time;
}

}  // namespace

void ForeignTraffic::count(UnexpectedFrame cause, const ReceivedFrame& received) {
  add(unexpected_[static_cast<std::size_t>(cause)], received);
}

void ForeignTraffic::note_master(const ReceivedFrame& received) { add(master_, received); }

const UnexpectedFrames& ForeignTraffic::unexpected(UnexpectedFrame cause) const {
  return unexpected_[static_cast<std::size_t>(cause)];
}

std::string ForeignTraffic::unexpected_text(UnexpectedFrame cause) const {
  const UnexpectedFrames& frames = unexpected(cause);
  if (frames.count == 0) return {};
  return fmt::format("{} frame{} {}, last: {}", frames.count, frames.count == 1 ? "" : "s", name_of(cause),
                     text_of(frames.last));
}

bool ForeignTraffic::listen(HostTime now) {
  if (since_ == kNever) since_ = now;
  talks_ = talks_ || quiet(now);
  return talks_;
}

bool ForeignTraffic::quiet(HostTime now) const { return now >= quiet_from(); }

HostTime ForeignTraffic::quiet_from() const {
  if (!alone_) return HostTime{};
  if (since_ == kNever) return kNever;
  return master_.count > 0 ? std::max(since_, master_.time) + listen_ : since_ + listen_;
}

std::string ForeignTraffic::master_text() const {
  return master_.count > 0 ? text_of(master_.last) : std::string();
}

bool ForeignTraffic::master_sets_clocks() const {
  return master_.count > 0 && master_.last.id == cob_id::kTime;
}

}  // namespace interpolated_motion::canopen
