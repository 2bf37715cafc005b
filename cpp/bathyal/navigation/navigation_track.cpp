// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/navigation_track.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "bathyal/base/error.hpp"
#include "bathyal/navigation/internal/filter_steps.hpp"

namespace bathyal {
namespace {

struct Arrival {
  double time;
  bool later;  ///< than an imu of the same time
  std::size_t row, reading;

  bool operator<(const Arrival& other) const {
    return std::tie(time, later, row, reading) <
           std::tie(other.time, other.later, other.row, other.reading);
  }
};

std::vector<Arrival> arrivals(const std::vector<DeviceReadings>& readings) {
  std::vector<Arrival> all;
  for (std::size_t row = 0; row < readings.size(); ++row) {
    for (std::size_t i = 0; i < readings[row].readings.size(); ++i) {
      const SensorReading& reading = readings[row].readings[i];
      all.push_back({reading.arrival, reading.kind != SensorKind::imu, row, i});
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

FilterRun run_readings(const NavigationFilter& filter, NavigationState& state,
                       const std::vector<DeviceReadings>& readings, int every,
                       std::vector<NavigationStep>* record) {
  if (every < 1) throw_argument("every", "1 or more", std::to_string(every));
  FilterRun run;
  for (const DeviceReadings& device : readings) {
    const std::size_t count = device.readings.size();
    run.updates.push_back({std::vector<double>(count, std::numeric_limits<double>::quiet_NaN()),
                           std::vector<bool>(count, false)});
  }
  std::int64_t samples = 0;
  const std::vector<Arrival> order = arrivals(readings);
  bool due = false;
  for (const Arrival& arrival : order) {
    const DeviceReadings& from = readings[arrival.row];
    if (due && !arrival.later) run.estimate.push_back(state.now);
    if (!arrival.later) due = samples++ % every == 0;
    const NavigationUpdate got =
        filter.update(state, from.device, from.readings[arrival.reading], record);
    if (got.used) run.updates[arrival.row].nis[arrival.reading] = got.nis;
    run.updates[arrival.row].accepted[arrival.reading] = got.accepted;
  }
  if (due) run.estimate.push_back(state.now);
  return run;
}

}  // namespace bathyal
