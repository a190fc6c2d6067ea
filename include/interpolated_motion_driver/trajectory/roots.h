#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace interpolated_motion::trajectory {

/// Coefficients of a polynomial, ascending: sum of c[i] x^i.
template <std::size_t Degree>
using Coefficients = std::array<double, Degree + 1>;

/// Up to `Degree` roots in ascending order.
template <std::size_t Degree>
struct Roots {
  std::array<double, Degree> values{};  ///< only the first `count` are meant
  std::size_t count = 0;                ///< 0..Degree

  /// Appends `x`, not below those before; dropped when there are `Degree` already.
  void add(double x) {
    if (count < Degree) values[count++] = x;
  }
  /// For a loop over the roots found.
  const double* begin() const { return values.data(); }
  const double* end() const { return values.data() + count; }
};

/// Value at `x`, by Horner's scheme.
template <std::size_t Degree>
double evaluate(const Coefficients<Degree>& c, double x) {
  double sum = c[Degree];
  for (std::size_t i = Degree; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

/// Coefficients of the derivative with respect to x.
template <std::size_t Degree>
Coefficients<Degree - 1> derivative(const Coefficients<Degree>& c) {
  Coefficients<Degree - 1> result{};
  for (std::size_t i = 0; i < Degree; ++i) result[i] = static_cast<double>(i + 1) * c[i + 1];
  return result;
}

/// The root of a polynomial in [low, high], where it is monotone and changes sign: Newton's steps, and a
/// bisection wherever one would leave the bracket or does not halve it, down to neighbouring doubles.
template <std::size_t Degree>
double bracketed_root(const Coefficients<Degree>& c, const Coefficients<Degree - 1>& slope, double low,
                      double high) {
  constexpr int kBisectionsOfADouble = 64;
  const bool rising = evaluate<Degree>(c, high) > 0.0;
  double x = 0.5 * (low + high);
  for (int i = 0; i < 2 * kBisectionsOfADouble && low < x && x < high; ++i) {
    const double value = evaluate<Degree>(c, x);
    if (value == 0.0) return x;
    const double width = high - low;
    ((value > 0.0) == rising ? high : low) = x;
    const double newton = x - value / evaluate<Degree - 1>(slope, x);
    if (std::abs(newton - x) <= std::numeric_limits<double>::epsilon()) return newton;
    const bool converging = newton > low && newton < high && std::abs(newton - x) < 0.25 * width;
    x = converging ? newton : 0.5 * (low + high);
  }
  return x;
}

/// Where a polynomial changes sign within [0, 1], in ascending order. Roots of the derivative cut the
/// interval into monotone parts with one root at most each. A root that only touches zero may be left out:
/// the polynomial changes no sign there.
template <std::size_t Degree>
Roots<Degree> sign_changes(const Coefficients<Degree>& c) {
  const auto slope = derivative<Degree>(c);
  const auto turns = sign_changes<Degree - 1>(slope);
  Roots<Degree> roots;
  double low = 0.0;
  double value_low = evaluate<Degree>(c, low);
  const auto visit = [&](double high) {
    const double value_high = evaluate<Degree>(c, high);
    if (value_low == 0.0) {
      roots.add(low);
    } else if (value_high != 0.0 && (value_low < 0.0) != (value_high < 0.0)) {
      roots.add(bracketed_root<Degree>(c, slope, low, high));
    }
    low = high;
    value_low = value_high;
  };
  for (const double turn : turns) visit(turn);
  visit(1.0);
  if (value_low == 0.0) roots.add(1.0);
  return roots;
}

/// Roots of c[0] + c[1] x within [0, 1].
template <>
inline Roots<1> sign_changes<1>(const Coefficients<1>& c) {
  Roots<1> roots;
  const double x = -c[0] / c[1];
  if (x >= 0.0 && x <= 1.0) roots.add(x);
  return roots;
}

/// Roots of a quadratic within [0, 1], without the cancellation of the school formula; a vanishing leading
/// coefficient gives an infinity or a NaN, which is in no interval.
template <>
inline Roots<2> sign_changes<2>(const Coefficients<2>& c) {
  Roots<2> roots;
  const double discriminant = c[1] * c[1] - 4.0 * c[2] * c[0];
  if (!(discriminant >= 0.0)) return roots;
  const double q = -0.5 * (c[1] + std::copysign(std::sqrt(discriminant), c[1]));
  const double one = q / c[2];
  const double other = c[0] / q;
  const double first = one > other ? other : one;
  const double second = one > other ? one : other;
  if (first >= 0.0 && first <= 1.0) roots.add(first);
  if (second >= 0.0 && second <= 1.0 && !(second == first)) roots.add(second);
  return roots;
}

}  // namespace interpolated_motion::trajectory
