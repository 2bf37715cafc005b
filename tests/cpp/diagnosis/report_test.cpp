// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/internal/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/diagnosis/arm/internal/next_poses.hpp"
#include "bathyal/diagnosis/internal/model_check.hpp"
#include "diagnosis/small_arms.hpp"

namespace bathyal::diagnosis {
namespace {

/// Tips of an arm whose joint 2 has a wave of order 2.
Tracked wavy() {
  const Arm arm = three_joints();
  Tracked out;
  out.q = RowMatrix(100, 3);
  out.position = RowMatrix(100, 3);
  for (Index i = 0; i < out.q.rows(); ++i) {
    RandomStream random(7, static_cast<std::uint64_t>(i));
    for (Index j = 0; j < 3; ++j) out.q(i, j) = random.uniform(-2.0, 2.0);
    Eigen::VectorXd q = out.q.row(i);
    q[1] += 2e-3 * std::cos(2.0 * q[1]);
    const RowFrames frames = row_frames(arm, {q.data(), 3});
    for (Index axis = 0; axis < 3; ++axis) {
      out.position(i, axis) = frames.world_from_tool.translation()[axis] + 1e-4 * random.normal();
    }
  }
  return out;
}

class ReportTest : public ::testing::Test {
 protected:
  ReportTest()
      : arm_(three_joints()),
        measurement_(to_measurement(arm_, wavy())),
        model_(arm_, measurement_, {}, identify_, library_effects()),
        selected_(selection::select_terms(model_, {}, {})) {}

  Arm arm_;
  Measurement measurement_;
  IdentifyOptions identify_;
  ArmModel model_;
  selection::SelectionResult selected_;
};

TEST_F(ReportTest, VerdictFollowsFromUnexplainedStructureAndAlternatives) {
  ASSERT_EQ(selected_.terms.size(), 1U);
  DiagnoseOptions options;
  const Diagnosis found = report(model_, measurement_, arm_, selected_, options);
  EXPECT_EQ(found.verdict, Verdict::kNamed);
  EXPECT_EQ(found.effects[0].joint, 1);
  EXPECT_EQ(found.unexplained.dependence.kind, Dependence::Kind::kNone);
  ASSERT_FALSE(found.lack_of_fit_before.empty());
  EXPECT_NE(found.lack_of_fit_before[0].dependence.kind, Dependence::Kind::kNone);

  const int term = selected_.terms[0].term;
  selected_.alternatives = {{term, term + 1, 0.5}};
  const Diagnosis two = report(model_, measurement_, arm_, selected_, options);
  EXPECT_EQ(two.verdict, Verdict::kAmbiguous);
  EXPECT_EQ(two.ambiguous.size(), 2U);
  selected_.alternatives = {
      {term, term + 1, 0.9}, {term, term + 2, 0.8}, {term, term + 3, 0.7}, {term, term + 4, 0.6}};
  const Diagnosis four = report(model_, measurement_, arm_, selected_, options);
  EXPECT_EQ(four.ambiguous.size(), 4U);
  EXPECT_EQ(four.ambiguous.back().odds, 0.7);
  EXPECT_EQ(four.effects[0].alternatives.size(), 4U);
  // One in twelve is not enough against the other.
  selected_.alternatives = {{term, term + 1, 0.08}};
  EXPECT_EQ(report(model_, measurement_, arm_, selected_, options).verdict, Verdict::kNamed);
  selected_.alternatives = {{term, term + 1, 0.5}};
  options.rival_odds = 0.6;
  EXPECT_EQ(report(model_, measurement_, arm_, selected_, options).verdict, Verdict::kNamed);

  int structure = 0;
  while (!model_.terms()[static_cast<std::size_t>(structure)].lack_of_fit) ++structure;
  selected_.lack_of_fit.emplace_back().term = structure;
  selected_.unexplained = 0.5 * selected_.explained;
  const Diagnosis unknown = report(model_, measurement_, arm_, selected_, options);
  EXPECT_EQ(unknown.verdict, Verdict::kUnknown);
  EXPECT_EQ(to_text(unknown.unexplained.dependence),
            model_.terms()[static_cast<std::size_t>(structure)].effect);
}

TEST_F(ReportTest, ModelThatDisagreesWithItsResidualsIsRefused) {
  Diagnosis found = report(model_, measurement_, arm_, selected_, {});
  EXPECT_NO_THROW(check_model(found, model_, measurement_, 1));
  found.residuals_after(0, 7) += 1e-6;
  EXPECT_THROW(check_model(found, model_, measurement_, 1), Error);
}

TEST_F(ReportTest, NextPosesDistinguishTheAlternativesOnly) {
  EXPECT_EQ(next_poses(model_, selected_, 2.0, 5).rows(), 0);
  const int term = selected_.terms[0].term;
  int other = 0;
  while (model_.terms()[static_cast<std::size_t>(other)].effect != "backlash" &&
         model_.terms()[static_cast<std::size_t>(other)].effect != "joint_scale") {
    ++other;
  }
  selected_.alternatives = {{term, other, 0.5}};
  const RowMatrix q = next_poses(model_, selected_, 0.05, 5);
  ASSERT_EQ(q.rows(), 5);
  for (Index j = 0; j < 3; ++j) {
    EXPECT_GE(q.col(j).minCoeff(), measurement_.q.col(j).minCoeff());
    EXPECT_LE(q.col(j).maxCoeff(), measurement_.q.col(j).maxCoeff());
  }
  EXPECT_EQ(model_.found().size(), 1U);
  EXPECT_EQ(model_.found()[0].variant.effect, model_.variant(term).effect);  // fitted as before
}

}  // namespace
}  // namespace bathyal::diagnosis
