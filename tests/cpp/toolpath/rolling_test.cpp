// SPDX-License-Identifier: BSD-3-Clause
// The standoff kept as a ball of that radius rolls over the bottom.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/random.hpp"
#include "bathyal/toolpath/internal/frames.hpp"
#include "bottoms.hpp"

namespace bathyal {
namespace {

using test::any;
using test::down;
using test::grid;
using test::mesh_of;
using test::scene_of;

ToolPathOptions at(double standoff, Orientation orientation = Orientation::kBlended) {
  ToolPathOptions options;
  options.standoff = standoff;
  options.orientation = orientation;
  return options;
}

ToolPathOptions plainly(ToolPathOptions options) {
  options.offset = Offset::kPlain;
  return options;
}

double least_distance(const Scene& scene, const ToolPath& path) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : path.position) least = std::min(least, scene.nearest(p).distance);
  return least;
}

double most_distance(const Scene& scene, const ToolPath& path) {
  double most = 0.0;
  for (const Vec3& p : path.position) most = std::max(most, scene.nearest(p).distance);
  return most;
}

/// A surface that does not change along y, from its section (x, z), 4 m wide.
Scene extruded(const std::vector<Eigen::Vector2d>& section) {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const Eigen::Vector2d& p : section) {
    points.emplace_back(p.x(), -2.0, p.y());
    points.emplace_back(p.x(), 2.0, p.y());
  }
  for (std::int32_t k = 0; k + 1 < static_cast<std::int32_t>(section.size()); ++k) {
    triangles.push_back({2 * k, 2 * k + 2, 2 * k + 3});
    triangles.push_back({2 * k, 2 * k + 3, 2 * k + 1});
  }
  return scene_of(mesh_of(points, triangles));
}

/// A rough reef: facets of 1 cm, slopes of 37° in the root mean square.
Scene reef(std::uint64_t seed) {
  RandomStream random(seed);
  const int cells = 120;
  std::vector<double> heights(static_cast<std::size_t>((cells + 1) * (cells + 1)));
  for (double& h : heights) h = random.uniform(-0.0092, 0.0092);
  const auto height = [&](double x, double y) {
    const auto c = static_cast<std::size_t>(std::lround(x / 0.01));
    const auto r = static_cast<std::size_t>(std::lround(y / 0.01));
    return heights[r * (cells + 1) + c];
  };
  return scene_of(grid(height, 0, 1.2, cells, 0, 1.2, cells));
}

TEST(Rolling, OverAnEvenSlopeIsThePlainOffset) {
  for (const Vec3& slope : {Vec3(0, 0, 0), Vec3(0.3, 0.5, 0), Vec3(-1.0, 0.2, 0)}) {
    const auto even = [&](double x, double y) { return slope.x() * x + slope.y() * y; };
    const Scene scene = scene_of(grid(even, -3, 3, 6, -3, 3, 6));
    const Aims aims = down({{-1.7, 0.1}, {1.2, 0.3}, {1.0, 1.4}});
    for (const Orientation o : {Orientation::kBlended, Orientation::kPiecewiseConstant}) {
      ToolPathOptions options = at(0.2, o);
      options.step = 0.05;
      const ToolPath rolled = plan_toolpath(scene, aims, options);
      const ToolPath plain = plan_toolpath(scene, aims, plainly(options));
      EXPECT_FALSE(any(rolled.crossing));
      EXPECT_TRUE(rolled.warnings.empty());
      EXPECT_NEAR(rolled.arc_length.back(), plain.arc_length.back(), 1e-9);
      for (std::size_t j = 0; j < rolled.size(); ++j) {
        EXPECT_LT((rolled.approach[j] - plain.approach[0]).norm(), 1e-9);
        EXPECT_LT((rolled.position[j] - rolled.surface[j] - 0.2 * rolled.approach[j]).norm(), 1e-9);
      }
      for (const Vec3& target : plain.targets.point) {
        double nearest = 1.0;
        for (const Vec3& p : rolled.surface) nearest = std::min(nearest, (p - target).norm());
        EXPECT_LT(nearest, 1e-9) << "the targets themselves are touched";
      }
    }
  }
}

TEST(Rolling, OverAStepGoesRoundItsUpperEdgeAndAlongItsWall) {
  // Level at 1 m, down a wall at x = 0, level at 0.
  const Scene scene = extruded({{-2, 1}, {0, 1}, {0, 0}, {2, 0}});
  const double r = 0.25;
  const ToolPath path =
      plan_toolpath(scene, down({{-1.5, 0.1}, {1.5, 0.1}}), at(r, Orientation::kPiecewiseConstant));
  EXPECT_FALSE(any(path.crossing));
  EXPECT_NEAR(least_distance(scene, path), r, 1e-12);
  EXPECT_NEAR(most_distance(scene, path), r, 1e-12);
  int on_arc = 0;
  for (std::size_t j = 0; j < path.size(); ++j) {
    const Vec3& p = path.position[j];
    EXPECT_NEAR(p.y(), 0.1, 1e-12);
    if (p.x() > 1e-9 && p.z() > 1.0 + 1e-9) {
      ++on_arc;
      EXPECT_NEAR(std::hypot(p.x(), p.z() - 1.0), r, 1e-12) << "a quarter round the edge";
      EXPECT_LT((path.approach[j] - Vec3(p.x(), 0, p.z() - 1.0) / r).norm(), 1e-9);
    }
  }
  EXPECT_GE(on_arc, 15);
  // Level, quarter circle, wall down to r over the foot, level.
  const double expected = 1.5 + std::numbers::pi / 2 * r + (1.0 - r) + (1.5 - r);
  EXPECT_NEAR(path.arc_length.back(), expected, 1e-3 * r);
}

TEST(Rolling, OverANarrowGrooveStaysAtTheHeightWhereBothSidesTouch) {
  for (const double half : {0.1, 0.2}) {  // of the groove's width; 60° sides
    const double depth = half * std::tan(std::numbers::pi / 3), r = 0.3;
    const Scene scene = extruded({{-2, 0}, {-half, 0}, {0, -depth}, {half, 0}, {2, 0}});
    for (const Orientation o : {Orientation::kBlended, Orientation::kPiecewiseConstant}) {
      const ToolPath path = plan_toolpath(scene, down({{-1, 0.1}, {1, 0.1}}), at(r, o));
      EXPECT_FALSE(any(path.crossing));
      EXPECT_GE(least_distance(scene, path), r);
      double lowest = 1.0, lowest_touch = 1.0;
      for (std::size_t j = 0; j < path.size(); ++j) {
        lowest = std::min(lowest, path.position[j].z());
        lowest_touch = std::min(lowest_touch, path.surface[j].z());
      }
      // The ball rests on both edges: half < r · sin 60°, where it would touch the sides.
      EXPECT_NEAR(lowest, std::sqrt(r * r - half * half), 1e-9);
      EXPECT_GT(lowest_touch, -1e-9) << "the ball never reaches into the groove";
    }
  }
}

TEST(Rolling, InAWideGrooveTurnsBetweenItsSidesAtTheAnalyticHeight) {
  const double half = 1.0, r = 0.3;  // 45° sides
  const Scene scene = extruded({{-2, 0}, {-half, 0}, {0, -half}, {half, 0}, {2, 0}});
  ToolPathOptions options = at(r);
  options.blend_length = 0.1;
  const ToolPath path = plan_toolpath(scene, down({{-1.5, 0.1}, {1.5, 0.1}}), options);
  EXPECT_FALSE(any(path.crossing));
  double lowest = 1.0;
  for (std::size_t j = 0; j < path.size(); ++j) {
    lowest = std::min(lowest, path.position[j].z());
    if (j == 0) continue;
    const double moved = (path.position[j] - path.position[j - 1]).norm();
    const double turn = toolpath::turn_between(path, j - 1, j);
    // A blend of 90° turns at 1.5 · 90° / blend_length at most, the arcs at 1 / r.
    EXPECT_LE(turn, (1.5 * std::numbers::pi / 2 / 0.1 + 1.0 / r) * moved * 1.01 + 1e-9);
  }
  EXPECT_NEAR(lowest, -half + r * std::numbers::sqrt2, 1e-9);
}

TEST(Rolling, OverASineIsTheEnvelopeOfBallsOnItsSection) {
  std::vector<Eigen::Vector2d> section;
  for (int k = 0; k <= 300; ++k) section.emplace_back(0.02 * k, 0.2 * std::sin(3.0 * 0.02 * k));
  const Scene scene = extruded(section);
  const double r = 0.7;  // the tightest radius of the troughs is 1 / 1.8
  const ToolPath path = plan_toolpath(scene, down({{1, 0.1}, {5, 0.1}}), at(r));
  EXPECT_FALSE(any(path.crossing));
  for (std::size_t j = 0; j < path.size(); ++j) {
    const Vec3& p = path.position[j];
    // The lowest free centre above x: the highest of all balls about points of the section.
    double height = -1.0;
    for (std::size_t k = 0; k + 1 < section.size(); ++k) {
      for (int i = 0; i < 40; ++i) {
        const Eigen::Vector2d q = section[k] + i / 40.0 * (section[k + 1] - section[k]);
        const double off = q.x() - p.x();
        if (std::abs(off) < r) height = std::max(height, q.y() + std::sqrt(r * r - off * off));
      }
    }
    EXPECT_NEAR(p.z(), height, 2e-7) << p.x();
    EXPECT_GE(p.z(), height - 1e-12);
  }
}

TEST(Rolling, OverARoughReefNeitherCrossesNorComesNearer) {
  const double r = 0.1;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Scene scene = reef(seed);
    const Aims aims = down({{0.2, 0.31}, {1.0, 0.45}, {0.9, 0.95}, {0.25, 0.9}}, 1.0);
    for (const Orientation o : {Orientation::kBlended, Orientation::kPiecewiseConstant}) {
      const ToolPath rolled = plan_toolpath(scene, aims, at(r, o));
      EXPECT_TRUE(rolled.warnings.empty()) << rolled.warnings[0];
      EXPECT_FALSE(any(rolled.crossing));
      EXPECT_GE(least_distance(scene, rolled), r);
      EXPECT_LE(most_distance(scene, rolled), r + 1e-9);
      double steepest = 0.0;
      for (std::size_t j = 1; j < rolled.size(); ++j) {
        const Vec3 moved = rolled.position[j] - rolled.position[j - 1];
        EXPECT_LT(moved.norm(), 0.1 * r + 1e-9);
        steepest = std::max(steepest, toolpath::turn_between(rolled, j - 1, j));
      }
      if (o == Orientation::kBlended) {
        EXPECT_LT(steepest, 0.35) << "continuous";
      }
      const ToolPath plain = plan_toolpath(scene, aims, plainly(at(r, o)));
      if (o == Orientation::kPiecewiseConstant) {
        EXPECT_GT(std::count(plain.crossing.begin(), plain.crossing.end(), true),
                  static_cast<long>(plain.size() / 5));
      }
      EXPECT_LT(least_distance(scene, plain), 0.9 * r);
    }
  }
}

TEST(Rolling, GoesRoundAnOverhang) {
  // A shelf at 1 m whose edge hangs 0.6 m out over the level below.
  const Scene scene = extruded({{-2, 1}, {0.6, 1}, {0.6, 0.9}, {0, 0.8}, {0, 0}, {3, 0}});
  const double r = 0.1;
  const ToolPath path = plan_toolpath(scene, down({{-1.5, 0.1}, {2.0, 0.1}}), at(r));
  EXPECT_TRUE(path.warnings.empty()) << path.warnings[0];
  EXPECT_FALSE(any(path.crossing));
  EXPECT_GE(least_distance(scene, path), r);
  EXPECT_LE(most_distance(scene, path), r + 1e-9);
  bool beneath = false;
  for (const Vec3& p : path.position) beneath = beneath || (p.x() < 0.2 && p.z() < 0.75);
  EXPECT_TRUE(beneath) << "follows the sheet in beneath the shelf";
}

TEST(Rolling, DoesNotFeelTheFarSideOfAThinSlab) {
  const auto sheet = [](double z) {
    return grid([z](double, double) { return z; }, -2, 2, 8, -2, 2, 8);
  };
  const Scene one({sheet(0.0)}, 1), two({sheet(0.0), sheet(-1e-3)}, 1);
  const Aims aims = down({{-1.3, 0.1}, {1.2, 0.4}});
  EXPECT_EQ(plan_toolpath(one, aims, at(0.3)).position, plan_toolpath(two, aims, at(0.3)).position);
}

TEST(Rolling, DoesNotRollAcrossAGap) {
  const auto keep = [](int c, int) { return c < 4 || c > 6; };
  const Scene scene = scene_of(grid([](double x, double y) { return 0.1 * std::sin(9 * x + y); }, 0,
                                    6, 12, 0, 6, 12, Vec3::Zero(), keep));
  const ToolPath path = plan_toolpath(scene, down({{0.5, 3.1}, {5.5, 3.1}}), at(0.2));
  EXPECT_EQ(std::count(path.gap.begin(), path.gap.end(), true), 1);
  EXPECT_GE(least_distance(scene, path), 0.2);
  for (std::size_t j = 0; j < path.size(); ++j) {
    EXPECT_TRUE(path.surface[j].x() < 2.0 + 1e-9 || path.surface[j].x() > 3.5 - 1e-9);
  }
}

TEST(Rolling, OverATargetInAHoleAndOverOneTargetOnly) {
  const Scene scene = extruded({{-2, 0}, {-0.1, 0}, {-0.1, -1}, {0.1, -1}, {0.1, 0}, {2, 0}});
  const double r = 0.3;
  const ToolPath one = plan_toolpath(scene, down({{0, 0.1}}), at(r));
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(one.position[0].z(), std::sqrt(r * r - 0.01), 1e-9);
  const ToolPath path = plan_toolpath(scene, down({{0.02, 0.1}, {1, 0.1}}), at(r));
  EXPECT_TRUE(path.warnings.empty());
  EXPECT_FALSE(any(path.crossing));
  EXPECT_GE(least_distance(scene, path), r);
  EXPECT_NEAR(path.position[0].x(), 0.02, 1e-9) << "straight above the target it cannot reach";
}

TEST(Rolling, ReversedAimsReverseThePathAndThreadsDoNotMatter) {
  const Scene scene = reef(5);
  const Aims aims = down({{0.2, 0.31}, {1.0, 0.45}, {0.9, 0.95}}, 1.0);
  ToolPathOptions options = at(0.1);
  const ToolPath there = plan_toolpath(scene, aims, options);
  options.targets.num_threads = 8;
  const ToolPath again = plan_toolpath(scene, aims, options);
  EXPECT_EQ(there.position, again.position);
  EXPECT_EQ(there.quaternion, again.quaternion);
  EXPECT_EQ(there.time, again.time);
  const ToolPath back = plan_toolpath(scene, Aims(aims.colwise().reverse()), options);
  EXPECT_NEAR(there.arc_length.back(), back.arc_length.back(), 1e-3);
  for (const Vec3& p : there.position) {
    double nearest = 1.0;
    for (const Vec3& q : back.position) nearest = std::min(nearest, (p - q).norm());
    EXPECT_LT(nearest, 0.01);
  }
}

TEST(Rolling, FootprintNormalsTurnTheApproachAndNotThePosition) {
  const Scene scene = reef(6);
  const Aims aims = down({{0.2, 0.31}, {1.0, 0.45}}, 1.0);
  ToolPathOptions options = at(0.1, Orientation::kPiecewiseConstant);
  const ToolPath ball = plan_toolpath(scene, aims, options);
  options.normal_radius = 0.15;
  const ToolPath footprint = plan_toolpath(scene, aims, options);
  EXPECT_GE(least_distance(scene, footprint), 0.1);
  for (const Vec3& a : footprint.approach) EXPECT_GT(a.z(), 0.97) << "level on the whole";
  EXPECT_LT(std::min_element(ball.approach.begin(), ball.approach.end(),
                             [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); })
                ->z(),
            0.97);
}

}  // namespace
}  // namespace bathyal
