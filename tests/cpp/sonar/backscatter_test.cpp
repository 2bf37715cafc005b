// SPDX-License-Identifier: BSD-3-Clause
// Backscatter by sediments against the limits in which it is known.
#include "bathyal/sonar/backscatter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "bathyal/world/materials.hpp"

namespace bathyal {
namespace {

constexpr double kPi = std::numbers::pi;

double radians(double degrees) { return degrees * kPi / 180.0; }

const Material& named(const std::string& name) {
  for (const Material& material : material_library()) {
    if (material.name == name) return material;
  }
  throw std::logic_error("no material " + name);
}

TEST(Backscatter, TheRoughnessIntegralHasItsClosedForms) {
  for (const double p : {1e-4, 4e-3, 6e-3, 0.1, 1.0, 30.0, 1e4}) {
    EXPECT_NEAR(roughness_integral(0.5, p) / (p / std::pow(1.0 + p * p, 1.5)), 1.0, 1e-6) << p;
  }
  for (const double p : {0.1, 1.0, 10.0}) {  // α → 1
    const double exact = std::exp(-0.25 / p) / (2.0 * p);
    EXPECT_NEAR(roughness_integral(0.9985, p) / exact, 1.0, 0.02) << p;
  }
}

TEST(Backscatter, TheRoughnessIntegralIsThatOfTheBesselFunction) {
  for (const double alpha : {0.3, 0.625, 0.9}) {
    const double p = 2.0;
    const double end = std::pow(40.0 / p, 0.5 / alpha);
    const int steps = 40000;  // Simpson's rule; u = end · v³ for the cusp of u^2α at 0
    double sum = 0.0;
    for (int i = 0; i <= steps; ++i) {
      const double v = static_cast<double>(i) / steps;
      const double u = end * v * v * v;
      const double f = std::cyl_bessel_j(0.0, u) * std::exp(-p * std::pow(u, 2.0 * alpha)) * u *
                       3.0 * end * v * v;
      sum += f * (i == 0 || i == steps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0));
    }
    EXPECT_NEAR(roughness_integral(alpha, p) / (sum / steps / 3.0), 1.0, 1e-6) << alpha;
  }
}

/// Its series and its integral meet.
TEST(Backscatter, TheRoughnessIntegralIsSmooth) {
  for (const double alpha : {0.2, 0.4, 0.625, 0.8, 0.95}) {
    const double below = roughness_integral(alpha, 0.005 * (1 - 1e-9));
    const double above = roughness_integral(alpha, 0.005 * (1 + 1e-9));
    EXPECT_NEAR(above / below, 1.0, 1e-6) << alpha;
  }
}

TEST(Backscatter, ACurveIsTheIntegral) {
  for (const double alpha : {0.2, 0.5, 0.625, 0.95}) {
    const RoughnessCurve curve(alpha);
    for (double p = 3e-10; p < 1e14; p *= 3.7) {  // beyond its ends as well
      EXPECT_NEAR(curve.at(p) / roughness_integral(alpha, p), 1.0, 1e-3) << alpha << " " << p;
    }
  }
}

/// First-order perturbation as APL-UW TR 9407 writes it: 4 k⁴ sin⁴ |Y|² W(2 k cos), by the grazing
/// angle.
double perturbation(const Sediment& s, double incidence, double frequency) {
  const double k = 2.0 * kPi * frequency / 1500.0;
  const double sine = std::cos(incidence), cosine = std::sin(incidence);
  const std::complex<double> kappa = std::complex<double>(1.0, s.loss) / s.speed_ratio;
  const std::complex<double> p = std::sqrt(kappa * kappa - cosine * cosine);
  const double r = s.density_ratio;
  const std::complex<double> y = ((r - 1.0) * (r - 1.0) * cosine * cosine + r * r - kappa * kappa) /
                                 ((r * sine + p) * (r * sine + p));
  const double in_cm = 2.0 * k * cosine / 100.0;
  const double spectrum = s.spectral_strength * std::pow(in_cm, -s.spectral_exponent) * 1e-8;
  return 4.0 * std::pow(k * sine, 4) * std::norm(y) * spectrum;
}

TEST(Backscatter, FarFromNadirASmoothBottomIsThatOfFirstOrderPerturbation) {
  Sediment sediment = *named("sand").sediment;
  sediment.volume = 0.0;
  sediment.spectral_strength *= 1e-4;
  for (const double degrees : {30.0, 60.0, 80.0}) {
    const double sigma = sediment_backscatter(sediment, std::cos(radians(degrees)), 30e3);
    EXPECT_NEAR(sigma / perturbation(sediment, radians(degrees), 30e3), 1.0, 1e-3) << degrees;
  }
}

TEST(Backscatter, AtNadirItIsKirchhoffs) {
  Sediment sediment = *named("sand").sediment;
  sediment.volume = 0.0;
  const double k = 2.0 * kPi * 30e3 / 1500.0;
  const double alpha = 0.625;
  const double w2 = sediment.spectral_strength * 1e-8 * std::pow(100.0, 3.25);
  const double ch2 = 2.0 * kPi * w2 * std::tgamma(2.0 - alpha) * std::pow(2.0, -2.0 * alpha) /
                     (alpha * (1.0 - alpha) * std::tgamma(1.0 + alpha));
  const double q = ch2 * std::pow(2.0, 1.0 - 2.0 * alpha) * std::pow(k, 2.0 * (1.0 - alpha));
  // |Γ|² / (8π) · Γ(1/α) / (2α) · q^(−1/α)
  const double exact = std::norm(reflection(sediment, 1.0)) / (8.0 * kPi) *
                       std::tgamma(1.0 / alpha) / (2.0 * alpha) * std::pow(q, -1.0 / alpha);
  EXPECT_NEAR(sediment_backscatter(sediment, 1.0, 30e3) / exact, 1.0, 1e-4);
}

TEST(Backscatter, ReflectionHasFresnelsLimits) {
  const Sediment sand = *named("sand").sediment;
  Sediment lossless = sand;
  lossless.loss = 0.0;
  const double impedance = lossless.density_ratio * lossless.speed_ratio;
  EXPECT_NEAR(reflection(lossless, 1.0).real(), (impedance - 1.0) / (impedance + 1.0), 1e-12);
  // Beyond the critical angle, sin θ > 1 / ν, everything is reflected.
  EXPECT_NEAR(std::norm(reflection(lossless, std::cos(radians(75.0)))), 1.0, 1e-12);
  EXPECT_LT(std::norm(reflection(sand, std::cos(radians(75.0)))), 1.0);
  EXPECT_NEAR(std::norm(reflection(sand, 0.0)), 1.0, 1e-12);
  Sediment water{1.0, 1.0, 0.0, 0.0, 3.25, 0.0};
  EXPECT_NEAR(std::abs(reflection(water, 0.5)), 0.0, 1e-12);
}

TEST(Backscatter, SedimentsLieWhereTheyWereMeasured) {
  // At 30 kHz and 30° grazing, sand −25 to −15 dB, mud −40 to −25 dB (TR 9407, its figures).
  const auto level = [](const char* name, double grazing) {
    return 10.0 * std::log10(backscatter(named(name), std::sin(radians(grazing)), 30e3));
  };
  EXPECT_GT(level("sand", 30.0), -30.0);
  EXPECT_LT(level("sand", 30.0), -15.0);
  EXPECT_GT(level("mud", 30.0), -42.0);
  EXPECT_LT(level("mud", 30.0), -25.0);
  for (const double grazing : {30.0, 50.0}) {
    EXPECT_GT(level("gravel", grazing), level("sand", grazing));
    EXPECT_GT(level("sand", grazing), level("mud", grazing));
  }
}

TEST(Backscatter, ATableIsReadLinearlyInDecibels) {
  Material material;
  material.name = "measured";
  material.angle = {0.2, 0.6, 1.2};
  material.backscatter = {-10.0, -20.0, -40.0};
  const auto level = [&](double angle) {
    return 10.0 * std::log10(backscatter(material, std::cos(angle), 600e3));
  };
  EXPECT_NEAR(level(0.1), -10.0, 1e-9);
  EXPECT_NEAR(level(0.4), -15.0, 1e-9);
  EXPECT_NEAR(level(0.9), -30.0, 1e-9);
  EXPECT_NEAR(level(1.4), -40.0, 1e-9);
}

TEST(Backscatter, WithoutALawItIsLamberts) {
  Material material;
  material.name = "plain";
  material.strength = 0.3;
  EXPECT_DOUBLE_EQ(backscatter(material, 0.5, 600e3), 0.3 * 0.25);
}

TEST(Backscatter, OfTheSurfaceIsThatOfItsFacets) {
  const double slope = 4.6e-3 * std::log(2.1 * 25.0);
  EXPECT_NEAR(surface_backscatter(1.0, 5.0), 1.0 / (4.0 * kPi * slope), 1e-12);
  EXPECT_LT(surface_backscatter(std::cos(radians(60.0)), 5.0), 1e-9);
  EXPECT_EQ(surface_backscatter(1.0, 0.0), surface_backscatter(1.0, 1.0));
}

TEST(Backscatter, SaysWhereItIsExtrapolated) {
  EXPECT_EQ(extrapolated(30e3), "");
  EXPECT_NE(extrapolated(600e3).find("600 kHz"), std::string::npos);
}

TEST(Backscatter, RefusesNonsense) {
  EXPECT_THROW(backscatter(named("sand"), 1.5, 30e3), std::invalid_argument);
  EXPECT_THROW(backscatter(named("sand"), std::nan(""), 30e3), std::invalid_argument);
  EXPECT_THROW(backscatter(named("sand"), 0.5, 0.0), std::invalid_argument);
  EXPECT_EQ(backscatter(named("sand"), 0.0, 30e3), 0.0);
}

}  // namespace
}  // namespace bathyal
