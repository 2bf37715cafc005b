// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>

#include "bathyal/base/text.hpp"
#include "bathyal/identify/checks/internal/checks.hpp"

namespace bathyal::identify {
namespace {

using Warnings = std::vector<std::string>;

void check_convergence(const CheckContext& context, Warnings& warnings) {
  if (context.fit.converged) return;
  warnings.push_back(
      "The search had not converged after " + counted(context.fit.iterations, "step") +
      ": the numbers are those of the last step. Raise max_iterations, and look for bad "
      "rows or a wrong arm first.");
}

/// Rows of the arm with implausibly large changes.
std::vector<std::string> folded_rows(const CheckContext& context) {
  std::vector<std::string> rows;
  for (const FitParameter& p : context.fit.parameters) {
    const bool row = p.group.rfind("row", 0) == 0;
    const double change = p.value - p.nominal;
    if (row && p.unit == "rad" &&
        std::abs(change) > std::max(Limits::kFolded, Limits::kFoldedSigma * p.std)) {
      rows.push_back(p.description + " by " + degrees(change));
    }
  }
  return rows;
}

bool looks_like_another_arm(const CheckContext& context) {
  if (context.search.refitted) return context.search.no_consensus;
  return context.fit.rms_after > Limits::kWrongArmShare * chain_length(context.nominal);
}

void check_machine(const CheckContext& context, Warnings& warnings) {
  if (!looks_like_another_arm(context)) return;
  const std::string links = three_digits(chain_length(context.nominal)) + " m of links";
  warnings.push_back(
      (context.search.no_consensus
           ? "No arm near the drawing, with its " + links + ", agrees with most of the rows"
           : millimetres(context.fit.rms_after) + " rms of residuals, where an arm with " + links +
                 " leaves a few") +
      ". Arm and data look like different machines; or the order, signs, zeros or units of what "
      "was recorded differ, or labels are mixed up. Check these and use none of these numbers.");
}

void check_folding(const CheckContext& context, Warnings& warnings) {
  const std::vector<std::string> folded = folded_rows(context);
  if (folded.empty()) return;
  warnings.push_back("The search turned " + listed(folded, 4) +
                     ": no arm is built so far from its drawing, and one that is folded until its "
                     "tip hardly moves agrees with any touches. Use none of these numbers; correct "
                     "what else is reported here, and identify again.");
}

/// Least squares: all rows have the same observation weight.
bool has_equal_weights(const CheckContext& context) {
  const auto& observation_weights = context.system.observation_weights();
  return std::all_of(observation_weights.begin(), observation_weights.end(),
                     [](double t) { return t == 1.0; });
}

void check_outliers(const CheckContext& context, Warnings& warnings) {
  constexpr std::size_t kMaxListed = 6;
  std::map<std::pair<int, int>, std::vector<int>> swapped;
  std::vector<std::string> far;
  for (const Outlier& outlier : context.fit.outliers) {
    if (outlier.fits) {
      swapped[{outlier.label, *outlier.fits}].push_back(outlier.row);
      continue;
    }
    far.push_back(
        std::to_string(outlier.row) + " (" +
        (outlier.label < 0 ? "" : "point " + context.measurement.name_of(outlier.label) + ", ") +
        millimetres(outlier.distance) + ")");
  }
  if (!swapped.empty()) {
    std::vector<std::string> groups;
    for (const auto& [labels, rows] : swapped) {
      groups.push_back((rows.size() == 1 ? "row " : "rows ") + listed(rows) + ", labelled " +
                       context.measurement.name_of(labels.first) + ", at point " +
                       context.measurement.name_of(labels.second));
    }
    warnings.push_back("Labels look swapped; by the other touches lie " +
                       listed(groups, kMaxListed) + ". Correct the labels and identify again.");
  }
  if (far.empty()) return;
  warnings.push_back(
      std::string(far.size() == 1 ? "One row lies" : std::to_string(far.size()) + " rows lie") +
      " far from where the others predict " + (far.size() == 1 ? "it" : "them") + ": row " +
      listed(far, kMaxListed) +
      (has_equal_weights(context)
           ? ". They bias this fit: see how they were recorded, leave them out or set "
             "loss=\"cauchy\", and identify again."
           : ". The robust loss bounds their influence; see how they were recorded."));
}

void check_given_noise(const CheckContext& context, Warnings& warnings) {
  const ArmFit& fit = context.fit;
  if (fit.degrees_of_freedom < Limits::kFewDof || !fit.outliers.empty()) return;
  double sum = 0.0;
  for (Index i = 0; i < fit.residuals.cols(); ++i) {
    sum += context.measurement.weights[i] * fit.residuals.col(i).squaredNorm();
  }
  const double found = std::sqrt(sum / fit.degrees_of_freedom);
  if (!has_equal_weights(context) || found < Limits::kNoiseRatio * fit.noise) return;
  warnings.push_back("The residuals imply a noise of " + millimetres(found) + " per axis, where " +
                     millimetres(fit.noise) +
                     " was given: standard deviations are too small by that factor. Give no noise, "
                     "or find what else is at work.");
}

void check_residual_structure(const CheckContext& context, Warnings& warnings) {
  const ResidualStructure& structure = context.structure;
  const double part = std::sqrt(structure.share) * context.fit.rms_after;
  if (structure.p > Limits::kStructureP || structure.share < Limits::kStructureShare ||
      part < Limits::kStructureSize || is_unusable(context)) {
    return;
  }
  const std::string joint = joint_label(context.nominal, structure.coordinate);
  warnings.push_back("Geometry is not enough: of the " + millimetres(context.fit.rms_after) +
                     " rms of residuals, at least " + millimetres(part) +
                     " depends on the joints, most on " + joint + " (by chance: p " +
                     (structure.p < 1e-12 ? "< 1e-12" : "= " + three_digits(structure.p)) +
                     "). Elastic links and gears, backlash or eccentric encoders cause this; no "
                     "parameter here represents it, and standard deviations do not include it. "
                     "Trust the arm near the recorded poses, and "
                     "diagnose these effects before relying on it elsewhere.");
}

void check_parameters(const CheckContext& context, Warnings& warnings) {
  if (is_unusable(context) || outliers_dominate(context)) return;
  const ArmFit& fit = context.fit;
  std::vector<std::string> far;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& p = fit.parameters[i];
    if (!is_row(fit.arm_parameters.slots[i])) continue;
    const double change = std::abs(p.value - p.nominal);
    const double most = std::min(p.unit == "rad" ? Limits::kFarAngle : Limits::kFarLength,
                                 Limits::kStrain * fit.arm_parameters.parameters[i].prior_std);
    if (change < most || change < Limits::kFarSigma * p.std) continue;
    far.push_back(p.description + " by " + in_its_unit(p.value - p.nominal, p.unit));
  }
  if (far.empty()) return;
  warnings.push_back("Farther from nominal than makers, or the prior, allow: " + listed(far, 6) +
                     ". Check that this is the arm's type and generation and that joint zeros "
                     "agree; else these numbers compensate for something that is not geometry.");
}

void check_precision(const CheckContext& context, Warnings& warnings) {
  if (is_unusable(context) || outliers_dominate(context)) return;
  std::vector<std::string> weak;
  for (std::size_t i = 0; i < context.fit.parameters.size(); ++i) {
    const FitParameter& p = context.fit.parameters[i];
    if (!is_row(context.fit.arm_parameters.slots[i]) || p.status != Status::kIdentified) continue;
    if (p.std < (p.unit == "rad" ? Limits::kFarAngle : Limits::kFarLength)) continue;
    weak.push_back(p.description + " (± " + in_its_unit(p.std, p.unit) + ")");
  }
  if (weak.empty()) return;
  warnings.push_back(
      "Determined too weakly to mean anything by themselves: " + listed(weak, 6) +
      ". Together they still predict tips near the recorded poses (fit.tip_std gives the "
      "uncertainty there and elsewhere). Record more varied poses, or hold them "
      "by the maker's tolerance with length_prior and angle_prior.");
}

void check_degrees_of_freedom(const CheckContext& context, Warnings& warnings) {
  const ArmFit& fit = context.fit;
  if (fit.degrees_of_freedom >= Limits::kFewDof) return;
  const int dof = std::max(0, static_cast<int>(std::lround(fit.degrees_of_freedom)));
  warnings.push_back(
      (dof == 0 ? "As many unknowns as equations: residuals are small for any arm, and do not "
                  "determine the noise"
                : "Only " + counted(dof, "equation") +
                      " more than unknowns: the noise, and with it every standard deviation, is "
                      "a rough guess") +
      ". Touch more poses; 20 and more for each of three points serve well.");
}

}  // namespace

bool is_unusable(const CheckContext& context) {
  return looks_like_another_arm(context) || !folded_rows(context).empty();
}

bool outliers_dominate(const CheckContext& context) {
  double far = 0.0;
  for (const Outlier& outlier : context.fit.outliers) {
    far += context.fit.residuals.col(outlier.row).squaredNorm();
  }
  return far > 0.5 * context.fit.residuals.squaredNorm();
}

void check_arm(const CheckContext& context, Warnings& warnings) {
  check_machine(context, warnings);
  check_folding(context, warnings);
}

void check_fit(const CheckContext& context, Warnings& warnings) {
  check_convergence(context, warnings);
  check_arm(context, warnings);
  check_outliers(context, warnings);
  check_lengths(context, warnings);
  check_residual_structure(context, warnings);
  check_parameters(context, warnings);
  check_precision(context, warnings);
  check_given_noise(context, warnings);
  check_degrees_of_freedom(context, warnings);
}

}  // namespace bathyal::identify
