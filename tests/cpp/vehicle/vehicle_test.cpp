// SPDX-License-Identifier: BSD-3-Clause
// The published vehicles against what their equations give on paper, and bodies with closed forms.
#include "bathyal/vehicle/vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/presets.hpp"
#include "bathyal/vehicle/simulate.hpp"

namespace bathyal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr FreeAxes kSurge{true, false, false, false, false, false};

Vec6 vec6(double x, double y, double z, double k, double m, double n) {
  Vec6 v;
  v << x, y, z, k, m, n;
  return v;
}

VehicleMotionRecord run(const VehicleOptions& options, const Vec6& wrench, double duration,
                        const FreeAxes& free = kAllFree, double step = 0.01) {
  SimulateOptions how;
  how.duration = duration;
  how.step = step;
  how.free = free;
  return simulate(
      Vehicle(options), {}, [&](double, const VehicleState&) { return wrench; }, {}, how);
}

TEST(Remus, SurgesAsTheHyperbolicTangent) {
  const auto found = run(remus100(), vec6(3.86, 0, 0, 0, 0, 0), 60.0, kSurge);
  for (std::size_t k = 0; k < found.time.size(); k += 500) {
    const double expected = 1.5436 * std::tanh(found.time[k] / 12.561);
    EXPECT_NEAR(found.state[k].velocity[0], expected, 2e-4) << found.time[k];
  }
}

TEST(Remus, SlowsWhereItsBuoyancyPitchesIt) {
  const auto found = run(remus100(), vec6(3.86, 0, 0, 0, 0, 0), 60.0);
  EXPECT_LT(found.state.back().velocity[0], 1.4);
}

TEST(Remus, HeelsUnderThePropellersTorque) {
  VehicleOptions remus = remus100();
  remus.linear_drag(3, 3) = 0.05;  // to come to rest
  const auto found =
      run(remus, vec6(0, 0, 0, -0.543, 0, 0), 200.0, {false, false, false, true, false, false});
  const Vec3 port = found.state.back().world_from_vehicle.linear().col(1);
  EXPECT_NEAR(std::asin(port.z()) / kDegree, -5.32, 0.01);  // port down
}

/// Period of small swings about `axis`, without drag.
double period(VehicleOptions options, int axis) {
  options.terms.clear();
  options.body.volume = options.body.mass / options.water_density;
  VehicleState start;
  Vec3 about = Vec3::Zero();
  about[axis - 3] = 1.0;
  start.world_from_vehicle.linear() = Eigen::AngleAxisd(1e-4, about).toRotationMatrix();
  SimulateOptions how;
  how.duration = 30.0;
  how.step = 0.001;
  const auto found = simulate(Vehicle(options), start, {}, {}, how);
  std::vector<double> crossings;
  for (std::size_t k = 1; k < found.time.size(); ++k) {
    const double a = found.state[k - 1].velocity[axis], b = found.state[k].velocity[axis];
    if (k > 10 && a < 0.0 && b >= 0.0) crossings.push_back(found.time[k - 1] - 0.001 * a / (b - a));
  }
  return (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
}

TEST(Remus, SwingsInPitchAndRoll) {
  EXPECT_NEAR(period(remus100(), 4), 7.460, 0.002);
  EXPECT_NEAR(period(remus100(), 3), 1.277, 0.001);
}

TEST(Remus, RisesByItsSevenNewton) {
  const auto found =
      run(remus100(), Vec6::Zero(), 120.0, {false, false, true, false, false, false});
  EXPECT_NEAR(found.state.back().velocity[2], 0.231, 0.0005);
}

/// Steady turn with the rudder at `rudder` to port, level in pitch, w = q = 0, thrust 3.86 N, the
/// propeller's torque on. \return speed and turning rate to port [°/s]
std::pair<double, double> turn(bool equal_cross_flow, double rudder) {
  const Vehicle remus(remus100(equal_cross_flow));
  constexpr double kStep = 0.005;
  VehicleState state;
  double heel = 0.0;
  for (int k = 0; k < 40000; ++k) {
    const double u = state.velocity[0], lift = u * u * rudder;
    const Vec6 wrench =
        vec6(3.86, -9.64 * lift, 0, -0.543, 0, 6.15 * lift);  // the stern swings out
    state.world_from_vehicle.linear() = Eigen::AngleAxisd(heel, Vec3::UnitX()).toRotationMatrix();
    state.velocity +=
        kStep * remus.acceleration(state, wrench, {}, {true, true, false, true, false, true});
    state.velocity[3] *= 0.999;  // the steady turn alone is asked for
    heel += kStep * state.velocity[3];
  }
  return {state.velocity.head<3>().norm(), state.velocity[5] / kDegree};
}

TEST(Remus, TurnsAsPublished) {
  const auto [port_speed, port] = turn(false, 4.0 * kDegree);
  const auto [starboard_speed, starboard] = turn(false, -4.0 * kDegree);
  EXPECT_NEAR(port, 9.36, 0.0936);
  EXPECT_NEAR(starboard, -9.02, 0.0902);
  EXPECT_NEAR(port_speed, 1.389, 0.0139);
  EXPECT_NEAR(starboard_speed, 1.411, 0.0141);
  EXPECT_NEAR(turn(true, 4.0 * kDegree).second, 11.55, 0.12);
  EXPECT_NEAR(turn(true, -4.0 * kDegree).second, -11.26, 0.12);
}

TEST(BlueRov, ReachesItsPublishedSpeeds) {
  const double expected[] = {0.549, 0.480, 0.433};
  for (int axis = 0; axis < 3; ++axis) {
    Vec6 push = Vec6::Zero();
    push[axis] = 50.0;
    FreeAxes free{};
    free[static_cast<std::size_t>(axis)] = true;
    const auto found = run(bluerov2_heavy(), push, 20.0, free);
    EXPECT_NEAR(found.state.back().velocity[axis], expected[axis], 5e-4) << axis;
  }
}

TEST(BlueRov, RestsUpright) {
  const auto found = run(bluerov2_heavy(), Vec6::Zero(), 60.0);
  EXPECT_LT(found.state.back().world_from_vehicle.translation().norm(), 1e-9);
}

/// REMUS with a diagonal added mass, centred, weightless, without drag.
VehicleOptions free_body() {
  VehicleOptions body = remus100();
  body.terms.clear();
  body.body.mass = 30.48;
  body.body.center_of_mass = Vec3::Zero();
  body.body.inertia = Vec3(0.177, 3.45, 3.45).asDiagonal();
  body.added_mass = Mat6(body.added_mass.diagonal().asDiagonal());
  body.gravity = 0.0;
  return body;
}

TEST(Kirchhoff, SwingsAboutBroadside) {
  const Vehicle vehicle(free_body());
  for (const auto& [angle, expected] : {std::pair(30.0, 3.19821), std::pair(60.0, 4.09135)}) {
    // an impulse of 47.115 N s along y of the world, the bow `angle` off its normal
    VehicleState start;
    start.world_from_vehicle.linear() =
        Eigen::AngleAxisd(-angle * kDegree, Vec3::UnitZ()).toRotationMatrix();
    Vec6 impulse = Vec6::Zero();
    impulse.head<3>() = start.world_from_vehicle.linear().transpose() * Vec3(0, 47.115, 0);
    start.velocity = vehicle.mass_matrix().llt().solve(impulse);
    SimulateOptions how;
    how.duration = 40.0;
    how.step = 0.002;
    const auto found = simulate(vehicle, start, {}, {}, how);
    std::vector<double> ends;
    for (std::size_t k = 1; k < found.time.size(); ++k) {
      const double a = found.state[k - 1].velocity[5], b = found.state[k].velocity[5];
      if (k > 5 && a < 0.0 && b >= 0.0) ends.push_back(found.time[k - 1] - 0.002 * a / (b - a));
    }
    const double period = (ends.back() - ends.front()) / static_cast<double>(ends.size() - 1);
    EXPECT_NEAR(period, expected, 2e-5) << angle;
  }
}

TEST(Kirchhoff, KeepsEnergyAndImpulseForAnHour) {
  const Vehicle vehicle(free_body());
  VehicleState start;
  start.velocity = vec6(0.8, 0.5, -0.3, 0.2, 0.15, -0.25);
  SimulateOptions how;
  how.duration = 3600.0;
  const auto found = simulate(vehicle, start, {}, {}, how);
  const auto impulse = [&](const VehicleState& state) {
    const Vec6 own = vehicle.mass_matrix() * state.velocity;
    return Vec3(state.world_from_vehicle.linear() * own.head<3>());
  };
  const double energy = vehicle.kinetic_energy(start.velocity);
  EXPECT_NEAR(vehicle.kinetic_energy(found.state.back().velocity), energy, 1e-6 * energy);
  EXPECT_LT((impulse(found.state.back()) - impulse(start)).norm(), 1e-6 * impulse(start).norm());
}

TEST(Vehicle, AUniformCurrentIsAMovingFrame) {
  const Vec3 current(0.3, -0.2, 0.1);
  const auto wrench = [](double time, const VehicleState&) {
    return vec6(10 * std::sin(time), 5, -3, 0.2, 0.1 * std::cos(time), 0.5);
  };
  const Vehicle vehicle(bluerov2_heavy());
  SimulateOptions how;
  how.duration = 20.0;
  const auto still = simulate(vehicle, {}, wrench, {}, how);
  VehicleState start;
  start.velocity.head<3>() = current;
  const auto carried = simulate(
      vehicle, start, wrench,
      [&](const Vec3&, double) {
        return Flow{current, {0, 0, 0}};
      },
      how);
  const Vec3 moved = carried.state.back().world_from_vehicle.translation() -
                     still.state.back().world_from_vehicle.translation();
  EXPECT_LT((moved - 20.0 * current).norm(), 1e-9);
}

TEST(Vehicle, TurningTheWorldChangesNothing) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Vec3::UnitZ()).toRotationMatrix();
  const Vehicle vehicle(remus100());
  const auto wrench = [](double, const VehicleState&) { return vec6(4, 0.1, 0, 0, 0.2, 0.3); };
  SimulateOptions how;
  how.duration = 20.0;
  VehicleState other;
  other.world_from_vehicle.linear() = turn;
  const auto one = simulate(vehicle, {}, wrench, {}, how);
  const auto two = simulate(vehicle, other, wrench, {}, how);
  EXPECT_LT((two.state.back().world_from_vehicle.translation() -
             turn * one.state.back().world_from_vehicle.translation())
                .norm(),
            1e-9);
}

TEST(Vehicle, WaterThatAcceleratesCarriesANeutralBody) {
  VehicleOptions body = free_body();
  body.body.volume = body.body.mass / body.water_density;
  const Vec3 push(0.05, 0.02, -0.03);
  const auto found = simulate(Vehicle(body), {}, {},
                              [&](const Vec3&, double time) {
                                return Flow{time * push, push};
                              },
                              {10.0, 0.01, 0.0, kAllFree});
  EXPECT_LT((found.state.back().velocity.head<3>() - 10.0 * push).norm(), 1e-9);
}

TEST(Ellipsoid, HasTheAddedMassOfLamb) {
  const Mat6 sphere = ellipsoid_added_mass(Vec3::Constant(0.7), 1000.0);
  const double ball = 1000.0 * 4.0 / 3.0 * std::numbers::pi * 0.343;
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(sphere(axis, axis), 0.5 * ball, 1e-9 * ball);
  EXPECT_NEAR((sphere.bottomRightCorner<3, 3>().norm()), 0.0, 1e-9);
  const Mat6 long_one = ellipsoid_added_mass({2.0, 0.5, 0.5}, 1000.0);
  const double mass = 1000.0 * 4.0 / 3.0 * std::numbers::pi * 0.5;
  EXPECT_NEAR(long_one(0, 0) / mass, 0.0816, 5e-5);
  EXPECT_NEAR(long_one(1, 1) / mass, 0.8598, 5e-5);
  EXPECT_NEAR(long_one(2, 2) / mass, 0.8598, 5e-5);
  EXPECT_NEAR(long_one(3, 3), 0.0, 1e-9);
  EXPECT_NEAR(long_one(4, 4) / (0.2 * mass * (4.0 + 0.25)), 0.6079, 5e-5);
  EXPECT_NEAR(long_one(5, 5), long_one(4, 4), 1e-9 * mass);
  EXPECT_THROW(ellipsoid_added_mass({1, 0, 1}, 1000.0), std::invalid_argument);
}

TEST(Simulate, RefusesAStepBeyondTheFastestMode) {
  SimulateOptions how;
  how.duration = 10.0;
  how.step = 1.0;
  VehicleState fast;
  fast.velocity[1] = 2.0;
  try {
    simulate(Vehicle(remus100()), fast, {}, {}, how);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("`step`: expected at most"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("sway"), std::string::npos) << error.what();
  }
  // a lone real mode: 2.785 / λ; a swing without drag: 2.828 / ω
  VehicleOptions drag = free_body();
  drag.linear_drag(0, 0) = 10.0;
  const Vehicle damped(drag);
  const FastestMode mode = fastest_mode(damped, {}, Vec6::Zero(), {}, kSurge);
  EXPECT_EQ(mode.axis, 0);
  EXPECT_NEAR(mode.step * mode.rate, 2.785, 0.001);
  VehicleOptions swing = remus100();
  swing.terms.clear();
  const FastestMode roll = fastest_mode(Vehicle(swing), {}, Vec6::Zero(), {}, kAllFree);
  EXPECT_EQ(roll.axis, 3);
  EXPECT_NEAR(roll.step * roll.rate, 2.828, 0.002);
}

TEST(Simulate, EndsWhenItIsToldTo) {
  const auto found = run(remus100(), Vec6::Zero(), 0.255);
  EXPECT_EQ(found.time.size(), 27U);
  EXPECT_DOUBLE_EQ(found.time.back(), 0.255);
  EXPECT_EQ(run(remus100(), Vec6::Zero(), 0.0).time.size(), 1U);
}

TEST(Vehicle, BadInput) {
  VehicleOptions good = remus100();
  const auto refused = [&](auto change) {
    VehicleOptions bad = good;
    change(bad);
    EXPECT_THROW(Vehicle{bad}, std::invalid_argument);
  };
  refused([](VehicleOptions& o) { o.body.mass = 0.0; });
  refused([](VehicleOptions& o) { o.body.inertia.setZero(), o.added_mass.setZero(); });
  refused([](VehicleOptions& o) { o.added_mass(0, 1) = 5.0; });
  refused([](VehicleOptions& o) { o.added_mass(0, 0) = -50.0; });
  refused([](VehicleOptions& o) { o.added_mass(0, 0) = std::nan(""); });
  refused([](VehicleOptions& o) { o.linear_drag(2, 2) = HUGE_VAL; });
  refused([](VehicleOptions& o) { o.terms.push_back({7, 0, 0, true, 1.0}); });
  refused([](VehicleOptions& o) { o.terms.push_back({0, 0, 0, true, std::nan("")}); });
  refused([](VehicleOptions& o) { o.water_density = 0.0; });
  refused([](VehicleOptions& o) { o.body.center_of_buoyancy.x() = 1.0; });
  EXPECT_THROW(run(good, Vec6::Zero(), -1.0), std::invalid_argument);
  EXPECT_THROW(run(good, Vec6::Zero(), 1.0, kAllFree, 0.0), std::invalid_argument);
  EXPECT_THROW(run(good, Vec6::Constant(std::nan("")), 1.0), Error);
}

}  // namespace
}  // namespace bathyal
