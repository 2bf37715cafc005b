// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/diagnosis.hpp"

#include <cstdio>

#include "bathyal/diagnosis/internal/seconds.hpp"

namespace bathyal {

std::string diagnosis::seconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g s", seconds);
  return text;
}

std::string to_text(const Dependence& dependence) {
  using Kind = Dependence::Kind;
  const auto joint = [&](std::size_t i) { return std::to_string(dependence.coordinates[i] + 1); };
  switch (dependence.kind) {
    case Kind::kNone:
      return "";
    case Kind::kPosition:
      return "position";
    case Kind::kRange:
      return "the range from the instrument";
    case Kind::kJoints:
      if (dependence.coordinates.size() == 1) return "joint " + joint(0);
      if (dependence.coordinates.size() == 2) return "joints " + joint(0) + " and " + joint(1);
      return "all joints together";
    case Kind::kTime:
      if (!dependence.period) return "time";
      return "time, period " + diagnosis::seconds(*dependence.period);
    case Kind::kOrder:
      return "the order of the rows";
    case Kind::kApproach:
      return "the last move of joint " + joint(0);
    case Kind::kSession:
      return "session";
    case Kind::kCovariate:
      if (!dependence.component) return dependence.covariate;
      return dependence.covariate + " " + std::to_string(*dependence.component + 1);
  }
  return "";
}

}  // namespace bathyal
