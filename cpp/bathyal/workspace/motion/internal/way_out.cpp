// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/way_out.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bathyal/base/random.hpp"

namespace bathyal::workspace {
namespace {

constexpr std::uint64_t kWayOutStream = 2;
constexpr double kRadii[] = {0.05, 0.1, 0.2, 0.4};  // [rad], [m]
constexpr int kDirections = 64;
constexpr int kSteps = 40;

JointMatrix two_rows(const JointRow& from, const JointRow& to) {
  JointMatrix rows(2, from.size());
  rows.row(0) = from;
  rows.row(1) = to;
  return rows;
}

JointRow within(const Arm& arm, const JointRow& q) {
  return q.cwiseMax(arm.lower().transpose()).cwiseMin(arm.upper().transpose());
}

/// Whether the clearance rises from the start's to above 0, and once above stays there.
bool leads_out(const PlanCheck& check, const JointRow& from, const JointRow& to) {
  double least_allowed = -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    const double now = check.clearance(from + double(i) / kSteps * (to - from)).least();
    if (i == 0) least_allowed = now - 1e-9;
    if (now < least_allowed) return false;
    if (now > 0.0) least_allowed = 0.0;
  }
  return least_allowed == 0.0;
}

}  // namespace

JointMatrix way_out_of_contact(PlanCheck& check, const JointRow& start) {
  RandomStream random(check.options().seed, kWayOutStream);
  for (const double radius : kRadii) {
    for (int i = 0; i < kDirections; ++i) {
      if (check.late()) return {};
      JointRow direction(start.size());
      for (double& value : direction) value = random.normal();
      const JointRow end = within(check.arm(), start + radius / direction.norm() * direction);
      if (check.is_free(end) && leads_out(check, start, end)) return two_rows(start, end);
    }
  }
  return {};
}

JointMatrix way_out_to_limits(PlanCheck& check, const JointRow& start) {
  const JointRow end = within(check.arm(), start);
  if (check.free_share(start, end) < 1.0) return {};
  return two_rows(start, end);
}

}  // namespace bathyal::workspace
