// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>

#include "bathyal/base/text.hpp"
#include "bathyal/identify/checks/internal/checks.hpp"

namespace bathyal {
namespace {

using Warnings = std::vector<std::string>;

void doubt_search(const Case& seen, Warnings& warnings) {
  if (seen.fit.converged) return;
  warnings.push_back("The search had not settled after " + counted(seen.fit.iterations, "step") +
                     ": the numbers are where it stood. Raise max_iterations, and look for bad "
                     "rows or a wrong arm first.");
}

/// Rows of the arm that moved out of all proportion.
std::vector<std::string> folded_rows(const Case& seen) {
  constexpr double kFolded = 0.5;  // [rad]
  constexpr double kSurely = 3.0;  // else it is not told, and wandered
  std::vector<std::string> rows;
  for (const FitParameter& p : seen.fit.parameters) {
    const bool row = p.group.rfind("row", 0) == 0;
    const double change = p.value - p.nominal;
    if (row && p.unit == "rad" && std::abs(change) > std::max(kFolded, kSurely * p.std)) {
      rows.push_back(p.words + " by " + degrees(change));
    }
  }
  return rows;
}

bool looks_foreign(const Case& seen) {
  if (seen.search.looked_twice) return seen.search.hopeless;
  return seen.fit.rms_after > kForeignShare * chain_length(seen.nominal);
}

void doubt_machine(const Case& seen, Warnings& warnings) {
  if (!looks_foreign(seen)) return;
  const std::string links = three_digits(chain_length(seen.nominal)) + " m of links";
  warnings.push_back(
      (seen.search.hopeless
           ? "No arm near the drawing, with its " + links + ", agrees with most of the rows"
           : millimetres(seen.fit.rms_after) + " rms are left, where an arm with " + links +
                 " leaves a few") +
      ". Arm and data look like different machines; or the order, signs, zeros or units of what "
      "was recorded differ, or labels are mixed up. Check these and use none of these numbers.");
}

void doubt_fold(const Case& seen, Warnings& warnings) {
  const std::vector<std::string> folded = folded_rows(seen);
  if (folded.empty()) return;
  warnings.push_back("The search turned " + listed(folded, 4) +
                     ": no arm is built so far from its drawing, and one that is folded until its "
                     "tip hardly moves agrees with any touches. Use none of these numbers; mend "
                     "what else is named here, and identify again.");
}

/// Least squares: no row is trusted less than another.
bool counts_all_alike(const Case& seen) {
  const auto& trust = seen.system.trust();
  return std::all_of(trust.begin(), trust.end(), [](double t) { return t == 1.0; });
}

void doubt_rows(const Case& seen, Warnings& warnings) {
  constexpr std::size_t kMostNamed = 6;
  std::map<std::pair<int, int>, std::vector<int>> swapped;
  std::vector<std::string> far;
  for (const Outlier& outlier : seen.fit.outliers) {
    if (outlier.fits) {
      swapped[{outlier.label, *outlier.fits}].push_back(outlier.row);
      continue;
    }
    far.push_back(
        std::to_string(outlier.row) + " (" +
        (outlier.label < 0 ? "" : "point " + seen.measurement.name_of(outlier.label) + ", ") +
        millimetres(outlier.distance) + ")");
  }
  if (!swapped.empty()) {
    std::vector<std::string> groups;
    for (const auto& [labels, rows] : swapped) {
      groups.push_back((rows.size() == 1 ? "row " : "rows ") + listed(rows) + ", labelled " +
                       seen.measurement.name_of(labels.first) + ", at point " +
                       seen.measurement.name_of(labels.second));
    }
    warnings.push_back("Labels look swapped; by the other touches lie " +
                       listed(groups, kMostNamed) + ". Mend the labels and identify again.");
  }
  if (far.empty()) return;
  warnings.push_back(
      std::string(far.size() == 1 ? "One row lies" : std::to_string(far.size()) + " rows lie") +
      " far from where the others want " + (far.size() == 1 ? "it" : "them") + ": row " +
      listed(far, kMostNamed) +
      (counts_all_alike(seen)
           ? ". They pull on this fit: see how they were recorded, leave them out or set "
             "loss=\"cauchy\", and identify again."
           : ". The robust loss bounds their pull; see how they were recorded."));
}

void doubt_noise_told(const Case& seen, Warnings& warnings) {
  constexpr double kMostRatio = 1.5;
  const ArmFit& fit = seen.fit;
  if (fit.degrees_of_freedom < 10.0 || !fit.outliers.empty()) return;
  double sum = 0.0;
  for (Index i = 0; i < fit.residuals.cols(); ++i) {
    sum += seen.measurement.weights[i] * fit.residuals.col(i).squaredNorm();
  }
  const double found = std::sqrt(sum / fit.degrees_of_freedom);
  if (!counts_all_alike(seen) || found < kMostRatio * fit.noise) return;
  warnings.push_back("What is left asks for a noise of " + millimetres(found) +
                     " per axis, where " + millimetres(fit.noise) +
                     " was told: standard deviations are too small by that factor. Tell no noise, "
                     "or find what else is at work.");
}

void doubt_geometry(const Case& seen, Warnings& warnings) {
  constexpr double kSurely = 1e-3;
  constexpr double kWorthTelling = 0.02;  // of the variance
  const JointStructure& structure = seen.structure;
  constexpr double kLeastPart = 1e-5;  // [m] no arm is asked for less
  const double part = std::sqrt(structure.share) * seen.fit.rms_after;
  if (structure.p > kSurely || structure.share < kWorthTelling || part < kLeastPart ||
      is_unusable(seen)) {
    return;
  }
  const std::string joint = joint_words(seen.nominal, structure.coordinate);
  warnings.push_back(
      "Geometry is not enough: of the " + millimetres(seen.fit.rms_after) +
      " rms that is left, at least " + millimetres(part) +
      " follows the joints, by itself most with " + joint + " (by chance: p " +
      (structure.p < 1e-12 ? "< 1e-12" : "= " + three_digits(structure.p)) +
      "). Elastic links and gears, backlash or eccentric encoders do so; no parameter here can, "
      "and standard deviations do not count it. Trust the arm near the recorded poses, and "
      "diagnose these effects before relying on it elsewhere.");
}

void doubt_parameters(const Case& seen, Warnings& warnings) {
  constexpr double kSurely = 4.0;
  constexpr double kStrain = 6.0;  // of the prior's std
  if (is_unusable(seen) || is_swamped(seen)) return;
  const ArmFit& fit = seen.fit;
  std::vector<std::string> far;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& p = fit.parameters[i];
    if (!is_row(fit.columns.places[i])) continue;
    const double change = std::abs(p.value - p.nominal);
    const double most = std::min(p.unit == "rad" ? kFarAngle : kFarLength,
                                 kStrain * fit.columns.columns[i].prior_std);
    if (change < most || change < kSurely * p.std) continue;
    far.push_back(p.words + " by " + in_its_unit(p.value - p.nominal, p.unit));
  }
  if (far.empty()) return;
  warnings.push_back("Farther from nominal than makers, or the prior, allow: " + listed(far, 6) +
                     ". Check that this is the arm's type and generation and that joint zeros "
                     "agree; else these numbers stand in for something that is not geometry.");
}

void doubt_weak(const Case& seen, Warnings& warnings) {
  if (is_unusable(seen) || is_swamped(seen)) return;
  std::vector<std::string> weak;
  for (std::size_t i = 0; i < seen.fit.parameters.size(); ++i) {
    const FitParameter& p = seen.fit.parameters[i];
    if (!is_row(seen.fit.columns.places[i]) || p.status != Status::kIdentified) continue;
    if (p.std < (p.unit == "rad" ? kFarAngle : kFarLength)) continue;
    weak.push_back(p.words + " (± " + in_its_unit(p.std, p.unit) + ")");
  }
  if (weak.empty()) return;
  warnings.push_back("Told too weakly to mean anything by themselves: " + listed(weak, 6) +
                     ". Together they still foretell tips near the recorded poses (fit.tip_std "
                     "says how well there and elsewhere). Record more varied poses, or hold them "
                     "by the maker's tolerance with length_prior and angle_prior.");
}

void doubt_intervals(const Case& seen, Warnings& warnings) {
  constexpr double kFew = 10.0;
  const ArmFit& fit = seen.fit;
  if (fit.degrees_of_freedom >= kFew) return;
  const int left = std::max(0, static_cast<int>(std::lround(fit.degrees_of_freedom)));
  warnings.push_back(
      (left == 0 ? "As many unknowns as equations: residuals are small whatever is true, and "
                   "say nothing of noise"
                 : "Only " + counted(left, "equation") +
                       " more than unknowns: the noise, and with it every standard deviation, is "
                       "a rough guess") +
      ". Touch more poses; 20 and more for each of three points serve well.");
}

}  // namespace

bool is_unusable(const Case& seen) { return looks_foreign(seen) || !folded_rows(seen).empty(); }

bool is_swamped(const Case& seen) {
  double far = 0.0;
  for (const Outlier& outlier : seen.fit.outliers) {
    far += seen.fit.residuals.col(outlier.row).squaredNorm();
  }
  return far > 0.5 * seen.fit.residuals.squaredNorm();
}

void doubt_arm(const Case& seen, Warnings& warnings) {
  doubt_machine(seen, warnings);
  doubt_fold(seen, warnings);
}

void doubt_fit(const Case& seen, Warnings& warnings) {
  doubt_search(seen, warnings);
  doubt_arm(seen, warnings);
  doubt_rows(seen, warnings);
  doubt_lengths(seen, warnings);
  doubt_geometry(seen, warnings);
  doubt_parameters(seen, warnings);
  doubt_weak(seen, warnings);
  doubt_noise_told(seen, warnings);
  doubt_intervals(seen, warnings);
}

}  // namespace bathyal
