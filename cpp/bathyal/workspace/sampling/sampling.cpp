// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/workspace/internal/postures.hpp"
#include "bathyal/workspace/sampling/internal/sampling_loads.hpp"
#include "bathyal/workspace/sampling/internal/sampling_search.hpp"

namespace bathyal {
namespace {

constexpr Index kStowedPostures = 64;

void check_posture(const Arm& arm, const std::vector<double>& q, std::string_view name) {
  if (q.empty()) return;
  check_joint_values(arm, JointView(q.data(), 1, static_cast<Index>(q.size())), name);
}

}  // namespace

void SamplingOptions::check() const {
  tool.body.check("tool");
  sample.body.check("sample");
  if (tool_pose) check_rigid("tool_pose", *tool_pose);
  const auto check_direction = [](std::string_view name, const Vec3& vector) {
    if (!vector.allFinite() || vector.isZero(0.0)) {
      throw_argument(name, "a finite direction of any length but zero",
                     vector.allFinite() ? "zero" : "nan or inf");
    }
  };
  if (direction) check_direction("direction", *direction);
  check_direction("tool_axis", tool_axis);
  check_positive("standoff", standoff);
  check_not_negative("depth", depth);
  check_not_negative("stiffness", stiffness);
  check_positive("force_limit", force_limit);
  check_positive("grab_time", grab_time);
  check_positive("press_speed", press_speed);
  check_positive("line_tolerance", line_tolerance);
  check_positive("step", step);
  check_finite("time", time);
  check_range("max_checks", max_checks, 1, 1e8);
  if (!gravity.allFinite()) throw_argument("gravity", "finite numbers", "nan or inf");
  check_not_negative("water_density", water_density);
}

std::string_view to_text(SamplingStatus status) {
  switch (status) {
    case SamplingStatus::kPlanned:
      return "planned";
    case SamplingStatus::kStart:
      return "start";
    case SamplingStatus::kForbidden:
      return "forbidden";
    case SamplingStatus::kNoBottom:
      return "no_bottom";
    case SamplingStatus::kUnreachable:
      return "unreachable";
    case SamplingStatus::kCollision:
      return "collision";
    case SamplingStatus::kNoApproach:
      return "no_approach";
    case SamplingStatus::kNoTransport:
      return "no_transport";
    default:
      return "no_retreat";
  }
}

SamplingPlan plan_sampling(const Workspace& workspace, const Vec3& target,
                           const SamplingOptions& options) {
  if (!target.allFinite()) throw_argument("target", "finite coordinates", "nan or inf");
  options.check();
  check_posture(workspace.arm(), options.q_start, "q_start");
  check_posture(workspace.arm(), options.q_transport, "q_transport");
  if (workspace.surroundings().world_from_vehicle.moves()) {
    throw_argument("vehicle_pose", "a vehicle at rest while a sample is taken", "one that moves");
  }
  workspace::SamplingSearch search(workspace, target, options);
  SamplingPlan plan;
  plan.contact = search.site().world_contact;
  plan.direction = search.site().world_direction;
  plan.depth = search.site().depth;
  if (search.find()) {
    plan.status = SamplingStatus::kPlanned;
    workspace::add_phases(search, options, plan);
  } else {
    plan.status = search.status();
    plan.reason = search.reason();
  }
  return plan;
}

std::vector<double> stowed_posture(const Workspace& workspace, double time, std::uint64_t seed) {
  const Arm& arm = workspace.arm();
  JointMatrix q(kStowedPostures + 2, arm.size());
  for (Index k = 0; k < arm.size(); ++k) {
    const double low = arm.lower()[k], high = arm.upper()[k];
    q(0, k) = std::clamp(0.0, low, high);
    q(1, k) = std::isfinite(high - low) ? 0.5 * (low + high) : q(0, k);
  }
  RandomStream random(seed);
  for (Index i = 2; i < q.rows(); ++i) q.row(i) = workspace::drawn_posture(arm, random);
  const std::vector<Clearance> clear = workspace.clearance(view_of(q), {&time, 1});
  const auto room = [&](Index i) { return clear[static_cast<std::size_t>(i)].least(); };
  Index best = room(0) > 0.0 ? 0 : 1;
  for (Index i = 2; i < q.rows() && !(room(best) > 0.0 && best < 2); ++i) {
    if (room(i) > room(best)) best = i;
  }
  if (!(room(best) > 0.0)) return {};
  const Eigen::RowVectorXd row = q.row(best);
  return {row.begin(), row.end()};
}

}  // namespace bathyal
