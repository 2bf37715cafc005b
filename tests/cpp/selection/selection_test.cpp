// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/selection.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "bathyal/base/random.hpp"

namespace bathyal::selection {
namespace {

constexpr Index kRows = 200, kRowsPerFold = 20;

/// A linear model of one base column, with noise of 1.
class LinearModel final : public Model {
 public:
  LinearModel() {
    observations_.order.resize(kRows);
    std::iota(observations_.order.begin(), observations_.order.end(), 0);
    observations_.replicate = observations_.order;
    observations_.session.assign(kRows, 0);
    observations_.group.assign(kRows, -1);
    RandomStream random(7);
    at_.residual.resize(kRows);
    for (double& value : at_.residual) value = random.normal();
    at_.jacobian = Eigen::VectorXd::Ones(kRows);
    at_.observation = observations_.order;
    at_.noise_rows = kRows;
  }

  /// A term with the derivatives `columns`.
  void add(const std::string& effect, const Eigen::MatrixXd& columns, bool lack_of_fit = false) {
    terms_.push_back({effect, -1, effect, effect, 1.0});
    terms_.back().lack_of_fit = lack_of_fit;
    columns_.push_back(columns);
  }
  Eigen::VectorXd& data() { return at_.residual; }
  void set_base(const Eigen::VectorXd& column) { at_.jacobian = column; }

  const Observations& observations() const override { return observations_; }
  const std::vector<Term>& terms() const override { return terms_; }
  const std::vector<std::vector<int>>& scans() const override { return scans_; }
  const std::vector<VarianceComponent>& variance_components() const override {
    return variance_components_;
  }
  std::vector<int> refine(int) override { return {}; }
  std::vector<Eigen::MatrixXd> columns(std::span<const int> terms) const override {
    std::vector<Eigen::MatrixXd> out;
    for (const int term : terms) out.push_back(columns_[static_cast<std::size_t>(term)]);
    return out;
  }
  const Linearization& linearization() const override { return at_; }
  void fit(const std::vector<int>&) override {}
  std::shared_ptr<const Checkpoint> save() const override { return std::make_shared<Checkpoint>(); }
  void restore(const Checkpoint&) override {}
  void set_observation_weights(const Eigen::VectorXd&) override {}
  void set_variance_ratios(const Eigen::VectorXd&) override {}
  double noise() const override { return 1e-3; }

 private:
  Observations observations_;
  Linearization at_;
  std::vector<Term> terms_;
  std::vector<Eigen::MatrixXd> columns_;
  std::vector<std::vector<int>> scans_;
  std::vector<VarianceComponent> variance_components_;
};

Eigen::VectorXd in_fold(Index fold, double size) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(kRows);
  column.segment(fold * kRowsPerFold, kRowsPerFold).setConstant(size);
  return column;
}

Eigen::VectorXd swing(std::uint64_t seed, double size) {
  Eigen::VectorXd column(kRows);
  RandomStream random(seed);
  for (double& value : column) value = size * random.normal();
  return column;
}

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
  EXPECT_LT(found.lack_of_fit[0].p, kBeyondNoise);
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
  EXPECT_LT(found.lack_of_fit[0].p, kBeyondNoise);
}

}  // namespace
}  // namespace bathyal::selection
