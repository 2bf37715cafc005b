// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "bathyal/arm/inverse.hpp"
#include "bathyal/workspace/motion/internal/bounded_least_squares.hpp"
#include "bathyal/workspace/motion/internal/proximity.hpp"

namespace bathyal::workspace {

/// Where the tip is to be, in the vehicle's frame, and what of it counts.
struct TipTarget {
  Pose pose = Pose::Identity();  ///< vehicle_from_tool
  InverseTask task = InverseTask::kPose;
  Vec3 axis = Vec3::UnitZ();  ///< of kPositionAxis: unit, in the tool's frame
};

/// What the tip misses.
struct TipError {
  Vec3 offset = Vec3::Zero();  ///< of the position [m]
  Vec3 turn = Vec3::Zero();    ///< as a rotation vector [rad]; zero for kPosition
  double distance() const { return offset.norm(); }
  double angle() const { return turn.norm(); }
};

TipError tip_error(const Pose& tip, const TipTarget& target);

/// What a step keeps to.
struct StepRules {
  Eigen::VectorXd change;  ///< that each coordinate makes at most [rad], [m]
  double clearance = 0.0;  ///< nearer than this nothing comes [m]
  double influence = 0.0;  ///< from here on approaching is slowed [m], above `clearance`
  double approach = 0.5;   ///< share of the way from a distance to `clearance` taken at most
  TipContact tip_contact = TipContact::kForbidden;
};

/// One step, and the constraints that hold it back.
struct TipStep {
  Eigen::VectorXd change;
  std::vector<NearPair> pairs;  ///< that hold it back
  std::vector<int> limits;      ///< coordinates that are held by the end of their range
};

/// Steps of an arm's coordinates that bring the tip nearer to a target by strict priorities:
/// 1. joint limits and the most that each coordinate may change,
/// 2. no pair of bodies that is nearer than `influence` comes nearer by more than a share of what
///    is over `clearance` (velocity damper: Faverjon, Tournassoud 1987),
/// 3. the position of the tip, 4. its axis or orientation, both damped,
/// 5. away from limits and from what is near, in what the others leave free.
class TipStepper {
 public:
  TipStepper(const Bodies& bodies, const Trajectory& world_from_vehicle, StepRules rules)
      : bodies_(&bodies), posture_(bodies, world_from_vehicle), rules_(std::move(rules)) {}

  void set(const Eigen::VectorXd& q, double time);

  const Eigen::VectorXd& q() const { return q_; }
  const Pose& tip() const { return posture_.frames().world_from_tool; }
  TipError error(const TipTarget& target) const { return tip_error(tip(), target); }

  /// Towards the target by `wanted` (of error(), perhaps shortened); `comfort`, 0 to 1, is how much
  /// of priority 5 is wanted.
  TipStep step(const TipTarget& target, const TipError& wanted, double comfort) const;

 private:
  LinearBounds bounds(const std::vector<NearPair>& pairs) const;

  const Bodies* bodies_;
  Posture posture_;
  StepRules rules_;
  Eigen::VectorXd q_;
};

}  // namespace bathyal::workspace
