// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/summary.hpp"

#include <cstdio>

namespace bathyal {
namespace {

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", metres * 1e3);
  return text;
}

int count(const ArmFit& fit, Status status) {
  int number = 0;
  for (const FitParameter& p : fit.parameters) number += p.status == status ? 1 : 0;
  return number;
}

}  // namespace

std::string summarize(const ArmFit& fit) {
  std::string text =
      "The tip's scatter falls from " + millimetres(fit.rms_before) + " to " +
      millimetres(fit.rms_after) + " (rms, 3-D) over " + std::to_string(fit.residuals.cols()) +
      " poses. Of " + std::to_string(fit.parameters.size()) + " parameters the data tell " +
      std::to_string(fit.rank) +
      " combinations: " + std::to_string(count(fit, Status::kIdentified)) +
      " parameters are identified each by itself, " + std::to_string(count(fit, Status::kGauge)) +
      " are left to base and tool (gauge)";
  const int prior = count(fit, Status::kPrior);
  const int lost = count(fit, Status::kNotIdentifiable);
  if (prior > 0) text += ", " + std::to_string(prior) + " rest on a prior";
  if (lost > 0) text += ", " + std::to_string(lost) + " could not be found";
  text += ". The arm's size rests on: " + fit.scale_source + ".";
  for (const std::string& warning : fit.warnings) text += " " + warning;
  return text;
}

}  // namespace bathyal
