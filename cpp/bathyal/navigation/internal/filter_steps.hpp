// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/navigation/internal/observation.hpp"

namespace bathyal {

/// error after = [top; D] error before + noise: the rows from the biases on are diagonal, 1 but for
/// the current, of which a part is kept.
struct Transition {
  static constexpr int kTop = kGyroBias;
  Eigen::Matrix<double, kTop, kNavigationErrors> top =
      Eigen::Matrix<double, kTop, kNavigationErrors>::Identity();
  double current_kept = 1.0;
};

using Gain =
    Eigen::Matrix<double, kNavigationErrors, Eigen::Dynamic, 0, kNavigationErrors, kSensorChannels>;

/// The gain a reading came in with, as the smoother needs it.
struct Correction {
  ObservationRows slope;
  Gain gain;
  ObservationMatrix inverse;  ///< of the innovation's covariance
  ObservationVector innovation;
};

/// One entry of the record, with the estimate after it.
struct NavigationStep {
  bool is_correction = false;
  bool is_row = false;  ///< a predict of the caller's ends here
  Transition transition;
  Correction correction;
  NavigationEstimate after;
};

/// Brings the estimate to an input's time and takes the input over.
Transition apply_prediction(const NavigationOptions& options, NavigationEstimate& estimate,
                            const NavigationInput& input);

/// Brings the estimate to a time between inputs: the last one holds.
Transition hold_until(const NavigationOptions& options, NavigationEstimate& estimate, double time);

/// Applies a reading at the estimate's time, unless the gate refuses it; the correction is written
/// where it is accepted.
NavigationUpdate apply_reading(const NavigationOptions& options, NavigationEstimate& estimate,
                               const SensorOptions& device, const SensorReading& reading,
                               Correction& correction);

/// Adds an error to an estimate; the covariance stays.
void add_error(NavigationEstimate& estimate, const NavigationVector& error);

}  // namespace bathyal
