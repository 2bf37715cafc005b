// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <string>
#include <vector>

#include "bathyal/geometry/pose.hpp"
#include "bathyal/geometry/rigid_body.hpp"

namespace bathyal {

using Vec6 = Eigen::Matrix<double, 6, 1>;  ///< linear, then angular; force, then moment
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// A part of the hydrodynamic force: coefficient · ν_a · ν_b in the direction `row`, or with |ν_b|
/// where it is `absolute`; ν is the velocity through the water.
struct ForceTerm {
  int row = 0, a = 0, b = 0;  ///< 0 to 5: surge, sway, heave, roll, pitch, yaw
  bool absolute = true;
  double coefficient = 0.0;
};

/// A ball that represents a part of a vehicle where it leaves the water or meets the bottom.
struct VehiclePart {
  Vec3 center = Vec3::Zero();  ///< in the vehicle's frame [m]
  double radius = 0.0;         ///< [m], above 0
  double volume = 0.0;         ///< its share of the water displaced, in any unit; above 0
};

/// A vehicle in water, in its frame: x forward, y port, z up, origin at the centre of buoyancy.
struct VehicleOptions {
  std::string name = "vehicle";
  RigidBody body = {};  ///< mass, centre, inertia, volume; its centre of buoyancy is the origin
  Mat6 added_mass = Mat6::Zero();   ///< symmetric, of no negative energy [kg, kg m, kg m²]
  Mat6 linear_drag = Mat6::Zero();  ///< force is −D ν
  std::vector<ForceTerm> terms = {};
  std::vector<VehiclePart> parts = {};  ///< none: it neither leaves the water nor touches
  double gravity = 9.80665;             ///< [m/s²]
  double water_density = 1025.0;        ///< [kg/m³]

  /// \throw std::invalid_argument that names the field; without mass or inertia, with an added mass
  ///        that is not symmetric or of negative energy, a total that is not positive definite, or
  ///        parts whose volumes do not balance about the origin.
  void check() const;
};

/// How the water moves at a place.
struct Flow {
  Vec3 velocity = Vec3::Zero();      ///< in the world [m/s]
  Vec3 acceleration = Vec3::Zero();  ///< [m/s²]
};

/// Where a vehicle is and how it moves.
struct VehicleState {
  Pose world_from_vehicle = Pose::Identity();
  Vec6 velocity = Vec6::Zero();  ///< over ground, in the vehicle's frame, of its origin
};

/// Directions in which a vehicle is free; in the others its velocity stays as it is.
using FreeAxes = std::array<bool, 6>;
inline constexpr FreeAxes kAllFree{true, true, true, true, true, true};

/// Its equations of motion (Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2nd
/// ed., ch. 6 to 8), the whole added mass in the mass matrix:
///
///   M_RB ν̇ + C_RB(ν) ν + M_A ν̇_r + C_A(ν_r) ν_r + D(ν_r) + g(R) = τ + ρ V a,
///
/// with ν_r the velocity through the water and a the water's acceleration. Water that moves
/// everywhere alike thus carries the vehicle as a frame that moves would.
class Vehicle {
 public:
  /// \throw std::invalid_argument as VehicleOptions::check
  explicit Vehicle(VehicleOptions options);

  const VehicleOptions& options() const { return *options_; }
  const Mat6& mass_matrix() const { return mass_; }  ///< M_RB + M_A

  /// dν/dt. \param wrench force and moment about the origin, in the vehicle's frame [N, N m]
  Vec6 acceleration(const VehicleState& state, const Vec6& wrench, const Flow& flow = {},
                    const FreeAxes& free = kAllFree) const;

  /// mass_matrix() · dν/dt with all axes free.
  Vec6 force(const VehicleState& state, const Vec6& wrench, const Flow& flow = {}) const;

  /// Force and moment of weight and buoyancy, about the origin, in the vehicle's frame.
  Vec6 hydrostatic(const Pose& world_from_vehicle) const;

  /// Force and moment of drag and lift at a velocity through the water.
  Vec6 drag(const Vec6& relative) const;

  /// ½ νᵀ M ν [J]
  double kinetic_energy(const Vec6& velocity) const { return 0.5 * velocity.dot(mass_ * velocity); }

 private:
  std::shared_ptr<const VehicleOptions> options_;
  Mat6 rigid_, mass_;
  Mat6 inverse_;  // of mass_
};

/// The rigid body's own mass matrix about the origin of its frame.
Mat6 mass_matrix(const RigidBody& body);

/// C(ν) ν of a symmetric mass matrix: the Coriolis and centripetal force (Fossen, theorem 3.2).
Vec6 coriolis(const Mat6& mass, const Vec6& velocity);

/// Added mass of an ellipsoid about its centre, half axes along x, y, z [m] (Lamb, Hydrodynamics,
/// 6th ed., art. 114, 115). \throw std::invalid_argument for a half axis that is not above 0.
Mat6 ellipsoid_added_mass(const Vec3& half_axes, double water_density);

}  // namespace bathyal
