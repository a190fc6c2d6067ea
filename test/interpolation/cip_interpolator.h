#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "interpolated_motion_driver/interpolation/cip_polynomial.h"
#include "interpolated_motion_driver/interpolation/cubic_hermite.h"
#include "interpolation/cip_time.h"

namespace interpolated_motion::interpolation {

/// What the commands are. Torque is interpolated as acceleration.
enum class CipCommand { Position, Velocity, Acceleration };

/// Settings of a fine interpolator. Units: the command's own (e.g. rad, rad/s), and s.
struct CipParameters {
  /// Decides which orders there are, and the unit of `deceleration`.
  CipCommand command = CipCommand::Position;
  int order = 3;  ///< of the polynomial: 1..3 for position, 1..2 for velocity, 1 for acceleration
  HostDuration period = std::chrono::milliseconds(10);  ///< controller update period T, 1 ns or more
  int missed_updates = 3;     ///< extrapolate so many periods beyond the newest command, then stop; 0..1000
  double deceleration = 1.0;  ///< of that stop, > 0: unit/s^2 of a position, unit/s of a velocity
  HostDuration blend{};       ///< how long a step at late data is faded out; 0: it is not
};

/// Throws std::invalid_argument with parameter, value and allowed range.
void validate(const CipParameters& parameters);

/// Command and its derivatives at one instant.
struct CipSample {
  double value = 0.0;              ///< in the unit of the commands
  double first_derivative = 0.0;   ///< per s
  double second_derivative = 0.0;  ///< per s^2
};

enum class CipState {
  Holding,        ///< stands at the value of reset(): the first command has not come into effect
  Interpolating,  ///< between two commands
  Extrapolating,  ///< beyond the newest one
  Stopping,       ///< no command for too long: braking
  Stopped,        ///< that stop has come to its end
};

/// What became of a command.
enum class CipPush {
  Pending,   ///< early: comes into effect at its t0
  Applied,   ///< in effect from now on
  Filled,    ///< older than the newest command: took its place in the history
  Outdated,  ///< of no use: its time has a command already, or lies before the whole history
  Full,      ///< too far ahead: too many commands are pending
  Stopped,   ///< refused: a stop is under way or over, until reset()
};

/// Step a command made in the output when it came into effect late: new minus old, before blending.
struct CipStep {
  double value = 0.0;             ///< in the unit of the commands
  double first_derivative = 0.0;  ///< per s
};

/// Fine interpolation of a stream of time-stamped commands ("Behavior models used in CIP Motion", Fine
/// Command Interpolation): a polynomial through the last commands, in effect from t0 on and not before,
/// extrapolated beyond t1 while no fresh command is there. Late commands are applied at once.
///
/// A command's stamp is its t1, the System Time at which its value is to be reached; t0 is the stamp of the
/// command before it. Stamps need not be equally spaced. Where the document is silent: see
/// docs/cip_fine_interpolation.md.
///
/// No allocation, no clock: `now` is given and never runs backwards.
class CipInterpolator {
 public:
  /// Holds 0 until reset. Throws std::invalid_argument as validate() does.
  explicit CipInterpolator(const CipParameters& parameters);

  /// Forgets all commands and holds `value` (the actual one, at rest) until the first command comes into
  /// effect, one period before its stamp. Ends a stop.
  void reset(double value);

  /// How far System Time is ahead of the local clock `now` is of. A change moves the output along the
  /// polynomial.
  void set_system_time_offset(SystemTimeOffset offset) { offset_ = offset; }

  /// A command to be reached at `stamp`, which has come at `now`.
  CipPush push(SystemTime stamp, double value, HostTime now);

  /// Output at `now`.
  CipSample sample(HostTime now);

  /// What becomes of the output at `now`. A stop that is due then begins.
  CipState state(HostTime now);

  /// By how much `now` lies beyond the newest command; 0 while it does not, and before the first.
  HostDuration extrapolated(HostTime now) const;

  /// Step of the latest command applied late; zero before there was one.
  const CipStep& last_step() const { return last_step_; }

 private:
  struct Command {
    SystemTime stamp{};  ///< t1: when `value` is to be reached
    double value = 0.0;  ///< in the unit of the commands
  };

  struct Blend {
    SystemTime begin{};       ///< when the late command came into effect
    CubicHermite correction;  ///< added to the output: from the step to nothing, over `blend`
  };

  struct Stop {
    SystemTime begin{};  ///< when the ride-through was over
    CipSample from;      ///< output at `begin`
  };

  static constexpr std::size_t kCommands = 8;  // the four in effect, and four that are early

  const Command& newest() const { return commands_[count_ - 1]; }
  std::size_t segment_end(SystemTime t) const;
  CipSample on_polynomial(SystemTime t) const;
  CipSample output(SystemTime t) const;
  CipSample stopping(SystemTime t) const;
  bool at_rest(SystemTime t) const;
  SystemTime stop_time(SystemTime stamp) const;
  void stop_if_due(SystemTime t);
  CipPush insert(const Command& command, SystemTime t);
  void start_at_rest(SystemTime stamp);
  void note_step(const CipSample& raw_before, const CipSample& before, SystemTime t);

  CipParameters parameters_;
  SystemTimeOffset offset_;
  double held_ = 0.0;
  std::array<Command, kCommands + 1> commands_{};  // by stamp, the newest last; one place to insert
  std::size_t count_ = 0;
  SystemTime motion_begin_{};
  std::optional<Blend> blend_;
  std::optional<Stop> stop_;
  CipStep last_step_;
};

}  // namespace interpolated_motion::interpolation
