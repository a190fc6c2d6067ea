#include "interpolated_motion_driver/hardware/can_link.h"

#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/hardware/can_bits.h"

namespace interpolated_motion::hardware {

namespace {

constexpr int kRecordBytes = 8;

canopen::MasterParameters master_parameters(const BusConfiguration& configuration) {
  canopen::MasterParameters parameters;
  parameters.own_node_id = static_cast<std::uint8_t>(configuration.host_node_id);
  parameters.heartbeat_period = host_duration(configuration.heartbeat_period);
  parameters.heartbeat_timeout = host_duration(configuration.heartbeat_timeout);
  parameters.sync_period = host_duration(configuration.sync_period);
  parameters.sync_tolerance = host_duration(configuration.sync_tolerance);
  parameters.isochronous = configuration.isochronous;
  parameters.time_stamp_period = configuration.time_stamp_period();
  parameters.bitrate = configuration.bitrate;
  parameters.max_bulk_load = configuration.max_load;
  parameters.sdo.timeout = host_duration(configuration.sdo_timeout);
  parameters.listen = host_duration(configuration.listen_before_start);
  parameters.alone = configuration.refuse_other_masters;
  return parameters;
}

}  // namespace

CanLink::CanLink(const BusConfiguration& configuration, transport::CanBus& bus,
                 std::unique_ptr<BusDevice> device)
    : BusLink(std::move(device)), bus_(bus), master_(configuration.name, master_parameters(configuration)) {}

void CanLink::receive(const WireObserver& observer) {
  while (const auto received = bus_.receive()) {
    if (observer.frame) observer.frame(name(), *received);
    ++(received->own ? sent_ : received_);
    master_.on_frame(*received);
  }
}

void CanLink::send_outgoing(HostTime now) {
  while (const canopen::Frame* frame = master_.peek_outgoing(now)) {
    if (!bus_.send(*frame, now)) break;
    master_.pop_outgoing(now);
  }
  peak_load_ = std::max(peak_load_, master_.bus_load(now));
}

void CanLink::fill_traffic(motion::BusSnapshot& out) const {
  out.load = master_.bus_load();
  out.frames_sent = sent_;
  out.frames_received = received_;
  const canopen::SyncTiming& timing = master_.sync_timing();
  out.sync_delay = timing.delay();
  out.sync_jitter = timing.jitter();
  out.syncs_skipped = timing.skipped();
}

std::uint64_t CanLink::unexpected() const {
  std::uint64_t frames = 0;
  for (int cause = 0; cause < canopen::kUnexpectedFrameCauses; ++cause)
    frames += master_.foreign().unexpected(static_cast<canopen::UnexpectedFrame>(cause)).count;
  return frames;
}

std::vector<std::string> CanLink::unexpected_traffic() const {
  std::vector<std::string> texts;
  for (int cause = 0; cause < canopen::kUnexpectedFrameCauses; ++cause) {
    std::string text = master_.unexpected_text(static_cast<canopen::UnexpectedFrame>(cause));
    if (!text.empty()) texts.push_back(std::move(text));
  }
  return texts;
}

double CanLink::record_bus_time() const {
  return longest_frame_bits(kRecordBytes) /
         (master_.parameters().bitrate * master_.parameters().max_bulk_load);
}

}  // namespace interpolated_motion::hardware
