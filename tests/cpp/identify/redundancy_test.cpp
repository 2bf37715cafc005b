// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/redundancy.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>

#include "bathyal/identify/model/arm_residuals.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

Measurement poses(bool tracked, Index joints) {
  Measurement m;
  m.tracked = tracked;
  m.q.setRandom(4, joints);
  m.weights.assign(4, 1.0);
  m.tool.assign(4, 0);
  m.station.assign(4, 0);
  m.point.assign(4, tracked ? -1 : 0);
  m.plane.assign(4, -1);
  m.position.setZero(3, 4);
  if (!tracked) m.labels = {0};
  return m;
}

struct Found {
  std::vector<std::string> names;
  std::vector<RedundantParameter> redundant;
  std::vector<Parameter> parameters;
};

Found gauge_of(const Arm& arm, bool tracked, bool base_known, Parametrization parametrization,
               const std::vector<std::string>& fixed = {}) {
  const Measurement m = poses(tracked, arm.size());
  ParameterChoice choice;
  choice.parametrization = parametrization;
  choice.free_base = tracked;
  const ArmParameters parameters =
      make_parameters(arm, m, {Pose::Identity()}, {pose_of(0.06, 0.02, 0.1, 0, 0)}, {}, choice);
  std::vector<int> held;
  for (const std::string& name : fixed) held.push_back(find_parameter(parameters.parameters, name));
  Found found{{}, find_redundant(parameters, m, choice, base_known, held), parameters.parameters};
  for (const RedundantParameter& gauge : found.redundant) {
    if (gauge.column >= 0) found.names.push_back(parameters.parameters[gauge.column].name);
  }
  return found;
}

bool holds(const Found& found, const std::string& name) {
  return std::find(found.names.begin(), found.names.end(), name) != found.names.end();
}

TEST(Gauge, TouchesLoseTheFootAndTheTip) {
  // 27 unknowns, of which touches determine 20 and a distance the scale: 6 are redundant.
  const Found found = gauge_of(ur10e(), false, false, Parametrization::kHayati);
  EXPECT_EQ(found.names.size(), 6U);
  EXPECT_TRUE(holds(found, "theta_1"));
  EXPECT_TRUE(holds(found, "d_1"));
}

TEST(Gauge, KnownBaseTellsTheFoot) {
  const Found found = gauge_of(ur10e(), false, true, Parametrization::kHayati);
  EXPECT_FALSE(holds(found, "theta_1"));
  EXPECT_FALSE(holds(found, "d_1"));
  EXPECT_EQ(found.names.size(), 4U);
}

TEST(Gauge, WhatTakesItsPartIsNamed) {
  const Found found = gauge_of(ur10e(), false, false, Parametrization::kHayati);
  for (const RedundantParameter& gauge : found.redundant) EXPECT_FALSE(gauge.partners.empty());
}

TEST(Gauge, FixedColumnsAreNeither) {
  const Found found = gauge_of(ur10e(), false, false, Parametrization::kHayati, {"theta_6"});
  EXPECT_FALSE(holds(found, "theta_6"));
}

TEST(Gauge, SlidingJointsHaveOneToo) {
  DhTable table;
  for (int i = 0; i < 3; ++i) table.rows.push_back({0.1, kPi / 2, 0.2, 0.3, 0});
  table.types = {JointType::kPrismatic, JointType::kRevolute, JointType::kRevolute};
  const Found found = gauge_of(arm_from_dh(table), true, false, Parametrization::kDh);
  EXPECT_TRUE(holds(found, "d_1"));
}

/// Four to six joints of which one slides, with the right angles, parallel axes and lengths of zero
/// of drawings; angles as they are, or written with four digits.
Arm drawn_arm(std::uint64_t seed, bool rounded) {
  RandomStream random(seed);
  const auto any_of = [&](double a, double b, double c) {
    const double which = random.uniform(0.0, 3.0);
    return which < 1.0 ? a : which < 2.0 ? b : c;
  };
  DhTable table;
  const int rows = 3 + static_cast<int>(seed % 4);
  for (int i = 0; i < rows; ++i) {
    const double alpha = any_of(-kPi / 2, kPi / 2, 0.0);
    const double a = any_of(0.0, 0.2, 0.35);
    const double d = any_of(0.0, 0.15, 0.3);
    table.rows.push_back({a, rounded ? std::round(1e4 * alpha) / 1e4 : alpha, d, 0.0, 0.0});
    table.types.push_back(JointType::kRevolute);
  }
  table.types[seed % 3] = JointType::kPrismatic;
  return arm_from_dh(table);
}

/// Held at nominal, a column that the others can do without on any other arm may be the only one
/// that moves this one where its axes are parallel or perpendicular.
TEST(Gauge, LosesNothingWhereTheArmStands) {
  constexpr double kClear = 1e-4;  // what rounded angles let through is less
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const bool rounded = seed % 2 == 1;
    const Arm arm = drawn_arm(seed, rounded);
    Measurement m = poses(true, arm.size());
    const JointMatrix q = random_poses(arm, 40, seed);
    m.q = q;
    m.weights.assign(40, 1.0);
    m.tool.assign(40, 0);
    m.station.assign(40, 0);
    m.point.assign(40, -1);
    m.plane.assign(40, -1);
    m.position.setZero(3, 40);
    if (seed % 5 == 0) m.rotation.assign(40, Eigen::Matrix3d::Identity());
    const ParameterChoice choice{Parametrization::kHayati, kNearlyParallel, true};
    const ArmParameters parameters =
        make_parameters(arm, m, {Pose::Identity()}, {pose_of(0.06, 0.02, 0.1, 0, 0)}, {}, choice);
    std::vector<int> kept;
    const std::vector<RedundantParameter> gauge = find_redundant(parameters, m, choice, false, {});
    for (int i = 0; i < static_cast<int>(parameters.parameters.size()); ++i) {
      const bool left = std::any_of(gauge.begin(), gauge.end(),
                                    [i](const RedundantParameter& g) { return g.column == i; });
      if (!left) kept.push_back(i);
    }
    ArmResiduals system(parameters, m, Criterion::kCentroid, false, 1);
    const Eigen::MatrixXd jacobian = system.jacobian(parameters.nominal());
    EXPECT_EQ(numerical_rank(jacobian(Eigen::all, kept), kClear).rank,
              numerical_rank(jacobian, kClear).rank);
  }
}

}  // namespace
}  // namespace bathyal
