// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/arm_shape.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"

namespace bathyal {
namespace {

/// Link k moves with joint k - 1 and hangs on the frame behind its row.
Pose frame_of_link(const Arm& arm, int link, const RowFrames& frames) {
  const auto k = static_cast<std::size_t>(link);
  return frames.world_from_row[k] * arm.links()[k].row_from_link;
}

/// The farther of the capsule's ends from an axis, and its radius more.
double distance_from_axis(const Capsule& capsule, const Vec3& origin, const Vec3& axis) {
  const auto of = [&](const Vec3& point) { return axis.cross(point - origin).norm(); };
  return std::max(of(capsule.start), of(capsule.end)) + capsule.radius;
}

}  // namespace

std::string link_name(const Arm& arm, int link) {
  const std::string& name = arm.links()[static_cast<std::size_t>(link)].name;
  return name.empty() ? "link_" + std::to_string(link) : name;
}

int link_index(const Arm& arm, std::string_view link, std::string_view argument) {
  std::vector<std::string> known;
  for (int i = 0; i < std::ssize(arm.links()); ++i) {
    known.push_back(link_name(arm, i));
    if (known.back() == link) return i;
  }
  throw_argument(argument, "the name of a link: " + listed(known), "\"" + std::string(link) + "\"");
}

std::vector<LinkCapsule> capsules_of_rows(const Arm& arm, std::span<const double> radii) {
  const std::size_t links = arm.joints().size() + 1;
  if (radii.size() > 1 && radii.size() != links) {
    throw_argument("radii", "none, one, or one for each of " + std::to_string(links) + " links",
                   std::to_string(radii.size()));
  }
  const auto radius = [&](std::size_t link) {
    return radii.empty() ? 0.0 : radii[radii.size() == 1 ? 0 : link];
  };
  std::vector<LinkCapsule> capsules;
  const auto add = [&](std::size_t link, std::size_t start_link, const Vec3& start,
                       const Vec3& end) {
    const LinkCapsule made{static_cast<int>(link), static_cast<int>(start_link), start, end,
                           radius(link)};
    Capsule{start, end, made.radius}.check("radii: link " + link_name(arm, static_cast<int>(link)));
    if (start_link != link || (end - start).norm() > 0.0) capsules.push_back(made);
  };
  // Row k leads from the frame of row k - 1 along its z by d, then along the new x by a.
  for (std::size_t k = 0; k + 1 < links; ++k) {
    const Joint& joint = arm.joints()[k];
    const Pose link_from_row = arm.links()[k + 1].row_from_link.inverse();
    const Pose row_from_before = row_pose(joint.row, joint.type, 0.0).inverse();
    const Vec3 elbow = row_from_before * Vec3(0.0, 0.0, joint.row.d);
    if (joint.type == JointType::kPrismatic) {
      const Pose before_from_row = arm.links()[k].row_from_link.inverse();
      add(k + 1, k, before_from_row.translation(), link_from_row * elbow);
    } else {
      add(k + 1, k + 1, link_from_row * row_from_before.translation(), link_from_row * elbow);
    }
    add(k + 1, k + 1, link_from_row * elbow, link_from_row.translation());
  }
  const Pose link_from_last = arm.links()[links - 1].row_from_link.inverse();
  add(links - 1, links - 1, link_from_last.translation(),
      link_from_last * (arm.flange() * arm.tool()).translation());
  return capsules;
}

std::vector<LinkCapsule> capsules_of_links(const Arm& arm,
                                           std::span<const std::vector<Capsule>> shapes) {
  if (shapes.size() != arm.links().size()) {
    throw_argument("shapes",
                   "capsules for each of " + std::to_string(arm.links().size()) + " links",
                   std::to_string(shapes.size()));
  }
  std::vector<LinkCapsule> capsules;
  for (std::size_t link = 0; link < shapes.size(); ++link) {
    for (const Capsule& capsule : shapes[link]) {
      capsule.check("shapes: link " + link_name(arm, static_cast<int>(link)));
      const int index = static_cast<int>(link);
      capsules.push_back({index, index, capsule.start, capsule.end, capsule.radius});
    }
  }
  return capsules;
}

Capsule placed(const Arm& arm, const LinkCapsule& capsule, const RowFrames& frames) {
  return {frame_of_link(arm, capsule.start_link, frames) * capsule.start,
          frame_of_link(arm, capsule.link, frames) * capsule.end, capsule.radius};
}

double displacement_bound(const Arm& arm, const RowFrames& frames, int link, int observer,
                          const Capsule& placed, std::span<const double> change) {
  double bound = 0.0;
  const auto move = [&](int joint_index) {
    const auto row = static_cast<std::size_t>(joint_index);
    const Joint& joint = arm.joints()[row];
    if (joint.type == JointType::kFixed) return;
    const double by =
        std::abs(joint.multiplier) * change[static_cast<std::size_t>(joint.coordinate)];
    const Pose& frame = frames.world_from_row[row];
    bound +=
        joint.type == JointType::kPrismatic
            ? by
            : by * (distance_from_axis(placed, frame.translation(), frame.linear().col(2)) + bound);
  };
  for (int k = link - 1; k >= observer; --k) move(k);
  for (int k = link; k < observer; ++k) move(k);
  return bound;
}

}  // namespace bathyal
