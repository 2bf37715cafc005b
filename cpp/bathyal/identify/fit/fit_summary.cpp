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

/// The least surely known of the identified ones in a unit; null when there is none.
const FitParameter* least_sure(const ArmFit& fit, const std::string& unit) {
  const FitParameter* worst = nullptr;
  for (const FitParameter& p : fit.parameters) {
    if (p.status != Status::kIdentified || p.unit != unit) continue;
    if (worst == nullptr || p.std > worst->std) worst = &p;
  }
  return worst;
}

std::string what_was_found(const ArmFit& fit) {
  std::string text = counted(fit.residuals.cols(), "pose");
  const auto points = static_cast<long>(fit.point_labels.size());
  if (points > 0) text += " at " + counted(points, "point");
  return text + ": the tip's error falls from " + millimetres(fit.rms_before) + " to " +
         millimetres(fit.rms_after) + " rms (3-D).";
}

std::string how_many(const ArmFit& fit) {
  const int gauge = count(fit, Status::kGauge);
  const int prior = count(fit, Status::kPrior);
  const int lost = count(fit, Status::kNotIdentifiable);
  const int held = count(fit, Status::kFixed) + count(fit, Status::kPruned);
  std::vector<std::string> kinds{std::to_string(count(fit, Status::kIdentified)) +
                                 " told by the data"};
  if (prior > 0) kinds.push_back(std::to_string(prior) + " resting on a prior");
  if (lost > 0) kinds.push_back(std::to_string(lost) + " not found");
  if (gauge > 0) {
    kinds.push_back(std::to_string(gauge) + " left to base and tool, which loses nothing (gauge)");
  }
  if (held > 0) kinds.push_back(std::to_string(held) + " held at nominal");
  return " Of " + counted(static_cast<long>(fit.parameters.size()), "parameter") + ": " +
         listed(kinds) + ".";
}

std::string how_surely(const ArmFit& fit) {
  std::vector<std::string> worst;
  for (const char* unit : {"m", "rad"}) {
    const FitParameter* p = least_sure(fit, unit);
    if (p != nullptr) worst.push_back(p->words + " ± " + in_its_unit(p->std, unit));
  }
  std::string text = " Noise " + millimetres(fit.noise) + " per axis.";
  if (!worst.empty()) text += " Least sure of what was told: " + listed(worst) + " (1 sigma).";
  return text + " The arm's size, " + three_digits(100.0 * fit.scale) + " % of nominal ± " +
         three_digits(100.0 * fit.scale_std) + " %, rests on: " + fit.scale_source + ".";
}

std::string what_speaks_against(const ArmFit& fit) {
  if (fit.warnings.empty()) {
    return " Nothing in the data speaks against it. To be sure, touch a few poses more that were "
           "not used and compare.";
  }
  if (fit.warnings.size() == 1) return " But: " + fit.warnings[0];
  std::string text =
      " But " + std::to_string(fit.warnings.size()) + " things speak against taking it as it is.";
  for (std::size_t i = 0; i < fit.warnings.size(); ++i) {
    text += " (" + std::to_string(i + 1) + ") " + fit.warnings[i];
  }
  return text;
}

}  // namespace

std::string summarize(const ArmFit& fit, bool with_warnings) {
  const std::string found = what_was_found(fit) + how_many(fit) + how_surely(fit);
  return fit.warnings.empty() || with_warnings ? found + what_speaks_against(fit) : found;
}

}  // namespace bathyal
