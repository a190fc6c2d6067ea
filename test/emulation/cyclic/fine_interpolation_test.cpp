#include "interpolated_motion_driver/emulation/cyclic/fine_interpolation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "interpolation/cip_interpolator.h"

// The drive's evaluation (Neville, in ms) against the driver's (Newton's coefficients, in s): two ways to the
// same polynomials.
namespace interpolated_motion::emulation {
namespace {

constexpr double kPeriodMs = 10.0;

HostTime at_ms(double ms) { return HostTime(host_duration(ms * 1e-3)); }

interpolation::CipInterpolator driver_side(int order) {
  interpolation::CipParameters parameters;
  parameters.order = order;
  parameters.period = std::chrono::milliseconds(10);
  parameters.missed_updates = 1000;
  return interpolation::CipInterpolator(parameters);
}

TEST(FineInterpolation, AgreesWithTheDriversInterpolator) {
  std::mt19937_64 engine(99);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  for (int order = 1; order <= 3; ++order) {
    FineInterpolation drive;
    drive.set_grid(kPeriodMs, 1.0);
    drive.set_order(order);
    drive.enter(0.0);
    interpolation::CipInterpolator driver = driver_side(order);
    double last = 0.0;
    int lost = 0;
    for (int n = 1; n <= 500; ++n) {
      const bool is_lost = n > 1 && uniform() < 0.15;
      if (is_lost) ++lost;
      // Whole microseconds, so that both clocks hold them exactly enough.
      const double arrival = n * kPeriodMs + std::floor(uniform() * 4000 - 2000) * 1e-3;
      for (double t = std::ceil(last); t < arrival; t += 1.0) {
        const MotionState demand = drive.at(t);
        const interpolation::CipSample sample = driver.sample(at_ms(t));
        const double tolerance = 1e-8 * (1.0 + std::abs(demand.position));
        EXPECT_NEAR(demand.position, sample.value, tolerance) << "order " << order << ", " << t << " ms";
        EXPECT_NEAR(demand.velocity, sample.first_derivative * 1e-3, tolerance);
        EXPECT_NEAR(demand.acceleration, sample.second_derivative * 1e-6, tolerance);
      }
      last = arrival;
      if (is_lost) continue;
      const double position = std::floor(1000 * std::sin(0.05 * n) + 10 * uniform());
      drive.update(position, arrival);
      driver.push(interpolation::SystemTime(host_duration((arrival + kPeriodMs) * 1e-3)), position,
                  at_ms(arrival));
    }
    EXPECT_GT(lost, 40);
    EXPECT_GE(drive.missed_in_all(), static_cast<std::uint32_t>(lost) - 5U);
    EXPECT_LE(drive.missed_in_all(), static_cast<std::uint32_t>(lost));
  }
}

// Against the coefficients as the document prints them, with the V of b1 read as the difference.
TEST(FineInterpolation, VelocityAndTorqueHaveTheDocumentsPolynomials) {
  FineInterpolation drive;
  drive.set_grid(kPeriodMs, 1.0);
  drive.set_order(3);
  drive.enter(0.0);
  const double velocities[] = {1.0, 4.0, -2.0, 5.0};
  const double torques[] = {10.0, 30.0, -20.0, 40.0};
  for (int n = 0; n < 4; ++n) {
    drive.update(0.0, n * kPeriodMs);
    drive.feed_forward(velocities[n], torques[n]);
  }
  const double v0 = velocities[3], v1 = velocities[2], v2 = velocities[1];
  const double dv = v0 - v1, da = dv - (v1 - v2);
  for (double tau = 0.0; tau < 15.0; tau += 0.5) {  // beyond the period too
    const double t = tau / kPeriodMs;
    EXPECT_NEAR(drive.velocity_at(30.0 + tau), v1 + (dv - da / 2.0) * t + da / 2.0 * t * t, 1e-9) << tau;
    EXPECT_NEAR(drive.torque_at(30.0 + tau), torques[2] + (torques[3] - torques[2]) * t, 1e-9) << tau;
  }
}

TEST(FineInterpolation, StandsUntilTheFirstUpdate) {
  FineInterpolation drive;
  drive.set_grid(kPeriodMs, 0.5);
  drive.enter(42.0);
  EXPECT_FALSE(drive.following());
  EXPECT_EQ(drive.at(1e6).position, 42.0);
  EXPECT_FALSE(drive.beyond(0, 1e6));
  EXPECT_EQ(drive.missed_now(1e6), 0U);
}

TEST(FineInterpolation, CountsWhatDoesNotCome) {
  FineInterpolation drive;
  drive.set_grid(kPeriodMs, 1.0);
  drive.enter(0.0);
  drive.update(10.0, 100.0);  // to be reached at 110 ms, when the next one is due
  EXPECT_EQ(drive.missed_now(114.9), 0U);
  EXPECT_EQ(drive.missed_now(115.1), 1U);
  EXPECT_EQ(drive.missed_now(125.1), 2U);
  EXPECT_FALSE(drive.beyond(2, 130.0));
  EXPECT_TRUE(drive.beyond(2, 130.1));
  drive.update(30.0, 130.0);
  EXPECT_EQ(drive.missed_in_all(), 2U);
  EXPECT_EQ(drive.missed_now(130.0), 0U);
}

TEST(FineInterpolation, OfTwoUpdatesInOnePeriodTheLaterCounts) {
  FineInterpolation drive;
  drive.set_grid(kPeriodMs, 1.0);
  drive.set_order(1);
  drive.enter(0.0);
  drive.update(10.0, 100.0);
  drive.update(20.0, 101.0);
  EXPECT_NEAR(drive.at(105.0).position, 10.0, 1e-12);
  EXPECT_NEAR(drive.at(110.0).position, 20.0, 1e-12);
  EXPECT_EQ(drive.missed_in_all(), 0U);
}

// A share of each deviation moves the grid, the rest is jitter.
TEST(FineInterpolation, GridFollowsSlowly) {
  FineInterpolation drive;
  drive.set_grid(kPeriodMs, 0.25);
  drive.set_order(1);
  drive.enter(0.0);
  drive.update(0.0, 100.0);
  drive.update(0.0, 110.0);
  drive.update(21.0, 122.0);  // 2 ms late: reached at 130.5, after a segment that began at 120
  EXPECT_NEAR(drive.at(125.0).position, 10.0, 1e-12);
  EXPECT_NEAR(drive.at(130.5).position, 21.0, 1e-12);
}

}  // namespace
}  // namespace interpolated_motion::emulation
