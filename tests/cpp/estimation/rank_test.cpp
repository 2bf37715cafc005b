// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/rank.hpp"

#include <gtest/gtest.h>

#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd any_matrix(Index rows, Index columns, std::uint64_t seed) {
  RandomStream random(seed);
  MatrixXd out(rows, columns);
  for (Index i = 0; i < out.size(); ++i) out.data()[i] = random.normal();
  return out;
}

TEST(TriangleOf, HasTheSquareOfAllRows) {
  for (const Index rows : {0, 3, 7, 1024, 1025, 5000}) {
    const MatrixXd matrix = any_matrix(rows, 7, 1);
    const MatrixXd triangle = qr_factor(matrix);
    ASSERT_EQ(triangle.rows(), 7);
    EXPECT_TRUE(triangle.isUpperTriangular(0.0));
    const MatrixXd square = matrix.transpose() * matrix;
    EXPECT_LE((triangle.transpose() * triangle - square).norm(), 1e-12 * square.norm());
    EXPECT_EQ(triangle, qr_factor(matrix, 3)) << "threads change nothing";
  }
}

TEST(ColumnSpace, IsOrthonormalAndWithoutDependentColumns) {
  MatrixXd matrix = any_matrix(3000, 6, 4);
  matrix.col(2) *= 1e-6;
  matrix.col(4) = matrix.col(0) - matrix.col(5);
  const MatrixXd basis = column_space(matrix, kRankTolerance);
  ASSERT_EQ(basis.cols(), 5);
  EXPECT_LT((basis.transpose() * basis - MatrixXd::Identity(5, 5)).norm(), 1e-12);
  EXPECT_LT((matrix - basis * (basis.transpose() * matrix)).norm(), 1e-11 * matrix.norm());
}

/// A column of a millionth's difference is seen; the square of the Jacobian would lose it.
TEST(RevealRank, SeesWhatNormalEquationsLose) {
  MatrixXd matrix = any_matrix(40, 5, 2);
  matrix.col(4) = matrix.col(3) + 3e-7 * any_matrix(40, 1, 3);
  EXPECT_EQ(numerical_rank(matrix).rank, 5);
  matrix.col(4) = matrix.col(3) - 2.0 * matrix.col(1);
  const RankReport report = numerical_rank(matrix);
  EXPECT_EQ(report.rank, 4);
  ASSERT_EQ(report.null_space().cols(), 1);
  EXPECT_LT((matrix * report.null_space()).norm(), 1e-13);
}

TEST(RevealRank, FewerRowsThanColumnsAndNoneAtAll) {
  EXPECT_EQ(numerical_rank(any_matrix(3, 5, 4)).rank, 3);
  EXPECT_EQ(numerical_rank(MatrixXd(0, 4)).rank, 0);
  EXPECT_EQ(numerical_rank(MatrixXd(0, 4)).null_space().cols(), 4);
  EXPECT_EQ(numerical_rank(MatrixXd(6, 0)).rank, 0);
}

TEST(UnseenOf, IsWhatRevealRankLeaves) {
  MatrixXd matrix = any_matrix(40, 5, 2);
  EXPECT_EQ(null_space_of(matrix).rows(), 5);
  EXPECT_EQ(null_space_of(matrix).cols(), 0);
  const MatrixXd difference = any_matrix(40, 1, 3);
  for (const double share : {1e-5, 1e-6, 1e-8, 0.0}) {
    matrix.col(4) = matrix.col(3) - 2.0 * matrix.col(1) + share * difference;
    const MatrixXd found = null_space_of(matrix);
    const MatrixXd known = numerical_rank(matrix).null_space();
    ASSERT_EQ(found.cols(), known.cols());
    EXPECT_EQ(found.cols(), share < 1e-7 ? 1 : 0);
    EXPECT_LT((found * found.transpose() - known * known.transpose()).norm(), 1e-12);
  }
  EXPECT_EQ(null_space_of(any_matrix(3, 5, 4)).cols(), 2);
  EXPECT_EQ(null_space_of(MatrixXd(0, 4)).cols(), 4);
  EXPECT_EQ(null_space_of(MatrixXd(6, 0)).cols(), 0);
}

TEST(InverseSquare, IsTheCovariance) {
  const MatrixXd matrix = any_matrix(2000, 6, 5);
  const MatrixXd identity = covariance_from_qr(matrix) * (matrix.transpose() * matrix);
  EXPECT_LT((identity - MatrixXd::Identity(6, 6)).norm(), 1e-12);
}

TEST(ReadableDirections, SpanTheSameSpaceWithLeadsOfTheirOwn) {
  const MatrixXd null_space =
      Eigen::HouseholderQR<MatrixXd>(any_matrix(6, 6, 6)).householderQ() * MatrixXd::Identity(6, 2);
  const std::vector<Eigen::VectorXd> directions = readable_directions(null_space);
  ASSERT_EQ(directions.size(), 2u);
  MatrixXd both(6, 2);
  both << directions[0], directions[1];
  EXPECT_LT((null_space * (null_space.transpose() * both) - both).norm(), 1e-13);
  for (int k = 0; k < 2; ++k) {
    bool own = false;
    for (Index i = 0; i < 6; ++i) {
      own = own || (both(i, k) == 1.0 && std::abs(both(i, 1 - k)) < 1e-15);
    }
    EXPECT_TRUE(own);
  }
}

std::vector<Parameter> three_columns() {
  return {{"d_2", "d of row 2", "m", "row 2", 0.0, 1e-3},
          {"d_3", "d of row 3", "m", "row 3", 0.0, 1e-3},
          {"theta_1", "theta of row 1", "rad", "row 1", 0.0, 1e-3}};
}

TEST(TradesOf, NameThePartner) {
  MatrixXd null_space(3, 1);
  null_space << std::sqrt(0.5), -std::sqrt(0.5), 0.0;
  const std::vector<NullSpacePartner> partners =
      null_space_partners(0, null_space, three_columns());
  ASSERT_EQ(partners.size(), 1u);
  EXPECT_EQ(partners[0].name, "d_3");
  EXPECT_NEAR(partners[0].factor, -1.0, 1e-15);
  EXPECT_TRUE(null_space_partners(2, null_space, three_columns()).empty());
  EXPECT_EQ(describe_direction(null_space.col(0) / null_space(0), three_columns()),
            "d of row 2 +1, d of row 3 -1");
}

TEST(SelectIndependent, TakesTheFirstOfThoseThatDoTheSame) {
  MatrixXd matrix = any_matrix(20, 4, 7);
  matrix.col(2) = matrix.col(0) + matrix.col(1);
  const IndependentColumns first = select_independent(matrix, {0, 1, 2, 3});
  EXPECT_EQ(first.kept, (std::vector<int>{0, 1, 3}));
  EXPECT_EQ(first.dependent, std::vector<int>{2});
  const IndependentColumns last = select_independent(matrix, {3, 2, 1, 0});
  EXPECT_EQ(last.dependent, std::vector<int>{0});
}

}  // namespace
}  // namespace bathyal
