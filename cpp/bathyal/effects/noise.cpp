// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/effects/internal/library.hpp"

// Effects on rows and on the noise: they perturb nothing that a column could represent, so that
// diagnosis finds them by likelihood. Their documentation is here, with that of the others.

namespace bathyal::effects {
namespace {

class RowEffect final : public Effect {
 public:
  explicit RowEffect(EffectInfo info) : info_(std::move(info)) {}
  EffectInfo info() const override { return info_; }
  std::vector<EffectVariant> variants(const EffectData&) const override { return {}; }
  Perturbations perturbations(const EffectVariant&, const EffectData&) const override { return {}; }

 private:
  EffectInfo info_;
};

}  // namespace

std::shared_ptr<const Effect> outliers() {
  return std::make_shared<RowEffect>(EffectInfo{
      .name = "outliers",
      .description = "rows that contradict the others: a slipped probe, a broken beam",
      .formula = "row i is excluded where its residual exceeds what noise explains",
      .source = "Huber: Robust estimation of a location parameter, 1964; Rousseeuw, Leroy: Robust "
                "regression and outlier detection, 1987"});
}

std::shared_ptr<const Effect> range_noise() {
  return std::make_shared<RowEffect>(EffectInfo{
      .name = "range_noise",
      .description = "noise that grows with the distance from the tracker",
      .formula = "σ² = σ0² + (rate · |position|)²",
      .source = "ISO 10360-10 (a tracker's permissible error A + B · L); Harvey: Estimating "
                "regression models with multiplicative heteroscedasticity, 1976",
      .ranges = {{.parameter = "rate", .unit = "m/m", .low = 1e-7, .high = 1e-2}}});
}

std::shared_ptr<const Effect> quantisation() {
  return std::make_shared<RowEffect>(
      EffectInfo{.name = "quantisation",
                 .description = "joint values that were logged in steps",
                 .formula = "all logged q are whole multiples of step",
                 .source = "Widrow, Kollár: Quantization noise, 2008",
                 .ranges = {{.parameter = "step", .unit = "rad", .low = 1e-6, .high = 2e-2}}});
}

}  // namespace bathyal::effects
