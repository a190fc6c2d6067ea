#include <algorithm>

#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_client.h"

// Expedited and segmented transfer, CiA 301, 7.2.4.3.3 to 7.2.4.3.6 (download) and 7.2.4.3.7 to 7.2.4.3.8
// (upload).
namespace interpolated_motion::canopen {
namespace {

constexpr std::size_t kSegmentBytes = 7;
constexpr unsigned kToggleBit = 0x10;

unsigned specifier(const Frame& frame) { return frame.data[0] >> 5; }
bool toggle_of(const Frame& frame) { return (frame.data[0] & kToggleBit) != 0; }

}  // namespace

bool SdoClient::is_expedited() const { return transfer_.data.size() >= 1 && transfer_.data.size() <= 4; }

void SdoClient::on_upload_initiate(const Frame& frame, HostTime now) {
  const unsigned command = frame.data[0];
  if (specifier(frame) != 2) return abort(abort_code::kCommand);
  const bool expedited = (command & 2) != 0;
  const bool size_given = (command & 1) != 0;
  if (expedited) {
    const std::size_t size = size_given ? 4 - (command >> 2 & 3) : 4;
    transfer_.data.append(&frame.data[4], size);
    return finish(true, 0, false);
  }
  if (size_given && !accept_size(frame)) return abort(abort_code::kMemory);
  state_ = State::UploadSegment;
  send(request(0x60), now);
}

bool SdoClient::accept_size(const Frame& frame) {
  size_known_ = true;
  announced_size_ = get_le<std::uint32_t>(&frame.data[4]);
  return announced_size_ <= parameters_.max_size;
}

void SdoClient::on_upload_segment(const Frame& frame, HostTime now) {
  const unsigned command = frame.data[0];
  if (specifier(frame) != 0) return abort(abort_code::kCommand);
  if (toggle_of(frame) != toggle_) return abort(abort_code::kToggle);
  const std::size_t size = kSegmentBytes - (command >> 1 & 7);
  const bool last = (command & 1) != 0;
  // Empty segments that are not the last would keep the transfer running for ever.
  if (size == 0 && !last) return abort(abort_code::kCommand);
  if (!append_received(&frame.data[1], size)) return;
  if (last) return finish_upload();
  toggle_ = !toggle_;
  send(request(toggle_ ? 0x70 : 0x60), now);
}

/// Takes over received bytes; aborts and returns false when there are more than announced or allowed.
bool SdoClient::append_received(const std::uint8_t* bytes, std::size_t count) {
  const std::size_t size = transfer_.data.size() + count;
  if (size_known_ && size > announced_size_) {
    abort(abort_code::kTooLong);
    return false;
  }
  if (size > parameters_.max_size) {
    abort(abort_code::kMemory);
    return false;
  }
  transfer_.data.append(bytes, count);
  return true;
}

void SdoClient::finish_upload() {
  if (size_known_ && transfer_.data.size() < announced_size_) return abort(abort_code::kTooShort);
  finish(true, 0, false);
}

void SdoClient::on_download_initiate(const Frame& frame, HostTime now) {
  if (specifier(frame) != 3) return abort(abort_code::kCommand);
  if (is_expedited()) return finish(true, 0, false);
  state_ = State::DownloadSegment;
  sent_ = 0;
  send_download_segment(now);
}

void SdoClient::send_download_segment(HostTime now) {
  const std::size_t size = std::min(kSegmentBytes, transfer_.data.size() - sent_);
  Frame frame = request(static_cast<std::uint8_t>((toggle_ ? kToggleBit : 0u) | (kSegmentBytes - size) << 1));
  std::copy_n(transfer_.data.data() + sent_, size, frame.data.begin() + 1);
  sent_ += size;
  if (sent_ == transfer_.data.size()) frame.data[0] |= 1;
  send(frame, now);
}

void SdoClient::on_download_segment(const Frame& frame, HostTime now) {
  if (specifier(frame) != 1) return abort(abort_code::kCommand);
  if (toggle_of(frame) != toggle_) return abort(abort_code::kToggle);
  if (sent_ == transfer_.data.size()) return finish(true, 0, false);
  toggle_ = !toggle_;
  send_download_segment(now);
}

}  // namespace interpolated_motion::canopen
