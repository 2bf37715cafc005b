// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

/// A fixed link's coordinate and rate are not looked at.
enum class TreeJoint { kRevolute, kPrismatic, kFixed };

/// A piece of a slender body that the water resists across its axis, after Morison:
/// force −coefficient |v| v, v the part across the axis of the water's velocity past its centre.
struct DragStrip {
  Vec3 center = Vec3::Zero();  ///< [m]
  Vec3 axis = Vec3::UnitZ();   ///< unit
  double coefficient = 0.0;    ///< ½ ρ C_D diameter length [kg/m], 0 or more
};

/// A body in water behind a joint. What is not said otherwise is in the link's own frame, which
/// moves with it and whose origin lies on the axis.
struct TreeLink {
  std::string name = {};
  int parent = -1;  ///< an earlier link; −1: the hull
  TreeJoint joint = TreeJoint::kRevolute;
  Pose parent_from_link = Pose::Identity();  ///< while the coordinate is 0
  Vec3 axis = Vec3::UnitZ();                 ///< turned about or slid along; any length but zero
  RigidBody body = {};
  Mat6 added_mass = Mat6::Zero();  ///< about the origin; symmetric, of no negative energy
  std::vector<DragStrip> strips = {};

  /// \throw std::invalid_argument that names the field, after `owner`
  void check(std::string_view owner) const;
};

/// A hull and the links that it carries. Gravity and water density are the hull's.
struct BodyTreeOptions {
  VehicleOptions vehicle;
  std::vector<TreeLink> links = {};  ///< at most BodyTree::kMostLinks
  Vec3 tip = Vec3::Zero();           ///< where a load acts on the last link, in its frame

  /// \throw std::invalid_argument that names the field, and the link
  void check() const;
};

struct BodyTreeState {
  VehicleState base = {};
  std::vector<double> q = {};     ///< one a link [rad, m]
  std::vector<double> rate = {};  ///< [rad/s, m/s]
};

/// What drives the joints.
enum class JointDrive {
  kEffort,       ///< torques [N m] or forces [N] are given, accelerations found
  kAcceleration  ///< accelerations are given, torques found: a motion that is carried out
};

struct TreeLoads {
  Vec6 wrench = Vec6::Zero();      ///< on the hull about its origin, along its axes [N, N m]
  Vec6 tip_wrench = Vec6::Zero();  ///< on the last link, at `tip`, along the hull's axes
  Flow flow = {};                  ///< everywhere the same
  JointDrive drive = JointDrive::kEffort;
  std::vector<double> joints = {};  ///< efforts or accelerations, one a link; empty: zeros
};

struct TreeAcceleration {
  Vec6 base = Vec6::Zero();          ///< dν/dt of the hull, in its frame
  std::vector<double> joints = {};   ///< [rad/s², m/s²]
  std::vector<double> efforts = {};  ///< of the drives, positive along the coordinate [N m, N]
};

/// Momentum in the world, the angular one about its origin.
using Momentum = Vec6;

/// Equations of motion of hull and links as one, each body in water as `Vehicle` is:
/// its added mass in the mass matrix, Coriolis forces of the added mass with the velocity through
/// the water. Solved by articulated bodies (Featherstone, Rigid Body Dynamics Algorithms, 2008,
/// table 9.4), O(links).
class BodyTree {
 public:
  static constexpr std::size_t kMostLinks = 32;

  /// \throw std::invalid_argument as BodyTreeOptions::check
  explicit BodyTree(BodyTreeOptions options);
  ~BodyTree();
  BodyTree(const BodyTree&);
  BodyTree& operator=(const BodyTree&);
  BodyTree(BodyTree&&) noexcept;
  BodyTree& operator=(BodyTree&&) noexcept;

  const BodyTreeOptions& options() const { return *options_; }
  const Vehicle& vehicle() const { return vehicle_; }
  std::size_t size() const;

  /// All coordinates and velocities zero.
  BodyTreeState rest() const;

  /// Allocates nothing where `found` has been used before.
  /// \throw std::invalid_argument for coordinates, rates or joints of another number than links
  void accelerations(const BodyTreeState& state, const TreeLoads& loads,
                     TreeAcceleration& found) const;

  /// Of bodies and the water that they carry, at rest otherwise [J].
  double kinetic_energy(const BodyTreeState& state) const;
  /// Of weight and buoyancy; 0 where the origins are at z = 0 of the world [J].
  double potential_energy(const BodyTreeState& state) const;
  Momentum momentum(const BodyTreeState& state) const;

  /// vehicle_from_link of each link.
  std::vector<Pose> link_poses(const BodyTreeState& state) const;

 private:
  struct Body;     // a link in the frame whose z is the joint's axis
  struct Passing;  // what a link needs from one sweep to the next

  void check_sizes(const BodyTreeState& state) const;
  void outward(const BodyTreeState& state, const TreeLoads& loads, Passing* all) const;
  void push_tip(const TreeLoads& loads, Passing* all) const;

  std::shared_ptr<const BodyTreeOptions> options_;
  Vehicle vehicle_;
  std::vector<Body> links_;
};

}  // namespace bathyal
