// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/greedy.hpp"

#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/geometry/mesh_report.hpp"

namespace bathyal {
namespace {

const Vec3 kUtm(620152, 7246504, -52);

/// A 42 × 42 grid 0.2 m apart with low waves; 3 362 triangles would cover it. `shake` moves each
/// sounding in plan, as a share of that.
PointMatrix waves(double shake, const Vec3& offset) {
  PointMatrix points(42 * 42, 3);
  RandomStream draw(1);
  for (int i = 0; i < 42 * 42; ++i) {
    const double x = 0.2 * (i % 42) + 0.2 * shake * draw.uniform(-1, 1);
    const double y = 0.2 * static_cast<double>(i / 42) + 0.2 * shake * draw.uniform(-1, 1);
    points.row(i) = Vec3(x, y, 0.3 * std::sin(x)) + offset;
  }
  return points;
}

Greedy run(const PointMatrix& points, const GreedyOptions& options = {}) {
  return greedy(Points(points).view(), options);
}

MeshReport report(const PointMatrix& points, const Greedy& result) {
  return mesh_report(TriangleMesh(points, result.triangles));
}

/// PCL as its tutorial calls it, coordinates as given, normals straight up.
std::size_t count_of_raw_pcl(const PointMatrix& points) {
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud(new pcl::PointCloud<pcl::PointNormal>);
  for (Index i = 0; i < points.rows(); ++i) {
    pcl::PointNormal p;
    p.getVector3fMap() = points.row(i).transpose().cast<float>();
    p.getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
    cloud->push_back(p);
  }
  pcl::search::KdTree<pcl::PointNormal>::Ptr tree(new pcl::search::KdTree<pcl::PointNormal>);
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> method;
  method.setSearchRadius(1.2);
  method.setMu(2.5);
  method.setMaximumNearestNeighbors(100);
  method.setMaximumSurfaceAngle(std::numbers::pi / 4);
  method.setMinimumAngle(std::numbers::pi / 18);
  method.setMaximumAngle(2 * std::numbers::pi / 3);
  method.setInputCloud(cloud);
  method.setSearchMethod(tree);
  std::vector<pcl::Vertices> polygons;
  method.reconstruct(polygons);
  return polygons.size();
}

TEST(Greedy, KeepsAtUtmCoordinatesWhatItHasAtTheOrigin) {
  const PointMatrix here = waves(0.2, Vec3::Zero());
  const Greedy near = run(here);
  EXPECT_GT(near.triangles.rows(), 3300);
  for (const Vec3& offset : {kUtm, Vec3(1e7, -1e7, 6000)}) {
    const Greedy far = run(waves(0.2, offset));
    EXPECT_EQ(far.triangles.rows(), near.triangles.rows());
    EXPECT_EQ(far.merged_points, 0);
    EXPECT_NEAR(far.search_radius, near.search_radius, 1e-6);
  }
  const std::size_t raw_near = count_of_raw_pcl(here);
  const std::size_t raw_far = count_of_raw_pcl(waves(0.2, kUtm));
  RecordProperty("raw_pcl_at_origin", static_cast<int>(raw_near));
  RecordProperty("raw_pcl_at_utm", static_cast<int>(raw_far));
  EXPECT_GT(raw_near, 3300U);
  EXPECT_LT(raw_far, raw_near / 2);  // why this function exists
}

TEST(Greedy, TurnsAHeightFieldUpAndCoversIt) {
  for (const double shake : {0.0, 0.2}) {
    const PointMatrix points = waves(shake, kUtm);
    const MeshReport r = report(points, run(points));
    EXPECT_EQ(r.inverted_triangles, 0) << shake;
    EXPECT_EQ(r.zero_area_triangles, 0);
    EXPECT_EQ(r.duplicate_triangles, 0);
    EXPECT_EQ(r.unused_vertices, 0);
    EXPECT_EQ(r.components, 1);
    EXPECT_EQ(r.boundary_loops.size(), 1U);
    EXPECT_NEAR(r.planar_area, 8.2 * 8.2, 0.7);
  }
}

TEST(Greedy, TakesASphereWhichNoHeightFieldCan) {
  PointMatrix points(3000, 3);
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < 3000; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 3000.0, r = std::sqrt(1.0 - z * z);
    points.row(i) = Vec3(r * std::cos(golden * i), r * std::sin(golden * i), z);
  }
  const Greedy result = run(points);
  const TriangleMesh mesh(points, result.triangles);
  const MeshReport r = mesh_report(mesh);
  EXPECT_NEAR(r.area, 4 * std::numbers::pi, 0.1);
  EXPECT_NEAR(r.area_share_inverted, 0.5, 0.01);
  EXPECT_EQ(r.inconsistent_edges, 0);
  Index outward = 0;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    outward += mesh.area_vector(t).dot(mesh.corner(t, 0)) > 0.0;
  }
  // PCL leaves a few triangles by themselves; those can only be turned up.
  EXPECT_GT(outward, 0.998 * static_cast<double>(mesh.triangle_count()));
}

std::string refusal(const PointMatrix& points) {
  try {
    run(points);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Greedy, RefusesWhatPclCrashesOn) {
  PointMatrix points(0, 3);
  EXPECT_NE(refusal(points).find("got 0 places"), std::string::npos);
  for (const Index count : {1, 2, 50}) {
    points = PointMatrix::Constant(count, 3, 7e6);
    EXPECT_NE(refusal(points).find("got 1 places"), std::string::npos);
  }
  for (const int count : {2, 3, 100}) {
    points.resize(count, 3);
    for (int i = 0; i < count; ++i) points.row(i) = kUtm + 0.7 * i * Vec3(1, 2, 0.5);
    EXPECT_NE(refusal(points).find("`points`"), std::string::npos) << count;
  }
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    points = waves(0.2, kUtm);
    points(77, 1) = bad;
    EXPECT_NE(refusal(points).find("row 77"), std::string::npos);
  }
}

TEST(Greedy, TakesVeryFewPointsAndDuplicates) {
  PointMatrix three(3, 3);
  three << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  EXPECT_EQ(run(three).triangles.rows(), 1);
  PointMatrix doubled(2 * 42 * 42, 3);
  doubled << waves(0.2, kUtm), waves(0.2, kUtm);
  const Greedy once = run(waves(0.2, kUtm)), twice = run(doubled);
  EXPECT_EQ(twice.merged_points, 42 * 42);
  EXPECT_EQ(twice.triangles.view(), once.triangles.view());
}

TEST(Greedy, HonoursItsParameters) {
  const PointMatrix points = waves(0.2, Vec3::Zero());
  EXPECT_LT(run(points, {.search_radius = 0.18}).triangles.rows(), 2000);
  EXPECT_LT(run(points, {.max_surface_angle = 0.02}).triangles.rows(), 2500);
  EXPECT_THROW(run(points, {.search_radius = -1.0}), std::invalid_argument);
  EXPECT_THROW(run(points, {.mu = 0.0}), std::invalid_argument);
  EXPECT_THROW(run(points, {.max_neighbours = 2}), std::invalid_argument);
  EXPECT_THROW(run(points, {.max_surface_angle = 4.0}), std::invalid_argument);
  EXPECT_THROW(run(points, {.min_angle = 2.5}), std::invalid_argument);
  EXPECT_THROW(run(points, {.max_angle = 0.0}), std::invalid_argument);
  EXPECT_THROW(run(points, {.normal_neighbours = 2}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
