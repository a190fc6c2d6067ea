#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/cia402/cia402_axis.h"
#include "interpolated_motion_driver/axis/epos/bring_up.h"
#include "interpolated_motion_driver/axis/epos/epos_parameters.h"
#include "interpolated_motion_driver/axis/epos/record_feed.h"
#include "interpolated_motion_driver/axis/epos/telemetry.h"
#include "interpolated_motion_driver/axis/goal_timeline.h"
#include "interpolated_motion_driver/axis/playback_clock.h"

namespace interpolated_motion::axis {

/// A maxon EPOS drive in Interpolated Position Mode (mode 7) on CANopen.
///
/// A goal's way: plan() encodes; load() empties the FIFO, checks where the drive stands, fills the FIFO and
/// compares 0x60C4:04 with what was sent; arm() sends controlword 0x1F, obeyed at the next SYNC; then records
/// follow by time, on the drive's own clock as PlaybackClock knows it; the record with time 0 ends the mode;
/// controlword 0x0F follows. stop() sets halt, waits for standstill, leaves the mode while halt is still set
/// (clearing halt first could resume the motion), empties the FIFO.
class EposAxis : public Cia402Axis {
 public:
  /// `master` and `node` must outlive the axis. Throws std::invalid_argument, naming joint and parameter,
  /// when a limit is not finite.
  EposAxis(EposAxisParameters parameters, canopen::Master& master, canopen::NodeLink& node);

  std::string description() const override;

  double rest_position() const override;
  GoalTime start_lead() const override { return GoalTime{0.0}; }
  std::optional<Refusal> plan(const trajectory::Path& path, GoalTime wait) override;
  std::vector<RecordSlot> record_slots() const override {
    return planned_.feed.slots(planned_.start - planned_.wait);
  }
  double record_bus_time() const override { return parameters_.record_bus_time; }
  void load(HostTime now) override;
  void arm(HostTime begin, HostTime now) override;
  HostTime path_begin() const override;
  void stop(HostTime now) override;

  std::optional<Refusal> plan_stream(HostTime origin, GoalTime rest) override;
  GoalTime stream_lead() const override;
  HostTime committed() const override;
  std::optional<Refusal> plan_follow(const trajectory::Path& path) override;
  void follow() override;

  GoalTime playback(HostTime when) const override { return goal_time_at(clock_.elapsed(when)); }
  GoalTime goal_time_at(double drive_seconds) const override { return timeline_.at(drive_seconds); }
  bool finished() const override { return finished_; }
  const AxisFeedback& feedback() const override { return feedback_; }
  void status(HostTime now, AxisStatus& out) const override;
  AxisReport report() const override;

  const EposFacts& facts() const { return facts_; }

 private:
  /// Of the enabled drive.
  enum class Phase {
    Off,  ///< it is not enabled
    ReadingRest,
    Ready,
    Clearing,
    Filling,
    Verifying,
    Loaded,
    Armed,  ///< start commanded, not yet confirmed
    Moving,
    Ending,  ///< played; waits until bit 4 of the controlword is off
    Braking,
    Emptying,
  };

  /// Records that can be in the FIFO by what has been sent and how far the drive can have played.
  struct FillRange {
    std::size_t least;
    std::size_t most;
    bool contains(std::size_t used) const { return used >= least && used <= most; }
  };

  std::vector<SdoSequence::Step> bring_up_steps() override;
  bool has_reported(HostTime since) const override;
  void on_enabled(HostTime now) override;
  void poll_enabled(HostTime now) override;
  AxisState enabled_state() const override;
  bool is_motion_phase() const override;
  HostDuration longest_motion(HostTime now) const override;
  void give_up(HostTime now) override;
  void press_stop(HostTime now) override;
  bool halted() const override;
  EposTelemetry& drive() override { return telemetry_; }
  const EposTelemetry& drive() const override { return telemetry_; }
  std::string text_of(const canopen::Emcy& emcy) const override;
  std::string fault_detail() const override;
  std::string lost_by_restart() const override { return "its FIFO and settings"; }

  void poll_reading_rest(HostTime now);
  void poll_clearing(HostTime now);
  void poll_filling(HostTime now);
  void poll_verifying(HostTime now);
  void poll_armed(HostTime now);
  void poll_moving(HostTime now);
  void poll_ending(HostTime now);
  void poll_braking(HostTime now);
  void poll_emptying(HostTime now);

  void on_tpdo(int number, const canopen::Frame& frame, HostTime time);
  void note_buffer_errors(cia402::BufferStatus before);
  void watch_motion(HostTime now);

  Phase phase() const { return enabled() ? phase_ : Phase::Off; }
  void enter_phase(Phase phase, HostTime now);
  bool is_playing() const { return phase() == Phase::Armed || phase() == Phase::Moving; }
  std::string clock_text() const;
  void read_rest(std::vector<SdoSequence::Step> before, Phase phase, HostTime now);

  encoding::PvtEncoding encoding() const;
  encoding::PvtEncoding stream_encoding() const;
  double behind_at(double drive_seconds) const;
  void start_loading(HostTime now);
  void start_emptying(HostTime now);
  void feed(HostTime now);
  void start_clock();
  void take_buffer_report(HostTime now);
  void learn_release(std::size_t used, HostTime when);
  void learn_clock(std::size_t used, HostTime when);
  FillRange expected_fill(HostTime when) const;
  void compare_fill(std::size_t used, HostTime when, HostTime now);
  void poll_fill_by_sdo(HostTime now);
  void end_of_motion(HostTime now);
  std::size_t used_records() const { return facts_.capacity - telemetry_.free_records; }
  double counts_per_second(std::int32_t velocity) const;

  EposAxisParameters parameters_;
  EposFacts facts_;
  EposTelemetry telemetry_;
  AxisFeedback feedback_;

  Phase phase_ = Phase::Off;

  std::int32_t rest_counts_ = 0;
  /// What plan() and plan_stream() have made, until load().
  struct Plan {
    RecordFeed feed;
    GoalTime start{0.0};             ///< goal time of the path's start
    GoalTime wait{0.0};              ///< from the start signal until then
    std::optional<HostTime> origin;  ///< host time of goal time 0, for a stream
  };
  Plan planned_;
  RecordFeed feed_;
  GoalTimeline timeline_;
  GoalTime wait_{0.0};  ///< from the start signal to the path's start
  std::optional<HostTime> stream_origin_;
  encoding::PvtStream way_on_;  ///< of plan_follow()
  double way_on_rate_ = 1.0;
  PlaybackClock clock_;
  bool finished_ = false;
  int load_attempts_ = 0;
  std::uint64_t records_due_ = 0;  ///< confirmations of RPDO1 after which all records sent are on the bus
  std::uint32_t held_records_ = 0;
  std::uint64_t reports_taken_ = 0;
  /// Whether the drive takes a record out of its FIFO when it sets out for it (1) or when it has reached it
  /// (0): the documents do not say; seen from the first report of a motion.
  std::optional<std::size_t> early_release_;
  int fill_mismatches_ = 0;
  HostTime fill_asked_{};

  std::uint32_t minimum_fill_ = 0;
  std::uint32_t underruns_ = 0;
  std::uint32_t underruns_at_load_ = 0;
  std::uint32_t overflows_ = 0;
  std::uint32_t refused_writes_ = 0;
  std::uint32_t refused_at_load_ = 0;
  std::uint64_t records_sent_ = 0;
};

}  // namespace interpolated_motion::axis
