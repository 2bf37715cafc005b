// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/effects/effect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bathyal/base/check.hpp"
#include "bathyal/effects/internal/library.hpp"

namespace bathyal {
namespace {

std::string shape_of(const RowMatrix& values) {
  return "shape (" + std::to_string(values.rows()) + ", " + std::to_string(values.cols()) + ")";
}

/// NaN marks a number that was not recorded.
bool is_complete(const RowMatrix& values) { return values.array().isFinite().all(); }

void check_shape(const std::string& name, const RowMatrix& values, Index rows, Index width) {
  if (values.rows() == rows && values.cols() == width) return;
  throw_argument("covariates " + name,
                 "shape (" + std::to_string(rows) + ", " + std::to_string(width) + ")",
                 shape_of(values));
}

void check_each(const std::string& name, const RowMatrix& values, const char* expected,
                bool (*good)(double)) {
  for (Index i = 0; i < values.size(); ++i) {
    const double value = values.data()[i];
    if (std::isnan(value) || good(value)) continue;
    throw_argument("covariates " + name, expected,
                   to_text(value) + " at row " + std::to_string(i / values.cols()));
  }
}

void check_known(const Covariates& covariates, const RowMatrix& q) {
  for (const auto& [name, values] : covariates) {
    const Index n = q.rows();
    if (name == "temperature" || name == "time") {
      check_shape(name, values, n, 1);
      check_each(name, values, "finite numbers", [](double v) { return std::isfinite(v); });
    } else if (name == "payload") {
      check_shape(name, values, n, 1);
      check_each(name, values, "finite numbers of 0 or more",
                 [](double v) { return v >= 0.0 && std::isfinite(v); });
    } else if (name == "direction") {
      check_shape(name, values, n, q.cols());
      check_each(name, values, "-1, 0 or 1",
                 [](double v) { return v == -1.0 || v == 0.0 || v == 1.0; });
    } else if (name == "gravity") {
      check_shape(name, values, n, 3);
      check_each(name, values, "finite numbers", [](double v) { return std::isfinite(v); });
    } else if (name == "row") {
      check_shape(name, values, n, 1);
      check_each(name, values, "whole numbers of 0 or more",
                 [](double v) { return v >= 0.0 && std::isfinite(v) && v == std::round(v); });
    } else if (name == "session") {
      check_shape(name, values, n, 1);
      check_each(name, values, "whole numbers",
                 [](double v) { return std::isfinite(v) && v == std::round(v); });
    }
  }
}

std::string place_of(const EffectVariant& variant, std::size_t parameter) {
  return "perturbations of " + variant.effect + ", parameter " + variant.parameters[parameter].name;
}

void check_perturbation(const std::string& name, const Perturbation& perturbation,
                        const EffectData& data) {
  const Index width = perturbation.site == PerturbationSite::kFrame ? 6 : 1;
  if (perturbation.values.rows() != data.rows() || perturbation.values.cols() != width) {
    throw_argument(
        name,
        "values of shape (" + std::to_string(data.rows()) + ", " + std::to_string(width) + ")",
        shape_of(perturbation.values));
  }
  if (!(perturbation.values.array().abs() <= kMaxPerturbation).all()) {
    throw_argument(name, "numbers within " + to_text(kMaxPerturbation), "larger ones, nan or inf");
  }
  const auto rows = static_cast<int>(data.arm->joints().size());
  const int last = perturbation.site == PerturbationSite::kJoint
                       ? static_cast<int>(data.arm->size()) - 1
                   : perturbation.site == PerturbationSite::kFrame ? rows + 1
                                                                   : 0;
  if (perturbation.index < 0 || perturbation.index > last) {
    throw_argument(name, "an index from 0 to " + std::to_string(last),
                   std::to_string(perturbation.index));
  }
}

}  // namespace

bool EffectData::has(std::string_view name) const {
  const auto found = covariates.find(std::string(name));
  return found != covariates.end() && found->second.rows() == rows() && is_complete(found->second);
}

const RowMatrix& EffectData::covariate(std::string_view name) const {
  return covariates.at(std::string(name));
}

EffectData make_effect_data(const Arm& arm, const RowMatrix& q, const Covariates& covariates,
                            bool has_rotation) {
  check_known(covariates, q);
  EffectData data;
  data.arm = &arm;
  data.q = q;
  data.covariates = covariates;
  data.has_rotation = has_rotation;
  data.gravity = kGravity.transpose().replicate(q.rows(), 1);
  if (data.has("gravity")) data.gravity = data.covariate("gravity");
  data.order.resize(static_cast<std::size_t>(q.rows()));
  std::iota(data.order.begin(), data.order.end(), 0);
  if (data.has("time")) {
    const RowMatrix& time = data.covariate("time");
    std::stable_sort(data.order.begin(), data.order.end(),
                     [&time](int a, int b) { return time(a, 0) < time(b, 0); });
  }
  return data;
}

std::string Effect::describe(const EffectVariant& variant, const Arm& arm) const {
  return variant.joint < 0 ? variant.effect
                           : variant.effect + " of " + effects::describe_joint(variant.joint, arm);
}

double plausible_size(const EffectInfo& info, const EffectParameter& parameter) {
  // "rad or m" is the unit of revolute and prismatic joints.
  const auto includes_unit = [&](const std::string& units) {
    const std::size_t at = units.find(parameter.unit);
    if (at == std::string::npos) return false;
    const std::size_t end = at + parameter.unit.size();
    return (at == 0 || units[at - 1] == ' ') &&
           (end == units.size() || units[end] == ',' || units.substr(end, 4) == " or ");
  };
  for (const EffectInfo::Range& range : info.ranges) {
    if (includes_unit(range.unit)) return range.high;
  }
  return std::numeric_limits<double>::infinity();
}

std::vector<std::vector<Perturbation>> perturbations_of(const Effect& effect,
                                                        const EffectVariant& variant,
                                                        const EffectData& data) {
  std::vector<std::vector<Perturbation>> perturbations = effect.perturbations(variant, data);
  if (perturbations.size() != variant.parameters.size()) {
    throw_argument("perturbations of " + variant.effect,
                   std::to_string(variant.parameters.size()) + " lists, one a parameter",
                   std::to_string(perturbations.size()));
  }
  for (std::size_t p = 0; p < perturbations.size(); ++p) {
    for (const Perturbation& perturbation : perturbations[p])
      check_perturbation(place_of(variant, p), perturbation, data);
  }
  return perturbations;
}

}  // namespace bathyal
