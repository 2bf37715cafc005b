// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/static_trim.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/sampling/internal/moved_bodies.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kTrimGrain = 128;  ///< postures of one task
/// Of the vehicle's mass times one metre: what the centres leave below this is rounding.
constexpr double kNeutralShare = 1e-12;

/// Of the vehicle alone, in its frame.
struct Floating {
  Vec3 mass_moment;  ///< Σ m r − ρ Σ V r [kg m]
  double net_mass;   ///< [kg]
  double scale;      ///< [kg m]
};

Floating floating(const Workspace& workspace, double water_density) {
  const std::optional<RigidBody>& body = workspace.surroundings().vehicle_body;
  if (!body) throw_argument("vehicle_body", "a RigidBody of the vehicle without the arm", "none");
  if (!(body->mass > 0.0 && body->volume > 0.0)) {
    throw_argument("vehicle_body", "a mass and a volume above 0",
                   to_text(body->mass) + " kg and " + to_text(body->volume) + " m³");
  }
  body->check("vehicle_body");
  const double displaced = water_density * body->volume;
  return {body->mass * body->center_of_mass - displaced * body->center_of_buoyancy,
          body->mass - displaced, body->mass + displaced};
}

void set_attitude(const Vec3& down, double scale, std::size_t i, StaticTrim& trim) {
  const double length = down.norm();
  if (!(length > kNeutralShare * scale)) {
    trim.roll[i] = trim.pitch[i] = std::numeric_limits<double>::quiet_NaN();
    trim.status[i] = TrimStatus::kNeutral;
    return;
  }
  // World's down in the vehicle's frame: (sin pitch, −sin roll cos pitch, −cos roll cos pitch).
  trim.pitch[i] = std::atan2(down.x(), std::hypot(down.y(), down.z()));
  const bool vertical = down.y() == 0.0 && down.z() == 0.0;
  trim.roll[i] = vertical ? 0.0 : std::atan2(-down.y(), -down.z());
  trim.status[i] = down.z() <= 0.0 ? TrimStatus::kUpright : TrimStatus::kTurnedOver;
}

}  // namespace

std::string_view to_text(TrimStatus status) {
  switch (status) {
    case TrimStatus::kUpright:
      return "upright";
    case TrimStatus::kTurnedOver:
      return "turned_over";
    default:
      return "neutral";
  }
}

void TrimOptions::check() const {
  check_positive("gravity", gravity);
  check_positive("water_density", water_density);
}

StaticTrim static_trim(const Workspace& workspace, JointView q, const TrimOptions& options) {
  check_joint_values(workspace.arm(), q);
  options.check();
  const Floating vehicle = floating(workspace, options.water_density);
  const auto rows = static_cast<std::size_t>(q.rows());
  StaticTrim trim;
  for (auto* values : {&trim.roll, &trim.pitch, &trim.righting, &trim.buoyancy}) {
    values->resize(rows);
  }
  trim.status.resize(rows);
  parallel_for(rows, kTrimGrain, options.num_threads, [&](std::size_t begin, std::size_t end) {
    workspace::MovedBodies bodies(workspace.arm(), workspace.attached());
    const auto size = static_cast<std::size_t>(q.cols());
    for (std::size_t i = begin; i < end; ++i) {
      bodies.set({q.data() + i * size, size});
      const Vec3 down = vehicle.mass_moment + bodies.mass_moment(options.water_density);
      set_attitude(down, vehicle.scale, i, trim);
      trim.righting[i] = options.gravity * down.norm();
      trim.buoyancy[i] =
          -options.gravity * (vehicle.net_mass + bodies.net_mass(options.water_density));
    }
  });
  return trim;
}

}  // namespace bathyal
