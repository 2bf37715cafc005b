// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/arm_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/arms.hpp"

namespace bathyal {
namespace {

std::span<const double> row_of(const JointMatrix& q, Index row) {
  return {q.data() + row * q.cols(), static_cast<std::size_t>(q.cols())};
}

Pose link_pose(const Arm& arm, const RowFrames& frames, int link) {
  const auto k = static_cast<std::size_t>(link);
  return frames.world_from_row[k] * arm.links()[k].row_from_link;
}

TEST(ArmShape, RowsBecomeSegmentsFromJointToJointAndToTheTool) {
  Arm arm = planar_arm();
  Pose flange_from_tool = Pose::Identity();
  flange_from_tool.translation() = Vec3(0.1, 0.0, 0.2);
  arm.set_tool(flange_from_tool);
  const std::vector<LinkCapsule> capsules = capsules_of_rows(arm, std::vector<double>{0.03});
  ASSERT_EQ(capsules.size(), 3U);
  const std::vector<double> q{kPi / 2, 0.0};
  const RowFrames frames = row_frames(arm, q);
  const Capsule upper = placed(arm, capsules[0], frames), lower = placed(arm, capsules[1], frames);
  EXPECT_EQ(capsules[0].link, 1);
  EXPECT_EQ(capsules[1].link, 2);
  EXPECT_EQ(upper.radius, 0.03);
  EXPECT_LT((upper.start - Vec3::Zero()).norm(), 1e-15);
  EXPECT_LT((upper.end - Vec3(0.0, 0.5, 0.0)).norm(), 1e-15);
  EXPECT_LT((lower.start - upper.end).norm(), 1e-15);
  const Capsule tool = placed(arm, capsules[2], frames);
  EXPECT_LT((tool.start - Vec3(0.0, 0.9, 0.0)).norm(), 1e-15);
  EXPECT_LT((tool.end - frames.world_from_tool.translation()).norm(), 1e-15);
}

TEST(ArmShape, SegmentsOfAnyArmAreOneChainFromRootToTool) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Arm arm = irregular_arm(seed);
    const JointMatrix q = random_poses(arm, 20, seed);
    const std::vector<LinkCapsule> capsules = capsules_of_rows(arm);
    for (Index i = 0; i < q.rows(); ++i) {
      const RowFrames frames = row_frames(arm, row_of(q, i));
      Vec3 end = frames.world_from_row[0].translation();
      for (const LinkCapsule& capsule : capsules) {
        const Capsule now = placed(arm, capsule, frames);
        EXPECT_LT((now.start - end).norm(), 1e-12);
        end = now.end;
      }
      EXPECT_LT((end - frames.world_from_tool.translation()).norm(), 1e-12);
    }
  }
}

TEST(ArmShape, NoPointMovesFartherThanTheBound) {
  double tightest = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Arm arm = irregular_arm(seed);
    const std::vector<LinkCapsule> capsules = capsules_of_rows(arm);
    const JointMatrix from = random_poses(arm, 40, seed);
    RandomStream random(seed, 1);
    for (Index i = 0; i < from.rows(); ++i) {
      const double size = i % 2 == 0 ? 0.01 : 1.0;
      std::vector<double> to, change;
      for (const double value : row_of(from, i)) {
        change.push_back(size * random.uniform());
        to.push_back(value + (random.uniform() < 0.5 ? -1.0 : 1.0) * change.back());
      }
      const RowFrames before = row_frames(arm, row_of(from, i)), after = row_frames(arm, to);
      const int observer = static_cast<int>(i) % static_cast<int>(arm.links().size());
      const Pose still =
          link_pose(arm, before, observer) * link_pose(arm, after, observer).inverse();
      for (const LinkCapsule& capsule : capsules) {
        const Capsule old = placed(arm, capsule, before);
        const Capsule now = in_frame(placed(arm, capsule, after), still);
        const double bound = displacement_bound(arm, before, capsule.link, observer, old, change);
        const double moved = std::max((now.start - old.start).norm(), (now.end - old.end).norm());
        // A start that is fixed in the link before moves less, or as seen from that link not at
        // all.
        if (capsule.start_link != capsule.link && observer >= capsule.link) continue;
        EXPECT_LE(moved, bound + 1e-12) << seed << " " << i << " " << capsule.link;
        if (bound > 0.0) tightest = std::max(tightest, moved / bound);
      }
    }
  }
  EXPECT_GT(tightest, 0.9);
}

TEST(ArmShape, Refusals) {
  const Arm arm = planar_arm();
  EXPECT_THROW(capsules_of_rows(arm, std::vector<double>{0.1, 0.1}), std::invalid_argument);
  EXPECT_THROW(capsules_of_rows(arm, std::vector<double>{-0.1}), std::invalid_argument);
  EXPECT_THROW(capsules_of_links(arm, std::vector<std::vector<Capsule>>(2)), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::vector<Capsule>> shapes(3);
  shapes[1].push_back({Vec3(nan, 0.0, 0.0), Vec3::Zero(), 0.1});
  EXPECT_THROW(capsules_of_links(arm, shapes), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
