// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "bathyal/base/random.hpp"
#include "bathyal/base/simd.hpp"
#include "bathyal/scene/ray_triangle.hpp"
#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"

namespace bathyal {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Rays {
  PointMatrix origins;
  PointMatrix directions;
};

PointView view(const PointMatrix& matrix) { return {matrix.data(), matrix.rows(), 3}; }

Vec3 random_vector(RandomStream& random) {
  return {random.normal(), random.normal(), random.normal()};
}

/// Origins about a box and directions of every kind: random, along axes, with tiny components.
Rays random_rays(Index count, const Vec3& centre, const Vec3& half, std::uint64_t seed) {
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
std::vector<RayHit> every_triangle(const std::vector<TriangleMesh>& meshes, const Rays& rays) {
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

void expect_same_bytes(const std::vector<RayHit>& a, const std::vector<RayHit>& b,
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
void expect_exact(const std::vector<TriangleMesh>& meshes, const Rays& rays) {
  const std::vector<RayHit> truth = every_triangle(meshes, rays);
  const Scene scene(meshes, 2);
  EveryLevel().run([&](const std::string& level) {
    for (const int threads : {1, 8}) {
      expect_same_bytes(scene.cast(view(rays.origins), view(rays.directions), threads), truth,
                        level + " on " + std::to_string(threads));
    }
  });
}

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

TEST(Cast, MeetsABoxWhereArithmeticSays) {
  const Scene scene({test::box(Vec3(1, 2, 3))});
  const RayHit down = scene.cast(Vec3(0.25, 0.5, 10), Vec3(0, 0, -4));
  EXPECT_EQ(down.range, 7.0);
  const RayHit inside = scene.cast(Vec3(0, 0, 0), Vec3(0, 5, 0));
  EXPECT_EQ(inside.range, 2.0);
  const RayHit slanted = scene.cast(Vec3(-4, 0.1, 0.2), Vec3(1, 0.1, 0.1));
  EXPECT_NEAR(slanted.range, 3.0 * std::sqrt(1.02), 1e-15 * 4);
  EXPECT_EQ(scene.cast(Vec3(0, 0, 10), Vec3(0, 0, 1)).triangle, -1);
  EXPECT_EQ(scene.cast(Vec3(0, 0, 10), Vec3(0, 0, 1)).range, kInf);
}

TEST(Cast, TouchesAtRangeZeroAndNotBehind) {
  const Scene scene({test::one_triangle(Vec3(0, 0, 5))});
  EXPECT_EQ(scene.cast(Vec3(0.2, 0.2, 5), Vec3(0, 0, 1)).range, 0.0);
  EXPECT_EQ(scene.cast(Vec3(0.2, 0.2, 5), Vec3(0, 0, -1)).range, 0.0);
  EXPECT_FALSE(std::signbit(scene.cast(Vec3(0.2, 0.2, 5), Vec3(0, 0, -1)).range));
  EXPECT_EQ(scene.cast(Vec3(0.2, 0.2, 5.001), Vec3(0, 0, 1)).triangle, -1);
  EXPECT_EQ(scene.cast(Vec3(0.2, 0.2, 4), Vec3(0, 0, 1)).range, 1.0);
}

TEST(Cast, BarycentricWeightsRebuildThePoint) {
  const TriangleMesh mesh = test::sphere(3, 2.0, Vec3(10, 20, 30));
  const Scene scene({mesh});
  const Rays rays = random_rays(500, Vec3(10, 20, 30), Vec3(3, 3, 3), 5);
  int met = 0;
  const auto hits = scene.cast(view(rays.origins), view(rays.directions));
  for (Index i = 0; i < rays.directions.rows(); ++i) {
    const RayHit& hit = hits[static_cast<std::size_t>(i)];
    if (hit.triangle < 0) continue;
    ++met;
    const Vec3 along = rays.origins.row(i).transpose() +
                       hit.range * rays.directions.row(i).transpose().normalized();
    const Vec3 across = (1 - hit.u - hit.v) * mesh.corner(hit.triangle, 0) +
                        hit.u * mesh.corner(hit.triangle, 1) + hit.v * mesh.corner(hit.triangle, 2);
    EXPECT_LT((along - across).norm(), 1e-13 * 40);
  }
  EXPECT_GT(met, 50);
}

TEST(Cast, SphereRangeWithinTheFacets) {
  const Scene scene({test::sphere(5, 1.0)});
  const double least = std::cos(0.05);  // facets of 1/32 of a right angle
  for (int i = 0; i < 200; ++i) {
    RandomStream random(3, static_cast<std::uint64_t>(i));
    const Vec3 direction = random_vector(random).normalized();
    const RayHit hit = scene.cast(-5.0 * direction, direction);
    EXPECT_GE(hit.range, 4.0 - 1e-12);
    EXPECT_LE(hit.range, 5.0 - least);
  }
}

TEST(Cast, IsTheDecisionOverEveryTriangleOnAllLevelsAndThreads) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(6.2e5, 7.2e6, -52), Vec3(-1e7, 1e7, 1e7)}) {
    const Vec3 middle = offset + Vec3(30, 25, 0);
    expect_exact({test::seabed(60, 50, offset)}, random_rays(4500, middle, Vec3(32, 27, 6), 1));
    expect_exact({test::sphere(4, 2.0, offset)}, random_rays(3000, offset, Vec3(3, 3, 3), 2));
  }
}

/// Rays in order, as a sonar has them: pings along a line, each a fan across it.
Rays fans(int pings, int beams, const Vec3& first, const Vec3& step, double tilt) {
  Rays rays{PointMatrix(Index{pings} * beams, 3), PointMatrix(Index{pings} * beams, 3)};
  for (int ping = 0; ping < pings; ++ping) {
    for (int beam = 0; beam < beams; ++beam) {
      const double angle = -1.2 + 2.4 * beam / (beams - 1);
      rays.origins.row(Index{ping} * beams + beam) = first + ping * step;
      rays.directions.row(Index{ping} * beams + beam) =
          Vec3(std::sin(angle), tilt * std::cos(7.0 * ping), -std::cos(angle));
    }
  }
  return rays;
}

TEST(Cast, FansAreTheDecisionOverEveryTriangle) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(6.2e5, 7.2e6, -52)}) {
    const TriangleMesh mesh = test::seabed(60, 50, offset);
    const Vec3 first = offset + Vec3(30, 1, 9);
    expect_exact({mesh}, fans(40, 101, first, Vec3(0, 1.2, 0), 0.0));
    expect_exact({mesh}, fans(25, 100, first, Vec3(0.3, 1.7, 0.1), 0.2));
    expect_exact({mesh}, fans(3, 900, first, Vec3(0, 15, 20), 0.01));  // many beams a triangle
    expect_exact({test::sphere(3, 2.0, offset), mesh}, fans(9, 150, first, Vec3(0, 5, 0), 0.1));
  }
}

TEST(Cast, NeighbouringRaysThroughVerticesAndEdgesAreExactToo) {
  // Straight down through every vertex, edge middle and cell middle of a grid, in order.
  const TriangleMesh mesh = test::seabed(12, 12);
  Rays rays{PointMatrix(23 * 23, 3), PointMatrix(23 * 23, 3)};
  for (int j = 0; j < 23; ++j) {
    for (int i = 0; i < 23; ++i) {
      rays.origins.row(23 * j + i) = Vec3(0.5 * i, 0.5 * j, 20);
      rays.directions.row(23 * j + i) = Vec3(0, 0, -1);
    }
  }
  expect_exact({mesh}, rays);
  for (const RayHit& hit : Scene({mesh}).cast(view(rays.origins), view(rays.directions))) {
    EXPECT_GE(hit.triangle, 0);
  }
}

TEST(Cast, AnyNumberOfRaysFillsItsPackets) {
  const Rays all = fans(2, 40, Vec3(30, 20, 9), Vec3(0, 1, 0), 0.1);
  const Scene scene({test::seabed(60, 50)});
  EveryLevel().run([&](const std::string& level) {
    const auto truth = scene.cast(view(all.origins), view(all.directions), 1);
    for (Index count = 1; count <= 40; ++count) {
      const auto some = scene.cast(PointView(all.origins.data(), count, 3),
                                   PointView(all.directions.data(), count, 3), 1);
      expect_same_bytes(some, {truth.begin(), truth.begin() + count}, level);
    }
  });
}

TEST(Cast, OddLengthsBesideOrdinaryOnesInAPacket) {
  const Scene scene({test::seabed(60, 50)});
  Rays rays = fans(2, 40, Vec3(30, 20, 9), Vec3(0, 1, 0), 0.1);
  const auto plain = scene.cast(view(rays.origins), view(rays.directions), 1);
  for (Index i = 0; i < 80; i += 3) rays.directions.row(i) *= i % 2 == 0 ? 0x1p+600 : 0x1p-600;
  EveryLevel().run([&](const std::string& level) {
    expect_same_bytes(scene.cast(view(rays.origins), view(rays.directions), 1), plain, level);
  });
}

TEST(Cast, OriginsFarOutside) {
  const TriangleMesh mesh = test::seabed(60, 50, Vec3(6.2e5, 7.2e6, -52));
  for (const double distance : {1e3, 1e5, 1e7, 1e10}) {
    Rays rays{PointMatrix(600, 3), PointMatrix(600, 3)};
    int met = 0;
    for (Index i = 0; i < 600; ++i) {
      RandomStream random(9, static_cast<std::uint64_t>(i));
      const Vec3 aim(6.2e5 + random.uniform(0, 59), 7.2e6 + random.uniform(0, 49), -52);
      const Vec3 from = aim + distance * (random_vector(random).normalized() + Vec3(0, 0, 1.5));
      rays.origins.row(i) = from;
      rays.directions.row(i) = aim - from;
    }
    expect_exact({mesh}, rays);
    for (const RayHit& hit : every_triangle({mesh}, rays)) met += hit.triangle >= 0 ? 1 : 0;
    EXPECT_GT(met, 400) << distance;
  }
}

TEST(Cast, LengthOfTheDirectionDoesNotMatter) {
  const Scene scene({test::seabed(20, 20)});
  for (const double length : {1e-320, 1e-300, 1e-160, 1e-3, 1.0, 1e150, 1e300}) {
    EXPECT_EQ(scene.cast(Vec3(5.3, 6.2, 40), Vec3(0, 0, -length)).range,
              scene.cast(Vec3(5.3, 6.2, 40), Vec3(0, 0, -1)).range);
    EXPECT_NEAR(scene.cast(Vec3(5.3, 6.2, 40), Vec3(0.1, 0.2, -1) * length).range,
                scene.cast(Vec3(5.3, 6.2, 40), Vec3(0.1, 0.2, -1)).range,
                length < 1e-310 ? 0.1 : 1e-13 * 40);
  }
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
    // Slopes that double holds exactly, so that the rays pass through the vertex and not beside it.
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

TEST(Cast, ManyMeshesNameTheirOwnTriangles) {
  std::vector<TriangleMesh> meshes;
  const TriangleMesh empty;
  for (int i = 0; i < 40; ++i) {
    meshes.push_back(test::box(Vec3(1, 1, 1), Vec3(4.0 * i, 0, 0)));
    if (i % 3 == 0) meshes.push_back(empty);
  }
  expect_exact(meshes, random_rays(1500, Vec3(80, 0, 0), Vec3(80, 2, 2), 8));
}

TEST(Cast, EmptySceneIsNeverHit) {
  const Scene scene({TriangleMesh()});
  EXPECT_EQ(scene.cast(Vec3(0, 0, 0), Vec3(0, 0, 1)).triangle, -1);
  EXPECT_EQ(scene.memory(), 0U);
  PointMatrix none(0, 3);
  EXPECT_TRUE(scene.cast(view(none), view(none)).empty());
}

TEST(Cast, RefusalsNameTheRow) {
  EXPECT_THROW(Scene(std::vector<TriangleMesh>{}), std::invalid_argument);
  const Scene scene({test::seabed(20, 20)});
  Rays rays = random_rays(9000, Vec3(10, 10, 0), Vec3(10, 10, 3), 6);
  const auto message = [&] {
    try {
      scene.cast(view(rays.origins), view(rays.directions), 2);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  rays.directions.row(8000).setZero();
  EXPECT_NE(message().find("directions"), std::string::npos);
  EXPECT_NE(message().find("row 8000"), std::string::npos);
  rays.directions(7000, 1) = kNan;
  EXPECT_NE(message().find("row 7000"), std::string::npos);
  rays.origins(17, 2) = kInf;
  EXPECT_NE(message().find("origins"), std::string::npos);
  EXPECT_NE(message().find("row 17 "), std::string::npos);
  EXPECT_THROW(scene.cast(view(PointMatrix(PointMatrix::Zero(2, 3))), view(rays.directions)),
               std::invalid_argument);
}

TEST(Cast, OneOriginServesAll) {
  const Scene scene({test::seabed(20, 20)});
  Rays rays = random_rays(300, Vec3(10, 10, 20), Vec3(0, 0, 0), 6);
  const PointMatrix one = rays.origins.topRows(1);
  expect_same_bytes(scene.cast(view(one), view(rays.directions)),
                    scene.cast(view(rays.origins), view(rays.directions)), "broadcast");
}

TEST(Occluded, CountsBothEndsAndNothingBeyond) {
  const Scene scene({test::one_triangle(Vec3(0, 0, 0)), test::seabed(30, 30, Vec3(100, 0, 0))});
  const auto blocked = [&](const Vec3& from, const Vec3& to) -> bool {
    return scene.occluded(PointView(from.data(), 1, 3), PointView(to.data(), 1, 3)).front();
  };
  EXPECT_TRUE(blocked(Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, -1)));
  EXPECT_TRUE(blocked(Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, 0)));
  EXPECT_TRUE(blocked(Vec3(0.2, 0.2, 0), Vec3(0.2, 0.2, 1)));
  EXPECT_TRUE(blocked(Vec3(0.3, 5.2, 0.7), Vec3(0, 0, 0)));  // ends on a corner
  EXPECT_FALSE(blocked(Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, 1e-12)));
  EXPECT_FALSE(blocked(Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, 1)));       // no segment
  EXPECT_FALSE(blocked(Vec3(0, 0, 1.7e308), Vec3(0, 0, -1.7e308)));  // longer than double holds
}

TEST(Occluded, AgreesWithCastOnAllLevels) {
  const Scene scene({test::seabed(60, 50, Vec3(6.2e5, 7.2e6, -52))});
  const Rays rays = random_rays(4000, Vec3(6.2e5 + 30, 7.2e6 + 25, -52), Vec3(32, 27, 6), 12);
  const PointMatrix ends = rays.origins + 9.0 * rays.directions;
  const auto hits = scene.cast(view(rays.origins), view(rays.directions));
  EveryLevel().run([&](const std::string& level) {
    const auto blocked = scene.occluded(view(rays.origins), view(ends));
    for (Index i = 0; i < ends.rows(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double length = (ends.row(i) - rays.origins.row(i)).norm();
      if (std::abs(hits[k].range - length) < 1e-6) continue;
      ASSERT_EQ(blocked[k], hits[k].range < length) << level << " " << i;
    }
  });
}

}  // namespace
}  // namespace bathyal
