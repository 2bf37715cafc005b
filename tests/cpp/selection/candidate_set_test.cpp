// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/candidate_set.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/selection/internal/subset_search.hpp"

namespace bathyal {
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

Form named(const std::string& effect, int joint) {
  return {effect, joint, effect + std::to_string(joint), effect, 4.0};
}

constexpr double kPlausible = 1e6;  ///< so large that it holds nothing

/// Three base columns, six candidates of two columns each; the misfit is made of the second and the
/// fifth one, some of the base, and noise of size 1.
class PoolTest : public ::testing::Test {
 protected:
  PoolTest() : base_(random_columns(1, 3)), basis_(orthonormal(base_)) {
    for (int f = 0; f < 6; ++f) {
      forms_.push_back(named("effect", f));
      ids_.push_back(f);
      columns_.push_back(kPlausible * random_columns(static_cast<std::uint64_t>(10 + f), 2));
    }
    misfit_ = base_ * Eigen::Vector3d(5.0, -3.0, 2.0) +
              columns_[1] * Eigen::Vector2d(1.0, 0.5) / kPlausible +
              columns_[4] * Eigen::Vector2d(-0.7, 0.4) / kPlausible + random_columns(99, 1);
  }
  Pool pool(int threads = 1) const {
    return {basis_, misfit_, kRows - 3.0, ids_, forms_, columns_, threads};
  }

  Eigen::MatrixXd base_, basis_;
  std::vector<Form> forms_;
  std::vector<int> ids_;
  std::vector<Eigen::MatrixXd> columns_;
  Eigen::VectorXd misfit_;
};

TEST_F(PoolTest, WhatIsLeftIsThatOfLeastSquares) {
  const Pool p = pool();
  const std::vector<int> set{1, 4};
  Eigen::MatrixXd all(kRows, 7);
  all << base_, columns_[1], columns_[4];
  const Eigen::VectorXd values = all.colPivHouseholderQr().solve(misfit_);
  const auto fit = p.judge(set);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->left, (misfit_ - all * values).squaredNorm(), 1e-9);
  EXPECT_EQ(fit->freedom, kRows - 7.0);
}

TEST_F(PoolTest, WaldIsWhatGoesWithoutTheMember) {
  const Pool p = pool();
  const std::vector<int> both{1, 4}, alone{4};
  const auto fit = p.judge(both);
  const auto without = p.judge(alone);
  EXPECT_NEAR(fit->f[0] * 2.0 * fit->noise(), without->left - fit->left, 1e-9);
}

TEST_F(PoolTest, TheScoreIsThatOfTheContract) {
  const Pool p = pool();
  const std::vector<int> set{1, 4};
  const auto fit = p.judge(set);
  ASSERT_TRUE(fit);
  double score = -0.5 * p.freedom() * std::log(fit->left);
  for (const double f : fit->f) {
    score -= std::log1p(f) + f / (1.0 + f) + std::log(4.0) + kNameCost;  // two columns, four trials
  }
  EXPECT_NEAR(fit->score, score, 1e-9);
}

TEST_F(PoolTest, QuickScoresAreTheTrueOnesForTheFirstMember) {
  const Pool p = pool();
  const Eigen::VectorXd quick = p.scores_beside({});
  for (int m = 0; m < p.size(); ++m) {
    const std::vector<int> alone{m};
    EXPECT_NEAR(quick[m], p.judge(alone)->score, 1e-9);
  }
}

TEST_F(PoolTest, WorthOfTheOnlyMemberIsWhatItsNameGains) {
  const Pool p = pool();
  for (int m = 0; m < p.size(); ++m) {
    const std::vector<int> alone{m};
    const auto fit = p.judge(alone);
    EXPECT_NEAR(p.worth(alone, *fit, 0), fit->score - p.judge({})->score, 1e-9);
  }
}

TEST_F(PoolTest, ScoresInsteadAreThoseBesideTheRest) {
  // But for what the others' costs change when a member goes, which is the same for all.
  const Pool p = pool();
  const std::vector<int> both{1, 4}, rest{4};
  const Eigen::VectorXd beside = p.scores_beside(rest);
  const Eigen::MatrixXd instead = p.scores_instead(both);
  const double change = instead(0, 0) - beside[0];
  EXPECT_LT(std::abs(change), 3.0);
  for (const int m : {2, 3, 5}) EXPECT_NEAR(instead(0, m), beside[m] + change, 1e-9) << m;
  EXPECT_TRUE(std::isinf(instead(0, 1)) && std::isinf(instead(0, 4)));
}

TEST_F(PoolTest, ValuesAreHeldToWhatIsPlausible) {
  // One standard deviation of noise at the largest plausible size, three times over: the value that
  // noise alone asks for is shrunk by 1 + 1 / 9, and what holds it there counts as left over.
  columns_[0] = random_columns(97, 1);
  columns_[0] -= basis_ * (basis_.transpose() * columns_[0]);
  columns_[0] *= 3.0 / columns_[0].norm();
  misfit_ = 2.0 * columns_[0];
  const Pool p = pool();
  const std::vector<int> one{0};
  const double unexplained = 1.0 - 1.0 / (1.0 + 1.0 / 9.0);
  EXPECT_NEAR(p.judge(one)->left, 36.0 * unexplained, 1e-9);
}

TEST_F(PoolTest, TwoWordsForOneThingAreNotNamedTogether) {
  for (auto& columns : columns_) columns /= kPlausible;
  columns_[2] = columns_[1];
  const Pool p = pool();
  const std::vector<int> both{1, 2};
  EXPECT_FALSE(p.judge(both));
}

TEST_F(PoolTest, WhatCouldNotBeSeenAtItsLargestIsNoCandidate) {
  columns_[2] = 0.9 * random_columns(95, 1) / random_columns(95, 1).norm();
  EXPECT_EQ(pool().size(), 5);
}

TEST_F(PoolTest, TheSearchFindsTheSetAndNothingBesideIt) {
  EXPECT_EQ(find_best_set(pool()), (std::vector<int>{1, 4}));
}

TEST_F(PoolTest, NoiseAloneHasNoCause) {
  misfit_ = random_columns(98, 1);
  EXPECT_TRUE(find_best_set(pool()).empty());
}

TEST_F(PoolTest, WhatTheBaseCanDoIsNoCandidate) {
  columns_[2] = base_ * Eigen::MatrixXd::Random(3, 2);
  const Pool p = pool();
  EXPECT_EQ(p.size(), 5);
  for (int m = 0; m < p.size(); ++m) EXPECT_NE(p.form(m), 2);
}

TEST_F(PoolTest, TwoWordsForOneThingAreRivals) {
  columns_[2] = columns_[1] * Eigen::Matrix2d{{1.0, 1.0}, {0.0, 2.0}};
  const Pool p = pool();
  const std::vector<int> set = find_best_set(p);
  ASSERT_EQ(set.size(), 2u);
  bool found = false;
  for (const Rival& rival : find_rivals(p, set)) {
    if (rival.member == 4 || rival.odds < 0.5) continue;
    found = true;
    EXPECT_EQ(rival.member + rival.instead, 3);
    EXPECT_NEAR(rival.odds, 1.0, 1e-6);
  }
  EXPECT_TRUE(found);
}

TEST_F(PoolTest, WhatHelpsBesideAMemberIsNoRivalOfIt) {
  const Pool p = pool();
  const std::vector<int> incomplete{1};
  for (const Rival& rival : find_rivals(p, incomplete)) EXPECT_LT(rival.odds, 0.05);
}

TEST_F(PoolTest, TheSameForAnyNumberOfThreads) {
  const std::vector<int> set{0, 1, 2, 3, 4, 5};
  EXPECT_EQ(pool(1).judge(set)->score, pool(2).judge(set)->score);
}

}  // namespace
}  // namespace bathyal
