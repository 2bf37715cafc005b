// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "bathyal/scene/scene.hpp"
#include "instances.hpp"
#include "meshes.hpp"
#include "rays.hpp"

namespace bathyal {
namespace {

using test::Cast;
using test::random_pose;
using test::stones;
using test::view;

constexpr double kInf = std::numeric_limits<double>::infinity();

PointMatrix random_points(int count, const Vec3& centre, const Vec3& half, std::uint64_t seed) {
  PointMatrix points(count, 3);
  for (Index i = 0; i < count; ++i) {
    RandomStream random(seed, static_cast<std::uint64_t>(i));
    for (int axis = 0; axis < 3; ++axis) {
      points(i, axis) = centre[axis] + half[axis] * random.uniform(-1.0, 1.0);
    }
  }
  return points;
}

/// Rounding of coordinates there, of turning and of the distance.
double slack(const Vec3& offset) { return 1e-12 * (100.0 + 10.0 * offset.cwiseAbs().maxCoeff()); }

TEST(Instances, NearestPointsAreThoseOfTheMergedMesh) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(6.2e5, 7.2e6, -52)}) {
    const Cast cast = stones(200, offset, 5);
    const Scene scene = cast.scene(), merged = cast.merged();
    const PointMatrix points = random_points(800, offset + Vec3(30, 25, 2), Vec3(40, 35, 8), 1);
    const auto found = scene.nearest(view(points), 2), truth = merged.nearest(view(points), 2);
    int same = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].distance, truth[i].distance, slack(offset)) << i;
      const Vec3 point = points.row(static_cast<Index>(i));
      EXPECT_NEAR((found[i].point - point).norm(), found[i].distance, slack(offset)) << i;
      if (found[i].mesh == truth[i].mesh && found[i].triangle == truth[i].triangle) ++same;
    }
    EXPECT_GT(same, 700);
    const auto alone = scene.nearest(view(points), 1);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(alone[i].point, found[i].point);
  }
}

TEST(Instances, NearestToSegmentsAreThoseOfTheMergedMesh) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(6.2e5, 7.2e6, -52)}) {
    const Cast cast = stones(200, offset, 5);
    const Scene scene = cast.scene(), merged = cast.merged();
    const PointMatrix from = random_points(600, offset + Vec3(30, 25, 4), Vec3(40, 35, 8), 1);
    const PointMatrix to = from + random_points(600, Vec3(0, 0, 0), Vec3(3, 3, 3), 2);
    for (const double within : {kInf, 1.5}) {
      const auto found = scene.nearest_segments(view(from), view(to), {within}, 2);
      const auto truth = merged.nearest_segments(view(from), view(to), {within}, 2);
      int crossing = 0, missing = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (truth[i].distance == kInf) {
          ++missing;
          EXPECT_EQ(found[i].distance, kInf);
          EXPECT_EQ(found[i].mesh, -1);
          continue;
        }
        EXPECT_NEAR(found[i].distance, truth[i].distance, slack(offset)) << i;
        EXPECT_NEAR((found[i].point - found[i].segment_point).norm(), found[i].distance,
                    slack(offset));
        if (truth[i].distance > 0.0) continue;
        ++crossing;
        EXPECT_EQ(found[i].distance, 0.0);
        EXPECT_EQ(found[i].point, found[i].segment_point);
      }
      EXPECT_GT(crossing, 30);
      EXPECT_EQ(missing > 0, within < kInf);
    }
  }
}

TEST(Instances, AtTheIdentityQueriesGiveTheBytesWithoutPoses) {
  const Cast cast = [] {
    Cast some;
    some.add(test::seabed(60, 50));
    some.add(test::sphere(3, 2.0, Vec3(20, 20, 1)));
    some.add(test::sphere(3, 2.0, Vec3(20, 20, 1)));  // other arrays: another mesh
    return some;
  }();
  const Scene scene = cast.scene(), plain(cast.meshes);
  const PointMatrix points = random_points(500, Vec3(30, 25, 2), Vec3(40, 35, 8), 1);
  const PointMatrix ends = random_points(500, Vec3(30, 25, 2), Vec3(40, 35, 8), 2);
  const auto near = scene.nearest(view(points)), near_plain = plain.nearest(view(points));
  const auto way = scene.nearest_segments(view(points), view(ends));
  const auto way_plain = plain.nearest_segments(view(points), view(ends));
  for (std::size_t i = 0; i < near.size(); ++i) {
    EXPECT_EQ(near[i].distance, near_plain[i].distance);
    EXPECT_EQ(near[i].mesh, near_plain[i].mesh);
    EXPECT_EQ(near[i].triangle, near_plain[i].triangle);
    EXPECT_EQ(near[i].point, near_plain[i].point);
    EXPECT_EQ(way[i].distance, way_plain[i].distance);
    EXPECT_EQ(way[i].mesh, way_plain[i].mesh);
    EXPECT_EQ(way[i].segment_point, way_plain[i].segment_point);
  }
}

TEST(Instances, WindingNumbersAddUp) {
  Cast cast;
  const TriangleMesh mesh = test::sphere(3, 1.0);
  for (int i = 0; i < 30; ++i) {
    RandomStream random(7, static_cast<std::uint64_t>(i));
    const Pose pose = random_pose(random, Vec3(0, 0, 0), Vec3(5, 5, 5));
    cast.add(i % 3 ? mesh : test::box(Vec3(1, 0.5, 2)), pose, random.uniform(0.5, 2.0));
  }
  const Scene scene = cast.scene(), merged = cast.merged();
  const PointMatrix points = random_points(600, Vec3(0, 0, 0), Vec3(7, 7, 7), 3);
  const WindingOptions exact{1e-9};
  const auto found = scene.winding_number(view(points), exact, 2);
  const auto truth = merged.winding_number(view(points), exact, 2);
  int inside = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], truth[i], 1e-9) << i;
    inside += std::abs(truth[i]) > 0.5 ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
  EXPECT_EQ(scene.contains(view(points)), merged.contains(view(points)));
  // On its surface, to rounding.
  PointMatrix corners(30, 3);
  for (std::int32_t m = 0; m < 30; ++m) corners.row(m) = scene.corner(m, 2, 1);
  EXPECT_EQ(scene.contains(view(corners)), std::vector<bool>(30, true));
}

double length_of(const std::vector<Polyline>& lines) {
  double length = 0.0;
  for (const Polyline& line : lines) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      length += (line.points[i] - line.points[i - 1]).norm();
    }
  }
  return length;
}

TEST(Instances, SectionsAreThoseOfTheMergedMesh) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(6.2e5, 7.2e6, -52)}) {
    const Cast cast = stones(150, offset, 9);
    const Scene scene = cast.scene(), merged = cast.merged();
    for (int k = 0; k < 40; ++k) {
      RandomStream random(31, static_cast<std::uint64_t>(k));
      const Vec3 normal(random.normal(), random.normal(), random.normal());
      const Plane plane = Plane::through(offset + Vec3(30, 25, 0), normal.normalized());
      const auto found = scene.section(plane), truth = merged.section(plane);
      ASSERT_EQ(found.size(), truth.size()) << k;
      EXPECT_NEAR(length_of(found), length_of(truth), 10.0 * slack(offset));
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].mesh, truth[i].mesh);
        EXPECT_EQ(found[i].triangle, truth[i].triangle);
        EXPECT_EQ(found[i].closed, truth[i].closed);
      }
      const Vec3 a = offset + Vec3(random.uniform(0, 20), random.uniform(0, 49), 0);
      const Vec3 b = offset + Vec3(random.uniform(40, 59), random.uniform(0, 49), 0);
      EXPECT_NEAR(length_of(scene.section(a, b)), length_of(merged.section(a, b)),
                  10.0 * slack(offset));
      EXPECT_EQ(scene.section(a, b).size(), merged.section(a, b).size());
    }
  }
}

TEST(Instances, WithoutTrianglesAnswerNothing) {
  const Scene scene({TriangleMesh()}, {Pose::Identity()});
  EXPECT_EQ(scene.nearest(Vec3(1, 2, 3)).distance, kInf);
  EXPECT_EQ(scene.nearest_segment(Vec3(1, 2, 3), Vec3(0, 0, 0)).mesh, -1);
  EXPECT_TRUE(scene.section(Vec3(0, 0, 0), Vec3(1, 0, 0)).empty());
  const PointMatrix point = PointMatrix::Zero(1, 3);
  EXPECT_EQ(scene.winding_number(view(point)), std::vector<double>{0.0});
}

TEST(Instances, MeshesInTheWorldAreWhereRaysMeetThem) {
  const Cast cast = stones(20, Vec3(0, 0, 0), 41);
  const Scene scene = cast.scene(), merged = cast.merged();
  for (std::int32_t m = 0; m < 21; ++m) {
    const TriangleMesh moved = scene.mesh_in_world(m);
    const TriangleMesh& truth = merged.meshes()[static_cast<std::size_t>(m)];
    EXPECT_LT((moved.vertices() - truth.vertices()).cwiseAbs().maxCoeff(), 1e-13 * 100);
    EXPECT_EQ(moved.triangles().data(),
              scene.meshes()[static_cast<std::size_t>(m)].triangles().data());
    EXPECT_EQ(moved.corner(3, 2), scene.corner(m, 3, 2));
    EXPECT_LT((moved.area_vector(3) - scene.area_vector(m, 3)).norm(), 1e-13 * 100);
  }
  EXPECT_TRUE(scene.is_at_identity(0));
  EXPECT_FALSE(scene.is_at_identity(1));
  EXPECT_EQ(scene.mesh_in_world(0).vertices().data(), scene.meshes()[0].vertices().data());
}

}  // namespace
}  // namespace bathyal
