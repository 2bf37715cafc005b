// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/workspace/workspace.hpp"

namespace bathyal {

struct ReachMapOptions {
  double voxel = 0.05;  ///< edge of a voxel [m], above 0
  /// Directions of approach: 6 (the faces of a cube), 26 (with its edges and corners), or 98 (each
  /// face's border and middle parted into four).
  int directions = 26;
  /// ReachPostures drawn, 1 to 2²¹; each is swept through all values of the first joint. 0: one for
  /// four voxels, 2¹⁶ at least.
  Index samples = 0;
  std::uint64_t seed = 0;       ///< of the postures
  bool check_clearance = true;  ///< makes `free` and `clearance`
  int num_threads = 0;

  /// \throw std::invalid_argument
  void check() const;
};

/// Where the tip of an arm can be, in the vehicle's frame: a box of cubes around all of its reach.
/// Voxel (i, j, k) is number (i · count[1] + j) · count[2] + k; it reaches from origin + voxel ·
/// (i, j, k) to origin + voxel · (i + 1, j + 1, k + 1). The foot of the arm lies in the middle of
/// one.
struct ReachMap {
  Vec3 origin = Vec3::Zero();  ///< [m]
  double voxel = 0.0;          ///< [m]
  Eigen::Array3i count{0, 0, 0};
  /// Unit vectors along which the tool's z axis is asked to point, in the vehicle's frame.
  std::vector<Vec3> approach;

  /// Of each voxel, 1 where some posture within the limits brings the tip to its middle, in any
  /// orientation and whatever the arm touches there.
  std::vector<std::uint8_t> reached;
  /// 1 where one of the postures found keeps clear of obstacles and of the arm itself, the end of
  /// the tool allowed to touch the scene (TipContact::kAllowed). All 0 without check_clearance.
  std::vector<std::uint8_t> free;
  /// Of each voxel and direction, (voxels, approach.size()): 1 where the tip reaches the voxel's
  /// middle with the tool's z axis along it; of an arm of fewer than five coordinates, which has no
  /// choice, where the axis lies nearest to it. Collisions are not looked at.
  std::vector<std::uint8_t> reached_along;
  std::vector<std::uint8_t> directions;  ///< how many of them
  /// Greatest √det(J Jᵀ) (Yoshikawa 1985; Manipulability::kYoshikawa) of the postures found with
  /// the tip in the voxel; NaN where it is not reached.
  std::vector<float> manipulability;
  /// Greatest Clearance::distance, or self_distance where that is less, of the postures looked at
  /// [m]: at most eleven, and no more once one is free; NaN where it is not reached, and without
  /// check_clearance.
  std::vector<float> clearance;

  std::size_t total() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
           static_cast<std::size_t>(count[2]);
  }
  /// Of the voxel that a point lies in; −1 outside of the box.
  Index index_of(const Vec3& point) const;
  Vec3 middle(Index index) const;
};

/// The reach of a workspace's arm, at time 0 where something moves, by forward sampling
/// (Zacharias, Borst, Hirzinger 2007, Capturing robot workspace structure).
///
/// ReachPostures of low discrepancy are swept through the range of the first joint, so that each
/// serves a whole circle (or line) of voxels. A posture whose tip lies in a voxel proves that the
/// voxel's middle is reached where the first-order step to it stays within the limits and is short.
/// From there the reached part of each direction grows voxel by voxel: inverse kinematics starts at
/// the posture of a neighbour, until all that border on the reached part have failed.
///
/// The same bytes for any number of threads.
/// \throw std::invalid_argument for options out of range, or more than 2²⁸ pairs of voxel and
///        direction.
ReachMap reach_map(const Workspace& workspace, const ReachMapOptions& options = {});

}  // namespace bathyal
