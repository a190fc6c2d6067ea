#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "interpolation/cip_interpolator.h"

// A 1 Hz sine of amplitude 1 commanded at 50 Hz, late and with losses. What is expected comes from the
// remainder of polynomial interpolation: with nodes t_i, w(t) = prod (t - t_i) and M_n = (2 pi)^n = max
// |f^(n)|,
//     |p - f|   <= M_(k+1) / (k+1)! |w(t)|,
//     |p' - f'| <= M_(k+1) / (k+1)! |w'(t)| + M_(k+2) / (k+2)! |w(t)|.
namespace interpolated_motion::interpolation {
namespace {

constexpr double kOmega = 6.283185307179586;
constexpr double kT = 0.02;
constexpr HostDuration kPeriod = std::chrono::milliseconds(20);

double sine(double t) { return std::sin(kOmega * t); }
HostTime at(double s) { return HostTime(host_duration(s)); }
SystemTime stamp(double s) { return SystemTime(host_duration(s)); }

double factorial(int n) { return n <= 1 ? 1.0 : n * factorial(n - 1); }
double derivative_bound(int n) { return std::pow(kOmega, n) / factorial(n); }

struct Remainder {
  double value;
  double rate;
};

Remainder remainder_bound(const std::vector<double>& nodes, double t) {
  const int n = static_cast<int>(nodes.size());
  double product = 1.0;
  double slope = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    product *= t - nodes[i];
    double others = 1.0;
    for (std::size_t j = 0; j < nodes.size(); ++j) others *= j == i ? 1.0 : t - nodes[j];
    slope += others;
  }
  const double value = derivative_bound(n) * std::abs(product);
  return {value, derivative_bound(n) * std::abs(slope) + derivative_bound(n + 1) * std::abs(product)};
}

CipParameters settings(int order, int missed_updates, HostDuration blend = {}) {
  CipParameters parameters;
  parameters.order = order;
  parameters.period = kPeriod;
  parameters.missed_updates = missed_updates;
  parameters.deceleration = 100.0;
  parameters.blend = blend;
  return parameters;
}

struct Recovery {
  double error = 0.0;          ///< of the extrapolated position when the late command arrives
  double position_step = 0.0;  ///< it makes
  double velocity_step = 0.0;
};

/// Worst of 360 phases of the sine, a command arriving `lateness` periods after its t0.
Recovery worst_recovery(int order, double lateness) {
  Recovery worst;
  for (int degree = 0; degree < 360; ++degree) {
    const auto f = [degree](double t) { return sine(t + degree / 360.0); };
    CipInterpolator interpolator(settings(order, 10));
    for (int n = 1; n <= 8; ++n) interpolator.push(stamp(n * kT), f(n * kT), at((n - 1) * kT));
    const double arrival = (8 + lateness) * kT;
    const double before = interpolator.sample(at(arrival)).value;
    interpolator.push(stamp(9 * kT), f(9 * kT), at(arrival));
    worst.error = std::max(worst.error, std::abs(before - f(arrival)));
    worst.position_step = std::max(worst.position_step, std::abs(interpolator.last_step().value));
    worst.velocity_step = std::max(worst.velocity_step, std::abs(interpolator.last_step().first_derivative));
  }
  return worst;
}

/// The `count` times newest, newest - T, ...
std::vector<double> grid_nodes(double newest, int count) {
  std::vector<double> nodes;
  nodes.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) nodes.push_back(newest - i * kT);
  return nodes;
}

TEST(CipStream, ExtrapolationErrorAgainstLateness) {
  std::printf("1 Hz sine of amplitude 1, T = 20 ms; peak velocity 6.28 /s\n");
  std::printf("order  late/T  extrapolation error  position step  velocity step /s\n");
  for (int order = 1; order <= 3; ++order) {
    for (const double lateness : {0.0, 0.25, 0.5, 1.0, 2.0, 3.0}) {
      const Recovery worst = worst_recovery(order, lateness);
      std::printf("%5d  %6.2f  %19.6f  %13.6f  %16.4f\n", order, lateness, worst.error, worst.position_step,
                  worst.velocity_step);
      const double now = (8 + lateness) * kT;
      const Remainder old_bound = remainder_bound(grid_nodes(8 * kT, order + 1), now);
      const Remainder new_bound = remainder_bound(grid_nodes(9 * kT, order + 1), now);
      EXPECT_LE(worst.error, old_bound.value + 1e-12);
      EXPECT_GE(worst.error, 0.75 * old_bound.value) << "the table shows the worst phase";
      EXPECT_LE(worst.position_step, old_bound.value + new_bound.value + 1e-12);
      EXPECT_LE(worst.velocity_step, old_bound.rate + new_bound.rate + 1e-12);
    }
  }
}

struct StreamResult {
  int lost = 0;
  int late = 0;  ///< applied after t0
  int longest_gap = 0;
  bool stopped = false;
  double error = 0.0;  ///< largest, of the position while not stopped
  double position_step = 0.0;
  double velocity_step = 0.0;
  double velocity_bound = 0.0;  ///< largest of the bounds that hold for the single steps
};

struct Arrival {
  double time;
  double stamp;
};

/// Sent one period ahead of their stamps, 20 % lost, the others delayed by 0..T/2.
std::vector<Arrival> lossy_arrivals(std::uint64_t seed, int count, StreamResult& result) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  std::vector<Arrival> arrivals;
  int gap = 0;
  for (int n = 1; n <= count; ++n) {
    const bool lost = n > 8 && uniform() < 0.2;
    gap = lost ? gap + 1 : 0;
    result.longest_gap = std::max(result.longest_gap, gap);
    if (lost) ++result.lost;
    if (!lost) arrivals.push_back({(n - 1 + 0.5 * uniform()) * kT, n * kT});
  }
  return arrivals;
}

/// Nodes of the polynomial in effect at `t`, of the commands received so far.
std::vector<double> nodes_in_effect(const std::vector<double>& stamps, double t, int order) {
  if (stamps.empty()) return {};
  std::size_t end = 0;
  while (end + 1 < stamps.size() && stamps[end] <= t + 1e-9) ++end;
  std::vector<double> nodes;
  for (int i = 0; i <= order && end >= static_cast<std::size_t>(i); ++i) {
    nodes.push_back(stamps[end - static_cast<std::size_t>(i)]);
  }
  return nodes;
}

class StreamRun {
 public:
  explicit StreamRun(const CipParameters& parameters)
      : order_(parameters.order),
        blended_(parameters.blend > HostDuration::zero()),
        interpolator_(parameters) {
    interpolator_.reset(0.0);
  }

  StreamResult run(std::uint64_t seed, int count) {
    const std::vector<Arrival> arrivals = lossy_arrivals(seed, count, result_);
    for (const Arrival& arrival : arrivals) {
      play_to(arrival.time);
      if (interpolator_.state(at(clock_)) == CipState::Stopping) break;
      receive(arrival);
    }
    return result_;
  }

 private:
  static constexpr double kSettled = 9 * kT;  // from here on nothing of the rest before the motion is used

  /// Samples each ms.
  void play_to(double end) {
    for (; clock_ < end; clock_ += 0.001) {
      const CipSample sample = interpolator_.sample(at(clock_));
      const CipState state = interpolator_.state(at(clock_));
      result_.stopped = result_.stopped || state == CipState::Stopping || state == CipState::Stopped;
      if (clock_ < kSettled || result_.stopped) continue;
      result_.error = std::max(result_.error, std::abs(sample.value - sine(clock_)));
    }
    clock_ = end;
  }

  void receive(const Arrival& arrival) {
    const double now = arrival.time;
    const CipSample before = interpolator_.sample(at(now));
    const std::vector<double> old_nodes = nodes_in_effect(stamps_, now, order_);
    EXPECT_NE(interpolator_.push(stamp(arrival.stamp), sine(arrival.stamp), at(now)), CipPush::Stopped);
    const CipSample after = interpolator_.sample(at(now));
    stamps_.push_back(arrival.stamp);
    if (now < kSettled || result_.stopped) return;
    ++result_.late;
    result_.position_step = std::max(result_.position_step, std::abs(after.value - before.value));
    const double step = std::abs(after.first_derivative - before.first_derivative);
    result_.velocity_step = std::max(result_.velocity_step, step);
    const double bound = remainder_bound(old_nodes, now).rate +
                         remainder_bound(nodes_in_effect(stamps_, now, order_), now).rate;
    result_.velocity_bound = std::max(result_.velocity_bound, bound);
    EXPECT_LE(step, blended_ ? 1e-9 : bound + 1e-9) << "at " << now << " s";
  }

  int order_;
  bool blended_;
  CipInterpolator interpolator_;
  double clock_ = 0.0;
  std::vector<double> stamps_;
  StreamResult result_;
};

constexpr int kOneMinute = 3000;

void print(const char* name, int order, const StreamResult& r) {
  std::printf("%-24s %5d  %4d  %3d  %7s  %8.5f  %8.5f  %8.4f  %8.4f\n", name, order, r.lost, r.longest_gap,
              r.stopped ? "yes" : "no", r.error, r.position_step, r.velocity_step, r.velocity_bound);
}

TEST(CipStream, TwentyPercentLostAndHalfAPeriodOfJitter) {
  std::printf("60 s of a 1 Hz sine at 50 Hz, 20 %% lost, 0..T/2 late (seed 2024)\n");
  std::printf("%-24s order  lost  gap  stopped  error     step      rate step  its bound\n", "");
  for (int order = 1; order <= 3; ++order) {
    const StreamResult off = StreamRun(settings(order, 0)).run(2024, kOneMinute);
    const StreamResult on = StreamRun(settings(order, 8)).run(2024, kOneMinute);
    const StreamResult blended = StreamRun(settings(order, 8, kPeriod / 2)).run(2024, kOneMinute);
    print("no extrapolation", order, off);
    print("extrapolation", order, on);
    print("extrapolation, blend T/2", order, blended);
    EXPECT_GT(on.lost, 500);
    EXPECT_GT(on.longest_gap, 2);
    EXPECT_LT(on.longest_gap, 8);
    EXPECT_TRUE(off.stopped);
    EXPECT_FALSE(on.stopped);
    EXPECT_FALSE(blended.stopped);
    EXPECT_GT(on.late, 2000) << "every command came after its t0";
    EXPECT_LE(on.velocity_step, on.velocity_bound);
    EXPECT_GT(on.velocity_step, 0.0);
    EXPECT_LT(blended.position_step, 1e-12);
    EXPECT_LT(blended.velocity_step, 1e-9);
  }
}

TEST(CipStream, NeverStopsOverManySeeds) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const StreamResult result = StreamRun(settings(2, 12)).run(seed, 500);
    EXPECT_FALSE(result.stopped) << "seed " << seed;
    EXPECT_LT(result.longest_gap, 12);
  }
}

}  // namespace
}  // namespace interpolated_motion::interpolation
