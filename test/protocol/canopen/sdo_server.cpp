#include "protocol/canopen/sdo_server.h"

#include <algorithm>

namespace interpolated_motion::canopen::test {
namespace {

std::uint32_t key_of(const Frame& f) {
  return static_cast<std::uint32_t>(f.data[2]) << 16 | static_cast<std::uint32_t>(f.data[1]) << 8 | f.data[3];
}

std::uint32_t word_of(const Frame& f) {
  return static_cast<std::uint32_t>(f.data[4]) | static_cast<std::uint32_t>(f.data[5]) << 8 |
         static_cast<std::uint32_t>(f.data[6]) << 16 | static_cast<std::uint32_t>(f.data[7]) << 24;
}

/// CRC-16-CCITT by polynomial long division of the message, bit by bit, with 16 zero bits appended.
int crc_of(const std::vector<std::uint8_t>& bytes) {
  unsigned remainder = 0;
  for (std::size_t bit = 0; bit < 8 * bytes.size() + 16; ++bit) {
    const unsigned next = bit < 8 * bytes.size() ? bytes[bit / 8] >> (7 - bit % 8) & 1u : 0u;
    remainder = remainder << 1 | next;
    if ((remainder & 0x10000u) != 0) remainder ^= 0x11021u;
  }
  return static_cast<int>(remainder);
}

}  // namespace

std::vector<Frame> SdoServer::handle(const Frame& request) {
  out_.clear();
  if (on_request(requests_++, request)) process(request);
  return out_;
}

void SdoServer::process(const Frame& request) {
  const int command = request.data[0];
  const bool block_data = phase_ == Phase::BlockDownload && command != 0x80;
  if (block_data) return block_download_segment(request);
  if (command == 0x80) {
    client_abort_ = word_of(request);
    phase_ = Phase::Idle;
    return;
  }
  if (phase_ == Phase::BlockDownloadEnd && (command & 0xE3) == 0xC1) return block_download_end(request);
  if (command >> 5 == 3) return upload_segment(request);
  if (command >> 5 == 0) return download_segment(request);
  if (command == 0xA1 || command == 0xA2 || command == 0xA3) return block_upload(request);
  initiate(request);
}

void SdoServer::initiate(const Frame& request) {
  key_ = key_of(request);
  toggle_ = false;
  position_ = 0;
  phase_ = Phase::Idle;
  if (refuse_with != 0) return abort(refuse_with);
  switch (request.data[0] >> 5) {
    case 1:
      return start_download(request);
    case 2:
      return start_upload();
    case 5:
      return start_block_upload(request);
    case 6:
      return start_block_download(request);
    default:
      return abort(0x05040001);
  }
}

void SdoServer::start_upload() {
  if (objects.count(key_) == 0) return abort(0x06020000);
  data_ = objects[key_];
  if (data_.size() >= 1 && data_.size() <= 4) {
    const int size = static_cast<int>(data_.size());
    std::uint32_t value = 0;
    for (int i = size; i-- > 0;) value = value << 8 | data_[static_cast<std::size_t>(i)];
    return reply_initiate(announce_size ? 0x43 | (4 - size) << 2 : 0x42, value);
  }
  phase_ = Phase::Upload;
  reply_initiate(announce_size ? 0x41 : 0x40, announce_size ? static_cast<std::uint32_t>(data_.size()) : 0);
}

void SdoServer::upload_segment(const Frame& request) {
  if (phase_ != Phase::Upload) return abort(0x05040001);
  if (((request.data[0] & 0x10) != 0) != toggle_) return abort(0x05030000);
  const std::size_t count = std::min<std::size_t>(7, data_.size() - position_);
  std::uint8_t b[7] = {};
  for (std::size_t i = 0; i < count; ++i) b[i] = data_[position_ + i];
  position_ += count;
  const bool last = position_ == data_.size();
  const int command = (toggle_ ? 0x10 : 0) | static_cast<int>(7 - count) << 1 | (last ? 1 : 0);
  toggle_ = !toggle_;
  if (last) phase_ = Phase::Idle;
  reply({command, b[0], b[1], b[2], b[3], b[4], b[5], b[6]});
}

void SdoServer::start_download(const Frame& request) {
  const int command = request.data[0];
  data_.clear();
  if ((command & 2) != 0) {
    const int size = (command & 1) != 0 ? 4 - (command >> 2 & 3) : 4;
    data_.assign(request.data.begin() + 4, request.data.begin() + 4 + size);
    store();
  } else {
    announced_ = word_of(request);
    phase_ = Phase::Download;
  }
  reply_initiate(0x60, 0);
}

void SdoServer::download_segment(const Frame& request) {
  if (phase_ != Phase::Download) return abort(0x05040001);
  const int command = request.data[0];
  if (((command & 0x10) != 0) != toggle_) return abort(0x05030000);
  const int count = 7 - (command >> 1 & 7);
  data_.insert(data_.end(), request.data.begin() + 1, request.data.begin() + 1 + count);
  if ((command & 1) != 0) {
    if (data_.size() != announced_) return abort(0x06070010);
    store();
    phase_ = Phase::Idle;
  }
  reply({toggle_ ? 0x30 : 0x20, 0, 0, 0, 0, 0, 0, 0});
  toggle_ = !toggle_;
}

void SdoServer::start_block_upload(const Frame& request) {
  if (!block_transfer) return start_upload();
  if (objects.count(key_) == 0) return abort(0x06020000);
  data_ = objects[key_];
  window_ = request.data[4];
  client_crc_ = (request.data[0] & 4) != 0;
  phase_ = Phase::BlockUpload;
  const auto size = static_cast<std::uint32_t>(data_.size());
  reply_initiate(0xC0 | (crc ? 4 : 0) | (announce_size ? 2 : 0), announce_size ? size : 0);
}

void SdoServer::block_upload(const Frame& request) {
  if (phase_ == Phase::BlockUploadEnd && request.data[0] == 0xA1) {
    phase_ = Phase::Idle;
    return;
  }
  if (phase_ != Phase::BlockUpload) return abort(0x05040001);
  if (request.data[0] == 0xA2) {
    position_ += std::size_t{7} * request.data[1];
    window_ = request.data[2];
    if (position_ >= std::max<std::size_t>(1, data_.size())) {
      const int unused = static_cast<int>(position_ - data_.size());
      const int check = crc && client_crc_ ? crc_of(data_) : 0;
      phase_ = Phase::BlockUploadEnd;
      return reply({0xC1 | unused << 2, check & 0xFF, check >> 8, 0, 0, 0, 0, 0});
    }
  }
  send_block();
}

void SdoServer::send_block() {
  std::size_t from = position_;
  for (int sequence = 1; sequence <= window_; ++sequence) {
    std::uint8_t b[7] = {};
    for (std::size_t i = 0; i < 7 && from + i < data_.size(); ++i) b[i] = data_[from + i];
    from += 7;
    const bool last = from >= data_.size();
    reply({sequence | (last ? 0x80 : 0), b[0], b[1], b[2], b[3], b[4], b[5], b[6]});
    if (last) return;
  }
}

void SdoServer::start_block_download(const Frame& request) {
  if (!block_transfer) return abort(0x05040001);
  announced_ = word_of(request);
  client_crc_ = (request.data[0] & 4) != 0;
  data_.clear();
  sequence_ = 0;
  last_seen_ = false;
  phase_ = Phase::BlockDownload;
  reply_initiate(crc ? 0xA4 : 0xA0, static_cast<std::uint32_t>(block_size));
}

void SdoServer::block_download_segment(const Frame& request) {
  const int sequence = request.data[0] & 0x7F;
  const bool last = (request.data[0] & 0x80) != 0;
  if (sequence == sequence_ + 1) {
    data_.insert(data_.end(), request.data.begin() + 1, request.data.end());
    sequence_ = sequence;
    last_seen_ = last;
  }
  if (!last && sequence != block_size) return;
  reply({0xA2, sequence_, block_size, 0, 0, 0, 0, 0});
  sequence_ = 0;
  if (last_seen_) phase_ = Phase::BlockDownloadEnd;
}

void SdoServer::block_download_end(const Frame& request) {
  data_.resize(data_.size() - (request.data[0] >> 2 & 7u));
  const int check = request.data[1] | request.data[2] << 8;
  if (crc && client_crc_ && check != crc_of(data_)) return abort(0x05040004);
  if (data_.size() != announced_) return abort(0x06070010);
  store();
  phase_ = Phase::Idle;
  reply({0xA1, 0, 0, 0, 0, 0, 0, 0});
}

void SdoServer::store() { objects[key_] = data_; }

void SdoServer::reply(std::initializer_list<int> bytes) {
  Frame frame;
  frame.id = 0x580u + node_;
  frame.length = 8;
  std::transform(bytes.begin(), bytes.end(), frame.data.begin(),
                 [](int byte) { return static_cast<std::uint8_t>(byte); });
  if (on_reply(replies_++, frame)) out_.push_back(frame);
}

void SdoServer::reply_initiate(int command, std::uint32_t value) {
  const auto byte = [value](int n) { return static_cast<int>(value >> (8 * n) & 0xFF); };
  const int index = static_cast<int>(key_ >> 8);
  reply(
      {command, index & 0xFF, index >> 8, static_cast<int>(key_ & 0xFF), byte(0), byte(1), byte(2), byte(3)});
}

void SdoServer::abort(std::uint32_t code) {
  phase_ = Phase::Idle;
  reply_initiate(0x80, code);
}

}  // namespace interpolated_motion::canopen::test
