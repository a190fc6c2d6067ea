#pragma once

#include <utility>
#include <vector>

#include "interpolated_motion_driver/emulation/silverdust/axis.h"
#include "interpolated_motion_driver/emulation/silverdust/command_interpreter.h"
#include "interpolated_motion_driver/emulation/silverdust/data_registers.h"
#include "interpolated_motion_driver/emulation/silverdust/electronics.h"
#include "interpolated_motion_driver/emulation/silverdust/error_limits.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/polling_status.h"
#include "interpolated_motion_driver/emulation/silverdust/program_target.h"
#include "interpolated_motion_driver/emulation/silverdust/registers.h"
#include "interpolated_motion_driver/emulation/silverdust/segment_queue.h"
#include "interpolated_motion_driver/emulation/silverdust/serial_interface.h"
#include "interpolated_motion_driver/emulation/silverdust/servo_clock.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"

namespace interpolated_motion::emulation {

// The drive as a whole: it owns the parts, feeds them characters, commands and servo ticks, and knows when it
// is powered. What a part does is said in its own header; each is named after its chapter of the manuals.
class SilverDust::Implementation {
 public:
  using Refusals = CommandRefusals;

  Implementation(transport::VirtualSerialLine& line, transport::SerialListener& listener,
                 const SilverDustParameters& parameters, HostTime now);

  const SilverDustParameters& parameters() const { return parameters_; }
  SilverDustCounters counters() const;
  void set_sample_observer(SampleObserver observer) { observer_ = std::move(observer); }
  std::int32_t position() const { return axis_.reading(); }
  bool has_torque() const { return awake_ && electronics_.enabled(); }
  void load_program(std::vector<ProgramStep> steps) { program_.load(std::move(steps)); }
  void stall(bool blocked) { axis_.set_stalled(blocked); }

  void power_cycle(HostTime now, HostDuration off);
  void raise_fault(SilverDustFault fault, HostTime now);
  void silence(bool silent, HostTime now) { serial_.silence(silent, now); }
  void set_clock_error(double ppm) { clock_.set_error(ppm); }
  void refuse_next(const Refusals& refusals) { interpreter_.refuse_next(refusals); }

  HostTime next_event() const;
  void catch_up(HostTime now);

  // True when the character has completed a packet.
  bool on_character(char value, HostTime time);

 private:
  CommandRouter command_chapters();
  void restart(HostTime now, HostTime awake_at);
  void wake_up();
  void on_packet(const Packet& packet, HostTime time);
  void tick();
  void check_position_error();
  bool resting() const;
  void observe(bool interpolating) const;

  const SilverDustParameters parameters_;
  SerialInterface serial_;
  ServoClock clock_;
  HostTime awake_at_;
  bool awake_ = false;

  PollingStatus polling_;
  RegisterFile register_file_;
  SegmentQueue queue_;
  ErrorLimits limits_;
  LaggingAxis axis_;
  MotionControl motion_;
  StoredProgram program_;
  Electronics electronics_;
  DataRegisters registers_;
  ProgramTarget program_target_;
  CommandInterpreter interpreter_;
  SampleObserver observer_;
};

}  // namespace interpolated_motion::emulation
