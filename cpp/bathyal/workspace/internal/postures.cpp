// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/postures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace bathyal::workspace {
namespace {

constexpr double kLeastSlide = 1.0;  // of a sliding joint without limits, either way [m]

}  // namespace

JointRow drawn_posture(const Arm& arm, const JointRow& middle, RandomStream& random) {
  JointRow q = middle;
  const double length = std::max(kLeastSlide, chain_length(arm));
  for (const Joint& joint : arm.joints()) {
    const Index k = joint.coordinate;
    if (k < 0 || !joint.follows.empty()) continue;
    const double reach = joint.type == JointType::kPrismatic ? length : std::numbers::pi;
    const double low = arm.lower()[k], high = arm.upper()[k];
    q[k] = random.uniform(std::isfinite(low) ? low : std::min(middle[k], high) - reach,
                          std::isfinite(high) ? high : std::max(middle[k], low) + reach);
  }
  return q;
}

JointRow drawn_posture(const Arm& arm, RandomStream& random) {
  return drawn_posture(arm, JointRow::Zero(arm.size()), random);
}

ReachedPostures reached_postures(const Arm& arm, const Pose& target, const JointMatrix& starts,
                                 const InverseOptions& options) {
  const auto count = static_cast<std::size_t>(starts.rows());
  const std::array<double, 16> numbers = row_major(target);
  std::vector<double> targets;
  for (std::size_t i = 0; i < count; ++i) {
    targets.insert(targets.end(), numbers.begin(), numbers.end());
  }
  const InverseResult found = inverse(arm, targets, view_of(starts), options);
  ReachedPostures reached{JointMatrix(starts.rows(), arm.size()), found.status.at(0)};
  Index rows = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (found.status[i] != InverseStatus::kReached) continue;
    reached.status = InverseStatus::kReached;
    reached.q.row(rows++) = found.q.row(static_cast<Index>(i));
  }
  reached.q.conservativeResize(rows, Eigen::NoChange);
  return reached;
}

}  // namespace bathyal::workspace
