// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

/// REMUS 100 as printed in Prestero (2001), Verification of a Six-Degree of Freedom Simulation
/// Model for the REMUS Autonomous Underwater Vehicle: weight 299 N, buoyancy 306 N, g 9.81 m/s².
/// The printed Y_vv = −1310 is ten times Z_ww of the same round hull; `equal_cross_flow` takes
/// −131. Added-mass cross terms of his tables are what C_A gives, and are left out; what is more
/// than that is lift.
VehicleOptions remus100(bool equal_cross_flow = false);

/// BlueROV2 Heavy by von Benzon and others (2022), An Open-Source Benchmark Simulator, its volume
/// such that it is neutral; origin 1 cm above the centre of mass.
VehicleOptions bluerov2_heavy();

/// A vehicle of z down, y starboard, as most tables are printed, in the axes of this house.
VehicleOptions from_z_down(VehicleOptions printed);

}  // namespace bathyal
