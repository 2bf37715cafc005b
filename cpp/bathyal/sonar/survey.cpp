// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/survey.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"

namespace bathyal {

std::vector<double> ping_times(const SonarOptions& options, const Trajectory& world_from_vehicle) {
  const double start = world_from_vehicle.time().empty() ? 0.0 : world_from_vehicle.time().front();
  const double end = world_from_vehicle.time().empty() ? 0.0 : world_from_vehicle.time().back();
  constexpr double kMostPings = 1e8;
  const double count = std::floor((end - start) * options.ping_rate * (1.0 + 1e-12)) + 1.0;
  if (!(count <= kMostPings)) {
    throw_argument("trajectory", "no more than 10⁸ pings", to_text(count));
  }
  std::vector<double> times(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < times.size(); ++k) {
    times[k] = std::min(end, start + static_cast<double>(k) / options.ping_rate);
  }
  return times;
}

void survey(const Sonar& sonar, const World& world, const Trajectory& world_from_vehicle,
            std::uint64_t seed, const PingRange& range,
            const std::function<bool(SurveyPing&&)>& keep, int num_threads, bool truth) {
  const SonarOptions& options = sonar.options();
  const std::vector<double> times = ping_times(options, world_from_vehicle);
  const auto total = static_cast<std::int64_t>(times.size());
  if (range.first < 0 || range.first > total || range.count < -1 ||
      range.count > total - range.first) {
    throw_argument("first", "pings within the survey's " + std::to_string(total),
                   std::to_string(range.count) + " from " + std::to_string(range.first));
  }
  const std::int64_t end = range.count < 0 ? total : range.first + range.count;
  for (std::int64_t k = range.first; k < end; ++k) {
    SurveyPing ping;
    ping.number = k;
    ping.time = times[static_cast<std::size_t>(k)];
    ping.world_from_vehicle = world_from_vehicle.at(ping.time);
    try {
      ping.echo =
          sonar.echo(world.at(ping.time, num_threads), world.water(), ping.world_from_vehicle, k,
                     num_threads, motion_at(world_from_vehicle, ping.time), truth);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("ping " + std::to_string(k) + " at " + to_text(ping.time) +
                                  " s: " + error.what());
    }
    const Pose world_from_sonar =
        ping.world_from_vehicle * options.vehicle_from_sonar * head_pose(options, k);
    ping.received = receive(options, ping.echo, {seed, world_from_sonar, ping.time}, num_threads);
    if (!keep(std::move(ping))) return;
  }
}

}  // namespace bathyal
