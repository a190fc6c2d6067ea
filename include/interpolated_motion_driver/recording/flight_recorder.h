#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/recording/byte_ring.h"
#include "interpolated_motion_driver/recording/order_log.h"
#include "interpolated_motion_driver/recording/recording.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::recording {

/// How much is kept.
struct RecorderSettings {
  HostDuration window = std::chrono::seconds(10);
  std::size_t bytes = std::size_t{8} << 20U;  ///< of memory: three quarters for the ring, the rest for orders
};

/// The last seconds of everything that a driver does, in bounded memory: what crosses the buses, orders with
/// their answers, states, the log. Everything is told to it with its time, which does not run backwards by
/// more than what a bus delays. What comes all the time (frames, lines, setpoints, joints) is kept without
/// allocation.
class FlightRecorder {
 public:
  FlightRecorder(const RecorderSettings& settings, Subject subject, HostTime start);

  void frame(const std::string& bus, const canopen::ReceivedFrame& frame);
  /// A line of a serial bus without its CR, as far as kLongestLine.
  void line(const std::string& bus, std::string_view text, HostTime time, bool from_host);

  void goal(HostTime now, const std::shared_ptr<const trajectory::Goal>& goal,
            const Expected<motion::GoalAcceptance, Refusal>& answer);
  void setpoint(HostTime now, const motion::Setpoint& setpoint, const std::optional<Refusal>& refusal);
  /// Any other order; `arguments` in YAML, without braces.
  void order(HostTime now, std::string_view verb, std::string arguments);
  /// Nobody has called the driver from `from` until `until`.
  void absence(HostTime from, HostTime until);
  void ended(HostTime now, const motion::GoalResult& result);
  void ended(HostTime now, const motion::RequestResult& result);

  void group(HostTime now, motion::GroupState before, motion::GroupState state, std::string_view fault);
  void log(HostTime now, std::string_view severity, std::string_view text);
  /// Where the joints are, and what has changed of drives and buses since the last look.
  void look(const motion::Snapshot& snapshot);

  /// Everything there is, as of `now`. Takes the time of copying the ring: about 0.1 ms a megabyte.
  Recording recording(HostTime now) const;

  /// Bytes of memory taken by what is kept.
  std::size_t used() const { return ring_.used() + orders_.used(); }

  static constexpr std::size_t kLongestLine = 200;   ///< characters
  static constexpr std::size_t kLongestNote = 1000;  ///< characters of any other text

 private:
  struct Seen {
    bool online = false;
    std::uint16_t statusword = 0;
    std::uint16_t error_code = 0;
    std::string state;
  };

  void push(EntryHead head, const void* bytes);
  void note(HostTime now, NoteKind kind, std::string_view text);
  void look_at_joint(HostTime now, std::size_t index, const motion::JointSnapshot& joint);
  void look_at_bus(HostTime now, std::size_t index, const motion::BusSnapshot& bus);
  std::uint8_t bus_number(const std::string& bus) const;
  std::string where() const;

  RecorderSettings settings_;
  Subject subject_;
  HostTime start_;
  ByteRing ring_;
  OrderLog orders_;
  std::vector<char> scratch_;  ///< of setpoints
  motion::GroupState state_ = motion::GroupState::Starting;
  std::vector<double> positions_;  ///< rad, of the latest look
  std::vector<Seen> drives_;
  std::vector<Seen> buses_;
  HostTime absent_until_ = kNever;
};

}  // namespace interpolated_motion::recording
