#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"

#include <iterator>
#include <utility>

#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"

namespace interpolated_motion::axis {

namespace {

bool unanswered(const canopen::SdoResult& result) {
  return !result.ok && !result.aborted_by_drive && result.abort_code == canopen::abort_code::kTimeout;
}

}  // namespace

SdoSequence::Step SdoSequence::read(canopen::ObjectAddress address, Check check) {
  return {address, std::nullopt, std::move(check)};
}

SdoSequence::Step SdoSequence::write(const canopen::SdoWrite& write, Check check) {
  return {write.address, write, std::move(check)};
}

void SdoSequence::start(std::vector<Step> steps, HostTime now) {
  cancel();
  steps_.assign(std::make_move_iterator(steps.begin()), std::make_move_iterator(steps.end()));
  state_ = State::Running;
  failure_.clear();
  poll(now);
}

void SdoSequence::insert(std::vector<Step> steps) {
  steps_.insert(steps_.begin(), std::make_move_iterator(steps.begin()), std::make_move_iterator(steps.end()));
}

void SdoSequence::replace_rest(std::vector<Step> steps) {
  steps_.clear();
  insert(std::move(steps));
}

void SdoSequence::cancel() {
  if (in_progress_) node_.sdo().abort(canopen::abort_code::kGeneral);
  node_.sdo().take_result();
  steps_.clear();
  in_progress_ = false;
  attempts_ = 0;
  state_ = State::Idle;
}

void SdoSequence::poll(HostTime now) {
  while (state_ == State::Running) {
    if (in_progress_) {
      const auto result = node_.sdo().take_result();
      if (!result) return;
      in_progress_ = false;
      finish_step(*result);
    } else if (steps_.empty()) {
      state_ = State::Done;
    } else {
      start_step(now);
    }
  }
}

HostTime SdoSequence::next_deadline() const { return in_progress_ ? node_.sdo().next_deadline() : kNever; }

void SdoSequence::start_step(HostTime now) {
  const Step& step = steps_.front();
  node_.sdo().set_timeout((attempts_ + 1) * timeout_);
  in_progress_ =
      step.write ? node_.sdo().start_download(*step.write, now) : node_.sdo().start_upload(step.address, now);
  ++attempts_;
}

void SdoSequence::finish_step(const canopen::SdoResult& result) {
  if (unanswered(result) && attempts_ <= kRetries) return;
  attempts_ = 0;
  const Step step = std::move(steps_.front());
  steps_.pop_front();
  std::optional<std::string> failure;
  if (step.check) {
    failure = step.check(result);
  } else if (!result.ok) {
    failure = result.text();
  }
  if (!failure) return;
  failure_ = *failure;
  steps_.clear();
  state_ = State::Failed;
}

}  // namespace interpolated_motion::axis
