// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/candidate_set.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/selection/decisions.hpp"
#include "bathyal/selection/internal/subset_search.hpp"

namespace bathyal::selection {
namespace {

constexpr Index kRows = 200;

Eigen::MatrixXd random_columns(std::uint64_t seed, Index columns) {
  Eigen::MatrixXd out(kRows, columns);
  for (Index c = 0; c < columns; ++c) {
    RandomStream random(seed, static_cast<std::uint64_t>(c));
    for (Index r = 0; r < kRows; ++r) out(r, c) = random.normal();
  }
  return out;
}

Term named(const std::string& effect, int joint) {
  return {effect, joint, effect + std::to_string(joint), effect, 4.0};
}

constexpr double kPlausible = 1e6;  ///< so large that the prior has no effect

/// Three base columns, six candidates of two columns each; the residual is made of the second and
/// the fifth one, of the base, and of noise of variance 1.
class CandidateSetTest : public ::testing::Test {
 protected:
  CandidateSetTest() : base_(random_columns(1, 3)), basis_(orthonormal(base_)) {
    for (int f = 0; f < 6; ++f) {
      terms_.push_back(named("effect", f));
      ids_.push_back(f);
      columns_.push_back(kPlausible * random_columns(static_cast<std::uint64_t>(10 + f), 2));
    }
    residual_ = base_ * Eigen::Vector3d(5.0, -3.0, 2.0) +
                columns_[1] * Eigen::Vector2d(1.0, 0.5) / kPlausible +
                columns_[4] * Eigen::Vector2d(-0.7, 0.4) / kPlausible + random_columns(99, 1);
  }
  CandidateSet candidates(int threads = 1) const {
    return {basis_, residual_, kRows - 3.0, ids_, terms_, columns_, threads};
  }

  Eigen::MatrixXd base_, basis_;
  std::vector<Term> terms_;
  std::vector<int> ids_;
  std::vector<Eigen::MatrixXd> columns_;
  Eigen::VectorXd residual_;
};

TEST_F(CandidateSetTest, ResidualSumIsThatOfLeastSquares) {
  const CandidateSet p = candidates();
  const std::vector<int> set{1, 4};
  Eigen::MatrixXd all(kRows, 7);
  all << base_, columns_[1], columns_[4];
  const Eigen::VectorXd values = all.colPivHouseholderQr().solve(residual_);
  const auto fit = p.evaluate(set);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->residual_sum, (residual_ - all * values).squaredNorm(), 1e-9);
  EXPECT_EQ(fit->dof, kRows - 7.0);
}

TEST_F(CandidateSetTest, WaldStatisticIsTheIncreaseWithoutTheMember) {
  const CandidateSet p = candidates();
  const std::vector<int> both{1, 4}, alone{4};
  const auto fit = p.evaluate(both);
  const auto without = p.evaluate(alone);
  EXPECT_NEAR(fit->f[0] * 2.0 * fit->noise(), without->residual_sum - fit->residual_sum, 1e-9);
}

TEST_F(CandidateSetTest, ScoreFollowsItsFormula) {
  const CandidateSet p = candidates();
  const std::vector<int> set{1, 4};
  const auto fit = p.evaluate(set);
  ASSERT_TRUE(fit);
  double score = -0.5 * p.dof() * std::log(fit->residual_sum);
  for (const double f : fit->f) {
    score -= std::log1p(f) + f / (1.0 + f) + std::log(4.0) +
             Decisions::kTermPenalty;  // two columns, four trials
  }
  EXPECT_NEAR(fit->score, score, 1e-9);
}

TEST_F(CandidateSetTest, ForwardScoresAreExactForTheFirstMember) {
  const CandidateSet p = candidates();
  const Eigen::VectorXd quick = p.forward_scores({});
  for (int m = 0; m < p.size(); ++m) {
    const std::vector<int> alone{m};
    EXPECT_NEAR(quick[m], p.evaluate(alone)->score, 1e-9);
  }
}

TEST_F(CandidateSetTest, MarginalScoreOfASingleMemberIsItsGain) {
  const CandidateSet p = candidates();
  for (int m = 0; m < p.size(); ++m) {
    const std::vector<int> alone{m};
    const auto fit = p.evaluate(alone);
    EXPECT_NEAR(p.marginal_score(alone, *fit, 0), fit->score - p.evaluate({})->score, 1e-9);
  }
}

TEST_F(CandidateSetTest, ExchangeScoresAreForwardScoresOfTheRest) {
  // Up to the change of the others' penalties when a member is removed, which is the same for all.
  const CandidateSet p = candidates();
  const std::vector<int> both{1, 4}, rest{4};
  const Eigen::VectorXd forward = p.forward_scores(rest);
  const Eigen::MatrixXd replacement = p.exchange_scores(both);
  const double change = replacement(0, 0) - forward[0];
  EXPECT_LT(std::abs(change), 3.0);
  for (const int m : {2, 3, 5}) EXPECT_NEAR(replacement(0, m), forward[m] + change, 1e-9) << m;
  EXPECT_TRUE(std::isinf(replacement(0, 1)) && std::isinf(replacement(0, 4)));
}

TEST_F(CandidateSetTest, PriorShrinksValues) {
  // At the plausible size the column is three standard deviations of noise long: the least-squares
  // value shrinks by 1 + 1 / 9, and the prior penalty counts as unexplained.
  columns_[0] = random_columns(97, 1);
  columns_[0] -= basis_ * (basis_.transpose() * columns_[0]);
  columns_[0] *= 3.0 / columns_[0].norm();
  residual_ = 2.0 * columns_[0];
  const CandidateSet p = candidates();
  const std::vector<int> one{0};
  const double unexplained = 1.0 - 1.0 / (1.0 + 1.0 / 9.0);
  EXPECT_NEAR(p.evaluate(one)->residual_sum, 36.0 * unexplained, 1e-9);
}

TEST_F(CandidateSetTest, CollinearTermsAreNotSelectedTogether) {
  for (auto& columns : columns_) columns /= kPlausible;
  columns_[2] = columns_[1];
  const CandidateSet p = candidates();
  const std::vector<int> both{1, 2};
  EXPECT_FALSE(p.evaluate(both));
}

TEST_F(CandidateSetTest, ATermBelowNoiseAtItsLargestIsNoCandidate) {
  columns_[2] = 0.9 * random_columns(95, 1) / random_columns(95, 1).norm();
  EXPECT_EQ(candidates().size(), 5);
}

TEST_F(CandidateSetTest, BeamSearchFindsTheTrueSet) {
  EXPECT_EQ(beam_search(candidates()), (std::vector<int>{1, 4}));
}

TEST_F(CandidateSetTest, NoiseAloneSelectsNothing) {
  residual_ = random_columns(98, 1);
  EXPECT_TRUE(beam_search(candidates()).empty());
}

TEST_F(CandidateSetTest, ATermInTheSpanOfTheBaseIsNoCandidate) {
  columns_[2] = base_ * Eigen::MatrixXd::Random(3, 2);
  const CandidateSet p = candidates();
  EXPECT_EQ(p.size(), 5);
  for (int m = 0; m < p.size(); ++m) EXPECT_NE(p.term_index(m), 2);
}

TEST_F(CandidateSetTest, CollinearTermsAreAlternatives) {
  columns_[2] = columns_[1] * Eigen::Matrix2d{{1.0, 1.0}, {0.0, 2.0}};
  const CandidateSet p = candidates();
  const std::vector<int> set = beam_search(p);
  ASSERT_EQ(set.size(), 2u);
  bool found = false;
  for (const Alternative& alternative : find_alternatives(p, set)) {
    if (alternative.member == 4 || alternative.odds < 0.5) continue;
    found = true;
    EXPECT_EQ(alternative.member + alternative.replacement, 3);
    EXPECT_NEAR(alternative.odds, 1.0, 1e-6);
  }
  EXPECT_TRUE(found);
}

/// A column more makes it less probable, by e^-1, and excludes nothing.
TEST_F(CandidateSetTest, AWiderTermThatFitsAsWellIsAnAlternative) {
  const Eigen::MatrixXd same = columns_[1];
  columns_[2].resize(same.rows(), same.cols() + 1);
  columns_[2] << same, kPlausible * random_columns(97, 1);
  const CandidateSet p = candidates();
  double odds = 0.0;
  for (const Alternative& alternative : find_alternatives(p, std::vector<int>{1, 4})) {
    if (alternative.member == 1 && alternative.replacement == 2) odds = alternative.odds;
  }
  EXPECT_GT(odds, 0.3);
}

TEST_F(CandidateSetTest, ATermThatAddsToAMemberIsNoAlternative) {
  const CandidateSet p = candidates();
  const std::vector<int> incomplete{1};
  for (const Alternative& alternative : find_alternatives(p, incomplete))
    EXPECT_LT(alternative.odds, 0.05);
}

TEST_F(CandidateSetTest, IsTheSameForAnyNumberOfThreads) {
  const std::vector<int> set{0, 1, 2, 3, 4, 5};
  EXPECT_EQ(candidates(1).evaluate(set)->score, candidates(2).evaluate(set)->score);
}

}  // namespace
}  // namespace bathyal::selection
