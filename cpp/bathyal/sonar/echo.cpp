// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/echo.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/sonar/backscatter.hpp"
#include "bathyal/sonar/internal/bent_paths.hpp"
#include "bathyal/sonar/internal/echo_rows.hpp"
#include "bathyal/sonar/internal/ray_fan.hpp"
#include "bathyal/sonar/internal/scatter_tables.hpp"
#include "bathyal/sonar/internal/side_lobes.hpp"
#include "bathyal/sonar/internal/surroundings.hpp"
#include "bathyal/sonar/internal/tracer.hpp"

namespace bathyal {

struct Sonar::State {
  State(SonarOptions described, std::vector<sonar::BeamRays> rays)
      : options(std::move(described)), fans(std::move(rays)), side_lobes(options) {}

  SonarOptions options;
  std::vector<sonar::BeamRays> fans;
  sonar::SideLobes side_lobes;
  mutable sonar::ScatterCache scatter;
};

namespace sonar {
namespace {

void write_row(const EchoPart& row, std::size_t beam, Echo& echo) {
  for (std::size_t i = 0; i < row.power.size(); ++i) {
    const std::size_t at = beam * static_cast<std::size_t>(echo.samples) + row.first + i;
    const Strongest& best = row.strongest[i];
    echo.power[at] = row.power[i];
    if (echo.truth.range.empty() || !(best.weight > 0.0)) continue;
    echo.truth.range[at] = best.range;
    echo.truth.incidence[at] = std::acos(best.incidence_cosine);
    echo.truth.material[at] = best.material;
    std::copy(best.point.begin(), best.point.end(),
              echo.truth.point.begin() + static_cast<std::ptrdiff_t>(3 * at));
  }
}

/// e^(−4αR) at the middle of each sample.
void absorb(const SonarOptions& options, double decibels_per_km, Echo& echo) {
  const double rate = -4.0 * nepers_per_metre(decibels_per_km);
  for (std::size_t at = 0; at < echo.power.size(); ++at) {
    const auto sample = static_cast<double>(at % static_cast<std::size_t>(echo.samples));
    echo.power[at] *= std::exp(rate * (sample + 0.5) * options.sample_length());
  }
}

/// What is worth knowing of a ping.
void add_notes(const SonarOptions& options, const Water& water, double z,
               const ScatterTables& scatter, Echo& echo) {
  if (echo.altitude > options.range) {
    echo.warnings.push_back("the range of " + to_text(options.range) +
                            " m ends above the bottom, " + to_text(echo.altitude) +
                            " m straight below");
  }
  const double bottom =
      water.depth(z) + (std::isnan(echo.altitude) ? options.range : echo.altitude);
  if (options.refraction && water.varies() && !water.covers(bottom)) {
    echo.warnings.push_back("the profile of the water ends at " + to_text(water.deepest()) +
                            " m, above the bottom; below it sound runs straight");
  }
  if (scatter.uses_sediment()) {
    std::string note = extrapolated(options.frequency);
    if (!note.empty()) echo.notes.push_back(std::move(note));
  }
}

/// Angles below the horizontal between which all rays leave, by the bounds of their directions.
std::pair<double, double> steepest_launches(const std::vector<BeamRays>& fans,
                                            const Pose& world_from_head) {
  const Eigen::RowVector3d down = -world_from_head.linear().row(2);
  double low = 1.0, high = -1.0;
  for (const BeamRays& fan : fans) {
    const Eigen::RowVector3d middle = 0.5 * (fan.least + fan.most).transpose();
    const Eigen::RowVector3d half = 0.5 * (fan.most - fan.least).transpose();
    low = std::min(low, down.dot(middle) - down.cwiseAbs().dot(half));
    high = std::max(high, down.dot(middle) + down.cwiseAbs().dot(half));
  }
  return {std::asin(std::clamp(low, -1.0, 1.0)), std::asin(std::clamp(high, -1.0, 1.0))};
}

Echo empty_echo(const SonarOptions& options, bool truth) {
  Echo echo;
  echo.beams = options.beams;
  echo.samples = options.samples;
  const auto size = static_cast<std::size_t>(echo.beams * echo.samples);
  echo.power.assign(size, 0.0);
  if (!truth) return echo;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  echo.truth = {std::vector<double>(size, kNone), std::vector<double>(size, kNone),
                std::vector<std::int32_t>(size, -1), std::vector<double>(3 * size, kNone)};
  return echo;
}

}  // namespace
}  // namespace sonar

Sonar::Sonar(SonarOptions options) {
  options.check();
  std::vector<sonar::BeamRays> fans = sonar::ray_fans(options);
  state_ = std::make_shared<const State>(std::move(options), std::move(fans));
}

const SonarOptions& Sonar::options() const { return state_->options; }

std::int64_t Sonar::ray_count() const {
  std::int64_t count = 0;
  for (const sonar::BeamRays& fan : state_->fans) {
    count += static_cast<std::int64_t>(fan.weight.size());
  }
  return count;
}

Echo Sonar::echo(const WorldSnapshot& world, const Water& water, const Pose& world_from_vehicle,
                 std::int64_t ping, int num_threads, const VehicleMotion& motion,
                 bool truth) const {
  const SonarOptions& options = state_->options;
  check_rigid("world_from_vehicle", world_from_vehicle);
  motion.check();
  resolve_threads(num_threads);
  const Pose world_from_head =
      world_from_vehicle * options.vehicle_from_sonar * head_pose(options, ping);
  const Vec3 head = world_from_head.translation();

  Echo echo = sonar::empty_echo(options, truth);
  echo.altitude = sonar::checked_altitude(world, water, head);
  echo.sound_speed = water.sound_speed(head.z(), world.time);
  const auto scatter = state_->scatter.tables(options, world.materials);
  sonar::add_notes(options, water, head.z(), *scatter, echo);

  sonar::Setting setting{options, world, *scatter, world_from_head};
  setting.sound_speed = echo.sound_speed;
  setting.sonar_depth = water.depth(head.z());
  if (water.surface()) setting.surface = water.surface_height(head.x(), head.y(), world.time);
  std::optional<sonar::BentPaths> bent;
  if (options.refraction && water.varies()) {
    const auto [up, down] = sonar::steepest_launches(state_->fans, world_from_head);
    bent.emplace(water.speed_profile(world.time), setting.sonar_depth, options.range, up, down,
                 num_threads);
    setting.bent = &*bent;
  }
  if (options.motion) {
    const Vec3 arm = head - world_from_vehicle.translation();
    setting.motion = {motion.velocity + motion.rate.cross(arm), motion.rate};
  }

  const sonar::Tracer tracer(setting);
  const std::vector<sonar::Task> tasks = sonar::tasks_of(state_->fans);
  std::vector<sonar::EchoPart> parts(tasks.size());
  parallel_for(tasks.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      parts[i] = tracer.trace(state_->fans[tasks[i].beam], tasks[i]);
    }
  });
  sonar::EchoRow row;
  row.reset(static_cast<std::size_t>(options.samples), options.sample_length());
  for (std::size_t i = 0; i < tasks.size();) {
    const std::size_t beam = tasks[i].beam;
    for (; i < tasks.size() && tasks[i].beam == beam; ++i) row.add(parts[i]);
    sonar::write_row(row.take(), beam, echo);
  }
  state_->side_lobes.add(echo, num_threads);
  if (options.absorption) {
    const double z = world_from_head.translation().z();
    sonar::absorb(options, water.absorption(options.frequency, z, world.time, *options.absorption),
                  echo);
  }
  return echo;
}

}  // namespace bathyal
