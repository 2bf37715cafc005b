// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/navigation/navigation_options.hpp"

namespace bathyal {

/// What a small vehicle carries, with errors as data sheets of the middle class have them: depth,
/// compass, imu, dvl, altimeter, gps, leak. Not those of one product.
std::vector<SensorOptions> typical_sensors();

/// A filter for them.
NavigationOptions typical_navigation();

}  // namespace bathyal
