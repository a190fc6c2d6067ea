#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/playback_clock.h"
#include "interpolated_motion_driver/axis/silverlode/command_sequence.h"
#include "interpolated_motion_driver/axis/silverlode/segment_feed.h"
#include "interpolated_motion_driver/protocol/silverlode/line_master.h"

namespace interpolated_motion::axis {

/// What a delivery works with, all of it one drive's and longer-lived: the line and the drive's link to it,
/// the commands of its axis, its segments, and the model of its clock.
struct DeliveryContext {
  silverlode::LineMaster& line;    ///< for the times that commands take on it
  silverlode::DeviceLink& device;  ///< takes the commands
  CommandSequence& sequence;       ///< for the steps of bring-up and clearing
  SegmentFeed& feed;               ///< gives the segments
  const PlaybackClock& clock;      ///< how far the drive has played
  double line_share;               ///< of the line's time that records may fill
};

/// The way segments take into a SilverLode drive. QCI-TD044 has two: QueueDelivery and RegisterDelivery.
///
/// offer() is called again and again while segments are to get into the drive; it keeps at most one command
/// on its way, whose outcome goes to take(). Both return why the motion cannot go on, and nothing when it
/// can.
class SegmentDelivery {
 public:
  using Steps = std::vector<CommandSequence::Step>;
  using Failure = std::optional<std::string>;
  /// When what must cross the line for a path may and must do so: segment i begins at `begins[i]` seconds
  /// after the path does, the segment that ends the motion at the last of them. A value, for any thread.
  using SlotRule = std::function<std::vector<RecordSlot>(const std::vector<double>& begins)>;

  virtual ~SegmentDelivery() = default;

  /// "queue of 8 segments", for the description of the axis.
  virtual std::string description() const = 0;
  /// Segments that can wait in the drive besides the one under execution. Known once bring_up_steps() are
  /// done.
  virtual std::size_t capacity() const = 0;

  /// Chooses this way at bring-up, when the drive stands. Nothing is left in the drive that IMS would play.
  virtual Steps bring_up_steps() = 0;
  /// Takes back whatever waits in a drive that stands.
  virtual Steps clear_steps() = 0;

  /// Shortest segment, s, that the drive may be given: the line must be able to follow.
  virtual double shortest_segment() const = 0;
  /// Time of the line that one record takes, s, as share of what records may fill. A record is what a slot
  /// stands for.
  virtual double record_bus_time() const = 0;
  /// Time of the line that one record really takes, s, with drives that answer as late as they do; and
  /// records that a segment is made of.
  virtual double record_time() const = 0;
  virtual std::size_t records_per_segment() const = 0;
  /// With segments that begin within `horizon` seconds wanted in the drive.
  virtual SlotRule slot_rule(double horizon) const = 0;

  /// A motion begins with nothing in the drive.
  virtual void begin() = 0;
  /// Gives the line what is due: whatever segments already taken from the feed still need, and the next
  /// segment when `more` are wanted, encoded for `rate` (see SegmentFeed::next()).
  virtual Failure offer(bool more, double rate, HostTime now) = 0;
  /// Whether `outcome` is that of the command on its way.
  bool owns(const silverlode::Outcome& outcome) const { return outcome.id == id_; }
  /// `outcome` is one that owns() is true of.
  virtual Failure take(const silverlode::Outcome& outcome, HostTime now) = 0;
  /// No segment goes to the drive any more; the outcome of a command on its way means nothing.
  virtual void give_up();

  /// Segments that the drive will execute if it hears nothing more.
  virtual std::size_t delivered() const = 0;

  std::uint64_t records_sent() const { return records_sent_; }      ///< segments, since the start
  std::uint32_t refused_writes() const { return refused_writes_; }  ///< since the start

 protected:
  explicit SegmentDelivery(const DeliveryContext& context) : context_(context) {}

  /// Puts `request` on the line as the one command on its way. False when the link takes none now.
  bool send(const silverlode::Request& request, HostTime deadline);
  bool sending() const { return id_ != silverlode::kNoRequest; }
  void forget_command() { id_ = silverlode::kNoRequest; }
  void count_segment() { ++records_sent_; }
  void count_refusal() { ++refused_writes_; }

  silverlode::LineMaster& line() const { return context_.line; }
  silverlode::DeviceLink& device() const { return context_.device; }
  std::uint8_t address() const { return context_.device.address(); }
  CommandSequence& sequence() const { return context_.sequence; }
  SegmentFeed& feed() const { return context_.feed; }
  const PlaybackClock& clock() const { return context_.clock; }
  double line_share() const { return context_.line_share; }

 private:
  DeliveryContext context_;
  silverlode::RequestId id_ = silverlode::kNoRequest;
  std::uint64_t records_sent_ = 0;
  std::uint32_t refused_writes_ = 0;
};

/// Segments that are kept waiting in the drive however short the horizon.
inline constexpr std::size_t kLeastAhead = 2;

/// When segment `i` is wanted in the drive, s, see SegmentDelivery::SlotRule: within the horizon, and early
/// enough for kLeastAhead.
double wanted_at(const std::vector<double>& begins, std::size_t i, double horizon);

/// Writes a register and reads it back. `purpose` is for the message when the drive has another value then.
SegmentDelivery::Steps write_and_verify(const silverlode::DeviceLink& device, std::uint16_t number,
                                        std::int32_t value, const char* purpose);

}  // namespace interpolated_motion::axis
