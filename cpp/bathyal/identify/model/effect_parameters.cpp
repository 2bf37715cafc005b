// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/effect_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr double kTypicalScale = 1e-3;  ///< [m], [rad] or a share: as of the parameters of the arm

double scale_of(const std::vector<Perturbation>& perturbations, const EffectParameter& parameter) {
  double size = 0.0;
  for (const Perturbation& perturbation : perturbations) {
    const auto rows = static_cast<double>(std::max<Index>(perturbation.values.rows(), 1));
    size = std::max(size, perturbation.values.norm() / std::sqrt(rows));
  }
  return size > 0.0 ? kTypicalScale / size : parameter.scale;
}

}  // namespace

std::string variant_name(const EffectVariant& variant) {
  std::string arguments;
  const auto append = [&arguments](const std::string& name, const std::string& value) {
    arguments += (arguments.empty() ? "" : ",") + name + "=" + value;
  };
  if (variant.joint >= 0) append("joint", std::to_string(variant.joint));
  for (const auto& [name, value] : variant.settings) append(name, to_text(value));
  return arguments.empty() ? variant.effect : variant.effect + "(" + arguments + ")";
}

int add_effect(ArmParameters& parameters, const EffectVariant& variant,
               std::vector<std::vector<Perturbation>> perturbations) {
  const auto first = static_cast<int>(parameters.parameters.size());
  const std::string name = variant_name(variant);
  for (std::size_t p = 0; p < variant.parameters.size(); ++p) {
    const EffectParameter& parameter = variant.parameters[p];
    parameters.parameters.push_back({name + "." + parameter.name, parameter.name + " of " + name,
                                     parameter.unit, name, 0.0,
                                     scale_of(perturbations[p], parameter)});
    parameters.slots.push_back(
        {ParameterKind::kEffect, static_cast<int>(parameters.perturbations.size()), 0});
    parameters.perturbations.push_back(
        std::make_shared<const std::vector<Perturbation>>(std::move(perturbations[p])));
  }
  return first;
}

void truncate_parameters(ArmParameters& parameters, std::size_t count) {
  parameters.parameters.resize(std::min(count, parameters.parameters.size()));
  parameters.slots.resize(parameters.parameters.size());
  parameters.perturbations.resize(
      parameters.parameters.size() -
      std::min(parameters.parameters.size(), geometry_parameters(parameters)));
}

std::size_t geometry_parameters(const ArmParameters& parameters) {
  const auto effect = [](const ParameterSlot& slot) { return slot.kind == ParameterKind::kEffect; };
  return static_cast<std::size_t>(
      std::find_if(parameters.slots.begin(), parameters.slots.end(), effect) -
      parameters.slots.begin());
}

}  // namespace bathyal
