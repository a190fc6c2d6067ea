#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::canopen::test {

/// An SDO server written from CiA 301 and the byte table of the protocol alone, to test the client against.
/// It shares no code with the client, and it breaks the protocol on demand.
class SdoServer {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit SdoServer(std::uint8_t node) : node_(node) {}

  std::map<std::uint32_t, Bytes> objects;  ///< key: index << 8 | sub-index
  bool announce_size = true;               ///< in replies to uploads
  bool block_transfer = true;     ///< else a block upload is answered normally, a block download aborted
  bool crc = true;                ///< takes part in the CRC of block transfers
  int block_size = 127;           ///< segments per block of a download
  std::uint32_t refuse_with = 0;  ///< abort code answered to every initiate; 0: none

  /// Called for the n-th request, n from 0; false loses it.
  std::function<bool(int, const Frame&)> on_request = [](int, const Frame&) { return true; };
  /// Called for the n-th reply, n from 0; may change it, false loses it.
  std::function<bool(int, Frame&)> on_reply = [](int, Frame&) { return true; };

  /// Hands over a request; returns the replies in their order.
  std::vector<Frame> handle(const Frame& request);

  int replies() const { return replies_; }
  int requests() const { return requests_; }
  /// Abort code the client sent last; 0 before.
  std::uint32_t client_abort() const { return client_abort_; }
  bool idle() const { return phase_ == Phase::Idle; }

 private:
  enum class Phase { Idle, Upload, Download, BlockUpload, BlockUploadEnd, BlockDownload, BlockDownloadEnd };

  void process(const Frame& request);
  void initiate(const Frame& request);
  void start_upload();
  void start_download(const Frame& request);
  void upload_segment(const Frame& request);
  void download_segment(const Frame& request);
  void start_block_upload(const Frame& request);
  void block_upload(const Frame& request);
  void send_block();
  void start_block_download(const Frame& request);
  void block_download_segment(const Frame& request);
  void block_download_end(const Frame& request);
  void store();

  void reply(std::initializer_list<int> bytes);
  void reply_initiate(int command, std::uint32_t value);
  void abort(std::uint32_t code);

  std::uint8_t node_;
  Phase phase_ = Phase::Idle;
  std::uint32_t key_ = 0;
  Bytes data_;
  std::size_t position_ = 0;
  bool toggle_ = false;
  int window_ = 0;
  int sequence_ = 0;
  bool last_seen_ = false;
  std::size_t announced_ = 0;
  bool client_crc_ = false;
  std::uint32_t client_abort_ = 0;
  int requests_ = 0;
  int replies_ = 0;
  std::vector<Frame> out_;
};

}  // namespace interpolated_motion::canopen::test
