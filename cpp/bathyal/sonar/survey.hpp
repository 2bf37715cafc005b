// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bathyal/geometry/trajectory.hpp"
#include "bathyal/sonar/echo.hpp"
#include "bathyal/world/world.hpp"

namespace bathyal {

/// Times of a survey's pings [s]: from the trajectory's first time, 1 / ping_rate apart, to its
/// last.
std::vector<double> ping_times(const SonarOptions& options, const Trajectory& world_from_vehicle);

/// A ping of a survey.
struct SurveyPing {
  std::int64_t number = 0;
  double time = 0.0;  ///< [s]
  Pose world_from_vehicle = Pose::Identity();
  Echo echo;
  Received received;
};

/// Which pings of a survey, and how.
struct PingRange {
  std::int64_t first = 0;
  std::int64_t count = -1;  ///< −1: to the end
};

/// Hears a world along a trajectory, ping after ping, and hands each on: memory does not grow with
/// their number. Ping k depends on nothing but the world, the trajectory, the sonar, `seed` and k,
/// so that parts of a survey join to the bytes of the whole. \param keep called in the order of the
/// pings; the survey ends early where it returns false.
/// \throw std::invalid_argument as Sonar::echo, with the ping's number.
void survey(const Sonar& sonar, const World& world, const Trajectory& world_from_vehicle,
            std::uint64_t seed, const PingRange& range,
            const std::function<bool(SurveyPing&&)>& keep, int num_threads = 0, bool truth = true);

}  // namespace bathyal
