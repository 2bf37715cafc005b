// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

enum class ShapeKind { kBox, kCylinder, kSphere, kMesh };

/// The outline of a body, or a part of it, as a robot's file gives it: for collisions or for the
/// eye. A mesh is the name of its file; nothing here opens it.
struct Shape {
  ShapeKind kind = ShapeKind::kBox;
  Vec3 size = Vec3::Zero();   ///< of a box: its full lengths along x, y and z [m]
  double radius = 0.0;        ///< of a cylinder or sphere [m]
  double length = 0.0;        ///< of a cylinder, along z, its middle in the origin [m]
  std::string file;           ///< of a mesh: as its owner's file names it
  std::string folder;         ///< from which a relative `file` starts; empty is unknown
  Vec3 scale = Vec3::Ones();  ///< of a mesh, along its x, y and z; negative mirrors
  Pose body_from_shape = Pose::Identity();
  std::string part;  ///< the body that it outlines, where several were made one: a finger

  /// Messages begin with `owner`, where it is not empty.
  /// \throw std::invalid_argument for a length that is negative or not finite (0 is a flat box), a
  ///        mesh without a file, a scale of 0 or not finite, a pose that is not rigid.
  void check(std::string_view owner = {}) const;
};

}  // namespace bathyal
