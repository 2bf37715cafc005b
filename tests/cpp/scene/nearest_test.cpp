// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/nearest.hpp"

#include <gtest/gtest.h>

#include <random>

#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"

namespace bathyal {
namespace {

PointMatrix random_points(Index count, const Vec3& low, const Vec3& high, unsigned seed) {
  std::mt19937 random(seed);
  PointMatrix points(count, 3);
  for (Index i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      points(i, axis) = std::uniform_real_distribution<double>(low[axis], high[axis])(random);
    }
  }
  return points;
}

PointView view(const PointMatrix& points) { return {points.data(), points.rows(), 3}; }

/// Least distance over a fine lattice of the triangle: an upper bound that closes in on the truth.
double lattice_distance(const std::array<Vec3, 3>& t, const Vec3& q) {
  constexpr int kSteps = 200;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const double u = double(i) / kSteps, v = double(j) / kSteps;
      best = std::min(best, (t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) - q).norm());
    }
  }
  return best;
}

TEST(ClosestPoint, IsTheBestOfTheTriangle) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 60; ++i) {
    std::array<Vec3, 3> t;
    for (Vec3& corner : t) corner = Vec3(normal(random), normal(random), normal(random));
    if (i % 4 == 0) t[2] = t[0] + 0.4 * (t[1] - t[0]);  // a segment
    if (i % 8 == 1) t[1] = t[2] = t[0];                 // a point
    const Vec3 q(2.0 * normal(random), 2.0 * normal(random), 2.0 * normal(random));
    const scene::ClosestPoint found = scene::closest_point(t, q);
    const double lattice = lattice_distance(t, q);
    EXPECT_LE(std::sqrt(found.squared_distance), lattice + 1e-12);
    EXPECT_GE(std::sqrt(found.squared_distance), lattice - 0.05);
    const Vec3 rebuilt = t[0] + found.u * (t[1] - t[0]) + found.v * (t[2] - t[0]);
    EXPECT_NEAR((rebuilt - found.point).norm(), 0.0, 1e-13);
    EXPECT_TRUE(found.u >= 0.0 && found.v >= 0.0 && found.u + found.v <= 1.0 + 1e-15);
  }
}

TEST(ClosestPoint, IsTheCornerItself) {
  const std::array<Vec3, 3> t{Vec3(0.1, 0.2, 0.3), Vec3(1.1, 0.7, 0.9), Vec3(0.3, 1.3, 0.7)};
  for (std::size_t c = 0; c < 3; ++c) {
    const scene::ClosestPoint found = scene::closest_point(t, t[c]);
    EXPECT_EQ(found.squared_distance, 0.0);
    EXPECT_EQ(found.point, t[c]);
  }
}

TEST(Nearest, BoxBySubtraction) {
  const Vec3 half(1.0, 2.0, 3.0);
  const Scene scene({test::box(half)});
  const PointMatrix points = random_points(500, {-5, -5, -5}, {5, 5, 5}, 2);
  const auto all = scene.nearest(view(points));
  for (Index i = 0; i < points.rows(); ++i) {
    const Vec3 q = points.row(i);
    const Vec3 beyond = (q.cwiseAbs() - half).cwiseMax(0.0);
    const double expected = beyond.norm() > 0.0 ? beyond.norm() : (half - q.cwiseAbs()).minCoeff();
    EXPECT_NEAR(all[static_cast<std::size_t>(i)].distance, expected, 1e-14);
    EXPECT_NEAR((all[static_cast<std::size_t>(i)].point - q).norm(), expected, 1e-14);
  }
}

/// Whether the answers are those of every triangle in turn, to the last bit.
void expect_exact(const Scene& scene, const PointMatrix& points) {
  const auto found = scene.nearest(view(points));
  for (Index i = 0; i < points.rows(); ++i) {
    const Vec3 q = points.row(i);
    double best = std::numeric_limits<double>::infinity();
    std::pair<std::int32_t, std::int32_t> who;
    for (std::int32_t m = 0; m < static_cast<std::int32_t>(scene.meshes().size()); ++m) {
      const TriangleMesh& each = scene.meshes()[static_cast<std::size_t>(m)];
      for (std::int32_t t = 0; t < each.triangle_count(); ++t) {
        const double d =
            scene::closest_point({each.corner(t, 0), each.corner(t, 1), each.corner(t, 2)}, q)
                .squared_distance;
        if (d < best) {
          best = d;
          who = {m, t};
        }
      }
    }
    const NearestPoint& one = found[static_cast<std::size_t>(i)];
    ASSERT_EQ(one.distance, std::sqrt(best)) << q.transpose();
    ASSERT_EQ(std::pair(one.mesh, one.triangle), who) << q.transpose();
  }
}

TEST(Nearest, SameAsEveryTriangleInTurn) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(512345.25, 7212345.5, -52.0)}) {
    const TriangleMesh mesh = test::seabed(40, 30, offset);
    expect_exact(Scene({test::one_triangle(offset + Vec3(0, 0, 60)), mesh}),
                 random_points(200, offset + Vec3(-20, -20, -20), offset + Vec3(60, 50, 40), 3));
  }
}

// What the floats of the sieve cannot hold must not rule anything out.
TEST(Nearest, SameAsEveryTriangleFromFarAwayAndAtEveryScale) {
  const TriangleMesh seabed = test::seabed(20, 15);
  for (const double far : {1e3, 1e6, 1e9, 1e10, 1e12, 1e18, 1e20, 1e30, 1e40, 1e140}) {
    expect_exact(Scene({seabed}), random_points(40, {-far, -far, -far}, {far, far, far}, 5));
  }
  for (const double scale : {1e-30, 1e-18, 1e-9, 1e-3, 1e6, 1e10}) {
    const Scene scene(
        {TriangleMesh(PointMatrix(scale * seabed.vertices()), seabed.shared_triangles())});
    expect_exact(scene, random_points(40, {-5 * scale, -5 * scale, -5 * scale},
                                      {25 * scale, 20 * scale, 5 * scale}, 6));
  }
}

TEST(Nearest, TiesGiveTheLowestTriangle) {
  const TriangleMesh mesh = test::seabed(20, 20, {512345.0, 7212345.0, 0.0});
  const Scene scene({mesh, mesh});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {  // at a corner and far above it
    const Vec3 corner = mesh.vertices().row(v);
    const NearestPoint found = scene.nearest(corner);
    EXPECT_EQ(found.distance, 0.0);
    EXPECT_EQ(found.point, corner);
    EXPECT_EQ(found.mesh, 0);
    std::int32_t lowest = 0;
    while (!(mesh.triangles().row(lowest).array() == static_cast<std::int32_t>(v)).any()) ++lowest;
    EXPECT_EQ(found.triangle, lowest);
  }
}

TEST(Nearest, ATriangleOfDenormalSizeIsAPoint) {
  for (const double size : {5e-324, 1e-310, 1e-200, 1e-162}) {
    PointMatrix corners(3, 3);
    corners << 0, 0, 0, size, 0, 0, 0, size, 0;
    TriangleMatrix triangle(1, 3);
    triangle << 0, 1, 2;
    const Scene scene({TriangleMesh(corners, triangle)});
    for (const Vec3& query : {Vec3(1, 2, 2), Vec3(-1, -2, -2), Vec3(3, 0, 0), Vec3(0, 3, 0)}) {
      const NearestPoint found = scene.nearest(query);
      EXPECT_DOUBLE_EQ(found.distance, 3.0) << size;
      EXPECT_LE(found.point.norm(), 2 * size);
      EXPECT_TRUE(found.u >= 0.0 && found.v >= 0.0 && found.u + found.v <= 1.0) << size;
      EXPECT_EQ(found.triangle, 0);
    }
  }
}

TEST(Nearest, EmptySceneAnswersInfinity) {
  const NearestPoint found = Scene({TriangleMesh()}).nearest(Vec3::Zero());
  EXPECT_EQ(found.distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(found.triangle, -1);
  EXPECT_TRUE(std::isnan(found.point.x()));
}

TEST(Nearest, OneThreadEqualsEight) {
  const Scene scene({test::seabed(50, 50)});
  const PointMatrix points = random_points(2000, {-10, -10, -10}, {60, 60, 10}, 4);
  const auto one = scene.nearest(view(points), 1), eight = scene.nearest(view(points), 8);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].distance, eight[i].distance);
    EXPECT_EQ(one[i].triangle, eight[i].triangle);
    EXPECT_EQ(one[i].point, eight[i].point);
  }
}

TEST(Nearest, RefusesPointsThatAreNotFinite) {
  const Scene scene({test::box({1, 1, 1})});
  EXPECT_THROW(scene.nearest(Vec3(0.0, std::nan(""), 0.0)), std::invalid_argument);
  EXPECT_THROW(scene.nearest(Vec3(0.0, INFINITY, 0.0)), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
