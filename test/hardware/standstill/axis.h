#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/axis_parameters.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"

namespace interpolated_motion::test {

/// A drive that stands still, as the host sees it. It accepts a path that stays where it stands.
class StandstillAxis : public axis::Axis {
 public:
  StandstillAxis(axis::AxisParameters parameters, canopen::Master& master, canopen::NodeLink& node);

  const std::string& joint() const override { return parameters_.joint; }
  const std::string& bus() const override { return master_.bus_name(); }
  std::string description() const override { return who() + ": stands still"; }
  axis::AxisState state() const override { return state_; }
  const std::string& fault_text() const override { return fault_text_; }

  void poll(HostTime now) override;
  HostTime next_deadline() const override;

  void bring_up(HostTime now) override;
  void enable(HostTime) override { state_ = axis::AxisState::Ready; }
  void disable(HostTime) override { state_ = axis::AxisState::Disabled; }
  void reset_fault(HostTime now) override { bring_up(now); }

  double rest_position() const override { return feedback_.position; }
  GoalTime start_lead() const override { return GoalTime{0.02}; }
  axis::TailEncoderPtr encoder_at_rest(double rest, GoalTime wait) const override;
  double record_bus_time() const override { return 0.0; }
  void load(axis::TailPtr tail, HostTime now) override;
  void arm(HostTime begin, HostTime now) override;
  HostTime path_begin() const override { return begin_; }
  void stop(HostTime) override { state_ = axis::AxisState::Ready; }

  Expected<axis::TailPtr, Refusal> standing_tail(HostTime origin, GoalTime rest) const override;
  GoalTime stream_lead() const override { return GoalTime{0.0}; }
  std::optional<GoalTime> committed() const override { return playback(polled_); }
  void hold(GoalTime) override {}
  axis::TailEncoderPtr encoder_behind(axis::Pace) const override { return encoder_at_rest(0.0, {}); }
  bool can_follow(const axis::Tail&) const override { return state_ == axis::AxisState::Moving; }
  void follow(axis::TailPtr tail) override;

  GoalTime playback(HostTime when) const override;
  GoalTime goal_time_at(double drive_seconds) const override;
  bool finished() const override { return finished_; }
  const axis::AxisFeedback& feedback() const override { return feedback_; }
  void status(HostTime now, axis::AxisStatus& out) const override;
  axis::AxisReport report() const override { return {}; }

 private:
  std::string who() const { return "Joint " + parameters_.joint + " (" + node_.name() + ")"; }
  void lose(const std::string& reason);

  axis::AxisParameters parameters_;
  canopen::Master& master_;
  canopen::NodeLink& node_;
  axis::AxisState state_ = axis::AxisState::Offline;
  std::string fault_text_;
  HostTime since_{};  ///< begin of the search
  HostTime polled_{};
  axis::AxisFeedback feedback_;
  trajectory::Path path_;
  HostTime begin_ = kNever;
  bool finished_ = false;
};

}  // namespace interpolated_motion::test
