// SPDX-License-Identifier: BSD-3-Clause
// Vehicles with their devices under control: holding a pose, cruising, lines, the bottom.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bathyal/control/allocation.hpp"
#include "bathyal/control/cruise.hpp"
#include "bathyal/control/guidance.hpp"
#include "bathyal/control/pose_hold.hpp"
#include "bathyal/vehicle/device_presets.hpp"
#include "bathyal/vehicle/presets.hpp"

namespace bathyal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Held {
  double position = 0.0, depth = 0.0, angle = 0.0, heading = 0.0;  // the worst, after a while
};

double angle_of(const Pose& pose) { return Eigen::AngleAxisd(pose.linear()).angle(); }

/// BlueROV2 asked to stay at the origin, its thrusters `failed`, for `duration` [s].
Held held(const std::function<Vec3(double)>& current, const std::vector<int>& failed,
          const PoseHoldOptions& options, double duration) {
  const VehicleSystem rov(bluerov2_heavy_system());
  const Allocation allocation(rov.thrusters());
  const PoseHold hold(rov.vehicle(), options);
  VehicleSystemState state = rov.rest();
  VehicleCommands commands{std::vector<double>(8, 0.0), {}, {}};
  PoseHoldState memory;
  AllocationResult result;
  Held worst;
  for (int k = 0; k < static_cast<int>(100.0 * duration); ++k) {
    const double now = 0.01 * k;
    if (k % 5 == 0) {  // 20 Hz
      const double voltage = rov.supply(state, commands).voltage;
      const Vec6 wrench = hold.step(memory, state.motion, {}, Vec3::Zero(), 0.05);
      allocation.allocate(wrench, voltage, failed, result);
      memory.shortfall = result.achieved - wrench;
      for (const int axis : allocation.rank(failed).lost) memory.shortfall[axis] = 0.0;
      commands.thrusters = result.command;
    }
    rov.step(
        state, commands,
        [&](double off, const VehicleState&) {
          return StepConditions{Flow{current(now + off), Vec3::Zero()}};
        },
        0.01);
    if (now < 20.0) continue;
    const Pose& pose = state.motion.world_from_vehicle;
    worst.position = std::max(worst.position, pose.translation().norm());
    worst.depth = std::max(worst.depth, std::abs(pose.translation().z()));
    worst.angle = std::max(worst.angle, angle_of(pose) / kDegree);
    worst.heading = std::max(
        worst.heading, std::abs(std::atan2(pose.linear()(1, 0), pose.linear()(0, 0))) / kDegree);
  }
  return worst;
}

Vec3 turning_current(double time) {
  const double angle = 2.0 * std::numbers::pi * time / 120.0;
  return 0.25 * Vec3(std::cos(angle), std::sin(angle), 0.0);
}

TEST(PoseHold, StaysInACurrentThatTurns) {
  const Held worst = held(turning_current, {}, {}, 180.0);
  RecordProperty("position_mm", static_cast<int>(1000.0 * worst.position));
  EXPECT_LT(worst.position, 0.05);
  EXPECT_LT(worst.angle, 2.0);
}

TEST(PoseHold, StaysWithAnyThrusterLost) {
  for (int lost = 0; lost < 8; ++lost) {
    const Held worst = held(turning_current, {lost}, {}, 60.0);
    EXPECT_LT(worst.position, 0.05) << lost;
    EXPECT_LT(worst.angle, 2.0) << lost;
  }
}

TEST(PoseHold, HoldsDepthAndHeadingWithAnyTwoLost) {
  PoseHoldOptions options;
  options.axes = {false, false, true, true, true, true};
  // without pitch of its own, it tips where it pushes up or down: gently, below its own 1.9 rad/s
  options.frequency = {0.5, 0.5, 0.5, 0.5, 0.5, 1.0};
  const auto drift = [](double) { return Vec3(0.1, 0.05, 0.02); };
  for (int a = 0; a < 8; ++a) {
    for (int b = a + 1; b < 8; ++b) {
      const Held worst = held(drift, {a, b}, options, 60.0);
      EXPECT_LT(worst.depth, 0.05) << a << b;
      EXPECT_LT(worst.heading, 2.0) << a << b;
    }
  }
}

TEST(PoseHold, HasThePolesItIsGiven) {
  // without drag, current and devices: heave alone obeys (s + ω)(s² + 2 ζ ω s + ω²)
  VehicleOptions bare = bluerov2_heavy();
  bare.terms.clear();
  bare.linear_drag.setZero();
  const Vehicle vehicle(bare);
  PoseHoldOptions options;
  options.frequency.fill(1.0);
  const PoseHold hold(vehicle, options);
  PoseHoldState memory;
  VehicleState state;
  state.world_from_vehicle.translation().z() = -1.0;
  const double step = 0.001;
  for (int k = 0; k < 3000; ++k) {
    const Vec6 wrench = hold.step(memory, state, {}, Vec3::Zero(), step);
    state.velocity += step * vehicle.acceleration(state, wrench);
    state.world_from_vehicle.translation() += step * state.velocity.head<3>();
  }
  // e(0) = 1, e'(0) = 0, e''(0) = −3: e = (1 + t − t²) exp(−t)
  EXPECT_NEAR(-state.world_from_vehicle.translation().z(), (1.0 + 3.0 - 9.0) * std::exp(-3.0),
              2e-3);
}

TEST(PoseHold, DoesNotWindUp) {
  // a current that it cannot hold for half a minute, then none
  const auto gust = [](double time) { return time < 30.0 ? Vec3(2.0, 0, 0) : Vec3(0, 0, 0); };
  const VehicleSystem rov(bluerov2_heavy_system());
  const Allocation allocation(rov.thrusters());
  const PoseHold hold(rov.vehicle(), {});
  VehicleSystemState state = rov.rest();
  VehicleCommands commands{std::vector<double>(8, 0.0), {}, {}};
  PoseHoldState memory;
  AllocationResult result;
  double least = 0.0;
  for (int k = 0; k < 12000; ++k) {
    if (k % 5 == 0) {
      const Vec6 wrench = hold.step(memory, state.motion, {}, Vec3::Zero(), 0.05);
      allocation.allocate(wrench, rov.supply(state, commands).voltage, {}, result);
      memory.shortfall = result.achieved - wrench;
      commands.thrusters = result.command;
    }
    rov.step(state, commands, Flow{gust(0.01 * k), Vec3::Zero()}, 0.01);
    if (k > 3000) least = std::min(least, state.motion.world_from_vehicle.translation().x());
  }
  EXPECT_LT(state.motion.world_from_vehicle.translation().norm(), 0.05);
  EXPECT_GT(least, -1.5);  // past the place that it comes back to
}

/// REMUS for `duration` [s] towards what `target` says; `seen` looks at each step.
void cruise(const std::function<CruiseTarget(double, const VehicleState&)>& target,
            const Vec3& current, double duration,
            const std::function<void(double, const VehicleState&)>& seen, double start_z = -20.0) {
  const VehicleSystem remus(remus100_system());
  const CruiseControl control(remus, {});
  const Thruster& propeller = remus.thrusters()[0];
  VehicleSystemState state = remus.rest();
  state.motion.world_from_vehicle.translation().z() = start_z;
  state.motion.velocity[0] = 1.5;
  CruiseState memory;
  VehicleCommands commands{{1.0}, {0.0, 0.0}, {}};
  for (int k = 0; k < static_cast<int>(50.0 * duration); ++k) {
    const double now = 0.02 * k;
    if (k % 5 == 0) {
      Vec6 relative = state.motion.velocity;
      relative.head<3>() -= state.motion.world_from_vehicle.linear().transpose() * current;
      const CruiseOutput output =
          control.step(memory, state.motion, relative, target(now, state.motion), 0.1);
      commands.fins = {output.rudder, output.stern_plane};
      commands.thrusters[0] = propeller.command_for(output.thrust, 16.0);
    }
    remus.step(state, commands, Flow{current, Vec3::Zero()}, 0.02);
    seen(now, state.motion);
  }
}

double heading_of(const VehicleState& state) {
  const Eigen::Matrix3d& turn = state.world_from_vehicle.linear();
  return std::atan2(turn(1, 0), turn(0, 0));
}

TEST(Cruise, ReachesHeadingDepthAndSpeed) {
  VehicleState last;
  cruise(
      [](double, const VehicleState&) {
        return CruiseTarget{1.4, 1.0, -25.0, 0.0};
      },
      Vec3::Zero(), 150.0, [&](double, const VehicleState& state) { last = state; });
  EXPECT_NEAR(heading_of(last), 1.0, 0.5 * kDegree);
  EXPECT_NEAR(last.world_from_vehicle.translation().z(), -25.0, 0.05);
  EXPECT_NEAR(last.velocity[0], 1.4, 0.01);
}

TEST(Cruise, RefusesAFinThatDoesNotTurn) {
  VehicleSystemOptions options = remus100_system();
  options.fins[0].published.setZero();
  EXPECT_THROW(CruiseControl(VehicleSystem(options), {}), std::invalid_argument);
  CruiseOptions bad;
  bad.rudder = 5;
  EXPECT_THROW(CruiseControl(VehicleSystem(remus100_system()), bad), std::invalid_argument);
}

TEST(LineOfSight, HoldsTheLineInACurrentFromTheSide) {
  LineOfSightOptions options;
  options.points = {{0.0, 0.0}, {150.0, 0.0}, {150.0, 120.0}};
  LineOfSightState line;
  double worst = 0.0;
  LineOfSightOutput steer;
  cruise(
      [&](double, const VehicleState& state) {
        steer = line_of_sight(options, line, state.world_from_vehicle.translation(), 0.1);
        return CruiseTarget{1.5, steer.heading, -20.0, 0.0};
      },
      Vec3(0.0, 0.3, 0.0), 190.0,
      [&](double time, const VehicleState&) {
        if (time > 50.0 && line.leg == 0) worst = std::max(worst, std::abs(steer.cross_track));
      });
  EXPECT_LT(worst, 0.5);
  EXPECT_EQ(line.leg, 1);
  EXPECT_EQ(line.arrived, 1);
}

double uneven(double x, double y) {
  return -30.0 + 1.5 * std::sin(2.0 * std::numbers::pi * x / 60.0) +
         0.4 * std::sin(2.0 * std::numbers::pi * (x + 0.5 * y) / 17.0);
}

TEST(FollowBottom, RemusStaysOverUnevenGround) {
  double least = 100.0, sum = 0.0;
  int count = 0;
  cruise(
      [&](double, const VehicleState& state) {
        const Vec3 here = state.world_from_vehicle.translation();
        const BottomFollowOutput path = follow_bottom({}, here, heading_of(state), uneven);
        return CruiseTarget{1.5, 0.0, path.z, path.climb};
      },
      Vec3::Zero(), 300.0,
      [&](double time, const VehicleState& state) {
        const Vec3 here = state.world_from_vehicle.translation();
        const double altitude = here.z() - uneven(here.x(), here.y());
        least = std::min(least, altitude);
        if (time < 30.0) return;
        sum += altitude;
        ++count;
      },
      -27.0);
  RecordProperty("least_mm", static_cast<int>(1000.0 * least));
  EXPECT_GT(least, 2.0);
  EXPECT_NEAR(sum / count, 3.0, 0.5);
}

TEST(FollowBottom, IsTheAltitudeOverLevelGround) {
  const auto level = follow_bottom({}, {1, 2, 3}, 0.3, [](double, double) { return -10.0; });
  EXPECT_DOUBLE_EQ(level.z, -7.0);
  EXPECT_EQ(level.climb, 0.0);
  const auto wall =
      follow_bottom({}, {0, 0, 0}, 0.0, [](double x, double) { return x > 10.0 ? 0.0 : -10.0; });
  EXPECT_GT(wall.z, -7.0);
  EXPECT_NEAR(wall.climb, 0.25, 1e-9);
}

TEST(Guidance, BadInput) {
  LineOfSightOptions line;
  line.points = {{0, 0}};
  EXPECT_THROW(line.check(), std::invalid_argument);
  line.points = {{0, 0}, {0, 0}};
  EXPECT_THROW(line.check(), std::invalid_argument);
  BottomFollowOptions bottom;
  bottom.altitude = 0.0;
  EXPECT_THROW(bottom.check(), std::invalid_argument);
  EXPECT_THROW(follow_bottom({}, {0, 0, 0}, 0.0, {}), std::invalid_argument);
  EXPECT_THROW(follow_bottom({}, {0, 0, 0}, 0.0, [](double, double) { return std::nan(""); }),
               std::invalid_argument);
  PoseHoldOptions hold;
  hold.damping = 0.0;
  EXPECT_THROW(PoseHold(Vehicle(bluerov2_heavy()), hold), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
