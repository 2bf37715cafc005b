// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/winding.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "meshes.hpp"

namespace bathyal {
namespace {

PointMatrix matrix_of(const std::vector<Vec3>& points) {
  PointMatrix matrix(static_cast<Index>(points.size()), 3);
  for (Index i = 0; i < matrix.rows(); ++i) matrix.row(i) = points[static_cast<std::size_t>(i)];
  return matrix;
}

PointView view(const PointMatrix& points) { return {points.data(), points.rows(), 3}; }

std::vector<Vec3> random_points(int count, double size, const Vec3& centre, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(centre + Vec3(uniform(random), uniform(random), uniform(random)));
  }
  return points;
}

/// The definition: every triangle's solid angle.
double exact_winding_number(const TriangleMesh& mesh, const Vec3& q) {
  double angle = 0.0;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    angle +=
        scene::solid_angle({mesh.corner(t, 0) - q, mesh.corner(t, 1) - q, mesh.corner(t, 2) - q});
  }
  return angle / (4.0 * std::numbers::pi);
}

TriangleMesh turned_inside_out(const TriangleMesh& mesh) {
  TriangleMatrix triangles = mesh.triangles();
  triangles.col(1).swap(triangles.col(2));
  return {mesh.shared_vertices(), std::move(triangles)};
}

/// The first `count` triangles.
TriangleMesh head(const TriangleMesh& mesh, Index count) {
  return {mesh.shared_vertices(), TriangleMatrix(mesh.triangles().topRows(count))};
}

TEST(SolidAngle, OctantIsHalfPi) {
  EXPECT_NEAR(scene::solid_angle({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}),
              std::numbers::pi / 2.0, 1e-15);
  EXPECT_NEAR(scene::solid_angle({Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()}),
              -std::numbers::pi / 2.0, 1e-15);
}

TEST(WindingNumber, OneInsideNoneOutside) {
  const Vec3 centre(3.0, -2.0, 7.0);
  for (const double sign : {1.0, -1.0}) {
    TriangleMesh mesh = test::sphere(5, 2.0, centre);
    if (sign < 0.0) mesh = turned_inside_out(mesh);
    const Scene scene({mesh});
    const std::vector<Vec3> points = random_points(2000, 4.0, centre, 1);
    const PointMatrix matrix = matrix_of(points);
    const auto numbers = scene.winding_number(view(matrix));
    const auto inside = scene.contains(view(matrix));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double radius = (points[i] - centre).norm();
      if (std::abs(radius - 2.0) < 0.01) continue;  // between the facets and the sphere
      EXPECT_NEAR(numbers[i], radius < 2.0 ? sign : 0.0, 0.02);
      EXPECT_EQ(inside[i], radius < 2.0);
    }
  }
}

TEST(WindingNumber, ErrorIsHeldToTheAccuracyAskedFor) {
  const TriangleMesh mesh = test::seabed(80, 60);
  const Scene scene({mesh});
  const std::vector<Vec3> points = random_points(150, 60.0, {40.0, 30.0, 0.0}, 2);
  const PointMatrix matrix = matrix_of(points);
  double coarsest = 0.0;
  for (const double accuracy : {1.0, 0.1, 0.01, 1e-3}) {
    const auto numbers = scene.winding_number(view(matrix), {accuracy});
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      double seen = 0.0;  // Σ area / (4π distance²), which the bound is a part of
      for (Index t = 0; t < mesh.triangle_count(); ++t) {
        const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        seen += 0.5 * mesh.area_vector(t).norm() / (middle - points[i]).squaredNorm();
      }
      const double error = std::abs(numbers[i] - exact_winding_number(mesh, points[i]));
      EXPECT_LE(error, accuracy * seen / (4.0 * std::numbers::pi) + 1e-12);
      worst = std::max(worst, error);
    }
    if (accuracy == 1.0) coarsest = worst;
    if (accuracy == 1e-3) {
      EXPECT_LT(worst, 0.1 * coarsest);
    }
  }
  EXPECT_GT(coarsest, 1e-6) << "nothing was far, the expansion was not tried";
}

// With the second term the error falls with the fourth power of the distance, without it or with a
// wrong one with the third: twice as far, 16 times less instead of 8.
TEST(WindingNumber, SecondTermOfTheExpansionCounts) {
  const TriangleMesh mesh = head(test::sphere(4, 1.0), 1024);  // half of it
  const Scene scene({mesh});
  const auto worst_at = [&](double distance) {
    double worst = 0.0;
    for (const Vec3& way : random_points(50, 1.0, Vec3::Zero(), 7)) {
      const Vec3 q = distance * way.normalized();
      const PointMatrix one = matrix_of({q});
      const double found = scene.winding_number(view(one), {1e3})[0];
      worst = std::max(worst, std::abs(found - exact_winding_number(mesh, q)));
    }
    return worst;
  };
  EXPECT_GT(worst_at(20.0) / worst_at(40.0), 12.0);
}

TEST(WindingNumber, OverlappingBodiesAddUp) {
  const Scene scene({test::box({1, 1, 1}), test::box({1, 1, 1}, {1, 0, 0}),
                     turned_inside_out(test::box({1, 1, 1}, {9, 0, 0}))});
  const PointMatrix points =
      matrix_of({{0.5, 0.1, 0.2}, {-0.5, 0.1, 0.2}, {9.3, 0.1, 0.2}, {4, 0, 0}});
  const auto numbers = scene.winding_number(view(points));
  EXPECT_NEAR(numbers[0], 2.0, 0.02);
  EXPECT_NEAR(numbers[1], 1.0, 0.02);
  EXPECT_NEAR(numbers[2], -1.0, 0.02);
  EXPECT_NEAR(numbers[3], 0.0, 0.02);
  EXPECT_EQ(scene.contains(view(points)), (std::vector<bool>{true, true, true, false}));
}

TEST(WindingNumber, HolesAreFilmedOver) {
  const TriangleMesh whole = test::sphere(4, 1.0);
  const Scene scene({head(whole, whole.triangle_count() * 15 / 16)});
  const PointMatrix points = matrix_of({{0.1, -0.2, 0.3}, {3, 0, 0}});
  EXPECT_EQ(scene.contains(view(points)), (std::vector<bool>{true, false}));
  const double missing = scene.winding_number(view(points))[0];
  EXPECT_GT(missing, 0.8);
  EXPECT_LT(missing, 0.99);
}

TEST(Contains, PointsOnTheSurface) {
  const Scene scene({test::box({1, 2, 3})});
  const PointMatrix points =
      matrix_of({{1, 0.3, 0.2}, {1, 2, 0.4}, {1, 2, 3}, {1, 2.5, 0}, {1.0 + 1e-12, 0.3, 0.2}});
  EXPECT_EQ(scene.contains(view(points)), (std::vector<bool>{true, true, true, false, false}));
  EXPECT_NEAR(scene.winding_number(view(points))[0], 0.5, 1e-12);
}

TEST(Contains, SurveyCoordinates) {
  const Vec3 offset(512345.25, 7212345.5, -52.0);
  const Scene scene({test::sphere(4, 0.5, offset)});
  const std::vector<Vec3> points = random_points(500, 1.0, offset, 5);
  const PointMatrix matrix = matrix_of(points);
  const auto inside = scene.contains(view(matrix));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double radius = (points[i] - offset).norm();
    if (std::abs(radius - 0.5) < 0.01) continue;
    EXPECT_EQ(inside[i], radius < 0.5);
  }
}

TEST(WindingNumber, OneThreadEqualsEight) {
  const TriangleMesh mesh = test::sphere(5, 2.0);
  const PointMatrix points = matrix_of(random_points(1000, 4.0, Vec3::Zero(), 6));
  const Scene one({mesh}, 1), eight({mesh}, 8);
  EXPECT_EQ(one.winding_number(view(points), {}, 1), eight.winding_number(view(points), {}, 8));
}

TEST(WindingNumber, NothingIsNowhere) {
  const Scene scene({TriangleMesh()});
  const PointMatrix points = matrix_of({{0, 0, 0}});
  EXPECT_EQ(scene.winding_number(view(points)), std::vector<double>{0.0});
  EXPECT_EQ(scene.contains(view(points)), std::vector<bool>{false});
}

TEST(WindingNumber, MemoryCountsClustersOnceMade) {
  const Scene scene({test::sphere(5, 2.0)});
  const std::size_t before = scene.memory();
  const PointMatrix points = matrix_of({{0, 0, 0}});
  scene.contains(view(points));
  EXPECT_GT(scene.memory(), before);
}

TEST(WindingNumber, Refusals) {
  const Scene scene({test::box({1, 1, 1})});
  const PointMatrix points = matrix_of({{0, 0, 0}});
  const PointMatrix bad = matrix_of({{0, 0, 0}, {0, std::nan(""), 0}});
  EXPECT_THROW(scene.winding_number(view(bad)), std::invalid_argument);
  EXPECT_THROW(scene.contains(view(bad)), std::invalid_argument);
  EXPECT_THROW(scene.winding_number(view(points), {0.0}), std::invalid_argument);
  EXPECT_THROW(scene.winding_number(view(points), {std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
