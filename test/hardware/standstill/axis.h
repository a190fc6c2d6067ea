#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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
  std::optional<Refusal> plan(const trajectory::Path& path, double rest, GoalTime wait) override;
  std::vector<axis::RecordSlot> record_slots() const override { return {}; }
  double record_bus_time() const override { return 0.0; }
  void load(HostTime) override { state_ = axis::AxisState::Loaded; }
  void arm(HostTime begin, HostTime now) override;
  HostTime path_begin() const override { return begin_; }
  void stop(HostTime) override { state_ = axis::AxisState::Ready; }

  std::optional<Refusal> plan_stream(HostTime origin, GoalTime rest) override;
  GoalTime stream_lead() const override { return GoalTime{0.0}; }
  std::optional<GoalTime> committed() const override { return playback(polled_); }
  std::optional<Refusal> plan_follow(const trajectory::Path& path, axis::Pace) override {
    return plan(path, rest_position(), {});
  }
  std::vector<axis::RecordSlot> follow_slots() const override { return {}; }
  void follow() override { path_ = planned_; }

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
  trajectory::Path planned_;
  trajectory::Path path_;
  HostTime begin_ = kNever;
  bool finished_ = false;
};

}  // namespace interpolated_motion::test
