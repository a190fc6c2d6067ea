#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/emulation/fault_command.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// One sample of an emulated drive's motion, whatever its kind. Nothing of it travels over the wire.
struct DemandSample {
  HostTime time{};                 ///< of the sample
  double drive_seconds = 0.0;      ///< on the drive's own clock, from the start of its motion
  double demand = 0.0;             ///< counts, before rounding
  std::int32_t actual = 0;         ///< counts
  std::optional<double> velocity;  ///< of the demand, counts/s; nothing where the drive does not know it
  /// The interpolator makes the demand, the sample that ends the motion included. `drive_seconds` keeps its
  /// last value afterwards.
  bool interpolating = true;
};

/// An emulated drive on an emulated bus, whatever its kind. A host knows of it what its bus carries; these
/// functions are for the world it lives in, for set-up, faults and observation.
class Drive {
 public:
  using Observer = std::function<void(const DemandSample&)>;

  virtual ~Drive() = default;

  /// Time of its next own action (sample, answer); kNever when it only answers, or is off for good.
  virtual HostTime next_event() const = 0;
  /// Does what is due up to `now`, which never goes back.
  virtual void process(HostTime now) = 0;

  /// Actual position, counts, as of the last process(), whether the drive is powered or not.
  virtual std::int32_t position() const = 0;

  /// The motor has power: the power stage is on and the drive holds or moves its axis.
  virtual bool has_torque() const = 0;

  /// `observer` is called at each own sample of the drive while it is powered, in place of any other. An
  /// empty function ends that: drives that nobody looks at may compute less.
  virtual void observe(Observer observer) = 0;

  /// Switches the supply off at `now`, and on again after `off`, >= 0. All volatile state is lost.
  virtual void power_cycle(HostTime now, HostDuration off) = 0;
  /// Blocks the axis (true) or frees it (false).
  virtual void stall(bool blocked) = 0;
  /// While silent the drive neither hears nor says anything, but goes on moving.
  virtual void silence(bool silent, HostTime now) = 0;
  /// Changes the error of the drive's crystal from its next sample on, ppm, within +-kLargestClockError.
  virtual void set_clock_error(double ppm) = 0;

  /// Obeys a command, `power_cycle SECONDS`, `stall 0|1`, `silence 0|1`, `clock PPM` or one of its kind, or
  /// returns why not.
  std::optional<std::string> inject(const std::string& command, HostTime now);

 private:
  /// The commands that only its kind has, to be obeyed at `now`.
  virtual std::vector<FaultCommand> own_faults(HostTime now) = 0;
};

}  // namespace interpolated_motion::emulation
