// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/reach_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bathyal/arm/inverse.hpp"
#include "bathyal/base/random.hpp"
#include "scene/meshes.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

Arm planar_arm_within(double first, double second) {
  DhTable table;
  table.rows = {{0.5, 0.0, 0.0, 0.0, 0.0}, {0.4, 0.0, 0.0, 0.0, 0.0}};
  table.types = {JointType::kRevolute, JointType::kRevolute};
  return arm_from_dh(table, {.lower = {-first, -second}, .upper = {first, second}});
}

/// Three joints that slide along x, y and z of the base.
Arm gantry(const Vec3& lower, const Vec3& upper) {
  std::vector<Joint> joints(3);
  const double alpha[] = {-kPi / 2, kPi / 2, 0.0};  // along z, y, z of the frame before it
  const double theta[] = {0.0, kPi / 2, 0.0};
  for (int k = 0; k < 3; ++k) {
    joints[k].type = JointType::kPrismatic;
    joints[k].coordinate = k;
    joints[k].row = {0.0, alpha[k], 0.0, theta[k], 0.0};
    joints[k].lower = lower[k];
    joints[k].upper = upper[k];
  }
  return Arm("gantry", joints);
}

Workspace alone(Arm arm, const Pose& mount = Pose::Identity()) {
  Surroundings around;
  around.vehicle_from_base = mount;
  return {std::move(arm), around};
}

ReachMap map_of(const Workspace& ws, double voxel, ReachMapOptions options = {}) {
  options.voxel = voxel;
  options.check_clearance = false;
  return reach_map(ws, options);
}

std::size_t count(const std::vector<std::uint8_t>& flags) {
  return static_cast<std::size_t>(std::ranges::count(flags, 1));
}

/// How many of some voxels the map has otherwise than inverse kinematics.
struct Differences {
  int reached = 0;  ///< in any orientation
  int along = 0;    ///< a direction drawn for each
};

Differences compare(const ReachMap& map, const Arm& arm, int checks, bool directions) {
  RandomStream random(5);
  std::vector<std::size_t> voxels, pairs;
  std::vector<double> targets;
  for (int k = 0; k < checks; ++k) {
    voxels.push_back(random.next() % map.total());
    const std::size_t i = random.next() % map.approach.size();
    pairs.push_back(voxels.back() * map.approach.size() + i);
    const Vec3& z = map.approach[i];
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> pose = Eigen::Matrix4d::Identity();
    pose.block<3, 1>(0, 0) = z.unitOrthogonal();
    pose.block<3, 1>(0, 1) = z.cross(z.unitOrthogonal());
    pose.block<3, 1>(0, 2) = z;
    pose.block<3, 1>(0, 3) = map.middle(static_cast<Index>(voxels.back()));
    targets.insert(targets.end(), pose.data(), pose.data() + 16);
  }
  const JointMatrix none(0, arm.size());
  const auto reached = [&](InverseTask task) {
    return inverse(arm, targets, view_of(none), {.task = task}).status;
  };
  Differences found;
  const auto at_all = reached(InverseTask::kPosition);
  for (std::size_t k = 0; k < voxels.size(); ++k) {
    found.reached += (at_all[k] == InverseStatus::kReached) != (map.reached[voxels[k]] != 0);
  }
  if (!directions) return found;
  const auto along = reached(InverseTask::kPositionAxis);
  for (std::size_t k = 0; k < voxels.size(); ++k) {
    found.along += (along[k] == InverseStatus::kReached) != (map.reached_along[pairs[k]] != 0);
  }
  return found;
}

TEST(ReachMap, ThatOfAPlanarArmIsARing) {
  const ReachMap map = map_of(alone(planar_arm()), 0.02);
  for (std::size_t v = 0; v < map.total(); ++v) {
    const Vec3 middle = map.middle(static_cast<Index>(v));
    const double radius = middle.head<2>().norm();
    if (std::abs(radius - 0.1) < 1e-3 || std::abs(radius - 0.9) < 1e-3) continue;
    const bool in_ring = std::abs(middle.z()) < 1e-9 && radius > 0.1 && radius < 0.9;
    ASSERT_EQ(map.reached[v] != 0, in_ring) << middle.transpose();
    if (!in_ring) continue;
    // The tool's z axis is that of the plane, whatever the posture.
    ASSERT_EQ(map.directions[v], 1);
    const std::size_t up =
        26 * v + static_cast<std::size_t>(std::ranges::find(map.approach, Vec3(Vec3::UnitZ())) -
                                          map.approach.begin());
    ASSERT_EQ(map.reached_along[up], 1);
    // Columns of the Jacobian: speeds of the tip, and the turn about z that both make.
    const double elbow = (radius * radius - 0.41) / 0.4;  // its cosine
    const double both = 0.16 + 0.2 * elbow + 1.0;
    const double squared = (radius * radius + 1.0) * 1.16 - both * both;
    EXPECT_NEAR(map.manipulability[v], std::sqrt(squared), 5e-3);
  }
}

TEST(ReachMap, LimitsOfTheFirstJointCutASector) {
  const ReachMap map = map_of(alone(planar_arm_within(kPi / 3, 1e-3)), 0.02);
  std::size_t reached = 0;
  for (std::size_t v = 0; v < map.total(); ++v) {
    if (map.reached[v] == 0) continue;
    ++reached;
    const Vec3 middle = map.middle(static_cast<Index>(v));
    EXPECT_NEAR(middle.norm(), 0.9, 1e-6);  // the elbow hardly moves
    EXPECT_LT(std::abs(std::atan2(middle.y(), middle.x())), kPi / 3 + 1e-3);
  }
  EXPECT_GT(reached, 0U);
  const ReachMap wide = map_of(alone(planar_arm_within(kPi / 3, kPi)), 0.02);
  for (std::size_t v = 0; v < wide.total(); ++v) {
    const Vec3 middle = wide.middle(static_cast<Index>(v));
    const double radius = middle.head<2>().norm();
    if (std::abs(middle.z()) > 1e-9 || std::abs(radius - 0.1) < 1e-3) continue;
    if (std::abs(radius - 0.9) < 1e-3) continue;
    // Half the angle at the foot, of the triangle of both links.
    const double cosine = (radius * radius + 0.25 - 0.16) / radius;
    const double lean = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double beyond = std::abs(std::atan2(middle.y(), middle.x())) - lean - kPi / 3;
    if (std::abs(beyond) < 1e-2) continue;
    EXPECT_EQ(wide.reached[v] != 0, radius > 0.1 && radius < 0.9 && beyond < 0.0)
        << middle.transpose();
  }
}

TEST(ReachMap, ThatOfAGantryIsABox) {
  const Vec3 lower(-0.31, 0.11, -0.21), upper(0.49, 0.51, 0.31);
  const Arm arm = gantry(lower, upper);
  JointMatrix ends(2, 3);
  ends << lower.transpose(), upper.transpose();
  const std::vector<double> poses = forward(arm, view_of(ends));
  Eigen::AlignedBox3d box;
  for (int k = 0; k < 2; ++k) {
    box.extend(Vec3(poses[16 * k + 3], poses[16 * k + 7], poses[16 * k + 11]));
  }
  EXPECT_NEAR(box.volume(), 0.8 * 0.4 * 0.52, 1e-9);
  const ReachMap map = map_of(alone(arm), 0.04);
  for (std::size_t v = 0; v < map.total(); ++v) {
    const Vec3 middle = map.middle(static_cast<Index>(v));
    EXPECT_EQ(map.reached[v] != 0, box.contains(middle)) << middle.transpose();
    EXPECT_EQ(map.directions[v], map.reached[v]);  // it never turns
  }
}

TEST(ReachMap, BoxHoldsAllOfTheReach) {
  for (const Arm& arm : {panda(), ur10e(), three_joints()}) {
    const ReachMap map = map_of(alone(arm), 0.1);
    const std::vector<double> poses = forward(arm, view_of(random_poses(arm, 20000, 3)));
    for (std::size_t k = 0; k < 20000; ++k) {
      const double* pose = &poses[16 * k];
      ASSERT_GE(map.index_of(Vec3(pose[3], pose[7], pose[11])), 0);
    }
  }
}

TEST(ReachMap, AgreesWithInverseKinematics) {
  const ReachMap map = map_of(alone(panda()), 0.06);
  const Differences found = compare(map, panda(), 1500, true);
  EXPECT_LE(found.reached, 7);  // 0.5 %
  EXPECT_LE(found.along, 7);
}

TEST(ReachMap, AgreesWithInverseKinematicsOnATiltedMount) {
  const Pose mount = pose_of(0.3, -0.2, 0.1, 0.7, 0.5);
  const Workspace ws = alone(ur10e(), mount);
  const Differences found = compare(map_of(ws, 0.12), ws.arm(), 1000, true);
  EXPECT_LE(found.reached, 5);
  EXPECT_LE(found.along, 10);
}

TEST(ReachMap, AgreesWithInverseKinematicsOfThreeJoints) {
  const Arm arm = three_joints();
  const ReachMap map = map_of(alone(arm), 0.04);
  EXPECT_LE(compare(map, arm, 3000, false).reached, 15);
  for (std::size_t v = 0; v < map.total(); ++v) {
    EXPECT_EQ(map.reached[v] != 0, map.directions[v] > 0);
  }
}

TEST(ReachMap, AgreesWhereTheFirstCoordinateMovesTwoJoints) {
  std::vector<Joint> joints(4);
  for (int k = 0; k < 4; ++k) {
    joints[k].row = {0.3, k == 0 ? kPi / 2 : 0.0, 0.1, 0.0, 0.0};
    joints[k].coordinate = k == 3 ? 0 : k;
    joints[k].lower = -2.0;
    joints[k].upper = 2.0;
  }
  joints[3].multiplier = 0.5;
  const Arm arm("mimic", joints);
  EXPECT_LE(compare(map_of(alone(arm), 0.06), arm, 1500, false).reached, 8);
}

TEST(ReachMap, SameBytesOnAnyNumberOfThreads) {
  Surroundings around;
  around.capsules = capsules_of_rows(panda(), std::vector<double>{0.05});
  around.hull = Hull(test::box(Vec3(0.3, 0.6, 0.2), Vec3(-0.4, 0.0, 0.0)));
  const Workspace ws(panda(), around);
  const auto made = [&](int threads) {
    return reach_map(ws, {.voxel = 0.15, .samples = 3000, .seed = 4, .num_threads = threads});
  };
  const ReachMap one = made(1);
  const ReachMap three = made(3);
  EXPECT_EQ(one.reached_along, three.reached_along);
  EXPECT_EQ(one.reached, three.reached);
  EXPECT_EQ(one.free, three.free);
  const auto same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  EXPECT_TRUE(std::ranges::equal(one.manipulability, three.manipulability, same));
  EXPECT_TRUE(std::ranges::equal(one.clearance, three.clearance, same));
}

TEST(ReachMap, HullTakesTheFreePartBehindItsFace) {
  const Arm arm = planar_arm();
  Surroundings around;
  around.capsules = capsules_of_rows(arm, std::vector<double>{0.03});
  around.hull = Hull(test::box(Vec3(0.5, 2.0, 1.0), Vec3(-0.7, 0.0, 0.0)));  // up to x = −0.2
  const ReachMap map = reach_map(Workspace(arm, around), {.voxel = 0.02});
  EXPECT_EQ(count(map.reached), count(map_of(alone(arm), 0.02).reached));
  for (std::size_t v = 0; v < map.total(); ++v) {
    const double x = map.middle(static_cast<Index>(v)).x();
    EXPECT_EQ(std::isnan(map.clearance[v]), map.reached[v] == 0);
    if (map.reached[v] == 0) {
      EXPECT_EQ(map.free[v], 0);
    } else if (x < -0.17) {
      EXPECT_EQ(map.free[v], 0) << x;
      EXPECT_LT(map.clearance[v], 0.0F);
    } else if (x > 0.1) {
      EXPECT_EQ(map.free[v], 1) << x;
      EXPECT_LT(map.clearance[v], 0.2F);  // the foot is no farther from it
    }
  }
}

TEST(ReachMap, MoreDirectionsAreFinerOnes) {
  const Workspace ws = alone(ur10e());
  const ReachMap six = map_of(ws, 0.25, {.directions = 6});
  const ReachMap many = map_of(ws, 0.25, {.directions = 98});
  ASSERT_EQ(six.approach.size(), 6U);
  ASSERT_EQ(many.approach.size(), 98U);
  for (const Vec3& one : many.approach) EXPECT_NEAR(one.norm(), 1.0, 1e-15);
  int differ = 0;
  for (std::size_t v = 0; v < six.total(); ++v) {
    differ += six.reached[v] != many.reached[v];
    for (std::size_t i = 0; i < 6; ++i) {
      const auto same = std::ranges::find_if(
          many.approach, [&](const Vec3& d) { return (d - six.approach[i]).norm() < 1e-12; });
      ASSERT_NE(same, many.approach.end());
      const auto k = static_cast<std::size_t>(same - many.approach.begin());
      differ += six.reached_along[6 * v + i] != many.reached_along[98 * v + k];
    }
  }
  EXPECT_LE(differ, static_cast<int>(7 * six.total() / 200));
}

TEST(ReachMap, RefusesWhatMakesNoMap) {
  const Workspace ws = alone(planar_arm());
  EXPECT_THROW(reach_map(ws, {.voxel = 0.0}), std::invalid_argument);
  EXPECT_THROW(reach_map(ws, {.voxel = NAN}), std::invalid_argument);
  EXPECT_THROW(reach_map(ws, {.voxel = 1e-4}), std::invalid_argument);
  EXPECT_THROW(reach_map(ws, {.directions = 7}), std::invalid_argument);
  EXPECT_THROW(reach_map(ws, {.samples = -1}), std::invalid_argument);
  EXPECT_THROW(reach_map(ws, {.samples = 3000000}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
