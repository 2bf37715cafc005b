// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"
#include "rays.hpp"

namespace bathyal {
namespace {

using test::every_triangle;
using test::EveryLevel;
using test::expect_exact;
using test::expect_same_bytes;
using test::random_rays;
using test::random_vector;
using test::Rays;
using test::view;

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

TEST(Cast, ExtremeLengthsAmongOrdinaryOnesInAPacket) {
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

}  // namespace
}  // namespace bathyal
