// SPDX-License-Identifier: BSD-3-Clause
// The 2.5-D Delaunay triangulation against PCL's greedy projection triangulation with PCL's own
// normals, as Filaretov, Konoplin, Konoplin (2018) use it: same soundings; PCL's runs on one
// thread.
#include <pcl/features/normal_3d.h>
#include <pcl/pcl_config.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/terrain/delaunay.hpp"

namespace {

using namespace bathyal;
using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Tree = pcl::search::KdTree<pcl::PointNormal>;

constexpr Index kRows = 1000;
constexpr Index kCount = kRows * kRows;
constexpr double kSide = 1000.0;  // [m], so that the spacing is 1 m
constexpr int kNormalNeighbours = 20;
constexpr double kRadius = 3.0;  // [m]

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median_seconds(const std::function<void()>& work) {
  std::array<double, 5> times{};
  for (double& time : times) time = seconds(work);
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

double plan_area(PointView points, TriangleView triangles) {
  double area = 0.0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = points.row(triangles(t, 0));
    const Vec3 b = points.row(triangles(t, 1));
    const Vec3 c = points.row(triangles(t, 2));
    area += 0.5 * std::abs((b - a).cross(c - a).z());
  }
  return area;
}

TriangleMatrix to_matrix(const std::vector<pcl::Vertices>& polygons) {
  TriangleMatrix triangles(static_cast<Index>(polygons.size()), 3);
  for (Index t = 0; t < triangles.rows(); ++t) {
    const auto& corners = polygons[static_cast<std::size_t>(t)].vertices;
    triangles.row(t) << corners[0], corners[1], corners[2];
  }
  return triangles;
}

}  // namespace

int main() {
  PointMatrix soundings(kCount, 3);
  RandomStream random(1);
  const Cloud::Ptr cloud(new Cloud);
  for (Index i = 0; i < kCount; ++i) {
    const double x = static_cast<double>(i % kRows) + random.uniform(0.2, 0.8);
    const double y = static_cast<double>(i / kRows) + random.uniform(0.2, 0.8);
    soundings.row(i) << x, y, 0.5 * std::sin(0.1 * x) * std::cos(0.07 * y);
    pcl::PointNormal p;
    p.getVector3fMap() = soundings.row(i).transpose().cast<float>();
    cloud->push_back(p);
  }
  const PointView points(soundings.data(), kCount, 3);
  Delaunay ours;
  const std::array<double, 2> mine{
      median_seconds([&] { ours = delaunay(points, {.num_threads = 1}); }),
      median_seconds([&] { ours = delaunay(points, {.num_threads = 2}); })};

  const Tree::Ptr tree(new Tree);
  std::vector<pcl::Vertices> polygons;
  const double normals = seconds([&] {
    tree->setInputCloud(cloud);
    pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> estimate;
    estimate.setInputCloud(cloud);
    estimate.setSearchMethod(tree);
    estimate.setKSearch(kNormalNeighbours);
    estimate.compute(*cloud);
  });
  const double surface = seconds([&] {
    pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
    greedy.setSearchRadius(kRadius);
    greedy.setMu(2.5);
    greedy.setMaximumNearestNeighbors(100);
    greedy.setMaximumSurfaceAngle(std::numbers::pi / 4);
    greedy.setMinimumAngle(std::numbers::pi / 18);
    greedy.setMaximumAngle(2 * std::numbers::pi / 3);
    greedy.setNormalConsistency(false);
    greedy.setInputCloud(cloud);
    greedy.setSearchMethod(tree);
    greedy.reconstruct(polygons);
  });
  const double area = plan_area(points, ours.triangles.view());
  const double peer_area = plan_area(points, Triangles(to_matrix(polygons)).view());
  if (std::abs(area / (kSide * kSide) - 1.0) > 0.01 || peer_area < 0.8 * area) {
    std::fprintf(stderr, "the surfaces do not cover the same ground: %g and %g m2\n", area,
                 peer_area);
    return 1;
  }
  std::printf("## 2.5-D Delaunay triangulation against PCL %s's greedy projection\n\n",
              PCL_VERSION_PRETTY);
  std::printf(
      "`build/bench/benchmarks/cpp/bench_greedy`: %td soundings, one in each square metre, on "
      "gentle waves, one thread each, "
      "ours "
      "the median of 5 runs, PCL's once. Search radius %g m, mu 2.5, 100 neighbours, surface angle "
      "45°, "
      "angles 10° to 120°, normals by %d neighbours. In plan ours covers %.1f %% of the ground and "
      "PCL's "
      "triangles add up to %.1f %%.\n\n",
      points.rows(), kRadius, kNormalNeighbours, 100 * area / (kSide * kSide),
      100 * peer_area / (kSide * kSide));
  std::printf(
      "| our threads | PCL / ours | PCL without normals / ours | ours [s] | PCL greedy [s] | PCL "
      "normals [s] |\n|---|---|---|---|---|---|\n");
  for (int i = 0; i < 2; ++i) {
    std::printf("| %d | %.0f | %.0f | %.3f | %.1f | %.1f |\n", i + 1, (normals + surface) / mine[i],
                surface / mine[i], mine[i], surface, normals);
  }
}
