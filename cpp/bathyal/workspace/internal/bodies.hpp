// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/workspace/arm_shape.hpp"
#include "bathyal/workspace/internal/obstacle.hpp"
#include "bathyal/workspace/workspace.hpp"

namespace bathyal::workspace {

/// Two things that are compared: a capsule, and an obstacle or another capsule (indices).
struct Pair {
  std::size_t capsule = 0;
  std::size_t other = 0;
};

/// The bodies of a workspace and which of them are compared.
struct Bodies {
  Arm arm;                       ///< its base in the vehicle's frame
  Vec6 pose_std = Vec6::Zero();  ///< of world_from_vehicle
  double angle_std = 0.0;        ///< the greatest of its rotation [rad]
  /// Those of the arm, then what of them touches the scene only by mistake: those of the last link
  /// without the end of the tool.
  std::vector<LinkCapsule> capsules{};
  std::vector<Obstacle> obstacles{};
  std::vector<Pair> with_obstacles{};          ///< with TipContact::kForbidden
  std::vector<Pair> with_obstacles_but_tip{};  ///< with TipContact::kAllowed
  std::vector<Pair> with_capsules{};           ///< the first capsule is of the later link
  std::vector<ExcludedPair> excluded{};

  int link_of(std::size_t capsule) const { return capsules[capsule].link; }
  const std::vector<Pair>& obstacle_pairs(TipContact contact) const {
    return contact == TipContact::kAllowed ? with_obstacles_but_tip : with_obstacles;
  }
  bool is_in_world(std::size_t obstacle) const {
    return obstacles[obstacle].frame() == kWorldFrame;
  }
};

/// Of the last link.
Pose link_from_tool(const Arm& arm);

/// \throw std::invalid_argument as Workspace.
Bodies make_bodies(Arm arm, const Surroundings& surroundings);

/// Workspace::warnings.
std::vector<std::string> plausibility(const Bodies& bodies);

/// By how much less the distance of a point in the vehicle's frame to what is fixed to the world
/// may be: three standard deviations of where the vehicle's uncertain pose takes it, along the
/// direction in which that is greatest (first order) [m]. Convex in the point, and no steeper than
/// 3 `angle_std`.
double pose_margin(const Bodies& bodies, const Vec3& point);

/// The arm at one moment: frames and capsules in the vehicle's frame. Its memory is used again.
class Posture {
 public:
  Posture(const Bodies& bodies, const Trajectory& world_from_vehicle)
      : bodies_(&bodies),
        world_from_vehicle_(&world_from_vehicle),
        placed_(bodies.capsules.size()) {}

  void set(std::span<const double> q, double time);

  const RowFrames& frames() const { return frames_; }
  const Capsule& capsule(std::size_t index) const { return placed_[index]; }

  /// vehicle_from_obstacle at the time.
  Pose obstacle_pose(const Obstacle& obstacle) const;

  /// Points of the answer are in the vehicle's frame; the distance is less by the pose_margin of
  /// what is fixed to the world.
  Nearness to_obstacle(const Pair& pair, double within) const;
  double to_capsule(const Pair& pair) const {
    return distance(placed_[pair.capsule], placed_[pair.other]);
  }

  /// How far points of a capsule can move against an obstacle, by vehicle and obstacle alone, in
  /// `duration` before and after the time [m].
  double drift(const Pair& pair, double duration) const;

 private:
  const Bodies* bodies_;
  const Trajectory* world_from_vehicle_;
  double time_ = 0.0;
  Pose vehicle_from_world_ = Pose::Identity();
  RowFrames frames_;
  std::vector<Capsule> placed_;
};

}  // namespace bathyal::workspace
