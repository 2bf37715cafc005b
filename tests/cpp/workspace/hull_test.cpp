// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/hull.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "../scene/meshes.hpp"
#include "bathyal/workspace/internal/inside_grid.hpp"

namespace bathyal {
namespace {

PointMatrix points_around(const TriangleMesh& mesh, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.1, 1.1);
  std::normal_distribution<double> normal(0.0, 0.01);
  const Vec3 low = mesh.vertices().colwise().minCoeff();
  const Vec3 size = mesh.vertices().colwise().maxCoeff().transpose() - low;
  PointMatrix points(count, 3);
  for (Index i = 0; i < count; ++i) {
    if (i % 2 == 0) {
      points.row(i) =
          low + Vec3(uniform(random), uniform(random), uniform(random)).cwiseProduct(size);
      continue;
    }
    const Index t = static_cast<Index>(random() % static_cast<unsigned>(mesh.triangle_count()));
    const Vec3 weights = Vec3(uniform(random), uniform(random), uniform(random)).cwiseAbs();
    Vec3 point = Vec3::Zero();
    for (int c = 0; c < 3; ++c) point += weights[c] / weights.sum() * mesh.corner(t, c);
    points.row(i) = point + Vec3(normal(random), normal(random), normal(random)) *
                                (i % 4 == 1 ? size.norm() : 1e-13);
  }
  return points;
}

std::vector<bool> contains(const Hull& hull, PointView points, int num_threads = 0) {
  const auto count = static_cast<std::size_t>(points.rows());
  const std::unique_ptr<bool[]> inside(new bool[count]);
  hull.contains(points, {inside.get(), count}, num_threads);
  return std::vector<bool>(inside.get(), inside.get() + count);
}

PointView view(const PointMatrix& points) { return {points.data(), points.rows(), 3}; }

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  PointMatrix points(a.vertex_count() + b.vertex_count(), 3);
  points << a.vertices(), b.vertices();
  TriangleMatrix triangles(a.triangle_count() + b.triangle_count(), 3);
  triangles << a.triangles(), b.triangles().array() + static_cast<int>(a.vertex_count());
  return {std::move(points), std::move(triangles)};
}

TriangleMesh without_last(const TriangleMesh& mesh, Index count) {
  return {mesh.shared_vertices(),
          TriangleMatrix(mesh.triangles().topRows(mesh.triangle_count() - count))};
}

TriangleMesh inside_out(const TriangleMesh& mesh) {
  return {mesh.shared_vertices(), TriangleMatrix(mesh.triangles().rowwise().reverse())};
}

/// Each triangle with corners of its own, as STL files have them.
TriangleMesh unwelded(const TriangleMesh& mesh) {
  PointMatrix points(3 * mesh.triangle_count(), 3);
  TriangleMatrix triangles(mesh.triangle_count(), 3);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    for (int c = 0; c < 3; ++c) points.row(3 * t + c) = mesh.corner(t, c);
    triangles.row(t) << static_cast<int>(3 * t), static_cast<int>(3 * t + 1),
        static_cast<int>(3 * t + 2);
  }
  return {std::move(points), std::move(triangles)};
}

struct Case {
  std::string name;
  TriangleMesh mesh;
};

std::vector<Case> cases() {
  const TriangleMesh ball = test::sphere(3, 1.0), body = test::box({1.0, 0.4, 0.2});
  return {{"sphere", ball},
          {"sphere far away", test::sphere(3, 1.0, {512345.25, 7212345.5, -52.0})},
          {"box", body},
          {"needle", test::box({3.0, 0.002, 0.001})},
          {"inside out", inside_out(ball)},
          {"own corners", unwelded(ball)},
          {"two that overlap", joined(body, test::box({0.2, 0.2, 1.0}, {0.3, 0.1, 0.0}))},
          {"wound against each other", joined(body, inside_out(test::box({0.2, 0.2, 1.0})))},
          {"a cavity", joined(ball, inside_out(test::sphere(2, 0.5)))},
          {"a hole", without_last(ball, 20)},
          {"half open", without_last(ball, ball.triangle_count() / 2)},
          {"box without lid", without_last(body, 2)}};
}

TEST(Hull, ContainsWhatTheWindingNumberSays) {
  for (const Case& one : cases()) {
    const Hull hull(one.mesh);
    const PointMatrix points = points_around(one.mesh, 1500, 5);
    const std::vector<bool> expected = hull.scene().contains(view(points));
    EXPECT_EQ(contains(hull, view(points)), expected) << one.name;
    EXPECT_EQ(contains(hull, view(points), 1), expected) << one.name;
    const PointMatrix few = points.topRows(40);
    EXPECT_EQ(contains(hull, view(few)), std::vector<bool>(expected.begin(), expected.begin() + 40))
        << one.name;
  }
}

/// The grid alone: it answers, is right, and leaves to the winding number little but the surface.
TEST(InsideGrid, AnswersAllButTheSurface) {
  for (const Case& one : cases()) {
    const Scene scene({one.mesh});
    const workspace::WeldedMesh welded(one.mesh);
    const auto open = workspace::edge_report(welded).open;
    const workspace::InsideGrid grid(scene, welded, open, 2);
    PointMatrix points = points_around(one.mesh, 1200, 6);
    const std::vector<bool> expected = scene.contains(view(points));
    int unknown = 0;
    for (Index i = 0; i < points.rows(); ++i) {
      const workspace::Side side = grid.look(points.row(i));
      unknown += side == workspace::Side::kUnknown;
      if (side == workspace::Side::kUnknown) continue;
      ASSERT_EQ(side == workspace::Side::kInside, expected[static_cast<std::size_t>(i)])
          << one.name << " at " << points.row(i);
    }
    // A quarter of the points lies within 1e-13 m of the surface.
    if (open.empty()) {
      EXPECT_LT(unknown, 360) << one.name;
    }
    EXPECT_LT(unknown, 1050) << one.name;
  }
}

TEST(Hull, ContainsItsVerticesAndEdges) {
  const TriangleMesh ball = test::sphere(3, 1.0);
  PointMatrix points(4 * ball.triangle_count(), 3);
  for (Index t = 0; t < ball.triangle_count(); ++t) {
    for (int c = 0; c < 3; ++c) points.row(4 * t + c) = ball.corner(t, c);
    points.row(4 * t + 3) = 0.5 * (ball.corner(t, 0) + ball.corner(t, 1));
  }
  ASSERT_GE(points.rows(), 1000);
  const Hull hull(ball);
  EXPECT_EQ(contains(hull, view(points)), hull.scene().contains(view(points)));
}

TEST(Hull, SignedDistanceOfABox) {
  const Hull hull(test::box({1.0, 2.0, 3.0}));
  PointMatrix points(3, 3);
  points << 0.0, 0.0, 0.0, 0.75, 0.0, 0.0, 1.0, 2.0, 5.0;
  EXPECT_EQ(hull.signed_distance(view(points)), (std::vector<double>{-1.0, -0.25, 2.0}));
}

TEST(Hull, VoxelsFillTheBox) {
  const Hull hull(test::box({1.0, 0.5, 0.25}, {10.0, 0.0, 0.0}));
  const Voxels voxels = hull.voxels(0.1);
  EXPECT_EQ(voxels.count[0] * voxels.count[1] * voxels.count[2], static_cast<int>(voxels.total()));
  EXPECT_TRUE((voxels.count == Eigen::Array3i(20, 10, 5)).all());
  EXPECT_TRUE(voxels.origin.isApprox(Vec3(9.0, -0.5, -0.25)));
  for (std::size_t v = 0; v < voxels.total(); ++v) EXPECT_TRUE(voxels.inside[v]);
  EXPECT_THROW(hull.voxels(0.0), std::invalid_argument);
  EXPECT_THROW(hull.voxels(1e-6), std::invalid_argument);
}

TEST(Hull, RefusesWhatEnclosesNothing) {
  EXPECT_THROW(Hull{TriangleMesh()}, std::invalid_argument);
  EXPECT_THROW(Hull(test::one_triangle(Vec3::Zero())), std::invalid_argument);
  EXPECT_THROW(Hull(test::box({1.0, 1.0, 0.0})), std::invalid_argument);
  EXPECT_THROW(Hull(test::box({1.0, 0.0, 0.0})), std::invalid_argument);
  EXPECT_NO_THROW(Hull(test::box({1.0, 1.0, 1e-3})));
  const Hull hull(test::box({1.0, 1.0, 1.0}));
  PointMatrix points = PointMatrix::Constant(1, 3, std::nan(""));
  EXPECT_THROW(contains(hull, view(points)), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
