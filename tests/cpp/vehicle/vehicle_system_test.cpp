// SPDX-License-Identifier: BSD-3-Clause
// Vehicles with their devices: published turns, conservation, order of the method, refusals.
#include "bathyal/vehicle/vehicle_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/device_presets.hpp"
#include "bathyal/vehicle/simulate.hpp"

namespace bathyal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Steady turn of REMUS by its devices: level in pitch, w = q = 0. \return to port [°/s]
double turn(double rudder) {
  const VehicleSystem remus(remus100_system());
  VehicleSystemState state = remus.rest();
  state.thrusters[0].speed = 25.0;
  state.fins[0].angle = rudder;
  const VehicleCommands commands{{1.0}, {rudder, 0.0}, {}};
  constexpr double kStep = 0.005;
  double heel = 0.0;
  for (int k = 0; k < 40000; ++k) {
    state.motion.world_from_vehicle.linear() =
        Eigen::AngleAxisd(heel, Vec3::UnitX()).toRotationMatrix();
    const Vec6 wrench = remus.device_wrench(state, commands, {});
    state.motion.velocity +=
        kStep * remus.vehicle().acceleration(state.motion, wrench, {},
                                             {true, true, false, true, false, true});
    state.motion.velocity[3] *= 0.999;  // the steady turn alone is asked for
    heel += kStep * state.motion.velocity[3];
  }
  return state.motion.velocity[5] / kDegree;
}

TEST(RemusSystem, TurnsAsPublished) {
  EXPECT_NEAR(turn(4.0 * kDegree), 9.36, 0.0936);
  EXPECT_NEAR(turn(-4.0 * kDegree), -9.02, 0.0902);
}

TEST(RemusSystem, StepsAsTheSimulation) {
  const VehicleSystem remus(remus100_system());
  VehicleSystemState state = remus.rest();
  state.thrusters[0].speed = 25.0;
  const VehicleCommands commands{{1.0}, {0.05, -0.02}, {}};
  state.fins[0].angle = 0.05;
  state.fins[1].angle = -0.02;
  SimulateOptions how;
  how.duration = 20.0;
  const auto expected = simulate(
      remus.vehicle(), {},
      [&](double, const VehicleState& motion) {
        VehicleSystemState at = state;
        at.motion = motion;
        return remus.device_wrench(at, commands, {});
      },
      {}, how);
  VehicleSystemState found = state;
  for (int k = 0; k < 2000; ++k) remus.step(found, commands, Flow(), 0.01);
  EXPECT_LT(
      (found.motion.world_from_vehicle.matrix() - expected.state.back().world_from_vehicle.matrix())
          .norm(),
      1e-9);
}

VehicleSystemState flown(double step, int count) {
  VehicleSystemOptions options = bluerov2_heavy_system();
  options.battery.reset();
  for (ThrusterOptions& thruster : options.thrusters) {
    thruster.lag = 0.2;
    thruster.inflow = 0.1;
  }
  const VehicleSystem rov(options);
  VehicleSystemState state = rov.rest();
  const VehicleCommands commands{{0.5, 0.4, -0.3, -0.5, 0.3, 0.35, 0.3, 0.4}, {}, {}};
  for (int k = 0; k < count; ++k) rov.step(state, commands, Flow(), step);
  return state;
}

TEST(RovSystem, ConvergesWithTheFourthPowerOfTheStep) {
  const auto exact = flown(0.0025, 800);
  const auto off = [&](double step, int count) {
    return (flown(step, count).motion.velocity - exact.motion.velocity).norm();
  };
  const double ratio = off(0.08, 25) / off(0.04, 50);
  EXPECT_GT(ratio, 12.0);
}

TEST(RovSystem, SagsUnderItsThrusters) {
  const VehicleSystem rov(bluerov2_heavy_system());
  VehicleSystemState state = rov.rest();
  const VehicleCommands commands{std::vector<double>(8, 0.7), {}, {}};
  for (int k = 0; k < 200; ++k) rov.step(state, commands, Flow(), 0.01);
  const BatteryLoad load = rov.supply(state, commands);
  EXPECT_FALSE(load.collapsed);
  EXPECT_LT(load.voltage, 16.0);
  double power = 0.0;
  for (std::size_t i = 0; i < 8; ++i)
    power += rov.thrusters()[i].power(state.thrusters[i].speed, {});
  EXPECT_NEAR(load.voltage * load.current, power, 1e-8);
  EXPECT_LT(state.battery.charge, 1.0);
  EXPECT_NEAR(1.0 - state.battery.charge, load.current * 2.0 / (3600.0 * 18.0), 1e-4);
}

TEST(RovSystem, RisesWhenItLetsGo) {
  VehicleSystemOptions options = bluerov2_heavy_system();
  options.drop_weights.push_back({"ballast", Vec3::Zero(), 1.0, 0.0});
  const VehicleSystem rov(options);
  VehicleSystemState state = rov.rest();
  VehicleCommands commands{std::vector<double>(8, 0.0), {}, {0}};
  for (int k = 0; k < 500; ++k) rov.step(state, commands, Flow(), 0.01);
  EXPECT_LT(state.motion.velocity[2], -0.05);
  commands.drop = {1};
  rov.step(state, commands, Flow(), 0.01);
  commands.drop = {0};
  for (int k = 0; k < 2000; ++k) rov.step(state, commands, Flow(), 0.01);
  EXPECT_EQ(state.drop_weights[0].released, 1);
  EXPECT_NEAR(state.motion.velocity[2], 0.0, 1e-3);
}

TEST(RovSystem, AUniformCurrentIsAMovingFrame) {
  const VehicleSystem rov(bluerov2_heavy_system());
  const VehicleCommands commands{{0.5, 0.4, -0.3, -0.5, 0.3, 0.35, 0.3, 0.4}, {}, {}};
  const Vec3 current(0.3, -0.2, 0.1);
  VehicleSystemState still = rov.rest(), carried = rov.rest();
  carried.motion.velocity.head<3>() = current;
  for (int k = 0; k < 300; ++k) {
    rov.step(still, commands, Flow(), 0.01);
    rov.step(
        carried, commands,
        [&](double, const VehicleState&) {
          return StepConditions{Flow{current, Vec3::Zero()}};
        },
        0.01);
  }
  EXPECT_LT((carried.motion.world_from_vehicle.translation() -
             still.motion.world_from_vehicle.translation() - 3.0 * current)
                .norm(),
            1e-9);
}

TEST(RovSystem, BadInput) {
  const VehicleSystem rov(bluerov2_heavy_system());
  VehicleSystemState state = rov.rest();
  VehicleCommands commands{std::vector<double>(8, 0.0), {}, {}};
  EXPECT_THROW(rov.step(state, {{0.0}, {}, {}}, Flow(), 0.01), std::invalid_argument);
  EXPECT_THROW(rov.step(state, commands, Flow(), 0.0), std::invalid_argument);
  EXPECT_THROW(rov.step(state, commands, StepConditionsFunction(), 0.01), std::invalid_argument);
  commands.thrusters[3] = std::nan("");
  EXPECT_THROW(rov.step(state, commands, Flow(), 0.01), std::invalid_argument);
  VehicleSystemOptions bad = bluerov2_heavy_system();
  bad.thrusters[5].lag = -1.0;
  try {
    VehicleSystem{bad};
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("thruster_6"), std::string::npos) << error.what();
  }
  bad = bluerov2_heavy_system();
  bad.thrusters.resize(40, bad.thrusters[0]);
  EXPECT_THROW(VehicleSystem{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
