// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/material.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

void check_table(const Material& material) {
  if (material.angle.size() != material.backscatter.size() || material.angle.size() == 1) {
    throw_argument("angle", "none, or two or more, and as many values of backscatter",
                   std::to_string(material.angle.size()) + " and " +
                       std::to_string(material.backscatter.size()));
  }
  for (std::size_t i = 0; i < material.angle.size(); ++i) {
    check_range("angle", material.angle[i], 0.0, 0.5 * std::numbers::pi);
    check_finite("backscatter", material.backscatter[i]);
    if (i > 0 && !(material.angle[i] > material.angle[i - 1])) {
      throw_argument("angle", "rising values",
                     to_text(material.angle[i]) + " in row " + std::to_string(i));
    }
  }
}

void check_sediment(const Sediment& sediment) {
  check_positive("density_ratio", sediment.density_ratio);
  check_positive("speed_ratio", sediment.speed_ratio);
  check_not_negative("loss", sediment.loss);
  check_not_negative("volume", sediment.volume);
  check_range("spectral_exponent", sediment.spectral_exponent, 2.4, 3.9);
  check_not_negative("spectral_strength", sediment.spectral_strength);
}

}  // namespace

void Material::check() const {
  if (name.empty()) throw_argument("name", "a name of the material", "none");
  check_not_negative("strength", strength);
  check_table(*this);
  if (sediment) check_sediment(*sediment);
}

}  // namespace bathyal
