// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bathyal/scene/scene.hpp"
#include "instances.hpp"
#include "meshes.hpp"
#include "rays.hpp"

namespace bathyal {
namespace {

using test::Cast;
using test::EveryLevel;
using test::expect_same_bytes;
using test::random_pose;
using test::random_rays;
using test::Rays;
using test::stones;
using test::view;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Rays fans(const Vec3& first, const Vec3& step) {
  Rays rays{PointMatrix(20 * 200, 3), PointMatrix(20 * 200, 3)};
  for (int i = 0; i < 20 * 200; ++i) {
    const double angle = -1.4 + 2.8 * (i % 200) / 199.0;
    rays.origins.row(i) = first + (i / 200) * step;
    rays.directions.row(i) = Vec3(std::sin(angle), 0.02, -std::cos(angle));
  }
  return rays;
}

/// The same triangles and ranges; where they differ, both are met at the same range (borders of
/// triangles and places where two bodies cut each other), and that rarely.
void expect_same_hits(const std::vector<RayHit>& a, const std::vector<RayHit>& b, double size,
                      int least_hits) {
  ASSERT_EQ(a.size(), b.size());
  int met = 0, other = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].triangle >= 0, b[i].triangle >= 0) << i;
    if (a[i].triangle < 0) continue;
    ++met;
    ASSERT_NEAR(a[i].range, b[i].range, 1e-9 * (size + a[i].range)) << i;
    if (a[i].mesh != b[i].mesh || a[i].triangle != b[i].triangle) ++other;
  }
  EXPECT_GE(met, least_hits);
  EXPECT_LE(other, met / 1000);
}

TEST(Instances, AThousandClonesAreTheMergedMesh) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(6.2e5, 7.2e6, -52)}) {
    const Cast cast = stones(1000, offset, 3);
    const Scene scene = cast.scene(), merged = cast.merged();
    const double size = offset.norm() > 0 ? 100.0 : 1.0;  // coordinates there round to 1e-9 m
    for (const Rays& rays : {random_rays(6000, offset + Vec3(30, 25, 2), Vec3(32, 27, 6), 5),
                             fans(offset + Vec3(30, 2, 12), Vec3(0, 2.3, 0))}) {
      expect_same_hits(scene.cast(view(rays.origins), view(rays.directions), 2),
                       merged.cast(view(rays.origins), view(rays.directions), 2), size, 1400);
      const PointMatrix ends = rays.origins + 8.0 * rays.directions;
      EXPECT_EQ(scene.occluded(view(rays.origins), view(ends), 2),
                merged.occluded(view(rays.origins), view(ends), 2));
    }
  }
}

TEST(Instances, RaysThatGrazeTheEndsOfABodyMeetIt) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(6.2e5, 7.2e6, -52)}) {
    const Cast cast = stones(200, offset, 3);
    const Scene merged = cast.merged();
    for (std::int32_t m = 1; m <= 200; ++m) {
      const auto row = static_cast<std::size_t>(m);
      const Scene alone({cast.meshes[row]}, {cast.poses[row]}, {cast.scales[row]});
      const PointView vertices = merged.meshes()[row].vertices();
      const Vec3 middle = vertices.colwise().mean();
      for (int axis = 0; axis < 3; ++axis) {
        Index most = 0;
        vertices.col(axis).maxCoeff(&most);
        const Vec3 end = vertices.row(most).transpose();
        const Vec3 inside = end + 1e-4 * (middle - end);
        RandomStream random(37, static_cast<std::uint64_t>(3 * m + axis));
        Vec3 across = test::random_vector(random);
        across[axis] = 0.0;
        EXPECT_EQ(alone.cast(inside - 9.0 * across.normalized(), across).mesh, 0) << m;
      }
    }
  }
}

TEST(Instances, AtTheIdentityTheBytesAreThoseWithoutPoses) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(6.2e5, 7.2e6, -52), Vec3(-1e7, 1e7, 1e7)}) {
    Cast cast;
    cast.add(test::seabed(60, 50, offset));
    cast.add(test::sphere(3, 2.0, offset + Vec3(20, 20, 1)));
    cast.add(test::box(Vec3(1, 2, 3), offset + Vec3(40, 20, 1)));
    const Scene plain(cast.meshes);
    for (const Scene& scene : {cast.scene(), plain.with_poses(cast.poses)}) {
      for (Rays rays : {random_rays(6000, offset + Vec3(30, 25, 2), Vec3(32, 27, 6), 7),
                        fans(offset + Vec3(30, 2, 12), Vec3(0, 2.3, 0))}) {
        for (Index i = 0; i < 200; i += 3) rays.directions.row(i) *= i % 2 ? 0x1p+600 : 0x1p-600;
        const auto truth = plain.cast(view(rays.origins), view(rays.directions), 1);
        const PointMatrix ends = rays.origins + 8.0 * rays.directions;
        const auto hidden = plain.occluded(view(rays.origins), view(ends), 1);
        EveryLevel().run([&](const std::string& level) {
          expect_same_bytes(scene.cast(view(rays.origins), view(rays.directions), 2), truth, level);
          EXPECT_EQ(scene.occluded(view(rays.origins), view(ends), 2), hidden) << level;
        });
      }
    }
  }
}

TEST(Instances, OfEqualRangesTheLowestRowIsMetAtTheIdentityToo) {
  // The second row is most of the scene, the third all of it again. The first is a part of it, its
  // triangles otherwise wound, with a spike that lets rays from above enter its box first.
  const TriangleMesh all = test::seabed(60, 50);
  const Index count = all.triangle_count() / 3;
  PointMatrix vertices(all.vertex_count() + 3, 3);
  vertices << all.vertices(), 0, 0, 0, 0.01, 0, 0, 0, 0, 20;
  TriangleMatrix part(count + 1, 3);
  part.topRows(count).col(0) = all.triangles().topRows(count).col(1);
  part.topRows(count).col(1) = all.triangles().topRows(count).col(2);
  part.topRows(count).col(2) = all.triangles().topRows(count).col(0);
  const auto last = static_cast<std::int32_t>(all.vertex_count());
  part.row(count) << last, last + 1, last + 2;
  const std::vector<TriangleMesh> meshes = {
      {Points(std::move(vertices)), Triangles(std::move(part))}, all, all};
  const Scene plain(meshes), scene = plain.with_poses(std::vector<Pose>(3, Pose::Identity()));
  for (const Rays& rays : {random_rays(6000, Vec3(30, 25, 2), Vec3(32, 27, 6), 7),
                           fans(Vec3(30, 2, 12), Vec3(0, 2.3, 0))}) {
    const auto truth = plain.cast(view(rays.origins), view(rays.directions), 1);
    int met[3] = {0, 0, 0};
    for (const RayHit& hit : truth) {
      if (hit.mesh >= 0) ++met[hit.mesh];
    }
    EXPECT_GT(std::min(met[0], met[1]), 100);
    EveryLevel().run([&](const std::string& level) {
      expect_same_bytes(scene.cast(view(rays.origins), view(rays.directions), 2), truth, level);
    });
  }
}

TEST(Instances, TheSameBytesOnThreadsAndLevels) {
  const Cast cast = stones(300, Vec3(0, 0, 0), 11);
  const Scene scene = cast.scene(1), again = cast.scene(8);
  for (Rays rays : {random_rays(9000, Vec3(30, 25, 2), Vec3(32, 27, 6), 13),
                    fans(Vec3(30, 2, 12), Vec3(0, 2.3, 0))}) {
    for (Index i = 0; i < 900; i += 7) rays.directions.row(i) *= i % 2 ? 0x1p+600 : 0x1p-600;
    const auto truth = scene.cast(view(rays.origins), view(rays.directions), 1);
    for (Index i = 0; i < 50; ++i) {  // one ray is what it is among others
      const RayHit one = scene.cast(rays.origins.row(i), rays.directions.row(i));
      expect_same_bytes({one}, {truth[static_cast<std::size_t>(i)]}, "one ray");
    }
    EveryLevel().run([&](const std::string& level) {
      for (const int threads : {1, 8}) {
        expect_same_bytes(again.cast(view(rays.origins), view(rays.directions), threads), truth,
                          level + " on " + std::to_string(threads));
      }
    });
  }
}

TEST(Instances, OneTurnedAndScaledBoxIsWhereArithmeticPutsIt) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix();
  pose.translation() = Vec3(10, 20, 30);
  const Scene scene({test::box(Vec3(1, 2, 3))}, {pose}, {2.0});
  // Half sizes 2, 4, 6, turned: 4 along x, 2 along y.
  EXPECT_NEAR(scene.cast(Vec3(0, 20.3, 30.2), Vec3(7, 0, 0)).range, 6.0, 1e-14);
  EXPECT_NEAR(scene.cast(Vec3(10.4, 0, 30.2), Vec3(0, 7, 0)).range, 18.0, 1e-14);
  const RayHit down = scene.cast(Vec3(13.5, 21.5, 100), Vec3(0, 0, -0.1));
  EXPECT_NEAR(down.range, 64.0, 1e-13);
  EXPECT_NEAR((hit_point(scene, down) - Vec3(13.5, 21.5, 36)).norm(), 0.0, 1e-13);
  EXPECT_NEAR((hit_normal(scene, down) - Vec3(0, 0, 1)).norm(), 0.0, 1e-15);
  EXPECT_EQ(scene.cast(Vec3(10, 22.1, 100), Vec3(0, 0, -1)).triangle, -1);
  const PointMatrix from = (PointMatrix(1, 3) << 0, 20, 30).finished();
  const PointMatrix to = (PointMatrix(2, 3) << 6.1, 20, 30, 5.9, 20, 30).finished();
  EXPECT_EQ(scene.occluded(view(from), view(to)), (std::vector<bool>{true, false}));
}

TEST(Instances, OfEqualRangesTheLowestRowIsMet) {
  const TriangleMesh mesh = test::sphere(2, 1.0, Vec3(0, 0, 0));
  RandomStream random(3, 0);
  const Pose pose = random_pose(random, Vec3(1, 2, 3), Vec3(1, 1, 1));
  const Pose far = random_pose(random, Vec3(50, 2, 3), Vec3(1, 1, 1));
  const Rays rays = random_rays(2000, pose.translation(), Vec3(2, 2, 2), 1);
  const Scene one({mesh}, {pose});
  const Scene several({mesh, mesh, mesh, mesh, mesh}, {far, pose, pose, far, pose});
  auto truth = one.cast(view(rays.origins), view(rays.directions));
  const auto hits = several.cast(view(rays.origins), view(rays.directions));
  int met = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (truth[i].triangle < 0) continue;
    ++met;
    EXPECT_EQ(hits[i].mesh, 1);
    EXPECT_EQ(hits[i].triangle, truth[i].triangle);
    EXPECT_EQ(hits[i].range, truth[i].range);
  }
  EXPECT_GT(met, 100);
}

TEST(Instances, MovedAgainSharesTheMeshesAndLeavesTheFirstAlone) {
  const Cast cast = stones(50, Vec3(0, 0, 0), 17);
  const Scene first = cast.scene();
  const Rays rays = random_rays(3000, Vec3(30, 25, 2), Vec3(32, 27, 6), 19);
  const auto before = first.cast(view(rays.origins), view(rays.directions));
  Cast moved = cast;
  for (std::size_t i = 1; i < moved.poses.size(); ++i) {
    RandomStream random(23, i);
    moved.poses[i] = random_pose(random, Vec3(30, 25, 0), Vec3(30, 25, 2));
  }
  const Scene later = first.with_poses(moved.poses);
  EXPECT_EQ(&later.meshes(), &first.meshes());
  EXPECT_EQ(later.scales(), first.scales());
  expect_same_bytes(later.cast(view(rays.origins), view(rays.directions)),
                    moved.scene().cast(view(rays.origins), view(rays.directions)), "made anew");
  expect_same_bytes(first.cast(view(rays.origins), view(rays.directions)), before, "the first");
  EXPECT_EQ(first.poses()[3].matrix(), cast.poses[3].matrix());
  EXPECT_EQ(later.poses()[3].matrix(), moved.poses[3].matrix());
}

TEST(Instances, ClonesCostNoMeshEach) {
  const TriangleMesh mesh = test::sphere(4, 1.0, Vec3(0, 0, 0));
  const std::vector<TriangleMesh> meshes(1000, mesh);
  const std::vector<Pose> poses(1000, Pose::Identity());
  EXPECT_LT(Scene(meshes, poses).memory(), Scene({mesh}).memory() + 1000 * 1000);
}

TEST(Instances, WithoutTrianglesAreNeverMet) {
  const TriangleMesh empty;
  const TriangleMesh mesh = test::box(Vec3(1, 1, 1));
  const Pose here = Pose::Identity();
  EXPECT_EQ(Scene({empty, empty}, {here, here}).cast(Vec3(0, 0, 5), Vec3(0, 0, -1)).triangle, -1);
  const Scene both({empty, mesh}, {here, here});
  EXPECT_EQ(both.cast(Vec3(0.1, 0.2, 5), Vec3(0, 0, -1)).mesh, 1);
  EXPECT_EQ(both.occluded(PointView(Vec3(0, 0, 5).eval().data(), 1, 3),
                          PointView(Vec3(0, 0, 0).eval().data(), 1, 3)),
            std::vector<bool>{true});
}

TEST(Instances, FarFromTheirOwnFrameAndFromTheWorlds) {
  // A mesh at survey coordinates brought near the origin, and one carried far out.
  Cast cast;
  Pose back = Pose::Identity();
  back.translation() = -Vec3(6.2e5, 7.2e6, -52);
  cast.add(test::seabed(60, 50, Vec3(6.2e5, 7.2e6, -52)), back);
  Pose out = Pose::Identity();
  out.translation() = Vec3(3e9, 0, 0);
  cast.add(test::sphere(3, 1.0, Vec3(0, 0, 0)), out, 1e3);
  const Scene scene = cast.scene();
  const Rays rays = random_rays(3000, Vec3(30, 25, 2), Vec3(32, 27, 6), 19);
  expect_same_hits(scene.cast(view(rays.origins), view(rays.directions)),
                   cast.merged().cast(view(rays.origins), view(rays.directions)), 10.0, 500);
  const RayHit far = scene.cast(Vec3(3e9, 12, 5e4), Vec3(0, 0, -1));
  EXPECT_EQ(far.mesh, 1);
  EXPECT_NEAR(far.range, 4.9e4, 10.0);
}

TEST(Instances, ANearlyRigidPoseIsTakenAsTheNearestRotation) {
  RandomStream random(29, 0);
  Pose pose = random_pose(random, Vec3(0, 0, 0), Vec3(1, 1, 1));
  const Eigen::Matrix3d exact = pose.linear();
  pose.linear() *= 1.0 + 3e-7;
  const Scene scene({test::sphere(3, 1.0, Vec3(0, 0, 0))}, {pose});
  EXPECT_LT((scene.poses()[0].linear() - exact).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Instances, WrongOnesAreRefusedByName) {
  const TriangleMesh mesh = test::box(Vec3(1, 1, 1));
  const Pose here = Pose::Identity();
  Pose torn = here, skewed = here, mirrored = here, gone = here;
  torn.translation().x() = kNan;
  skewed.linear()(0, 1) = 0.1;
  mirrored.linear()(2, 2) = -1.0;
  gone.translation().x() = 1e13;
  const auto message = [](const auto& make) {
    try {
      make();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  for (const Pose& bad : {torn, skewed, mirrored}) {
    EXPECT_NE(message([&] {
                Scene({mesh, mesh}, {here, bad});
              }).find("`poses[1]`"),
              std::string::npos);
  }
  EXPECT_NE(message([&] { Scene({mesh, mesh}, {here, gone}); }).find("1e12"), std::string::npos);
  EXPECT_NE(message([&] { Scene({mesh, mesh}, {here}); }).find("`poses`"), std::string::npos);
  EXPECT_NE(message([&] { Scene({mesh}).with_poses({}); }).find("`poses`"), std::string::npos);
  EXPECT_NE(message([&] { Scene({}, std::vector<Pose>()); }).find("`meshes`"), std::string::npos);
  for (const double bad : {0.0, -1.0, kNan, kInf, 1e-300, 1e300}) {
    EXPECT_NE(message([&] {
                Scene({mesh, mesh}, {here, here}, {1.0, bad});
              }).find("`scales[1]`"),
              std::string::npos);
  }
  EXPECT_NE(message([&] {
              Scene({mesh, mesh}, {here, here}, {1.0});
            }).find("`scales`"),
            std::string::npos);
}

}  // namespace
}  // namespace bathyal
