// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/dh.hpp"

#include <cmath>
#include <utility>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

/// The part of a row that comes after its joint in the standard convention and before it in the
/// modified one.
struct Twist {
  double a = 0.0;
  double alpha = 0.0;
  double beta = 0.0;
};

Twist twist_of(const DhRow& row) { return {row.a, row.alpha, row.beta}; }

void set_twist(DhRow& row, const Twist& twist) {
  row.a = twist.a;
  row.alpha = twist.alpha;
  row.beta = twist.beta;
}

Pose twist_pose(const Twist& twist) {
  return Eigen::Translation3d(twist.a, 0.0, 0.0) * Eigen::AngleAxisd(twist.alpha, Vec3::UnitX()) *
         Eigen::AngleAxisd(twist.beta, Vec3::UnitY());
}

/// The twist that makes `pose`; all zero when none does.
Twist twist_of(const Pose& pose) {
  const Eigen::Matrix3d rotation = pose.linear();
  const Twist twist{pose.translation().x(), std::atan2(rotation(2, 1), rotation(1, 1)),
                    std::atan2(rotation(0, 2), rotation(0, 0))};
  return twist_pose(twist).isApprox(pose, 1e-14) ? twist : Twist{};
}

/// Moves every twist one row on: of the modified convention's rows to those of the standard one.
void to_standard(DhTable& table) {
  if (table.rows.empty()) return;
  table.root = table.root * twist_pose(twist_of(table.rows.front()));
  for (std::size_t k = 0; k + 1 < table.rows.size(); ++k) {
    set_twist(table.rows[k], twist_of(table.rows[k + 1]));
  }
  set_twist(table.rows.back(), {});
  table.convention = DhConvention::kStandard;
}

void to_modified(DhTable& table) {
  const Twist first = twist_of(table.root);
  table.root = table.root * twist_pose(first).inverse();
  table.flange = twist_pose(twist_of(table.rows.back())) * table.flange;
  for (std::size_t k = table.rows.size() - 1; k > 0; --k) {
    set_twist(table.rows[k], twist_of(table.rows[k - 1]));
  }
  set_twist(table.rows.front(), first);
  table.convention = DhConvention::kModified;
}

template <class Value>
void check_length(std::string_view name, const std::vector<Value>& values, std::size_t rows) {
  if (!values.empty() && values.size() != rows) {
    throw_argument(name, std::to_string(rows) + ", one a row of the table",
                   std::to_string(values.size()));
  }
}

std::vector<Joint> joints_of(const DhTable& table, const DhArmOptions& options) {
  std::vector<Joint> joints(table.rows.size());
  int coordinate = 0;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    Joint& joint = joints[k];
    joint.name = options.names.empty() ? "joint_" + std::to_string(k + 1) : options.names[k];
    joint.row = table.rows[k];
    joint.type = table.types[k];
    if (joint.type != JointType::kFixed) joint.coordinate = coordinate++;
    if (!options.lower.empty()) joint.lower = options.lower[k];
    if (!options.upper.empty()) joint.upper = options.upper[k];
    if (!options.velocity.empty()) joint.velocity = options.velocity[k];
    if (!options.effort.empty()) joint.effort = options.effort[k];
  }
  return joints;
}

}  // namespace

Arm arm_from_dh(const DhTable& table, const DhArmOptions& options) {
  const std::size_t rows = table.rows.size();
  if (table.types.size() != rows) {
    throw_argument("joint_types", std::to_string(rows) + ", one a row of the table",
                   std::to_string(table.types.size()));
  }
  check_length("names", options.names, rows);
  check_length("lower", options.lower, rows);
  check_length("upper", options.upper, rows);
  check_length("velocity", options.velocity, rows);
  check_length("effort", options.effort, rows);
  DhTable standard = table;
  if (standard.convention == DhConvention::kModified) to_standard(standard);
  Arm arm(options.name, joints_of(standard, options), options.links, standard.root,
          standard.flange);
  arm.set_source(options.source);
  return arm;
}

DhTable dh_table(const Arm& arm, DhConvention convention) {
  DhTable table;
  table.root = arm.root();
  table.flange = arm.flange();
  for (const Joint& joint : arm.joints()) {
    table.rows.push_back(joint.row);
    table.types.push_back(joint.type);
  }
  if (convention == DhConvention::kModified) to_modified(table);
  return table;
}

}  // namespace bathyal
