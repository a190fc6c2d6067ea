#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// One setpoint of a stream: where all joints are to be at one instant.
struct Setpoint {
  HostTime time{};  ///< the instant, on the sender's side: the arm is there `delay` later
  std::vector<std::string> joint_names;  ///< every joint once, in any order
  std::vector<double> positions;         ///< rad, in the order of the names
  std::vector<double> velocities;        ///< rad/s; empty: taken from the setpoints themselves
  std::string source;                    ///< who sends: a stream has one sender
};

/// How a stream of setpoints is followed.
struct StreamParameters {
  /// The arm is so far behind the stream, besides what its drives need to know ahead
  /// (axis::Axis::stream_lead()): longer rides out more jitter.
  GoalTime delay{0.03};
  GoalTime horizon{
      0.1};  ///< motion kept in drives that have a FIFO: more rides out longer stalls of the host
  GoalTime ride_through{0.1};  ///< without setpoints it goes on for so long, then brakes
  GoalTime write_period{
      0.02};                ///< shortest time between two setpoints from hardware::MotionHardware::write()
  GoalTime linger{1.0};     ///< at rest it waits so long for more; then the stream has ended
  GoalTime max_age{0.2};    ///< an older setpoint is refused
  GoalTime max_ahead{0.5};  ///< one for later than that is refused
  GoalTime catch_up{0.5};  ///< longest the arm may be behind the stream after late setpoints, besides `delay`
};

/// What has come of setpoints since the driver was started.
struct StreamCounters {
  std::uint64_t accepted = 0;  ///< also those passed over for a newer one before the drives had begun
  std::uint64_t refused = 0;   ///< some only when the drives had begun and it could not be reached
};

}  // namespace interpolated_motion::motion
