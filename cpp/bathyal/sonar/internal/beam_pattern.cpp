// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/beam_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace bathyal::sonar {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWidths = 2.6;  ///< past the second side lobe of sinc²

double sinc(double u) {
  const double x = kPi * u;
  return std::abs(x) < 1e-8 ? 1.0 : std::sin(x) / x;
}

/// A line array of the length L under the shading 1 + 2 Σ F_m cos(2π m x / L): its amplitude at
/// u = L sin φ / λ is sinc(u) + Σ F_m (sinc(u − m) + sinc(u + m)).
class LineArray {
 public:
  explicit LineArray(std::vector<double> shading) : shading_(std::move(shading)) {
    double low = 0.0, high = 1.0;  // of every shading here the first null lies beyond 0.9
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (power(middle) > 0.5 ? low : high) = middle;
    }
    half_power_ = low;
  }

  /// Power `off` half-power places off the axis.
  double at(double off) const { return power(half_power_ * off); }

 private:
  double power(double u) const {
    double amplitude = sinc(u);
    for (std::size_t i = 0; i < shading_.size(); ++i) {
      const auto m = static_cast<double>(i + 1);
      amplitude += shading_[i] * (sinc(u - m) + sinc(u + m));
    }
    return amplitude * amplitude;
  }

  std::vector<double> shading_;
  double half_power_ = 0.0;
};

/// F_m of Taylor's shading with `even` side lobes of one level (Taylor 1955).
std::vector<double> taylor_shading(double level_decibels, int even) {
  const double a = std::acosh(std::pow(10.0, level_decibels / 20.0)) / kPi;
  const double widened = even * even / (a * a + (even - 0.5) * (even - 0.5));
  std::vector<double> shading;
  for (int m = 1; m < even; ++m) {
    double above = m % 2 == 1 ? 0.5 : -0.5, below = 1.0;
    for (int n = 1; n < even; ++n) {
      above *= 1.0 - m * m / (widened * (a * a + (n - 0.5) * (n - 0.5)));
      if (n != m) below *= 1.0 - static_cast<double>(m * m) / (n * n);
    }
    shading.push_back(above / below);
  }
  return shading;
}

const LineArray& array_of(BeamPattern kind) {
  static const LineArray uniform({}), hann({0.5}), taylor(taylor_shading(30.0, 4));
  if (kind == BeamPattern::kHann) return hann;
  return kind == BeamPattern::kTaylor ? taylor : uniform;
}

}  // namespace

double pattern_shape(BeamPattern kind, double off) {
  if (kind == BeamPattern::kNone) return 1.0;
  if (kind == BeamPattern::kGaussian) return std::exp(-std::numbers::ln2 * off * off);
  return array_of(kind).at(off);
}

double pattern(BeamPattern kind, double angle, double width, double steered) {
  return pattern_shape(kind,
                       (std::sin(angle + steered) - std::sin(steered)) / std::sin(0.5 * width));
}

double reach_of(BeamPattern kind, double width) {
  if (kind == BeamPattern::kNone) return 0.5 * width;
  return std::min(kWidths * width, 0.5 * kPi);
}

}  // namespace bathyal::sonar
