// SPDX-License-Identifier: BSD-3-Clause
// What a path must keep when the world is moved, scaled, or walked backwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bathyal/base/random.hpp"
#include "bottoms.hpp"

namespace bathyal {
namespace {

using test::down;
using test::grid;
using test::piecewise_constant;
using test::scene_of;

double hills(double x, double y) { return std::sin(1.3 * x) * std::cos(0.9 * y) - 4.0; }

TriangleMesh bottom() { return grid(hills, 0, 6, 20, 0, 6, 20); }

const Aims kTour = down({{0.63, 0.71}, {5.12, 1.33}, {4.21, 5.24}, {1.17, 4.41}});

TriangleMesh moved(const TriangleMesh& mesh, const Pose& pose, double scale = 1.0) {
  PointMatrix vertices(mesh.vertex_count(), 3);
  for (Index i = 0; i < vertices.rows(); ++i) {
    vertices.row(i) = pose * Vec3(scale * mesh.vertices().row(i).transpose());
  }
  return {vertices, mesh.shared_triangles()};
}

Aims moved(const Aims& aims, const Pose& pose, double scale = 1.0) {
  Aims result(aims.rows(), 6);
  for (Index i = 0; i < aims.rows(); ++i) {
    result.row(i) << (pose * Vec3(scale * aims.row(i).head<3>().transpose())).transpose(),
        (pose.linear() * aims.row(i).tail<3>().transpose()).transpose();
  }
  return result;
}

TEST(Properties, ATurnAboutZAndAShiftMoveThePathWithThem) {
  RandomStream random(11);
  for (int k = 0; k < 20; ++k) {
    const double reach = k % 2 == 0 ? 10.0 : 1e6;
    const Pose pose =
        Eigen::Translation3d(random.uniform(-reach, reach), random.uniform(-reach, reach), -50.0) *
        Eigen::AngleAxisd(random.uniform(-3, 3), Vec3::UnitZ());
    const ToolPath here = plan_toolpath(scene_of(bottom()), kTour);
    const ToolPath there = plan_toolpath(scene_of(moved(bottom(), pose)), moved(kTour, pose));
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t j = 0; j < here.size(); ++j) {
      EXPECT_LT((pose * here.position[j] - there.position[j]).norm(), 1e-6);
      EXPECT_LT((pose.linear() * here.frame(j).linear() - there.frame(j).linear()).norm(), 1e-5);
      EXPECT_NEAR(here.time[j], there.time[j], 1e-4);
      EXPECT_NEAR(here.normal_std[j], there.normal_std[j], 1e-6);
    }
  }
}

TEST(Properties, ScaleScalesThePath) {
  for (const double scale : {0.1, 30.0}) {
    ToolPathOptions small, large;
    large.speed *= scale;
    large.acceleration *= scale;
    large.blend_length *= scale;
    small.step = 0.07;
    large.step = 0.07 * scale;
    const ToolPath a = plan_toolpath(scene_of(bottom()), kTour, small);
    const ToolPath b = plan_toolpath(scene_of(moved(bottom(), Pose::Identity(), scale)),
                                     moved(kTour, Pose::Identity(), scale), large);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t j = 0; j < a.size(); ++j) {
      EXPECT_LT((scale * a.position[j] - b.position[j]).norm(), 1e-9 * scale);
      EXPECT_LT((a.approach[j] - b.approach[j]).norm(), 1e-8);
      EXPECT_NEAR(a.time[j], b.time[j], 1e-5);
    }
  }
}

TEST(Properties, ReversedAimsReverseThePath) {
  Aims back = kTour.colwise().reverse();
  ToolPathOptions blended;
  blended.blend_length = 0.3;  // turns overlap
  for (const ToolPathOptions& options : {piecewise_constant(), blended}) {
    const ToolPath there = plan_toolpath(scene_of(bottom()), kTour, options);
    const ToolPath again = plan_toolpath(scene_of(bottom()), back, options);
    ASSERT_EQ(there.size(), again.size());
    for (std::size_t j = 0; j < there.size(); ++j) {
      const std::size_t k = there.size() - 1 - j;
      EXPECT_LT((there.position[j] - again.position[k]).norm(), 1e-9);
      EXPECT_LT((there.approach[j] - again.approach[k]).norm(), 1e-6);
      EXPECT_LT((there.travel[j] + again.travel[k]).norm(), 1e-6);
      EXPECT_NEAR(there.time[j], there.time.back() - again.time[k], 1e-6 * there.time.back());
    }
  }
}

TEST(Properties, OneThreadEqualsEight) {
  ToolPathOptions one, eight;
  one.targets.num_threads = 1;
  eight.targets.num_threads = 8;
  for (ToolPathOptions* options : {&one, &eight}) {
    options->normal_radius = 0.5;
    options->tool_radius = 0.1;
    options->tool_length = 0.5;
    options->standoff = 0.05;
  }
  std::vector<Eigen::Vector2d> at;
  for (int k = 0; k < 300; ++k)
    at.emplace_back(3 + 2.5 * std::sin(k * 0.7), 3 + 2.5 * std::cos(k * 1.1));
  const Scene scene = scene_of(bottom());
  const ToolPath a = plan_toolpath(scene, down(at), one), b = plan_toolpath(scene, down(at), eight);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.quaternion, b.quaternion);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.normal_std, b.normal_std);
  EXPECT_EQ(a.contact, b.contact);
}

TEST(Properties, EverySampleLiesOnItsFacetAndInTheUprightPlaneOfItsPair) {
  ToolPathOptions options;
  options.step = 0.05;
  const Scene scene = scene_of(bottom());
  const ToolPath path = plan_toolpath(scene, kTour, options);
  const TriangleMesh& mesh = scene.meshes()[0];
  for (std::size_t j = 0; j < path.size(); ++j) {
    const Vec3 normal = outward_normal(mesh, path.triangle[j]);
    EXPECT_NEAR(normal.dot(path.surface[j] - mesh.corner(path.triangle[j], 0)), 0.0, 1e-9);
    const auto i = static_cast<std::size_t>(path.segment[j]);
    const Vec3 ab = path.targets.point[i + 1] - path.targets.point[i];
    EXPECT_NEAR(ab.cross(Vec3::UnitZ()).normalized().dot(path.surface[j] - path.targets.point[i]),
                0, 1e-9);
    if (j > 0) {
      EXPECT_LE((path.surface[j] - path.surface[j - 1]).norm(), 0.05 + 1e-9);
    }
  }
  for (const Vec3& target : path.targets.point) {
    EXPECT_NE(std::find(path.surface.begin(), path.surface.end(), target), path.surface.end())
        << "the path goes through every target exactly";
  }
}

}  // namespace
}  // namespace bathyal
