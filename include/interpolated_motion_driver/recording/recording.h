#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/recording/order_log.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::recording {

/// Version of the text that to_text() writes and parse_recording() reads.
inline constexpr int kFormatVersion = 1;

/// What is recorded of.
struct Subject {
  std::string configuration;                              ///< the driver's parameters, YAML on one line
  std::map<std::string, trajectory::JointLimits> limits;  ///< as the robot description has them
  std::vector<std::string> joints;
  std::vector<std::string> buses;
};

/// Texts that arise now and then.
enum class NoteKind : std::uint8_t { Group, Drive, Bus, End, Log };

/// Where a joint was, an entry of EntryKind::Joint.
struct JointSample {
  double desired = 0.0;           ///< rad, the committed trajectory
  double desired_velocity = 0.0;  ///< rad/s
  double actual = 0.0;            ///< rad
  double actual_velocity = 0.0;   ///< rad/s
  double demand = 0.0;            ///< rad, the drive's own
  double fill_time = 0.0;         ///< s of motion left in the drive's buffer
};

/// A copy of all that a FlightRecorder has, which another thread may write down.
struct Recording {
  Subject subject;
  HostTime begin{};             ///< everything since then is there, as far as there was room
  HostTime end{};               ///< when the copy was made
  bool complete = false;        ///< it begins with the driver: nothing has been forgotten
  std::uint64_t displaced = 0;  ///< entries for which there was no room
  std::uint64_t orders_left_out = 0;
  std::vector<std::byte> entries;  ///< of ByteRing::copy()
  std::vector<Order> orders;
};

/// The recording as docs/recording.md describes it. `cause`: why it is written. `wall_clock`: that minus the
/// host's clock.
std::string to_text(const Recording& recording, const std::string& cause,
                    std::optional<HostDuration> wall_clock = std::nullopt);

}  // namespace interpolated_motion::recording
