// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/materials.hpp"

#include <cmath>
#include <optional>
#include <string>

namespace bathyal {
namespace {

/// `level`: 10 log₁₀ μ of Lambert's law [dB].
Material material(std::string name, double level, std::optional<Sediment> sediment = {}) {
  Material made;
  made.name = std::move(name);
  made.strength = std::pow(10.0, 0.1 * level);
  made.sediment = sediment;
  return made;
}

}  // namespace

const std::vector<Material>& material_library() {
  static const std::vector<Material> library = {
      // ρ ratio, c ratio, loss, σ₂, γ, w₂ [cm⁴]
      material("rock", -12.0, Sediment{2.5, 2.5, 0.01374, 0.002, 3.25, 0.01862}),
      material("gravel", -16.0, Sediment{2.492, 1.3370, 0.01705, 0.002, 3.25, 0.012937}),
      material("coarse_sand", -20.0, Sediment{2.231, 1.2503, 0.01638, 0.002, 3.25, 0.006957}),
      material("sand", -22.0, Sediment{1.845, 1.1782, 0.01624, 0.002, 3.25, 0.004446}),
      material("fine_sand", -25.0, Sediment{1.451, 1.1073, 0.01602, 0.002, 3.25, 0.002715}),
      material("silt", -29.0, Sediment{1.149, 0.9873, 0.00386, 0.001, 3.25, 0.000518}),
      material("mud", -34.0, Sediment{1.145, 0.9801, 0.00148, 0.001, 3.25, 0.000518}),
      material("concrete", -10.0),
      material("steel", -6.0),
      material("rubber", -24.0),
      material("wood", -18.0),
      material("fish", -26.0),
  };
  return library;
}

}  // namespace bathyal
