#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "interpolated_motion_driver/axis/playback_clock.h"
#include "interpolated_motion_driver/axis/silverlode/execution_watch.h"
#include "interpolated_motion_driver/axis/silverlode/ims_plan.h"
#include "interpolated_motion_driver/axis/silverlode/ims_start.h"
#include "interpolated_motion_driver/axis/silverlode/line_start.h"
#include "interpolated_motion_driver/axis/silverlode/power_stage.h"
#include "interpolated_motion_driver/axis/silverlode/segment_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/segment_feed.h"
#include "interpolated_motion_driver/axis/silverlode/segment_loader.h"

namespace interpolated_motion::axis {

/// Plays paths on a SilverLode drive in interpolated motion (IMS).
///
/// A goal's way: it is encoded whole, to see that it can be done; load() empties the drive's queue, looks
/// where the drive stands, and puts a first segment of waiting into it; arm() sends IMS. The time of that
/// command tells when the drive began, so a second segment of waiting can end exactly at the instant the path
/// is to begin at, however long the drives of a line had to wait for their turn. Then segments of the path
/// follow, each encoded when it is due, at a rate that takes the drive's crystal into account; the segment
/// with time 0 ends the motion. If the host stays silent the queue runs dry, and the drive brakes by itself
/// with register 19. How a segment gets into the drive is SegmentDelivery's matter.
class ImsPlayer final : public SegmentPlayer {
 public:
  /// `common_start`: what starts the drives of the line together; null when each gets an IMS of its own. It
  /// and `stage` must outlive the player. Throws std::invalid_argument, naming joint and parameter.
  ImsPlayer(SilverlodePowerStage& stage, LineStart* common_start);

  DriveCommands::Steps queue_steps() override { return delivery_->bring_up_steps(); }
  std::string queue_text() const override { return delivery_->description(); }
  bool take(const silverlode::Outcome& outcome, HostTime now) override;
  bool interpolates() const override { return phase_ == Phase::Starting || phase_ == Phase::Moving; }

  void begin(HostTime now) override;
  void play(HostTime now) override;
  AxisState enabled_state() const override;
  bool may_move() const override { return interpolates() || phase_ == Phase::Braking; }
  HostDuration longest_motion(HostTime now) const override;
  void give_up(HostTime now) override;

  double rest_position() const override;
  GoalTime start_lead() const override;
  TailEncoderPtr encoder_at_rest(double rest, GoalTime wait) const override;
  double record_bus_time() const override { return delivery_->record_bus_time(); }
  BusWatch bus_watch() const override;
  void load(TailPtr tail, HostTime now) override;
  void arm(HostTime begin, HostTime now) override;
  HostTime path_begin() const override { return begin_; }
  void stop(HostTime now) override;

  Expected<TailPtr, Refusal> standing_tail(HostTime origin, GoalTime rest) const override;
  GoalTime stream_lead() const override { return ims_stream_lead(parameters_, *delivery_, stage_.line()); }
  std::optional<GoalTime> committed() const override;
  void hold(GoalTime until) override;
  TailEncoderPtr encoder_behind(Pace pace) const override;
  bool can_follow(const Tail& tail) const override;
  void follow(TailPtr tail) override;

  GoalTime playback(HostTime when) const override { return stream_begin_ + playback_of_feed(when); }
  GoalTime goal_time_at(double drive_seconds) const override {
    return stream_begin_ + feed_.goal_time_at(drive_seconds);
  }
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
    Starting,  ///< IMS is on its way
    Moving,
    Ending,  ///< played; looks where the drive has stopped
    Braking,
    Emptying,
  };

  void poll_starting(HostTime now);
  void poll_moving(HostTime now);
  void poll_ending(HostTime now);
  void begin_motion(HostTime now);
  void watch_motion(HostTime now);
  void end_of_motion(HostTime now);
  GoalTime playback_of_feed(HostTime when) const;
  void enter(Phase phase, HostTime now);

  SilverlodePowerStage& stage_;
  const SilverlodeAxisParameters& parameters_;
  Phase phase_ = Phase::Off;
  std::int32_t rest_counts_ = 0;

  double lead_ = 0.0;  ///< s, from arm() to the begin of the path, as of load()
  std::optional<HostTime> stream_origin_;
  GoalTime stream_begin_{0.0};  ///< goal time at which the feed's own begins, other than 0 for a stream
  SegmentFeed feed_;
  PlaybackClock clock_;
  std::unique_ptr<SegmentDelivery> delivery_;
  SegmentLoader loader_;
  ImsStart start_;
  ExecutionWatch execution_;
  HostTime begin_ = kNever;
  bool second_wait_made_ = false;
  bool finished_ = false;

  std::uint32_t minimum_fill_ = 0;
  std::uint32_t underruns_ = 0;
  std::uint32_t underruns_at_load_ = 0;
  std::uint32_t refused_at_load_ = 0;
};

}  // namespace interpolated_motion::axis
