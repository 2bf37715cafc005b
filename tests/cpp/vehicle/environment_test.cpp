// SPDX-License-Identifier: BSD-3-Clause
// Waves, the surface and the bottom, against what a floating or resting body must do.
#include "bathyal/vehicle/environment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bathyal/geometry/solid.hpp"
#include "bathyal/vehicle/from_mesh.hpp"
#include "bathyal/vehicle/presets.hpp"
#include "bathyal/vehicle/simulate.hpp"

namespace bathyal {
namespace {

TriangleMesh box(const Vec3& low, const Vec3& high) {
  Points::Matrix corners(8, 3);
  for (int i = 0; i < 8; ++i) {
    corners.row(i) << ((i & 1) != 0 ? high.x() : low.x()), ((i & 2) != 0 ? high.y() : low.y()),
        ((i & 4) != 0 ? high.z() : low.z());
  }
  Triangles::Matrix faces(12, 3);
  faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6,
      1, 3, 5, 3, 7, 5;
  return {corners, faces};
}

Water with_surface(double z, Waves waves = {}) {
  WaterOptions options;
  options.surface = z;
  options.waves = std::move(waves);
  return Water(options);
}

VehicleMotionRecord run(const VehicleOptions& options, const Pose& start, double duration,
                        const Environment& environment, const Vec6& wrench = Vec6::Zero()) {
  SimulateOptions how;
  how.duration = duration;
  how.environment = std::make_shared<Environment>(environment);
  return simulate(
      Vehicle(options), {start}, [&](double, const VehicleState&) { return wrench; }, {}, how);
}

Pose at_height(double z) { return Pose(Eigen::Translation3d(0.0, 0.0, z)); }

TEST(Environment, ABuoyantVehicleFloatsWithTheShareOfItsWeightUnderWater) {
  const VehicleOptions remus = remus100(true);
  const Environment sea(with_surface(0.0));
  const auto found = run(remus, at_height(-2.0), 120.0, sea);
  const Pose& end = found.state.back().world_from_vehicle;
  EXPECT_NEAR(sea.submerged(Vehicle(remus), end, 0.0), 299.0 / 306.0, 0.002);
  EXPECT_LT(found.state.back().velocity.head<3>().norm(), 0.01);
}

TEST(Environment, AVehicleInTheAirFallsFreely) {
  const VehicleOptions remus = remus100(true);
  const auto found = run(remus, at_height(10.0), 0.5, Environment(with_surface(0.0)));
  // Its added mass stays: the share of its own is what falls.
  const double own = remus.body.mass / (remus.body.mass + remus.added_mass(2, 2));
  EXPECT_NEAR(found.state.back().velocity.z(), -own * 9.81 * 0.5, 0.01);
}

TEST(Environment, ANeutralVehicleFollowsTheOrbitsOfLongWaves) {
  VehicleOptions ball;
  ball.body.volume = 1e-4;
  ball.body.mass = ball.water_density * ball.body.volume;
  ball.body.inertia = Eigen::Matrix3d::Identity() * 1e-6;
  ball.added_mass.topLeftCorner<3, 3>() = 0.5 * ball.body.mass * Eigen::Matrix3d::Identity();
  ball.added_mass.bottomRightCorner<3, 3>() = 1e-6 * Eigen::Matrix3d::Identity();
  // 100 m long waves of 2 cm in deep water; at 50 m depth 4.32 % of the orbit is left.
  const double period = 8.004;
  const Environment sea(with_surface(0.0, Waves::regular(0.02, period)));
  SimulateOptions how;
  how.duration = period;
  how.environment = std::make_shared<Environment>(sea);
  VehicleState start;
  start.world_from_vehicle = at_height(-50.0);
  start.velocity.head<3>() = sea.flow(Vec3(0.0, 0.0, -50.0), 0.0).velocity;
  const auto found = simulate(Vehicle(ball), start, {}, {}, how);
  double low = 1e9, high = -1e9;
  for (const VehicleState& state : found.state) {
    low = std::min(low, state.world_from_vehicle.translation().x());
    high = std::max(high, state.world_from_vehicle.translation().x());
  }
  EXPECT_NEAR(0.5 * (high - low) / 0.01, 0.0432, 0.0002);
}

TEST(Environment, ASinkingVehicleComesToRestOnTheBottom) {
  VehicleOptions rov = bluerov2_heavy();
  rov.body.mass += 2.0;  // 20 N
  const Environment sea(with_surface(0.0),
                        Scene({box(Vec3(-5.0, -5.0, -11.0), Vec3(5.0, 5.0, -10.0))}));
  const auto found = run(rov, at_height(-9.0), 60.0, sea);
  const VehicleState& end = found.state.back();
  EXPECT_NEAR(end.world_from_vehicle.translation().z(), -10.0 + 0.127, 0.005);
  EXPECT_LT(end.velocity.norm(), 1e-4);
  for (const VehicleState& state : found.state) {
    EXPECT_GT(state.world_from_vehicle.translation().z(), -10.0);
  }
}

TEST(Environment, FrictionHoldsAgainstASmallPushAndSlidesUnderALargeOne) {
  VehicleOptions rov = bluerov2_heavy();
  rov.body.mass += 2.0;
  const Environment sea(with_surface(0.0),
                        Scene({box(Vec3(-50.0, -50.0, -11.0), Vec3(50.0, 50.0, -10.0))}));
  const Pose start = at_height(-10.0 + 0.126);
  Vec6 push = Vec6::Zero();
  push[0] = 5.0;  // friction bears 10 N
  const auto held = run(rov, start, 20.0, sea, push);
  EXPECT_LT(std::abs(held.state.back().velocity[0]), 0.01);
  push[0] = 20.0;
  const auto slid = run(rov, start, 20.0, sea, push);
  EXPECT_GT(slid.state.back().velocity[0], 0.1);
}

TEST(Environment, StepsThatContactDoesNotBearAreRefused) {
  SimulateOptions how;
  how.duration = 1.0;
  how.step = 0.05;
  how.environment = std::make_shared<Environment>(
      Water(), Scene({box(Vec3(-5.0, -5.0, -11.0), Vec3(5.0, 5.0, -10.0))}));
  EXPECT_THROW(simulate(Vehicle(bluerov2_heavy()), {}, {}, {}, how), std::invalid_argument);
  how.step = 0.01;
  EXPECT_NO_THROW(simulate(Vehicle(bluerov2_heavy()), {}, {}, {}, how));
}

TEST(SolidMoments, OfABox) {
  const SolidMoments found = solid_moments(box(Vec3(1, 2, 3), Vec3(3, 5, 7)), "mesh");
  EXPECT_NEAR(found.volume, 24.0, 1e-12);
  EXPECT_TRUE(found.centroid.isApprox(Vec3(2.0, 3.5, 5.0), 1e-12));
  EXPECT_TRUE(found.second.isApprox(
      Eigen::Matrix3d(Vec3(24.0 * 4 / 12, 24.0 * 9 / 12, 24.0 * 16 / 12).asDiagonal()), 1e-12));
}

TEST(VehicleFromMesh, OfACubeIsTheSphereOfEqualVolume) {
  const auto made = vehicle_from_mesh(box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  const Vehicle vehicle(made.options);
  EXPECT_NEAR(vehicle.options().added_mass(0, 0), 0.5 * 1025.0, 1e-6);
  EXPECT_NEAR(vehicle.options().added_mass(3, 3), 0.0, 1e-6);
  EXPECT_NEAR(vehicle.options().body.mass, 1025.0, 1e-9);
  EXPECT_NEAR(vehicle.options().body.inertia(0, 0), 1025.0 / 6.0, 1e-9);
  EXPECT_TRUE(made.vehicle_from_mesh.translation().isApprox(Vec3(-0.5, -0.5, -0.5), 1e-12));
}

TEST(VehicleFromMesh, AnOpenMeshIsRefused) {
  const TriangleMesh closed = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  Triangles::Matrix one(1, 3);
  one << 0, 1, 2;
  EXPECT_THROW(vehicle_from_mesh(TriangleMesh(closed.shared_vertices(), one)),
               std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
