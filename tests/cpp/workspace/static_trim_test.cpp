// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/static_trim.hpp"

#include <gtest/gtest.h>

#include "bathyal/workspace/sampling/vehicle_wrench.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

/// 20 kg, neutral in water, its centre of mass `low` below the origin.
RigidBody floating_body(double low = 0.02) {
  RigidBody body;
  body.mass = 20.0;
  body.center_of_mass = Vec3(0, 0, -low);
  body.volume = 20.0 / 1025.0;
  return body;
}

Workspace with_ball(const Arm& arm, double mass, const RigidBody& vehicle = floating_body()) {
  Surroundings around;
  around.vehicle_body = vehicle;
  RigidBody ball;
  ball.mass = mass;
  return Workspace(arm, around).attach({}, ball);
}

TEST(StaticTrim, AMassForwardIsNoseDownAndOneToStarboardRollsThere) {
  const Arm arm = planar_arm();  // 0.9 m in the plane z = 0
  JointMatrix q(4, 2);
  q << 0, 0, kPi, 0, -kPi / 2, 0, kPi / 2, 0;  // forward, aft, starboard, port
  const StaticTrim trim = static_trim(with_ball(arm, 0.1), view_of(q));
  const double angle = std::atan2(0.1 * 0.9, 20.0 * 0.02);  // a pendulum's
  EXPECT_NEAR(trim.pitch[0], angle, 1e-12);
  EXPECT_NEAR(trim.pitch[1], -angle, 1e-12);
  EXPECT_NEAR(trim.roll[2], angle, 1e-12);
  EXPECT_NEAR(trim.roll[3], -angle, 1e-12);
  for (const std::size_t i : {0, 1}) EXPECT_NEAR(trim.roll[i], 0.0, 1e-12);
  for (const std::size_t i : {2, 3}) EXPECT_NEAR(trim.pitch[i], 0.0, 1e-12);
  for (const TrimStatus status : trim.status) EXPECT_EQ(status, TrimStatus::kUpright);
  EXPECT_NEAR(trim.righting[0], 9.80665 * std::hypot(0.09, 0.4), 1e-12);
  EXPECT_NEAR(trim.buoyancy[0], -0.1 * 9.80665, 1e-9);
}

/// Of all that hangs together about the vehicle's origin, in an attitude.
Vec3 moment(const Workspace& ws, const JointMatrix& q, const Pose& world_from_vehicle) {
  const RigidBody& body = *ws.surroundings().vehicle_body;
  const Vec3 gravity = world_from_vehicle.linear().transpose() * Vec3(0, 0, -9.80665);
  const std::vector<double> arm = vehicle_wrench(ws.arm(), ws.attached(), world_from_vehicle,
                                                 view_of(q), Wrenches(nullptr, 0, 6));
  return Vec3(arm[3], arm[4], arm[5]) + body.center_of_mass.cross(body.mass * gravity) -
         body.center_of_buoyancy.cross(1025.0 * body.volume * gravity);
}

TEST(StaticTrim, NoMomentRemainsAndATiltTurnsBack) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    RigidBody vehicle = floating_body(1.5);
    vehicle.center_of_mass += Vec3(0.3, 0.2, 0);
    vehicle.volume *= 1.3;
    Surroundings around;
    around.vehicle_body = vehicle;
    const Workspace ws = Workspace(irregular_arm(seed), around);
    const JointMatrix q = random_poses(ws.arm(), 1, seed);
    const StaticTrim trim = static_trim(ws, view_of(q));
    const auto turned = [&](double roll, double pitch) {
      return Pose(Eigen::AngleAxisd(1.2, Vec3::UnitZ()) *  // any heading
                  Eigen::AngleAxisd(pitch, Vec3::UnitY()) * Eigen::AngleAxisd(roll, Vec3::UnitX()));
    };
    EXPECT_NEAR(moment(ws, q, turned(trim.roll[0], trim.pitch[0])).norm(), 0.0, 1e-9);
    const double small = 1e-4;
    const Vec3 rolled = moment(ws, q, turned(trim.roll[0] + small, trim.pitch[0]));
    EXPECT_LT(rolled.x(), 0.0);
    EXPECT_NEAR(moment(ws, q, turned(trim.roll[0], trim.pitch[0] + small)).norm(),
                small * trim.righting[0], 1e-3 * small * trim.righting[0]);
  }
}

TEST(StaticTrim, TurnedOverAndNeutral) {
  const Arm arm = planar_arm();
  const JointMatrix q = JointMatrix::Zero(1, 2);
  const StaticTrim over = static_trim(with_ball(arm, 0.0, floating_body(-0.02)), view_of(q));
  EXPECT_EQ(over.status[0], TrimStatus::kTurnedOver);
  EXPECT_NEAR(std::abs(over.roll[0]), kPi, 1e-12);
  const StaticTrim neutral = static_trim(with_ball(arm, 0.0, floating_body(0.0)), view_of(q));
  EXPECT_EQ(neutral.status[0], TrimStatus::kNeutral);
  EXPECT_TRUE(std::isnan(neutral.roll[0]) && std::isnan(neutral.pitch[0]));
}

TEST(StaticTrim, RefusesAVehicleWithoutBodyByName) {
  const JointMatrix q = JointMatrix::Zero(1, 2);
  const auto message = [&](const Workspace& ws, const TrimOptions& options = {}) {
    try {
      static_trim(ws, view_of(q), options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_TRUE(message(Workspace(planar_arm(), {})).starts_with("`vehicle_body`: expected"));
  RigidBody light = floating_body();
  light.volume = 0.0;
  EXPECT_TRUE(message(with_ball(planar_arm(), 1.0, light)).starts_with("`vehicle_body`: expected"));
  EXPECT_FALSE(message(with_ball(planar_arm(), 1.0), {.water_density = 0.0}).empty());
  EXPECT_FALSE(message(with_ball(planar_arm(), 1.0), {.gravity = NAN}).empty());
}

}  // namespace
}  // namespace bathyal
