// SPDX-License-Identifier: BSD-3-Clause
// Patterns of shaded arrays against textbooks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "bathyal/sonar/echo.hpp"
#include "bathyal/sonar/internal/beam_pattern.hpp"
#include "bathyal/sonar/internal/pattern_mean.hpp"
#include "bathyal/sonar/presets.hpp"
#include "worlds.hpp"

namespace bathyal {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
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

TEST(BeamPatterns, MeansOverCellsAreThoseOfFineSums) {
  for (const BeamPattern kind : {BeamPattern::kNone, BeamPattern::kUniform, BeamPattern::kHann,
                                 BeamPattern::kTaylor, BeamPattern::kGaussian}) {
    for (const bool squared : {false, true}) {
      for (const double half : {0.0, 1e-4, 0.01, 0.4, 5.2}) {
        for (const double off : {0.0, -0.7, 2.3, 31.0}) {
          constexpr int kPlaces = 4000;
          double mean = 0.0;
          for (int k = 0; k < kPlaces; ++k) {
            const double place = off + half * ((2.0 * k + 1.0) / kPlaces - 1.0);
            mean += std::pow(sonar::pattern_shape(kind, place), squared ? 2 : 1) / kPlaces;
          }
          if (std::abs(off) + half > 32.0) continue;  // past the table: the pattern itself
          EXPECT_NEAR(sonar::pattern_mean(kind, squared)(off, half), mean, 2e-5);
        }
      }
    }
  }
}

/// A ball round the sonar, of a law that gives σ₀ = cos²θ = 1 everywhere: without spreading each
/// beam hears R² ∫ b² dΩ. Of a uniform array at half power `width`, one way, ∫ sinc² of the sine
/// over all of it is λ/L = width / 0.8859, of which the rays' reach, x = 7.234, has 2/π (Si(2x) −
/// sin²x/x) = 0.953.
TEST(BeamPatterns, ABeamOfOneRayHasTheEnergyOfItsPattern) {
  const TriangleMesh ball = test::ball(Vec3::Zero(), 20.0);
  TriangleMatrix inward = ball.triangles();
  inward.col(1).swap(inward.col(2));
  const WorldSnapshot world =
      test::world_of({TriangleMesh(PointMatrix(ball.vertices()), std::move(inward))}, {1.0});
  const auto heard = [&](int rays, bool moving) {
    SonarOptions options = imaging_sonar();
    options.beams = 5;
    options.sector = radians(4.0);
    options.beam_width = radians(1.0);
    options.fan_width = radians(180.0);
    options.fan_span = radians(2.0);
    options.beam_pattern = BeamPattern::kUniform;
    options.rays_across_beam = rays;
    options.motion = moving;
    const VehicleMotion creeping{Vec3(1e-9, 0, 0), Vec3(0, 0, 1e-12)};
    const Echo echo = Sonar(options).echo(world, Water(), test::at(0, 0, 0), 0, 0, creeping);
    return test::sum(echo.power, 2 * 512, 512);
  };
  const double fine = heard(400, false);
  const double expected = 400.0 * radians(2.0) * radians(1.0) / 0.8859 * 0.953;
  EXPECT_NEAR(fine / expected, 1.0, 0.002);
  for (const int rays : {1, 2, 5, 12}) {
    EXPECT_NEAR(heard(rays, false) / fine, 1.0, 0.001) << rays;
    EXPECT_NEAR(heard(rays, true) / heard(rays, false), 1.0, 1e-4) << rays;
  }
}

}  // namespace
}  // namespace bathyal
