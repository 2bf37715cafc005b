// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"
#include "rays.hpp"

namespace bathyal {
namespace {

using test::EveryLevel;
using test::expect_exact;
using test::random_rays;
using test::Rays;
using test::view;

Eigen::Matrix3d random_rotation(std::uint64_t seed) {
  RandomStream random(seed);
  return Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
      .normalized()
      .toRotationMatrix();
}

TriangleMesh moved(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation, const Vec3& shift) {
  PointMatrix points(mesh.vertex_count(), 3);
  for (Index i = 0; i < points.rows(); ++i) {
    points.row(i) = rotation * mesh.vertices().row(i).transpose() + shift;
  }
  return {std::move(points), mesh.shared_triangles()};
}

/// From inside a closed mesh every ray must get out through something; from outside, a ray through
/// the middle must get in.
void expect_no_slip(const TriangleMesh& mesh, const Vec3& inside) {
  std::vector<Vec3> aims;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3 a = mesh.corner(t, c);
      const Vec3 b = mesh.corner(t, (c + 1) % 3);
      for (const double s : {0.0, 0.5, 1.0 / 3.0, 0.9, 1e-9}) aims.push_back(a + s * (b - a));
    }
  }
  Rays rays{PointMatrix(static_cast<Index>(2 * aims.size()), 3),
            PointMatrix(static_cast<Index>(2 * aims.size()), 3)};
  for (std::size_t i = 0; i < aims.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    rays.origins.row(row) = inside;
    rays.directions.row(row) = aims[i] - inside;
    rays.origins.row(row + 1) = inside + 7.0 * (aims[i] - inside);
    rays.directions.row(row + 1) = inside - aims[i];
  }
  const Scene scene({mesh});
  EveryLevel().run([&](const std::string& level) {
    const auto hits = scene.cast(view(rays.origins), view(rays.directions), 1);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      ASSERT_GE(hits[i].triangle, 0)
          << level << ", aim " << i / 2 << (i % 2 ? " from outside" : "");
    }
  });
}

TEST(Cast, NeverSlipsThroughAnEdgeOrVertexOfAClosedMesh) {
  for (const double far : {0.0, 1e7}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const Eigen::Matrix3d turn = seed == 0 ? Eigen::Matrix3d::Identity() : random_rotation(seed);
      const Vec3 shift = far * Vec3(0.0620153, 0.72465, -0.9);
      expect_no_slip(moved(test::box(Vec3(1, 2, 3)), turn, shift), shift + Vec3(0.1, -0.2, 0.3));
      expect_no_slip(moved(test::box(Vec3(1, 1, 1)), turn, shift), shift);
      expect_no_slip(moved(test::tetrahedron(), turn, shift), shift);
      expect_no_slip(moved(test::sphere(3, 1.5), turn, shift), shift);
    }
  }
}

TEST(Cast, RunsAlongEdgesAndInPlanesOfFaces) {
  const Scene scene({test::box(Vec3(1, 1, 1))});
  // Along an edge and along the diagonal of a face: the face in front is met at its border.
  EXPECT_EQ(scene.cast(Vec3(-3, 1, 1), Vec3(1, 0, 0)).range, 2.0);
  EXPECT_EQ(scene.cast(Vec3(-3, 0.5, 1), Vec3(1, 0, 0)).range, 2.0);
  EXPECT_DOUBLE_EQ(scene.cast(Vec3(-3, -3, 1), Vec3(1, 1, 0)).range, 2.0 * std::sqrt(2.0));
  // In the plane of a single triangle: it is not met.
  const Scene sheet({test::one_triangle(Vec3(0, 0, 0))});
  EXPECT_EQ(sheet.cast(Vec3(-1, 0.25, 0), Vec3(1, 0, 0)).triangle, -1);
}

TEST(Cast, TiesGoToTheLowestMeshAndTriangle) {
  const TriangleMesh sheet = test::seabed(6, 6);
  PointMatrix flat = sheet.vertices();
  flat.col(2).setZero();
  const TriangleMesh mesh(std::move(flat), sheet.shared_triangles());
  const Scene twice({mesh, mesh});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    std::int32_t lowest = 0;
    while ((mesh.triangles().row(lowest).array() != static_cast<std::int32_t>(v)).all()) ++lowest;
    // Slopes that double holds exactly, so that the rays pass through the vertex and not next to
    // it.
    for (const Vec3& from : {Vec3(0, 0, 3), Vec3(0.5, -1.25, 2), Vec3(-16, 3, 0.125)}) {
      const RayHit hit = twice.cast(mesh.vertices().row(v).transpose() + from, -from);
      EXPECT_EQ(hit.mesh, 0);
      EXPECT_EQ(hit.triangle, lowest) << "vertex " << v;
    }
  }
}

TEST(Cast, TrianglesThatShareAnEdgeTieExactly) {
  // A ray down the middle of an edge of two tilted triangles, in both orders.
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    RandomStream random(seed);
    const Vec3 p(0, random.uniform(-3, -1), random.uniform(-1, 1));
    const Vec3 q(0, random.uniform(1, 3), random.uniform(-1, 1));
    const Vec3 left(-1, random.uniform(-1, 1), random.uniform(-1, 1));
    const Vec3 right(1, random.uniform(-1, 1), random.uniform(-1, 1));
    for (const auto& mesh : {test::mesh_of({p, q, left, right}, {{0, 1, 2}, {1, 0, 3}}),
                             test::mesh_of({p, q, left, right}, {{3, 1, 0}, {2, 0, 1}})}) {
      EXPECT_EQ(Scene({mesh}).cast(Vec3(0, 0.1, 7), Vec3(0, 0, -1)).triangle, 0);
    }
  }
}

TEST(Cast, DegenerateTrianglesNeitherHitNorSpoil) {
  const TriangleMesh mesh =
      test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0.2, 0.2, 1}},
                    {{4, 4, 4}, {0, 1, 3}, {4, 4, 0}, {0, 1, 2}, {0, 1, 1}});
  const Scene scene({mesh});
  const RayHit hit = scene.cast(Vec3(0.2, 0.2, 5), Vec3(0, 0, -1));
  EXPECT_EQ(hit.triangle, 3);
  EXPECT_EQ(hit.range, 5.0);
  EXPECT_EQ(scene.cast(Vec3(1.5, 0, 5), Vec3(0, 0, -1)).triangle, -1);
  expect_exact({mesh}, random_rays(500, Vec3(0.5, 0.5, 0), Vec3(1, 1, 1), 4));
}

TEST(Cast, ClosedMeshWithACapOfNoAreaDoesNotLeak) {
  // The square's side 0–1 carries a midpoint on one side only; a zero-area triangle fills in.
  const TriangleMesh mesh =
      test::mesh_of({{0, 0, 0}, {3, 1, 0.3}, {1.5, 0.5, 0.15}, {0, 4, 0}, {2, -3, 0}},
                    {{0, 1, 3}, {0, 2, 1}, {2, 0, 4}, {1, 2, 4}});
  const Scene scene({mesh});
  for (int i = 1; i < 400; ++i) {
    const Vec3 at = (i / 400.0) * Vec3(3, 1, 0.3);
    EXPECT_GE(scene.cast(at + Vec3(0.3, 0.1, 5), Vec3(-0.3, -0.1, -5)).triangle, 0) << i;
  }
}

}  // namespace
}  // namespace bathyal
