// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/vehicle/vehicle_system.hpp"

namespace bathyal {

/// Blue Robotics' T200 with its Basic ESC: the law that `fit_thruster` finds in their bollard tests
/// (10 to 20 V); the tests have neither torque nor lag, which is that of `t200_benchmark`.
ThrusterOptions t200();

/// The T200 as von Benzon and others (2022), An Open-Source Benchmark Simulator, have it:
/// thrust −140.3 c⁹ + 389.9 c⁷ − 404.1 c⁵ + 176 c³ + 8.9 c N of the command c at any voltage, at
/// most 30.6 N; the lag is the mean delay of their transfer function.
ThrusterOptions t200_benchmark();

/// Of four lithium-ion cells in series, 14.8 V, 18 A h as Blue Robotics sells it. Open-circuit
/// voltage and inner resistance (0.05 Ω) are typical of such cells, not measured.
BatteryOptions lithium_ion_4s();

/// BlueROV2 Heavy with eight T200 (names as its autopilot's: 1 to 4 level, at 45°, 5 to 8
/// vertical; places of von Benzon and others 2022) on one battery.
VehicleSystemOptions bluerov2_heavy_system(bool benchmark_thrusters = false);

/// REMUS 100 with its propeller (3.86 N and 0.543 N m at 1 500 turns a minute; Prestero 2001) and
/// fins: `rudder`, positive turns it to port, and `stern_plane`, positive pitches the bow down.
VehicleSystemOptions remus100_system(bool equal_cross_flow = false);

}  // namespace bathyal
