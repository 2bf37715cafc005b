// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/term_selection.hpp"

#include <gtest/gtest.h>

#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/selection/decisions.hpp"
#include "bathyal/selection/lack_of_fit.hpp"
#include "selection/linear_model.hpp"

namespace bathyal::selection {
namespace {

/// Three terms, of which the data have the first two, and a lack-of-fit term that they have too.
LinearModel truth() {
  LinearModel model;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Eigen::VectorXd column = swing(seed, 20.0);
    model.add("term " + std::to_string(seed), column);
    if (seed < 3) model.data() += 0.1 * column;
  }
  model.add("structure", swing(4, 20.0), true);
  return model;
}

TEST(TermSelector, SelectsTheTermsOfTheData) {
  LinearModel model = truth();
  WorkingPoint point(model, 1);
  int calls = 0;
  TermSelector selector(point, [&] { ++calls; });
  const Selection found = selector.select();
  EXPECT_EQ(found.terms, (std::vector<int>{0, 1}));
  EXPECT_TRUE((found.weights.array() == 1.0).all());
  EXPECT_EQ(selector.candidates(), (std::vector<int>{0, 1, 2}));  // no lack-of-fit term
  EXPECT_GT(calls, 0);
}

TEST(TermSelector, ExcludesAnOutlier) {
  LinearModel model = truth();
  model.data()[17] += 40.0;
  WorkingPoint point(model, 1);
  TermSelector selector(point, [] {});
  const Selection found = selector.select();
  EXPECT_EQ(found.terms, (std::vector<int>{0, 1}));
  EXPECT_EQ(found.weights[17], 0.0);
  EXPECT_EQ(found.weights.sum(), kRows - 1.0);
}

TEST(TermSelector, TriesNoOtherTermsThanThoseOfAShortlist) {
  LinearModel model = truth();
  WorkingPoint point(model, 1);
  TermSelector selector(point, [] {});
  EXPECT_EQ(selector.select_from({{1}, {1, 2}}).terms, std::vector<int>{1});
  const Shortlist both = TermSelector(point, [] {}).shortlist({0, 1});
  EXPECT_EQ(both.terms, (std::vector<int>{0, 1}));
  EXPECT_EQ(TermSelector(point, [] {}).select_from(both).terms, (std::vector<int>{0, 1}));
}

/// A wide term that spans a narrow one of its alias group scores a little better by chance.
TEST(TermSelector, DescribesACauseByTheNarrowestTermThatDoesAsWell) {
  LinearModel model;
  const Eigen::VectorXd wave = swing(1, 20.0);
  Eigen::MatrixXd curve(kRows, 2);
  curve << wave, model.data() + swing(5, 8.0);
  model.add("curve", curve);
  for (const std::uint64_t seed : {2, 1, 3}) model.add_alias("curve", swing(seed, 20.0));
  model.add_scan({1, 2, 3});
  model.data() += 0.1 * wave;
  WorkingPoint point(model, 1);
  const CandidateSet candidates = point.candidate_set({0, 2});
  ASSERT_GT(candidates.evaluate(std::vector<int>{0})->score,
            candidates.evaluate(std::vector<int>{1})->score);
  EXPECT_EQ(TermSelector(point, [] {}).select().terms, std::vector<int>{2});
}

/// Clean data are asked in three ways, and must not be three times as likely to be called unknown.
TEST(LackOfFitCheck, EachKindOfTestCountsTheOthers) {
  LinearModel model;
  model.add("structure", swing(4, 20.0), true);
  model.data() += 0.02 * swing(4, 20.0);
  WorkingPoint point(model, 1);
  const NuisanceBasis& base = point.nuisance();
  const Eigen::VectorXd residual =
      model.data() - base.basis * (base.basis.transpose() * model.data());
  const std::vector<LackOfFit> found = point.lack_of_fit(base);
  ASSERT_EQ(found.size(), 1U);
  const double left = base.dof - found[0].width;
  const double noise = (residual.squaredNorm() - found[0].explained) / left;
  const double alone = f_tail(found[0].explained / found[0].width / noise, found[0].width, left);
  ASSERT_LT(alone, 1.0 / 4.0);
  EXPECT_NEAR(found[0].p, 4.0 * alone, 1e-9);
}

TEST(LackOfFitCheck, FindsStructureThatTheTermsDoNotExplain) {
  LinearModel model = truth();
  model.data() += 0.1 * swing(4, 20.0);
  WorkingPoint point(model, 1);
  const std::vector<int> candidates{0, 1, 2};
  const Folds folds = make_folds(model.observations());
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(kRows);
  LackOfFitCheck check(point, candidates, folds, weights, [] {});
  const ActiveSet active = check.select({0, 1});
  EXPECT_EQ(active.terms, (std::vector<int>{0, 1}));
  EXPECT_EQ(active.lack_of_fit, std::vector<int>{3});
  EXPECT_EQ(active.all(), (std::vector<int>{0, 1, 3}));
  EXPECT_TRUE(check.remaining(active, false).empty());
}

/// Two terms that span the structure leave nothing of it to find.
TEST(LackOfFitCheck, OneStructureTakesThePlaceOfTermsThatCrowdAroundIt) {
  LinearModel model;
  const Eigen::VectorXd structure = swing(4, 20.0), other = swing(5, 20.0);
  model.add("sum", structure + other);
  model.add("difference", structure - other);
  model.add("structure", structure, true);
  model.data() += 0.1 * structure;
  WorkingPoint point(model, 1);
  const std::vector<int> candidates{0, 1};
  const Folds folds = make_folds(model.observations());
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(kRows);
  const ActiveSet active = LackOfFitCheck(point, candidates, folds, weights, [] {}).select({0, 1});
  EXPECT_TRUE(active.terms.empty());
  EXPECT_EQ(active.lack_of_fit, std::vector<int>{2});
}

TEST(LackOfFitCheck, FindsNothingWhereTheTermsExplainAll) {
  LinearModel model = truth();
  WorkingPoint point(model, 1);
  const std::vector<int> candidates{0, 1, 2};
  const Folds folds = make_folds(model.observations());
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(kRows);
  LackOfFitCheck check(point, candidates, folds, weights, [] {});
  EXPECT_TRUE(check.select({0, 1}).lack_of_fit.empty());
}

TEST(LackOfFitCheck, StructureOfARefutedTermRemains) {
  LinearModel model = truth();
  model.data() += 0.1 * swing(4, 20.0);
  WorkingPoint point(model, 1);
  const std::vector<int> candidates{0, 1, 2};
  const Folds folds = make_folds(model.observations());
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(kRows);
  const LackOfFitCheck check(point, candidates, folds, weights, [] {});
  const std::vector<LackOfFit> remaining = check.remaining({{0, 1}, {}}, true);
  ASSERT_EQ(remaining.size(), 1U);
  EXPECT_EQ(remaining[0].term, 3);
  EXPECT_LE(remaining[0].p, Decisions::kBeyondNoise);
}

}  // namespace
}  // namespace bathyal::selection
