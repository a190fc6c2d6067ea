#include "interpolated_motion_driver/encoding/transmission.h"

#include <gtest/gtest.h>

namespace interpolated_motion::encoding {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(Transmission, CountsOfATurnOfTheJoint) {
  const Transmission transmission{2000, 100, 1, 0.0};
  EXPECT_NEAR(transmission.counts(2 * kPi), 200000, 1e-8);
  EXPECT_NEAR(transmission.counts_per_radian(), 31830.988618379067, 1e-9);
}

TEST(Transmission, OffsetIsWhereTheEncoderReadsZero) {
  const Transmission transmission{4096, 50, -1, 0.25};
  EXPECT_EQ(transmission.counts(0.25), 0);
  EXPECT_NEAR(transmission.counts(0.25 + kPi), -102400, 1e-8);
  EXPECT_NEAR(transmission.joint_position(-102400), 0.25 + kPi, 1e-12);
}

TEST(Transmission, VelocitiesAreSigned) {
  const Transmission transmission{2000, 100, -1, 3.0};
  // One joint turn a second: 100 motor turns a second the other way.
  EXPECT_NEAR(transmission.motor_rpm(2 * kPi), -6000, 1e-9);
  EXPECT_NEAR(transmission.counts_per_second(2 * kPi), -200000, 1e-8);
  EXPECT_NEAR(transmission.joint_velocity_from_rpm(-6000), 2 * kPi, 1e-12);
  EXPECT_NEAR(transmission.joint_velocity(-200000), 2 * kPi, 1e-12);
}

}  // namespace
}  // namespace interpolated_motion::encoding
