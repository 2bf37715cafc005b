// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/selection.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bathyal/selection/decisions.hpp"
#include "selection/linear_model.hpp"

namespace bathyal::selection {
namespace {

using Names = std::vector<std::string>;

Names effects_of(const LinearModel& model, const std::vector<SelectedTerm>& chosen) {
  Names effects;
  for (const SelectedTerm& one : chosen) effects.push_back(model.terms()[one.term].effect);
  return effects;
}

TEST(SelectTerms, StructureOfARefutedTermIsUnexplained) {
  LinearModel model;
  Eigen::VectorXd base = Eigen::VectorXd::Ones(kRows);
  base.segment(5 * kRowsPerFold, kRowsPerFold).setZero();
  model.set_base(base);
  // No other fold determines it: what is held out there cannot be predicted.
  model.add("bump", in_fold(5, 10.0));
  model.add("somewhere", in_fold(5, 10.0), true);
  model.data() += in_fold(5, 8.0);
  const SelectionResult found = select_terms(model, {1, 10}, {});
  EXPECT_TRUE(found.terms.empty());
  EXPECT_EQ(effects_of(model, found.lack_of_fit), Names{"somewhere"});
  EXPECT_GT(found.unexplained, 0.9 * 20 * 64.0);
}

TEST(SelectTerms, ATermThatPredictsBadlyIsDroppedAlone) {
  LinearModel model;
  const Eigen::VectorXd one = swing(1, 20.0), other = swing(2, 20.0);
  model.add("one", one);
  model.add("other", other);
  // Fold 0 determines it badly, and wrong for fold 5: the prediction there is far off, as its
  // variance says, and raises PRESS by more than the other two terms lower it.
  const Eigen::VectorXd faint = in_fold(0, 0.7), strong = in_fold(5, 220.0);
  model.add("spoiler", faint + strong);
  model.data() += 0.2 * one + 0.2 * other + 0.1 * strong - 2.0 * faint;
  const SelectionResult found = select_terms(model, {1, 10}, {});
  EXPECT_EQ(effects_of(model, found.terms), (Names{"one", "other"}));
}

/// A truth that only a lack-of-fit term describes, a term that approximates it, and `others` that
/// are true.
SelectionResult with_approximation(LinearModel& model, int others) {
  const Eigen::VectorXd truth = swing(1, 20.0);
  model.add("nearest", truth + swing(2, 8.0));
  model.add("truth", truth, true);
  model.data() += 0.1 * truth;
  for (int i = 0; i < others; ++i) {
    const Eigen::VectorXd other = swing(10 + static_cast<std::uint64_t>(i), 20.0);
    model.add("other " + std::to_string(i), other);
    model.data() += 0.1 * other;
  }
  return select_terms(model, {1, 10}, {});
}

TEST(SelectTerms, LackOfFitReplacesATermThatOnlyApproximatesIt) {
  LinearModel model;
  const SelectionResult found = with_approximation(model, 2);
  EXPECT_EQ(effects_of(model, found.terms), (Names{"other 0", "other 1"}));
  EXPECT_EQ(effects_of(model, found.lack_of_fit), Names{"truth"});
}

TEST(SelectTerms, AmongManyTermsLackOfFitIsReportedInAddition) {
  LinearModel model;
  const SelectionResult found = with_approximation(model, 6);
  EXPECT_EQ(found.terms.size(), 7u);
  EXPECT_EQ(effects_of(model, found.terms).front(), "nearest");
  ASSERT_EQ(effects_of(model, found.lack_of_fit), Names{"truth"});
  EXPECT_LT(found.lack_of_fit[0].p, Decisions::kBeyondNoise);
  EXPECT_GT(found.unexplained, 0.0);
}

TEST(SelectTerms, LackOfFitThatPredictsNothingReplacesNoTerm) {
  LinearModel model;
  const Eigen::VectorXd name = swing(1, 20.0);
  model.add("name", name);
  // The term's value differs between folds: significant, and unpredictable from the other folds.
  Eigen::MatrixXd by_fold = Eigen::MatrixXd::Zero(kRows, kRows / kRowsPerFold);
  for (Index b = 0; b < by_fold.cols(); ++b) {
    const auto rows = Eigen::seqN(b * kRowsPerFold, kRowsPerFold);
    by_fold(rows, b) = name(rows);
    model.data()(rows) += (b % 2 == 0 ? 0.17 : 0.11) * name(rows);
  }
  model.add("by block", by_fold, true);
  const SelectionResult found = select_terms(model, {1, 10}, {});
  EXPECT_EQ(effects_of(model, found.terms), Names{"name"});
  ASSERT_EQ(effects_of(model, found.lack_of_fit), Names{"by block"});
  EXPECT_EQ(found.lack_of_fit[0].width, kRows / kRowsPerFold - 1);
  EXPECT_LT(found.lack_of_fit[0].p, Decisions::kBeyondNoise);
}

}  // namespace
}  // namespace bathyal::selection
