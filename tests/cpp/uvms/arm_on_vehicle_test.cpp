// SPDX-License-Identifier: BSD-3-Clause
// Arm and vehicle as one tree, against the arm's own kinematics and the quasi-static wrench.
#include "bathyal/uvms/arm_on_vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "bathyal/arm/dh.hpp"
#include "bathyal/uvms/trim_hold.hpp"
#include "bathyal/vehicle/device_presets.hpp"
#include "bathyal/vehicle/presets.hpp"
#include "bathyal/workspace/sampling/vehicle_wrench.hpp"

namespace bathyal {
namespace {

Arm odd_arm() {
  DhTable table;
  table.rows = {{0.1, 1.2, 0.2, 0.3, 0.0},
                {0.4, -0.7, 0.0, 1.0, 0.05},
                {0.2, 0.4, 0.1, -0.6, 0.0},
                {0.0, 0.9, 0.15, 0.2, 0.0}};
  table.types = {JointType::kRevolute, JointType::kRevolute, JointType::kPrismatic,
                 JointType::kRevolute};
  DhArmOptions options;
  for (int k = 0; k < 5; ++k) {
    Link link;
    link.row_from_link.translation() = Vec3(0.02 * k, -0.01, 0.03);
    link.row_from_link.linear() =
        Eigen::AngleAxisd(0.3 * k, Vec3(1.0, 2.0, 0.5).normalized()).toRotationMatrix();
    link.body = {0.5 + 0.1 * k, Vec3(0.05, 0.02 * k, -0.01), Vec3(0.01, 0.012, 0.015).asDiagonal(),
                 4e-4, Vec3(0.03, 0.0, 0.01)};
    options.links.push_back(link);
  }
  return arm_from_dh(table, options);
}

Workspace odd_workspace(double radius = 0.03) {
  Surroundings around;
  around.vehicle_from_base.translation() = Vec3(0.3, 0.1, -0.2);
  around.vehicle_from_base.linear() =
      Eigen::AngleAxisd(0.7, Vec3(0.2, 1.0, -0.4).normalized()).toRotationMatrix();
  const std::vector<double> radii{radius};
  around.capsules = capsules_of_rows(odd_arm(), radii);
  const Capsule held{Vec3::Zero(), Vec3(0.0, 0.0, 0.2), 0.02};
  const RigidBody tool{0.4, Vec3(0.0, 0.01, 0.1), 1e-3 * Eigen::Matrix3d::Identity(), 1e-4,
                       Vec3(0.0, 0.0, 0.1)};
  return Workspace(odd_arm(), around).attach({&held, 1}, tool);
}

const std::vector<double> kPosture{0.4, -0.8, 0.1, 1.1};

BodyTreeState at_posture(const ArmOnVehicle& system, const std::vector<double>& q) {
  TreeJointMotion joints;
  const std::vector<double> zero(q.size(), 0.0);
  system.set_joints(q, zero, zero, joints);
  return {{}, joints.q, joints.rate};
}

TEST(ArmOnVehicle, LinksAreWhereTheArmsAre) {
  const Workspace workspace = odd_workspace();
  const ArmOnVehicle system(Vehicle(bluerov2_heavy()), workspace);
  const BodyTreeState state = at_posture(system, kPosture);
  const Pose tool = system.tree().link_poses(state).back();
  const Pose expected = row_frames(workspace.arm(), kPosture).world_from_tool;
  EXPECT_LT((tool.matrix() - expected.matrix()).norm(), 1e-12);
}

/// At rest and held, the tree's force on the hull is the wrench of the workspace.
TEST(ArmOnVehicle, WeighsWhatTheWorkspaceSays) {
  const Workspace workspace = odd_workspace();
  const Vehicle vehicle(bluerov2_heavy());
  const ArmOnVehicle system(vehicle, workspace);
  const JointView q(kPosture.data(), 1, 4);
  const Eigen::Matrix<double, 1, 6, Eigen::RowMajor> contact{3.0, -2.0, 8.0, 0.1, 0.2, -0.3};
  WrenchOptions still;
  still.water_density = vehicle.options().water_density;
  still.gravity = {0.0, 0.0, -vehicle.options().gravity};
  const std::vector<double> wrench = vehicle_wrench(workspace, q, {contact.data(), 1, 6}, still);
  TreeLoads loads;
  loads.tip_wrench = contact.transpose();
  loads.wrench = -Eigen::Map<const Vec6>(wrench.data());
  loads.wrench -= vehicle.hydrostatic(Pose::Identity());
  loads.drive = JointDrive::kAcceleration;
  TreeAcceleration found;
  system.tree().accelerations(at_posture(system, kPosture), loads, found);
  EXPECT_LT(found.base.norm(), 1e-10);
}

/// A cylinder that turns about its end: added inertia ρ π r² L³ / 3, drag's moment ½ ρ C d ω² L⁴
/// / 4.
TEST(ArmOnVehicle, WaterResistsALinkAsACylinder) {
  DhTable table;
  table.rows = {{2.0, 0.0, 0.0, 0.0, 0.0}};
  table.types = {JointType::kRevolute};
  Surroundings around;
  const std::vector<double> radii{0.01};
  const Arm arm = arm_from_dh(table);
  around.capsules = capsules_of_rows(arm, radii);
  LinkWaterOptions water;
  water.strips = 100;
  const Vehicle vehicle(bluerov2_heavy());
  const ArmOnVehicle system(vehicle, Workspace(arm, around), water);
  const TreeLink& link = system.tree().options().links[1];
  const double density = vehicle.options().water_density;
  EXPECT_NEAR(link.added_mass(5, 5) / (density * std::numbers::pi * 1e-4 * 8.0 / 3.0), 1.0, 0.015);
  EXPECT_NEAR(link.added_mass(0, 0), 0.0, 1e-9);
  double moment = 0.0;
  for (const DragStrip& strip : link.strips) {
    moment += strip.coefficient * std::pow(strip.center.norm(), 3);
  }
  EXPECT_NEAR(moment / (0.5 * density * 1.1 * 0.02 * 16.0 / 4.0), 1.0, 0.02);
}

TEST(JointSpline, GoesThroughItsRowsAndRestsAtTheEnds) {
  const std::vector<double> time{0.0, 0.5, 1.5, 2.0}, rows{0.0, 1.0, 0.3, 0.9, -0.2, 0.4, 0.1, 0.0};
  const JointSpline spline(time, JointView(rows.data(), 4, 2));
  std::vector<double> q, rate, acceleration, later, rate_later, acceleration_later;
  for (std::size_t k = 0; k < 4; ++k) {
    spline.at(time[k], q, rate, acceleration);
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(q[j], rows[2 * k + j], 1e-14);
    if (k == 0 || k == 3) {
      EXPECT_NEAR(rate[0], 0.0, 1e-14);
      continue;
    }
    spline.at(time[k] - 1e-7, later, rate_later, acceleration_later);
    EXPECT_NEAR(rate[0], rate_later[0], 1e-5);
    EXPECT_NEAR(acceleration[0], acceleration_later[0], 1e-4);
  }
  spline.at(5.0, q, rate, acceleration);
  EXPECT_EQ(q[1], 0.0);
  EXPECT_EQ(acceleration[1], 0.0);
  const std::vector<double> back{0.0, 0.5, 0.5, 2.0};
  EXPECT_THROW(JointSpline(back, JointView(rows.data(), 4, 2)), std::invalid_argument);
}

/// Nothing from outside: the momentum of all stays what it was, none.
TEST(ArmOnVehicle, ArmThatMovesMovesTheVehicleTheOtherWay) {
  VehicleOptions bare;
  bare.body = {20.0, Vec3(0.02, 0.0, 0.01), Vec3(0.5, 0.6, 0.7).asDiagonal(), 0.02, Vec3::Zero()};
  bare.gravity = 0.0;
  LinkWaterOptions water;
  water.drag = 0.0;
  const ArmOnVehicle system(Vehicle(bare), odd_workspace(), water);
  const std::vector<double> time{0.0, 0.6, 1.2};
  const std::vector<double> rows{0.0, 0.0, 0.0, 0.0, 0.8, -0.5, 0.1, 1.0, 0.2, 0.6, 0.05, -0.4};
  const JointSpline motion(time, JointView(rows.data(), 3, 4));
  ArmMotionOptions options;
  options.steps.duration = 0.9;
  options.steps.step = 1e-3;
  const ArmMotionRecord run = simulate_arm_motion(system, {}, motion, options);
  BodyTreeState last = at_posture(system, {run.q.end() - 4, run.q.end()});
  std::vector<double> q, rate, acceleration;
  motion.at(0.9, q, rate, acceleration);
  TreeJointMotion joints;
  system.set_joints(q, rate, acceleration, joints);
  last = {run.vehicle.state.back(), joints.q, joints.rate};
  EXPECT_GT(run.vehicle.state.back().velocity.norm(), 0.02);
  EXPECT_LT(system.tree().momentum(last).norm(), 1e-8);
}

class TrimHoldTest : public testing::Test {
 protected:
  TrimHoldTest()
      : system_(bluerov2_heavy_system()),
        vehicle_(system_.vehicle),
        arm_(vehicle_, odd_workspace()),
        controller_(vehicle_, {}) {
    std::vector<Thruster> thrusters;
    for (const ThrusterOptions& one : system_.thrusters) thrusters.emplace_back(one);
    allocation_.emplace(thrusters);
    options_.duration = 12.0;
    const JointView q(kPosture.data(), 1, 4);
    WrenchOptions still;
    still.water_density = vehicle_.options().water_density;
    still.gravity = {0.0, 0.0, -vehicle_.options().gravity};
    const std::vector<double> wrench = vehicle_wrench(arm_.workspace(), q, {nullptr, 0, 6}, still);
    options_.expected_wrench.rows = {Eigen::Map<const Vec6>(wrench.data())};
  }

  double worst_pitch() {
    const TrimHoldRecord run =
        hold_trim(arm_, *allocation_, controller_, {}, JointSpline(kPosture), options_);
    double worst = 0.0;
    for (const VehicleState& state : run.motion.vehicle.state) {
      worst = std::max(worst, std::abs(state.world_from_vehicle.linear()(2, 0)));
    }
    EXPECT_EQ(run.thrust.size(), run.motion.vehicle.state.size());
    return worst;
  }

  VehicleSystemOptions system_;
  Vehicle vehicle_;
  ArmOnVehicle arm_;
  PoseHold controller_;
  std::optional<Allocation> allocation_;
  TrimHoldOptions options_;
};

TEST_F(TrimHoldTest, WhatIsExpectedDisturbsLess) {
  const double known = worst_pitch();
  options_.expected_wrench.rows.clear();
  const double unknown = worst_pitch();
  EXPECT_LT(known, 0.02);
  EXPECT_GT(unknown, 3.0 * known);
}

TEST_F(TrimHoldTest, RefusesAMomentThatTheThrustersCannotGive) {
  options_.expected_wrench.rows[0] << 0.0, 0.0, 0.0, 0.0, 60.0, 0.0;
  try {
    worst_pitch();
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("in pitch"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace bathyal
