#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "interpolated_motion_driver/emulation/canopen/canopen_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_parameters.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// One 1 ms sample of an emulated drive, for tests and displays; nothing of it travels over the wire.
struct EposSample {
  HostTime time{};  ///< of the drive's sample
  std::int64_t samples_since_start =
      -1;  ///< 0 at the sample that made the interpolation active, k after k ms of interpolation
           ///< (halted samples not counted); keeps its last value afterwards; -1 before the first start
  bool interpolating =
      false;              ///< `demand` comes from the interpolator; true up to the sample that ends the mode
  double demand = 0.0;    ///< position demand before rounding, qc
  double velocity = 0.0;  ///< of the demand, qc/s
  std::int32_t actual = 0;  ///< position actual value, qc
};

/// What an emulated drive has counted since it was made.
struct EposCounters {
  std::uint64_t records_accepted = 0;  ///< put into the buffer, those with time 0 included
  std::uint64_t records_refused = 0;   ///< dropped, aborted or overflowing records
  std::uint64_t underflows = 0;        ///< ran dry, or could not start, as the settings have it
  std::uint64_t overflows = 0;         ///< records for a full buffer, whatever InactiveOverflow made of them
  int minimum_fill = -1;  ///< lowest number of records while interpolating and before the record that ends
                          ///< the mode is queued; -1 when there was no such sample
  std::uint64_t emergencies = 0;  ///< EMCY messages with a code other than 0
  std::uint64_t lost_frames = 0;  ///< frames its transmit queue had no room for
};

/// An emulated maxon EPOS2 positioning controller on a virtual CAN bus: object dictionary, SDO, PDO, NMT,
/// heartbeat and EMCY (CiA 301), device control (CiA 402) with the statuswords of EPOS2, the Interpolated
/// Position Mode with its 64-record buffer and 1 kHz cubic interpolation ("EPOS3 Interpolated Position
/// Mode", 4.2 and 4.3), and an axis with following error. Everything a host can do to it, it does through the
/// bus; the functions are for set-up, faults and observation.
class EposDrive : public CanopenDrive {
 public:
  using SampleObserver = std::function<void(const EposSample&)>;

  /// A drive switched on at `now`. `bus` must outlive it. Throws std::invalid_argument for a wrong parameter.
  EposDrive(transport::VirtualCanBus& bus, const EposParameters& parameters, HostTime now);
  ~EposDrive() override;

  /// As given to the constructor, and what has been counted since.
  const EposParameters& parameters() const;
  EposCounters counters() const;

  void observe(Observer observer) override;
  /// As observe(), with all that a drive of this kind has to tell. An empty function ends that.
  void set_sample_observer(SampleObserver observer);

 private:
  class Implementation;

  std::unique_ptr<Implementation> implementation_;
};

}  // namespace interpolated_motion::emulation
