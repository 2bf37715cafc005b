// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/internal/duplicates.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bathyal::diagnosis {
namespace {

/// Rows 0 1 2 1 0, but for the last position.
Tracked record() {
  Tracked out;
  out.q = RowMatrix(5, 2);
  out.q << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.3, 0.4, 0.1, 0.2;
  out.position = RowMatrix(5, 3);
  for (Index i = 0; i < 5; ++i) out.position.row(i).setConstant(out.q(i, 0));
  out.position(4, 2) += 1e-9;
  return out;
}

TEST(Duplicates, AgreeInAllThatWasMeasured) {
  EXPECT_EQ(find_duplicates(record()), (std::vector<int>{0, 1, 2, 1, 4}));
}

TEST(Duplicates, MayDifferInTimeAndInNoOtherCovariate) {
  Tracked tracked = record();
  tracked.covariates["time"] = RowMatrix(Eigen::VectorXd::LinSpaced(5, 0.0, 4.0));
  EXPECT_EQ(find_duplicates(tracked)[3], 1);
  tracked.covariates["temperature"] = RowMatrix(Eigen::VectorXd::LinSpaced(5, 5.0, 6.0));
  EXPECT_EQ(find_duplicates(tracked)[3], 3);
  tracked.covariates["temperature"].setConstant(std::nan(""));
  EXPECT_EQ(find_duplicates(tracked)[3], 1);
}

TEST(Duplicates, AreLeftOutWithTheirCovariates) {
  Tracked tracked = record();
  tracked.covariates["time"] = RowMatrix(Eigen::VectorXd::LinSpaced(5, 0.0, 4.0));
  const Tracked once = without_duplicates(tracked, find_duplicates(tracked));
  ASSERT_EQ(once.q.rows(), 4);
  EXPECT_EQ(once.position.row(3), tracked.position.row(4));
  EXPECT_EQ(once.covariates.at("time")(3, 0), 4.0);
}

TEST(Duplicates, OfTouchesAreNoneWithAnotherPointOrOnAPlane) {
  Touches touches;
  touches.q = RowMatrix::Constant(4, 2, 0.5);
  touches.point = {0, 1, 0, 1};
  EXPECT_EQ(find_duplicates(touches), (std::vector<int>{0, 1, 0, 1}));
  touches.planes.resize(1);
  touches.planes[0].rows = {1, 3};
  EXPECT_EQ(find_duplicates(touches), (std::vector<int>{0, 1, 0, 3}));
  const Touches once = without_duplicates(touches, {0, 1, 0, 3});
  EXPECT_EQ(once.planes[0].rows, (std::vector<int>{1, 2}));
}

}  // namespace
}  // namespace bathyal::diagnosis
