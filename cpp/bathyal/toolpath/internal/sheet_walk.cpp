// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/sheet_walk.hpp"

#include <algorithm>

namespace bathyal::toolpath {
namespace {

/// Adds to a rising list; false where it is there already. Footprints are small.
bool insert(std::vector<std::int32_t>& sorted, std::int32_t value) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (at != sorted.end() && *at == value) return false;
  sorted.insert(at, value);
  return true;
}

}  // namespace

SheetWalk::SheetWalk(const TriangleMesh& mesh)
    : mesh_(mesh),
      start_(static_cast<std::size_t>(mesh.vertex_count()) + 1, 0),
      triangles_(static_cast<std::size_t>(mesh.triangle_count()) * 3) {
  const TriangleView triangles = mesh.triangles();
  for (Index i = 0; i < triangles.size(); ++i) ++start_[triangles.data()[i] + 1];
  for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  for (Index t = 0; t < triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      triangles_[next[triangles(t, c)]++] = static_cast<std::int32_t>(t);
    }
  }
}

std::vector<std::int32_t> SheetWalk::vertices_within(std::int32_t triangle, const Vec3& centre,
                                                     double radius) const {
  const Vec3 outward = mesh_.area_vector(triangle);
  const double squared = radius * radius;
  std::vector<std::int32_t> vertices, reached{triangle}, open{triangle}, seen;
  while (!open.empty()) {
    const std::int32_t t = open.back();
    open.pop_back();
    for (int c = 0; c < 3; ++c) {
      const std::int32_t v = mesh_.triangles()(t, c);
      const bool near = (mesh_.vertices().row(v).transpose() - centre).squaredNorm() <= squared;
      // The first facet's corners lead on even from afar: it may be larger than the footprint.
      if (!near && t != triangle) continue;
      if (!insert(seen, v)) continue;
      if (near) insert(vertices, v);
      for (std::int32_t k = start_[v]; k < start_[v + 1]; ++k) {
        const std::int32_t other = triangles_[k];
        if (mesh_.area_vector(other).dot(outward) <= 0.0) continue;
        if (insert(reached, other)) open.push_back(other);
      }
    }
  }
  return vertices;
}

std::vector<std::int32_t> SheetWalk::vertices_around(std::int32_t triangle) const {
  std::vector<std::int32_t> vertices;
  for (int c = 0; c < 3; ++c) {
    const std::int32_t v = mesh_.triangles()(triangle, c);
    for (std::int32_t k = start_[v]; k < start_[v + 1]; ++k) {
      for (int d = 0; d < 3; ++d) insert(vertices, mesh_.triangles()(triangles_[k], d));
    }
  }
  return vertices;
}

}  // namespace bathyal::toolpath
