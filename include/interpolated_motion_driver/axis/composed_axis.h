#pragma once

#include <optional>
#include <string>
#include <utility>

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
  TailEncoderPtr encoder_at_rest(double rest, GoalTime wait) const override {
    return player_->encoder_at_rest(rest, wait);
  }
  double record_bus_time() const override { return player_->record_bus_time(); }
  BusWatch bus_watch() const override { return player_->bus_watch(); }
  void load(TailPtr tail, HostTime now) override { player_->load(std::move(tail), now); }
  void arm(HostTime begin, HostTime now) override { player_->arm(begin, now); }
  HostTime path_begin() const override { return player_->path_begin(); }
  void stop(HostTime now) override { player_->stop(now); }

  Expected<TailPtr, Refusal> standing_tail(HostTime origin, GoalTime rest) const override {
    return player_->standing_tail(origin, rest);
  }
  GoalTime stream_lead() const override { return player_->stream_lead(); }
  std::optional<GoalTime> committed() const override { return player_->committed(); }
  void hold(GoalTime until) override { player_->hold(until); }
  TailEncoderPtr encoder_behind(Pace pace) const override { return player_->encoder_behind(pace); }
  trajectory::DemandCheck demand_check() const override { return player_->demand_check(); }
  bool can_follow(const Tail& tail) const override { return player_->can_follow(tail); }
  void follow(TailPtr tail) override { player_->follow(std::move(tail)); }

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
