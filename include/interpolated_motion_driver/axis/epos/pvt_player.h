#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/axis/cia402/power_stage.h"
#include "interpolated_motion_driver/axis/epos/epos_device.h"
#include "interpolated_motion_driver/axis/epos/fifo_loader.h"
#include "interpolated_motion_driver/axis/epos/fifo_watch.h"
#include "interpolated_motion_driver/axis/epos/pvt_plan.h"
#include "interpolated_motion_driver/axis/epos/record_feed.h"
#include "interpolated_motion_driver/axis/epos/record_sender.h"
#include "interpolated_motion_driver/axis/goal_timeline.h"
#include "interpolated_motion_driver/axis/playback_clock.h"
#include "interpolated_motion_driver/axis/player.h"

namespace interpolated_motion::axis {

/// Plays paths on an EPOS drive in Interpolated Position Mode (mode 7).
///
/// A goal's way: its encoder makes a tail of it; load() fills the FIFO (FifoLoader); arm() sends controlword
/// 0x1F, obeyed at the next SYNC; then records follow by time, on the drive's own clock as PlaybackClock
/// knows it; the record with time 0 ends the mode; controlword 0x0F follows. stop() sets halt, waits for
/// standstill, leaves the mode while halt is still set (clearing halt first could resume the motion), empties
/// the FIFO.
class PvtPlayer final : public Player {
 public:
  /// `stage` and `drive`, its device, must outlive the player.
  PvtPlayer(Cia402PowerStage& stage, EposDevice& drive);

  void begin(HostTime now) override;
  void play(HostTime now) override;
  AxisState enabled_state() const override;
  bool may_move() const override { return is_playing() || phase_ == Phase::Braking; }
  HostDuration longest_motion(HostTime now) const override;
  void give_up(HostTime now) override;

  double rest_position() const override;
  GoalTime start_lead() const override { return GoalTime{0.0}; }
  TailEncoderPtr encoder_at_rest(double rest, GoalTime wait) const override;
  double record_bus_time() const override { return drive_.parameters().record_bus_time; }
  void load(TailPtr tail, HostTime now) override;
  void arm(HostTime begin, HostTime now) override;
  HostTime path_begin() const override;
  void stop(HostTime now) override;

  Expected<TailPtr, Refusal> standing_tail(HostTime origin, GoalTime rest) const override;
  GoalTime stream_lead() const override { return pvt_stream_lead(drive_); }
  std::optional<GoalTime> committed() const override;
  void hold(GoalTime until) override;
  TailEncoderPtr encoder_behind(Pace pace) const override;
  bool can_follow(const Tail& tail) const override;
  void follow(TailPtr tail) override;

  GoalTime playback(HostTime when) const override { return goal_time_at(clock_.elapsed(when)); }
  GoalTime goal_time_at(double drive_seconds) const override { return timeline_.at(drive_seconds); }
  bool finished() const override { return finished_; }
  void motion_status(HostTime now, AxisStatus& out) const override;
  AxisReport report() const override;

 private:
  enum class Phase {
    Off,  ///< the drive is not enabled
    ReadingRest,
    Ready,
    Loading,
    Loaded,
    Armed,  ///< start commanded, not yet confirmed
    Moving,
    Ending,  ///< played; waits until bit 4 of the controlword is off
    Braking,
    Emptying,
  };

  void poll_armed(HostTime now);
  void poll_moving(HostTime now);
  void poll_ending(HostTime now);
  void poll_braking(HostTime now);
  void poll_emptying(HostTime now);

  void enter(Phase phase, HostTime now);
  bool is_playing() const { return phase_ == Phase::Armed || phase_ == Phase::Moving; }
  void start_clock();
  double kept_until() const;  ///< s on the drive's clock, see RecordFeed::knot()
  void watch_motion(HostTime now);
  void end_of_motion(HostTime now);
  void start_emptying(HostTime now);

  Cia402PowerStage& stage_;
  EposDevice& drive_;
  Phase phase_ = Phase::Off;
  std::int32_t rest_counts_ = 0;
  bool watches_as_at_rest_ =
      false;  ///< in Ending: the drive has been told that it need not wait for the host

  RecordFeed feed_;
  GoalTimeline timeline_;
  GoalTime wait_{0.0};  ///< from the start signal to the path's start
  std::optional<HostTime> stream_origin_;
  HostTime origin_{};  ///< of goal time 0, once the clock runs
  PlaybackClock clock_;
  bool finished_ = false;

  RecordSender sender_;
  FifoWatch watch_;
  FifoLoader loader_;
  std::uint32_t underruns_at_load_ = 0;
  std::uint32_t lost_at_load_ = 0;
};

}  // namespace interpolated_motion::axis
