// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/gauge.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../arm/arms.hpp"

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
  std::vector<GaugeColumn> gauge;
  std::vector<Column> columns;
};

Found gauge_of(const Arm& arm, bool tracked, bool base_known, Parametrization parametrization,
               const std::vector<std::string>& fixed = {}) {
  const Measurement m = poses(tracked, arm.size());
  ColumnChoice choice;
  choice.parametrization = parametrization;
  choice.free_base = tracked;
  const ArmColumns columns =
      make_columns(arm, m, {Pose::Identity()}, {pose_of(0.06, 0.02, 0.1, 0, 0)}, {}, choice);
  std::vector<int> held;
  for (const std::string& name : fixed) held.push_back(find_column(columns.columns, name));
  Found found{{}, find_gauge(columns, m, choice, base_known, held), columns.columns};
  for (const GaugeColumn& gauge : found.gauge) {
    if (gauge.column >= 0) found.names.push_back(columns.columns[gauge.column].name);
  }
  return found;
}

bool holds(const Found& found, const std::string& name) {
  return std::find(found.names.begin(), found.names.end(), name) != found.names.end();
}

TEST(Gauge, TouchesLoseTheFootAndTheTip) {
  // 27 unknowns, of which touches tell 20 and a distance the size: 6 are gauge.
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
  for (const GaugeColumn& gauge : found.gauge) EXPECT_FALSE(gauge.trades.empty());
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

}  // namespace
}  // namespace bathyal
