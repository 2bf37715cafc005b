// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "arrays.hpp"
#include "bathyal/navigation/sensor.hpp"

// What the bindings of sensors and of the filter share.

namespace bathyal::python {

/// Readings of one sensor, in order of their time.
struct SensorReadings {
  SensorOptions sensor;
  std::vector<SensorReading> rows;
};

/// (N, 3) roll, pitch, yaw of (N,) yaw or of themselves.
PointMatrix attitude_argument(const ArrayLike& object);

/// (N,) as a vector.
std::vector<double> numbers_argument(std::string_view name, const ArrayLike& object);

/// (N, 3), owned.
PointMatrix rows_of_three(std::string_view name, const ArrayLike& object);

}  // namespace bathyal::python
