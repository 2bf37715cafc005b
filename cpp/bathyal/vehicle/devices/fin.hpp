// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

/// A rudder, stern plane or fixed fin, in the vehicle's frame. Its force is either published,
///
///   τ = published · u |u| δ,
///
/// where `area` is 0, or that of a wing in the water that it meets, with stall.
struct FinOptions {
  std::string name = "fin";
  Vec3 position = Vec3::Zero();   ///< of its centre of pressure [m]
  Vec3 forward = Vec3::UnitX();   ///< its chord at angle 0, trailing edge to leading edge
  Vec3 shaft = Vec3::UnitZ();     ///< that it turns about, to the right hand; square to `forward`
  double area = 0.0;              ///< [m²], 0 or more; 0: `published`
  double lift_slope = 0.0;        ///< dC_L/dα [1/rad], 0 or more
  double drag = 0.0;              ///< C_D without lift, 0 or more
  double induced_drag = 0.0;      ///< of C_L², 0 or more
  double stall = 0.35;            ///< angle of attack at which the flow comes off [rad]
  double water_density = 1025.0;  ///< [kg/m³]
  Vec6 published = Vec6::Zero();  ///< force and moment a (m/s)² and rad
  double limit = 0.35;            ///< largest angle [rad]
  double rate = 0.0;              ///< largest turning rate [rad/s]; 0: any
  double lag = 0.0;               ///< time constant [s]

  /// \throw std::invalid_argument that names the field
  void check() const;
};

struct FinState {
  double angle = 0.0;  ///< δ [rad]
};

class Fin {
 public:
  /// \throw std::invalid_argument as FinOptions::check
  explicit Fin(FinOptions options);

  const FinOptions& options() const { return options_; }

  /// The angle after `time`: it lags behind the command, held within the limit, and is no faster
  /// than the rate.
  FinState advanced(const FinState& state, double command, double time) const;

  /// Lift and drag coefficients at an angle of attack within ±π [rad]: linear up to the stall and a
  /// flat plate beyond, blended (Beard and McLain 2012, Small Unmanned Aircraft, eq. 4.9, 4.10).
  std::pair<double, double> coefficients(double attack) const;

  /// Force and moment about the vehicle's origin. \param relative velocity through the water
  Vec6 wrench(double angle, const Vec6& relative) const;

 private:
  FinOptions options_;
  Vec3 side_;  // shaft × forward
};

}  // namespace bathyal
