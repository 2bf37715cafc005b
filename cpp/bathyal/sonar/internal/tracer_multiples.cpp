// SPDX-License-Identifier: BSD-3-Clause
// Multiples: a ray goes on from what it met as from a mirror, and what scatters it farther on comes
// back by the same way. After the first reflection sound runs straight, at the times of the water's
// own sound speed.
#include <cmath>
#include <span>

#include "bathyal/sonar/internal/batch.hpp"
#include "bathyal/sonar/internal/tracer.hpp"

namespace bathyal::sonar {
namespace {

constexpr double kLeastPower = 1e-12;  ///< of a ray that is worth following
constexpr double kOff = 1e-6;          ///< by which it leaves a surface [m]

Vec3 mirrored(const Vec3& vector, const Vec3& normal) {
  return vector - 2.0 * vector.dot(normal) * normal;
}

}  // namespace

/// Turns an arrival into a ray that leaves it. Its power is reflected twice, there and back.
bool Tracer::reflect(Arrival& arrival, double& power) const {
  const double against = arrival.normal.dot(arrival.direction);
  if (std::abs(against) < kLeastCosine) return false;
  if (arrival.hit.mesh != kSurface) {
    const double once = setting_.tables.reflected(setting_.world.material(arrival.hit),
                                                  std::fmin(std::abs(against), 1.0));
    power *= once * once;
  }
  if (power < kLeastPower) return false;
  for (Vec3* vector : {&arrival.direction, &arrival.by_psi, &arrival.by_phi}) {
    *vector = mirrored(*vector, arrival.normal);
  }
  arrival.point -= std::copysign(kOff * (1.0 + arrival.range), against) * arrival.normal;
  return true;
}

void Tracer::follow_reflections(const BeamRays& fan, Batch& batch) const {
  std::vector<Traveller>& going = batch.travellers;
  going.clear();
  for (std::size_t i = 0; i < batch.count; ++i) {
    const Arrival& arrival = batch.arrivals[i];
    if (arrival.hit.mesh != -1 && arrival.range < options_.range)
      going.push_back({i, Vec3::Zero(), 1.0});
  }
  const double top = setting_.world_from_head.translation().z() + setting_.sonar_depth;
  for (int bounce = 0; bounce < options_.multiples && !going.empty(); ++bounce) {
    std::size_t left = 0;
    for (const Traveller& traveller : going) {
      Traveller next = traveller;
      Arrival& arrival = batch.arrivals[next.ray];
      if (!reflect(arrival, next.power)) continue;
      Eigen::Map<Vec3>(batch.origins.data() + 3 * left) = arrival.point;
      Eigen::Map<Vec3>(batch.chords.data() + 3 * left) = arrival.direction;
      going[left++] = next;
    }
    going.resize(left);
    if (left == 0) return;
    const auto rows = static_cast<Index>(left);
    setting_.world.scene.cast(PointView(batch.origins.data(), rows, 3),
                              PointView(batch.chords.data(), rows, 3),
                              std::span<RayHit>(batch.hits.data(), left), 1);
    left = 0;
    for (std::size_t i = 0; i < going.size(); ++i) {
      Arrival& arrival = batch.arrivals[going[i].ray];
      RayHit& hit = batch.hits[i];
      meets_surface(arrival.point, arrival.direction, hit);
      if (hit.mesh == -1) continue;
      const double from = arrival.point.z();
      arrival.hit = hit;
      arrival.point += hit.range * arrival.direction;
      arrival.normal = normal(hit, batch.facet);
      arrival.length += hit.range;
      arrival.range +=
          setting_.bent == nullptr
              ? hit.range
              : setting_.bent->slow_range(hit.range, top - from, top - arrival.point.z());
      if (arrival.range >= options_.range) continue;
      Return back =
          returned(fan, arrival, weight(fan, batch.first + going[i].ray) * going[i].power);
      if (moves_) back.weight *= received(*batch.reception, batch.direction(going[i].ray), back);
      batch.row.add(back);
      going[left++] = going[i];
    }
    going.resize(left);
  }
}

}  // namespace bathyal::sonar
