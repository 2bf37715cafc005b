// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/working_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"
#include "bathyal/selection/outlier_test.hpp"

namespace bathyal {
namespace {

constexpr Index kManyUnits = 40, kLeftOutUnit = 7;

/// Units of so many rows each, one base column and noise of 1; a unit is left out, or none.
class ManyRows final : public Subject {
 public:
  ManyRows(Index rows, bool left_out) : rows_(rows) {
    at_.misfit.resize(kManyUnits * rows);
    RandomStream random(11);
    for (double& value : at_.misfit) value = random.normal();
    at_.base = Eigen::MatrixXd::Ones(kManyUnits * rows, 1);
    for (Index u = 0; u < kManyUnits; ++u) {
      units_.order.push_back(static_cast<int>(u));
      at_.unit.insert(at_.unit.end(), static_cast<std::size_t>(rows), static_cast<int>(u));
    }
    at_.misfit.segment(kLeftOutUnit * rows, rows).array() += 20.0;
    if (!left_out) return;
    at_.misfit.segment(kLeftOutUnit * rows, rows) *= std::sqrt(kLeftOut);
    at_.base.middleRows(kLeftOutUnit * rows, rows) *= std::sqrt(kLeftOut);
    at_.lost = static_cast<double>(rows);
  }

  const Units& units() const override { return units_; }
  const std::vector<Form>& forms() const override { return forms_; }
  const std::vector<std::vector<int>>& scans() const override { return scans_; }
  const std::vector<NoiseForm>& noise_forms() const override { return noise_forms_; }
  std::vector<int> finer(int) override { return {}; }
  std::vector<Eigen::MatrixXd> columns(std::span<const int>) const override { return {}; }
  const Linearization& linearization() const override { return at_; }
  void settle(const std::vector<int>&) override {}
  std::shared_ptr<const Place> place() const override { return std::make_shared<Place>(); }
  void return_to(const Place&) override {}
  void set_trust(const Eigen::VectorXd&) override {}
  void set_noise_forms(const Eigen::VectorXd&) override {}
  double noise() const override { return 1.0; }

  /// Log evidence where a column of its own explains each row of the unit, by the books.
  double score_with_columns_of_their_own() const {
    Eigen::VectorXd others(at_.misfit.size() - rows_);
    others << at_.misfit.head(kLeftOutUnit * rows_),
        at_.misfit.tail(at_.misfit.size() - (kLeftOutUnit + 1) * rows_);
    const double left = (others.array() - others.mean()).square().sum();
    const auto wide = static_cast<double>(rows_);
    const double variance = left / static_cast<double>(others.size() - 1);
    const double off = (at_.misfit.segment(kLeftOutUnit * rows_, rows_) / std::sqrt(kLeftOut))
                           .array()
                           .square()
                           .sum();
    return -0.5 * static_cast<double>(at_.misfit.size() - 1) * std::log(left) -
           cost_of_freedom(wide, off / wide / variance) - std::log(double(kManyUnits));
  }

 private:
  Index rows_;
  Units units_;
  Linearization at_;
  std::vector<Form> forms_;
  std::vector<std::vector<int>> scans_;
  std::vector<NoiseForm> noise_forms_;
};

Eigen::VectorXd trust(bool left_out) {
  Eigen::VectorXd out = Eigen::VectorXd::Ones(kManyUnits);
  if (left_out) out[kLeftOutUnit] = 0.0;
  return out;
}

/// Of positions a unit has three rows, of whole poses six: as many numbers leave it out.
TEST(Vantage, AUnitLeftOutCostsAsManyNumbersAsItHasRows) {
  for (const Index rows : {Index{1}, Index{3}, Index{6}}) {
    ManyRows subject(rows, true);
    const Vantage vantage(subject, 1);
    EXPECT_NEAR(vantage.score_of({}, trust(true)), subject.score_with_columns_of_their_own(), 0.5)
        << rows;
  }
}

TEST(Vantage, RowsThatMeasureNothingAreNotCounted) {
  ManyRows subject(3, false);
  Linearization at = subject.linearization();
  at.misfit.segment(3 * kLeftOutUnit + 1, 2).setZero();  // a touch of a plane
  at.base.middleRows(3 * kLeftOutUnit + 1, 2).setZero();
  const Eigen::MatrixXd basis = at.base.normalized();
  const std::vector<UnitTest> tests = test_units(at, basis, trust(false), 3.0 * kManyUnits - 3.0);
  EXPECT_EQ(tests[kLeftOutUnit].rows, 1.0);
  EXPECT_EQ(tests[kLeftOutUnit + 1].rows, 3.0);
}

}  // namespace
}  // namespace bathyal
