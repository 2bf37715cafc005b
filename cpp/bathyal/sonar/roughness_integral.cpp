// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/sonar/backscatter.hpp"

// exp(−p u^2α) is a mixture of Gaussians: E exp(−u² p^(1/α) S) with S positive and α-stable. Kanter
// (1975) gives it by an angle φ, even in (0, π), and an exponential W: S = (A(φ) / W)^((1−α)/α),
//   A = sin((1−α)φ) / sin φ · (sin(αφ) / sin φ)^(α/(1−α)).
// The integral of a Gaussian being exp(−1/4s) / 2s, I = E[2 x e^−x], x = 1 / (4 p^(1/α) S):
// positive, smooth, and without the cancellation of the Bessel function's waves. Where p is small,
// of p's power series (asymptotic) 15 terms say more.

namespace bathyal {
namespace {

constexpr int kAnglesOfMixture = 96;
constexpr double kSmallest = 0.005;  ///< p of the series
constexpr int kTermsOfSeries = 15;

double logarithm_of_a(double alpha, double phi) {
  const double sine = std::sin(phi);
  return std::log(std::sin((1.0 - alpha) * phi) / sine) +
         alpha / (1.0 - alpha) * std::log(std::sin(alpha * phi) / sine);
}

/// E over W: ∫ W e^−W · 2 x e^−x d ln W, ln x = rise · (ln W − ln A) + shift.
double mean_over_w(double rise, double shift, double log_a) {
  const double turn = log_a - shift / rise;  // where x = 1
  const double low = std::min(turn, 0.0) - 46.0 / (1.0 + rise);
  const double high = std::min(turn + 4.0 / rise, 0.0) + 4.0;
  const double step = 0.4 / (1.0 + rise);
  double sum = 0.0;
  for (double y = low; y <= high; y += step) {
    const double log_x = rise * (y - log_a) + shift;
    if (log_x > 6.7) break;  // e^−x is nothing
    sum += std::exp(y - std::exp(y) + log_x - std::exp(log_x));
  }
  return 2.0 * step * sum;
}

/// Σ −(−p)ⁿ / n! · 2^(2αn+1) Γ(1 + αn)² sin(παn) / π.
double series(double alpha, double p) {
  double sum = 0.0;
  double factor = -1.0;
  for (int n = 1; n <= kTermsOfSeries; ++n) {
    factor *= -p / n;
    const double order = alpha * n;
    sum += factor * std::pow(2.0, 2.0 * order + 1.0) * std::pow(std::tgamma(1.0 + order), 2) *
           std::sin(std::numbers::pi * order) / std::numbers::pi;
  }
  return sum;
}

constexpr double kFirst = -18.0, kLast = 28.0;  ///< ln p of a curve; beyond, powers of p
constexpr double kPitch = 0.25;

}  // namespace

double roughness_integral(double alpha, double p) {
  check_range("alpha", alpha, 1e-3, 0.999);
  check_positive("p", p);
  if (p < kSmallest) return series(alpha, p);
  const double rise = (1.0 - alpha) / alpha;
  const double shift = -std::log(4.0) - std::log(p) / alpha;
  double sum = 0.0;
  double weights = 0.0;
  for (int i = 1; i < kAnglesOfMixture; ++i) {  // tanh-sinh over φ, which A makes steep near π
    const double t = (i - 0.5 * kAnglesOfMixture) * (6.4 / kAnglesOfMixture);
    const double inner = 0.5 * std::numbers::pi * std::sinh(t);
    const double weight = std::cosh(t) / std::pow(std::cosh(inner), 2);
    const double phi = std::numbers::pi / (1.0 + std::exp(-2.0 * inner));
    weights += weight;
    if (phi >= std::numbers::pi || phi <= 0.0) continue;
    sum += weight * mean_over_w(rise, shift, logarithm_of_a(alpha, phi));
  }
  return sum / weights;
}

RoughnessCurve::RoughnessCurve(double alpha) : alpha_(alpha) {
  for (int row = 0; kFirst + row * kPitch <= kLast; ++row) {
    logarithm_.push_back(std::log(roughness_integral(alpha, std::exp(kFirst + row * kPitch))));
  }
}

double RoughnessCurve::at(double p) const {
  const double place = (std::log(p) - kFirst) / kPitch;
  const auto rows = static_cast<double>(logarithm_.size());
  const double low = std::fmin(std::fmax(std::floor(place), 1.0), rows - 3.0);
  const double* y = logarithm_.data() + static_cast<std::ptrdiff_t>(low);
  const double t = place - low;
  if (t < -1.0) return std::exp(y[-1] + (t + 1.0) * (y[0] - y[-1]));
  if (t > 2.0) return std::exp(y[2] + (t - 2.0) * (y[2] - y[1]));
  // Lagrange's cubic through the four rows about it.
  return std::exp(-y[-1] * t * (t - 1.0) * (t - 2.0) / 6.0 +
                  y[0] * (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0 -
                  y[1] * (t + 1.0) * t * (t - 2.0) / 2.0 + y[2] * (t + 1.0) * t * (t - 1.0) / 6.0);
}

}  // namespace bathyal
