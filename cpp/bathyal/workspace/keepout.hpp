// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bathyal/geometry/plane.hpp"
#include "bathyal/geometry/pose.hpp"
#include "bathyal/geometry/trajectory.hpp"
#include "bathyal/workspace/hull.hpp"

namespace bathyal {

enum class KeepOutKind { kSphere, kBox, kCylinder, kCone, kHalfSpace, kMesh };

/// "sphere", "box", "cylinder", "cone", "half_space" or "mesh".
std::string to_string(KeepOutKind kind);

/// What a keep-out is fixed to and called. Neither may be empty.
struct KeepOutLabel {
  std::string frame = "hull";  ///< "hull" (the vehicle's frame), "world", or the name of a link
  std::optional<std::string> name{};  ///< unless given, that of the kind
};

/// A volume that an arm must stay out of. Points and distances are in the frame that it names [m];
/// a distance is below 0 inside. All but the mesh are convex, and their distances exact, inside
/// too. Immutable, cheap to copy.
class KeepOut {
 public:
  static KeepOut sphere(double radius, const Vec3& center, KeepOutLabel label = {});

  /// `size`: full lengths along x, y and z of the box's own frame, the middle in its origin.
  static KeepOut box(const Vec3& size, const Pose& frame_from_box, KeepOutLabel label = {});

  /// Along z of its own frame, the middle in its origin.
  static KeepOut cylinder(double radius, double length, const Pose& frame_from_cylinder,
                          KeepOutLabel label = {});

  /// Apex in the origin of its own frame; opens along +z up to a flat end of `radius` at z =
  /// `length`: an optical modem's beam.
  static KeepOut cone(double radius, double length, const Pose& frame_from_cone,
                      KeepOutLabel label = {});

  /// All points with normal · x ≤ offset: the normal points to where it is free.
  static KeepOut half_space(const Plane& border, KeepOutLabel label = {});

  /// Inside as Hull has it.
  static KeepOut mesh(Hull hull, KeepOutLabel label = {});

  /// The same volume carried along: what was given in the frame is moved by `frame_from_given`, a
  /// pose over time. An obstacle that moves.
  KeepOut moved(Trajectory frame_from_given) const;

  /// At rest in the identity unless moved.
  const Trajectory& motion() const { return motion_; }

  KeepOutKind kind() const { return kind_; }
  const std::string& frame() const { return frame_; }
  const std::string& name() const { return name_; }
  bool convex() const { return kind_ != KeepOutKind::kMesh; }

  double radius() const { return radius_; }                  ///< sphere, cylinder, cone [m]
  double length() const { return length_; }                  ///< cylinder, cone [m]
  const Vec3& size() const { return size_; }                 ///< box [m]
  const Pose& pose() const { return frame_from_shape_; }     ///< all but half-space and mesh
  const Plane& border() const { return border_; }            ///< half-space
  const std::optional<Hull>& hull() const { return hull_; }  ///< mesh

  /// distance() ≤ 0 of each point; of a mesh, Hull::contains.
  /// \throw std::invalid_argument for a point that is not finite, or `inside` of another length.
  void contains(PointView points, std::span<bool> inside, int num_threads = 0) const;

  /// Signed distance of each point [m].
  /// \throw std::invalid_argument for a point that is not finite.
  std::vector<double> distance(PointView points, int num_threads = 0) const;

  /// Signed distance of capsules: of the axis from a[i] to b[i], less radius[i]. One that reaches
  /// into the volume has the least distance along its axis, below 0: how far it must move at most;
  /// of a mesh, the depth of the deeper end. Within 1e-12 of the shape's and the axis' size.
  /// \throw std::invalid_argument for a value that is not finite, a radius below 0, or rows that do
  /// not match.
  std::vector<double> capsule_distance(PointView a, PointView b, std::span<const double> radius,
                                       int num_threads = 0) const;

 private:
  KeepOut(KeepOutKind kind, KeepOutLabel label);
  static KeepOut round(KeepOutKind kind, double radius, double length, const Pose& frame_from_shape,
                       KeepOutLabel label);

  KeepOutKind kind_;
  std::string frame_, name_;
  double radius_ = 0.0, length_ = 0.0;
  Vec3 size_ = Vec3::Zero();
  Pose frame_from_shape_ = Pose::Identity();
  Plane border_;
  std::optional<Hull> hull_;
  Trajectory motion_;
};

}  // namespace bathyal
