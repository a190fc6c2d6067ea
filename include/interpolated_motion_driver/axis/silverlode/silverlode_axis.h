#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis_base.h"
#include "interpolated_motion_driver/axis/playback_clock.h"
#include "interpolated_motion_driver/axis/silverlode/command_sequence.h"
#include "interpolated_motion_driver/axis/silverlode/line_start.h"
#include "interpolated_motion_driver/axis/silverlode/segment_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/segment_feed.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_parameters.h"
#include "interpolated_motion_driver/axis/silverlode/status.h"
#include "interpolated_motion_driver/protocol/silverlode/line_master.h"

namespace interpolated_motion::axis {

/// A QuickSilver SilverLode drive in interpolated motion (IMS), fed over a serial line.
///
/// A goal's way: plan() encodes it whole, to see that it can be done; load() empties the drive's queue, looks
/// where the drive stands, and puts a first segment of waiting into it; arm() sends IMS. The time of that
/// command tells when the drive began, so a second segment of waiting can end exactly at the instant the path
/// is to begin at, however long the drives of a line had to wait for their turn. Then segments of the path
/// follow, each encoded when it is due, at a rate that takes the drive's crystal into account; the segment
/// with time 0 ends the motion. If the host stays silent the queue runs dry, and the drive brakes by itself
/// with register 19. How a segment gets into the drive is SegmentDelivery's matter.
class SilverlodeAxis : public AxisBase {
 public:
  /// `common_start`: what starts the drives of the line together; null when each gets an IMS of its own. It,
  /// `line` and `device` must outlive the axis. Throws std::invalid_argument, naming joint and parameter.
  SilverlodeAxis(SilverlodeAxisParameters parameters, silverlode::LineMaster& line,
                 silverlode::DeviceLink& device, LineStart* common_start = nullptr);

  const std::string& bus() const override { return line_.line_name(); }
  std::string description() const override;

  void poll(HostTime now) override;
  HostTime next_deadline() const override;

  void enable(HostTime now) override;
  void disable(HostTime now) override;
  void reset_fault(HostTime now) override;

  double rest_position() const override;
  GoalTime start_lead() const override { return GoalTime{parameters_.start_lead}; }
  std::optional<Refusal> plan(const trajectory::Path& path, GoalTime wait) override;
  std::vector<RecordSlot> record_slots() const override { return planned_slots_; }
  double record_bus_time() const override { return delivery_->record_bus_time(); }
  void load(HostTime now) override;
  void arm(HostTime begin, HostTime now) override;
  HostTime path_begin() const override { return begin_; }
  void stop(HostTime now) override;

  std::optional<Refusal> plan_stream(HostTime origin, GoalTime rest) override;
  GoalTime stream_lead() const override;
  HostTime committed() const override;
  std::optional<Refusal> plan_follow(const trajectory::Path& path) override;
  void follow() override;

  GoalTime playback(HostTime when) const override;
  GoalTime goal_time_at(double drive_seconds) const override {
    return stream_begin_ + feed_.goal_time_at(drive_seconds);
  }
  bool finished() const override { return finished_; }
  const AxisFeedback& feedback() const override { return status_.feedback(); }
  void status(HostTime now, AxisStatus& out) const override;
  AxisReport report() const override;

 private:
  /// Of the enabled drive.
  enum class Phase {
    Off,  ///< it is not enabled
    Ready,
    Clearing,
    Filling,  ///< the first segment is on its way
    Loaded,
    Starting,   ///< IMS is on its way
    Verifying,  ///< IMS was sent to all drives of the line: has this one begun?
    Moving,
    Ending,  ///< played; looks where the drive has stopped
    Braking,
    Emptying,
  };
  using Steps = std::vector<CommandSequence::Step>;

  /// Looks at a drive that is to come to rest; about 12 s on a line at 57600 baud.
  static constexpr int kLooksAtStop = 1000;
  /// The same where STP may have been lost or not obeyed: then it is sent again.
  static constexpr int kLooksAtFault = 50;

  std::string device_name() const override { return device_.name(); }
  void listen(HostTime now) override;
  void go_on(HostDuration away, HostTime now) override;
  void poll_stage(HostTime now) override;
  void forget_drive() override;
  void probe(HostTime now) override;
  std::optional<bool> probe_answer() const override;
  std::string no_answer_text() const override;
  void configure(HostTime now) override;
  AxisState enabled_state() const override;
  bool may_move() const override { return is_motion_phase() || phase_ == Phase::Braking; }
  HostDuration longest_motion(HostTime now) const override;
  void give_up(HostTime now) override;
  void press_stop(HostTime now) override;
  bool stands() const override { return sequence_.state() == CommandSequence::State::Done; }
  bool obeys_stop() const override { return sequence_.running() && heard_stop_; }
  std::string unseen_text() const override;
  void on_fault_stopped() override;

  void poll_enabled(HostTime now);
  void poll_clearing(HostTime now);
  void poll_filling(HostTime now);
  void poll_starting(HostTime now);
  void poll_verifying(HostTime now);
  void poll_moving(HostTime now);
  void poll_ending(HostTime now);
  void poll_braking(HostTime now);
  void advance_when_done(Stage next, HostTime now);

  // What is sent for what: silverlode_bring_up.cpp.
  Steps bring_up_steps();
  Steps enable_steps();
  Steps clear_status();
  Steps emptying_steps();
  CommandSequence::Step settle_on_a_count();
  Steps error_limit_steps();
  CommandSequence::Step await_rest(int looks_left);
  CommandSequence::Step check_no_fault();
  CommandSequence::Step try_multi_register();
  CommandSequence::Step read_rest();
  CommandSequence::Step read_position();
  CommandSequence::Check store(std::int32_t& value) const;
  std::int32_t underrun_deceleration() const;
  std::int32_t stop_deceleration() const;
  double counts_per_radian() const;

  void take_start(const silverlode::Outcome& outcome, HostTime now);
  void withdraw_start();
  CommandSequence::Step check_begun();
  void begin_motion(HostTime now);

  std::vector<RecordSlot> slots_of(const encoding::ImsStream& stream, GoalTime start) const;
  double horizon() const;
  void make_second_wait(HostTime now);
  void feed(HostTime now);
  void offer(bool more, HostTime now);
  double rate_for_next() const;
  void take_execution(const SilverlodeStatus::Execution& look, HostTime now);
  void learn_clock(HostTime asked, double elapsed);
  void look_at_drive(HostTime now);
  HostDuration look_period() const;
  void watch_rest(HostTime now);
  void watch_motion(HostTime now);
  void end_of_motion(HostTime now);
  void start_braking(HostTime now);

  encoding::ImsEncoding encoding() const;
  encoding::ImsEncoding stream_encoding() const;
  GoalTime playback_of_feed(HostTime when) const;
  double drive_rate() const { return 1.0 + 1e-6 * clock_error_ppm_; }
  double tick() const { return parameters_.scale.tick; }
  double demand_at(HostTime when) const;
  std::string state_text() const;
  Phase phase() const { return enabled() ? phase_ : Phase::Off; }
  bool is_motion_phase() const {
    return phase() == Phase::Starting || phase() == Phase::Verifying || phase() == Phase::Moving;
  }
  void enter_phase(Phase phase, HostTime now);
  bool sequence_done(HostTime now);

  SilverlodeAxisParameters parameters_;
  silverlode::LineMaster& line_;
  silverlode::DeviceLink& device_;
  LineStart* common_start_;
  std::size_t start_member_ = 0;  ///< of common_start_
  CommandSequence sequence_;
  SilverlodeStatus status_;

  Phase phase_ = Phase::Off;
  bool heard_stop_ = false;  ///< whether the drive has answered to STP since a fault was found
  std::string revision_;
  bool multi_register_ = true;

  std::int32_t rest_counts_ = 0;
  std::int32_t read_target_ = 0;        ///< register 0 and
  std::int32_t read_deceleration_ = 0;  ///< register 19 as the drive has them before a motion
  trajectory::Path planned_path_;
  std::vector<RecordSlot> planned_slots_;
  std::optional<HostTime> planned_origin_;  ///< host time of goal time 0, for a stream
  std::optional<HostTime> stream_origin_;
  GoalTime stream_begin_{0.0};  ///< goal time at which the feed's own begins, other than 0 for a stream
  SegmentFeed feed_;
  PlaybackClock clock_;
  std::unique_ptr<SegmentDelivery> delivery_;
  double clock_error_ppm_ = 0.0;  ///< as the last motion has shown it
  HostTime begin_ = kNever;
  bool second_wait_made_ = false;
  bool finished_ = false;

  silverlode::RequestId start_id_ = silverlode::kNoRequest;
  int misfits_ = 0;  ///< looks in a row at an execution that does not fit

  std::uint32_t minimum_fill_ = 0;
  std::uint32_t underruns_ = 0;
  std::uint32_t underruns_at_load_ = 0;
  std::uint32_t refused_at_load_ = 0;
};

}  // namespace interpolated_motion::axis
