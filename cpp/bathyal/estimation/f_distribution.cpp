// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/f_distribution.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal {
namespace {

/// The fraction of I_x(a, b), which converges fast where x < (a + 1) / (a + b + 2); evaluated as
/// Lentz does, from the front.
double beta_fraction(double x, double a, double b) {
  constexpr double kTiny = 1e-300;
  constexpr int kMostTerms = 10000;
  const auto not_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1.0;
  double d = 1.0 / not_zero(1.0 - (a + b) * x / (a + 1.0));
  double value = d;
  for (int m = 1; m <= kMostTerms; ++m) {
    const double even_term = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m));
    d = 1.0 / not_zero(1.0 + even_term * d);
    c = not_zero(1.0 + even_term / c);
    value *= d * c;
    const double odd_term = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0));
    d = 1.0 / not_zero(1.0 + odd_term * d);
    c = not_zero(1.0 + odd_term / c);
    value *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) break;
  }
  return value;
}

/// I_x(a, b); `rest` is 1 - x, a separate argument so that neither end loses digits.
double incomplete_beta(double x, double rest, double a, double b) {
  if (x <= 0.0) return 0.0;
  if (rest <= 0.0) return 1.0;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log(rest));
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(x, a, b) / a;
  return 1.0 - front * beta_fraction(rest, b, a) / b;
}

}  // namespace

double f_tail(double f, double above, double below) {
  if (!(f > 0.0)) return 1.0;
  const double whole = below + above * f;
  return incomplete_beta(below / whole, above * f / whole, below / 2.0, above / 2.0);
}

FTest f_test(double explained, double width, double total, double dof) {
  const double noise = (total - explained) / (dof - width);
  FTest out;
  if (!(noise > 0.0)) return out;
  out.p = f_tail(explained / width / noise, width, dof - width);
  out.explained = std::max(explained - width * noise, 0.0);
  out.share = out.explained / total;
  return out;
}

}  // namespace bathyal
