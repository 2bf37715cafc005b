// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/fit_summary.hpp"

#include <algorithm>

#include "bathyal/base/text.hpp"

namespace bathyal {
namespace {

int count(const ArmFit& fit, Status status) {
  return static_cast<int>(
      std::count_if(fit.parameters.begin(), fit.parameters.end(),
                    [status](const FitParameter& p) { return p.status == status; }));
}

/// The identified parameter of a unit with the largest std; null when there is none.
const FitParameter* least_certain(const ArmFit& fit, const std::string& unit) {
  const FitParameter* worst = nullptr;
  for (const FitParameter& p : fit.parameters) {
    if (p.status != Status::kIdentified || p.unit != unit) continue;
    if (worst == nullptr || p.std > worst->std) worst = &p;
  }
  return worst;
}

std::string residuals_text(const ArmFit& fit) {
  std::string text = counted(fit.residuals.cols(), "pose");
  const auto points = static_cast<long>(fit.point_labels.size());
  if (points > 0) text += " at " + counted(points, "point");
  return text + ": the tip's error falls from " + millimetres(fit.rms_before) + " to " +
         millimetres(fit.rms_after) + " rms (3-D).";
}

std::string parameters_text(const ArmFit& fit) {
  const int redundant = count(fit, Status::kGauge);
  const int prior = count(fit, Status::kPrior);
  const int lost = count(fit, Status::kNotIdentifiable);
  const int held = count(fit, Status::kFixed) + count(fit, Status::kPruned);
  std::vector<std::string> kinds{std::to_string(count(fit, Status::kIdentified)) +
                                 " determined by the data"};
  if (prior > 0) kinds.push_back(std::to_string(prior) + " determined by a prior");
  if (lost > 0) kinds.push_back(std::to_string(lost) + " not identifiable");
  if (redundant > 0) {
    kinds.push_back(std::to_string(redundant) +
                    " redundant with base and tool, without loss of accuracy (gauge)");
  }
  if (held > 0) kinds.push_back(std::to_string(held) + " held at nominal");
  return " Of " + counted(static_cast<long>(fit.parameters.size()), "parameter") + ": " +
         listed(kinds) + ".";
}

std::string uncertainty_text(const ArmFit& fit) {
  std::vector<std::string> worst;
  for (const char* unit : {"m", "rad"}) {
    const FitParameter* p = least_certain(fit, unit);
    if (p != nullptr) worst.push_back(p->description + " ± " + in_its_unit(p->std, unit));
  }
  std::string text = " Noise " + millimetres(fit.noise) + " per axis.";
  if (!worst.empty()) text += " Least certain of these: " + listed(worst) + " (1 sigma).";
  return text + " The scale of the arm, " + three_digits(100.0 * fit.scale) + " % of nominal ± " +
         three_digits(100.0 * fit.scale_std) + " %, is determined by: " + fit.scale_source + ".";
}

std::string warnings_text(const ArmFit& fit) {
  if (fit.warnings.empty()) {
    return " No check raised a warning. To verify it, touch a few more poses that were not used "
           "and compare.";
  }
  if (fit.warnings.size() == 1) return " Warning: " + fit.warnings[0];
  std::string text(1, ' ');
  text.append(std::to_string(fit.warnings.size())).append(" warnings.");
  for (std::size_t i = 0; i < fit.warnings.size(); ++i) {
    text.append(" (").append(std::to_string(i + 1)).append(") ").append(fit.warnings[i]);
  }
  return text;
}

}  // namespace

std::string summarize(const ArmFit& fit, bool with_warnings) {
  const std::string text = residuals_text(fit) + parameters_text(fit) + uncertainty_text(fit);
  return fit.warnings.empty() || with_warnings ? text + warnings_text(fit) : text;
}

}  // namespace bathyal
