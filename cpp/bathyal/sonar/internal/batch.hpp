// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bathyal/sonar/internal/tracer.hpp"

namespace bathyal::sonar {

inline constexpr std::size_t kRaysOfCast = 1024;  ///< their hits stay in the cache

/// A ray on its way along bent paths, or after reflections.
struct Traveller {
  std::size_t ray = 0;
  Vec3 from = Vec3::Zero();  ///< where its chord starts
  double power = 1.0;        ///< what reflections have left, there and back
};

/// Rays of one column, and what a thread needs to trace them; used again and again.
struct Tracer::Batch {
  std::size_t first = 0, count = 0;  ///< of the fan's rays
  EchoRow row;
  Facet facet;
  std::optional<Reception> reception;  ///< of a beam that moves
  std::vector<double> directions = std::vector<double>(3 * kRaysOfCast);
  std::vector<double> origins = std::vector<double>(3 * kRaysOfCast);
  std::vector<double> chords = std::vector<double>(3 * kRaysOfCast);
  std::vector<RayHit> hits = std::vector<RayHit>(kRaysOfCast);
  std::vector<Arrival> arrivals = std::vector<Arrival>(kRaysOfCast);
  std::vector<BentPaths::Launch> launches = std::vector<BentPaths::Launch>(kRaysOfCast);
  std::vector<Traveller> travellers;

  Vec3 direction(std::size_t i) const { return Eigen::Map<const Vec3>(directions.data() + 3 * i); }
};

}  // namespace bathyal::sonar
