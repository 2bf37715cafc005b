// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/effect_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr double kOrdinary = 1e-3;  ///< [m], [rad] or a share: as of the arm's own columns

double scale_of(const std::vector<Action>& actions, const EffectParameter& parameter) {
  double size = 0.0;
  for (const Action& action : actions) {
    const auto rows = static_cast<double>(std::max<Index>(action.values.rows(), 1));
    size = std::max(size, action.values.norm() / std::sqrt(rows));
  }
  return size > 0.0 ? kOrdinary / size : parameter.scale;
}

}  // namespace

std::string variant_name(const EffectVariant& variant) {
  std::string inside;
  const auto tell = [&inside](const std::string& name, const std::string& value) {
    inside += (inside.empty() ? "" : ",") + name + "=" + value;
  };
  if (variant.joint >= 0) tell("joint", std::to_string(variant.joint));
  for (const auto& [name, value] : variant.settings) tell(name, to_text(value));
  return inside.empty() ? variant.effect : variant.effect + "(" + inside + ")";
}

int add_effect(ArmColumns& columns, const EffectVariant& variant,
               std::vector<std::vector<Action>> actions) {
  const auto first = static_cast<int>(columns.columns.size());
  const std::string name = variant_name(variant);
  for (std::size_t p = 0; p < variant.parameters.size(); ++p) {
    const EffectParameter& parameter = variant.parameters[p];
    columns.columns.push_back({name + "." + parameter.name, parameter.name + " of " + name,
                               parameter.unit, name, 0.0, scale_of(actions[p], parameter)});
    columns.places.push_back({Part::kEffect, static_cast<int>(columns.actions.size()), 0});
    columns.actions.push_back(std::make_shared<const std::vector<Action>>(std::move(actions[p])));
  }
  return first;
}

void truncate_columns(ArmColumns& columns, std::size_t count) {
  columns.columns.resize(std::min(count, columns.columns.size()));
  columns.places.resize(columns.columns.size());
  columns.actions.resize(columns.columns.size() -
                         std::min(columns.columns.size(), geometry_columns(columns)));
}

std::size_t geometry_columns(const ArmColumns& columns) {
  const auto effect = [](const Place& place) { return place.part == Part::kEffect; };
  return static_cast<std::size_t>(
      std::find_if(columns.places.begin(), columns.places.end(), effect) - columns.places.begin());
}

}  // namespace bathyal
