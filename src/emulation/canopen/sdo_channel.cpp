#include "interpolated_motion_driver/emulation/canopen/sdo_channel.h"

namespace interpolated_motion::emulation {
namespace {

// Function codes of the predefined connection set (CiA 301).
constexpr std::uint32_t kSdoResponse = 0x580;
constexpr std::uint32_t kSdoRequest = 0x600;

constexpr std::size_t kResponses = 32;
// Segments of a block upload sent in one sample: leaves room in the transmit queue for PDOs.
constexpr int kSegmentsPerSample = 8;

}  // namespace

std::uint32_t SdoChannel::request_id() const { return kSdoRequest + node_id_; }

void SdoChannel::on_request(const canopen::Frame& frame, HostTime now) {
  if (frame.remote || frame.length != 8) return;
  if (const auto response = server_.on_request(frame.data)) respond(*response, now);
}

void SdoChannel::send_due(HostTime now) {
  while (!responses_.empty() && responses_.front().due <= now) {
    port_.send(responses_.front().frame, now);
    responses_.pop_front();
  }
}

void SdoChannel::pump_segments(HostTime now) {
  for (int i = 0; i < kSegmentsPerSample && port_.free_slots() > 1; ++i) {
    const auto segment = server_.next_segment();
    if (!segment) return;
    respond(*segment, now);
  }
}

void SdoChannel::restart() {
  reset();
  responses_.clear();
}

void SdoChannel::respond(const SdoServer::Bytes& bytes, HostTime now) {
  if (responses_.size() >= kResponses) return port_.count_lost();
  canopen::Frame frame;
  frame.id = kSdoResponse + node_id_;
  frame.length = 8;
  frame.data = bytes;
  responses_.push_back({now + response_time_, frame});
}

}  // namespace interpolated_motion::emulation
