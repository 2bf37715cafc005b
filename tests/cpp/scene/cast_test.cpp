// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "bathyal/scene/moller_trumbore.hpp"
#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"
#include "rays.hpp"

namespace bathyal {
namespace {

using test::EveryLevel;
using test::expect_exact;
using test::expect_same_bytes;
using test::random_rays;
using test::random_vector;
using test::Rays;
using test::view;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

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

TEST(MollerTrumbore, AgreesWithTheHierarchyAwayFromEdges) {
  const TriangleMesh mesh = test::seabed(20, 20);
  const Scene scene({mesh});
  PointMatrix origins(50, 3), directions(50, 3);
  for (Index i = 0; i < 50; ++i) {
    origins.row(i) << 1.37 + 0.31 * static_cast<double>(i), 2.11 + 0.29 * static_cast<double>(i), 9;
    directions.row(i) << 0.1, -0.07, -2;
  }
  const Points from(origins), along(directions);
  const std::vector<RayHit> expected = scene.cast(from.view(), along.view());
  const std::vector<RayHit> hits = intersect_moller_trumbore(mesh, from.view(), along.view());
  ASSERT_EQ(hits.size(), expected.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits[i].triangle, expected[i].triangle);
    EXPECT_EQ(std::isfinite(hits[i].range), hits[i].triangle >= 0);
    if (hits[i].triangle < 0) continue;
    EXPECT_NEAR(hits[i].range, expected[i].range, 1e-12);
  }
}

}  // namespace
}  // namespace bathyal
