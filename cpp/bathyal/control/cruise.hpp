// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>

#include "bathyal/vehicle/vehicle_system.hpp"

namespace bathyal {

/// Speed, heading and depth of a vehicle with one propeller, a rudder and a stern plane.
struct CruiseOptions {
  double speed = 1.5;               ///< at which the gains are found [m/s], above 0
  double heading_frequency = 0.5;   ///< natural, of the slower modes [rad/s]
  double depth_frequency = 0.4;     ///< [rad/s]
  double speed_frequency = 0.3;     ///< [rad/s]
  double damping = 0.9;             ///< ratio
  double integral = 0.3;            ///< the integrals' poles, times the frequency; above 0
  double most_pitch = 0.45;         ///< that a depth error asks for [rad]
  int rudder = 0, stern_plane = 1;  ///< rows of the vehicle's fins
  int propeller = 0;                ///< row of its thrusters

  /// \throw std::invalid_argument that names the field
  void check() const;
};

struct CruiseTarget {
  double speed = 0.0;    ///< through the water, ahead [m/s]
  double heading = 0.0;  ///< of the bow about z from x [rad]
  double z = 0.0;        ///< of the origin in the world [m]
  double climb = 0.0;    ///< dz over the way run, of the path asked for; up positive
};

struct CruiseState {
  double heading = 0.0;  ///< integral of the error [rad s]
  double depth = 0.0;    ///< [m s]
  double speed = 0.0;    ///< [m]
};

struct CruiseOutput {
  double rudder = 0.0, stern_plane = 0.0;  ///< angles [rad]
  double thrust = 0.0;                     ///< [N]
};

/// State feedback by pole placement (Ackermann's formula) on the model, linear about straight,
/// level motion at `speed`: (sway, yaw rate, heading and its integral) by the rudder, (heave, pitch
/// rate, pitch, depth and its integral) by the stern plane. The slower two poles are those of
/// frequency and damping, one is the integral's; the rest are the vehicle's own fastest, so that
/// the fins do not work against it. Integrals rest while a fin is at its limit.
class CruiseControl {
 public:
  /// \throw std::invalid_argument as CruiseOptions::check, or where a fin does not turn the vehicle
  CruiseControl(const VehicleSystem& system, CruiseOptions options);

  const CruiseOptions& options() const { return options_; }
  const Eigen::Vector4d& heading_gains() const { return yaw_; }             ///< of v, r, ψ, ∫ψ
  const Eigen::Matrix<double, 5, 1>& depth_gains() const { return dive_; }  ///< of w, q, θ, z, ∫z

  /// \param relative velocity through the water, in the vehicle's frame
  CruiseOutput step(CruiseState& state, const VehicleState& measured, const Vec6& relative,
                    const CruiseTarget& target, double time) const;

 private:
  CruiseOptions options_;
  Vehicle vehicle_;
  double rudder_limit_, plane_limit_, least_thrust_, most_thrust_;
  Eigen::Vector4d yaw_;
  Eigen::Matrix<double, 5, 1> dive_;
};

}  // namespace bathyal
