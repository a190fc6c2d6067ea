#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/ring.h"
#include "interpolated_motion_driver/protocol/silverlode/device_link.h"
#include "interpolated_motion_driver/protocol/silverlode/line_load.h"
#include "interpolated_motion_driver/protocol/silverlode/line_parameters.h"
#include "interpolated_motion_driver/protocol/silverlode/reply_delay.h"
#include "interpolated_motion_driver/protocol/silverlode/reply_parser.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

/// Why a line received was not taken for an answer.
enum class UnexpectedLine : std::uint8_t {
  NoRequest,     ///< a reply while none was awaited: late, or a second one
  WrongAddress,  ///< a reply of another address than the one asked
  WrongEcho,     ///< data or NAK for another command, a data reply of a wrong length, or one of a wrong kind
  Malformed,     ///< no reply at all
  Truncated,     ///< a line without its end when the time was over
};
inline constexpr int kUnexpectedLineCauses = 5;  ///< values of UnexpectedLine

/// Lines of one cause: how many, the last of them, and what had been sent before it.
struct UnexpectedLines {
  std::uint64_t count = 0;  ///< since the master was made
  LineText last;            ///< as far as it was kept; only where `count` is not 0
  LineText sent;            ///< the request before it
  HostTime time{};          ///< of the last character of `last`
};

/// The host's end of one serial line with many SilverLode drives in 8-bit ASCII, sans-IO: characters received
/// go in with `on_character`, requests come out of `peek_outgoing`/`pop_outgoing`, time is given. After
/// construction and `add_device` nothing is allocated per exchange.
///
/// One exchange at a time: a request, then its reply or the time-out, which leaves `reply_timeout` to the
/// drive besides the exact time of the characters. A request that got no whole reply is repeated when it is
/// repeatable; IMW and IMS never are, their outcome tells that it is unknown whether the drive has them.
/// After a time-out, a malformed line, or characters nobody asked for, the line is left alone until it was
/// silent for `guard` (at most ten times as long when it never is). After a time-out of a `patient` request
/// it is left alone for `kLateReplies` times `reply_timeout`, so that a reply that is late is seen to be: it
/// cannot be taken for that to the next request then.
///
/// Order: broadcasts; control requests, device after device in turn; bulk requests, the earliest deadline
/// first. A device that does not answer costs a time-out an attempt, so after each failed attempt a bulk
/// request (of a device without control requests) goes before the next control request.
class LineMaster {
 public:
  /// So many times `reply_timeout` a reply to a `patient` request may be late and still be recognised.
  static constexpr int kLateReplies = 5;

  /// `line_name` is used in texts. Throws std::invalid_argument with parameter, value and range.
  explicit LineMaster(std::string line_name, LineParameters parameters = {});
  ~LineMaster();
  LineMaster(const LineMaster&) = delete;
  LineMaster& operator=(const LineMaster&) = delete;

  /// Adds a drive, address 1..254, not added before; throws std::invalid_argument otherwise.
  DeviceLink& add_device(std::uint8_t address);
  /// The device, or nullptr when it was not added.
  DeviceLink* find_device(std::uint8_t address) const { return devices_[address].get(); }

  /// Devices added so far.
  std::size_t device_count() const { return in_order_.size(); }

  /// As given to the constructor.
  const std::string& line_name() const { return line_name_; }
  const LineParameters& parameters() const { return parameters_; }

  /// A character received; `time` is that of its last bit.
  void on_character(char c, HostTime time);

  /// Does what time demands: time-outs. Hand over the characters received until `now` before, so that a reply
  /// which is there already prevents its time-out.
  void poll(HostTime now);

  /// When `poll`, or `peek_outgoing` for a request that waits for silence, must be called next. A request
  /// that may go already sets no deadline: offer it to the transport after every call that may have queued
  /// some or ended an exchange, and again when it has room.
  HostTime next_deadline() const;

  /// The text to send next, with its CR; empty when there is none or the line is taken. Valid until the next
  /// call of any function of the master or its devices.
  std::optional<std::string_view> peek_outgoing(HostTime now);
  /// The transport has taken the text that `peek_outgoing` returned just before.
  void pop_outgoing(HostTime now);

  /// A bulk request of any device waits.
  bool bulk_waits() const;
  /// No request waits or is under way.
  bool idle() const { return !exchange_ && !something_waits(); }

  /// Sends a request to the global address to all drives, before everything else that waits. It is not
  /// answered, and may be lost without notice. `kNoRequest`, and nothing queued, when the queue of 8 is full
  /// or the request has another address.
  RequestId broadcast(const Request& request);
  /// When the last bit of a broadcast was on the line, computed. Empty as long as it has not left, and when
  /// another one has left since.
  std::optional<HostTime> broadcast_end(RequestId id) const;

  /// Ends all requests that wait with outcome `Dropped`, and forgets broadcasts. For a line
  /// that was down: a command of then must not reach a drive now. A request on the line goes on to its
  /// outcome, yet is not repeated.
  void clear_outgoing();

  /// Time of `characters` on the line.
  HostDuration characters_time(std::size_t characters) const;
  /// Time the line is taken by `request` when all is well: its characters, `turnaround`, those of the longest
  /// reply of a drive that accepts it, and `pause`; `guard` in place of the latter three when there is no
  /// reply.
  HostDuration exchange_time(const Request& request) const;
  /// The longest time an attempt can take the line: reply and silence after a time-out included.
  HostDuration longest_exchange_time(const Request& request) const;

  /// Share of the line in use, see `LineLoad`.
  double load(HostTime now) const;
  /// As of the latest time this master was given.
  double load() const { return load(now_); }
  /// How late replies come, 0 before the first.
  HostDuration reply_delay() const { return reply_delay_.mean(); }

  /// Lines that were no answer, `count` 0 when there were none of that cause.
  const UnexpectedLines& unexpected(UnexpectedLine cause) const;
  /// `line0: a reply of another address than the one asked came 3 times, last "* 12" after "@17 20"`; empty
  /// when there were none.
  std::string unexpected_text(UnexpectedLine cause) const;
  /// Lines that are this host's own, heard back.
  std::uint64_t echoes() const { return echoes_; }
  /// Characters that belong to no line.
  std::uint64_t dropped_characters() const { return parser_.dropped_characters(); }

 private:
  friend class DeviceLink;
  struct Exchange {
    DeviceLink* device = nullptr;  ///< that was asked; never null in an exchange
    DeviceLink::Waiting sent;      ///< with this attempt counted
    bool may_repeat = true;        ///< false once its requests have been dropped
    HostTime begin{};              ///< when the transport took the request
    HostTime request_end{};        ///< its last bit on the line, computed
    HostTime reply_deadline{};     ///< when the attempt counts as unanswered
    LineText other;                ///< the last line received that was not the answer
  };
  /// What was on the line last.
  struct Last {
    LineText sent;  ///< the request
    DeviceLink* device =
        nullptr;             ///< that was asked by the last attempt that has ended; null: there was none
    HostTime request_end{};  ///< of that attempt, its last bit on the line
    bool answered = false;   ///< by a whole reply
  };
  enum class Peeked : std::uint8_t { None, Broadcast, Control, Bulk };

  void advance(HostTime now);
  bool something_waits() const;
  void choose_next();
  void pass_on(std::size_t& turn) const;
  std::optional<std::size_t> next_control_device() const;
  std::optional<std::size_t> next_bulk_device() const;
  void do_not_repeat(const DeviceLink& device);

  void begin_exchange(DeviceLink& device, DeviceLink::Waiting waiting, HostTime now);
  void end_unanswered();
  void send_broadcast(HostTime now);
  void await_silence(HostTime time);
  void on_reply(const Reply& reply);
  void ignore_line(UnexpectedLine cause, HostTime time);
  void on_malformed(HostTime time);
  void on_timeout();
  void fail_attempt(OutcomeKind kind, const LineText& received, HostTime time);
  void end_exchange(HostTime time, HostDuration silence);
  Outcome make_outcome(OutcomeKind kind, HostTime time) const;
  void count(UnexpectedLine cause, HostTime time);

  std::string line_name_;
  LineParameters parameters_;
  std::array<std::unique_ptr<DeviceLink>, 256> devices_;
  std::vector<DeviceLink*> in_order_;  ///< the devices as they were added
  HostTime now_{};                     ///< latest time given

  struct Broadcast {
    RequestId id = kNoRequest;  ///< of broadcast()
    Request request;            ///< to the global address
  };
  struct SentBroadcast {
    RequestId id = kNoRequest;  ///< of broadcast(); kNoRequest: none has left yet
    HostTime end{};             ///< its last bit on the line, computed
  };
  canopen::Ring<Broadcast> broadcasts_;
  RequestId last_broadcast_ = kNoRequest;
  SentBroadcast sent_broadcast_;  ///< the last
  Peeked peeked_ = Peeked::None;
  DeviceLink* peeked_device_ = nullptr;
  std::size_t control_turn_ = 0;  ///< index into `in_order_` of the device whose control request goes next
  std::size_t bulk_turn_ = 0;     ///< the same of bulk requests with equal deadlines
  bool bulk_first_ = false;       ///< a control attempt failed: a bulk request goes before the next one

  ReplyParser parser_;
  std::optional<Exchange> exchange_;
  Last last_;
  HostTime free_at_{};      ///< the line may be used from then on
  HostTime noise_begin_{};  ///< first and last of the latest characters without a request
  HostTime noise_end_{};

  LineLoad load_;
  ReplyDelay reply_delay_;
  std::array<UnexpectedLines, kUnexpectedLineCauses> unexpected_{};
  std::uint64_t echoes_ = 0;
};

/// As exchange_time(), with drives that answer as late as they do where that is more than `turnaround`; in
/// steps, so that what is planned does not change with each reply.
HostDuration real_exchange_time(const LineMaster& line, const Request& request);

}  // namespace interpolated_motion::silverlode
