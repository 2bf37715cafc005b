// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "bathyal/workspace/workspace.hpp"

namespace bathyal::workspace {

/// Where a vehicle's hull keeps clear of what is fixed to the world.
class HullRoom {
 public:
  /// `area`: of the vehicle's origins that will be asked for.
  HullRoom(const Surroundings& surroundings, double clearance, const Eigen::AlignedBox3d& area,
           int num_threads);

  /// A first look, over heights of the bottom in a raster: false where the hull surely or probably
  /// has no room.
  bool seems_clear(const Pose& world_from_vehicle) const;

  /// Decides. One thread.
  bool clear(const Pose& world_from_vehicle) const;

 private:
  bool above_bottom(const Pose& world_from_vehicle) const;
  bool clear_of_bottom(const Pose& world_from_vehicle) const;
  bool clear_of(const KeepOut& keepout, const Pose& world_from_vehicle) const;
  double height(const Vec3& point) const;

  const Surroundings* surroundings_;
  double clearance_;
  std::vector<Vec3> vertices_;                     ///< of the hull, each once
  std::vector<std::pair<Index, Index>> edges_;     ///< of the hull, each once
  std::vector<Vec3> support_;                      ///< some vertices, far from each other
  std::vector<KeepOut> keepouts_;                  ///< fixed to the world
  std::vector<std::vector<Vec3>> keepout_points_;  ///< of each: middle, corners, rims
  std::vector<std::vector<std::array<Vec3, 2>>> keepout_lines_;  ///< of each: edges, generators
  std::vector<std::array<Vec3, 2>> bottom_;  ///< edges of the scene near to the area
  double top_;                               ///< greatest height of the scene
  Eigen::Vector2d raster_origin_ = Eigen::Vector2d::Zero();
  double raster_step_ = 1.0;
  Index raster_rows_ = 0, raster_columns_ = 0;
  std::vector<double> raster_;
};

}  // namespace bathyal::workspace
