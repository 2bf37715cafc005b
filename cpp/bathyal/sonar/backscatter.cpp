// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/backscatter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

using Complex = std::complex<double>;

constexpr double kWaterSpeed = 1500.0;              ///< [m/s], for the wave number
constexpr double kLeastSlant = 1e-3;                ///< of q / k, which is 0 at θ = 0
constexpr double kLowest = 10e3, kHighest = 100e3;  ///< [Hz]

/// κ of the bottom's complex wave number over that of water.
Complex wave_number_ratio(const Sediment& sediment) {
  return Complex(1.0, sediment.loss) / sediment.speed_ratio;
}

/// P, proportional to the sine of the grazing angle in the bottom; `along` = sin θ of incidence.
Complex vertical(const Sediment& sediment, double along) {
  const Complex kappa = wave_number_ratio(sediment);
  return std::sqrt(kappa * kappa - along * along);
}

double roughness(const Sediment& sediment, double cosine, double along, double wave_number,
                 const std::function<double(double, double)>& integral) {
  const double rho = sediment.density_ratio;
  const Complex kappa = wave_number_ratio(sediment);
  const Complex p_b = vertical(sediment, along);
  const Complex through = 1.0 + reflection(sediment, cosine);
  const Complex shape =
      (1.0 / rho - 1.0) * (-along * along - p_b * p_b / rho) + 1.0 - kappa * kappa / rho;  // G
  const double amplitude = std::norm(through * through * shape);

  const double alpha = 0.5 * sediment.spectral_exponent - 1.0;
  const double strength =  // of W = w₂ K^−γ in metres
      sediment.spectral_strength * 1e-8 * std::pow(100.0, sediment.spectral_exponent);
  const double structure = 2.0 * std::numbers::pi * strength * std::tgamma(2.0 - alpha) *
                           std::pow(2.0, -2.0 * alpha) /
                           (alpha * (1.0 - alpha) * std::tgamma(1.0 + alpha));  // C_h²
  const double q = 2.0 * wave_number * std::hypot(along, 0.5 * kLeastSlant);
  const double q3 = 2.0 * wave_number * cosine;
  if (!(structure * q3 > 0.0)) return 0.0;
  const double p = 0.5 * structure * q3 * q3 * std::pow(q, -2.0 * alpha);
  const double k2 = wave_number * wave_number;
  return 0.25 * k2 * k2 * amplitude / (2.0 * std::numbers::pi * q * q * q3 * q3) *
         integral(alpha, p);
}

double volume(const Sediment& sediment, double cosine, double along) {
  if (!(sediment.loss > 0.0) || !(sediment.volume > 0.0)) return 0.0;
  const Complex gamma = reflection(sediment, cosine);
  const Complex p_b = vertical(sediment, along);
  return 5.0 * sediment.loss * sediment.volume * std::norm(1.0 - gamma * gamma) * cosine * cosine /
         (sediment.speed_ratio * std::numbers::ln10 * std::norm(p_b) * p_b.imag());
}

/// Linear in dB between the table's angles, at its ends as the nearest.
double of_table(const Material& material, double cosine) {
  const double angle = std::acos(std::min(cosine, 1.0));
  const auto after = std::upper_bound(material.angle.begin(), material.angle.end(), angle);
  const auto row = static_cast<std::size_t>(after - material.angle.begin());
  const std::vector<double>& level = material.backscatter;
  if (row == 0) return std::pow(10.0, 0.1 * level.front());
  if (row == level.size()) return std::pow(10.0, 0.1 * level.back());
  const double part =
      (angle - material.angle[row - 1]) / (material.angle[row] - material.angle[row - 1]);
  return std::pow(10.0, 0.1 * (level[row - 1] + part * (level[row] - level[row - 1])));
}

}  // namespace

double backscatter(const Material& material, double cosine, double frequency) {
  material.check();
  check_range("cosine", cosine, 0.0, 1.0);
  check_positive("frequency", frequency);
  if (!material.angle.empty()) return of_table(material, cosine);
  if (material.sediment) return sediment_backscatter(*material.sediment, cosine, frequency);
  return material.strength * cosine * cosine;
}

double sediment_backscatter(const Sediment& sediment, double cosine, double frequency) {
  return sediment_backscatter(sediment, cosine, frequency, roughness_integral);
}

double sediment_backscatter(const Sediment& sediment, double cosine, double frequency,
                            const std::function<double(double, double)>& integral) {
  if (!(cosine > 0.0)) return 0.0;
  const double along = std::sqrt((1.0 - cosine) * (1.0 + cosine));
  const double wave_number = 2.0 * std::numbers::pi * frequency / kWaterSpeed;
  return roughness(sediment, cosine, along, wave_number, integral) +
         volume(sediment, cosine, along);
}

Complex reflection(const Sediment& sediment, double cosine) {
  const double along = std::sqrt(std::max((1.0 - cosine) * (1.0 + cosine), 0.0));
  const Complex in_bottom = vertical(sediment, along);
  const double in_water = sediment.density_ratio * cosine;
  const Complex sum = in_water + in_bottom;
  return std::norm(sum) > 0.0 ? (in_water - in_bottom) / sum : Complex(-1.0);
}

double reflected_power(const Material& material, double cosine) {
  return std::norm(reflection(material.sediment.value_or(Sediment{}), cosine));
}

double surface_backscatter(double cosine, double wind) {
  if (!(cosine > 0.0)) return 0.0;
  const double slope = 4.6e-3 * std::log(2.1 * std::pow(std::max(wind, 1.0), 2));
  const double square = cosine * cosine;
  const double tangent = (1.0 - square) / square;
  return std::exp(-tangent / slope) / (4.0 * std::numbers::pi * slope * square * square);
}

std::string extrapolated(double frequency) {
  if (frequency >= kLowest && frequency <= kHighest) return {};
  return "extrapolated: backscatter by sediments is known from 10 to 100 kHz, not at " +
         to_text(frequency / 1e3) + " kHz";
}

}  // namespace bathyal
