// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/inside_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/internal/voxel_overlap.hpp"

namespace bathyal::workspace {
namespace {

constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();

/// What Scene::contains may be off by, of two winding numbers (WindingOptions::accuracy).
constexpr float kWindingError = 0.1F;

/// Voxels beyond the mesh's box on every side, so that the grid's border is empty.
constexpr double kMargin = 1.3;

/// References lie off the middle: planes of drawn hulls often pass through middles.
const Vec3 kReference(0.5137, 0.4789, 0.5073);

/// Two voxels a triangle: more take longer to fill than they save; open edges make each dearer.
double voxel_target(std::size_t triangles, bool closed) {
  if (!closed) return 1 << 16;
  return std::clamp(2.0 * static_cast<double>(triangles), 0x1p17, 0x1p21);
}

}  // namespace

InsideGrid::InsideGrid(const Scene& scene, const WeldedMesh& mesh,
                       const std::vector<OpenEdge>& open, int num_threads) {
  const Eigen::AlignedBox3d box = mesh.box();
  const Vec3 extent = box.sizes();
  const Vec3 stout = extent.cwiseMax(extent.maxCoeff() / 64.0);
  size_ = std::cbrt(stout.prod() / voxel_target(mesh.triangles.size(), open.empty()));
  low_ = box.min() - Vec3::Constant(kMargin * size_);
  count_ = (extent.array() / size_ + 2.0 * kMargin).ceil().cast<int>();
  const double reach = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  rounding_ = kRounding * (reach + extent.norm());
  edge_tolerance_ = kRounding * 4.0 * size_ * extent.squaredNorm();
  make_facets(mesh, num_threads);
  fill_lists();
  if (open.empty()) {
    find_windings_of_closed(scene, num_threads);
  } else {
    find_windings_of_open(scene, mesh, open, num_threads);
  }
  mark_empty_voxels();
}

Side InsideGrid::look(const Vec3& point) const {
  const Vec3 local = point - low_;
  const Eigen::Array3d cell = local.array() / size_;
  if (!(cell >= 0.0).all() || !(cell < count_.cast<double>()).all()) {
    return change_.empty() ? Side::kOutside : Side::kUnknown;
  }
  const Eigen::Array3i at = cell.cast<int>();
  const std::size_t v = voxel(at[0], at[1], at[2]);
  if (side_[v] != Side::kUnknown) return side_[v];
  const Crossings found =
      crossings(local, reference(at[0], at[1], at[2]), v, [](std::int32_t) { return false; });
  if (!found.known) return Side::kUnknown;
  return side_of(winding_[v] + static_cast<float>(found.count), v);
}

Side InsideGrid::side_of(float winding, std::size_t voxel) const {
  const float beyond = std::abs(winding) - 0.5F;
  const float change = change_.empty() ? 0.0F : change_[voxel];
  if (!(std::abs(beyond) > change + kWindingError)) return Side::kUnknown;
  return beyond > 0.0F ? Side::kInside : Side::kOutside;
}

std::size_t InsideGrid::voxel(int i, int j, int k) const {
  return (static_cast<std::size_t>(i) * static_cast<std::size_t>(count_[1]) +
          static_cast<std::size_t>(j)) *
             static_cast<std::size_t>(count_[2]) +
         static_cast<std::size_t>(k);
}

Vec3 InsideGrid::reference(int i, int j, int k) const {
  return size_ * (Vec3(i, j, k) + kReference);
}

std::span<const std::int32_t> InsideGrid::facets_of(std::size_t voxel) const {
  return std::span(list_).subspan(begin_[voxel], begin_[voxel + 1] - begin_[voxel]);
}

template <class Skip>
InsideGrid::Crossings InsideGrid::crossings(const Vec3& from, const Vec3& to, std::size_t voxel,
                                            const Skip& skip) const {
  Crossings found;
  for (const std::int32_t number : facets_of(voxel)) {
    const Facet& facet = facets_[static_cast<std::size_t>(number)];
    const double start = facet.normal.dot(from) - facet.offset;
    const double end = facet.normal.dot(to) - facet.offset;
    if (std::min(start, end) > facet.tolerance || std::max(start, end) < -facet.tolerance) continue;
    if (skip(number)) continue;
    const Vec3 along = to - from;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = facet.corners[c] - from, b = facet.corners[(c + 1) % 3] - from;
      const double side = along.dot(a.cross(b));
      least = std::min(least, side);
      most = std::max(most, side);
    }
    if (least < -edge_tolerance_ && most > edge_tolerance_) continue;  // passes outside of an edge
    const bool through = least > edge_tolerance_ || most < -edge_tolerance_;
    const bool sides_known = std::abs(start) > facet.tolerance && std::abs(end) > facet.tolerance;
    if (!through || !sides_known) return {0, false};
    found.count += start < 0.0 ? 1 : -1;
  }
  return found;
}

void InsideGrid::make_facets(const WeldedMesh& mesh, int num_threads) {
  facets_.resize(mesh.triangles.size());
  constexpr std::size_t kGrain = 4096;
  parallel_for(facets_.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      Facet& facet = facets_[t];
      for (std::size_t c = 0; c < 3; ++c) facet.corners[c] = mesh.corner(t, c) - low_;
      const auto& [a, b, c] = facet.corners;
      const Vec3 normal = (b - a).cross(c - a);
      const double longest = std::sqrt(
          std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
      const double length = normal.norm(), height = length / longest;
      if (!(height > kThin * longest)) {
        facet.normal = Vec3::Zero();
        facet.offset = 0.0;
        facet.tolerance = std::numeric_limits<double>::infinity();
        continue;
      }
      facet.normal = normal / length;
      facet.offset = facet.normal.dot(a);
      // Corners that move by the rounding tilt the plane by the more the lower the triangle is.
      facet.tolerance = rounding_ * (1.0 + (longest + 4.0 * size_) / height);
    }
  });
}

void InsideGrid::fill_lists() {
  const VoxelFrame frame{size_, count_};
  begin_.assign(static_cast<std::size_t>(count_.prod()) + 1, 0);
  for (const Facet& facet : facets_) {
    for_each_voxel(frame, facet.corners, facet.normal,
                   [&](int i, int j, int k) { ++begin_[voxel(i, j, k) + 1]; });
  }
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  list_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t t = 0; t < facets_.size(); ++t) {
    for_each_voxel(frame, facets_[t].corners, facets_[t].normal, [&](int i, int j, int k) {
      list_[next[voxel(i, j, k)]++] = static_cast<std::int32_t>(t);
    });
  }
}

void InsideGrid::find_windings_of_closed(const Scene& scene, int num_threads) {
  winding_.resize(begin_.size() - 1);
  const auto rows = static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]);
  constexpr std::size_t kGrain = 32;
  // From the grid's border, where it is 0, from reference to reference along each row.
  parallel_for(rows, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int i = static_cast<int>(row) / count_[1], j = static_cast<int>(row) % count_[1];
      winding_[voxel(i, j, 0)] = 0.0F;
      for (int k = 0; k + 1 < count_[2]; ++k) {
        const std::size_t here = voxel(i, j, k), there = here + 1;
        const Vec3 from = reference(i, j, k), to = reference(i, j, k + 1);
        const auto first = facets_of(here);
        const Crossings a = crossings(from, to, here, [](std::int32_t) { return false; });
        const Crossings b = crossings(from, to, there, [&](std::int32_t facet) {
          return std::binary_search(first.begin(), first.end(), facet);
        });
        if (a.known && b.known) {
          winding_[there] = winding_[here] - static_cast<float>(a.count + b.count);
        } else {
          const Vec3 world = to + low_;
          const PointView point(world.data(), 1, 3);
          winding_[there] =
              static_cast<float>(std::round(scene.winding_number(point, {}, 1).front()));
        }
      }
    }
  });
}

void InsideGrid::find_windings_of_open(const Scene& scene, const WeldedMesh& mesh,
                                       const std::vector<OpenEdge>& open, int num_threads) {
  const std::size_t total = begin_.size() - 1;
  Points::Matrix points(static_cast<Index>(total), 3);
  for (int i = 0; i < count_[0]; ++i) {
    for (int j = 0; j < count_[1]; ++j) {
      for (int k = 0; k < count_[2]; ++k) {
        points.row(static_cast<Index>(voxel(i, j, k))) = reference(i, j, k) + low_;
      }
    }
  }
  const PointView view(points.data(), points.rows(), 3);
  const std::vector<double> windings = scene.winding_number(view, {}, num_threads);
  winding_.assign(windings.begin(), windings.end());

  change_.resize(total);
  const double reach = 0.55 * std::numbers::sqrt3 * size_;  // from a reference to its voxel's end
  constexpr std::size_t kGrain = 256;
  parallel_for(total, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3 query = points.row(static_cast<Index>(v));
      double gradient = 0.0;
      for (const OpenEdge& edge : open) {
        const Vec3 a = mesh.points[static_cast<std::size_t>(edge.from)];
        const Vec3 along = mesh.points[static_cast<std::size_t>(edge.to)] - a;
        const double t = std::clamp(along.dot(query - a) / along.squaredNorm(), 0.0, 1.0);
        const double distance = std::max(0.0, (a + t * along - query).norm() - reach);
        gradient += edge.count * along.norm() / (4.0 * std::numbers::pi * distance * distance);
      }
      change_[v] = static_cast<float>(gradient * reach);
    }
  });
}

void InsideGrid::mark_empty_voxels() {
  side_.resize(winding_.size());
  for (std::size_t v = 0; v < side_.size(); ++v) {
    side_[v] = begin_[v] == begin_[v + 1] ? side_of(winding_[v], v) : Side::kUnknown;
  }
}

}  // namespace bathyal::workspace
