#include "hardware/standstill/axis.h"

#include <chrono>
#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::test {
namespace {

using axis::AxisState;

constexpr HostDuration kPollInterval = std::chrono::milliseconds(10);
constexpr HostDuration kPatience = std::chrono::milliseconds(500);  // without a position
constexpr double kLooksAtAPiece = 8.0;

std::int32_t position_in(const canopen::Frame& frame) {
  std::uint32_t bits = 0;
  for (unsigned i = 0; i < 4; ++i) bits |= static_cast<std::uint32_t>(frame.data[i]) << (8 * i);
  return static_cast<std::int32_t>(bits);
}

struct StandstillTail : axis::Tail {
  trajectory::Path path;
};

class StandstillEncoder : public axis::TailEncoder {
 public:
  StandstillEncoder(std::string who, const encoding::Transmission& transmission, double here)
      : who_(std::move(who)), transmission_(transmission), here_(here) {}

  Expected<axis::TailPtr, Refusal> encode(const trajectory::Path& path) const override {
    for (const trajectory::Piece& piece : path.pieces()) {
      for (double look = 0.0; look <= kLooksAtAPiece; ++look) {
        const GoalTime time = piece.start + look / kLooksAtAPiece * piece.duration();
        const double away = path.sample(time).position - here_;
        if (std::abs(away * transmission_.counts_per_radian()) <= 1.0) continue;
        return Refusal{GoalError::InvalidGoal,
                       fmt::format("{} stands still at {:.4f} rad; the goal leads away.", who_, here_)};
      }
    }
    auto tail = std::make_unique<StandstillTail>();
    tail->path = path;
    return axis::TailPtr(std::move(tail));
  }

 private:
  std::string who_;
  encoding::Transmission transmission_;
  double here_;
};

}  // namespace

StandstillAxis::StandstillAxis(axis::AxisParameters parameters, canopen::Master& master,
                               canopen::NodeLink& node)
    : parameters_(std::move(parameters)), master_(master), node_(node) {
  node.set_tpdo_handler([this](int, const canopen::Frame& frame, HostTime time) {
    feedback_ = {time, parameters_.transmission.joint_position(position_in(frame)), 0.0};
  });
}

void StandstillAxis::bring_up(HostTime now) {
  state_ = AxisState::Configuring;
  fault_text_.clear();
  since_ = polled_ = now;
  node_.send_nmt(canopen::NmtCommand::Start);
}

void StandstillAxis::poll(HostTime now) {
  polled_ = now;
  const bool heard = feedback_.time > since_;
  if (state_ == AxisState::Offline) return;
  if (state_ == AxisState::Configuring) {
    if (heard) state_ = AxisState::Disabled;
    if (!heard && now - since_ > parameters_.bring_up_timeout) lose("no position has come from the drive");
    return;
  }
  if (now - feedback_.time > kPatience) return lose("no position comes from the drive any more");
  if (state_ != AxisState::Moving || playback(now) < path_.end_time()) return;
  finished_ = true;
  state_ = AxisState::Ready;
}

HostTime StandstillAxis::next_deadline() const { return polled_ + kPollInterval; }

void StandstillAxis::lose(const std::string& reason) {
  state_ = AxisState::Offline;
  fault_text_ = fmt::format("{}: {}.", who(), reason);
}

axis::TailEncoderPtr StandstillAxis::encoder_at_rest(double /*rest*/, GoalTime /*wait*/) const {
  return std::make_unique<StandstillEncoder>(who(), parameters_.transmission, feedback_.position);
}

void StandstillAxis::load(axis::TailPtr tail, HostTime /*now*/) {
  follow(std::move(tail));
  finished_ = false;
  state_ = AxisState::Loaded;
}

void StandstillAxis::follow(axis::TailPtr tail) { path_ = axis::own<StandstillTail>(*tail).path; }

Expected<axis::TailPtr, Refusal> StandstillAxis::standing_tail(HostTime /*origin*/, GoalTime /*rest*/) const {
  return encoder_at_rest(0.0, {})->encode(trajectory::Path(feedback_.position));
}

void StandstillAxis::arm(HostTime begin, HostTime /*now*/) {
  begin_ = begin;
  state_ = AxisState::Moving;
}

GoalTime StandstillAxis::playback(HostTime when) const {
  return begin_ == kNever ? path_.start_time() - start_lead() : goal_time_at(seconds(when - begin_));
}

GoalTime StandstillAxis::goal_time_at(double drive_seconds) const {
  return path_.start_time() + GoalTime{drive_seconds};
}

void StandstillAxis::status(HostTime /*now*/, axis::AxisStatus& out) const {
  out = {};
  out.online = state_ != AxisState::Offline;
  out.state = axis::to_string(state_);
  out.demand_position = feedback_.position;
}

}  // namespace interpolated_motion::test
