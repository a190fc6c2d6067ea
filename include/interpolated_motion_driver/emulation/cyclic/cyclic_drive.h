#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "interpolated_motion_driver/emulation/canopen/canopen_drive.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_parameters.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// One servo sample of an emulated cyclic drive, for tests and displays; nothing of it travels over the wire.
struct CyclicSample {
  HostTime time{};           ///< of the drive's sample
  bool following = false;    ///< `demand` comes from the fine interpolation of target positions
  std::uint32_t missed = 0;  ///< target positions that have failed to come, one after the other, up to now
  double demand = 0.0;       ///< position demand before rounding, counts
  double velocity = 0.0;     ///< of the demand, counts/s
  std::int32_t actual = 0;   ///< position actual value, counts
};

/// What an emulated cyclic drive has counted since it was made.
struct CyclicCounters {
  std::uint64_t updates = 0;      ///< target positions taken while following
  std::uint64_t emergencies = 0;  ///< EMCY messages with a code other than 0
  std::uint64_t lost_frames = 0;  ///< frames its transmit queue had no room for
};

/// An emulated servo drive on a virtual CAN bus in the cyclic synchronous position mode: object dictionary,
/// SDO, PDO, NMT, heartbeat and EMCY (CiA 301), device control and mode 8 (CiA 402), fine interpolation of
/// the target positions to its servo rate with ride-through of late and lost ones ("Behavior models used in
/// CIP Motion"), and an axis with following error. It is no vendor's product; its objects are in
/// `cyclic_object_table.h` and `config/eds/cyclic_emulated.eds`.
///
/// A target position that takes effect (at SYNC, when its RPDO is synchronous) is reached one interpolation
/// time period (0x60C2) later. When more than 0x2100:2 of them fail to come in a row, the drive faults with
/// EMCY 0x8700 (sync controller) and brakes by 0x605E. Modes: 8, and 0, in which the drive stands. A mode is
/// entered at the actual position; the first target position then is to be near it.
class CyclicDrive : public CanopenDrive {
 public:
  using SampleObserver = std::function<void(const CyclicSample&)>;

  /// A drive switched on at `now`. `bus` must outlive it. Throws std::invalid_argument for a wrong parameter.
  CyclicDrive(transport::VirtualCanBus& bus, const CyclicParameters& parameters, HostTime now);
  ~CyclicDrive() override;

  /// As given to the constructor, and what has been counted since.
  const CyclicParameters& parameters() const;
  CyclicCounters counters() const;

  /// The drive interpolates at rest as well: its motion begins when the demand leaves rest, and is over when
  /// it has stood for half a second, or no longer follows target positions.
  void observe(Observer observer) override;
  /// Called at each own servo sample while the drive has booted, in place of any other. An empty function
  /// ends that.
  void set_sample_observer(SampleObserver observer);

 private:
  class Implementation;

  std::unique_ptr<Implementation> implementation_;
};

}  // namespace interpolated_motion::emulation
