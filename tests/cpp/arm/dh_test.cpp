// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/dh.hpp"

#include <gtest/gtest.h>

#include "bathyal/arm/row_frames.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

Pose rotation(double angle, const Vec3& axis) { return Pose(Eigen::AngleAxisd(angle, axis)); }
Pose along(double x, double z) { return Pose(Eigen::Translation3d(x, 0.0, z)); }

/// A row in the modified convention, factor by factor.
Pose modified_row(const DhRow& row, double value) {
  return along(row.a, 0.0) * rotation(row.alpha, Vec3::UnitX()) *
         rotation(row.beta, Vec3::UnitY()) * rotation(row.theta + value, Vec3::UnitZ()) *
         along(0.0, row.d);
}

DhTable modified_table() {
  DhTable table;
  table.convention = DhConvention::kModified;
  RandomStream random(11);
  const auto any = [&] { return random.uniform(-1.0, 1.0); };
  for (int i = 0; i < 4; ++i) table.rows.push_back({any(), any(), any(), any(), any()});
  table.types.assign(4, JointType::kRevolute);
  table.root = pose_of(any(), any(), any(), any(), any());
  table.flange = pose_of(any(), any(), any(), any(), any());
  return table;
}

TEST(DhTable, RowIsTheProductOfItsFactors) {
  const DhRow row{0.3, 0.4, -0.2, 1.1, 0.05};
  const Pose expected = rotation(1.1 + 0.6, Vec3::UnitZ()) * along(0.0, -0.2) * along(0.3, 0.0) *
                        rotation(0.4, Vec3::UnitX()) * rotation(0.05, Vec3::UnitY());
  EXPECT_TRUE(row_pose(row, JointType::kRevolute, 0.6).isApprox(expected, 1e-15));
  EXPECT_NEAR(row_pose(row, JointType::kPrismatic, 0.6).translation().z(), 0.4, 1e-15);
  EXPECT_NEAR(row_pose(row, JointType::kFixed, 0.6).translation().z(), -0.2, 1e-15);
}

TEST(DhTable, ModifiedConventionIsTakenOverExactly) {
  const DhTable table = modified_table();
  const Arm arm = arm_from_dh(table);
  const std::vector<double> q{0.3, -0.8, 1.9, 0.2};
  Pose expected = table.root;
  for (std::size_t k = 0; k < 4; ++k) expected = expected * modified_row(table.rows[k], q[k]);
  expected = expected * table.flange;
  EXPECT_TRUE(row_frames(arm, q).world_from_tool.isApprox(expected, 1e-14));
}

TEST(DhTable, ComesBackInEitherConvention) {
  const DhTable table = modified_table();
  const Arm arm = arm_from_dh(table);
  const std::vector<double> q{0.3, -0.8, 1.9, 0.2};
  const Pose expected = row_frames(arm, q).world_from_tool;
  for (const DhConvention convention : {DhConvention::kStandard, DhConvention::kModified}) {
    const Arm again = arm_from_dh(dh_table(arm, convention));
    EXPECT_TRUE(row_frames(again, q).world_from_tool.isApprox(expected, 1e-14));
  }
  // A root that is a twist is the first row's own again.
  DhTable plain = table;
  plain.root = Pose::Identity();
  const DhTable back = dh_table(arm_from_dh(plain), DhConvention::kModified);
  EXPECT_TRUE(back.root.isApprox(Pose::Identity(), 1e-14));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(back.rows[k].a, plain.rows[k].a, 1e-14);
    EXPECT_NEAR(back.rows[k].alpha, plain.rows[k].alpha, 1e-14);
    EXPECT_NEAR(back.rows[k].beta, plain.rows[k].beta, 1e-14);
    EXPECT_NEAR(back.rows[k].d, plain.rows[k].d, 1e-14);
  }
  EXPECT_TRUE(back.flange.isApprox(plain.flange, 1e-14));
}

TEST(DhTable, RefusesUnequalLists) {
  DhTable table = modified_table();
  DhArmOptions options;
  options.lower = {0.0};
  EXPECT_THROW(arm_from_dh(table, options), std::invalid_argument);
  table.types.pop_back();
  EXPECT_THROW(arm_from_dh(table), std::invalid_argument);
  EXPECT_THROW(arm_from_dh(DhTable{}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
