// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/arm.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

void check_joint(const Joint& joint) {
  const std::string name = "joint " + joint.name;
  const DhRow& row = joint.row;
  check_finite(name + " a", row.a);
  check_finite(name + " alpha", row.alpha);
  check_finite(name + " d", row.d);
  check_finite(name + " theta", row.theta);
  check_finite(name + " beta", row.beta);
  check_finite(name + " multiplier", joint.multiplier);
  check_finite(name + " offset", joint.offset);
  if (joint.type != JointType::kFixed && joint.multiplier == 0.0) {
    throw_argument(name + " multiplier", "a number other than 0", "0");
  }
  if (!(joint.lower <= joint.upper)) {
    throw_argument(name + " limits", "lower <= upper",
                   to_text(joint.lower) + " and " + to_text(joint.upper));
  }
}

void check_link(const Link& link) {
  const std::string name = "link " + link.name;
  check_rigid(name + " frame", link.row_from_link);
  link.body.check(name);
  for (const Shape& shape : link.collision) shape.check(name + " collision");
  for (const Shape& shape : link.visual) shape.check(name + " visual");
}

/// Coordinates are numbered in the order in which joints first use them.
Index count_coordinates(const std::vector<Joint>& joints) {
  Index count = 0;
  for (const Joint& joint : joints) {
    if (joint.type == JointType::kFixed) {
      if (joint.coordinate != -1) {
        throw_argument("joint " + joint.name + " coordinate", "-1, as of every fixed joint",
                       std::to_string(joint.coordinate));
      }
    } else if (joint.coordinate == count) {
      ++count;
    } else if (joint.coordinate < 0 || joint.coordinate > count) {
      throw_argument("joint " + joint.name + " coordinate",
                     "one that a joint before it uses, or " + std::to_string(count),
                     std::to_string(joint.coordinate));
    }
  }
  if (count == 0) throw_argument("joints", "at least one that moves", "none");
  return count;
}

}  // namespace

Arm::Arm(std::string name, std::vector<Joint> joints, std::vector<Link> links, const Pose& root,
         const Pose& flange)
    : name_(std::move(name)),
      joints_(std::move(joints)),
      links_(std::move(links)),
      root_(root),
      flange_(flange) {
  check_rigid("root", root);
  check_rigid("flange", flange);
  for (const Joint& joint : joints_) check_joint(joint);
  if (links_.empty()) links_.resize(joints_.size() + 1);
  if (links_.size() != joints_.size() + 1) {
    throw_argument("links", std::to_string(joints_.size() + 1) + ", one more than joints",
                   std::to_string(links_.size()));
  }
  for (const Link& link : links_) check_link(link);
  size_ = count_coordinates(joints_);

  lower_.setConstant(size_, -Joint::kUnlimited);
  upper_.setConstant(size_, Joint::kUnlimited);
  for (const Joint& joint : joints_) {
    if (joint.type == JointType::kFixed) continue;
    const std::pair<double, double> ends =
        std::minmax((joint.lower - joint.offset) / joint.multiplier,
                    (joint.upper - joint.offset) / joint.multiplier);
    double& lower = lower_[joint.coordinate];
    double& upper = upper_[joint.coordinate];
    lower = std::max(lower, ends.first);
    upper = std::min(upper, ends.second);
    if (lower > upper) {
      throw_argument("joint " + joint.name + " limits",
                     "a range that overlaps that of the joint it follows", "none left");
    }
  }
}

void Arm::set_base(const Pose& world_from_base) {
  check_rigid("base", world_from_base);
  base_ = world_from_base;
}

void Arm::set_tool(const Pose& flange_from_tool) {
  check_rigid("tool", flange_from_tool);
  tool_ = flange_from_tool;
}

double chain_length(const Arm& arm) {
  double length = 0.0;
  for (const Joint& joint : arm.joints()) length += std::hypot(joint.row.a, joint.row.d);
  return length;
}

}  // namespace bathyal
