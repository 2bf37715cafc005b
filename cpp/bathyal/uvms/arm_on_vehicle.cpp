// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/uvms/arm_on_vehicle.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

/// Puts a cylinder of a capsule's radius and volume into a link.
void add_cylinder(const Capsule& capsule, const LinkWaterOptions& water, double density,
                  TreeLink& link) {
  const double radius = capsule.radius, length = (capsule.end - capsule.start).norm();
  if (!(radius > 0.0)) return;
  const Vec3 axis = length > 0.0 ? Vec3((capsule.end - capsule.start) / length) : Vec3::UnitZ();
  const Vec3 center = 0.5 * (capsule.start + capsule.end);
  const double whole = length + 4.0 / 3.0 * radius, piece = whole / water.strips;
  const double mass = water.added_mass * density * std::numbers::pi * radius * radius * piece;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
  for (int i = 0; i < water.strips; ++i) {
    const Vec3 at = center + ((i + 0.5) * piece - 0.5 * whole) * axis;
    Eigen::Matrix3d lever;  // at × f
    lever << 0.0, -at.z(), at.y(), at.z(), 0.0, -at.x(), -at.y(), at.x(), 0.0;
    Eigen::Matrix<double, 3, 6> velocity;
    velocity << Eigen::Matrix3d::Identity(), -lever;
    Mat6 added = mass * velocity.transpose() * across * velocity;
    // The strip's own length turns with it.
    added.bottomRightCorner<3, 3>() += mass * piece * piece / 12.0 * across;
    link.added_mass += added;
    if (water.drag > 0.0) {
      link.strips.push_back({at, axis, water.drag * density * radius * piece});
    }
  }
}

TreeJoint joint_of(JointType type) {
  if (type == JointType::kFixed) return TreeJoint::kFixed;
  return type == JointType::kPrismatic ? TreeJoint::kPrismatic : TreeJoint::kRevolute;
}

/// Foot, links and tool, in the frames of the arm's rows: the frame after row k - 1 is that of tree
/// link k, but that its joint lies in the frame before. So that the origin is on the axis, a link's
/// frame is the one before its row, turned and shifted by the joint.
BodyTreeOptions tree_of(const Vehicle& vehicle, const Workspace& workspace,
                        const LinkWaterOptions& water) {
  water.check();
  const Arm& arm = workspace.arm();
  BodyTreeOptions options{vehicle.options(), {}, Vec3::Zero()};
  const double density = options.vehicle.water_density;
  std::vector<Pose> link_from_row;  // of each tree link, the frame after its row
  Pose ahead = arm.base() * arm.root();
  for (std::size_t k = 0; k < arm.links().size(); ++k) {
    const Link& body = arm.links()[k];
    TreeLink link;
    link.name = link_name(arm, static_cast<int>(k));
    link.parent = static_cast<int>(k) - 1;
    link.parent_from_link = ahead;
    Pose after = Pose::Identity();
    if (k == 0) {
      link.joint = TreeJoint::kFixed;
    } else {
      const Joint& joint = arm.joints()[k - 1];
      link.joint = joint_of(joint.type);
      after = row_pose(joint.row, joint.type, 0.0);
    }
    link.body = in_frame(body.body, after * body.row_from_link);
    link_from_row.push_back(after);
    ahead = after;
    options.links.push_back(std::move(link));
  }
  TreeLink tool;
  tool.name = "tool";
  tool.parent = static_cast<int>(options.links.size()) - 1;
  tool.joint = TreeJoint::kFixed;
  tool.parent_from_link = ahead * arm.flange() * arm.tool();
  tool.body = workspace.attached();
  for (const Capsule& capsule : workspace.attached_capsules()) {
    add_cylinder(capsule, water, density, tool);
  }
  for (const LinkCapsule& capsule : workspace.surroundings().capsules) {
    // What a sliding joint draws out is taken as it is with the joint at 0.
    const auto at = static_cast<std::size_t>(capsule.link);
    const Link& body = arm.links()[at];
    const Pose own = link_from_row[at] * body.row_from_link;
    Vec3 start = own * capsule.start;
    if (capsule.start_link != capsule.link) {
      const auto before = static_cast<std::size_t>(capsule.start_link);
      start = options.links[at].parent_from_link.inverse() * link_from_row[before] *
              arm.links()[before].row_from_link * capsule.start;
    }
    add_cylinder({start, own * capsule.end, capsule.radius}, water, density, options.links[at]);
  }
  options.links.push_back(std::move(tool));
  return options;
}

}  // namespace

void LinkWaterOptions::check() const {
  check_not_negative("added_mass", added_mass);
  check_not_negative("drag", drag);
  check_range("strips", strips, 1, 100);
}

ArmOnVehicle::ArmOnVehicle(const Vehicle& vehicle, const Workspace& workspace,
                           LinkWaterOptions water)
    : workspace_(workspace), water_(water), tree_(tree_of(vehicle, workspace, water)) {}

void ArmOnVehicle::set_joints(const std::vector<double>& q, const std::vector<double>& rate,
                              const std::vector<double>& acceleration,
                              TreeJointMotion& motion) const {
  const Arm& arm = workspace_.arm();
  const auto check = [&](const char* name, const std::vector<double>& values) {
    if (values.size() == static_cast<std::size_t>(arm.size())) return;
    throw_argument(name, std::to_string(arm.size()) + " numbers", std::to_string(values.size()));
  };
  check("q", q);
  check("rate", rate);
  check("acceleration", acceleration);
  motion.q.assign(tree_.size(), 0.0);
  motion.rate.assign(tree_.size(), 0.0);
  motion.acceleration.assign(tree_.size(), 0.0);
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const Joint& joint = arm.joints()[k];
    if (joint.coordinate < 0) continue;
    const auto c = static_cast<std::size_t>(joint.coordinate);
    motion.q[k + 1] = joint.multiplier * q[c] + joint.offset;
    motion.rate[k + 1] = joint.multiplier * rate[c];
    motion.acceleration[k + 1] = joint.multiplier * acceleration[c];
  }
}

std::vector<double> ArmOnVehicle::tree_efforts(const std::vector<double>& efforts) const {
  const Arm& arm = workspace_.arm();
  if (efforts.size() != static_cast<std::size_t>(arm.size())) {
    throw_argument("torque", std::to_string(arm.size()) + " numbers",
                   std::to_string(efforts.size()));
  }
  std::vector<double> all(tree_.size(), 0.0);
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const Joint& joint = arm.joints()[k];
    if (joint.coordinate < 0) continue;
    if (!joint.follows.empty()) {
      throw_argument("torque", "an arm without joints that mimic others",
                     joint.name + ", which follows " + joint.follows);
    }
    all[k + 1] = efforts[static_cast<std::size_t>(joint.coordinate)] / joint.multiplier;
  }
  return all;
}

std::vector<double> ArmOnVehicle::coordinate_values(const std::vector<double>& of_links) const {
  const Arm& arm = workspace_.arm();
  std::vector<double> values(static_cast<std::size_t>(arm.size()), 0.0);
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const Joint& joint = arm.joints()[k];
    if (joint.coordinate >= 0 && joint.follows.empty()) {
      values[static_cast<std::size_t>(joint.coordinate)] = of_links[k + 1] / joint.multiplier;
    }
  }
  return values;
}

std::vector<double> ArmOnVehicle::coordinate_efforts(const std::vector<double>& of_links) const {
  const Arm& arm = workspace_.arm();
  std::vector<double> efforts(static_cast<std::size_t>(arm.size()), 0.0);
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const Joint& joint = arm.joints()[k];
    if (joint.coordinate < 0) continue;
    efforts[static_cast<std::size_t>(joint.coordinate)] += joint.multiplier * of_links[k + 1];
  }
  return efforts;
}

void WrenchRows::check(const char* name) const {
  if (time.size() != (rows.size() > 1 ? rows.size() : 0) && time.size() != rows.size()) {
    throw_argument(name, "one row, or one a time", std::to_string(rows.size()) + " rows");
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!rows[k].allFinite()) throw_argument(name, "finite numbers", "nan or inf");
    if (k > 0 && !(time[k] > time[k - 1])) throw_argument(name, "rising times", "others");
  }
}

Vec6 WrenchRows::at(double moment) const {
  if (rows.empty()) return Vec6::Zero();
  if (rows.size() == 1) return rows.front();
  const auto after = std::upper_bound(time.begin(), time.end(), moment) - time.begin();
  if (after == 0) return rows.front();
  if (after == std::ssize(time)) return rows.back();
  const auto k = static_cast<std::size_t>(after);
  const double share = (moment - time[k - 1]) / (time[k] - time[k - 1]);
  return (1.0 - share) * rows[k - 1] + share * rows[k];
}

ArmMotionRecord simulate_arm_motion(const ArmOnVehicle& system, const VehicleState& start,
                                    const JointSpline& motion, const ArmMotionOptions& options) {
  options.tip_wrench.check("tip_wrench");
  std::vector<double> q, rate, acceleration;
  const TreeJointMotionFunction follow = [&](double time, TreeJointMotion& joints) {
    motion.at(time, q, rate, acceleration);
    system.set_joints(q, rate, acceleration, joints);
  };
  const TreeLoadsFunction loads = [&](double time, const BodyTreeState& state, TreeLoads& now) {
    now.flow.velocity = options.current;
    now.tip_wrench = options.tip_wrench.at(time);
    if (options.wrench) now.wrench = options.wrench(time, state.base);
  };
  BodyTreeState from = system.tree().rest();
  from.base = start;
  const TreeMotionRecord run = simulate_tree(system.tree(), from, loads, follow, options.steps);
  ArmMotionRecord record;
  record.vehicle.time = run.time;
  TreeLoads now;
  TreeJointMotion joints;
  TreeAcceleration found;
  for (std::size_t k = 0; k < run.time.size(); ++k) {
    follow(run.time[k], joints);
    loads(run.time[k], run.state[k], now);
    now.drive = JointDrive::kAcceleration;
    now.joints = joints.acceleration;
    system.tree().accelerations(run.state[k], now, found);
    record.vehicle.state.push_back(run.state[k].base);
    record.q.insert(record.q.end(), q.begin(), q.end());
    const std::vector<double> efforts = system.coordinate_efforts(found.efforts);
    record.effort.insert(record.effort.end(), efforts.begin(), efforts.end());
  }
  return record;
}

}  // namespace bathyal
