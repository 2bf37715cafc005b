// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "bathyal/toolpath/internal/polygon.hpp"
#include "bottoms.hpp"

namespace bathyal {
namespace {

const Plane kFlat(Vec3::UnitZ(), -5.0);

Polygon polygon_of(const std::vector<Eigen::Vector2d>& corners) {
  Polygon polygon(static_cast<Index>(corners.size()), 2);
  for (std::size_t i = 0; i < corners.size(); ++i) polygon.row(static_cast<Index>(i)) = corners[i];
  return polygon;
}

const std::vector<Eigen::Vector2d> kRectangle{{0, 0}, {10, 0}, {10, 4}, {0, 4}};
/// A U, open at the top, 12 wide and 9 high, its arms 3 wide.
const std::vector<Eigen::Vector2d> kU{{0, 0}, {12, 0}, {12, 9}, {9, 9},
                                      {9, 3}, {3, 3},  {3, 9},  {0, 9}};

bool inside(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const auto& a = polygon[i];
    const auto& b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      in = !in;
    }
  }
  return in;
}

double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

double to_edges(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  double nearest = INFINITY;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    nearest = std::min(nearest, distance(p, polygon[i], polygon[(i + 1) % polygon.size()]));
  }
  return nearest;
}

double to_lines(const Aims& aims, const Eigen::Vector2d& p) {
  double nearest = INFINITY;
  for (Index i = 0; i + 1 < aims.rows(); i += 2) {
    nearest = std::min(nearest, distance(p, aims.row(i).head<2>(), aims.row(i + 1).head<2>()));
  }
  return nearest;
}

TEST(CoverPolygon, MowsARectangleToAndFro) {
  const Aims aims = cover_polygon(kFlat, polygon_of(kRectangle), 1.5);
  ASSERT_EQ(aims.rows(), 6);  // 4 m in three lines of 4/3 m
  const double y[] = {2.0 / 3, 2.0 / 3, 2.0, 2.0, 10.0 / 3, 10.0 / 3};
  const double x[] = {0, 10, 10, 0, 0, 10};
  for (Index i = 0; i < 6; ++i) {
    EXPECT_NEAR(aims(i, 0), x[i], 1e-12);
    EXPECT_NEAR(aims(i, 1), y[i], 1e-12);
    EXPECT_EQ(aims(i, 2), -4.0);
    EXPECT_EQ(Vec3(aims.row(i).tail<3>()), -Vec3::UnitZ());
  }
}

TEST(CoverPolygon, LeavesNothingOutOfAConcavePolygonInAnyDirection) {
  for (const double direction : {0.0, 0.4, std::numbers::pi / 2, 2.5, -1.0}) {
    for (const bool reverse : {false, true}) {
      auto corners = kU;
      if (reverse) std::reverse(corners.begin(), corners.end());
      const Aims aims = cover_polygon(kFlat, polygon_of(corners), 0.73, {direction, 0.0});
      const Eigen::Vector2d along(std::cos(direction), std::sin(direction));
      for (Index i = 0; i + 1 < aims.rows(); i += 2) {
        const Eigen::Vector2d a = aims.row(i).head<2>(), b = aims.row(i + 1).head<2>();
        EXPECT_NEAR(std::abs((b - a).normalized().dot(along)), 1.0, 1e-9);
        for (double t = 0.01; t < 1.0; t += 0.07) EXPECT_TRUE(inside(kU, a + t * (b - a)));
      }
      for (double px = 0.05; px < 12; px += 0.31) {
        for (double py = 0.05; py < 9; py += 0.31) {
          if (!inside(kU, {px, py})) continue;
          // Half the spacing across; by a slanted edge the line's end lies further along it.
          EXPECT_LE(to_lines(aims, {px, py}), 0.365 * (1 + 1.0 / 0.38) + 1e-9) << px << " " << py;
        }
      }
    }
  }
}

TEST(CoverPolygon, MowsOneArmOfAUBeforeTheOther) {
  const Aims aims = cover_polygon(kFlat, polygon_of(kU), 1.0);
  int changes = 0;
  for (Index i = 1; i < aims.rows(); ++i) {
    if (aims(i, 1) > 3 && aims(i - 1, 1) > 3 && (aims(i, 0) > 6) != (aims(i - 1, 0) > 6)) ++changes;
  }
  EXPECT_EQ(changes, 1) << "over from one arm to the other once";
  // Up the base, then on into the arm that begins nearest to where it ended, from the nearer side.
  EXPECT_NEAR((aims.row(5).head<2>() - Eigen::RowVector2d(12, 2.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((aims.row(6).head<2>() - Eigen::RowVector2d(12, 3.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((aims.row(18).head<2>() - Eigen::RowVector2d(3, 8.5)).norm(), 0.0, 1e-12);
}

TEST(CoverPolygon, KeepsTheMarginFromEveryEdge) {
  const std::vector<Eigen::Vector2d> slanted{{0, 0}, {9, 1}, {7, 6}, {4, 3}, {1, 7}};
  for (const double direction : {0.0, 0.7}) {
    const Aims aims = cover_polygon(kFlat, polygon_of(slanted), 0.4, {direction, 0.5});
    ASSERT_GT(aims.rows(), 8);
    double nearest = INFINITY;
    for (Index i = 0; i + 1 < aims.rows(); i += 2) {
      const Eigen::Vector2d a = aims.row(i).head<2>(), b = aims.row(i + 1).head<2>();
      for (double t = 0.0; t <= 1.0; t += 0.01) {
        nearest = std::min(nearest, to_edges(slanted, a + t * (b - a)));
      }
      EXPECT_NEAR(to_edges(slanted, a), 0.5, 1e-9) << "and no more than that";
    }
    EXPECT_NEAR(nearest, 0.5, 1e-9);
  }
  EXPECT_EQ(cover_polygon(kFlat, polygon_of(kRectangle), 1.0, {0.0, 2.5}).rows(), 0);
}

TEST(CoverPolygon, WorksFarFromTheOriginAndOverAMesh) {
  const Vec3 shift(620153, 7246506, -52);
  const Scene scene = test::scene_of(
      test::grid([](double x, double) { return 0.1 * x; }, -1, 11, 12, -1, 5, 6, shift));
  std::vector<Eigen::Vector2d> far;
  for (const auto& corner : kRectangle) far.push_back(corner + shift.head<2>());
  far.push_back(far.front());  // closed
  const Aims aims = cover_polygon(scene, polygon_of(far), 1.5);
  ASSERT_EQ(aims.rows(), 6);
  const ToolPath path = plan_toolpath(scene, aims);
  EXPECT_TRUE(path.warnings.empty());
  EXPECT_NEAR(path.arc_length.back(), 3 * 10 * std::sqrt(1.01) + 2 * 4.0 / 3, 1e-6);
}

TEST(CoverPolygon, RefusesWhatIsNoPolygon) {
  const auto refused = [](const std::vector<Eigen::Vector2d>& corners, double spacing = 1.0) {
    EXPECT_THROW(cover_polygon(kFlat, polygon_of(corners), spacing), std::invalid_argument);
  };
  refused({});
  refused({{0, 0}, {1, 0}});
  refused({{0, 0}, {1, 0}, {0, 0}, {0, 0}});
  refused({{0, 0}, {1, 0}, {2, 0}});
  refused({{0, 0}, {4, 4}, {4, 0}, {0, 3}});
  refused({{0, 0}, {1, 0}, {NAN, 1}});
  refused(kRectangle, 0.0);
  refused(kRectangle, -1.0);
  refused(kRectangle, 1e-9);
  EXPECT_THROW(cover_polygon(kFlat, polygon_of(kRectangle), 1.0, {NAN, 0.0}),
               std::invalid_argument);
  EXPECT_THROW(cover_polygon(kFlat, polygon_of(kRectangle), 1.0, {0.0, -1.0}),
               std::invalid_argument);
  EXPECT_THROW(cover_polygon(Plane(Vec3::UnitX(), 0.0), polygon_of(kRectangle), 1.0),
               std::invalid_argument);
}

TEST(Polygon, StretchesKeepTheMarginFromEveryEdge) {
  const auto corners = toolpath::corners_along(polygon_of(kU), kU[0], 0.0);
  const auto two = toolpath::stretches(corners, 6.0, 0.5);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_NEAR(two[0].low, 0.5, 1e-12);
  EXPECT_NEAR(two[0].high, 2.5, 1e-12);
  EXPECT_NEAR(two[1].low, 9.5, 1e-12);
  EXPECT_NEAR(two[1].high, 11.5, 1e-12);
  EXPECT_EQ(toolpath::stretches(corners, 1.5, 0.5).size(), 1U);
  EXPECT_TRUE(toolpath::stretches(corners, 6.0, 1.6).empty());
}

}  // namespace
}  // namespace bathyal
