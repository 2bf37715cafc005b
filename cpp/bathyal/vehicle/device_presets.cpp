// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/device_presets.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "bathyal/vehicle/presets.hpp"

namespace bathyal {
namespace {

constexpr double kBenchmarkLag =
    (9258.0 - 6136.0) / 108700.0;  // of (6136 s + 108 700) over a cubic

double benchmark_thrust(double c) {
  const double s = c * c;
  return c * (8.9 + s * (176.0 + s * (-404.1 + s * (389.9 + s * -140.3))));
}

ThrusterTable benchmark_table(const ThrusterSide& side) {
  constexpr int kHalf = 250;
  ThrusterTable table;
  table.voltage = {16.0};
  for (int k = -kHalf; k <= kHalf; ++k) {
    const double command = static_cast<double>(k) / kHalf;
    const double thrust = benchmark_thrust(command);
    const double speed = std::sqrt(std::abs(thrust) / side.thrust);
    table.command.push_back(command);
    table.thrust.push_back(thrust);
    table.speed.push_back(std::copysign(speed, thrust));
    table.power.push_back((side.power_cubic + side.power_quartic * speed) * std::pow(speed, 3));
  }
  return table;
}

ThrusterOptions placed(ThrusterOptions thruster, int number, const Vec3& position,
                       const Vec3& direction) {
  thruster.name = "thruster_" + std::to_string(number);
  thruster.position = position;
  thruster.direction = direction;
  return thruster;
}

FinOptions remus_fin(const std::string& name, const Vec6& published) {
  FinOptions fin;
  fin.name = name;
  fin.position = Vec3(-0.638, 0.0, 0.0);
  fin.published = published;
  fin.limit = 15.0 * std::numbers::pi / 180.0;
  return fin;
}

}  // namespace

ThrusterOptions t200() {
  ThrusterOptions thruster;
  thruster.name = "t200";
  thruster.ahead = {.thrust = 0.01471037532,
                    .speed = 58.84048088,
                    .shape = 0.6896523176,
                    .voltage_exponent = 0.4798994394,
                    .power_cubic = 9.312043666e-4,
                    .power_quartic = 1.805532583e-5};
  thruster.astern = {.thrust = 0.01169216143,
                     .speed = 57.73324073,
                     .shape = 0.6496757107,
                     .voltage_exponent = 0.4530935532,
                     .power_cubic = 3.099104152e-4,
                     .power_quartic = 3.224468421e-5};
  thruster.dead_zone = 0.07166666667;
  thruster.nominal_voltage = 16.0;
  thruster.lag = kBenchmarkLag;
  return thruster;
}

ThrusterOptions t200_benchmark() {
  ThrusterOptions thruster = t200();
  thruster.name = "t200_benchmark";
  thruster.astern = thruster.ahead;
  thruster.dead_zone = 0.0;
  thruster.table = std::make_shared<const ThrusterTable>(benchmark_table(thruster.ahead));
  return thruster;
}

BatteryOptions lithium_ion_4s() {
  BatteryOptions battery;
  battery.capacity = 18.0;
  battery.resistance = 0.05;
  battery.charge = {0.0, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0};
  battery.voltage = {12.0, 13.2, 13.8, 14.2, 14.6, 15.2, 16.0, 16.8};
  return battery;
}

VehicleSystemOptions bluerov2_heavy_system(bool benchmark_thrusters) {
  VehicleSystemOptions system;
  system.vehicle = bluerov2_heavy();
  const ThrusterOptions thruster = benchmark_thrusters ? t200_benchmark() : t200();
  int number = 0;
  for (const double x : {1.0, -1.0}) {
    for (const double y : {-1.0, 1.0}) {
      system.thrusters.push_back(
          placed(thruster, ++number, Vec3(0.156 * x, 0.111 * y, -0.085), Vec3(x, -y, 0.0)));
    }
  }
  for (const double x : {1.0, -1.0}) {
    for (const double y : {-1.0, 1.0}) {
      system.thrusters.push_back(
          placed(thruster, ++number, Vec3(0.120 * x, 0.218 * y, 0.0), Vec3::UnitZ()));
    }
  }
  system.battery = lithium_ion_4s();
  return system;
}

VehicleSystemOptions remus100_system(bool equal_cross_flow) {
  VehicleSystemOptions system;
  system.vehicle = remus100(equal_cross_flow);
  constexpr double kTurns = 25.0;  // 1 500 a minute
  ThrusterOptions propeller;
  propeller.name = "propeller";
  propeller.position = Vec3(-0.72, 0.0, 0.0);
  propeller.ahead.thrust = propeller.astern.thrust = 3.86 / (kTurns * kTurns);
  propeller.ahead.torque = propeller.astern.torque = 0.543 / (kTurns * kTurns);
  propeller.ahead.speed = propeller.astern.speed = kTurns;
  system.thrusters.push_back(propeller);
  Vec6 rudder, plane;
  rudder << 0.0, -9.64, 0.0, 0.0, 0.0, 6.15;
  plane << 0.0, 0.0, 9.64, 0.0, 6.15, 0.0;
  system.fins = {remus_fin("rudder", rudder), remus_fin("stern_plane", plane)};
  return system;
}

}  // namespace bathyal
