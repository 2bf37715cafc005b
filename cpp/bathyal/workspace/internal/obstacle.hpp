// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <string>
#include <variant>

#include "bathyal/scene/scene.hpp"
#include "bathyal/workspace/capsule.hpp"
#include "bathyal/workspace/hull.hpp"
#include "bathyal/workspace/keepout.hpp"

namespace bathyal::workspace {

/// Where a capsule comes nearest to an obstacle, in the obstacle's frame.
struct Nearness {
  /// From surface to surface [m]. Where the capsule's axis meets the obstacle's surface or lies
  /// inside: minus the radius and the depth of the deeper end (of a convex keep-out: of the deepest
  /// point of the axis).
  double distance = std::numeric_limits<double>::infinity();
  Vec3 axis_point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 surface_point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// The frame that an obstacle is fixed to: a link's index, or one of these.
inline constexpr int kVehicleFrame = -1;
inline constexpr int kWorldFrame = -2;

/// One thing that an arm must not touch.
class Obstacle {
 public:
  explicit Obstacle(Hull hull);
  Obstacle(KeepOut keepout, int frame);
  /// The bottom and what lies on it. Below a surface that faces up is inside: of the bottom, and of
  /// closed bodies.
  explicit Obstacle(Scene scene);

  const std::string& name() const { return name_; }
  bool is_hull() const { return std::holds_alternative<Hull>(body_); }
  bool is_scene() const { return std::holds_alternative<Scene>(body_); }
  bool is_keepout() const { return std::holds_alternative<KeepOut>(body_); }
  /// Around a hull, a scene or a mesh; empty of other keep-outs.
  const Eigen::AlignedBox3d& box() const { return box_; }
  int frame() const { return frame_; }
  /// In that frame: at rest but for keep-outs that move.
  const Trajectory& motion() const { return motion_; }
  bool moved() const { return motion_.moves() || !motion_.pose().front().matrix().isIdentity(0.0); }

  /// Of a capsule in the obstacle's frame. What is farther than `within` is not looked for.
  Nearness nearest(const Capsule& capsule,
                   double within = std::numeric_limits<double>::infinity()) const;

 private:
  bool holds(const Vec3& point) const;
  Nearness nearest_of_surface(const Scene& surface, const Capsule& capsule, double within) const;

  std::string name_;
  int frame_;
  Trajectory motion_;
  std::variant<Hull, KeepOut, Scene> body_;
  Eigen::AlignedBox3d box_;  ///< empty of convex keep-outs
};

}  // namespace bathyal::workspace
