#include "interpolated_motion_driver/emulation/canopen/sdo_server.h"

#include <algorithm>

namespace interpolated_motion::emulation {
namespace {

// Command bytes of CiA 301, 7.2.4.3.
constexpr std::uint8_t kAbort = 0x80;
constexpr std::uint8_t kDownloadConfirmed = 0x60;
constexpr std::uint8_t kSegmentConfirmed = 0x20;
constexpr std::uint8_t kBlockDownloadConfirmed = 0xA4;  // the server computes the CRC
constexpr std::uint8_t kBlockConfirmed = 0xA2;
constexpr std::uint8_t kBlockEndConfirmed = 0xA1;
constexpr std::uint8_t kBlockUploadConfirmed = 0xC6;  // CRC and size
constexpr std::uint8_t kBlockUploadEnd = 0xC1;
constexpr std::uint8_t kToggle = 0x10;
constexpr std::uint8_t kLastOfBlock = 0x80;
constexpr std::uint8_t kServerBlockSize = 127;
constexpr std::size_t kSegment = 7;

std::uint32_t u32(const std::uint8_t* bytes) {
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8 |
         static_cast<std::uint32_t>(bytes[2]) << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

void put_u32(std::uint8_t* bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

// CRC-16/XMODEM: polynomial 0x1021, start value 0 (CiA 301, block transfer).
std::uint16_t crc16(const std::uint8_t* bytes, std::size_t size) {
  std::uint16_t crc = 0;
  for (std::size_t i = 0; i < size; ++i) {
    crc = static_cast<std::uint16_t>(crc ^ (bytes[i] << 8));
    for (int bit = 0; bit < 8; ++bit) {
      const bool carry = (crc & 0x8000) != 0;
      crc = static_cast<std::uint16_t>(crc << 1);
      if (carry) crc = static_cast<std::uint16_t>(crc ^ 0x1021);
    }
  }
  return crc;
}

}  // namespace

SdoServer::Bytes SdoServer::abort(AbortCode code) {
  state_ = State::Idle;
  Bytes response = confirm(kAbort);
  put_u32(&response[4], static_cast<std::uint32_t>(code));
  return response;
}

SdoServer::Bytes SdoServer::confirm(std::uint8_t command) const {
  return {
      command, static_cast<std::uint8_t>(index_), static_cast<std::uint8_t>(index_ >> 8), subindex_, 0, 0, 0,
      0};
}

void SdoServer::take_multiplexer(const Bytes& request) {
  index_ = static_cast<std::uint16_t>(request[1] | request[2] << 8);
  subindex_ = request[3];
}

std::optional<SdoServer::Bytes> SdoServer::on_request(const Bytes& request) {
  if (request[0] == kAbort) {
    state_ = State::Idle;
    return std::nullopt;
  }
  if (state_ == State::BlockDownload) return block_download_segment(request);
  switch (request[0] >> 5) {
    case 0:
      return download_segment(request);
    case 1:
      return start_download(request);
    case 2:
      return start_upload(request);
    case 3:
      return upload_segment(request);
    case 5:
      return block_upload(request);
    case 6:
      return (request[0] & 1) == 0 ? start_block_download(request) : end_block_download(request);
    default:
      return abort(AbortCode::CommandSpecifier);
  }
}

std::optional<SdoServer::Bytes> SdoServer::start_download(const Bytes& request) {
  take_multiplexer(request);
  state_ = State::Idle;
  std::size_t object_size = 0;
  const AbortCode refusal = objects_.sdo_writable(index_, subindex_, object_size);
  if (refusal != AbortCode::None) return abort(refusal);
  const bool expedited = (request[0] & 2) != 0;
  const bool sized = (request[0] & 1) != 0;
  if (expedited) {
    const std::size_t size = sized ? 4U - ((request[0] >> 2) & 3U) : std::min<std::size_t>(object_size, 4);
    const AbortCode code = objects_.sdo_write(index_, subindex_, &request[4], size);
    return code == AbortCode::None ? confirm(kDownloadConfirmed) : abort(code);
  }
  announced_ = sized ? u32(&request[4]) : 0;
  if (sized && announced_ > object_size) return abort(AbortCode::TooLong);
  if (sized && announced_ < object_size) return abort(AbortCode::TooShort);
  size_ = 0;
  toggle_ = false;
  state_ = State::SegmentedDownload;
  return confirm(kDownloadConfirmed);
}

std::optional<SdoServer::Bytes> SdoServer::download_segment(const Bytes& request) {
  if (state_ != State::SegmentedDownload) return abort(AbortCode::CommandSpecifier);
  const bool toggle = (request[0] & kToggle) != 0;
  if (toggle != toggle_) return abort(AbortCode::ToggleBit);
  const std::size_t length = kSegment - ((request[0] >> 1) & 7U);
  if (size_ + length > data_.size()) return abort(AbortCode::TooLong);
  std::copy_n(&request[1], length, &data_[size_]);
  size_ += length;
  const bool last = (request[0] & 1) != 0;
  const auto answer = static_cast<std::uint8_t>(kSegmentConfirmed | (toggle ? kToggle : 0));
  toggle_ = !toggle_;
  if (!last) return Bytes{answer};
  if (announced_ != 0 && size_ != announced_) return abort(AbortCode::LengthMismatch);
  const AbortCode code = objects_.sdo_write(index_, subindex_, data_.data(), size_);
  if (code != AbortCode::None) return abort(code);
  state_ = State::Idle;
  return Bytes{answer};
}

std::optional<SdoServer::Bytes> SdoServer::start_upload(const Bytes& request) {
  take_multiplexer(request);
  state_ = State::Idle;
  const AbortCode code = objects_.sdo_read(index_, subindex_, data_, size_);
  return code == AbortCode::None ? answer_upload() : abort(code);
}

SdoServer::Bytes SdoServer::answer_upload() {
  if (size_ >= 1 && size_ <= 4) {
    Bytes response = confirm(static_cast<std::uint8_t>(0x43 | (4 - size_) << 2));
    std::copy_n(data_.begin(), size_, &response[4]);
    return response;
  }
  Bytes response = confirm(0x41);
  put_u32(&response[4], static_cast<std::uint32_t>(size_));
  sent_ = 0;
  toggle_ = false;
  state_ = State::SegmentedUpload;
  return response;
}

std::optional<SdoServer::Bytes> SdoServer::upload_segment(const Bytes& request) {
  if (state_ != State::SegmentedUpload) return abort(AbortCode::CommandSpecifier);
  if (((request[0] & kToggle) != 0) != toggle_) return abort(AbortCode::ToggleBit);
  const std::size_t length = std::min(kSegment, size_ - sent_);
  const bool last = sent_ + length == size_;
  Bytes response{};
  response[0] =
      static_cast<std::uint8_t>((toggle_ ? kToggle : 0) | (kSegment - length) << 1 | (last ? 1 : 0));
  std::copy_n(&data_[sent_], length, &response[1]);
  sent_ += length;
  toggle_ = !toggle_;
  if (last) state_ = State::Idle;
  return response;
}

std::optional<SdoServer::Bytes> SdoServer::start_block_download(const Bytes& request) {
  take_multiplexer(request);
  std::size_t object_size = 0;
  const AbortCode refusal = objects_.sdo_writable(index_, subindex_, object_size);
  if (refusal != AbortCode::None) return abort(refusal);
  const bool sized = (request[0] & 2) != 0;
  announced_ = sized ? u32(&request[4]) : 0;
  if (sized && announced_ > object_size) return abort(AbortCode::TooLong);
  if (sized && announced_ < object_size) return abort(AbortCode::TooShort);
  crc_ = (request[0] & 4) != 0;
  size_ = 0;
  sequence_ = 0;
  state_ = State::BlockDownload;
  Bytes response = confirm(kBlockDownloadConfirmed);
  response[4] = kServerBlockSize;
  return response;
}

std::optional<SdoServer::Bytes> SdoServer::block_download_segment(const Bytes& request) {
  const auto number = static_cast<std::uint8_t>(request[0] & 0x7F);
  const bool last = (request[0] & kLastOfBlock) != 0;
  if (number == 0) return abort(AbortCode::SequenceNumber);
  const bool expected = number == sequence_ + 1;
  if (expected) {
    if (size_ + kSegment > data_.size()) return abort(AbortCode::TooLong);
    std::copy_n(&request[1], kSegment, &data_[size_]);
    size_ += kSegment;
    ++sequence_;
  }
  if (!last && number < kServerBlockSize) return std::nullopt;
  const Bytes response{kBlockConfirmed, sequence_, kServerBlockSize};
  sequence_ = 0;
  if (expected && last) state_ = State::BlockDownloadEnd;
  return response;
}

std::optional<SdoServer::Bytes> SdoServer::end_block_download(const Bytes& request) {
  if (state_ != State::BlockDownloadEnd) return abort(AbortCode::CommandSpecifier);
  const std::size_t unused = (request[0] >> 2) & 7U;
  if (unused > size_) return abort(AbortCode::LengthMismatch);
  size_ -= unused;
  if (announced_ != 0 && size_ != announced_) return abort(AbortCode::LengthMismatch);
  const auto crc = static_cast<std::uint16_t>(request[1] | request[2] << 8);
  if (crc_ && crc != crc16(data_.data(), size_)) return abort(AbortCode::Crc);
  const AbortCode code = objects_.sdo_write(index_, subindex_, data_.data(), size_);
  if (code != AbortCode::None) return abort(code);
  state_ = State::Idle;
  return Bytes{kBlockEndConfirmed};
}

std::optional<SdoServer::Bytes> SdoServer::block_upload(const Bytes& request) {
  switch (request[0] & 3) {
    case 0:
      return start_block_upload(request);
    case 1:
      if (state_ != State::BlockUploadEnd) return abort(AbortCode::CommandSpecifier);
      state_ = State::Idle;
      return std::nullopt;
    case 2:
      return acknowledge_block(request);
    default:
      if (state_ != State::BlockUploadReady) return abort(AbortCode::CommandSpecifier);
      state_ = State::BlockUploading;
      sequence_ = 0;
      return std::nullopt;
  }
}

std::optional<SdoServer::Bytes> SdoServer::start_block_upload(const Bytes& request) {
  take_multiplexer(request);
  state_ = State::Idle;
  const AbortCode code = objects_.sdo_read(index_, subindex_, data_, size_);
  if (code != AbortCode::None) return abort(code);
  const std::uint8_t block = request[4];
  const std::uint8_t protocol_switch = request[5];
  if (block == 0 || block > 127) return abort(AbortCode::BlockSize);
  if (protocol_switch != 0 && size_ <= protocol_switch) return answer_upload();
  block_size_ = block;
  crc_ = (request[0] & 4) != 0;
  sent_ = 0;
  state_ = State::BlockUploadReady;
  Bytes response = confirm(kBlockUploadConfirmed);
  put_u32(&response[4], static_cast<std::uint32_t>(size_));
  return response;
}

std::optional<SdoServer::Bytes> SdoServer::next_segment() {
  if (state_ != State::BlockUploading) return std::nullopt;
  const std::size_t offset = std::min(size_, sent_ + sequence_ * kSegment);
  const std::size_t length = std::min(kSegment, size_ - offset);
  last_segment_ = offset + length == size_;
  ++sequence_;
  Bytes segment{};
  segment[0] = static_cast<std::uint8_t>(sequence_ | (last_segment_ ? kLastOfBlock : 0));
  std::copy_n(&data_[offset], length, &segment[1]);
  if (last_segment_ || sequence_ == block_size_) state_ = State::BlockUploadAcknowledge;
  return segment;
}

std::optional<SdoServer::Bytes> SdoServer::acknowledge_block(const Bytes& request) {
  if (state_ != State::BlockUploadAcknowledge) return abort(AbortCode::CommandSpecifier);
  const std::uint8_t acknowledged = request[1];
  const std::uint8_t block = request[2];
  if (acknowledged > sequence_) return abort(AbortCode::SequenceNumber);
  if (block == 0 || block > 127) return abort(AbortCode::BlockSize);
  const bool complete = last_segment_ && acknowledged == sequence_;
  sent_ = std::min(size_, sent_ + acknowledged * kSegment);
  block_size_ = block;
  sequence_ = 0;
  if (!complete) {
    state_ = State::BlockUploading;
    return std::nullopt;
  }
  state_ = State::BlockUploadEnd;
  const std::size_t unused = (kSegment - size_ % kSegment) % kSegment;
  const std::uint16_t crc = crc_ ? crc16(data_.data(), size_) : std::uint16_t{0};
  return Bytes{static_cast<std::uint8_t>(kBlockUploadEnd | unused << 2), static_cast<std::uint8_t>(crc),
               static_cast<std::uint8_t>(crc >> 8)};
}

}  // namespace interpolated_motion::emulation
