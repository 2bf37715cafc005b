// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/world/generate/internal/mesh_builder.hpp"
#include "bathyal/world/generate/solids.hpp"

namespace bathyal {
namespace {

using SphereTriangle = std::array<std::int32_t, 3>;

struct UnitSphere {
  std::vector<Vec3> directions;
  std::vector<SphereTriangle> triangles;
};

UnitSphere icosahedron() {
  constexpr double kG = std::numbers::phi;
  UnitSphere sphere;
  for (const double s : {1.0, -1.0}) {
    for (const double t : {kG, -kG}) {
      sphere.directions.push_back(Vec3(0.0, s, t).normalized());
      sphere.directions.push_back(Vec3(s, t, 0.0).normalized());
      sphere.directions.push_back(Vec3(t, 0.0, s).normalized());
    }
  }
  // Its faces are the triples of neighbours: an edge is 1.05 of the radius.
  const auto near = [&](int a, int b) {
    return (sphere.directions[static_cast<std::size_t>(a)] -
            sphere.directions[static_cast<std::size_t>(b)])
               .norm() < 1.1;
  };
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      for (int c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
        const Vec3& pa = sphere.directions[static_cast<std::size_t>(a)];
        const Vec3& pb = sphere.directions[static_cast<std::size_t>(b)];
        const Vec3& pc = sphere.directions[static_cast<std::size_t>(c)];
        const bool outward = pa.dot(pb.cross(pc)) > 0.0;
        sphere.triangles.push_back(outward ? SphereTriangle{a, b, c} : SphereTriangle{a, c, b});
      }
    }
  }
  return sphere;
}

UnitSphere subdivide(const UnitSphere& coarse) {
  UnitSphere fine{coarse.directions, {}};
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto next = static_cast<std::int32_t>(fine.directions.size());
    const auto [found, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)}, next);
    if (fresh) {
      const Vec3 sum = fine.directions[static_cast<std::size_t>(a)] +
                       fine.directions[static_cast<std::size_t>(b)];
      fine.directions.push_back(sum.normalized());
    }
    return found->second;
  };
  for (const SphereTriangle& t : coarse.triangles) {
    const std::int32_t ab = middle(t[0], t[1]);
    const std::int32_t bc = middle(t[1], t[2]);
    const std::int32_t ca = middle(t[2], t[0]);
    fine.triangles.insert(fine.triangles.end(),
                          {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

Vec3 random_direction(RandomStream& random) {
  const double z = random.uniform(-1.0, 1.0);
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

/// Distance of its surface in each direction: planes cut a sphere, waves roughen what remains.
std::vector<double> rock_shape(const std::vector<Vec3>& directions, const BoulderOptions& options) {
  RandomStream random(options.seed, 0xb0d);
  std::vector<std::pair<Vec3, double>> planes;
  for (int i = 0; i < 18; ++i) {
    const Vec3 normal = random_direction(random);
    planes.emplace_back(normal, random.uniform(0.65, 1.0));
  }
  std::vector<std::array<double, 4>> waves;
  for (int i = 0; i < 24; ++i) {
    const Vec3 k = random.uniform(4.0, 14.0) * random_direction(random);
    waves.push_back({k.x(), k.y(), k.z(), random.uniform(0.0, 2.0 * std::numbers::pi)});
  }
  std::vector<double> distance;
  for (const Vec3& d : directions) {
    double near = 1.1;
    for (const auto& plane : planes) {
      const double towards = plane.first.dot(d);
      if (towards > 0.0) near = std::min(near, plane.second / towards);
    }
    double rough = 0.0;
    for (const auto& w : waves)
      rough += std::sin(w[0] * d.x() + w[1] * d.y() + w[2] * d.z() + w[3]);
    distance.push_back(near * (1.0 + options.roughness * rough / std::sqrt(12.0)));
  }
  return distance;
}

}  // namespace

void BoulderOptions::check() const {
  check_range("roughness", roughness, 0.0, 0.2);
  check_range("subdivisions", subdivisions, 1, 6);
}

TriangleMesh make_boulder(double radius, const BoulderOptions& options) {
  check_range("radius", radius, 1e-4, 1e4);
  options.check();
  UnitSphere sphere = icosahedron();
  for (int i = 0; i < options.subdivisions; ++i) sphere = subdivide(sphere);
  const std::vector<double> distance = rock_shape(sphere.directions, options);
  const auto corner = [&](std::int32_t i) {
    const auto row = static_cast<std::size_t>(i);
    return Vec3(std::max(distance[row], 0.2) * sphere.directions[row]);
  };
  double volume = 0.0;
  for (const SphereTriangle& t : sphere.triangles) {
    volume += corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0;
  }
  const double scale = radius * std::cbrt(4.0 / 3.0 * std::numbers::pi / volume);
  generate::MeshBuilder builder;
  for (std::size_t i = 0; i < sphere.directions.size(); ++i) {
    builder.vertex(scale * corner(static_cast<std::int32_t>(i)));
  }
  for (const SphereTriangle& t : sphere.triangles) builder.triangle(t[0], t[1], t[2]);
  builder.rest();
  return builder.mesh();
}

}  // namespace bathyal
