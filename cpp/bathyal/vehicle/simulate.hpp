// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "bathyal/vehicle/environment.hpp"
#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

/// Force and moment about a vehicle's origin, in its frame [N, N m].
using WrenchFunction = std::function<Vec6(double time, const VehicleState& state)>;
using FlowFunction = std::function<Flow(const Vec3& point, double time)>;

struct SimulateOptions {
  double duration = 0.0;  ///< [s], 0 or more
  double step = 0.01;     ///< [s], above 0
  double start = 0.0;     ///< time of the first state [s]
  FreeAxes free = kAllFree;
  std::shared_ptr<const Environment> environment = {};  ///< null: deep water, nothing to touch

  /// \throw std::invalid_argument
  void check() const;
};

/// States one step apart, the first and the last among them.
struct VehicleMotionRecord {
  std::vector<double> time;
  std::vector<VehicleState> state;
};

/// Integrates by the classical Runge–Kutta method of fourth order, of the position, a unit
/// quaternion and the velocity; a duration that is no whole number of steps ends with the step that
/// reaches it. \param flow how the water moves; null: as the environment
/// say, and at rest without any.
/// \throw std::invalid_argument for a step beyond the stability limit of the fastest mode at the
///        first state, or of contact, which is named, and for a pose that is not rigid
/// \throw Error where the motion runs away: it is no longer finite
VehicleMotionRecord simulate(const Vehicle& vehicle, const VehicleState& start,
                             const WrenchFunction& wrench, const FlowFunction& flow,
                             const SimulateOptions& options);

/// A mode of the motion about a state, and how large a step it bears.
struct FastestMode {
  double rate = 0.0;  ///< |λ| [1/s]
  int axis = 0;       ///< that has most of its energy, 0 to 5
  double step = 0.0;  ///< the largest at which the method still lets it die down [s]; infinite: any
};

/// Of velocity and attitude, at a state under a constant wrench, by finite differences.
FastestMode fastest_mode(const Vehicle& vehicle, const VehicleState& state, const Vec6& wrench,
                         const Flow& flow, const FreeAxes& free);

}  // namespace bathyal
