#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_result.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

/// How the bytes travel (CiA 301, 7.2.4.2).
enum class SdoTransfer {
  Automatic,  ///< expedited up to 4 bytes, else segmented; every server knows both
  /// Up to 127 segments per reply, with CRC-16 when the server supports it. A lost segment is repeated,
  /// unless it was the last of its block in an upload: then the transfer ends with the time-out.
  Block,
};

struct SdoParameters {
  /// Longest wait for a reply. EPOS drives answer within a few milliseconds; most of this is for a host that
  /// stalls and a bus full of PDOs, all of which go first.
  HostDuration timeout = std::chrono::milliseconds(250);
  std::uint8_t block_size = 127;  ///< segments per block asked for in a block upload, 1..127
  std::size_t max_size = 65'536;  ///< bytes; a longer upload is aborted with 0x05040005
};

/// SDO client for one server (CiA 301, 7.2.4): upload and download, expedited, segmented and block. Sans-IO:
/// frames go in with `on_frame`, come out of `next_frame`, time is given. One transfer at a time.
///
/// Replies that cannot belong to the running transfer are counted and ignored: initiate replies and aborts
/// for another object (late answers to a transfer that timed out), frames of other than 8 bytes, anything
/// while idle. A reply that belongs to it, yet breaks the protocol (toggle, command, sequence, size, CRC),
/// ends the transfer with an abort. Every transfer ends: with the drive's reply, an abort, or the time-out.
class SdoClient {
 public:
  /// `node`: the server's node id, 1..127. Throws std::invalid_argument for a node id or parameters out of
  /// range.
  explicit SdoClient(std::uint8_t node, SdoParameters parameters = {});

  /// A transfer is running.
  bool busy() const { return state_ != State::Idle; }

  /// Starts to read an object. Returns false, and does nothing, while busy. A result not taken yet is
  /// dropped.
  bool start_upload(ObjectAddress address, HostTime now, SdoTransfer transfer = SdoTransfer::Automatic);

  /// Starts to write `size` bytes (copied) to an object; as above.
  bool start_download(ObjectAddress address, const std::uint8_t* bytes, std::size_t size, HostTime now,
                      SdoTransfer transfer = SdoTransfer::Automatic);
  bool start_download(ObjectAddress address, const std::vector<std::uint8_t>& bytes, HostTime now,
                      SdoTransfer transfer = SdoTransfer::Automatic);
  /// Starts to write an integer; as above.
  bool start_download(const SdoWrite& write, HostTime now);

  /// Gives up the running transfer: the drive is told with an abort, the result is a failure with
  /// `abort_code`. Nothing happens when idle.
  void abort(std::uint32_t abort_code);

  /// A frame with the server's COB-ID (0x580 + node) was received.
  void on_frame(const Frame& frame, HostTime now);

  /// Ends the transfer with abort 0x05040000 when its time-out has passed.
  void poll(HostTime now);

  /// When `poll` must be called next; `kNever` when idle.
  HostTime next_deadline() const { return busy() ? deadline_ : kNever; }

  /// Next frame to send to the server (0x600 + node). The segments of a block are made one by one as they are
  /// asked for. The time-out runs anew from each frame handed out.
  std::optional<Frame> next_frame(HostTime now);
  /// Whether next_frame() has one.
  bool has_frame() const { return closing_ || request_ || segment_due(); }

  /// The outcome of the transfer that ended last, once.
  std::optional<SdoResult> take_result();

  /// Time-out of the transfers started from now on; 0x1010 (store parameters) takes longer than others.
  void set_timeout(HostDuration timeout) { parameters_.timeout = timeout; }
  HostDuration timeout() const { return parameters_.timeout; }  ///< from each frame sent to its answer

  /// Node id of the server, 1..127.
  std::uint8_t node() const { return node_; }
  /// Frames ignored since the start, see above.
  std::uint64_t ignored_frames() const { return ignored_frames_; }

 private:
  enum class State {
    Idle,
    UploadInitiate,
    UploadSegment,
    DownloadInitiate,
    DownloadSegment,
    BlockUploadInitiate,
    BlockUploadSegments,
    BlockUploadEnd,
    BlockDownloadInitiate,
    BlockDownloadSegments,
    BlockDownloadEnd,
  };

  bool start(ObjectAddress address, SdoDirection direction, State state);
  void dispatch(const Frame& frame, HostTime now);
  void finish(bool ok, std::uint32_t code, bool by_drive);
  void send(const Frame& frame, HostTime now);
  Frame request(std::uint8_t command) const;
  Frame initiate_request(std::uint8_t command) const;
  bool is_for_this_object(const Frame& frame) const;
  bool is_initiate() const;
  bool is_expedited() const;
  bool is_repeated_initiate(const Frame& frame) const;
  void on_abort(const Frame& frame);
  void ignore() { ++ignored_frames_; }

  void on_upload_initiate(const Frame& frame, HostTime now);
  void on_upload_segment(const Frame& frame, HostTime now);
  bool accept_size(const Frame& frame);
  bool append_received(const std::uint8_t* bytes, std::size_t count);
  void finish_upload();
  void on_download_initiate(const Frame& frame, HostTime now);
  void on_download_segment(const Frame& frame, HostTime now);
  void send_download_segment(HostTime now);

  void on_block_upload_initiate(const Frame& frame, HostTime now);
  void on_block_upload_segment(const Frame& frame, HostTime now);
  bool take_block_segment(const Frame& frame, HostTime now);
  void acknowledge_block(bool last, HostTime now);
  bool count_progress(unsigned segments);
  void on_block_upload_end(const Frame& frame);
  void on_block_download_initiate(const Frame& frame, HostTime now);
  void on_block_download_acknowledge(const Frame& frame, HostTime now);
  void on_block_download_end(const Frame& frame);
  void begin_block(std::size_t first_segment, unsigned block_size, HostTime now);
  void send_block_end(HostTime now);
  Frame block_segment();
  bool segment_due() const { return state_ == State::BlockDownloadSegments && block_sequence_ < block_size_; }
  std::size_t total_segments() const;

  std::uint8_t node_;
  SdoParameters parameters_;
  State state_ = State::Idle;
  HostDuration timeout_{};  ///< of the running transfer
  HostTime deadline_ = kNever;
  SdoResult transfer_;
  bool has_result_ = false;
  std::optional<Frame>
      closing_;  ///< abort or final confirmation of a transfer that ended: goes before the next request
  std::optional<Frame> request_;  ///< of the running transfer, not yet handed out
  std::uint64_t ignored_frames_ = 0;

  bool toggle_ = false;
  bool size_known_ = false;
  std::size_t announced_size_ = 0;
  std::size_t sent_ = 0;  ///< bytes sent in a segmented download

  bool crc_used_ = false;
  std::uint8_t block_size_ = 0;      ///< segments in the running block
  std::uint8_t block_sequence_ = 0;  ///< last segment sent, or received in sequence, of it
  std::size_t block_first_ = 0;      ///< index of its first segment in a download
  int blocks_without_progress_ = 0;
};

}  // namespace interpolated_motion::canopen
