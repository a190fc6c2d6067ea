#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "interpolated_motion_driver/emulation/device.h"
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
      false;            ///< `demand` comes from the interpolator; true up to the sample that ends the mode
  double demand = 0.0;  ///< position demand before rounding, qc
  std::int32_t actual = 0;  ///< position actual value, qc
};

/// What an emulated drive has counted since it was made.
struct EposCounters {
  std::uint64_t records_accepted = 0;
  std::uint64_t records_refused = 0;  ///< dropped, aborted or overflowing records
  std::uint64_t underflows = 0;
  std::uint64_t overflows = 0;
  int minimum_fill = -1;  ///< lowest number of records while interpolating and before the record that ends
                          ///< the mode is queued; -1 when there was no such sample
  std::uint64_t emergencies = 0;  ///< EMCY messages with a code other than 0
  std::uint64_t lost_frames = 0;  ///< frames its transmit queue had no room for
};

/// An emulated maxon EPOS2 positioning controller on a virtual CAN bus: object dictionary, SDO, PDO, NMT,
/// heartbeat and EMCY (CiA 301), device control (CiA 402) with the statuswords of EPOS2, the Interpolated
/// Position Mode with its 64-record buffer and 1 kHz cubic interpolation ("EPOS3 Interpolated Position
/// Mode", 4.2 and 4.3), and an axis with following error. Everything a host can do to it, it does through the
/// bus; the functions below are for set-up, faults and observation.
class EposDrive : public Device {
 public:
  using SampleObserver = std::function<void(const EposSample&)>;

  /// A drive switched on at `now`. `bus` must outlive it. Throws std::invalid_argument for a wrong parameter.
  EposDrive(transport::VirtualCanBus& bus, const EposParameters& parameters, HostTime now);
  ~EposDrive() override;
  EposDrive(const EposDrive&) = delete;
  EposDrive& operator=(const EposDrive&) = delete;

  const EposParameters& parameters() const;
  EposCounters counters() const;

  /// Called at each own 1 ms sample while the drive has booted. An empty function ends that.
  void set_sample_observer(SampleObserver observer);

  /// Position of the axis, qc, whether the drive is powered or not.
  std::int32_t position() const;

  /// Switches the supply off at `now`, and on again after `off`. All volatile state is lost.
  void power_cycle(HostTime now, HostDuration off);

  /// Blocks the axis (true) or frees it (false).
  void stall(bool blocked);

  /// Changes the external load: a standing deviation of the axis in qc.
  void set_load(double counts);

  /// Reports the error `code` in an EMCY message and goes into fault reaction. Error register bits as in CiA
  /// 301.
  void raise_fault(std::uint16_t code, std::uint8_t error_register, HostTime now);

  /// Sends an EMCY message without any other reaction.
  void send_emergency(std::uint16_t code, std::uint8_t error_register, HostTime now);

  /// While silent the drive neither hears nor says anything, but goes on moving.
  void silence(bool silent, HostTime now);

  /// Changes the error of the drive's crystal from its next sample on, ppm. (Its motion clock is that crystal
  /// corrected by SYNC and time stamps, when there are any.)
  void set_clock_error(double ppm);

  HostTime next_event() const override { return next_event_; }
  void process(HostTime now) override;
  void on_can_frame(const canopen::Frame& frame, HostTime time) override;

 private:
  class Implementation;

  HostTime next_event_ = kNever;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace interpolated_motion::emulation
