#pragma once

#include <array>
#include <string>

#include "interpolated_motion_driver/emulation/silverdust/axis.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/interpolation.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/profile.h"
#include "interpolated_motion_driver/emulation/silverdust/registers.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/emulation/silverdust/status.h"

namespace interpolated_motion::emulation {

// The parts of the drive put together. Five source files: power, clock and characters
// (silverdust_implementation.cpp), commands (silverdust_commands.cpp, silverdust_command_actions.cpp), motion
// and faults (silverdust_motion.cpp), registers and status words (silverdust_state.cpp).
class SilverDust::Implementation : public ProgramTarget {
 public:
  Implementation(transport::VirtualSerialLine& line, transport::SerialListener& listener,
                 const SilverDustParameters& parameters, HostTime now);

  // Commands to be refused without being executed.
  struct Refusals {
    std::int64_t command = -1;
    NakCode code = NakCode::BadCommand;
    int left = 0;
  };

  const SilverDustParameters& parameters() const { return parameters_; }
  SilverDustCounters counters() const;
  void set_sample_observer(SampleObserver observer) { observer_ = std::move(observer); }
  std::int32_t position() const;
  void load_program(std::vector<ProgramStep> steps) { program_.load(std::move(steps)); }
  void stall(bool blocked) { axis_.set_stalled(blocked); }

  void power_cycle(HostTime now, HostDuration off);
  void raise_fault(SilverDustFault fault, HostTime now);
  void silence(bool silent, HostTime now);
  void set_clock_error(double ppm);
  void refuse_next(const Refusals& refusals) { refusals_ = refusals; }

  HostTime next_event() const;
  void catch_up(HostTime now);
  bool on_character(char value, HostTime time);

  void program_write(std::int64_t reg, std::int32_t value) override;
  std::int32_t program_read(std::int64_t reg) const override;
  void program_start_interpolation() override;

 private:
  // What has the profile generator.
  enum class Motion { None, Interpolated, Profile, Velocity, Stopping };

  // Answer to a command.
  struct Answer {
    static constexpr std::size_t kWords = 8;
    enum class Kind { None, Acknowledge, Data, Nak };
    Kind kind = Kind::Acknowledge;
    NakCode code = NakCode::BadCommand;
    std::uint16_t echo = 0;
    std::array<std::uint16_t, kWords> words{};
    std::size_t word_count = 0;
  };

  // silverdust_implementation.cpp
  void restart(HostTime now, HostTime awake_at);
  void wake_up();
  void drop_answers(HostTime now);
  HostTime tick_time(std::int64_t tick) const;
  std::int64_t ticks_until(HostTime now) const;
  void on_packet(const Packet& packet, HostTime time);
  void send(const Answer& answer, int address, HostTime time);

  // silverdust_commands.cpp
  Answer execute(const Packet& packet);
  Answer obey(const CommandInfo& info, const Packet& packet);
  Answer immediate(Command command, const Packet& packet);
  Answer program(Command command, const Packet& packet);
  Answer bad_value();
  Answer cannot_start();
  static Answer nak(NakCode code);
  static Answer word(std::uint16_t value, std::uint16_t echo);

  // silverdust_command_actions.cpp
  Answer read_registers(const Packet& packet);
  Answer write_register(const Packet& packet);
  Answer write_queue(const Packet& packet);
  Answer start_interpolation(const Packet& packet);
  Answer start_move(Command command, const Packet& packet);
  Answer velocity_mode(const Packet& packet);
  Answer stop(const Packet& packet);
  Answer restart_command();
  Answer set_error_limits(const Packet& packet);
  Answer set_identity(const Packet& packet);
  Answer set_ack_delay(const Packet& packet);
  Answer check_status(const Packet& packet);
  Answer kill_conditions(const Packet& packet);
  Answer clear_poll(const Packet& packet);

  // silverdust_motion.cpp
  void tick();
  void move();
  void observe(bool interpolating) const;
  void end_motion();
  void halt();
  void kill();
  void check_errors();
  void check_kill_conditions();
  bool resting() const;
  bool busy() const { return motion_ != Motion::None || program_.running(); }
  std::int64_t ordinary_step(std::int64_t acceleration) const;
  std::int64_t running_step() const;

  // silverdust_state.cpp
  std::int32_t read_register(std::int64_t number) const;
  std::int32_t error_register() const;
  std::int32_t velocity_register() const;
  bool set_register(std::int64_t number, std::int32_t value);
  std::uint16_t internal_status() const;
  std::uint16_t io_word() const;
  void clear_internal_status();
  std::int64_t position_error() const;
  void latch(std::uint16_t status_bits, std::uint16_t polling_bits);

  const SilverDustParameters parameters_;
  transport::VirtualSerialLine& line_;
  int port_;

  HostTime now_;  // of the packet that is executed
  HostTime awake_at_;
  bool awake_ = false;
  bool silent_ = false;
  HostTime epoch_;
  double period_ns_;
  std::int64_t ticks_ = 0;

  PacketParser parser_;
  std::uint64_t aborted_seen_ = 0;
  int address_;
  int group_;
  int ack_delay_;
  std::string text_;

  RegisterFile registers_;
  PollingStatus polling_;
  std::uint16_t latched_status_ = 0;
  bool temperature_ok_ = true;
  ProfileGenerator profile_;
  SegmentQueue queue_;
  InterpolatedMove interpolation_;
  StoredProgram program_;
  LaggingAxis axis_;

  Motion motion_ = Motion::None;
  std::int64_t motion_step_ = 0;  // of the running profile, velocity or stopping motion, fractions per tick
  bool enabled_ = false;
  bool killed_ = false;
  bool kill_keeps_driver_ = false;
  std::uint16_t kill_enable_ = 0;
  std::uint16_t kill_state_ = 0;
  int moving_limit_ = 0;
  int holding_limit_ = 0;
  int holding_delay_ = 0;
  int holding_countdown_ = 0;
  std::int64_t largest_error_ = 0;

  Refusals refusals_;
  SampleObserver observer_;
  SilverDustCounters counters_;
};

}  // namespace interpolated_motion::emulation
