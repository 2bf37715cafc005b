// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/room_check.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bathyal/base/text.hpp"

namespace bathyal::diagnosis {
namespace {

constexpr double kLongTool = 1.0;      ///< of the arm's reach
constexpr double kFarBase = 2.0;       ///< likewise
constexpr double kWrongLength = 0.25;  ///< likewise
constexpr double kLeastReach = 0.2;    ///< [m] of an arm with lengths of zero

/// Lengths of all rows, flange, tool and the farthest that joints slide.
double reach_of(const Arm& arm, const Measurement& m) {
  double reach = chain_length(arm) + arm.flange().translation().norm() +
                 arm.tool().translation().norm() + arm.root().translation().norm();
  for (const Joint& joint : arm.joints()) {
    if (joint.type != JointType::kPrismatic) continue;
    const auto values = joint.multiplier * m.q.col(joint.coordinate).array() + joint.offset;
    reach += values.abs().maxCoeff();
  }
  return std::max(reach, kLeastReach);
}

std::string metres(double value) { return three_digits(value) + " m"; }

std::string of_several(const std::string& what, std::size_t index, std::size_t count) {
  return count == 1 ? what : what + " " + std::to_string(index + 1);
}

}  // namespace

std::vector<std::string> check_room(const Arm& nominal, const ArmState& fitted,
                                    const Measurement& measurement) {
  const double reach = reach_of(nominal, measurement);
  const std::string advice =
      "; these data hardly determine it, and its numbers mean nothing. Record poses that differ in "
      "all joints, give the maker's tolerance as length_prior, or hold it by `fixed`.";
  std::vector<std::string> out;
  for (std::size_t t = 0; t < fitted.tools.size(); ++t) {
    const double length = fitted.tools[t].translation().norm();
    if (length <= kLongTool * reach) continue;
    out.push_back(of_several("The tool", t, fitted.tools.size()) + " came out " + metres(length) +
                  " from the flange, farther than the arm of " + metres(reach) + " is long" +
                  advice);
  }
  for (std::size_t b = 0; measurement.tracked && b < fitted.bases.size(); ++b) {
    std::vector<Index> rows;
    for (Index i = 0; i < measurement.rows(); ++i) {
      if (measurement.station[i] == static_cast<int>(b)) rows.push_back(i);
    }
    if (rows.empty()) continue;
    const Vec3 center = measurement.position(Eigen::all, rows).rowwise().mean();
    const double away = (fitted.bases[b].translation() - center).norm();
    if (away <= kFarBase * reach) continue;
    out.push_back(of_several("The base", b, fitted.bases.size()) + " came out " + metres(away) +
                  " from the measured positions, farther than the arm of " + metres(reach) +
                  " reaches" + advice);
  }
  for (std::size_t k = 0; k < nominal.joints().size(); ++k) {
    const DhRow& drawn = nominal.joints()[k].row;
    const DhRow& row = fitted.arm.joints()[k].row;
    for (const auto& [name, change, value] :
         {std::tuple{"a", row.a - drawn.a, row.a}, std::tuple{"d", row.d - drawn.d, row.d}}) {
      if (std::abs(change) <= kWrongLength * reach) continue;
      out.push_back(std::string("Length ") + name + " of row " + std::to_string(k + 1) +
                    " came out at " + metres(value) + ", " + metres(change) + " from nominal" +
                    advice);
    }
  }
  return out;
}

}  // namespace bathyal::diagnosis
