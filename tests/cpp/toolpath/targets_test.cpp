// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/targets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "bathyal/toolpath/aims.hpp"
#include "bottoms.hpp"

namespace bathyal {
namespace {

using test::axis;
using test::down;
using test::grid;
using test::scene_of;

constexpr double kPi = std::numbers::pi;
const auto kFlat = [](double, double) { return -5.0; };

TargetStatus status_of(const Surface& surface, const Vec3& point, const Vec3& direction,
                       const TargetOptions& options = {}) {
  return find_targets(surface, axis(point, direction), options).status[0];
}

TEST(FindTargets, MeetsAPlaneByEquation3) {
  const Vec3 m = Vec3(1, -2, 5).normalized();
  const Plane plane(m, -4.0);
  const Vec3 p(3, 1, 7), d(0.3, 0.2, -1.7);
  const Targets targets = find_targets(plane, axis(p, d));
  EXPECT_EQ(targets.status[0], TargetStatus::kHit);
  EXPECT_NEAR(plane.distance(targets.point[0]), 0.0, 1e-12);
  EXPECT_NEAR((targets.point[0] - p).norm(), targets.range[0], 1e-12);
  EXPECT_NEAR((targets.point[0] - p).cross(d).norm(), 0.0, 1e-12);
  EXPECT_NEAR(std::cos(targets.incidence[0]), -m.dot(d.normalized()), 1e-12);
  EXPECT_EQ(targets.triangle[0], -1);
  EXPECT_TRUE(targets.barycentric[0].array().isNaN().all());
}

TEST(FindTargets, ReportsParallelBehindAndTooFarOnAPlane) {
  const Plane plane(Vec3::UnitZ(), -5.0);
  EXPECT_EQ(status_of(plane, Vec3(0, 0, 0), Vec3(1, 2, 0)), TargetStatus::kParallel);
  EXPECT_EQ(status_of(plane, Vec3(0, 0, -5), Vec3(1, 2, 0)), TargetStatus::kParallel);
  EXPECT_EQ(status_of(plane, Vec3(0, 0, 0), Vec3(0, 0, 1)), TargetStatus::kBehind);
  TargetOptions near;
  near.max_range = 4.9;
  EXPECT_EQ(status_of(plane, Vec3(0, 0, 0), Vec3(0, 0, -1), near), TargetStatus::kMiss);
  near.max_range = 5.0;
  EXPECT_EQ(status_of(plane, Vec3(0, 0, 0), Vec3(0, 0, -1), near), TargetStatus::kHit);
}

// Erratum: the paper's eq 3 has no t ≥ 0, so that an axis that points away still finds a target.
TEST(FindTargets, PrintedEquation3FindsATargetBehindTheCamera) {
  const Plane plane(Vec3::UnitZ(), -5.0);
  const Vec3 p(0, 0, 0), d(0, 0, 1);
  const double printed = -(plane.normal().dot(p) - plane.offset()) / plane.normal().dot(d);
  EXPECT_EQ(printed, -5.0);
  EXPECT_EQ((p + printed * d).z(), -5.0) << "on the plane, yet behind the camera";
  EXPECT_EQ(status_of(plane, p, d), TargetStatus::kBehind);
}

// Erratum: in the normal form with d ≥ 0 the plane's m points down for a vehicle above the bottom.
TEST(FindTargets, APlanesNormalIsOnTheSideOfUpWhicheverWayItIsWritten) {
  const Plane printed(-Vec3::UnitZ(), 5.0);
  EXPECT_EQ(find_targets(printed, axis(Vec3::Zero(), Vec3(0, 0, -1))).normal[0], Vec3::UnitZ());
  const Plane wall(Vec3::UnitX(), 3.0);
  EXPECT_EQ(find_targets(wall, axis(Vec3::Zero(), Vec3(1, 0, 0))).normal[0], Vec3::UnitX());
}

TEST(FindTargets, SaysGrazingBeyondTheStatedAngleAndKeepsThePoint) {
  const Plane plane(Vec3::UnitZ(), -5.0);
  TargetOptions options;
  options.grazing_angle = kPi / 4;
  EXPECT_EQ(status_of(plane, Vec3::Zero(), Vec3(0.99, 0, -1), options), TargetStatus::kHit);
  const Targets targets = find_targets(plane, axis(Vec3::Zero(), Vec3(1.01, 0, -1)), options);
  EXPECT_EQ(targets.status[0], TargetStatus::kGrazing);
  EXPECT_NEAR(targets.point[0].x(), 5.05, 1e-12);
  // From beneath: beyond π/2 whatever the axis.
  const Targets beneath = find_targets(plane, axis(Vec3(0, 0, -9), Vec3(0, 0, 1)));
  EXPECT_EQ(beneath.status[0], TargetStatus::kGrazing);
  EXPECT_DOUBLE_EQ(beneath.incidence[0], kPi);
}

TEST(FindTargets, MeetsAMeshWithBarycentricCoordinatesOfEquation4) {
  const Vec3 shift(620153, 7246506, -52);
  const Scene scene =
      scene_of(grid([](double x, double y) { return 0.1 * x - 0.2 * y; }, 0, 4, 4, 0, 4, 4, shift));
  const Vec3 p = shift + Vec3(1.3, 2.1, 30), d(0.05, -0.02, -1);
  const Targets targets = find_targets(scene, axis(p, d));
  ASSERT_EQ(targets.status[0], TargetStatus::kHit);
  const TriangleMesh& mesh = scene.meshes()[0];
  const Vec3 uvw = targets.barycentric[0];
  EXPECT_NEAR(uvw.sum(), 1.0, 1e-12);
  const auto t = targets.triangle[0];
  const Vec3 point = shift + uvw[2] * (mesh.corner(t, 0) - shift) +
                     uvw[0] * (mesh.corner(t, 1) - shift) + uvw[1] * (mesh.corner(t, 2) - shift);
  EXPECT_NEAR((point - targets.point[0]).norm(), 0.0, 1e-8);
  EXPECT_NEAR((p + targets.range[0] * d.normalized() - targets.point[0]).norm(), 0.0, 1e-8);
  EXPECT_NEAR((targets.normal[0] - Vec3(-0.1, 0.2, 1).normalized()).norm(), 0.0, 1e-9);
}

// Erratum: eq 7–9 name neither t ≥ 0 nor the nearest of several triangles.
TEST(FindTargets, PrintedConditions7To9AreMetByTrianglesBehindAndBeyond) {
  const auto layer = [](double z) {
    return grid([z](double, double) { return z; }, 0, 1, 1, 0, 1, 1);
  };
  const Scene scene({layer(3.0), layer(-2.0), layer(-1.0)}, 1);
  const Vec3 p(0.6, 0.3, 0), d(0, 0, -1);
  int printed = 0;
  for (const TriangleMesh& mesh : scene.meshes()) {
    const Vec3 v0 = mesh.corner(0, 0), e1 = mesh.corner(0, 1) - v0, e2 = mesh.corner(0, 2) - v0;
    const double det = d.cross(e2).dot(e1);  // eq 6
    const double u = d.cross(e2).dot(p - v0) / det, v = (p - v0).cross(e1).dot(d) / det;
    printed += u >= 0 && u <= 1 && v >= 0 && v <= 1 && u + v <= 1 ? 1 : 0;
  }
  EXPECT_EQ(printed, 3) << "all three meet the printed conditions";
  const Targets targets = find_targets(scene, axis(p, d));
  EXPECT_EQ(targets.mesh[0], 2) << "the nearest one ahead";
  EXPECT_EQ(targets.range[0], 1.0);
}

TEST(FindTargets, DistinguishesAHoleFromTheEdgeOfTheSurvey) {
  const auto stripe = [](int c, int) { return c < 4 || c > 5; };  // lost: 4 < x < 6, open in y
  const Scene lost = scene_of(grid(kFlat, 0, 10, 10, 0, 10, 10, Vec3::Zero(), stripe));
  const auto square = [](int c, int r) { return c < 4 || c > 5 || r < 4 || r > 5; };
  const Scene hole = scene_of(grid(kFlat, 0, 10, 10, 0, 10, 10, Vec3::Zero(), square));
  const Vec3 straight(0, 0, -1);
  for (const Scene& scene : {lost, hole}) {
    EXPECT_EQ(status_of(scene, Vec3(5, 5, 0), straight), TargetStatus::kHole);
    EXPECT_EQ(status_of(scene, Vec3(3, 5.2, -4), Vec3(2, 0, -1)), TargetStatus::kHole) << "slanted";
    EXPECT_EQ(status_of(scene, Vec3(5, 2.5, -2), Vec3(0.1, 2.5, -3)), TargetStatus::kHole)
        << "along the stripe";
    EXPECT_EQ(status_of(scene, Vec3(12, 5, 0), straight), TargetStatus::kMiss) << "past the edge";
    EXPECT_EQ(status_of(scene, Vec3(5, 5, 0), Vec3(1, 0, 0)), TargetStatus::kMiss) << "level";
    EXPECT_EQ(status_of(scene, Vec3(9, 5, -4), Vec3(2, 0, -1)), TargetStatus::kMiss)
        << "slanted, past the edge";
    EXPECT_EQ(status_of(scene, Vec3(2, 5, 0), Vec3(0, 0, 1)), TargetStatus::kBehind);
    EXPECT_EQ(status_of(scene, Vec3(5, 5, 0), Vec3(0, 0, 1)), TargetStatus::kMiss)
        << "the gap lies behind";
  }
}

TEST(FindTargets, MovesAimsOfTheVehicle) {
  TargetOptions options;
  options.reference.world_from_vehicle =
      Eigen::Translation3d(10, 20, -30) * Eigen::AngleAxisd(kPi / 2, Vec3::UnitZ());
  const Plane plane(Vec3::UnitZ(), -35.0);
  const Aims aims = axis(Vec3(1, 0, 0), Vec3(1, 0, -1));
  EXPECT_NEAR((find_targets(plane, aims, options).point[0] - Vec3(10, 26, -35)).norm(), 0, 1e-12);
  options.reference.frame = AimsFrame::kWorld;
  EXPECT_NEAR((find_targets(plane, aims, options).point[0] - Vec3(36, 0, -35)).norm(), 0, 1e-12);
}

TEST(FindTargets, TakesDirectionsOfAnyLengthAndNoAims) {
  const Plane plane(Vec3::UnitZ(), -5.0);
  for (const double length : {1e-300, 1e-3, 1e3, 1e300}) {
    const Targets targets = find_targets(plane, axis(Vec3::Zero(), length * Vec3(0, 3, -4)));
    EXPECT_NEAR(targets.range[0], 6.25, 1e-12);
  }
  EXPECT_EQ(find_targets(plane, Aims(0, 6)).size(), 0U);
}

TEST(FindTargets, RefusesWhatIsNotAnAim) {
  const Plane plane(Vec3::UnitZ(), -5.0);
  EXPECT_THROW(find_targets(plane, axis(Vec3::Zero(), Vec3::Zero())), std::invalid_argument);
  EXPECT_THROW(find_targets(plane, axis(Vec3(NAN, 0, 0), Vec3::UnitZ())), std::invalid_argument);
  EXPECT_THROW(find_targets(plane, axis(Vec3::Zero(), Vec3(0, INFINITY, 0))),
               std::invalid_argument);
  TargetOptions options;
  options.reference.world_from_vehicle.linear() *= 2.0;
  EXPECT_THROW(find_targets(plane, down({{0, 0}}), options), std::invalid_argument);
  options = {};
  options.reference.world_from_vehicle.linear().col(0) *= -1.0;
  EXPECT_THROW(find_targets(plane, down({{0, 0}}), options), std::invalid_argument) << "mirrored";
  options = {};
  options.grazing_angle = 0.0;
  EXPECT_THROW(find_targets(plane, down({{0, 0}}), options), std::invalid_argument);
  options = {};
  options.max_range = NAN;
  EXPECT_THROW(find_targets(plane, down({{0, 0}}), options), std::invalid_argument);
}

TEST(AimsReference, TurnsAimsIntoTheWorldAndKnowsUp) {
  AimsReference reference;
  reference.world_from_vehicle.linear() =
      Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()).toRotationMatrix();
  reference.world_from_vehicle.translation() = Vec3(1, 2, 3);
  Aims world = reference.to_world(axis({0, 0, 1}, {0, 0, -2}));
  EXPECT_NEAR((Vec3(world.row(0).head<3>()) - Vec3(1, 1, 3)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((Vec3(world.row(0).tail<3>()) - Vec3(0, 1, 0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(reference.up(), Vec3::UnitZ());
  reference.vertical = Vertical::kVehicle;
  EXPECT_NEAR((reference.up() - Vec3(0, -1, 0)).norm(), 0.0, 1e-15);
  reference.frame = AimsFrame::kWorld;
  world = reference.to_world(axis({0, 0, 1}, {0, 0, -2}));
  EXPECT_EQ(Vec3(world.row(0).head<3>()), Vec3(0, 0, 1));
}

}  // namespace
}  // namespace bathyal
