// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "bathyal/world/material.hpp"

namespace bathyal {

/// σ₀ of a surface at an angle of incidence θ: power per unit area and solid angle at 1 m
/// (dimensionless). By the material's table where it has one, else by its sediment, else Lambert's
/// strength · cos²θ. \param cosine of θ, 0 to 1 \param frequency [Hz]
/// \throw std::invalid_argument for a cosine or frequency outside, and as Material::check.
double backscatter(const Material& material, double cosine, double frequency);

/// σ₀ of a rough, penetrable bottom, the sum of
///  - roughness by the small-slope approximation (Jackson, Richardson 2007, High-Frequency Seafloor
///    Acoustics, ch. 13; a fluid bottom), for relief whose spectrum is w₂ K^−γ:
///      σ_r = ¼ k⁴ |(1 + Γ)² G|² · 2 I(α, p) / (π q² q₃²),
///      I = ∫ J₀(u) exp(−p u^2α) u du, p = ½ C_h² q₃² q^−2α, α = γ/2 − 1, q = 2 k sin θ,
///      q₃ = 2 k cos θ. It is Kirchhoff's near θ = 0 and first-order perturbation far from it, so
///      that neither needs to be joined to the other;
///  - volume, of APL-UW TR 9407 (1994): 5 δ σ₂ |1 − Γ²|² cos²θ / (ν ln 10 |P|² Im P),
/// with k of water of 1500 m/s, Γ the reflection coefficient, P = √(κ² − sin²θ), κ = (1 + iδ) / ν.
double sediment_backscatter(const Sediment& sediment, double cosine, double frequency);

/// The same with the integral I(α, p) by another function: a RoughnessCurve is quick.
double sediment_backscatter(const Sediment& sediment, double cosine, double frequency,
                            const std::function<double(double, double)>& integral);

/// Γ of a plane wave at the bottom as a lossy fluid; ±1 at grazing incidence.
std::complex<double> reflection(const Sediment& sediment, double cosine);

/// |Γ|² of a material: of its sediment, else that of sand.
double reflected_power(const Material& material, double cosine);

/// σ₀ of the sea surface from below by its facets (APL-UW TR 9407): sec⁴θ / (4π s²) e^(−tan²θ/s²),
/// s² = 0.0046 ln(2.1 U²) the mean square slope, at least that of 1 m/s. Bubbles are left out.
/// \param wind speed U at 10 m [m/s]
double surface_backscatter(double cosine, double wind);

/// What lies outside of the range for which a model of sediments was measured (10 to 100 kHz), by
/// name: "extrapolated: …"; empty inside.
std::string extrapolated(double frequency);

/// ∫₀^∞ J₀(u) exp(−p u^2α) u du, 0 < α < 1, p > 0, within 10⁻⁶ of its value.
double roughness_integral(double alpha, double p);

/// roughness_integral of one α by a table over ln p, cubic between, within 10⁻³ of its value.
class RoughnessCurve {
 public:
  explicit RoughnessCurve(double alpha);

  double alpha() const { return alpha_; }
  double at(double p) const;

 private:
  double alpha_;
  std::vector<double> logarithm_;
};

}  // namespace bathyal
