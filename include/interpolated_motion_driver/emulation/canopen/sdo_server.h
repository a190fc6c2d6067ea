#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "interpolated_motion_driver/emulation/canopen/abort_code.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::emulation {

/// Largest object an SDO transfer of the emulated drive carries, bytes.
constexpr std::size_t kSdoCapacity = 64;

/// The objects behind an SDO server.
class SdoObjects {
 public:
  virtual ~SdoObjects() = default;

  /// Puts the value into `data` and its length into `size`.
  virtual AbortCode sdo_read(std::uint16_t index, std::uint8_t subindex,
                             std::array<std::uint8_t, kSdoCapacity>& data, std::size_t& size) = 0;

  /// Whether a transfer to this object may begin. `object_size` receives the length of its value.
  virtual AbortCode sdo_writable(std::uint16_t index, std::uint8_t subindex, std::size_t& object_size) = 0;

  /// Writes `size` bytes, the least significant first. None: written; else what the client is told.
  virtual AbortCode sdo_write(std::uint16_t index, std::uint8_t subindex, const std::uint8_t* data,
                              std::size_t size) = 0;
};

/// Server side of the SDO protocols of CiA 301: expedited, segmented and block transfer (with CRC) in both
/// directions. One transfer at a time; a new request replaces an unfinished one.
class SdoServer {
 public:
  using Bytes = std::array<std::uint8_t, 8>;

  /// `objects` must outlive it.
  explicit SdoServer(SdoObjects& objects) : objects_(objects) {}

  /// Response to the 8 bytes of a client's frame; nothing when the protocol has none at this point.
  std::optional<Bytes> on_request(const Bytes& request);

  /// The next segment of a block upload, nothing when none is due. To be asked as long as frames can be sent.
  std::optional<Bytes> next_segment();

  /// Forgets an unfinished transfer.
  void reset() { state_ = State::Idle; }

 private:
  enum class State {
    Idle,
    SegmentedDownload,
    SegmentedUpload,
    BlockDownload,
    BlockDownloadEnd,
    BlockUploadReady,
    BlockUploading,
    BlockUploadAcknowledge,
    BlockUploadEnd,
  };

  Bytes abort(AbortCode code);
  Bytes confirm(std::uint8_t command) const;
  void take_multiplexer(const Bytes& request);

  std::optional<Bytes> start_download(const Bytes& request);
  std::optional<Bytes> download_segment(const Bytes& request);
  std::optional<Bytes> start_upload(const Bytes& request);
  std::optional<Bytes> upload_segment(const Bytes& request);
  Bytes answer_upload();
  std::optional<Bytes> start_block_download(const Bytes& request);
  std::optional<Bytes> block_download_segment(const Bytes& request);
  std::optional<Bytes> end_block_download(const Bytes& request);
  std::optional<Bytes> block_upload(const Bytes& request);
  std::optional<Bytes> start_block_upload(const Bytes& request);
  std::optional<Bytes> acknowledge_block(const Bytes& request);

  SdoObjects& objects_;
  State state_ = State::Idle;
  std::uint16_t index_ = 0;
  std::uint8_t subindex_ = 0;
  bool toggle_ = false;
  bool crc_ = false;
  std::array<std::uint8_t, kSdoCapacity> data_{};
  std::size_t size_ = 0;       ///< bytes of data_ that are valid
  std::size_t announced_ = 0;  ///< length the client has announced, 0: none
  std::size_t sent_ = 0;       ///< bytes confirmed by the client of an upload
  std::uint8_t block_size_ = 0;
  std::uint8_t sequence_ = 0;
  bool last_segment_ = false;
};

}  // namespace interpolated_motion::emulation
