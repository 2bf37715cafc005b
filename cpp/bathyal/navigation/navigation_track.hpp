// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/navigation/navigation_filter.hpp"

namespace bathyal {

/// Readings of one device, in order of their time.
struct DeviceReadings {
  int device = 0;
  std::vector<SensorReading> readings;
};

/// What became of the readings of one device: one value a reading.
struct DeviceUpdates {
  std::vector<double> nis;  ///< NaN where it was not used
  std::vector<bool> accepted;
};

struct FilterRun {
  std::vector<NavigationEstimate> estimate;  ///< after each sample of the imu and what came with it
  std::vector<DeviceUpdates> updates;        ///< one a device, as given
};

/// Hands readings to the filter as they arrive; of several at one time those of an imu first, then
/// by the order of the devices. \param every keeps each so-manieth estimate, 1 or more
/// \throw std::invalid_argument as NavigationFilter::update
FilterRun run_readings(const NavigationFilter& filter, NavigationState& state,
                       const std::vector<DeviceReadings>& readings, int every = 1,
                       std::vector<NavigationStep>* record = nullptr);

}  // namespace bathyal
