// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/compensation/effect_sum.hpp"

#include <gtest/gtest.h>

#include "bathyal/compensation/fixed_effect.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

Pose rigid(const Arm& arm, const JointMatrix& q) {
  return row_frames(arm, {q.data(), static_cast<std::size_t>(q.size())}).world_from_tool;
}

TEST(EffectSum, AddsPerturbationsTimesTheirValues) {
  const Arm arm = irregular_arm(2);
  const JointMatrix q = random_poses(arm, 1, 4);
  const auto flange = static_cast<int>(arm.joints().size()) + 1;
  RowMatrix shift = RowMatrix::Zero(1, 6);
  shift(0, 2) = 1.0;
  const FixedEffect effect{{},
                           Eigen::Vector2d(0.02, 0.003),
                           {{{PerturbationSite::kJoint, 1, RowMatrix::Constant(1, 1, 2.0)}},
                            {{PerturbationSite::kFrame, flange, shift}}}};
  EffectSum sum(arm, 1);
  EXPECT_EQ(sum.chained[0], 0);
  sum.add(effect.perturbations, effect.values);
  sum.add(effect.perturbations, effect.values);
  EXPECT_EQ(sum.chained[0], 1);
  EXPECT_NEAR(sum.q(0, 1), 2.0 * 0.04, 1e-16);

  CorrectedFrames frames;
  compute_corrected_frames(arm, q.data(), sum, 0, frames);
  JointMatrix moved = q;
  moved(0, 1) += 0.08;
  Arm longer = arm;
  longer.set_tool(Pose(Eigen::Translation3d(0.0, 0.0, 0.006)) * arm.tool());
  EXPECT_LT((frames.world_from_tool.matrix() - rigid(longer, moved).matrix()).norm(), 1e-13);
}

}  // namespace
}  // namespace bathyal
