// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/working_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"
#include "bathyal/selection/outlier_test.hpp"

namespace bathyal::selection {
namespace {

constexpr Index kManyObservations = 40, kExcludedObservation = 7;

/// Observations of `rows` rows each, one base column and noise of 1; one is excluded, or none.
class ManyRows final : public Model {
 public:
  ManyRows(Index rows, bool excluded) : rows_(rows) {
    at_.residual.resize(kManyObservations * rows);
    RandomStream random(11);
    for (double& value : at_.residual) value = random.normal();
    at_.jacobian = Eigen::MatrixXd::Ones(kManyObservations * rows, 1);
    for (Index u = 0; u < kManyObservations; ++u) {
      observations_.order.push_back(static_cast<int>(u));
      at_.observation.insert(at_.observation.end(), static_cast<std::size_t>(rows),
                             static_cast<int>(u));
    }
    at_.residual.segment(kExcludedObservation * rows, rows).array() += 20.0;
    if (!excluded) return;
    at_.residual.segment(kExcludedObservation * rows, rows) *= std::sqrt(kExcludedWeight);
    at_.jacobian.middleRows(kExcludedObservation * rows, rows) *= std::sqrt(kExcludedWeight);
    at_.constrained_dof = static_cast<double>(rows);
  }

  const Observations& observations() const override { return observations_; }
  const std::vector<Term>& terms() const override { return terms_; }
  const std::vector<std::vector<int>>& scans() const override { return scans_; }
  const std::vector<VarianceComponent>& variance_components() const override {
    return variance_components_;
  }
  std::vector<int> refine(int) override { return {}; }
  std::vector<Eigen::MatrixXd> columns(std::span<const int>) const override { return {}; }
  const Linearization& linearization() const override { return at_; }
  const std::vector<Eigen::MatrixXd>& contexts() const override { return contexts_; }
  std::vector<Eigen::MatrixXd> directions() const override { return {}; }
  void fit(const std::vector<int>&) override {}
  std::shared_ptr<const Checkpoint> save() const override { return std::make_shared<Checkpoint>(); }
  void restore(const Checkpoint&) override {}
  void set_observation_weights(const Eigen::VectorXd&) override {}
  void set_variance_ratios(const Eigen::VectorXd&) override {}
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& loads) const override { return loads; }
  double noise() const override { return 1.0; }

  /// Log evidence where a column of its own explains each row of the excluded observation.
  double score_by_formula() const {
    Eigen::VectorXd others(at_.residual.size() - rows_);
    others << at_.residual.head(kExcludedObservation * rows_),
        at_.residual.tail(at_.residual.size() - (kExcludedObservation + 1) * rows_);
    const double left = (others.array() - others.mean()).square().sum();
    const auto wide = static_cast<double>(rows_);
    const double variance = left / static_cast<double>(others.size() - 1);
    const double off =
        (at_.residual.segment(kExcludedObservation * rows_, rows_) / std::sqrt(kExcludedWeight))
            .array()
            .square()
            .sum();
    return -0.5 * static_cast<double>(at_.residual.size() - 1) * std::log(left) -
           complexity_penalty(wide, off / wide / variance) - std::log(double(kManyObservations));
  }

 private:
  Index rows_;
  Observations observations_;
  Linearization at_;
  std::vector<Term> terms_;
  std::vector<std::vector<int>> scans_;
  std::vector<Eigen::MatrixXd> contexts_;
  std::vector<VarianceComponent> variance_components_;
};

Eigen::VectorXd weights(bool excluded) {
  Eigen::VectorXd out = Eigen::VectorXd::Ones(kManyObservations);
  if (excluded) out[kExcludedObservation] = 0.0;
  return out;
}

/// An observation of a position has three rows, of a whole pose six: as many parameters exclude it.
TEST(WorkingPoint, AnExcludedObservationCostsOneParameterPerRow) {
  for (const Index rows : {Index{1}, Index{3}, Index{6}}) {
    ManyRows model(rows, true);
    const WorkingPoint working_point(model, 1);
    EXPECT_NEAR(working_point.score({}, weights(true)), model.score_by_formula(), 0.5) << rows;
  }
}

TEST(WorkingPoint, RowsWithoutInformationAreNotCounted) {
  ManyRows model(3, false);
  Linearization at = model.linearization();
  at.residual.segment(3 * kExcludedObservation + 1, 2).setZero();  // a touch of a plane
  at.jacobian.middleRows(3 * kExcludedObservation + 1, 2).setZero();
  const Eigen::MatrixXd basis = at.jacobian.normalized();
  const std::vector<ObservationTest> tests =
      test_observations(at, basis, weights(false), 3.0 * kManyObservations - 3.0);
  EXPECT_EQ(tests[kExcludedObservation].rows, 1.0);
  EXPECT_EQ(tests[kExcludedObservation + 1].rows, 3.0);
}

}  // namespace
}  // namespace bathyal::selection
