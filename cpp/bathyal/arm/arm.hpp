// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <limits>
#include <string>
#include <vector>

#include "bathyal/geometry/pose.hpp"
#include "bathyal/geometry/rigid_body.hpp"
#include "bathyal/geometry/shape.hpp"

namespace bathyal {

/// Neighbouring axes whose directions have a sine below this (5.7 degrees) count as nearly
/// parallel: their row has Hayati's beta in place of d. A common normal moves by the arm's length
/// over that sine for each radian of error, so nearer ones leave d and theta ill-determined, while
/// beta stays well-determined far beyond; and no arm is built askew by as much.
inline constexpr double kNearlyParallel = 0.1;

enum class JointType { kRevolute, kPrismatic, kFixed };

/// One row of a Denavit-Hartenberg table in the standard (distal) convention, with Hayati and
/// Mirmirani's fifth angle (1985) for neighbouring axes that are nearly parallel:
///   previous_from_this = Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta)
/// (Yukhimets, Gubankov 2023, eq 2, where beta is 0). A revolute joint adds its value to theta, a
/// prismatic one to d. Metres and radians.
struct DhRow {
  double a = 0.0;
  double alpha = 0.0;
  double d = 0.0;
  double theta = 0.0;
  double beta = 0.0;
};

/// A joint and the row behind it. Its value is multiplier * q[coordinate] + offset: a mimic joint
/// shares the coordinate of the joint it follows; a fixed one has none (coordinate -1, value 0).
struct Joint {
  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();

  std::string name;
  JointType type = JointType::kRevolute;
  DhRow row;
  int coordinate = -1;
  std::string follows;  ///< name of the joint that it mimics; empty for one that leads
  double multiplier = 1.0;
  double offset = 0.0;
  double lower = -kUnlimited;  ///< of the joint's value [rad] or [m]; a joint without limits wraps
  double upper = kUnlimited;
  double velocity = kUnlimited;  ///< [rad/s] or [m/s]
  double effort = kUnlimited;    ///< [N m] or [N]
};

/// A named place on a link: what a URDF calls a link and joins by a fixed joint.
struct Frame {
  std::string name;
  Pose link_from_frame = Pose::Identity();
};

/// What hangs on the frame behind a row: link 0 is the foot, before any joint; link k moves with
/// joint k - 1. All but `row_from_link` is given in the link's own frame.
struct Link {
  std::string name;
  Pose row_from_link = Pose::Identity();  ///< from the link's frame to the frame of its row
  RigidBody body;
  std::vector<Frame> frames;     ///< that move with it; `body` includes what they weigh
  std::vector<Shape> collision;  ///< what must not touch anything, frames' too
  std::vector<Shape> visual;     ///< what it looks like
};

/// A serial arm: world_from_tool = base * root * row 1 * … * row m * flange * tool.
/// `base` (world_from_base) and `tool` (flange_from_tool) are the user's; `root` and `flange`
/// belong to the arm: what lies before the first row and behind the last (of a URDF, of a table in
/// the modified convention).
class Arm {
 public:
  /// `links` may be empty (nameless, massless links are made) or one more than `joints`.
  /// Coordinates count 0 … n - 1 in the order in which joints first use them. (The first one may
  /// follow a joint that is not part of the arm: a lifting column's stages, its drive.)
  /// \throw std::invalid_argument for no moving joint, a value that is not finite, limits that are
  ///        crossed, coordinates that skip a number, a transform that is not rigid.
  Arm(std::string name, std::vector<Joint> joints, std::vector<Link> links = {},
      const Pose& root = Pose::Identity(), const Pose& flange = Pose::Identity());

  const std::string& name() const { return name_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<Link>& links() const { return links_; }
  const Pose& root() const { return root_; }
  const Pose& flange() const { return flange_; }

  /// Where the name and the numbers come from, one sentence; empty when unknown.
  const std::string& source() const { return source_; }
  void set_source(std::string source) { source_ = std::move(source); }

  const Pose& base() const { return base_; }  ///< world_from_base
  const Pose& tool() const { return tool_; }  ///< flange_from_tool
  void set_base(const Pose& world_from_base);
  void set_tool(const Pose& flange_from_tool);

  /// Number of coordinates n, the width of every q.
  Index size() const { return size_; }

  /// Limits of each coordinate: those of its joint and of all that follow it, intersected.
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }

 private:
  std::string name_;
  std::vector<Joint> joints_;
  std::vector<Link> links_;
  Pose root_;
  Pose flange_;
  Pose base_ = Pose::Identity();
  Pose tool_ = Pose::Identity();
  std::string source_;
  Index size_ = 0;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
};

/// Lengths of all rows together, flange and tool left out, sliding joints at rest [m].
double chain_length(const Arm& arm);

}  // namespace bathyal
