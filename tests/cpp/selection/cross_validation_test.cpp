// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/cross_validation.hpp"

#include <gtest/gtest.h>

#include "selection/linear_model.hpp"

namespace bathyal::selection {
namespace {

class CrossValidationTest : public ::testing::Test {
 protected:
  CrossValidationTest() {
    const Eigen::VectorXd truth = swing(1, 20.0);
    model_.add("truth", truth);
    model_.add("nothing", swing(2, 20.0));
    model_.add("base", Eigen::VectorXd::Ones(kRows));
    model_.data() += 0.2 * truth;
    folds_ = make_folds(model_.observations());
  }
  LinearModel model_;
  Folds folds_;
};

TEST_F(CrossValidationTest, LeavesOutWhatIsCollinearWithTheBase) {
  const WorkingPoint point(model_, 1);
  const BlockCrossValidation held(point, {0, 1, 2}, folds_);
  EXPECT_EQ(held.terms(), (std::vector<int>{0, 1}));
  EXPECT_EQ(held.rows(), static_cast<double>(kRows));
}

TEST_F(CrossValidationTest, ATrueTermPredictsAndAnIdleOneDoesNot) {
  const WorkingPoint point(model_, 1);
  const BlockCrossValidation held(point, {0, 1}, folds_);
  EXPECT_LT(held.press(), 0.2 * held.press(0));
  EXPECT_LT(held.press(1), held.press());
  EXPECT_GT(held.log_predictive_density(), held.log_predictive_density(0) + 100.0);
  EXPECT_GT(held.log_predictive_density(1), held.log_predictive_density());
  EXPECT_DOUBLE_EQ(held.log_predictive_density(1), held.log_predictive_density_of({0}));
}

TEST_F(CrossValidationTest, PressIsTheSumOfSquaredErrors) {
  const WorkingPoint point(model_, 1);
  BlockCrossValidation held(point, {0, 1}, folds_);
  EXPECT_NEAR(held.errors().error.squaredNorm(), held.press(), 1e-9 * held.press());
  EXPECT_GT(held.errors_of_base().error.squaredNorm(), 5.0 * held.press());
  const double without = held.press(1);
  held.drop(1);
  EXPECT_EQ(held.terms(), std::vector<int>{0});
  EXPECT_DOUBLE_EQ(held.press(), without);
}

}  // namespace
}  // namespace bathyal::selection
