#include "interpolated_motion_driver/axis/silverlode/ims_start.h"

#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::axis {

using silverlode::Outcome;

ImsStart::ImsStart(SilverlodePowerStage& stage, LineStart* common) : stage_(stage), common_(common) {
  if (common_ != nullptr) member_ = common_->join();
}

void ImsStart::ask() {
  sent_.reset();
  failure_.reset();
  begun_ = false;
  if (common_ != nullptr) return common_->ask(member_);
  silverlode::DeviceLink& device = stage_.device();
  own_ = device.request(silverlode::ims_request(device.address(), stage_.parameters().ims_arguments));
}

void ImsStart::withdraw() {
  if (common_ != nullptr) common_->withdraw(member_);
}

bool ImsStart::take(const Outcome& outcome) {
  if (own_ == silverlode::kNoRequest || outcome.id != own_) return false;
  own_ = silverlode::kNoRequest;
  if (outcome.accepted()) {
    sent_ = outcome.request_end;
    begun_ = true;
  } else {
    failure_ = stage_.device().text(outcome);
  }
  return true;
}

std::optional<std::string> ImsStart::poll(HostTime now) {
  return common_ != nullptr ? poll_common(now) : std::exchange(failure_, std::nullopt);
}

std::optional<std::string> ImsStart::poll_common(HostTime now) {
  CommandSequence& sequence = stage_.sequence();
  if (!sent_) {
    sent_ = common_->sent();
    if (sent_) sequence.start({check_begun()}, now);
    return std::nullopt;
  }
  if (sequence.state() == CommandSequence::State::Failed) return sequence.failure();
  begun_ = sequence.state() == CommandSequence::State::Done;
  return std::nullopt;
}

// A command to all drives is not answered: whether this one has heard and obeyed it shows in what it does.
CommandSequence::Step ImsStart::check_begun() {
  return {silverlode::rio_request(stage_.device().address()),
          [this](const Outcome& outcome) -> std::optional<std::string> {
            if (!outcome.accepted()) return stage_.device().text(outcome);
            if (silverlode::IoStatus{outcome.word().value_or(0)}.trajectory_active()) return std::nullopt;
            return fmt::format(
                "the drive has not started at {}. If it never does, set `start` of the bus to "
                "`addressed`",
                common_->text());
          }};
}

}  // namespace interpolated_motion::axis
