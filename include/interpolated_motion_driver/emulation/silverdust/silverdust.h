#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "interpolated_motion_driver/emulation/drive.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/program.h"
#include "interpolated_motion_driver/transport/virtual_serial_line.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// One servo tick of an emulated drive, for tests and displays; nothing of it travels over the wire.
struct SilverDustSample {
  HostTime time{};                      ///< of the tick
  std::int64_t ticks_since_start = -1;  ///< 0 at the tick that loaded the first segment of an IMS operation,
                                        ///< k after k ticks; keeps its last value afterwards; -1 before
  bool interpolating = false;           ///< an IMS operation made this tick, the one that ends it included
  double demand = 0.0;                  ///< target position with its fraction, counts, not wrapped to 32 bit
  double velocity = 0.0;                ///< of the target, counts per tick
  std::int32_t actual = 0;              ///< actual position, counts
};

/// What an emulated drive has counted since it was made.
struct SilverDustCounters {
  std::uint64_t segments_accepted = 0;      ///< IMW acknowledged
  std::uint64_t segments_refused_full = 0;  ///< IMW answered with NAK 6
  std::uint64_t segments_executed = 0;      ///< those with time 0 included
  std::uint64_t underruns = 0;              ///< no fresh segment when one was due, the start included
  int minimum_fill = -1;  ///< lowest number of segments waiting in the queue when one was due (0: underrun)
                          ///< and before the one that ends the operation was queued; -1: none was due so far
  std::uint64_t commands = 0;  ///< packets for this drive, broadcasts included
  std::uint64_t naks = 0;      ///< said to this drive's own address
};

/// A fault of the electronics, or the report of one.
enum class SilverDustFault { OverTemperature, OverVoltage, LowVoltage, MovingError, HoldingError };

/// An emulated QuickSilver SilverDust servo controller on a virtual serial line: 8-bit ASCII protocol,
/// polling and internal status words, data registers, and interpolated motion ("Interpolated Motion",
/// QCI-TD044) from the queue (IMQ, IMW) or from registers, each servo tick in exact integers; an axis with
/// following error. Everything a host can do to it, it does through the line; the functions below are for
/// set-up, faults and observation. Choices where the documents are silent are in SilverDustParameters;
/// besides those:
/// - HLT and a kill motor condition end a motion where the target stands; it stays there until TTP.
/// - Registers 18 and 20..24 cannot be written during an IMS operation: ACK, no effect, command error bit.
/// - Numbers for a stop condition of IMS, MAV, MRV and VMI are taken but never stop anything.
/// - An over-temperature lasts until CIS.
///
/// The drive computes its ticks when it is asked: while nobody observes it, time passes in leaps.
///
/// Its own commands: `fault over_temperature|over_voltage|low_voltage|moving_error|holding_error`, `nak
/// COMMAND CODE COUNT` (see refuse_next()).
class SilverDust : public Drive, public transport::SerialListener {
 public:
  using SampleObserver = std::function<void(const SilverDustSample&)>;

  /// A drive on `line`, which must outlive it. Throws std::invalid_argument for a wrong parameter.
  SilverDust(transport::VirtualSerialLine& line, const SilverDustParameters& parameters, HostTime now);
  ~SilverDust() override;

  /// As given to the constructor, and what has been counted since.
  const SilverDustParameters& parameters() const;
  SilverDustCounters counters() const;

  void observe(Observer observer) override;
  /// Called at each own servo tick while the drive is awake, in place of any other. An empty function ends
  /// that.
  void set_sample_observer(SampleObserver observer);

  std::int32_t position() const override;
  bool has_torque() const override;

  /// Stores a standalone program; RUN starts it.
  void load_program(std::vector<ProgramStep> steps);

  void power_cycle(HostTime now, HostDuration off) override;
  void stall(bool blocked) override;
  void silence(bool silent, HostTime now) override;
  void set_clock_error(double ppm) override;

  /// Makes the drive report a fault; kill motor conditions apply.
  void raise_fault(SilverDustFault fault, HostTime now);

  /// The next `count` commands with number `command` are not executed but answered with a NAK of `code`.
  void refuse_next(int command, int code, int count);

  HostTime next_event() const override { return next_event_; }
  void process(HostTime now) override;
  void on_character(char value, HostTime time) override;

 private:
  class Implementation;

  std::vector<FaultCommand> own_faults(HostTime now) override;

  HostTime next_event_ = kNever;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace interpolated_motion::emulation
