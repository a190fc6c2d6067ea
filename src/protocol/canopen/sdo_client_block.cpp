#include <algorithm>

#include "interpolated_motion_driver/protocol/canopen/crc16.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_client.h"

// Block transfer, CiA 301, 7.2.4.3.9 to 7.2.4.3.15.
namespace interpolated_motion::canopen {
namespace {

constexpr std::size_t kSegmentBytes = 7;
constexpr unsigned kMaxBlockSize = 127;
constexpr unsigned kCrcSupported = 0x04;
constexpr unsigned kSizeIndicated = 0x02;
constexpr unsigned kLastSegment = 0x80;

/// A peer that acknowledges nothing, again and again, would keep the transfer running for ever.
constexpr int kMaxBlocksWithoutProgress = 3;

unsigned unused_bytes_of(const Frame& end) { return end.data[0] >> 2 & 7u; }

}  // namespace

void SdoClient::on_block_upload_initiate(const Frame& frame, HostTime now) {
  const unsigned command = frame.data[0];
  // A server may answer with a normal upload: one without block transfer, or for a short object.
  if ((command & 0xE0) == 0x40) return on_upload_initiate(frame, now);
  if ((command & 0xE1) != 0xC0) return abort(abort_code::kCommand);
  if ((command & kSizeIndicated) != 0 && !accept_size(frame)) return abort(abort_code::kMemory);
  crc_used_ = (command & kCrcSupported) != 0;
  block_size_ = parameters_.block_size;
  block_sequence_ = 0;
  state_ = State::BlockUploadSegments;
  send(request(0xA3), now);
}

void SdoClient::on_block_upload_segment(const Frame& frame, HostTime now) {
  const auto sequence = static_cast<std::uint8_t>(frame.data[0] & 0x7F);
  const bool last = (frame.data[0] & kLastSegment) != 0;
  if (sequence == 0 || sequence > block_size_) return abort(abort_code::kSequence);
  const bool expected = sequence == block_sequence_ + 1;
  if (expected && !take_block_segment(frame, now)) return;
  // The last one of a block ends it even when one before it was lost: the server repeats from the gap on.
  if (last || sequence == block_size_) acknowledge_block(expected && last, now);
}

bool SdoClient::take_block_segment(const Frame& frame, HostTime now) {
  const std::size_t limit = size_known_ ? announced_size_ : parameters_.max_size;
  const bool full = transfer_.data.size() >= limit && !transfer_.data.empty();
  if (full) {
    abort(size_known_ ? abort_code::kTooLong : abort_code::kMemory);
    return false;
  }
  transfer_.data.append(&frame.data[1], kSegmentBytes);
  ++block_sequence_;
  deadline_ = now + timeout_;
  return true;
}

void SdoClient::acknowledge_block(bool last, HostTime now) {
  if (!count_progress(block_sequence_)) return abort(abort_code::kSequence);
  Frame frame = request(0xA2);
  frame.data[1] = block_sequence_;
  frame.data[2] = parameters_.block_size;
  block_sequence_ = 0;
  if (last) state_ = State::BlockUploadEnd;
  send(frame, now);
}

bool SdoClient::count_progress(unsigned segments) {
  blocks_without_progress_ = segments == 0 ? blocks_without_progress_ + 1 : 0;
  return blocks_without_progress_ <= kMaxBlocksWithoutProgress;
}

void SdoClient::on_block_upload_end(const Frame& frame) {
  if ((frame.data[0] & 0xE3) != 0xC1) return abort(abort_code::kCommand);
  transfer_.data.truncate(transfer_.data.size() - unused_bytes_of(frame));
  if (size_known_ && transfer_.data.size() != announced_size_) return abort(abort_code::kLengthMismatch);
  const std::uint16_t crc = crc16(transfer_.data.data(), transfer_.data.size());
  if (crc_used_ && crc != get_le<std::uint16_t>(&frame.data[1])) return abort(abort_code::kCrc);
  closing_ = request(0xA1);
  transfer_.last_sent = *closing_;
  finish(true, 0, false);
}

std::size_t SdoClient::total_segments() const {
  return std::max<std::size_t>(1, (transfer_.data.size() + kSegmentBytes - 1) / kSegmentBytes);
}

void SdoClient::on_block_download_initiate(const Frame& frame, HostTime now) {
  if ((frame.data[0] & 0xE3) != 0xA0) return abort(abort_code::kCommand);
  crc_used_ = (frame.data[0] & kCrcSupported) != 0;
  begin_block(0, frame.data[4], now);
}

void SdoClient::begin_block(std::size_t first_segment, unsigned block_size, HostTime now) {
  if (block_size < 1 || block_size > kMaxBlockSize) return abort(abort_code::kBlockSize);
  block_first_ = first_segment;
  block_size_ =
      static_cast<std::uint8_t>(std::min<std::size_t>(block_size, total_segments() - first_segment));
  block_sequence_ = 0;
  state_ = State::BlockDownloadSegments;
  deadline_ = now + timeout_;
}

Frame SdoClient::block_segment() {
  const std::size_t index = block_first_ + block_sequence_++;
  const std::size_t offset = index * kSegmentBytes;
  Frame frame = request(block_sequence_);
  if (index + 1 == total_segments()) frame.data[0] |= kLastSegment;
  std::copy_n(transfer_.data.data() + offset, std::min(kSegmentBytes, transfer_.data.size() - offset),
              frame.data.begin() + 1);
  transfer_.last_sent = frame;
  return frame;
}

void SdoClient::on_block_download_acknowledge(const Frame& frame, HostTime now) {
  if ((frame.data[0] & 0xE3) != 0xA2) return abort(abort_code::kCommand);
  const unsigned acknowledged = frame.data[1];
  if (acknowledged > block_sequence_ || !count_progress(acknowledged)) return abort(abort_code::kSequence);
  const std::size_t next = block_first_ + acknowledged;
  if (next < total_segments()) return begin_block(next, frame.data[2], now);
  send_block_end(now);
}

void SdoClient::send_block_end(HostTime now) {
  const std::size_t unused = total_segments() * kSegmentBytes - transfer_.data.size();
  Frame frame = request(static_cast<std::uint8_t>(0xC1 | unused << 2));
  if (crc_used_) put_le(&frame.data[1], crc16(transfer_.data.data(), transfer_.data.size()));
  state_ = State::BlockDownloadEnd;
  send(frame, now);
}

void SdoClient::on_block_download_end(const Frame& frame) {
  if ((frame.data[0] & 0xE3) != 0xA1) return abort(abort_code::kCommand);
  finish(true, 0, false);
}

}  // namespace interpolated_motion::canopen
