// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "bathyal/workspace/workspace.hpp"

namespace bathyal {

struct TrimOptions {
  double gravity = 9.80665;       ///< above 0 [m/s²]; scales `righting` and `buoyancy`, no angle
  double water_density = 1025.0;  ///< [kg/m³], above 0
  int num_threads = 0;

  /// \throw std::invalid_argument
  void check() const;
};

enum class TrimStatus {
  kUpright,     ///< at rest with the vehicle's z axis upwards
  kTurnedOver,  ///< what is at rest has the z axis downwards: the vehicle would turn over
  kNeutral,     ///< every attitude is at rest: the angles are NaN
};

std::string_view to_text(TrimStatus status);

/// How a vehicle hangs in the water. One value a row of q.
struct StaticTrim {
  std::vector<double> roll;   ///< about x [rad], -π to π; positive is starboard down
  std::vector<double> pitch;  ///< about y [rad], -π/2 to π/2; positive is nose down
  std::vector<TrimStatus> status;
  /// Moment that turns the vehicle back from a right angle off this attitude [N m]: that of a small
  /// angle is this times the angle.
  std::vector<double> righting;
  /// Buoyancy less weight of all [N]: below 0 it sinks.
  std::vector<double> buoyancy;
};

/// The attitude in which Surroundings::vehicle_body, the arm in a posture and what is attached to
/// it are at rest: world_from_vehicle = Rz(heading) Ry(pitch) Rx(roll), any heading.
///
/// At rest no moment about the vehicle's origin remains: (Σ m r_cg − ρ Σ V r_cb) × g = 0, with the
/// centres of all bodies in the vehicle's frame, the arm's foot among the arm's. Of the two
/// directions of g that do so the one along the vector is stable, and returned: exact for any
/// angle. Where weight and buoyancy are equal, the vector is their common amount times that from
/// the centre of buoyancy to the centre of mass, whatever the origin; where they are not, the
/// remaining vertical force is held at the vehicle's origin (by thrusters) without a moment.
/// A mass or volume of 0 of a link, unknown, adds nothing.
/// \throw std::invalid_argument as check_joint_values, for a workspace without a vehicle body or
///        with one without mass or volume, options out of range.
StaticTrim static_trim(const Workspace& workspace, JointView q, const TrimOptions& options = {});

}  // namespace bathyal
