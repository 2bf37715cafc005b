// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/navigation/navigation_filter.hpp"

namespace bathyal {

using ObservationRows =
    Eigen::Matrix<double, Eigen::Dynamic, kNavigationErrors, 0, kSensorChannels, kNavigationErrors>;
using ObservationVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kSensorChannels, 1>;
using ObservationMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kSensorChannels, kSensorChannels>;

/// Where the parts of the error begin.
enum NavigationPart : int {
  kPosition = 0,
  kVelocity = 3,
  kAttitude = 6,
  kGyroBias = 9,
  kAccelBias = 12,
  kLogScale = 15,
  kLogMount = 16,
  kCurrent = 19,
  kFixLever = 21
};

/// reading = predicted + slope · error + noise
struct Observation {
  ObservationVector innovation;  ///< reading − predicted
  ObservationRows slope;
  ObservationVector variance;  ///< of the channels' noise
};

/// Of the kinds that say something of the motion: depth, dvl, compass, gps, usbl, lbl, current.
bool observes_motion(SensorKind kind);

/// \pre observes_motion(reading.kind)
Observation observe(const NavigationOptions& options, const NavigationEstimate& estimate,
                    const SensorOptions& device, const SensorReading& reading);

Eigen::Matrix3d cross_matrix(const Vec3& v);

}  // namespace bathyal
