#include "interpolated_motion_driver/protocol/canopen/sdo_client.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"

namespace interpolated_motion::canopen {
namespace {

constexpr std::uint8_t kAbort = 0x80;

void check(std::uint8_t node, const SdoParameters& p) {
  if (!valid_node_id(node)) {
    throw std::invalid_argument(fmt::format("SDO client: node id {} is not in 1..{}", node, kMaxNodeId));
  }
  if (p.timeout <= HostDuration::zero()) {
    throw std::invalid_argument(
        fmt::format("SDO client of node {}: time-out of {} ns is not above 0", node, p.timeout.count()));
  }
  if (p.block_size < 1 || p.block_size > 127) {
    throw std::invalid_argument(
        fmt::format("SDO client of node {}: block size {} is not in 1..127", node, p.block_size));
  }
}

}  // namespace

SdoClient::SdoClient(std::uint8_t node, SdoParameters parameters) : node_(node), parameters_(parameters) {
  check(node_, parameters_);
}

bool SdoClient::start_upload(ObjectAddress address, HostTime now, SdoTransfer transfer) {
  const bool block = transfer == SdoTransfer::Block;
  if (!start(address, SdoDirection::Upload, block ? State::BlockUploadInitiate : State::UploadInitiate)) {
    return false;
  }
  Frame frame = initiate_request(block ? 0xA4 : 0x40);
  if (block) frame.data[4] = parameters_.block_size;
  send(frame, now);
  return true;
}

bool SdoClient::start_download(ObjectAddress address, const std::uint8_t* bytes, std::size_t size,
                               HostTime now, SdoTransfer transfer) {
  const bool block = transfer == SdoTransfer::Block;
  if (!start(address, SdoDirection::Download,
             block ? State::BlockDownloadInitiate : State::DownloadInitiate)) {
    return false;
  }
  transfer_.data.append(bytes, size);
  Frame frame = initiate_request(block ? 0xC6 : 0x21);
  if (!block && is_expedited()) {
    frame.data[0] = static_cast<std::uint8_t>(0x23 | (4 - size) << 2);
    for (std::size_t i = 0; i < size; ++i) frame.data[4 + i] = bytes[i];
  } else {
    put_le(&frame.data[4], static_cast<std::uint32_t>(size));
  }
  send(frame, now);
  return true;
}

bool SdoClient::start_download(ObjectAddress address, const std::vector<std::uint8_t>& bytes, HostTime now,
                               SdoTransfer transfer) {
  return start_download(address, bytes.data(), bytes.size(), now, transfer);
}

bool SdoClient::start_download(const SdoWrite& write, HostTime now) {
  std::uint8_t bytes[8];
  put_le(bytes, write.value);
  return start_download(write.address, bytes, write.size, now);
}

bool SdoClient::start(ObjectAddress address, SdoDirection direction, State state) {
  if (busy()) return false;
  has_result_ = false;
  transfer_ = SdoResult{};
  transfer_.node = node_;
  transfer_.address = address;
  transfer_.direction = direction;
  transfer_.timeout = parameters_.timeout;
  state_ = state;
  timeout_ = parameters_.timeout;
  toggle_ = false;
  size_known_ = false;
  blocks_without_progress_ = 0;
  return true;
}

void SdoClient::abort(std::uint32_t abort_code) {
  if (!busy()) return;
  const bool drive_knows = !(is_initiate() && request_);
  request_.reset();
  if (drive_knows) {
    Frame frame = initiate_request(kAbort);
    put_le(&frame.data[4], abort_code);
    closing_ = frame;
  }
  finish(false, abort_code, false);
}

void SdoClient::finish(bool ok, std::uint32_t code, bool by_drive) {
  transfer_.ok = ok;
  transfer_.abort_code = code;
  transfer_.aborted_by_drive = by_drive;
  if (!ok && transfer_.direction == SdoDirection::Upload) transfer_.data.clear();
  state_ = State::Idle;
  has_result_ = true;
}

void SdoClient::poll(HostTime now) {
  if (busy() && now >= deadline_) abort(abort_code::kTimeout);
}

std::optional<SdoResult> SdoClient::take_result() {
  if (!has_result_) return std::nullopt;
  has_result_ = false;
  return std::move(transfer_);
}

std::optional<Frame> SdoClient::next_frame(HostTime now) {
  std::optional<Frame> frame;
  if (closing_) {
    frame.swap(closing_);
  } else if (request_) {
    frame.swap(request_);
    deadline_ = std::max(deadline_, now + timeout_);
  } else if (segment_due()) {
    frame = block_segment();
    deadline_ = std::max(deadline_, now + timeout_);
  }
  return frame;
}

void SdoClient::send(const Frame& frame, HostTime now) {
  request_ = frame;
  transfer_.last_sent = frame;
  deadline_ = now + timeout_;
}

Frame SdoClient::request(std::uint8_t command) const {
  Frame frame;
  frame.id = cob_id::sdo_request(node_);
  frame.length = 8;
  frame.data[0] = command;
  return frame;
}

Frame SdoClient::initiate_request(std::uint8_t command) const {
  Frame frame = request(command);
  put_le(&frame.data[1], transfer_.address.index);
  frame.data[3] = transfer_.address.subindex;
  return frame;
}

void SdoClient::on_frame(const Frame& frame, HostTime now) {
  // A frame cannot be the answer to a request that has not been handed out yet.
  const bool usable = busy() && !request_ && !frame.remote && frame.length == 8;
  if (!usable) return ignore();
  if (frame.data[0] == kAbort) return on_abort(frame);
  if (is_initiate() && !is_for_this_object(frame)) return ignore();
  if (is_repeated_initiate(frame)) return ignore();
  dispatch(frame, now);
}

void SdoClient::on_abort(const Frame& frame) {
  // Once the initiate has been answered, an abort can only be meant for this transfer, whatever object it
  // names.
  if (is_initiate() && !is_for_this_object(frame)) return ignore();
  finish(false, get_le<std::uint32_t>(&frame.data[4]), true);
}

void SdoClient::dispatch(const Frame& frame, HostTime now) {
  switch (state_) {
    case State::Idle:
      return;
    case State::UploadInitiate:
      return on_upload_initiate(frame, now);
    case State::UploadSegment:
      return on_upload_segment(frame, now);
    case State::DownloadInitiate:
      return on_download_initiate(frame, now);
    case State::DownloadSegment:
      return on_download_segment(frame, now);
    case State::BlockUploadInitiate:
      return on_block_upload_initiate(frame, now);
    case State::BlockUploadSegments:
      return on_block_upload_segment(frame, now);
    case State::BlockUploadEnd:
      return on_block_upload_end(frame);
    case State::BlockDownloadInitiate:
      return on_block_download_initiate(frame, now);
    case State::BlockDownloadSegments:
      return on_block_download_acknowledge(frame, now);
    case State::BlockDownloadEnd:
      return on_block_download_end(frame);
  }
}

bool SdoClient::is_for_this_object(const Frame& frame) const {
  return get_le<std::uint16_t>(&frame.data[1]) == transfer_.address.index &&
         frame.data[3] == transfer_.address.subindex;
}

bool SdoClient::is_initiate() const {
  return state_ == State::UploadInitiate || state_ == State::DownloadInitiate ||
         state_ == State::BlockUploadInitiate || state_ == State::BlockDownloadInitiate;
}

/// After a time-out and a second try, the answer to the first try may be followed by that to the second. And
/// a late answer may be of a transfer to the same object in the other direction.
bool SdoClient::is_repeated_initiate(const Frame& frame) const {
  const unsigned command = frame.data[0];
  switch (state_) {
    case State::UploadInitiate:
      return command == 0x60;
    case State::DownloadInitiate:
      return (command & 0xE0) == 0x40;
    case State::UploadSegment:
      return (command & 0xE0) == 0x40 && is_for_this_object(frame);
    case State::DownloadSegment:
      return command == 0x60 && is_for_this_object(frame);
    case State::BlockDownloadSegments:
      return (command & 0xE3) == 0xA0 && is_for_this_object(frame);
    default:
      return false;
  }
}

}  // namespace interpolated_motion::canopen
