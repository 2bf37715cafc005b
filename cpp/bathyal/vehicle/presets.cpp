// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/presets.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace bathyal {
namespace {

enum Axis { kU, kV, kW, kP, kQ, kR };

/// Which of an axis' numbers change sign when y and z are turned round.
constexpr std::array<double, 6> kSigns{1.0, -1.0, -1.0, 1.0, -1.0, -1.0};

double sign(int axis) { return kSigns[static_cast<std::size_t>(axis)]; }

}  // namespace

VehicleOptions from_z_down(VehicleOptions printed) {
  const Mat6 signs = Eigen::Map<const Vec6>(kSigns.data()).asDiagonal();
  const Eigen::Matrix3d turn = Vec3(1.0, -1.0, -1.0).asDiagonal();
  printed.body.center_of_mass = turn * printed.body.center_of_mass;
  printed.body.inertia = turn * printed.body.inertia * turn;
  for (VehiclePart& part : printed.parts) part.center = turn * part.center;
  printed.added_mass = signs * printed.added_mass * signs;
  printed.linear_drag = signs * printed.linear_drag * signs;
  for (ForceTerm& term : printed.terms) {
    term.coefficient *= sign(term.row) * sign(term.a) * (term.absolute ? 1.0 : sign(term.b));
  }
  return printed;
}

VehicleOptions remus100(bool equal_cross_flow) {
  VehicleOptions remus;
  remus.name = "remus100";
  remus.gravity = 9.81;
  remus.body.mass = 299.0 / remus.gravity;
  remus.body.volume = 306.0 / (remus.gravity * remus.water_density);
  remus.body.center_of_mass = Vec3(0.0, 0.0, 0.0196);
  const double aside = remus.body.mass * 0.0196 * 0.0196;  // printed about the centre of buoyancy
  remus.body.inertia = Vec3(0.177 - aside, 3.45 - aside, 3.45).asDiagonal();

  Vec6 diagonal;
  diagonal << 0.93, 35.5, 35.5, 0.0704, 4.88, 4.88;
  remus.added_mass = diagonal.asDiagonal();
  remus.added_mass(kV, kR) = remus.added_mass(kR, kV) = -1.93;
  remus.added_mass(kW, kQ) = remus.added_mass(kQ, kW) = 1.93;

  const double across = equal_cross_flow ? -131.0 : -1310.0;
  remus.terms = {
      {kU, kU, kU, true, -1.62},
      {kV, kV, kV, true, across},
      {kV, kR, kR, true, 0.632},
      {kW, kW, kW, true, -131.0},
      {kW, kQ, kQ, true, -0.632},
      {kP, kP, kP, true, -0.130},
      {kQ, kW, kW, true, 3.18},
      {kQ, kQ, kQ, true, -188.0},
      {kR, kV, kV, true, -3.18},
      {kR, kR, kR, true, -94.0},
      // lift of hull and fins: printed, less what C_A gives
      {kV, kU, kV, false, -28.6},
      {kV, kU, kR, false, 5.22 + 0.93},
      {kW, kU, kW, false, -28.6},
      {kW, kU, kQ, false, -5.22 - 0.93},
      {kQ, kU, kW, false, 24.0 - (35.5 - 0.93)},
      {kQ, kU, kQ, false, -2.0 - 1.93},
      {kR, kU, kV, false, -24.0 + (35.5 - 0.93)},
      {kR, kU, kR, false, -2.0 - 1.93},
  };
  constexpr double kRadius = 0.0955;  // of a hull 1.33 m long
  for (int k = -4; k <= 4; ++k) remus.parts.push_back({Vec3(0.14 * k, 0.0, 0.0), kRadius, 1.0});
  return from_z_down(remus);
}

VehicleOptions bluerov2_heavy() {
  VehicleOptions rov;
  rov.name = "bluerov2_heavy";
  rov.gravity = 9.82;
  rov.body.mass = 13.5;
  rov.body.volume = rov.body.mass / rov.water_density;
  rov.body.center_of_mass = Vec3(0.0, 0.0, 0.01);
  rov.body.inertia = Vec3(0.26, 0.23, 0.37).asDiagonal();
  Vec6 added, linear, quadratic;
  added << 6.36, 7.12, 18.68, 0.189, 0.135, 0.222;
  linear << 13.7, 0.0, 33.0, 0.0, 0.8, 0.0;
  quadratic << 141.0, 217.0, 190.0, 1.19, 0.47, 1.5;
  rov.added_mass = added.asDiagonal();
  rov.linear_drag = linear.asDiagonal();
  for (int axis = 0; axis < 6; ++axis) {
    rov.terms.push_back({axis, axis, axis, true, -quadratic[axis]});
  }
  for (const double x : {-0.118, 0.118}) {  // 0.457 × 0.575 × 0.254 m
    for (const double y : {-0.177, 0.177}) {
      for (const double z : {-0.017, 0.017}) rov.parts.push_back({Vec3(x, y, z), 0.11, 1.0});
    }
  }
  return from_z_down(rov);
}

}  // namespace bathyal
