// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/greedy.hpp"

#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/geometry/orient.hpp"
#include "bathyal/terrain/sheets.hpp"
#include "bathyal/terrain/triangulate.hpp"

namespace bathyal {
namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Tree = pcl::search::KdTree<pcl::PointNormal>;

constexpr double kRadiusOfSpacing = 6.0;
constexpr double kShake = 1e-3;  // of the spacing
constexpr double kFlat = 1e-12;  // height over longest edge below which a triangle has no area

/// The cloud as PCL takes it, and the row that each of its points came from.
struct Input {
  Cloud::Ptr cloud{new Cloud};
  std::vector<std::int32_t> row;
};

/// Points in float32 about the local origin, each place once.
Input to_pcl(PointView points) {
  const Vec3 origin = local_origin(points);
  const auto at = [&](std::int32_t i) {
    const Eigen::Vector3f p = (points.row(i).transpose() - origin).cast<float>();
    return std::array{p.x(), p.y(), p.z()};
  };
  std::vector<std::int32_t> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return at(a) < at(b) || (at(a) == at(b) && a < b);
  });
  const auto last = std::unique(order.begin(), order.end(),
                                [&](std::int32_t a, std::int32_t b) { return at(a) == at(b); });
  order.erase(last, order.end());
  std::sort(order.begin(), order.end());

  Input input;
  input.row = std::move(order);
  for (const std::int32_t i : input.row) {
    const auto [x, y, z] = at(i);
    pcl::PointNormal p;
    p.x = x, p.y = y, p.z = z;
    input.cloud->push_back(p);
  }
  return input;
}

void check_spans_a_surface(const Cloud& cloud) {
  Vec3 mean = Vec3::Zero();
  for (const auto& p : cloud) mean += p.getVector3fMap().cast<double>();
  mean /= static_cast<double>(std::max<std::size_t>(1, cloud.size()));
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const auto& p : cloud) {
    const Vec3 d = p.getVector3fMap().cast<double>() - mean;
    moment += d * d.transpose();
  }
  const Vec3 values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment).eigenvalues();
  // 1e-6 across for 1 along, squared: less is a line in float32.
  if (cloud.size() < 3 || !(values[1] > 1e-12 * values[2])) {
    throw_argument("points", "three points or more at different places and not on one line",
                   std::to_string(cloud.size()) + (cloud.size() < 3 ? " places" : " on one line"));
  }
}

double median_nearest_distance(const Cloud& cloud, Tree& tree) {
  std::vector<float> nearest(cloud.size());
  pcl::Indices found;
  std::vector<float> squared;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    tree.nearestKSearch(cloud, static_cast<int>(i), 2, found, squared);
    nearest[i] = squared.back();
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return std::sqrt(static_cast<double>(*middle));
}

/// Moves PCL's copy of the points by a thousandth of their spacing. On a grid PCL's choices among
/// equally good neighbours contradict each other and leave holes; off it they do not.
void shake(Input& input, double spacing) {
  for (std::size_t i = 0; i < input.cloud->size(); ++i) {
    RandomStream draw(0, static_cast<std::uint64_t>(input.row[i]));
    for (float& coordinate : (*input.cloud)[i].data) {
      coordinate += static_cast<float>(kShake * spacing * draw.uniform(-1.0, 1.0));
    }
    (*input.cloud)[i].data[3] = 1.0F;
  }
}

/// The direction of least scatter of each point's neighbours, z up. In double about the point:
/// PCL's own estimate loses small neighbourhoods in float32.
void estimate_normals(Cloud& cloud, Tree& tree, int neighbours) {
  pcl::Indices found;
  std::vector<float> squared;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    tree.nearestKSearch(cloud, static_cast<int>(i), neighbours, found, squared);
    const Vec3 centre = cloud[i].getVector3fMap().cast<double>();
    Vec3 mean = Vec3::Zero();
    for (const int j : found)
      mean += cloud[static_cast<std::size_t>(j)].getVector3fMap().cast<double>() - centre;
    mean /= static_cast<double>(found.size());
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    for (const int j : found) {
      const Vec3 d =
          cloud[static_cast<std::size_t>(j)].getVector3fMap().cast<double>() - centre - mean;
      moment += d * d.transpose();
    }
    Vec3 normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment).eigenvectors().col(0);
    if (normal.z() < 0.0) normal = -normal;
    cloud[i].getNormalVector3fMap() = normal.cast<float>();
  }
}

/// PCL prints to the terminal when it enlarges neighbourhoods; a library does not.
class QuietPcl {
 public:
  QuietPcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL before_ = pcl::console::getVerbosityLevel();
};

std::vector<pcl::Vertices> run_pcl(const Input& input, const Tree::Ptr& tree,
                                   const GreedyOptions& options, double search_radius) {
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> method;
  method.setSearchRadius(search_radius);
  method.setMu(options.mu);
  method.setMaximumNearestNeighbors(
      std::min(options.max_neighbours, static_cast<int>(input.cloud->size())));
  method.setMaximumSurfaceAngle(options.max_surface_angle);
  method.setMinimumAngle(options.min_angle);
  method.setMaximumAngle(options.max_angle);
  method.setNormalConsistency(options.normal_consistency);
  method.setInputCloud(input.cloud);
  method.setSearchMethod(tree);
  std::vector<pcl::Vertices> polygons;
  const QuietPcl quiet;
  method.reconstruct(polygons);
  return polygons;
}

/// PCL's polygons as rows of the caller's points, without repeated ones and those without area.
TriangleMatrix keep_sound(const std::vector<pcl::Vertices>& polygons,
                          const std::vector<std::int32_t>& row, PointView points) {
  using Corners = std::array<std::int32_t, 3>;
  std::vector<Corners> kept;
  for (const pcl::Vertices& polygon : polygons) {
    if (polygon.vertices.size() != 3) continue;
    Corners corners;
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = row[static_cast<std::size_t>(polygon.vertices[c])];
    }
    const Vec3 a = points.row(corners[0]), b = points.row(corners[1]), c = points.row(corners[2]);
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if ((b - a).cross(c - a).norm() > kFlat * longest) kept.push_back(corners);
  }
  const auto sorted = [](Corners corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::sort(kept.begin(), kept.end(), [&](const Corners& a, const Corners& b) {
    return std::pair(sorted(a), a) < std::pair(sorted(b), b);
  });
  kept.erase(
      std::unique(kept.begin(), kept.end(),
                  [&](const Corners& a, const Corners& b) { return sorted(a) == sorted(b); }),
      kept.end());
  TriangleMatrix triangles(static_cast<Index>(kept.size()), 3);
  for (std::size_t t = 0; t < kept.size(); ++t) {
    for (int c = 0; c < 3; ++c)
      triangles(static_cast<Index>(t), c) = kept[t][static_cast<std::size_t>(c)];
  }
  return triangles;
}

/// Turns every triangle up: the triangles of a height field.
void turn_up(PointView points, TriangleMatrix& triangles) {
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = points.row(triangles(t, 0));
    const Vec3 u = points.row(triangles(t, 1)).transpose() - a;
    const Vec3 v = points.row(triangles(t, 2)).transpose() - a;
    if (u.x() * v.y() - u.y() * v.x() < 0.0) std::swap(triangles(t, 1), triangles(t, 2));
  }
}

}  // namespace

void GreedyOptions::check() const {
  check_not_negative("search_radius", search_radius);
  check_positive("mu", mu);
  if (max_neighbours < 3)
    throw_argument("max_neighbours", "3 or more", std::to_string(max_neighbours));
  check_positive("max_surface_angle", max_surface_angle);
  check_range("max_surface_angle", max_surface_angle, 0.0, std::numbers::pi);
  check_positive("max_angle", max_angle);
  check_range("max_angle", max_angle, 0.0, std::numbers::pi);
  check_range("min_angle", min_angle, 0.0, max_angle);
  if (normal_neighbours < 3) {
    throw_argument("normal_neighbours", "3 or more", std::to_string(normal_neighbours));
  }
}

Greedy greedy(PointView points, const GreedyOptions& options) {
  options.check();
  check_clean("points", points);
  Input input = to_pcl(points);
  check_spans_a_surface(*input.cloud);

  const Tree::Ptr tree(new Tree);
  tree->setInputCloud(input.cloud);
  const double spacing = median_nearest_distance(*input.cloud, *tree);
  const double search_radius =
      options.search_radius > 0.0 ? options.search_radius : kRadiusOfSpacing * spacing;
  shake(input, spacing);
  tree->setInputCloud(input.cloud);
  estimate_normals(*input.cloud, *tree, options.normal_neighbours);
  TriangleMatrix triangles =
      keep_sound(run_pcl(input, tree, options, search_radius), input.row, points);
  if (find_sheets(points, {.num_threads = 1}).single_valued()) {
    turn_up(points, triangles);
  } else {
    orient(points, triangles);
  }
  return {std::move(triangles), search_radius,
          points.rows() - static_cast<Index>(input.row.size())};
}

}  // namespace bathyal
