// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "bathyal/sonar/backscatter.hpp"
#include "bathyal/sonar/internal/batch.hpp"

namespace bathyal::sonar {
namespace {

constexpr std::size_t kRaysOfTask = 32768;  ///< whole columns, about as many
constexpr double kBeyond = 1.5;             ///< ranges at which a cell may still reach into the row

}  // namespace

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

Tracer::Tracer(const Setting& setting)
    : setting_(setting),
      options_(setting.options),
      facets_(setting.world.scene),
      moves_(setting.motion.moves()) {}

EchoPart Tracer::trace(const BeamRays& fan, const Task& task) const {
  thread_local Batch batch;
  EchoRow& row = batch.row;
  row.reset(static_cast<std::size_t>(options_.samples), options_.sample_length());
  batch.facet = Facet();
  if (moves_) batch.reception.emplace(options_, fan.beam, fan.half_phi);
  for (std::size_t column = task.first_column; column < task.last_column; ++column) {
    double farthest = 0.0;  // of what lies lower in the column
    for (std::size_t first = fan.columns[column]; first < fan.columns[column + 1];
         first += kRaysOfCast) {
      batch.first = first;
      batch.count = std::min(kRaysOfCast, fan.columns[column + 1] - first);
      launch(fan, batch);
      if (setting_.bent != nullptr)
        arrive_bent(batch);
      else
        arrive_straight(batch);
      for (std::size_t i = 0; i < batch.count; ++i) {
        Arrival& arrival = batch.arrivals[i];
        if (arrival.hit.mesh == -1 || arrival.range > options_.range * kBeyond) continue;
        if (!options_.layover) {
          if (arrival.range < farthest - options_.sample_length()) continue;
          farthest = std::max(farthest, arrival.range);
        }
        const Vec3 from = batch.direction(i);
        tangents(fan, from, arrival);
        Return back = returned(fan, arrival, weight(fan, first + i));
        if (moves_) back.weight *= received(*batch.reception, from, back);
        row.add(back);
      }
      if (options_.multiples > 0) follow_reflections(fan, batch);
    }
  }
  return row.take();
}

void Tracer::launch(const BeamRays& fan, Batch& batch) const {
  const Eigen::Matrix3d turn = setting_.world_from_head.linear();
  for (std::size_t i = 0; i < batch.count; ++i) {
    Eigen::Map<Vec3>(batch.directions.data() + 3 * i) =
        turn * Eigen::Map<const Vec3>(fan.direction.data() + 3 * (batch.first + i));
  }
}

void Tracer::arrive_straight(Batch& batch) const {
  const Vec3 origin = setting_.world_from_head.translation();
  setting_.world.scene.cast(PointView(origin.data(), 1, 3),
                            PointView(batch.directions.data(), static_cast<Index>(batch.count), 3),
                            std::span<RayHit>(batch.hits.data(), batch.count), 1);
  for (std::size_t i = 0; i < batch.count; ++i) {
    Arrival& arrival = batch.arrivals[i];
    const Vec3 direction = batch.direction(i);
    arrival.hit = batch.hits[i];
    if (direction.z() > 0.0) meets_surface(origin, direction, arrival.hit);
    arrival.range = arrival.length = arrival.hit.range;
    if (arrival.hit.mesh == -1) continue;
    arrival.point = origin + arrival.range * direction;
    arrival.direction = direction;
    arrival.normal = normal(arrival.hit, batch.facet);
  }
}

/// Where the sea surface comes before what was hit: it is what reflects, or there is nothing.
bool Tracer::meets_surface(const Vec3& from, const Vec3& direction, RayHit& hit) const {
  if (!setting_.surface || !(direction.z() > 0.0)) return false;
  const double range = std::max((*setting_.surface - from.z()) / direction.z(), 0.0);
  if (range >= hit.range) return false;
  hit = RayHit();
  if (options_.multiples > 0) {
    hit.mesh = kSurface;
    hit.range = range;
  }
  return true;
}

void Tracer::tangents(const BeamRays& fan, const Vec3& launch, Arrival& arrival) const {
  if (!(fan.half_psi > 0.0)) return;
  const Vec3 array = setting_.world_from_head.linear() * fan.beam.array;
  const double sine = launch.dot(array);
  arrival.by_psi = fan.beam.sense * array.cross(launch);
  arrival.by_phi = (array - sine * launch) / std::sqrt(std::max(1.0 - sine * sine, 1e-6));
  if (setting_.bent == nullptr) return;
  const Vec3 axis = launch.cross(arrival.direction);  // turned along with the ray
  const double rest = 1.0 / (1.0 + launch.dot(arrival.direction));
  for (Vec3* tangent : {&arrival.by_psi, &arrival.by_phi}) {
    const Vec3 across = axis.cross(*tangent);
    *tangent += across + rest * axis.cross(across);
  }
}

Return Tracer::returned(const BeamRays& fan, const Arrival& arrival, double weight) const {
  const double against = arrival.normal.dot(arrival.direction);
  const double cosine = std::clamp(std::abs(against), kLeastCosine, 1.0);
  Return back;
  back.range = arrival.range;
  back.incidence_cosine = cosine;
  back.point = arrival.point;
  double scattered = 0.0;  // σ₀ / cos θ
  if (arrival.hit.mesh == kSurface) {
    back.material = kSurface;
    scattered = surface_backscatter(cosine, options_.wind_speed) / cosine;
  } else {
    back.material = setting_.world.material(arrival.hit);
    scattered = setting_.tables.over_cosine(back.material, cosine);
  }
  back.weight = weight * power(scattered, arrival.length);
  if (fan.half_psi > 0.0) spread(fan, arrival, against, back);
  return back;
}

/// Of σ₀ / cos θ. Pixels carry no range of their own; angles cover R² of it.
double Tracer::power(double scattered, double length) const {
  const double square = length * length;
  if (options_.spreading) return scattered / square;
  return options_.rays == RayModel::kCamera ? scattered : scattered * square;
}

/// The ranges that the ray's cell covers on the plane of what it met.
void Tracer::spread(const BeamRays& fan, const Arrival& arrival, double against,
                    Return& back) const {
  const double facing = std::copysign(std::max(std::abs(against), kLeastCosine), against);
  const double steep_psi = -arrival.normal.dot(arrival.by_psi) / facing;
  const double steep_phi = -arrival.normal.dot(arrival.by_phi) / facing;
  const double half_psi = std::abs(steep_psi) * fan.half_psi;
  const double half_phi = std::abs(steep_phi) * fan.half_phi;
  back.half = arrival.range * std::max(half_psi, half_phi);
  constexpr double kGrazing = 0.1;  // a facet nearly on edge ends within the cell
  if (back.incidence_cosine < kGrazing && arrival.hit.mesh >= 0) {
    back.half = std::min(back.half, 0.5 * facets_.longest_edge(arrival.hit));
  }
  back.least = arrival.range * std::abs(against);
  if (half_psi >= half_phi && steep_psi != 0.0)
    back.slide = arrival.direction + arrival.by_psi / steep_psi;
  else if (steep_phi != 0.0)
    back.slide = arrival.direction + arrival.by_phi / steep_phi;
}

/// A moving head: the sound has gone R and comes back to where the head is then, after t with
/// |R u − v t| = c t − R. Puts the range at ½ c t, and gives the beam's power there.
double Tracer::received(const Reception& reception, const Vec3& launch, Return& back) const {
  const double c = setting_.sound_speed;
  const VehicleMotion& motion = setting_.motion;
  const double range = back.range;
  const double time =
      2.0 * range * (c - launch.dot(motion.velocity)) / (c * c - motion.velocity.squaredNorm());
  back.range = 0.5 * c * time;
  back.half *= back.range / range;
  back.least *= back.range / range;
  const Vec3 from = (range * launch - time * motion.velocity).normalized();
  const Vec3 turned = (-time) * motion.rate;  // Rodrigues, for the small angles of a ping
  const double square = turned.squaredNorm();
  const double first =
      square < 1e-4 ? 1.0 - square / 6.0 : std::sin(std::sqrt(square)) / std::sqrt(square);
  const double second =
      square < 1e-4 ? 0.5 - square / 24.0 : (1.0 - std::cos(std::sqrt(square))) / square;
  const Vec3 across = turned.cross(from);
  const Vec3 direction = from + first * across + second * turned.cross(across);
  return reception.power(setting_.world_from_head.linear().transpose() * direction);
}

/// Of a ray before what it meets.
double Tracer::weight(const BeamRays& fan, std::size_t ray) const {
  return moves_ ? fan.transmitted[ray] : fan.weight[ray];
}

Vec3 Tracer::normal(const RayHit& hit, Facet& last) const {
  if (hit.mesh == kSurface) return -Vec3::UnitZ();
  if (hit.triangle != last.triangle || hit.mesh != last.mesh)
    last = {hit.mesh, hit.triangle, facets_.normal(hit)};
  return last.normal;
}

}  // namespace bathyal::sonar
