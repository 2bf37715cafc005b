// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/flags.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bottoms.hpp"

namespace bathyal {
namespace {

using namespace toolpath;

using test::any;
using test::down;
using test::grid;
using test::scene_of;

/// A round trough (sign = 1) or ridge (−1) of radius 1 along y, 100° of it.
Scene trough(double sign) {
  const auto round = [sign](double x, double) { return -sign * std::sqrt(1.0 - x * x); };
  return scene_of(grid(round, -0.76, 0.76, 60, -2, 2, 8));
}

ToolPath stood_off(const Scene& scene, double standoff, Orientation orientation) {
  ToolPathOptions options;
  options.standoff = standoff;
  options.offset = Offset::kPlain;
  options.orientation = orientation;
  return plan_toolpath(scene, down({{-0.7, 0.1}, {0.7, 0.1}}, 3.0), options);
}

TEST(Crossing, AStandoffBeyondTheRadiusOfATroughTurnsBack) {
  for (const Orientation o : {Orientation::kBlended, Orientation::kPiecewiseConstant}) {
    const ToolPath beyond = stood_off(trough(1.0), 1.3, o);
    const auto flagged = std::count(beyond.crossing.begin(), beyond.crossing.end(), true);
    EXPECT_GT(flagged, static_cast<long>(0.9 * static_cast<double>(beyond.size())));
    EXPECT_FALSE(any(stood_off(trough(1.0), 0.8, Orientation::kBlended).crossing));
    EXPECT_FALSE(any(stood_off(trough(-1.0), 1.3, o).crossing)) << "a ridge spreads the path";
    EXPECT_FALSE(any(stood_off(trough(1.0), 0.0, o).crossing));
  }
}

TEST(Crossing, TheWholeLoopOverAValleyIsFlagged) {
  const auto valley = [](double x, double) { return std::abs(x); };
  const Scene scene = scene_of(grid(valley, -4, 4, 8, -2, 2, 2));
  ToolPathOptions options;
  options.standoff = 0.5;
  options.offset = Offset::kPlain;
  options.step = 0.02;
  const ToolPath path = plan_toolpath(scene, down({{-3, 0.3}, {3, 0.3}}), options);
  // The offset lines of 45° slopes cross above x = 0 where their feet are standoff · tan 45° away.
  for (std::size_t j = 0; j < path.size(); ++j) {
    const double s = std::abs(path.surface[j].x()) * std::sqrt(2.0);
    if (s < 0.5 - 0.03) {
      EXPECT_TRUE(path.crossing[j]) << s;
    }
    if (s > 0.5 + 0.03) {
      EXPECT_FALSE(path.crossing[j]) << s;
    }
  }
}

ToolPath with_tool(const Scene& scene, const Aims& aims, double radius, double length) {
  ToolPathOptions options;
  options.tool_radius = radius;
  options.tool_length = length;
  options.step = 0.05;
  return plan_toolpath(scene, aims, options);
}

TEST(Contact, FlatAndConvexGroundIsClearAndAPlaneAlways) {
  const Scene flat = scene_of(grid([](double, double) { return 0.0; }, -2, 2, 8, -2, 2, 8));
  const Aims aims = down({{-0.7, 0.1}, {0.7, 0.1}}, 9);
  EXPECT_FALSE(any(with_tool(flat, aims, 0.2, 1.0).contact));
  EXPECT_FALSE(any(with_tool(trough(-1.0), aims, 0.2, 1.0).contact));
  ToolPathOptions options;
  options.tool_radius = 0.2;
  options.tool_length = 1.0;
  EXPECT_FALSE(any(plan_toolpath(Plane(Vec3::UnitZ(), 0.0), aims, options).contact));
}

TEST(Contact, ARadiusBeyondThatOfATroughMeetsGround) {
  const Aims aims = down({{-0.3, 0.1}, {0.3, 0.1}}, 3);
  EXPECT_FALSE(any(with_tool(trough(1.0), aims, 0.5, 1.2).contact)) << "half the trough's radius";
  const ToolPath wide = with_tool(trough(1.0), aims, 1.3, 2.6);
  EXPECT_EQ(std::count(wide.contact.begin(), wide.contact.end(), true),
            static_cast<long>(wide.size()));
}

TEST(Contact, IsFlaggedWithinTheRadiusOfAWallAndOnlyThere) {
  // Flat ground with an upright wall at x = 2, 1 m high, seen by a tool of 0.3 m radius.
  const auto wall = [](double x, double) { return x > 1.0 ? 1.0 : 0.0; };
  TriangleMesh step = grid(wall, 0, 4, 4, -2, 2, 4);
  PointMatrix vertices = step.vertices();
  for (Index i = 0; i < vertices.rows(); ++i) {
    if (vertices(i, 0) == 2.0) vertices(i, 0) = 1.0 + 1e-9;
  }
  const Scene scene = scene_of(TriangleMesh(vertices, step.shared_triangles()));
  const ToolPath path = with_tool(scene, down({{0.1, 0.1}, {0.95, 0.1}}, 9), 0.3, 0.8);
  for (std::size_t j = 0; j < path.size(); ++j) {
    const double x = path.surface[j].x();
    if (x < 0.70) {
      EXPECT_FALSE(path.contact[j]) << x;
    }
    if (x > 0.72) {
      EXPECT_TRUE(path.contact[j]) << x;
    }
  }
}

TEST(Contact, TheBodysAxisAloneMeetsARoof) {
  const auto sheet = [](double z) {
    return grid([z](double, double) { return z; }, -2, 2, 4, -2, 2, 4);
  };
  const Scene scene({sheet(0.0), sheet(1.0)}, 1);
  const Aims aims = down({{-0.5, 0.1}, {0.5, 0.1}}, 0.5);
  EXPECT_FALSE(any(with_tool(scene, aims, 0.0, 0.9).contact));
  const ToolPath path = with_tool(scene, aims, 0.0, 1.1);
  EXPECT_TRUE(path.contact.front() && path.contact.back());
  EXPECT_FALSE(any(with_tool(scene, aims, 0.0, 0.0).contact)) << "no body";
}

}  // namespace
}  // namespace bathyal
