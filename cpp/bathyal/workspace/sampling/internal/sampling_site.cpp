// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/internal/sampling_site.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bathyal::workspace {
namespace {

constexpr double kPatch = 0.05;  // around the target, for the bottom's normal [m]
constexpr int kPatchPoints = 8;  // on its rim
constexpr Index kAligning = 5;   // coordinates that place the tip and turn its axis

/// Normal of the triangle nearest to a point, turned upwards.
Vec3 upward_normal(const Scene& scene, const Vec3& point) {
  const NearestPoint nearest = scene.nearest(point);
  if (nearest.triangle < 0) return Vec3::UnitZ();
  RayHit hit;
  hit.mesh = nearest.mesh;
  hit.triangle = nearest.triangle;
  const Vec3 normal = hit_normal(scene, hit);
  return normal.z() < 0.0 ? Vec3(-normal) : normal;
}

/// Against the mean normal around the target.
Vec3 into_bottom(const Workspace& workspace, const Vec3& target) {
  const std::optional<Scene>& scene = workspace.surroundings().scene;
  if (!scene) return -Vec3::UnitZ();
  const Vec3 middle = upward_normal(*scene, target);
  Vec3 sum = middle;
  const Vec3 u = middle.unitOrthogonal(), v = middle.cross(u);
  for (int i = 0; i < kPatchPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPatchPoints;
    sum += upward_normal(*scene, target + kPatch * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return -sum.normalized();
}

/// How far the bottom lies beyond the target along the direction, below 0 before it; none where it
/// is farther than a standoff. Without a scene the target is on it.
std::optional<double> bottom_beyond(const Workspace& workspace, const Vec3& target,
                                    const Vec3& direction, double standoff) {
  const std::optional<Scene>& scene = workspace.surroundings().scene;
  if (!scene) return 0.0;
  const RayHit hit = scene->cast(target - standoff * direction, direction);
  if (!(hit.range <= 2.0 * standoff)) return std::nullopt;
  return hit.range - standoff;
}

}  // namespace

SamplingSite sampling_site(const Workspace& workspace, const Vec3& target,
                           const SamplingOptions& options) {
  SamplingSite site;
  site.world_direction =
      options.direction ? options.direction->normalized() : into_bottom(workspace, target);
  const auto found = bottom_beyond(workspace, target, site.world_direction, options.standoff);
  const double beyond = found.value_or(0.0);
  site.has_bottom = found.has_value();
  site.under = std::max(0.0, -beyond);
  site.world_contact = target + beyond * site.world_direction;
  site.depth = options.stiffness > 0.0
                   ? std::min(options.depth, options.force_limit / options.stiffness)
                   : options.depth;
  const Pose vehicle_from_world =
      workspace.surroundings().world_from_vehicle.at(options.time).inverse();
  const Vec3 direction = vehicle_from_world.linear() * site.world_direction;
  site.contact = vehicle_from_world * site.world_contact;
  site.before = site.contact - options.standoff * direction;
  site.deepest = site.contact + site.depth * direction;
  const bool aligned = options.align.value_or(workspace.arm().size() >= kAligning);
  site.aim.task = aligned ? InverseTask::kPositionAxis : InverseTask::kPosition;
  site.aim.axis = options.tool_axis.normalized();
  site.aim.direction = direction;
  return site;
}

Workspace with_tool(const Workspace& workspace, const SamplingOptions& options) {
  Workspace held = workspace;
  if (options.tool_pose) {
    Arm arm = workspace.arm();
    const Pose new_from_old = options.tool_pose->inverse() * arm.tool();
    arm.set_tool(*options.tool_pose);
    held = Workspace(arm, workspace.surroundings());  // whose capsules are fixed to the links
    held = held.attach({}, in_frame(workspace.attached(), new_from_old));
  }
  return held.attach(options.tool.capsules, options.tool.body);
}

}  // namespace bathyal::workspace
