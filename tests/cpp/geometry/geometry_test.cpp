// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <stdexcept>

#include "bathyal/geometry/plane.hpp"
#include "bathyal/geometry/pose.hpp"
#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal {
namespace {

PointMatrix three_points() {
  PointMatrix points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  return points;
}

TEST(Plane, IsScaledToAUnitNormal) {
  const Plane plane(Vec3(0, 0, 4), 8.0);
  EXPECT_EQ(plane.normal(), Vec3::UnitZ());
  EXPECT_DOUBLE_EQ(plane.offset(), 2.0);
  EXPECT_DOUBLE_EQ(plane.distance(Vec3(5, 6, 3)), 1.0);
  EXPECT_EQ(plane.project(Vec3(5, 6, 3)), Vec3(5, 6, 2));
}

TEST(Plane, RefusesAZeroOrInfiniteNormal) {
  EXPECT_THROW(Plane(Vec3::Zero(), 1.0), std::invalid_argument);
  EXPECT_THROW(Plane(Vec3(0, 0, INFINITY), 1.0), std::invalid_argument);
  EXPECT_THROW(Plane(Vec3::UnitZ(), NAN), std::invalid_argument);
}

TEST(Plane, OfADenormalNormalIsAsAnyOtherOrRefused) {
  constexpr double kLeast = 5e-324;
  EXPECT_EQ(Plane(Vec3(0, 0, kLeast), 0.0).normal(), Vec3::UnitZ());
  EXPECT_DOUBLE_EQ(Plane(Vec3(0, 0, kLeast), kLeast).offset(), 1.0);
  EXPECT_NEAR(Plane(Vec3(3 * kLeast, 0, 4 * kLeast), 0.0).normal().x(), 0.6, 1e-15);
  EXPECT_NEAR(Plane::through(Vec3(0, 0, 5), Vec3(3, 0, 4) * kLeast).offset(), 4.0, 1e-14);
  EXPECT_DOUBLE_EQ(Plane(Vec3(0, 0, 1e-200), 1e-190).offset(), 1e10);
  EXPECT_THROW(Plane(Vec3(0, 0, kLeast), 1.0), std::invalid_argument);
  EXPECT_THROW(Plane(Vec3(0, 0, 1e-200), 1e200), std::invalid_argument);
}

TEST(SharedArray, SnapshotsWhatSomebodyMayWriteTo) {
  auto buffer = std::make_shared<PointMatrix>(three_points());
  const Points given(buffer->data(), 3, buffer, true);
  const Points taken = given.snapshot();
  EXPECT_TRUE(given.writable());
  EXPECT_FALSE(taken.writable());
  buffer->setConstant(7.0);
  EXPECT_EQ(given.view()(0, 0), 7.0);
  EXPECT_EQ(taken.view(), three_points());
  EXPECT_EQ(taken.snapshot().data(), taken.data());
}

TEST(TriangleMesh, CopiesTrianglesThatSomebodyMayWriteTo) {
  auto buffer = std::make_shared<TriangleMatrix>(1, 3);
  *buffer << 0, 1, 2;
  auto vertices = std::make_shared<PointMatrix>(three_points());
  const TriangleMesh mesh(Points(vertices->data(), 3, vertices, true),
                          Triangles(buffer->data(), 1, buffer, true));
  const TriangleMesh taken = mesh.snapshot();
  *buffer << 9, 9, 9;
  EXPECT_EQ(mesh.triangles(), (TriangleMatrix(1, 3) << 0, 1, 2).finished());
  (*vertices)(0, 0) = NAN;
  EXPECT_TRUE(taken.vertices().allFinite());
  EXPECT_THROW(mesh.snapshot(), std::invalid_argument);
}

TEST(TriangleMesh, SharesWhatItIsGiven) {
  const Points points(three_points());
  TriangleMatrix triangles(1, 3);
  triangles << 0, 1, 2;
  const TriangleMesh mesh(points, triangles);
  EXPECT_EQ(mesh.vertices().data(), points.data());
  EXPECT_EQ(mesh.area_vector(0), Vec3::UnitZ());
}

TEST(TriangleMesh, RefusesIndicesOutOfRangeAndVerticesThatAreNotFinite) {
  TriangleMatrix triangles(1, 3);
  triangles << 0, 1, 3;
  EXPECT_THROW(TriangleMesh(three_points(), triangles), std::invalid_argument);
  triangles << -1, 1, 2;
  EXPECT_THROW(TriangleMesh(three_points(), triangles), std::invalid_argument);
  triangles << 0, 1, 2;
  PointMatrix points = three_points();
  points(1, 2) = NAN;
  EXPECT_THROW(TriangleMesh(points, triangles), std::invalid_argument);
}

TEST(LocalOrigin, IsSnappedToWholeMetresAndIgnoresWhatIsNotFinite) {
  PointMatrix points(3, 3);
  points << 620152.873, 7246504.912, -52.9, 620153.873, 7246506.9, -51.1, NAN, 0, 0;
  EXPECT_EQ(local_origin(Points(points).view()), Vec3(620153, 7246506, -52));
}

TEST(Pose, WhatIsNoRigidMotionIsRefused) {
  Pose pose = Pose::Identity();
  check_rigid("pose", pose);
  pose.linear()(0, 1) = 1e-3;
  EXPECT_THROW(check_rigid("pose", pose), std::invalid_argument);
  pose.linear() = -Eigen::Matrix3d::Identity();
  EXPECT_THROW(check_rigid("pose", pose), std::invalid_argument);
  pose = Pose::Identity();
  pose.matrix()(3, 0) = 0.5;
  EXPECT_THROW(check_rigid("pose", pose), std::invalid_argument);
  pose = Pose::Identity();
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check_rigid("pose", pose), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
