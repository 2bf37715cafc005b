// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// Camera axes, one a row: px py pz, a point of the axis [m], and dx dy dz, its direction (any
/// length but zero). Filaretov, Konoplin, Konoplin (2018), eq 2: P and d.
using Aims = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Which frame the aims are given in.
enum class AimsFrame {
  kVehicle,  ///< the paper's: moved by world_from_vehicle
  kWorld     ///< the frame of the survey already
};

/// What "vertical" means where the bottom is cut between two targets.
enum class Vertical {
  kGravity,  ///< the world's z
  kVehicle   ///< the paper's: the vehicle's z, which leans with the vehicle
};

/// The frame that aims refer to: where the vehicle is, and which way is up.
struct AimsReference {
  Pose world_from_vehicle = Pose::Identity();
  AimsFrame frame = AimsFrame::kVehicle;
  Vertical vertical = Vertical::kGravity;

  /// \throw std::invalid_argument when world_from_vehicle is not a rigid motion (to 1e-6).
  void check() const;

  /// Unit vector in the world.
  Vec3 up() const;

  /// The aims in the world frame, directions of unit length.
  /// \throw std::invalid_argument that names the first row which is not finite or has no direction.
  Aims to_world(const Aims& aims) const;
};

}  // namespace bathyal
