// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "bathyal/vehicle/devices/thruster_table.hpp"
#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

/// A thruster that turns one way: ahead or astern. n is the propeller's speed [1/s].
struct ThrusterSide {
  double thrust = 0.0;  ///< of n² [N s²]
  double torque = 0.0;  ///< of n², that the water puts on the propeller [N m s²]
  double speed = 0.0;   ///< at full command and the nominal voltage [1/s]
  double shape = 1.0;   ///< speed is that times xˢʰᵃᵖᵉ, x the command past the dead zone
  double voltage_exponent = 0.0;  ///< and times (voltage / nominal) to this
  double power_cubic = 0.0;       ///< electrical power is cubic |n|³ + quartic n⁴ [W s³]
  double power_quartic = 0.0;     ///< [W s⁴]

  /// \param name of the side, for the error. \throw std::invalid_argument
  void check(const std::string& name) const;
};

/// A thruster, in the vehicle's frame. Its force is
///
///   T = k n|n| − inflow |n| u_a,
///
/// with k by the side and u_a the speed of the water that it meets along its direction: a propeller
/// whose thrust coefficient is linear in its advance ratio (Fossen 2011, eq. 12.224; see
/// `set_propeller`). A table, where there is one, gives what is reached in still water, and the law
/// the difference while the speed lags.
struct ThrusterOptions {
  std::string name = "thruster";
  Vec3 position = Vec3::Zero();    ///< in the vehicle's frame [m]
  Vec3 direction = Vec3::UnitX();  ///< of its force ahead; of any length above 0
  ThrusterSide ahead = {};
  ThrusterSide astern = {};
  double inflow = 0.0;         ///< [N s² / m], 0 or more
  double torque_inflow = 0.0;  ///< the same of the torque [N s²]
  int spin = 1;            ///< 1: right-handed, its moment on the vehicle is against `direction`
  double dead_zone = 0.0;  ///< commands up to this size stop it, at the nominal voltage; below 1
  double nominal_voltage = 16.0;  ///< [V]; the dead zone goes with nominal / actual
  double lag = 0.0;               ///< time constant of the speed [s]
  std::shared_ptr<const ThrusterTable> table = {};  ///< null: the law alone

  /// \throw std::invalid_argument that names the field
  void check() const;
};

/// Sets law and inflow from coefficients in the advance ratio J = u_a / (n D): K_T = k0 + k1 J,
/// K_Q = q0 + q1 J, of the same size astern. \param diameter D [m]
/// \throw std::invalid_argument for k1 or q1 above 0, or a diameter or density not above 0
void set_propeller(ThrusterOptions& options, double diameter, std::pair<double, double> thrust,
                   std::pair<double, double> torque, double water_density);

/// What changes of it in time.
struct ThrusterState {
  double speed = 0.0;  ///< of the propeller [1/s]
};

/// What a command at a voltage makes of it; held for a step.
struct ThrusterDrive {
  double speed = 0.0;   ///< that it settles at [1/s]
  double thrust = 0.0;  ///< of the table beyond the law's [N]
  double power = 0.0;   ///< [W]
};

class Thruster {
 public:
  /// \throw std::invalid_argument as ThrusterOptions::check
  explicit Thruster(ThrusterOptions options);

  const ThrusterOptions& options() const { return options_; }

  /// \param command −1 to 1, beyond as at the ends: its electronics hold it there
  ThrusterDrive drive(double command, double voltage) const;

  /// The speed after `time`, exactly, under a drive.
  ThrusterState advanced(const ThrusterState& state, const ThrusterDrive& drive, double time) const;

  double thrust(double speed, const ThrusterDrive& drive,
                double inflow_speed = 0.0) const;                ///< [N]
  double torque(double speed, double inflow_speed = 0.0) const;  ///< on the propeller [N m]
  double power(double speed, const ThrusterDrive& drive) const;  ///< [W], 0 or more

  /// Force and moment about the vehicle's origin. \param relative velocity through the water
  Vec6 wrench(double speed, const ThrusterDrive& drive, const Vec6& relative) const;

  /// Its two parts: in still water, and what inflow changes.
  Vec6 still_wrench(double speed, const ThrusterDrive& drive) const;
  Vec6 inflow_wrench(double speed, const Vec6& relative) const;
  bool meets_inflow() const { return options_.inflow > 0.0 || options_.torque_inflow > 0.0; }

  /// What it settles at in still water.
  ThrusterPoint steady(double command, double voltage) const;

  /// The command whose steady thrust is `thrust`; beyond what it can give, the nearest.
  double command_for(double thrust, double voltage) const;

  /// Force and moment about the origin of a thrust of 1 N ahead, its torque with it.
  const Vec6& column() const { return column_; }

 private:
  const ThrusterSide& side(double speed) const {
    return speed >= 0.0 ? options_.ahead : options_.astern;
  }
  double settled(double command, double voltage) const;
  double command_in_table(double thrust, double voltage) const;

  ThrusterOptions options_;
  Vec6 axis_, column_;  // (d, r × d); with the torque
};

}  // namespace bathyal
