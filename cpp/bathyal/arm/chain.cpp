// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
constexpr double kOnAxis = 1e-13;  // [m] a link's frame this near to its axis counts as on it

/// A directed line: an axis.
struct Line {
  Vec3 point;
  Vec3 direction;  // unit
};

Line operator*(const Pose& target_from_source, const Line& line) {
  return {target_from_source * line.point, target_from_source.linear() * line.direction};
}

/// A rotation whose z axis is `z` (unit), by permuting axes where `z` is one of them: the identity
/// for z.
Eigen::Matrix3d rotation_with_z(const Vec3& z) {
  Index largest = 0;
  z.cwiseAbs().maxCoeff(&largest);
  const Vec3 guess = Vec3::Unit((largest + 1) % 3);
  Eigen::Matrix3d rotation;
  rotation.col(0) = (guess - guess.dot(z) * z).normalized();
  rotation.col(1) = z.cross(rotation.col(0));
  rotation.col(2) = z;
  return rotation;
}

/// The direction of a row's x axis in (-pi/2, pi/2]; `x`, `y` need not be of unit length.
double half_turn_angle(double x, double y) {
  if (x == 0.0 && y == 0.0) return 0.0;
  // A normal along y but for a file's rounded digits must not flip from joint to joint.
  const double nearly_zero = 1e-6 * std::hypot(x, y);
  if (x > nearly_zero || (x >= -nearly_zero && y > 0.0)) return std::atan2(y, x);
  return std::atan2(-y, -x);
}

/// The row from a frame whose z axis is one axis to a frame whose z axis is `next`, given in the
/// first: the common normal is x.
DhRow row_of_normal(const Line& next) {
  const Vec3& z = next.direction;
  DhRow row;
  row.theta = half_turn_angle(-z.y(), z.x());
  const double c = std::cos(row.theta), s = std::sin(row.theta);
  const double across = c * z.y() - s * z.x();  // -sin(alpha)
  row.alpha = std::atan2(-across, z.z());
  row.a = c * next.point.x() + s * next.point.y();
  const double along = (s * next.point.x() - c * next.point.y()) / across;
  row.d = next.point.z() + along * z.z();
  return row;
}

/// The same for nearly parallel axes (Hayati, Mirmirani 1985): x runs to where `next` meets the
/// plane z = 0.
DhRow row_of_parallel(const Line& next) {
  const Vec3& z = next.direction;
  Vec3 foot = next.point - next.point.z() / z.z() * z;
  if (foot.head<2>().norm() <= kRounding * next.point.norm()) foot.setZero();
  DhRow row;
  row.theta = half_turn_angle(foot.x(), foot.y());
  const double c = std::cos(row.theta), s = std::sin(row.theta);
  row.a = c * foot.x() + s * foot.y();
  row.beta = std::asin(std::clamp(c * z.x() + s * z.y(), -1.0, 1.0));
  row.alpha = std::atan2(s * z.x() - c * z.y(), z.z());
  return row;
}

DhRow row_to(const Line& next, double nearly_parallel) {
  const double sine = next.direction.head<2>().norm();
  return sine < nearly_parallel || sine <= kRounding ? row_of_parallel(next) : row_of_normal(next);
}

/// Zeros without a sign, for tables that people read.
DhRow unsigned_zeros(const DhRow& row) {
  return {row.a + 0.0, row.alpha + 0.0, row.d + 0.0, row.theta + 0.0, row.beta + 0.0};
}

/// The row that ends the table: along and about the last axis only, to the frame of the last link.
DhRow last_row(const Pose& frame) {
  const Eigen::Matrix3d turn = frame.linear() * rotation_with_z(frame.linear().row(2));
  DhRow row;
  row.theta = std::atan2(turn(1, 0), turn(0, 0));
  row.d = frame.translation().z();
  return row;
}

void check_chain(const JointChain& chain) {
  if (chain.links.size() != chain.joints.size() + 1) {
    throw_argument("links", std::to_string(chain.joints.size() + 1) + ", one more than joints",
                   std::to_string(chain.links.size()));
  }
  for (const ChainJoint& joint : chain.joints) {
    const std::string name = "joint " + joint.joint.name;
    check_rigid(name + " origin", joint.parent_from_joint);
    if (joint.joint.type == JointType::kFixed) continue;
    if (!(joint.axis.stableNorm() > 0.0) || !joint.axis.allFinite()) {
      throw_argument(name + " axis", "a direction of finite length other than 0",
                     to_text(joint.axis.x()) + ", " + to_text(joint.axis.y()) + ", " +
                         to_text(joint.axis.z()));
    }
  }
}

Link with_attached(const ChainLink& link) {
  Link whole = link.link;
  for (const Attached& attached : link.attached) {
    attach(whole, attached.link_from_body, attached.body);
  }
  return whole;
}

/// The chain without its fixed joints.
struct MovingChain {
  std::vector<Joint> joints;
  std::vector<Pose> parent_from_joint;
  std::vector<Vec3> axis;   // unit
  std::vector<Link> links;  // one more than joints
  Pose last_from_flange = Pose::Identity();
};

MovingChain without_fixed(const JointChain& chain) {
  MovingChain moving;
  moving.links.push_back(with_attached(chain.links[0]));
  Pose moving_from_here = Pose::Identity();  // from the link before to the last one that moves
  for (std::size_t k = 0; k < chain.joints.size(); ++k) {
    const ChainJoint& joint = chain.joints[k];
    moving_from_here = moving_from_here * joint.parent_from_joint;
    Link behind = with_attached(chain.links[k + 1]);
    if (joint.joint.type == JointType::kFixed) {
      attach(moving.links.back(), moving_from_here, behind);
      continue;
    }
    moving.joints.push_back(joint.joint);
    moving.parent_from_joint.push_back(moving_from_here);
    moving.axis.push_back(joint.axis.stableNormalized());
    moving.links.push_back(std::move(behind));
    moving_from_here.setIdentity();
  }
  moving.last_from_flange = moving_from_here;
  return moving;
}

/// A frame on the first axis: that of the base, where it is there already.
Pose first_frame(const Line& axis) {
  const Vec3 off = axis.point - axis.point.z() * axis.direction;
  if (axis.direction == Vec3::UnitZ() && off.norm() == 0.0) return Pose::Identity();
  Pose frame = Pose::Identity();
  frame.linear() = rotation_with_z(axis.direction);
  frame.translation() = axis.point;
  return frame;
}

/// Where joint k turns or slides, in the frame of the link before it.
Line axis_before(const MovingChain& chain, std::size_t k) {
  return chain.parent_from_joint[k] * Line{Vec3::Zero(), chain.axis[k]};
}

void move(std::vector<Shape>& shapes, const Pose& new_from_link) {
  for (Shape& shape : shapes) shape.body_from_shape = new_from_link * shape.body_from_shape;
}

/// `link` in another frame.
Link in_frame(const Link& link, const Pose& new_from_link) {
  Link moved = link;
  moved.body = bathyal::in_frame(link.body, new_from_link);
  for (Frame& frame : moved.frames) frame.link_from_frame = new_from_link * frame.link_from_frame;
  move(moved.collision, new_from_link);
  move(moved.visual, new_from_link);
  return moved;
}

template <class Thing>
void append(std::vector<Thing>& things, const std::vector<Thing>& more) {
  things.insert(things.end(), more.begin(), more.end());
}

/// Its frames as bodies without mass.
ChainLink with_frames_apart(Link link) {
  ChainLink apart;
  for (Frame& frame : std::exchange(link.frames, {})) {
    Attached attached;
    attached.link_from_body = frame.link_from_frame;
    attached.body.name = std::move(frame.name);
    apart.attached.push_back(std::move(attached));
  }
  apart.link = std::move(link);
  return apart;
}

/// Whether a link whose frame is `before_from_link` while its joint is at 0 may keep it.
bool lies_on_axis(JointType type, const Pose& before_from_link) {
  return type != JointType::kRevolute || before_from_link.translation().head<2>().norm() <= kOnAxis;
}

}  // namespace

void attach(Link& link, const Pose& link_from_body, const Link& body) {
  const Link here = in_frame(body, link_from_body);
  link.body = combined(link.body, here.body);
  if (!body.name.empty()) link.frames.push_back({body.name, link_from_body});
  append(link.frames, here.frames);
  append(link.collision, here.collision);
  append(link.visual, here.visual);
}

void ChainOptions::check() const { check_range("nearly_parallel", nearly_parallel, 0.0, 0.5); }

Arm arm_from_chain(const JointChain& chain, const ChainOptions& options) {
  options.check();
  check_chain(chain);
  MovingChain moving = without_fixed(chain);
  const std::size_t count = moving.joints.size();
  if (count == 0) throw_argument("joints", "at least one that moves", "none");

  const Pose root = first_frame(axis_before(moving, 0));
  moving.links[0].row_from_link = root.inverse();
  Pose before_from_link = moving.links[0].row_from_link;  // of the link before the joint
  for (std::size_t k = 0; k < count; ++k) {
    const Pose before_from_joint = before_from_link * moving.parent_from_joint[k];
    DhRow& row = moving.joints[k].row;
    row = unsigned_zeros(k + 1 < count ? row_to(before_from_joint * axis_before(moving, k + 1),
                                                options.nearly_parallel)
                                       : last_row(before_from_joint));
    // What rounding takes from the row stays in the link's frame: errors do not add up.
    const Pose row_from_before = row_pose(row, moving.joints[k].type, 0.0).inverse();
    before_from_link = row_from_before * before_from_joint;
    moving.links[k + 1].row_from_link = before_from_link;
  }
  return Arm(chain.name, std::move(moving.joints), std::move(moving.links), root,
             before_from_link * moving.last_from_flange);
}

JointChain chain_from_arm(const Arm& arm) {
  JointChain chain;
  chain.name = arm.name();
  const std::vector<Link>& links = arm.links();
  Pose parent_from_row = arm.root();  // the row's frame in that of the link before the joint
  chain.links.push_back(with_frames_apart(in_frame(links[0], arm.root() * links[0].row_from_link)));
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const Joint& joint = arm.joints()[k];
    const Pose before_from_row = row_pose(joint.row, joint.type, 0.0);
    const Pose before_from_own = before_from_row * links[k + 1].row_from_link;
    Pose before_from_link = Pose::Identity();
    if (lies_on_axis(joint.type, before_from_own)) before_from_link = before_from_own;
    const Pose link_from_before = before_from_link.inverse();

    ChainJoint chain_joint;
    chain_joint.joint = joint;
    chain_joint.parent_from_joint = parent_from_row * before_from_link;
    chain_joint.axis = link_from_before.linear().col(2);
    chain.joints.push_back(std::move(chain_joint));
    chain.links.push_back(
        with_frames_apart(in_frame(links[k + 1], link_from_before * before_from_own)));
    parent_from_row = link_from_before * before_from_row;
  }
  ChainJoint flange;
  flange.joint.type = JointType::kFixed;
  flange.parent_from_joint = parent_from_row * arm.flange();
  chain.joints.push_back(std::move(flange));
  chain.links.emplace_back();
  return chain;
}

}  // namespace bathyal
