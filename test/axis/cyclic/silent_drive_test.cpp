#include <cstdint>

#include <gtest/gtest.h>

#include "axis/cyclic/setpoint_stream_fixture.h"

// Target positions of a drive that does not answer SYNC.
namespace interpolated_motion::axis {
namespace {

// At 2 rad/s: 20 counts a period. Whether it has got the last two target positions is not known, nor whether
// it would get the next ones: nothing becomes of a stop before it is heard of.
TEST_F(SetpointStreamTest, ADriveThatIsNotHeardOfIsSentWhereItGoesByItself) {
  stream.follow(ramp(0.0, 2.0, 2.0), at(900));
  play(950, 1050);
  EXPECT_EQ(*stream.next(at(1050), false), 2 * (1060 - 900));
  stream.brake();
  EXPECT_EQ(*stream.next(at(1060), false), 2 * (1070 - 900));
  EXPECT_EQ(*stream.next(at(1070), false), 2 * (1080 - 900));
  targets.clear();
  play(1080, 1600);
  EXPECT_EQ(targets.front(), 2 * (1090 - 900));
  EXPECT_EQ(targets.back(), targets[targets.size() - 10]);
  expect_within_acceleration(kMaxAcceleration);
}

// The path bends off at 4 rad/s^2; a drive that interpolates on lines goes straight on. Known to it are 130
// and 147 counts, at 1070 and 1080 ms.
TEST_F(SetpointStreamTest, ADriveThatIsHeardOfAgainIsLedBackFromWhereItWent) {
  encoding::SetpointEncoding encoding = encoding_of(kCounts);
  encoding.order = 1;
  SetpointStream on_lines(encoding, limits());
  trajectory::Polynomial bent;
  bent.coefficients = {0.0, 2.0, -2.0};
  on_lines.follow(trajectory::Path({{GoalTime{0.0}, GoalTime{0.5}, bent}}), at(1000));
  for (int sync = 1000; sync < 1100; sync += 10) on_lines.next(at(sync));
  EXPECT_EQ(*on_lines.next(at(1100), false), 147 + 3 * 17);
  EXPECT_EQ(*on_lines.next(at(1110), false), 147 + 4 * 17);
  const std::int32_t first = *on_lines.next(at(1120), true);
  EXPECT_EQ(first, 147 + 5 * 17);
  const auto detour = on_lines.take_detour();
  ASSERT_TRUE(detour);
  EXPECT_GE(detour->counts, 147 + 5 * 17 - 1000.0 * (2.0 * 0.13 - 2.0 * 0.13 * 0.13) - 1.0);
  EXPECT_FALSE(on_lines.is_led());
}

// A drive that hears, and cannot be heard, is not to be led astray.
TEST_F(SetpointStreamTest, FiveTimesAtMost) {
  stream.follow(ramp(0.0, 2.0, 2.0), at(900));
  play(1000, 1050);
  for (int sync = 1050; sync < 1200; sync += 10) stream.next(at(sync), false);
  EXPECT_TRUE(stream.is_led());
}

TEST_F(SetpointStreamTest, AtRestItDoesNotMatterWhetherADriveIsHeard) {
  stream.rest(5);
  for (int sync = 1000; sync < 1100; sync += 10) EXPECT_EQ(*stream.next(at(sync), false), 5);
  EXPECT_EQ(stream.missed(), 0U);
}

}  // namespace
}  // namespace interpolated_motion::axis
