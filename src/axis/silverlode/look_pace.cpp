#include "interpolated_motion_driver/axis/silverlode/look_pace.h"

#include <algorithm>

#include "interpolated_motion_driver/axis/silverlode/status.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::axis {

namespace registers = silverlode::registers;
using silverlode::kMaxAddress;

namespace {

constexpr int kPartOfTimeout = 3;
/// Times that part, at most: a drive that is heard less often than that is not watched.
constexpr int kLongest = 3;
/// Share of the line that questions have at least.
constexpr double kLeastShare = 0.05;

// Written once: at every poll it is asked how long they take.

const silverlode::Request& longest_question() {
  static const silverlode::Request question =
      silverlode::rrg_request(kMaxAddress, registers::kActualPosition, registers::kImsTicksLeft,
                              registers::kProfileAcceleration, registers::kProfileVelocity);
  return question;
}

const silverlode::Request& shortest_question() {
  static const silverlode::Request question = silverlode::rio_request(kMaxAddress);
  return question;
}

}  // namespace

HostDuration longest_look_time(const silverlode::LineMaster& line) {
  return silverlode::real_exchange_time(line, longest_question());
}

HostDuration look_time(const silverlode::LineMaster& line) {
  return (longest_look_time(line) + silverlode::real_exchange_time(line, shortest_question())) / 2;
}

HostDuration LookPace::period() const {
  return std::max(parameters_.status_period, static_cast<int>(line_.device_count()) * look_time(line_));
}

HostDuration LookPace::overdue() const {
  const HostDuration usual = parameters_.feedback_timeout / kPartOfTimeout;
  const double share = std::max(kLeastShare, 1.0 - parameters_.line_share);
  const HostDuration needed =
      host_duration(static_cast<double>(line_.device_count()) * seconds(look_time(line_)) / share);
  return std::clamp(needed, usual, kLongest * usual);
}

HostDuration LookPace::feedback_timeout() const {
  const int questions = SilverlodeStatus::questions_in_motion(facts_.multi_register);
  return std::max(parameters_.feedback_timeout, (questions + 1) * overdue());
}

}  // namespace interpolated_motion::axis
