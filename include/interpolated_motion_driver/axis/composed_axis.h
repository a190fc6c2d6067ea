#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/player.h"
#include "interpolated_motion_driver/axis/power_stage.h"

namespace interpolated_motion::axis {

/// An axis made of a power stage and a player.
class ComposedAxis : public Axis {
 public:
  ComposedAxis() = default;
  ComposedAxis(const ComposedAxis&) = delete;
  ComposedAxis& operator=(const ComposedAxis&) = delete;

  const std::string& joint() const override { return stage_->joint(); }
  const std::string& bus() const override { return stage_->bus(); }
  std::string description() const override { return stage_->description(); }
  AxisState state() const override { return stage_->state(); }
  const std::string& fault_text() const override { return stage_->fault_text(); }

  void poll(HostTime now) override { stage_->poll(now); }
  HostTime next_deadline() const override { return stage_->next_deadline(); }

  void bring_up(HostTime now) override { stage_->bring_up(now); }
  void enable(HostTime now) override { stage_->enable(now); }
  void disable(HostTime now) override { stage_->disable(now); }
  void reset_fault(HostTime now) override { stage_->reset_fault(now); }

  double rest_position() const override { return player_->rest_position(); }
  GoalTime start_lead() const override { return player_->start_lead(); }
  std::optional<Refusal> plan(const trajectory::Path& path, double rest, GoalTime wait) override {
    return player_->plan(path, rest, wait);
  }
  std::vector<RecordSlot> record_slots() const override { return player_->record_slots(); }
  double record_bus_time() const override { return player_->record_bus_time(); }
  BusWatch bus_watch() const override { return player_->bus_watch(); }
  void load(HostTime now) override { player_->load(now); }
  void arm(HostTime begin, HostTime now) override { player_->arm(begin, now); }
  HostTime path_begin() const override { return player_->path_begin(); }
  void stop(HostTime now) override { player_->stop(now); }

  std::optional<Refusal> plan_stream(HostTime origin, GoalTime rest) override {
    return player_->plan_stream(origin, rest);
  }
  GoalTime stream_lead() const override { return player_->stream_lead(); }
  std::optional<GoalTime> committed() const override { return player_->committed(); }
  std::optional<Refusal> plan_follow(const trajectory::Path& path, Pace pace) override {
    return player_->plan_follow(path, pace);
  }
  trajectory::DemandCheck demand_check() const override { return player_->demand_check(); }
  std::vector<RecordSlot> follow_slots() const override { return player_->follow_slots(); }
  void follow() override { player_->follow(); }

  GoalTime playback(HostTime when) const override { return player_->playback(when); }
  GoalTime goal_time_at(double drive_seconds) const override { return player_->goal_time_at(drive_seconds); }
  bool finished() const override { return player_->finished(); }
  const AxisFeedback& feedback() const override { return stage_->feedback(); }
  void status(HostTime now, AxisStatus& out) const override {
    stage_->drive_status(out);
    player_->motion_status(now, out);
  }
  AxisReport report() const override { return player_->report(); }
  std::optional<AxisNote> take_note() override { return stage_->notes().take(); }

 protected:
  /// To be called by the constructor of the axis, which owns both.
  void join(PowerStage& stage, Player& player) {
    stage_ = &stage;
    player_ = &player;
  }

 private:
  PowerStage* stage_ = nullptr;
  Player* player_ = nullptr;
};

}  // namespace interpolated_motion::axis
