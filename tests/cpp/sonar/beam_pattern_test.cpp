// SPDX-License-Identifier: BSD-3-Clause
// Patterns of shaded arrays against textbooks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "bathyal/sonar/internal/beam_pattern.hpp"

namespace bathyal {
namespace {

double decibels(double power) { return 10.0 * std::log10(power); }

/// First null and first side lobe, in half-power places off the axis and in decibels.
std::pair<double, double> first_side_lobe(BeamPattern kind) {
  constexpr double kStep = 1e-4;
  double off = kStep;
  while (sonar::pattern_shape(kind, off + kStep) < sonar::pattern_shape(kind, off)) off += kStep;
  const double null = off;
  while (sonar::pattern_shape(kind, off + kStep) > sonar::pattern_shape(kind, off)) off += kStep;
  return {null, decibels(sonar::pattern_shape(kind, off))};
}

/// Widths at half power in λ/L: 0.886, 1.44, and of Taylor's 30 dB with n̄ = 4 1.12; first nulls
/// at 1, 2 and σ √(A² + ¼) (Harris 1978; Van Trees 2002, ch. 3; Taylor 1955).
TEST(BeamPatterns, PatternsHaveTheSideLobesOfTextbooks) {
  const auto [uniform_null, uniform] = first_side_lobe(BeamPattern::kUniform);
  EXPECT_NEAR(uniform, -13.26, 0.01);
  EXPECT_NEAR(uniform_null, 1.0 / (0.5 * 0.88589), 1e-3);
  const auto [hann_null, hann] = first_side_lobe(BeamPattern::kHann);
  EXPECT_NEAR(hann, -31.47, 0.01);
  EXPECT_NEAR(hann_null, 2.0 / (0.5 * 1.4406), 2e-3);
  const auto [taylor_null, taylor] = first_side_lobe(BeamPattern::kTaylor);
  EXPECT_NEAR(taylor, -30.0, 0.4);
  const double a = std::acosh(std::pow(10.0, 1.5)) / std::numbers::pi;
  const double sigma = 4.0 / std::sqrt(a * a + 3.5 * 3.5);
  const double half = sigma *
                      std::sqrt(std::pow(std::acosh(std::pow(10.0, 1.5)), 2) -
                                std::pow(std::acosh(std::pow(10.0, 1.5) / std::sqrt(2.0)), 2)) /
                      std::numbers::pi;
  EXPECT_NEAR(taylor_null, sigma * std::sqrt(a * a + 0.25) / half, 0.01 * taylor_null);
  for (const BeamPattern kind :
       {BeamPattern::kUniform, BeamPattern::kHann, BeamPattern::kTaylor, BeamPattern::kGaussian}) {
    EXPECT_NEAR(sonar::pattern_shape(kind, 1.0), 0.5, 1e-9);
    EXPECT_NEAR(sonar::pattern(kind, 0.005, 0.01), 0.5, 1e-9);
  }
}

}  // namespace
}  // namespace bathyal
