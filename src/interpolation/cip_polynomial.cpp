#include "interpolated_motion_driver/interpolation/cip_polynomial.h"

namespace interpolated_motion::interpolation {

CipPolynomial cip_position_polynomial(int order, double period, const CipValues& p) {
  const double dp = p[0] - p[1];
  const double dv = order >= 2 ? p[0] - 2 * p[1] + p[2] : 0.0;
  const double da = order >= 3 ? p[0] - 3 * p[1] + 3 * p[2] - p[3] : 0.0;
  return {{p[1], (dp - dv / 2 - da / 6) / period, dv / (2 * period * period),
           da / (6 * period * period * period)}};
}

CipPolynomial cip_velocity_polynomial(int order, double period, const CipValues& v) {
  const double dv = v[0] - v[1];
  const double da = order >= 2 ? v[0] - 2 * v[1] + v[2] : 0.0;
  return {{v[1], (dv - da / 2) / period, da / (2 * period * period), 0.0}};
}

CipPolynomial cip_acceleration_polynomial(double period, const CipValues& a) {
  return {{a[1], (a[0] - a[1]) / period, 0.0, 0.0}};
}

CipPolynomial cip_polynomial_through(int order, const CipKnots& knots) {
  // Newton's form on the nodes 0, T, -h, ... that is t0, t1, t-1, t-2:
  //   p = f0 + f01 tau + f012 tau (tau - T) + f0123 tau (tau - T) (tau + h).
  const double t = knots[0].time - knots[1].time;
  const double rise = (knots[0].value - knots[1].value) / t;
  if (order == 1) return {{knots[1].value, rise, 0.0, 0.0}};

  const double h = knots[1].time - knots[2].time;
  const double rise_before = (knots[1].value - knots[2].value) / h;
  const double second = (rise - rise_before) / (t + h);
  if (order == 2) return {{knots[1].value, rise - second * t, second, 0.0}};

  const double g = knots[2].time - knots[3].time;
  const double rise_first = (knots[2].value - knots[3].value) / g;
  const double second_before = (rise_before - rise_first) / (h + g);
  const double third = (second - second_before) / (t + h + g);
  return {{knots[1].value, rise - second * t - third * t * h, second + third * (h - t), third}};
}

}  // namespace interpolated_motion::interpolation
