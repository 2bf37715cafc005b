// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "bathyal/uvms/joint_spline.hpp"
#include "bathyal/vehicle/simulate.hpp"
#include "bathyal/vehicle/tree/simulate_tree.hpp"
#include "bathyal/workspace/workspace.hpp"

// An underwater vehicle-manipulator system: the arm moves the vehicle that carries it.

namespace bathyal {

/// How the water resists a link: as a cylinder across its axis, strip by strip (Fossen 2011, sect.
/// 8.1; McLain and Rock 1998, for arms). Along the axis it does not.
struct LinkWaterOptions {
  double added_mass = 1.0;  ///< over the mass of the water that the cylinder displaces, 0 or more
  double drag = 1.1;        ///< C_D of the strips' projected area, 0 or more
  int strips = 4;           ///< of each capsule, 1 to 100

  /// \throw std::invalid_argument
  void check() const;
};

/// A vehicle, an arm and what is attached to it as one tree of bodies. The arm, its mount and the
/// capsules that its links are in the water are those of a workspace; the foot and the tool are
/// fixed links. Weight, buoyancy and inertia of a link are those given: 0 is none.
class ArmOnVehicle {
 public:
  /// \throw std::invalid_argument for an arm of more links than BodyTree::kMostLinks, options out
  ///        of range
  ArmOnVehicle(const Vehicle& vehicle, const Workspace& workspace, LinkWaterOptions water = {});

  const Workspace& workspace() const { return workspace_; }
  const BodyTree& tree() const { return tree_; }
  const LinkWaterOptions& water() const { return water_; }

  /// The tree's joints of an arm's coordinates, which follow each joint's multiplier and offset.
  /// \throw std::invalid_argument for q, rates or accelerations of another number
  void set_joints(const std::vector<double>& q, const std::vector<double>& rate,
                  const std::vector<double>& acceleration, TreeJointMotion& motion) const;

  /// Loads of the tree's joints by those of the arm's coordinates, and back.
  /// \throw std::invalid_argument for an arm with joints that mimic others: their drives share the
  ///        load in a way that is not known
  std::vector<double> tree_efforts(const std::vector<double>& efforts) const;
  std::vector<double> coordinate_values(const std::vector<double>& of_links) const;

  /// Of a motion that is carried out: each coordinate's joint and those that mimic it.
  std::vector<double> coordinate_efforts(const std::vector<double>& of_links) const;

 private:
  Workspace workspace_;
  LinkWaterOptions water_;
  BodyTree tree_;
};

/// Rows over time, joined by straight lines, as at the ends beyond them; one row: always.
struct WrenchRows {
  std::vector<double> time = {};  ///< (K,) rising [s]; empty of one row
  std::vector<Vec6> rows = {};    ///< none: zero

  /// \throw std::invalid_argument that names `name`
  void check(const char* name) const;
  Vec6 at(double time) const;
};

struct ArmMotionOptions {
  WrenchFunction wrench = {};  ///< on the vehicle; null: none
  WrenchRows tip_wrench = {};  ///< on the tool at its centre point, along the vehicle's axes
  Vec3 current = Vec3::Zero();
  SimulateTreeOptions steps = {};
};

struct ArmMotionRecord {
  VehicleMotionRecord vehicle;
  std::vector<double> q;       ///< (K, n)
  std::vector<double> effort;  ///< (K, n) that the drives give to carry the motion out [N m, N]
};

/// How vehicle and arm move while the arm carries a motion out, in deep water.
/// \throw std::invalid_argument for a motion of another number of coordinates, and as simulate_tree
ArmMotionRecord simulate_arm_motion(const ArmOnVehicle& system, const VehicleState& start,
                                    const JointSpline& motion, const ArmMotionOptions& options);

}  // namespace bathyal
