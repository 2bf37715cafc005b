// SPDX-License-Identifier: BSD-3-Clause
// Rays along the bent paths of sound: chord after chord, each hit moved from its chord to the arc.
#include <algorithm>
#include <cmath>
#include <span>

#include "bathyal/sonar/internal/batch.hpp"
#include "bathyal/sonar/internal/tracer.hpp"

namespace bathyal::sonar {

void Tracer::arrive_bent(Batch& batch) const {
  const Vec3 origin = setting_.world_from_head.translation();
  std::vector<Traveller>& going = batch.travellers;
  going.clear();
  for (std::size_t i = 0; i < batch.count; ++i) {
    batch.arrivals[i].hit = RayHit();
    going.push_back({i, setting_.bent->launch(batch.direction(i)), origin, 1.0});
  }
  const int last = setting_.bent->chords() - 1;
  for (int chord = 0; chord <= last && !going.empty(); ++chord) {
    for (std::size_t i = 0; i < going.size(); ++i) {
      const Vec3 to = origin + setting_.bent->place(going[i].launch, chord + 1.0);
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
      const bool over = meets_surface(going[i].from, way / length, hit);
      if (hit.range <= length || (chord == last && hit.mesh != -1)) {
        arrive_on_chord(batch, i, chord, hit);
      } else if (!(over && hit.mesh == -1 && going[i].from.z() + way.z() > *setting_.surface)) {
        going[left] = going[i];
        going[left++].from += way;
      }
    }
    going.resize(left);
  }
}

void Tracer::arrive_on_chord(Batch& batch, std::size_t i, int chord, const RayHit& hit) const {
  const BentPaths& bent = *setting_.bent;
  const Traveller& traveller = batch.travellers[i];
  const Vec3 way = Eigen::Map<const Vec3>(batch.chords.data() + 3 * i);
  const double length = way.norm();
  const Vec3 along = way / length;
  Arrival& arrival = batch.arrivals[traveller.ray];
  arrival.hit = hit;
  arrival.normal = hit.mesh == kSurface ? Vec3(-Vec3::UnitZ()) : facets_.normal(hit);

  // On the arc: the chord's point and 4 f (1 − f) times the middle's distance from the chord, moved
  // along the chord into the plane of what was hit.
  double part = hit.range / length;
  Vec3 off = Vec3::Zero();
  if (part < 1.0) {
    const Vec3 middle = setting_.world_from_head.translation() +
                        bent.place(traveller.launch, chord + 0.5) - traveller.from - 0.5 * way;
    off = 4.0 * part * (1.0 - part) * middle;
    const double facing = arrival.normal.dot(along);
    if (std::abs(facing) > 10.0 * kLeastCosine) {
      const double moved = -arrival.normal.dot(off) / facing;
      part += std::clamp(moved / length, -0.01, 0.01);
    }
  }
  const BentPaths::State from = bent.state(traveller.launch, chord);
  const BentPaths::State to = bent.state(traveller.launch, chord + 1);
  const double inside = std::clamp(part, 0.0, 1.0);
  const double faster = 0.5 * (to.speed / from.speed - 1.0);  // the first part takes longer
  const double time = part + faster * inside * (1.0 - inside);
  arrival.point = traveller.from + part * way + off;
  arrival.range = bent.chord_range() * (chord + time);
  arrival.length = arrival.range * std::sqrt(from.tube + inside * (to.tube - from.tube));
  arrival.direction =
      BentPaths::turned(traveller.launch, from.turned + inside * (to.turned - from.turned));
}

}  // namespace bathyal::sonar
