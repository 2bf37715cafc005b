// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
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
  Arm arm;  ///< its base in the vehicle's frame
  Pose vehicle_from_world = Pose::Identity();
  std::vector<LinkCapsule> capsules{};
  std::vector<Obstacle> obstacles{};
  std::vector<Pair> with_obstacles{};
  std::vector<Pair> with_capsules{};  ///< the first capsule is of the later link
  std::vector<ExcludedPair> excluded{};

  int link_of(std::size_t capsule) const { return capsules[capsule].link; }
};

/// \throw std::invalid_argument as Workspace.
Bodies make_bodies(Arm arm, const Surroundings& surroundings);

/// The arm in one posture: frames and capsules in the vehicle's frame. Its memory is used again.
class Posture {
 public:
  explicit Posture(const Bodies& bodies) : bodies_(&bodies), placed_(bodies.capsules.size()) {}

  void set(std::span<const double> q);

  const RowFrames& frames() const { return frames_; }
  const Capsule& capsule(std::size_t index) const { return placed_[index]; }

  /// Points of the answer are in the vehicle's frame.
  Nearness to_obstacle(const Pair& pair, double within) const;
  double to_capsule(const Pair& pair) const {
    return distance(placed_[pair.capsule], placed_[pair.other]);
  }

 private:
  const Bodies* bodies_;
  RowFrames frames_;
  std::vector<Capsule> placed_;
};

}  // namespace bathyal::workspace
