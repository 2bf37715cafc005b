// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/arm/arm.hpp"

// An arm as URDF describes it, by joint origins and axes, and the conversion to rows and back.

namespace bathyal {

/// A joint between two links. `joint.row` is not looked at.
struct ChainJoint {
  Joint joint;
  /// The frame of the link behind the joint, while the joint's value is 0, in that of the link
  /// before it.
  Pose parent_from_joint = Pose::Identity();
  /// In the frame of the link behind; through its origin. Any length but zero.
  Vec3 axis = Vec3::UnitZ();
};

/// A body that is fixed to a link without being one: a gripper's finger, a camera.
struct Attached {
  Pose link_from_body = Pose::Identity();
  Link body;
};

/// A link of a chain; `link.row_from_link` is not looked at.
struct ChainLink {
  Link link;
  std::vector<Attached> attached;
};

/// A serial chain: links[0], joints[0], links[1] … The base is the frame of links[0], the flange
/// that of the last link.
struct JointChain {
  std::string name;
  std::vector<ChainJoint> joints;
  std::vector<ChainLink> links;
};

struct ChainOptions {
  /// Neighbouring axes whose directions have a sine below this take Hayati's row [0 to 0.5]; 0
  /// leaves that to axes that are parallel but for rounding: a plain table, whose d grows beyond
  /// measure with nearly parallel axes.
  double nearly_parallel = kNearlyParallel;

  void check() const;
};

/// The arm that moves as the chain does, to rounding, links included.
///
/// Rows follow the common normals of neighbouring axes (Denavit, Hartenberg 1955); of the two
/// tables that describe one normal (theta and alpha turned round, a negated) the one with theta in
/// (-pi/2, pi/2] (to 1e-6). Neighbours within `nearly_parallel` of parallel or antiparallel take
/// Hayati's row, in which d is 0 and beta tilts the axis; coincident ones among them have a = theta
/// = 0. Where the z axis of links[0] is the first axis, `root` is the identity. The last row ends
/// in the origin of the last link that moves, turned about its axis only; the rest is `flange`.
///
/// Fixed joints vanish: the link behind one becomes a frame of the link before it, its mass,
/// inertia, volume and centres are added up.
/// \throw std::invalid_argument for what Arm refuses, an axis without direction, an origin that is
///        not rigid, a number of links other than joints + 1.
Arm arm_from_chain(const JointChain& chain, const ChainOptions& options = {});

/// The chain that moves as the arm does, `base` and `tool` left out. Every row is one joint (fixed
/// ones stay). A link keeps its own frame where that lies on the axis of its joint, as in a
/// chain it must; elsewhere the frame is that before the row, turned with the joint, its z along
/// the axis. The frames of links become attached bodies without mass. The last link is the flange,
/// behind a fixed joint without a name.
JointChain chain_from_arm(const Arm& arm);

/// `link` and `body` as one (`combined`), in the frame of `link`. The body's name and frames become
/// frames of the link, its shapes the link's.
void attach(Link& link, const Pose& link_from_body, const Link& body);

}  // namespace bathyal
