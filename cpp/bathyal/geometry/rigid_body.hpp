// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <string_view>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// What a body weighs, how it resists turning, and the water it displaces; in one frame, which the
/// owner names.
struct RigidBody {
  double mass = 0.0;                                  ///< [kg]; 0 is unknown
  Vec3 center_of_mass = Vec3::Zero();                 ///< [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass [kg m²]
  double volume = 0.0;                                ///< displaced [m³]; 0 is unknown
  Vec3 center_of_buoyancy = Vec3::Zero();             ///< [m]

  /// Messages begin with `owner`, where it is not empty: "link forearm mass".
  /// \throw std::invalid_argument for a mass or volume that is negative or not finite, a centre
  ///        that is not finite, and an inertia that no body has: not finite, not symmetric (1e-6 of
  ///        its trace), or with a principal moment above the sum of the two others (by 1e-3 of the
  ///        trace: files round). The latter takes in negative moments. A body may be without mass
  ///        or inertia: unknown.
  void check(std::string_view owner = {}) const;
};

/// The body in the axes and about the origin of another frame.
RigidBody in_frame(const RigidBody& body, const Pose& new_from_body);

/// Two bodies in one frame, fixed to each other: masses and volumes added, centres weighted by
/// them, inertia about the new centre (Steiner). Where neither has a mass (volume), the centre is
/// that of `one`.
RigidBody combined(const RigidBody& one, const RigidBody& other);

}  // namespace bathyal
