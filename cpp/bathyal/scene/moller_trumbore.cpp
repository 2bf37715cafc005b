// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/moller_trumbore.hpp"

#include "bathyal/base/parallel.hpp"
#include "bathyal/scene/internal/ray_rows.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kGrain = 16;

/// Takes the triangle when the ray meets it nearer than what `hit` holds.
void intersect(const TriangleMesh& mesh, Index triangle, const Vec3& origin, const Vec3& direction,
               RayHit& hit) {
  const Vec3 v0 = mesh.corner(triangle, 0);
  const Vec3 e1 = mesh.corner(triangle, 1) - v0;
  const Vec3 e2 = mesh.corner(triangle, 2) - v0;
  const Vec3 p = direction.cross(e2);
  const double det = e1.dot(p);
  if (det == 0.0) return;  // the ray runs along the plane, or the triangle has no area
  const Vec3 s = origin - v0;
  const Vec3 q = s.cross(e1);
  const double t = e2.dot(q) / det;         // eq 7
  const double u = s.dot(p) / det;          // eq 8
  const double v = direction.dot(q) / det;  // eq 9
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t < hit.range)) return;
  hit.range = t;
  hit.mesh = 0;
  hit.triangle = static_cast<std::int32_t>(triangle);
  hit.u = u;
  hit.v = v;
}

}  // namespace

std::vector<RayHit> intersect_moller_trumbore(const TriangleMesh& mesh, PointView origins,
                                              PointView directions, int num_threads) {
  scene::check_rows(origins, directions, "origins", "directions");
  std::vector<RayHit> hits(static_cast<std::size_t>(directions.rows()));
  parallel_for(hits.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Index>(i);
      const Vec3 origin = origins.row(origins.rows() == 1 ? 0 : row);
      const Vec3 given = directions.row(row);
      if (!origin.allFinite() || !given.allFinite() || given.isZero(0.0)) {
        scene::throw_bad_row(origins, directions, row, "origins", "directions",
                             "finite directions of any length but zero");
      }
      const Vec3 direction = given.stableNormalized();
      for (Index t = 0; t < mesh.triangle_count(); ++t) {
        intersect(mesh, t, origin, direction, hits[i]);
      }
    }
  });
  return hits;
}

}  // namespace bathyal
