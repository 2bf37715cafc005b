// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/hull.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/internal/inside_grid.hpp"

namespace bathyal {
namespace {

using workspace::InsideGrid;
using workspace::Side;
using workspace::WeldedMesh;

/// Fewer points are not worth a grid.
constexpr Index kFewPoints = 1000;

/// Of a mesh with more, the grid's bounds would take longer than most queries.
constexpr std::size_t kMostOpenEdges = 2000;

/// Height over length below which a mesh is flat.
constexpr double kFlat = 1e-9;

/// Farthest that a vertex lies from the plane of the largest triangle, over the mesh's size.
double relative_thickness(const WeldedMesh& mesh) {
  Vec3 normal = Vec3::Zero(), on_plane = Vec3::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0);
    const Vec3 area = (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a);
    if (area.squaredNorm() > normal.squaredNorm()) normal = area, on_plane = a;
  }
  if (normal.isZero(0.0)) return 0.0;
  normal.normalize();
  double thickness = 0.0;
  for (const Vec3& point : mesh.points) {
    thickness = std::max(thickness, std::abs(normal.dot(point - on_plane)));
  }
  return thickness / mesh.box().sizes().norm();
}

void check_encloses(const TriangleMesh& mesh, const WeldedMesh& welded) {
  if (mesh.triangle_count() > 0 && relative_thickness(welded) > kFlat) return;
  const std::string count = std::to_string(mesh.triangle_count());
  throw_argument("mesh", "a surface that encloses a volume",
                 mesh.triangle_count() == 0   ? "no triangle"
                 : mesh.triangle_count() == 1 ? "one triangle"
                                              : "a flat one of " + count + " triangles");
}

}  // namespace

struct Hull::State {
  explicit State(const TriangleMesh& mesh) : welded(mesh), edges(edge_report(welded)) {}

  const WeldedMesh welded;
  const workspace::EdgeReport edges;
  mutable std::once_flag report_made, grid_made;
  mutable HullReport report;
  mutable std::optional<InsideGrid> grid;
};

Hull::Hull(TriangleMesh mesh, int num_threads) : scene_({std::move(mesh)}, num_threads) {
  state_ = std::make_shared<const State>(this->mesh());
  check_encloses(this->mesh(), state_->welded);
}

bool Hull::closed() const { return state_->edges.open.empty(); }

const HullReport& Hull::report() const {
  std::call_once(state_->report_made, [&] { state_->report = hull_report(mesh()); });
  return state_->report;
}

void Hull::contains(PointView points, std::span<bool> inside, int num_threads) const {
  if (std::ssize(inside) != points.rows()) {
    throw_argument("inside", std::to_string(points.rows()) + " values",
                   std::to_string(inside.size()));
  }
  check_points_finite("points", points);
  const auto ask_scene = [&](PointView queries, const auto& answer) {
    const std::vector<bool> found = scene_.contains(queries, {}, num_threads);
    for (std::size_t i = 0; i < found.size(); ++i) answer(i, found[i]);
  };
  if (points.rows() < kFewPoints || state_->edges.open.size() > kMostOpenEdges) {
    return ask_scene(points, [&](std::size_t i, bool is_inside) { inside[i] = is_inside; });
  }
  std::call_once(state_->grid_made, [&] {
    state_->grid.emplace(scene_, state_->welded, state_->edges.open, num_threads);
  });
  constexpr std::size_t kGrain = 4096;
  parallel_for(inside.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> unknown;
    for (std::size_t i = begin; i < end; ++i) {
      const Side side = state_->grid->look(points.row(static_cast<Index>(i)));
      inside[i] = side == Side::kInside;
      if (side == Side::kUnknown) unknown.push_back(i);
    }
    Points::Matrix rest(static_cast<Index>(unknown.size()), 3);
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      rest.row(static_cast<Index>(i)) = points.row(static_cast<Index>(unknown[i]));
    }
    ask_scene(PointView(rest.data(), rest.rows(), 3),
              [&](std::size_t i, bool is_inside) { inside[unknown[i]] = is_inside; });
  });
}

std::vector<double> Hull::signed_distance(PointView points, int num_threads) const {
  const std::vector<NearestPoint> nearest = scene_.nearest(points, num_threads);
  const auto inside = std::make_unique<bool[]>(nearest.size());
  contains(points, {inside.get(), nearest.size()}, num_threads);
  std::vector<double> distances;
  distances.reserve(nearest.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    distances.push_back(inside[i] ? -nearest[i].distance : nearest[i].distance);
  }
  return distances;
}

Voxels Hull::voxels(double size, int num_threads) const {
  check_positive("size", size);
  constexpr double kMostVoxels = 0x1p28;
  const Eigen::AlignedBox3d box = state_->welded.box();
  const Vec3 counts = (box.sizes() / size).array().ceil().max(1.0);
  if (!(counts.prod() <= kMostVoxels)) {
    const double least = std::cbrt(box.volume() / kMostVoxels);
    throw_argument("size", "a size of no more than 2^28 voxels: about " + to_text(least) + " m",
                   to_text(size));
  }
  Voxels voxels;
  voxels.size = size;
  voxels.count = counts.array().cast<int>();
  voxels.origin = box.center() - 0.5 * size * counts;  // the same margin at both ends
  voxels.inside = std::make_shared<bool[]>(voxels.total());
  const auto row_length = static_cast<std::size_t>(voxels.count[2]);
  constexpr std::size_t kRows = 4096;
  const std::size_t rows = voxels.total() / row_length;
  for (std::size_t first = 0; first < rows; first += kRows) {
    const std::size_t count = std::min(kRows, rows - first);
    Points::Matrix middles(static_cast<Index>(count * row_length), 3);
    for (Index i = 0; i < middles.rows(); ++i) {
      const std::size_t v = first * row_length + static_cast<std::size_t>(i);
      const std::size_t row = v / row_length;
      const auto across = static_cast<std::size_t>(voxels.count[1]);
      const Vec3 at(static_cast<double>(row / across), static_cast<double>(row % across),
                    static_cast<double>(v % row_length));
      middles.row(i) = voxels.origin + size * (at + Vec3::Constant(0.5));
    }
    contains(PointView(middles.data(), middles.rows(), 3),
             {voxels.inside.get() + first * row_length, count * row_length}, num_threads);
  }
  return voxels;
}

}  // namespace bathyal
