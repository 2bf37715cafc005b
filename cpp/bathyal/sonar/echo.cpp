// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/echo.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/sonar/internal/echo_rows.hpp"
#include "bathyal/sonar/internal/facets.hpp"
#include "bathyal/sonar/internal/ray_fan.hpp"
#include "bathyal/sonar/internal/surroundings.hpp"

namespace bathyal {

struct Sonar::State {
  SonarOptions options;
  std::vector<sonar::BeamRays> fans;
};

namespace sonar {
namespace {

constexpr std::size_t kRaysOfTask = 32768;  ///< whole columns, about as many
constexpr std::size_t kRaysOfCast = 2048;   ///< their hits stay in the cache
constexpr double kLeastCosine = 1e-4;       ///< at which a surface is seen along its edge

/// Columns of one beam that are traced as one.
struct Task {
  std::size_t beam;
  std::size_t first_column, last_column;
};

std::vector<Task> tasks_of(const std::vector<BeamRays>& fans) {
  std::vector<Task> tasks;
  for (std::size_t beam = 0; beam < fans.size(); ++beam) {
    const std::vector<std::size_t>& columns = fans[beam].columns;
    std::size_t first = 0;
    for (std::size_t column = 1; column < columns.size(); ++column) {
      if (columns[column] - columns[first] < kRaysOfTask && column + 1 < columns.size()) continue;
      tasks.push_back({beam, first, column});
      first = column;
    }
  }
  return tasks;
}

/// What a thread works with from task to task.
struct Scratch {
  EchoRow row;
  std::vector<double> directions = std::vector<double>(3 * kRaysOfCast);
  std::vector<RayHit> hits = std::vector<RayHit>(kRaysOfCast);
};

/// Traces rays of a sonar that rests in the world.
class Tracer {
 public:
  Tracer(const SonarOptions& options, const WorldSnapshot& world, const Pose& world_from_head)
      : options_(options), world_(world), facets_(world.scene), world_from_head_(world_from_head) {}

  EchoPart trace(const BeamRays& fan, const Task& task) const {
    thread_local Scratch scratch;
    auto& [row, directions, hits] = scratch;
    row.reset(static_cast<std::size_t>(options_.samples), options_.sample_length());
    const Vec3 array = world_from_head_.linear() * fan.beam.array;
    for (std::size_t column = task.first_column; column < task.last_column; ++column) {
      double farthest = 0.0;  // of what lies lower in the column
      for (std::size_t first = fan.columns[column]; first < fan.columns[column + 1];
           first += kRaysOfCast) {
        const std::size_t count = std::min(kRaysOfCast, fan.columns[column + 1] - first);
        cast(fan, first, count, directions, hits);
        for (std::size_t i = 0; i < count; ++i) {
          if (hits[i].mesh < 0 || hits[i].range > options_.range * 1.5) continue;
          if (!options_.layover) {
            if (hits[i].range < farthest - options_.sample_length()) continue;
            farthest = std::max(farthest, hits[i].range);
          }
          const Eigen::Map<const Vec3> direction(directions.data() + 3 * i);
          row.add(returned(fan, array, direction, fan.weight[first + i], hits[i]));
        }
      }
    }
    return row.take();
  }

 private:
  void cast(const BeamRays& fan, std::size_t first, std::size_t count,
            std::vector<double>& directions, std::vector<RayHit>& hits) const {
    const Eigen::Matrix3d turn = world_from_head_.linear();
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Map<Vec3>(directions.data() + 3 * i) =
          turn * Eigen::Map<const Vec3>(fan.direction.data() + 3 * (first + i));
    }
    const Vec3 origin = world_from_head_.translation();
    world_.scene.cast(PointView(origin.data(), 1, 3),
                      PointView(directions.data(), static_cast<Index>(count), 3),
                      std::span<RayHit>(hits.data(), count), 1);
  }

  Return returned(const BeamRays& fan, const Vec3& array, const Vec3& direction, double weight,
                  const RayHit& hit) const {
    const Vec3 normal = facets_.normal(hit);
    const double against = normal.dot(direction);
    const double cosine = std::max(std::abs(against), kLeastCosine);
    Return back;
    back.range = hit.range;
    back.incidence_cosine = std::min(cosine, 1.0);
    back.material = world_.material(hit);
    back.point = world_from_head_.translation() + hit.range * direction;
    const Material& material = (*world_.materials)[static_cast<std::size_t>(back.material)];
    back.weight = weight * power(material.strength * cosine, hit.range);
    if (fan.half_psi > 0.0) spread(fan, array, direction, normal, against, back);
    return back;
  }

  /// Of σ₀ / cos θ. Pixels carry no range of their own; angles cover R² of it.
  double power(double scattered, double range) const {
    const double square = range * range;
    if (options_.spreading) return scattered / square;
    return options_.rays == RayModel::kCamera ? scattered : scattered * square;
  }

  /// The ranges that the ray's cell covers on the plane of the facet.
  void spread(const BeamRays& fan, const Vec3& array, const Vec3& direction, const Vec3& normal,
              double against, Return& back) const {
    const double facing = std::copysign(std::max(std::abs(against), kLeastCosine), against);
    const Vec3 by_psi = fan.beam.sense * array.cross(direction);
    const double sine = direction.dot(array);
    const double steep_psi = -normal.dot(by_psi) / facing;
    const double steep_phi =
        -(normal.dot(array) - sine * against) / (facing * std::max(1.0 - sine * sine, 1e-6));
    const double half_psi = std::abs(steep_psi) * fan.half_psi;
    const double half_phi = std::abs(steep_phi) * fan.half_phi;
    back.half = back.range * std::max(half_psi, half_phi);
    if (half_psi >= half_phi && steep_psi != 0.0)
      back.slide = direction + by_psi / steep_psi;
    else if (steep_phi != 0.0)
      back.slide = direction + (array - sine * direction) / steep_phi;
  }

  const SonarOptions& options_;
  const WorldSnapshot& world_;
  Facets facets_;
  Pose world_from_head_;
};

void write_row(const EchoPart& row, std::size_t beam, Echo& echo) {
  for (std::size_t i = 0; i < row.power.size(); ++i) {
    const std::size_t at = beam * static_cast<std::size_t>(echo.samples) + row.first + i;
    const Strongest& best = row.strongest[i];
    echo.power[at] = row.power[i];
    if (!(best.weight > 0.0)) continue;
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

Echo empty_echo(const SonarOptions& options) {
  Echo echo;
  echo.beams = options.beams;
  echo.samples = options.samples;
  const auto size = static_cast<std::size_t>(echo.beams * echo.samples);
  echo.power.assign(size, 0.0);
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
  state_ = std::make_shared<const State>(State{std::move(options), std::move(fans)});
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
                 std::int64_t ping, int num_threads) const {
  const SonarOptions& options = state_->options;
  check_rigid("world_from_vehicle", world_from_vehicle);
  resolve_threads(num_threads);
  const Pose world_from_head =
      world_from_vehicle * options.vehicle_from_sonar * head_pose(options, ping);

  Echo echo = sonar::empty_echo(options);
  echo.altitude = sonar::checked_altitude(world, water, world_from_head.translation());
  echo.sound_speed = water.sound_speed(world_from_head.translation().z(), world.time);
  if (echo.altitude > options.range) {
    echo.warnings.push_back("the range of " + to_text(options.range) +
                            " m ends above the bottom, " + to_text(echo.altitude) +
                            " m straight below");
  }

  const sonar::Tracer tracer(options, world, world_from_head);
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
  if (options.absorption) {
    const double z = world_from_head.translation().z();
    sonar::absorb(options, water.absorption(options.frequency, z, world.time, *options.absorption),
                  echo);
  }
  return echo;
}

}  // namespace bathyal
