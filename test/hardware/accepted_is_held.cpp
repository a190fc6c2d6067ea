#include "hardware/accepted_is_held.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/playback.h"

namespace interpolated_motion::test {

namespace {

using motion::GoalOutcome;
using motion::GroupState;

struct Shape {
  double duration;   ///< s
  double interval;   ///< s between points
  double amplitude;  ///< rad
  double hertz;
};

Shape shape_of(SweepGoal kind) {
  switch (kind) {
    case SweepGoal::Slow:
      return {6.0, 1.0, 0.3, 0.1};
    case SweepGoal::Fast:
      return {4.0, 0.1, 0.45, 0.6};
    case SweepGoal::Dense:
      break;
  }
  return {3.0, 0.05, 0.03, 2.5};
}

Verdict broken(std::string text) { return {Verdict::Kind::Broken, std::move(text)}; }

}  // namespace

const char* name_of(SweepGoal goal) {
  switch (goal) {
    case SweepGoal::Slow:
      return "slow";
    case SweepGoal::Fast:
      return "fast";
    case SweepGoal::Dense:
      break;
  }
  return "dense";
}

// The amplitude grows from nothing and vanishes again, so it starts and ends at rest.
trajectory::Goal sweep_goal(SweepGoal kind, int joints) {
  const Shape shape = shape_of(kind);
  std::vector<double> times;
  std::vector<std::vector<double>> positions;
  const int points = static_cast<int>(std::lround(shape.duration / shape.interval));
  for (int i = 1; i <= points; ++i) {
    const double t = shape.interval * i;
    const double window = std::pow(std::sin(kPi * t / shape.duration), 2);
    std::vector<double> position;
    position.reserve(static_cast<std::size_t>(joints));
    for (int joint = 0; joint < joints; ++joint)
      position.push_back(shape.amplitude * window * std::sin(2.0 * kPi * shape.hertz * t + 0.7 * joint));
    times.push_back(t);
    positions.push_back(position);
  }
  return make_goal(times, positions);
}

Verdict verdict_of(const YAML::Node& arm, const trajectory::Goal& goal, double bound) {
  Scenario scenario(arm);
  if (!scenario.run_until_state(GroupState::Idle, 60.0))
    return broken("not brought up: " + scenario.snapshot().fault);
  const auto accepted = scenario.submit(goal);
  if (!accepted) return {Verdict::Kind::Refused, accepted.error().text};
  const auto result = scenario.result_of(accepted.value().id);
  if (result.outcome != GoalOutcome::Succeeded) return broken(result.text);
  for (const auto& joint : scenario.driver().report().joints) {
    if (joint.worst_deviation > bound)
      return broken(fmt::format("{} was {:.2f} counts off its path", joint.joint, joint.worst_deviation));
    if (joint.underruns > 0) return broken(fmt::format("{} ran dry", joint.joint));
  }
  return {Verdict::Kind::Held, {}};
}

std::vector<int> sweep_sample(int size, int usual) {
  const char* text = std::getenv("IMD_PROPERTY_CASES");
  const int count = std::clamp(text == nullptr ? usual : std::atoi(text), 1, size);
  std::vector<int> sample;
  sample.reserve(static_cast<std::size_t>(count));
  int step = static_cast<int>(0.381966 * size);  // of the golden section: well mixed however many are taken
  while (std::gcd(step, size) != 1) ++step;
  for (int i = 0; i < count; ++i)
    sample.push_back(static_cast<int>(static_cast<std::int64_t>(i + 1) * step % size));
  return sample;
}

void SweepTally::add(const std::string& combination, const Verdict& verdict) {
  static const bool tells_each = std::getenv("IMD_SWEEP_TEXT") != nullptr;
  const char* word = "refused";
  if (verdict.kind == Verdict::Kind::Held) word = "held";
  if (verdict.kind == Verdict::Kind::Broken) word = "BROKEN";
  if (tells_each) std::printf("%s: %s. %s\n", combination.c_str(), word, verdict.text.c_str());
  refused_ += verdict.kind == Verdict::Kind::Refused ? 1 : 0;
  held_ += verdict.kind == Verdict::Kind::Held ? 1 : 0;
  broken_ += verdict.kind == Verdict::Kind::Broken ? 1 : 0;
  EXPECT_NE(verdict.kind, Verdict::Kind::Broken) << combination << ": " << verdict.text;
}

void SweepTally::print() const {
  std::printf("%s: %d combinations, %d refused, %d accepted, of which %d held\n", name_.c_str(),
              refused_ + accepted(), refused_, accepted(), held_);
}

}  // namespace interpolated_motion::test
