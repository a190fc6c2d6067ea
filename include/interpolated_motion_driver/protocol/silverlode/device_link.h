#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/protocol/canopen/ring.h"
#include "interpolated_motion_driver/protocol/silverlode/outcome.h"
#include "interpolated_motion_driver/protocol/silverlode/request.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

class LineMaster;

/// What one address has been asked and has answered, since the start.
struct LinkStatistics {
  std::uint64_t sent = 0;          ///< requests on the line, repeats included
  std::uint64_t repeats = 0;       ///< requests sent again after an attempt without a whole reply
  std::uint64_t acknowledged = 0;  ///< replies "*"
  std::uint64_t data = 0;          ///< replies "#"
  std::array<std::uint64_t, kMaxNakCode + 1> refused{};  ///< by NAK code, others at index 0
  std::uint64_t timeouts = 0;                            ///< attempts without a reply
  std::uint64_t timeouts_in_a_row = 0;                   ///< since the last whole reply
  std::uint64_t garbled = 0;                             ///< attempts that ended with a garbled reply
  std::uint64_t garbled_in_a_row = 0;                    ///< since the last whole reply
  std::uint64_t second_replies = 0;                      ///< to a request that was answered already
  HostDuration late_by{};  ///< of the last reply that came after its time-out, since the last in time: from
                           ///< the last bit of the request to the first of the reply; 0: none was late
};

/// One drive of a line as the master talks to it. Owned by the master and as long-lived; obtained from
/// `LineMaster::add_device`.
///
/// Control requests leave in the order given, one after the other has its outcome. A bulk request (IMW)
/// leaves when no control request waits on the line; at most one waits at a time, so that the caller decides
/// late what goes next. Every request taken ends with one outcome, except a bulk request that was withdrawn.
class DeviceLink {
 public:
  DeviceLink(const DeviceLink&) = delete;
  DeviceLink& operator=(const DeviceLink&) = delete;

  /// 1..254.
  std::uint8_t address() const { return address_; }
  /// "line0 address 17", for texts.
  std::string name() const;

  /// Queues a control request. `kNoRequest`, and nothing queued, when the queue is full, outcomes have not
  /// been taken, or the request is for another address.
  RequestId request(const Request& request);

  /// Puts a request into the place for the bulk request. Among devices that of the earliest `deadline` (when
  /// the drive must have it) goes first. `kNoRequest` when one waits already, else as `request`.
  RequestId offer_bulk(const Request& request, HostTime deadline);
  /// A bulk request has not left yet.
  bool bulk_waits() const { return bulk_.has_value(); }
  /// Takes the bulk request back; it never reaches the line and has no outcome. False when none waits.
  bool withdraw_bulk();

  /// Ends all requests that wait, outcome `Dropped`. One that is on the line goes on to its outcome, yet is
  /// not repeated.
  void drop_requests();

  /// The oldest outcome not yet taken.
  std::optional<Outcome> take_outcome() { return outcomes_.take(); }
  /// Requests without outcome: waiting or on the line. The bulk request included.
  std::size_t pending() const;

  /// Counted since the device was added.
  const LinkStatistics& statistics() const { return statistics_; }
  /// `line0 address 17: IMW "@17 25 4000 ..." refused, NAK 6 (buffer full)`. Of a request without a whole
  /// reply also what is known of the cause: replies come too late, or are garbled several times in a row,
  /// those of this address alone as of two drives that share it, or of all as by noise.
  std::string text(const Outcome& outcome) const;

 private:
  friend class LineMaster;
  struct Waiting {
    RequestId id = kNoRequest;  ///< of its outcome
    Request request;            ///< as it goes on the line
    int attempts = 0;           ///< times it has been on the line
  };
  struct Bulk {
    Waiting waiting;      ///< not yet sent
    HostTime deadline{};  ///< when the drive must have it; the earliest on the line goes first
  };

  DeviceLink(LineMaster& master, std::uint8_t address, std::size_t capacity);

  bool can_take(const Request& request) const;
  bool control_waits() const { return repeat_.has_value() || !control_.empty(); }
  const Waiting& next_control() const { return repeat_ ? *repeat_ : control_.front(); }
  Waiting take_control();
  Waiting take_bulk();
  void give_up_repeat();
  void finish_unsent(const Waiting& waiting);
  void count(const Outcome& outcome);
  std::string cause_text(const Outcome& outcome) const;

  LineMaster& master_;
  std::uint8_t address_;
  canopen::Ring<Waiting> control_;
  std::optional<Waiting> repeat_;  ///< goes before `control_`
  Outcome failure_;                ///< of the last attempt of `repeat_`
  std::optional<Bulk> bulk_;
  bool on_line_ = false;  ///< a request of this device is on the line
  canopen::Ring<Outcome> outcomes_;
  RequestId last_id_ = kNoRequest;
  LinkStatistics statistics_;
};

}  // namespace interpolated_motion::silverlode
