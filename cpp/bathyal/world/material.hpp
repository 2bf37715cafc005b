// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bathyal {

/// What a model of scattering at a rough, penetrable bottom takes (Jackson, Winebrenner, Ishimaru
/// 1986; APL-UW TR 9407, 1994): ratios to the water above it.
struct Sediment {
  double density_ratio = 1.845;         ///< ρ of the bottom over ρ of the water
  double speed_ratio = 1.1782;          ///< c of the bottom over c of the water
  double loss = 0.01624;                ///< imaginary over real wave number
  double volume = 0.002;                ///< σ₂: scattering in the volume over its absorption
  double spectral_exponent = 3.25;      ///< γ of the relief's spectrum, 2.4 to 3.9
  double spectral_strength = 0.004446;  ///< w₂ of the relief's spectrum [cm⁴], at 1 cm⁻¹
};

/// How a surface scatters sound back: σ₀ by the angle of incidence θ from its normal, power per
/// unit area and solid angle at 1 m (dimensionless). By Lambert's law σ₀ = strength cos²θ.
struct Material {
  std::string name;
  double strength = 1.0;  ///< μ of Lambert's law, linear, 0 or more; the paper's K_d

  /// A measured law instead, where given: σ₀ [dB] at rising angles [rad], linear in dB between, at
  /// the ends as the nearest. Both have the same length, 0 or at least 2.
  std::vector<double> angle;
  std::vector<double> backscatter;

  std::optional<Sediment> sediment;  ///< for the models that compute σ₀ from it

  /// \throw std::invalid_argument for a name that is empty, or a number out of its range.
  void check() const;
};

}  // namespace bathyal
