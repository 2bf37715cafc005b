// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/base/simd.hpp"
#include "bathyal/scene/internal/ray_triangle.hpp"
#include "bathyal/scene/scene.hpp"

// Rays of every kind, and the decision over every triangle that a hierarchy must agree with.

namespace bathyal::test {

struct Rays {
  PointMatrix origins;
  PointMatrix directions;
};

inline PointView view(const PointMatrix& matrix) { return {matrix.data(), matrix.rows(), 3}; }

inline Vec3 random_vector(RandomStream& random) {
  return {random.normal(), random.normal(), random.normal()};
}

/// Origins about a box and directions of every kind: random, along axes, with tiny components.
inline Rays random_rays(Index count, const Vec3& centre, const Vec3& half, std::uint64_t seed) {
  Rays rays{PointMatrix(count, 3), PointMatrix(count, 3)};
  for (Index i = 0; i < count; ++i) {
    RandomStream random(seed, static_cast<std::uint64_t>(i));
    Vec3 unit;
    for (int axis = 0; axis < 3; ++axis) unit[axis] = random.uniform(-1.5, 1.5);
    rays.origins.row(i) = centre + half.cwiseProduct(unit);
    Vec3 direction = random_vector(random);
    if (i % 7 == 0) direction[static_cast<int>(random.next() % 3)] = 0.0;
    if (i % 11 == 0) direction[static_cast<int>(random.next() % 3)] *= 1e-12;
    if (i % 13 == 0) direction = Vec3(0, 0, -1);
    rays.directions.row(i) = direction;
  }
  return rays;
}

/// The decision of the engine put to every triangle, without a hierarchy.
inline std::vector<RayHit> every_triangle(const std::vector<TriangleMesh>& meshes,
                                          const Rays& rays) {
  std::vector<RayHit> hits(static_cast<std::size_t>(rays.directions.rows()));
  for (Index i = 0; i < rays.directions.rows(); ++i) {
    RayHit& hit = hits[static_cast<std::size_t>(i)];
    const Vec3 unit = rays.directions.row(i).transpose() /
                      std::sqrt(rays.directions(i, 0) * rays.directions(i, 0) +
                                rays.directions(i, 1) * rays.directions(i, 1) +
                                rays.directions(i, 2) * rays.directions(i, 2));
    const Vec3 origin = rays.origins.row(i);
    const Vec3 direction = rays.directions.row(i);
    const scene::ExactRay ray = scene::exact_ray(origin.data(), direction.data(), unit.data());
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      for (Index t = 0; t < meshes[m].triangle_count(); ++t) {
        const Vec3 a = meshes[m].corner(t, 0);
        const Vec3 b = meshes[m].corner(t, 1);
        const Vec3 c = meshes[m].corner(t, 2);
        scene::Meeting meeting;
        if (!scene::meets(ray, a.data(), b.data(), c.data(), meeting)) continue;
        if (!(meeting.t >= 0.0 && meeting.t < hit.range)) continue;
        hit.range = meeting.t;
        hit.mesh = static_cast<std::int32_t>(m);
        hit.triangle = static_cast<std::int32_t>(t);
        hit.u = meeting.u;
        hit.v = meeting.v;
      }
    }
  }
  return hits;
}

inline void expect_same_bytes(const std::vector<RayHit>& a, const std::vector<RayHit>& b,
                              const std::string& what) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(std::memcmp(&a[i], &b[i], sizeof(RayHit)), 0)
        << what << ", ray " << i << ": " << a[i].range << " on " << a[i].triangle << " and "
        << b[i].range << " on " << b[i].triangle;
  }
}

/// Puts the best level back when a test ends.
struct EveryLevel {
  SimdLevel best = simd_level();
  ~EveryLevel() { set_simd_level(best); }

  template <class Body>
  void run(const Body& body) {
    for (const SimdLevel level : available_simd_levels()) {
      set_simd_level(level);
      body(std::string(to_text(level)));
    }
  }
};

/// Every level and number of threads against every triangle.
inline void expect_exact(const std::vector<TriangleMesh>& meshes, const Rays& rays) {
  const std::vector<RayHit> truth = every_triangle(meshes, rays);
  const Scene scene(meshes, 2);
  EveryLevel().run([&](const std::string& level) {
    for (const int threads : {1, 8}) {
      expect_same_bytes(scene.cast(view(rays.origins), view(rays.directions), threads), truth,
                        level + " on " + std::to_string(threads));
    }
  });
}

}  // namespace bathyal::test
