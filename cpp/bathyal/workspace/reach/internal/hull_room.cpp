// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/internal/hull_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>

#include "bathyal/base/parallel.hpp"

namespace bathyal::workspace {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kSupport = 40;
constexpr Index kRaster = 512;  ///< cells along the longer side of the raster, at most
constexpr double kCell = 0.05;  ///< and not smaller than this [m]

/// Vertices and edges of a mesh, each once by its place.
void collect(const TriangleMesh& mesh, std::vector<Vec3>& vertices,
             std::vector<std::pair<Index, Index>>& edges) {
  std::map<std::array<double, 3>, Index> known;
  std::vector<Index> number;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 at = mesh.vertices().row(v).transpose();
    const auto [entry, fresh] =
        known.try_emplace({at.x(), at.y(), at.z()}, static_cast<Index>(vertices.size()));
    if (fresh) vertices.push_back(at);
    number.push_back(entry->second);
  }
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Index a = number[static_cast<std::size_t>(mesh.triangles()(t, k))];
      const Index b = number[static_cast<std::size_t>(mesh.triangles()(t, (k + 1) % 3))];
      edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

bool overlap(const std::array<Vec3, 2>& edge, const Eigen::AlignedBox3d& box) {
  const Vec3 low = edge[0].cwiseMin(edge[1]);
  const Vec3 high = edge[0].cwiseMax(edge[1]);
  return (low.array() <= box.max().array()).all() && (high.array() >= box.min().array()).all();
}

/// Edges of a mesh that may come into the box, each at least once.
void collect_edges(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box,
                   std::vector<std::array<Vec3, 2>>& edges) {
  std::vector<std::pair<Index, Index>> found;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (!overlap({mesh.corner(t, k), mesh.corner(t, (k + 1) % 3)}, box)) continue;
      const Index a = mesh.triangles()(t, k);
      const Index b = mesh.triangles()(t, (k + 1) % 3);
      found.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (const auto& [a, b] : found) {
    edges.push_back({mesh.vertices().row(a).transpose(), mesh.vertices().row(b).transpose()});
  }
}

/// Each time the vertex that is farthest from those taken.
std::vector<Vec3> spread(const std::vector<Vec3>& vertices) {
  std::vector<Vec3> taken;
  std::vector<double> distance(vertices.size(), kInfinity);
  std::size_t next = 0;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    if (vertices[i].z() < vertices[next].z()) next = i;
  }
  while (taken.size() < std::min(kSupport, vertices.size())) {
    taken.push_back(vertices[next]);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      distance[i] = std::min(distance[i], (vertices[i] - taken.back()).norm());
    }
    next = static_cast<std::size_t>(std::ranges::max_element(distance) - distance.begin());
  }
  return taken;
}

/// Of a convex volume: its middle, corners and rims, in the frame that it is given in.
std::vector<Vec3> points_of(const KeepOut& keepout) {
  std::vector<Vec3> points;
  const double r = keepout.radius();
  const double h = 0.5 * keepout.length();
  const auto rim = [&](double z) {
    for (int k = 0; k < 16; ++k) {
      const double at = k * std::numbers::pi / 8.0;
      points.emplace_back(r * std::cos(at), r * std::sin(at), z);
    }
  };
  switch (keepout.kind()) {
    case KeepOutKind::kBox:
      for (int k = 0; k < 8; ++k) {
        const Vec3 sign((k & 1) - 0.5, ((k >> 1) & 1) - 0.5, ((k >> 2) & 1) - 0.5);
        points.emplace_back(keepout.size().cwiseProduct(sign));
      }
      points.emplace_back(0.0, 0.0, 0.0);
      break;
    case KeepOutKind::kCylinder:
      rim(-h);
      rim(h);
      points.emplace_back(0.0, 0.0, -h);
      points.emplace_back(0.0, 0.0, 0.0);
      points.emplace_back(0.0, 0.0, h);
      break;
    case KeepOutKind::kCone:
      rim(2.0 * h);
      points.emplace_back(0.0, 0.0, 0.0);
      points.emplace_back(0.0, 0.0, 2.0 * h);
      break;
    case KeepOutKind::kSphere:
      points.emplace_back(0.0, 0.0, 0.0);
      break;
    case KeepOutKind::kMesh: {
      const PointView vertices = keepout.hull()->mesh().vertices();
      for (Index i = 0; i < vertices.rows(); ++i) points.emplace_back(vertices.row(i).transpose());
      return points;
    }
    case KeepOutKind::kHalfSpace:
      return points;
  }
  for (Vec3& point : points) point = keepout.pose() * point;
  return points;
}

/// Of a box, a cylinder, a cone or a mesh: edges, or lines from rim to rim or apex, which may
/// pierce a face of the hull.
std::vector<std::array<Vec3, 2>> lines_of(const KeepOut& keepout, const std::vector<Vec3>& points) {
  std::vector<std::array<Vec3, 2>> lines;
  if (keepout.kind() == KeepOutKind::kBox) {
    for (std::size_t k = 0; k < 8; ++k) {
      for (const std::size_t bit : {1U, 2U, 4U}) {
        if ((k & bit) == 0) lines.push_back({points[k], points[k | bit]});
      }
    }
  } else if (keepout.kind() == KeepOutKind::kCylinder || keepout.kind() == KeepOutKind::kCone) {
    const bool cone = keepout.kind() == KeepOutKind::kCone;
    for (std::size_t k = 0; k < 16; ++k) lines.push_back({points[k], points[16 + (cone ? 0 : k)]});
  } else if (keepout.kind() == KeepOutKind::kMesh) {
    std::vector<Vec3> vertices;
    std::vector<std::pair<Index, Index>> edges;
    collect(keepout.hull()->mesh(), vertices, edges);
    for (const auto& [a, b] : edges) {
      lines.push_back(
          {vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)]});
    }
  }
  return lines;
}

}  // namespace

HullRoom::HullRoom(const Surroundings& surroundings, double clearance,
                   const Eigen::AlignedBox3d& area, int num_threads)
    : surroundings_(&surroundings), clearance_(clearance), top_(-kInfinity) {
  if (surroundings.hull) {
    collect(surroundings.hull->mesh(), vertices_, edges_);
  } else {
    vertices_.push_back(Vec3::Zero());
  }
  support_ = spread(vertices_);
  for (const KeepOut& keepout : surroundings.keepouts) {
    if (keepout.frame() != "world") continue;
    keepouts_.push_back(keepout);
    keepout_points_.push_back(points_of(keepout));
    keepout_lines_.push_back(lines_of(keepout, keepout_points_.back()));
  }
  if (!surroundings.scene) return;

  double radius = 0.0;
  for (const Vec3& vertex : vertices_) radius = std::max(radius, vertex.norm());
  const Vec3 around = Vec3::Constant(radius + clearance);
  const Eigen::AlignedBox3d near(area.min() - around, area.max() + around);
  for (std::int32_t m = 0; m < surroundings.scene->row_count(); ++m) {
    const TriangleMesh mesh = surroundings.scene->mesh_in_world(m);
    if (mesh.vertex_count() > 0) top_ = std::max(top_, mesh.vertices().col(2).maxCoeff());
    collect_edges(mesh, near, bottom_);
  }
  const Eigen::Vector2d size = near.sizes().head<2>();
  raster_step_ = std::max(kCell, size.maxCoeff() / static_cast<double>(kRaster));
  raster_origin_ = near.min().head<2>();
  raster_rows_ = static_cast<Index>(size.x() / raster_step_) + 1;
  raster_columns_ = static_cast<Index>(size.y() / raster_step_) + 1;
  raster_.assign(static_cast<std::size_t>(raster_rows_ * raster_columns_), top_);
  parallel_for(raster_.size(), 256, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const auto cell = static_cast<Index>(c);
      const Eigen::Vector2d at(static_cast<double>(cell / raster_columns_) + 0.5,
                               static_cast<double>(cell % raster_columns_) + 0.5);
      const Eigen::Vector2d point = raster_origin_ + raster_step_ * at;
      raster_[c] = height({point.x(), point.y(), 0.0});
    }
  });
}

/// Of the topmost surface at the point's x and y; of the scene's highest point where there is none.
double HullRoom::height(const Vec3& point) const {
  const double above = top_ + 1.0;
  const RayHit hit = surroundings_->scene->cast({point.x(), point.y(), above}, -Vec3::UnitZ());
  return hit.mesh < 0 ? top_ : above - hit.range;
}

bool HullRoom::seems_clear(const Pose& world_from_vehicle) const {
  if (raster_.empty()) return true;
  for (const Vec3& vertex : support_) {
    const Vec3 at = world_from_vehicle * vertex;
    const Eigen::Vector2d cell = (at.head<2>() - raster_origin_) / raster_step_;
    if (!(cell.minCoeff() >= 0.0)) return false;
    const auto row = static_cast<Index>(cell.x());
    const auto column = static_cast<Index>(cell.y());
    if (row >= raster_rows_ || column >= raster_columns_) return false;
    const double bottom = raster_[static_cast<std::size_t>(row * raster_columns_ + column)];
    if (at.z() < bottom + clearance_) return false;
  }
  return true;
}

bool HullRoom::clear(const Pose& world_from_vehicle) const {
  if (surroundings_->scene &&
      !(above_bottom(world_from_vehicle) && clear_of_bottom(world_from_vehicle))) {
    return false;
  }
  return std::ranges::all_of(
      keepouts_, [&](const KeepOut& keepout) { return clear_of(keepout, world_from_vehicle); });
}

bool HullRoom::above_bottom(const Pose& world_from_vehicle) const {
  return std::ranges::all_of(support_, [&](const Vec3& vertex) {
    const Vec3 at = world_from_vehicle * vertex;
    return at.z() > height(at);
  });
}

/// Surfaces come nearest to each other, or meet, at an edge of one of them.
bool HullRoom::clear_of_bottom(const Pose& world_from_vehicle) const {
  const Scene& scene = *surroundings_->scene;
  const auto too_near = [&](double distance) { return distance < clearance_ || distance == 0.0; };
  const NearestSegmentOptions within{.within = std::max(clearance_, 1e-9)};
  if (edges_.empty()) return !too_near(scene.nearest(world_from_vehicle.translation()).distance);
  for (const auto& [a, b] : edges_) {
    const Vec3 from = world_from_vehicle * vertices_[static_cast<std::size_t>(a)];
    const Vec3 to = world_from_vehicle * vertices_[static_cast<std::size_t>(b)];
    if (too_near(scene.nearest_segment(from, to, within).distance)) return false;
  }
  const Pose vehicle_from_world = world_from_vehicle.inverse();
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : vertices_) box.extend(Vec3(world_from_vehicle * vertex));
  const Vec3 around = Vec3::Constant(clearance_);
  box = {box.min() - around, box.max() + around};
  std::vector<double> ends;
  for (const std::array<Vec3, 2>& edge : bottom_) {
    if (!overlap(edge, box)) continue;
    const Vec3 from = vehicle_from_world * edge[0];
    const Vec3 to = vehicle_from_world * edge[1];
    if (too_near(surroundings_->hull->scene().nearest_segment(from, to, within).distance)) {
      return false;
    }
    ends.insert(ends.end(), from.begin(), from.end());
  }
  const std::size_t count = ends.size() / 3;
  const std::unique_ptr<bool[]> inside(new bool[count]);
  surroundings_->hull->contains({ends.data(), static_cast<Index>(count), 3}, {inside.get(), count},
                                1);
  return std::none_of(inside.get(), inside.get() + count, [](bool in) { return in; });
}

bool HullRoom::clear_of(const KeepOut& keepout, const Pose& world_from_vehicle) const {
  const Pose given_from_vehicle = keepout.motion().at(0.0).inverse() * world_from_vehicle;
  std::vector<double> corners, from, to;
  for (const Vec3& vertex : vertices_) {
    const Vec3 at = given_from_vehicle * vertex;
    corners.insert(corners.end(), at.begin(), at.end());
  }
  const auto view = [](const std::vector<double>& points) {
    return PointView(points.data(), static_cast<Index>(points.size() / 3), 3);
  };
  const auto all_clear = [&](const std::vector<double>& distances) {
    return std::ranges::all_of(distances, [&](double d) { return d > 0.0 && d >= clearance_; });
  };
  if (!all_clear(keepout.distance(view(corners), 1))) return false;
  if (edges_.empty() || keepout.kind() == KeepOutKind::kHalfSpace) return true;
  for (const auto& [a, b] : edges_) {
    from.insert(from.end(), &corners[3 * static_cast<std::size_t>(a)],
                &corners[3 * static_cast<std::size_t>(a)] + 3);
    to.insert(to.end(), &corners[3 * static_cast<std::size_t>(b)],
              &corners[3 * static_cast<std::size_t>(b)] + 3);
  }
  if (keepout.convex()) {
    const std::vector<double> radii(edges_.size(), 0.0);
    if (!all_clear(keepout.capsule_distance(view(from), view(to), radii, 1))) return false;
  } else {
    const Scene& surface = keepout.hull()->scene();
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const double d = surface
                           .nearest_segment(view(from).row(static_cast<Index>(e)).transpose(),
                                            view(to).row(static_cast<Index>(e)).transpose())
                           .distance;
      if (!(d > 0.0 && d >= clearance_)) return false;
    }
  }
  std::vector<double> own;
  const auto number = static_cast<std::size_t>(&keepout - keepouts_.data());
  const Pose vehicle_from_given = given_from_vehicle.inverse();
  for (const auto& [start, end] : keepout_lines_[number]) {
    const double d = surroundings_->hull->scene()
                         .nearest_segment(vehicle_from_given * start, vehicle_from_given * end)
                         .distance;
    if (!(d > 0.0 && d >= clearance_)) return false;
  }
  for (const Vec3& point : keepout_points_[number]) {
    const Vec3 at = vehicle_from_given * point;
    own.insert(own.end(), at.begin(), at.end());
  }
  std::vector<double> distances = surroundings_->hull->signed_distance(view(own), 1);
  // A ball may bulge into a face between the edges.
  if (keepout.kind() == KeepOutKind::kSphere) distances.front() -= keepout.radius();
  return all_clear(distances);
}

}  // namespace bathyal::workspace
