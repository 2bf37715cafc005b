// SPDX-License-Identifier: BSD-3-Clause
// Rays along the bent paths of sound: chord after chord, each hit moved from its chord to the arc.
#include <algorithm>
#include <cmath>
#include <span>

#include "bathyal/sonar/internal/batch.hpp"
#include "bathyal/sonar/internal/tracer.hpp"

namespace bathyal::sonar {

void Tracer::arrive_bent(Batch& batch) const {
  const BentPaths& bent = *setting_.bent;
  const Vec3 origin = setting_.world_from_head.translation();
  std::vector<Traveller>& going = batch.travellers;
  going.clear();
  for (std::size_t i = 0; i < batch.count; ++i) {
    batch.arrivals[i].hit = RayHit();
    batch.launches[i] = bent.launch(batch.direction(i));
    going.push_back({i, origin, 1.0});
  }
  for (std::size_t chord = 0; !going.empty(); ++chord) {
    for (std::size_t i = 0; i < going.size(); ++i) {
      const BentPaths::Launch& launch = batch.launches[going[i].ray];
      const Vec3 to = origin + bent.place(launch, bent.chord_ends(launch)[chord]);
      Eigen::Map<Vec3>(batch.origins.data() + 3 * i) = going[i].from;
      Eigen::Map<Vec3>(batch.chords.data() + 3 * i) = to - going[i].from;
    }
    const auto rows = static_cast<Index>(going.size());
    setting_.world.scene.cast(PointView(batch.origins.data(), chord == 0 ? 1 : rows, 3),
                              PointView(batch.chords.data(), rows, 3),
                              std::span<RayHit>(batch.hits.data(), going.size()), 1);
    std::size_t left = 0;
    for (std::size_t i = 0; i < going.size(); ++i) {
      const Vec3 way = Eigen::Map<const Vec3>(batch.chords.data() + 3 * i);
      const double length = way.norm();
      RayHit& hit = batch.hits[i];
      const bool last = chord + 1 == bent.chord_ends(batch.launches[going[i].ray]).size();
      const bool over = meets_surface(going[i].from, way / length, hit);
      if (hit.range <= length || (last && hit.mesh != -1)) {
        arrive_on_chord(batch, going[i], chord, hit.range / length * way, hit);
      } else if (!last &&
                 !(over && hit.mesh == -1 && going[i].from.z() + way.z() > *setting_.surface)) {
        going[left] = going[i];
        going[left++].from += way;
      }
    }
    going.resize(left);
  }
}

/// A hit at `on_chord` from the chord's start: of the steps of the arc, the one that is near it
/// meets its plane.
void Tracer::arrive_on_chord(Batch& batch, const Traveller& traveller, std::size_t chord,
                             const Vec3& on_chord, const RayHit& hit) const {
  const BentPaths& bent = *setting_.bent;
  const BentPaths::Launch& launch = batch.launches[traveller.ray];
  Arrival& arrival = batch.arrivals[traveller.ray];
  arrival.hit = hit;
  arrival.normal = normal(hit, batch.facet);

  const Vec3 met = traveller.from + on_chord - setting_.world_from_head.translation();
  const std::vector<int>& ends = bent.chord_ends(launch);
  const int first = chord == 0 ? 0 : ends[chord - 1];
  const int end = ends[chord];
  const double guess = first + std::floor(on_chord.norm() / bent.step_range());
  int step = std::clamp(static_cast<int>(guess), first, end - 1);
  Vec3 from, way;
  double part = 0.0;
  const auto look = [&](int at) {
    step = at;
    from = bent.place(launch, step);
    way = bent.place(launch, step + 1) - from;
    part = way.dot(met - from) / way.squaredNorm();
  };
  look(step);
  while (part > 1.0 && step + 1 < end) look(step + 1);  // where sound is faster, steps are longer
  while (part < 0.0 && step > first) look(step - 1);
  const double facing = arrival.normal.dot(way) / way.norm();
  if (std::abs(facing) > 10.0 * kLeastCosine) {
    const double moved = arrival.normal.dot(met - from) / arrival.normal.dot(way) - part;
    part += std::clamp(moved, -0.05, 0.05);
  }
  const BentPaths::State before = bent.state(launch, step);
  const BentPaths::State after = bent.state(launch, step + 1);
  const double faster = 0.5 * (after.speed / before.speed - 1.0);  // the first part takes longer
  const double time = part + faster * part * (1.0 - part);
  arrival.point = setting_.world_from_head.translation() + from + part * way;
  arrival.range = bent.step_range() * (step + time);
  const double inside = std::clamp(part, 0.0, 1.0);
  arrival.length = arrival.range * std::sqrt(before.tube + inside * (after.tube - before.tube));
  arrival.direction =
      BentPaths::turned(launch, before.turned + inside * (after.turned - before.turned));
}

}  // namespace bathyal::sonar
