// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/standpoint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scene/meshes.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

const Vec3 kHalf(0.7, 0.25, 0.2);  // of the hull

/// A bottom over ±4 m of which `height` gives z.
TriangleMesh bottom_of(const std::function<double(double, double)>& height, int cells = 40) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double x = 8.0 * i / cells - 4.0;
      const double y = 8.0 * j / cells - 4.0;
      vertices.emplace_back(x, y, height(x, y));
      if (i == cells || j == cells) continue;
      const int at = i * (cells + 1) + j;
      triangles.emplace_back(at, at + cells + 1, at + 1);
      triangles.emplace_back(at + 1, at + cells + 1, at + cells + 2);
    }
  }
  return test::mesh_of(vertices, triangles);
}

/// The arm under the bow of a box.
Surroundings vehicle_over(const TriangleMesh& bottom) {
  Surroundings around;
  around.vehicle_from_base = Eigen::Translation3d(0.75, 0.0, -0.25) * Pose::Identity();
  around.capsules = capsules_of_rows(three_joints(), std::vector<double>{0.03});
  around.hull = Hull(test::box(kHalf));
  around.scene = Scene({bottom});
  return around;
}

StandpointOptions quick() { return {.voxel = 0.08, .headings = 8, .step = 0.16, .refined = 6}; }

using Targets = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
PointView view(const Targets& targets) { return {targets.data(), targets.rows(), 3}; }

/// Points of the hull's surface, 2.5 cm apart and less, in the world.
std::vector<Vec3> hull_points(const Pose& pose) {
  std::vector<Vec3> points;
  for (int face = 0; face < 6; ++face) {
    for (double u = -1.0; u <= 1.0; u += 0.035) {
      for (double v = -1.0; v <= 1.0; v += 0.035) {
        Vec3 at;
        at[face / 2] = face % 2 == 0 ? -1.0 : 1.0;
        at[(face / 2 + 1) % 3] = u;
        at[(face / 2 + 2) % 3] = v;
        points.push_back(pose * kHalf.cwiseProduct(at));
      }
    }
  }
  return points;
}

void expect_as_checked(const Standpoint& found, const Surroundings& around,
                       const Targets& targets) {
  Surroundings there = around;
  for (const StandpointPlace& place : found.places) {
    const Pose& pose = place.world_from_vehicle;
    EXPECT_NEAR(pose.linear()(2, 2), 1.0, 1e-15);  // level
    there.world_from_vehicle = pose;
    const auto checks = Workspace(three_joints(), there).check_target(view(targets));
    double count = 0.0;
    for (std::size_t i = 0; i < checks.size(); ++i) {
      EXPECT_EQ(place.reached[i] != 0, checks[i].status == TargetIndicator::kFree);
      count += place.reached[i];
    }
    EXPECT_GT(place.score, count);
    EXPECT_LT(place.score, count + 1.0);
    for (const Vec3& point : hull_points(pose)) {
      ASSERT_GE(around.scene->nearest(point).distance, 0.05 - 1e-12);
    }
  }
  for (std::size_t k = 1; k < found.places.size(); ++k) {
    EXPECT_LE(found.places[k].score, found.places[k - 1].score);
    for (std::size_t l = 0; l < k; ++l) {
      const Pose between =
          found.places[k].world_from_vehicle.inverse() * found.places[l].world_from_vehicle;
      EXPECT_TRUE(between.translation().norm() >= 0.2 ||
                  Eigen::AngleAxisd(between.linear()).angle() >= 20.0 * kPi / 180.0 - 1e-9);
    }
  }
}

TEST(Standpoint, ReachesALineOfTargetsOnAFlatBottom) {
  const Surroundings around = vehicle_over(bottom_of([](double, double) { return -10.0; }, 4));
  Targets targets(5, 3);
  for (int i = 0; i < 5; ++i) targets.row(i) << 1.0 + 0.15 * i, -0.5 + 0.1 * i, -9.98;
  const Standpoint found = best_standpoint(three_joints(), around, view(targets), quick());
  EXPECT_EQ(found.status, StandpointStatus::kAll) << found.reason;
  ASSERT_GE(found.places.size(), 2U);
  EXPECT_GT(found.places[0].score, 5.5);
  EXPECT_EQ(found.reason, "5 of 5 targets reached");
  for (const Vec3& point : hull_points(found.places[0].world_from_vehicle)) {
    ASSERT_GE(point.z(), -9.95);
  }
  expect_as_checked(found, around, targets);
}

TEST(Standpoint, ReachesAsManyAsItCan) {
  const Surroundings around = vehicle_over(bottom_of([](double, double) { return 0.0; }, 4));
  Targets targets(4, 3);
  targets << 0.0, 0.0, 0.02, 0.2, 0.1, 0.02, 0.3, 0.3, 0.02, 0.0, 3.9, 0.02;  // the last far off
  const Standpoint found = best_standpoint(three_joints(), around, view(targets), quick());
  EXPECT_EQ(found.status, StandpointStatus::kSome);
  EXPECT_EQ(found.places.at(0).reached, (std::vector<std::uint8_t>{1, 1, 1, 0}));
  expect_as_checked(found, around, targets);
}

TEST(Standpoint, HullStaysAboveASteepRoughBottom) {
  const auto height = [](double x, double y) {
    return 0.8 * x + 0.15 * std::sin(5.0 * y) + 0.1 * std::cos(7.0 * x);
  };
  const Surroundings around = vehicle_over(bottom_of(height));
  Targets targets(3, 3);
  for (int i = 0; i < 3; ++i) {
    const double x = 0.2 * i - 0.5;
    targets.row(i) << x, 0.1 * i, height(x, 0.1 * i) + 0.06;
  }
  const Standpoint found = best_standpoint(three_joints(), around, view(targets), quick());
  ASSERT_FALSE(found.places.empty()) << found.reason;
  EXPECT_GT(found.places[0].score, 2.0);
  expect_as_checked(found, around, targets);
  for (const StandpointPlace& place : found.places) {
    for (const Vec3& point : hull_points(place.world_from_vehicle)) {
      const RayHit under = around.scene->cast(point, -Vec3::UnitZ());
      ASSERT_TRUE(under.mesh >= 0);
    }
  }
}

TEST(Standpoint, HullIsNotPiercedByANeedle) {
  const TriangleMesh flat = bottom_of([](double, double) { return 0.0; }, 4);
  Targets targets(1, 3);
  targets << 0.0, 0.0, 0.02;
  const Standpoint alone =
      best_standpoint(three_joints(), vehicle_over(flat), view(targets), quick());
  ASSERT_FALSE(alone.places.empty());
  // Up through the middle of two faces of the best place, past all edges and vertices.
  const Vec3 tip = alone.places[0].world_from_vehicle * Vec3(0.31, 0.02, 0.3);
  const Vec3 foot(tip.x(), tip.y(), 0.0);
  const TriangleMesh needle = test::mesh_of(
      {tip, foot + Vec3(0.01, 0, 0), foot + Vec3(-0.01, 0.01, 0), foot + Vec3(-0.01, -0.01, 0)},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}});
  Surroundings around = vehicle_over(flat);
  around.scene = Scene({flat, needle});
  const Standpoint found = best_standpoint(three_joints(), around, view(targets), quick());
  ASSERT_FALSE(found.places.empty());
  expect_as_checked(found, around, targets);
}

TEST(Standpoint, KeepsOutOfVolumesFixedToTheWorld) {
  Surroundings around = vehicle_over(bottom_of([](double, double) { return 0.0; }, 4));
  Targets targets(1, 3);
  targets << 0.0, 0.0, 0.02;
  const Standpoint alone = best_standpoint(three_joints(), around, view(targets), quick());
  ASSERT_FALSE(alone.places.empty());
  const Vec3 place = alone.places[0].world_from_vehicle.translation();
  const Pose there(Eigen::Translation3d(place) * Pose::Identity());
  for (const KeepOut& keepout :
       {KeepOut::sphere(0.1, place + Vec3(0.0, 0.0, 0.25), {.frame = "world"}),
        KeepOut::box(Vec3(0.3, 0.3, 0.1), there, {.frame = "world"}),
        KeepOut::box(Vec3(0.01, 0.01, 4.0), there, {.frame = "world", .name = "pole"}),
        KeepOut::cylinder(0.1, 4.0, there, {.frame = "world"}),
        KeepOut::mesh(Hull(test::box(Vec3::Constant(0.05), place)), {.frame = "world"})}) {
    around.keepouts = {keepout};
    const Standpoint found = best_standpoint(three_joints(), around, view(targets), quick());
    ASSERT_FALSE(found.places.empty()) << keepout.name();
    for (const StandpointPlace& one : found.places) {
      const std::vector<Vec3> points = hull_points(one.world_from_vehicle);
      std::vector<double> rows;
      for (const Vec3& point : points) rows.insert(rows.end(), point.begin(), point.end());
      const auto distances = keepout.distance({rows.data(), static_cast<Index>(points.size()), 3});
      EXPECT_GE(*std::ranges::min_element(distances), 0.05 - 1e-9) << keepout.name();
      const Vec3 middle = one.world_from_vehicle.inverse() * place;
      EXPECT_FALSE((middle.cwiseAbs().array() < kHalf.array()).all());  // not swallowed by it
    }
  }
}

TEST(Standpoint, SaysWhyThereIsNone) {
  const TriangleMesh flat = bottom_of([](double, double) { return 0.0; }, 4);
  Targets targets(1, 3);
  targets << 0.0, 0.0, 0.02;
  const auto status = [&](const Surroundings& around) {
    const Standpoint found = best_standpoint(three_joints(), around, view(targets), quick());
    EXPECT_TRUE(found.places.empty());
    EXPECT_FALSE(found.reason.empty());
    return found.status;
  };
  Surroundings covered = vehicle_over(flat);
  covered.keepouts.push_back(KeepOut::sphere(5.0, Vec3::Zero()));
  EXPECT_EQ(status(covered), StandpointStatus::kNoReach);
  Surroundings full = vehicle_over(flat);
  full.keepouts.push_back(
      KeepOut::half_space(Plane(Vec3::UnitZ(), 50.0), {.frame = "world", .name = "all"}));
  EXPECT_EQ(status(full), StandpointStatus::kNoRoom);
  targets.row(0) << 0.0, 0.0, -0.3;
  EXPECT_EQ(status(vehicle_over(flat)), StandpointStatus::kBlocked);
}

TEST(Standpoint, SameBytesOnAnyNumberOfThreads) {
  const Surroundings around = vehicle_over(bottom_of([](double x, double) { return 0.2 * x; }, 8));
  Targets targets(2, 3);
  targets << 0.0, 0.0, 0.05, 0.3, 0.2, 0.11;
  StandpointOptions options = quick();
  options.refined = 3;
  options.num_threads = 1;
  const Standpoint one = best_standpoint(three_joints(), around, view(targets), options);
  options.num_threads = 4;
  const Standpoint four = best_standpoint(three_joints(), around, view(targets), options);
  ASSERT_EQ(one.places.size(), four.places.size());
  ASSERT_FALSE(one.places.empty());
  for (std::size_t k = 0; k < one.places.size(); ++k) {
    EXPECT_EQ(one.places[k].world_from_vehicle.matrix(),
              four.places[k].world_from_vehicle.matrix());
    EXPECT_EQ(one.places[k].score, four.places[k].score);
    EXPECT_EQ(one.places[k].reached, four.places[k].reached);
  }
}

TEST(Standpoint, RefusesBadInput) {
  const Surroundings around = vehicle_over(bottom_of([](double, double) { return 0.0; }, 2));
  const auto found = [&](const Targets& targets, const StandpointOptions& options) {
    return best_standpoint(three_joints(), around, view(targets), options);
  };
  EXPECT_THROW(found(Targets(0, 3), quick()), std::invalid_argument);
  EXPECT_THROW(found(Targets::Constant(1, 3, NAN), quick()), std::invalid_argument);
  EXPECT_THROW(found(Targets::Zero(1, 3), {.voxel = -1.0}), std::invalid_argument);
  EXPECT_THROW(found(Targets::Zero(1, 3), {.headings = 0}), std::invalid_argument);
  EXPECT_THROW(found(Targets::Zero(1, 3), {.hull_clearance = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
