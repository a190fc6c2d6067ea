#include "interpolated_motion_driver/axis/silverlode/command_sequence.h"

#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::axis {

namespace {

/// Refusals of a command that cannot be read, as one that was garbled on the line.
bool not_understood(const silverlode::Outcome& outcome) {
  using silverlode::NakCode;
  return outcome.refused_with(NakCode::BadCommand) || outcome.refused_with(NakCode::BadFormat) ||
         outcome.refused_with(NakCode::BadAddress);
}

}  // namespace

void CommandSequence::start(std::vector<Step> steps, HostTime now) {
  cancel();
  steps_.assign(std::make_move_iterator(steps.begin()), std::make_move_iterator(steps.end()));
  state_ = State::Running;
  failure_.clear();
  unheard_ = false;
  misunderstood_ = 0;
  waiting_since_ = now;
  poll(now);
}

void CommandSequence::insert(std::vector<Step> steps) {
  steps_.insert(steps_.begin(), std::make_move_iterator(steps.begin()), std::make_move_iterator(steps.end()));
}

void CommandSequence::cancel() {
  steps_.clear();
  awaited_ = silverlode::kNoRequest;
  state_ = State::Idle;
}

void CommandSequence::end(const std::string& failure) {
  failure_ = failure;
  steps_.clear();
  awaited_ = silverlode::kNoRequest;
  state_ = State::Failed;
}

void CommandSequence::poll(HostTime now) {
  if (state_ != State::Running) return;
  if (now - waiting_since_ > kPatience)
    return end(fmt::format("{}: commands do not get onto the line: is it connected?", device_.name()));
  if (awaited_ != silverlode::kNoRequest) return;
  if (steps_.empty()) {
    state_ = State::Done;
  } else {
    awaited_ = device_.request(steps_.front().request);
  }
}

bool CommandSequence::take(const silverlode::Outcome& outcome, HostTime now) {
  if (awaited_ == silverlode::kNoRequest || outcome.id != awaited_) return false;
  awaited_ = silverlode::kNoRequest;
  waiting_since_ = now;
  if (not_understood(outcome) && misunderstood_++ < kRepeats) {
    poll(now);
    return true;
  }
  misunderstood_ = 0;
  const Step step = std::move(steps_.front());
  steps_.pop_front();
  std::optional<std::string> failure;
  if (step.check) {
    failure = step.check(outcome);
  } else if (!outcome.accepted()) {
    failure = device_.text(outcome);
  }
  if (failure) end(*failure);
  unheard_ = failure && outcome.unknown();
  poll(now);
  return true;
}

}  // namespace interpolated_motion::axis
