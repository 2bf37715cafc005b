// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/inverse_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bathyal::arm {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kTolerance = 1e-6;       ///< [m] and [rad]
constexpr double kPaperTolerance = 1e-2;  ///< [m], of Maevskiy, Zanin (2020)

/// Whether each coordinate only turns joints, by whole multiples: then 2 pi more is the same pose.
std::vector<std::uint8_t> find_turns(const Arm& arm) {
  std::vector<std::uint8_t> turns(static_cast<std::size_t>(arm.size()), 1);
  for (const Joint& joint : arm.joints()) {
    if (joint.type == JointType::kFixed) continue;
    const bool whole = joint.multiplier == std::round(joint.multiplier);
    if (joint.type != JointType::kRevolute || !whole) turns[joint.coordinate] = 0;
  }
  return turns;
}

/// The chain stretched out: an upper bound.
double longest_reach(const Arm& arm) {
  double reach = (arm.flange() * arm.tool()).translation().norm();
  for (const Joint& joint : arm.joints()) {
    double slide = std::abs(joint.row.d);
    if (joint.type == JointType::kPrismatic) {
      slide = std::max(std::abs(joint.row.d + joint.lower), std::abs(joint.row.d + joint.upper));
    }
    reach += std::hypot(joint.row.a, slide);
  }
  return reach;
}

/// A fifth of the lengths of the chain, sliding joints at rest: among what was tried on six- and
/// seven-joint arms, where the search comes through most often.
double balance_length(const Arm& arm) {
  const double length = (arm.flange() * arm.tool()).translation().norm() + chain_length(arm);
  return length > 0.0 ? 0.2 * length : 1.0;
}

}  // namespace

InverseProblem::InverseProblem(const Arm& arm, const InverseOptions& options)
    : program(arm),
      lower(arm.lower().begin(), arm.lower().end()),
      upper(arm.upper().begin(), arm.upper().end()),
      turns(find_turns(arm)),
      wraps(size()),
      middle(size()),
      reach(longest_reach(arm)),
      max_iterations(options.max_iterations) {
  for (std::size_t j = 0; j < size(); ++j) {
    const double width = upper[j] - lower[j];
    wraps[j] = turns[j] != 0 && width >= kTurn ? 1 : 0;
    middle[j] =
        std::isfinite(width) ? 0.5 * (lower[j] + upper[j]) : std::clamp(0.0, lower[j], upper[j]);
  }
  const bool paper = options.method == InverseMethod::kPseudoInverse;
  position_tolerance = options.position_tolerance.value_or(paper ? kPaperTolerance : kTolerance);
  angle_tolerance = options.angle_tolerance.value_or(paper ? kPaperTolerance : kTolerance);
  task.kind = options.task;
  task.length = balance_length(arm);
  const Vec3 axis = options.axis.normalized();
  std::copy(axis.begin(), axis.end(), task.axis);
}

PlainPose InverseProblem::relative(PlainPose target) const {
  for (int i = 0; i < 3; ++i) {
    target.translation[i] -= program.view.world_from_first.translation[i];
  }
  return target;
}

void InverseProblem::unwind(std::span<const double> reference, double* q) const {
  for (std::size_t j = 0; j < size(); ++j) {
    if (turns[j] == 0) continue;
    double value = q[j] - kTurn * std::round((q[j] - reference[j]) / kTurn);
    if (value > upper[j]) value -= kTurn * std::ceil((value - upper[j]) / kTurn);
    if (value < lower[j]) value += kTurn * std::ceil((lower[j] - value) / kTurn);
    if (value <= upper[j]) q[j] = value;
  }
}

bool InverseProblem::within_limits(const double* q) const {
  for (std::size_t j = 0; j < size(); ++j) {
    if (!(q[j] >= lower[j] && q[j] <= upper[j])) return false;
  }
  return true;
}

}  // namespace bathyal::arm
