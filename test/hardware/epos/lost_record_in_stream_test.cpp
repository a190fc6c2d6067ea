#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/setpoint_streaming.h"

// In a stream the FIFO holds a tenth of a second: a record that the bus has lost must be missed before the
// drive gets to the hole, also when the SYNC that would have told of it was lost with it (field trial S9).
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

/// Every drive of the arm.
const std::string kHasToBeAsked = [] {
  std::string drives;
  for (int i = 1; i <= 6; ++i)
    drives += fmt::format("joint{}: {{emulation: {{free_records_pdo_mappable: false}}}}, ", i);
  return "drives: {" + drives + "}";
}();

class LostInAStream : public SetpointStreaming, public testing::WithParamInterface<int> {
 protected:
  /// Streams where the sine is fastest, and loses `frames` frames `instant` after 1.2 s.
  void lose(int frames, double instant, const std::string& changes = "") {
    frames_ = frames;
    lost_at_ = 1.2 + instant;
    start(six_axis(changes), 0.155);
    stream(1.24, [](int) { return 0.001; });
    run(1.0);
    EXPECT_EQ(frames_, 0) << "nothing was lost";
  }

  void look() override {
    if (frames_ == 0 || seconds(scenario->now() - begin) < lost_at_) return;
    std::string reason;
    const std::string command = fmt::format("drop {}", std::exchange(frames_, 0));
    EXPECT_TRUE(scenario->driver().inject("can0", command, &reason, scenario->now())) << reason;
  }

  double worst_acceleration() const {
    double worst = 0.0;
    for (const Smoothness& joint : smoothness) worst = std::max(worst, joint.acceleration);
    return worst;
  }

 private:
  int frames_ = 0;
  double lost_at_ = 0.0;  ///< s after the begin of the stream
};

TEST_P(LostInAStream, IsMissedBeforeTheDriveGetsThere) {
  for (int step = 0; step < 10; ++step) {
    const double instant = 0.0031 * step;  // all phases of SYNC (10 ms) and of the records (25 ms)
    lose(GetParam(), instant);
    const std::string text = scenario->snapshot().fault;
    EXPECT_EQ(text.find("0xFF0C"), std::string::npos) << instant << " s: " << text;
    EXPECT_LE(worst_acceleration(), 1.05 * kAcceleration) << instant << " s: " << text;
  }
}

TEST_P(LostInAStream, IsMissedWhereSyncIsRareToo) {
  for (int step = 0; step < 10; ++step) {
    const double instant = 0.0051 * step;  // all phases of SYNC (50 ms)
    lose(GetParam(), instant, "buses: {can0: {sync_period: 0.05}}");
    const std::string text = scenario->snapshot().fault;
    EXPECT_EQ(text.find("0xFF0C"), std::string::npos) << instant << " s: " << text;
    EXPECT_LE(worst_acceleration(), 1.05 * kAcceleration) << instant << " s: " << text;
  }
}

TEST_P(LostInAStream, IsMissedByADriveThatHasToBeAskedToo) {
  for (int step = 0; step < 10; ++step) {
    const double instant = 0.0051 * step;  // all phases of the questions (50 ms)
    lose(std::min(GetParam(), 5), instant, kHasToBeAsked);
    const std::string text = scenario->snapshot().fault;
    EXPECT_EQ(text.find("0xFF0C"), std::string::npos) << instant << " s: " << text;
    EXPECT_LE(worst_acceleration(), 1.05 * kAcceleration) << instant << " s: " << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, LostInAStream, testing::Values(1, 2, 3, 5, 8, 12, 20));

}  // namespace
}  // namespace interpolated_motion::test
