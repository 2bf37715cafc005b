// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/gram.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <tuple>

#include "bathyal/base/random.hpp"
#include "bathyal/base/simd.hpp"

namespace bathyal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd random_matrix(std::uint64_t seed, Index rows, Index columns) {
  RandomStream random(seed);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.uniform(-1.0, 1.0); });
}

using Shape = std::tuple<Index, Index, Index>;  ///< rows, columns of one, columns of the other

class ProductsTest : public testing::TestWithParam<Shape> {
 protected:
  void TearDown() override { set_simd_level(available_simd_levels().back()); }
};

TEST_P(ProductsTest, AreThoseOfEigen) {
  const auto [rows, wide, other] = GetParam();
  const MatrixXd a = random_matrix(1, rows, wide), b = random_matrix(2, rows, other);
  const MatrixXd small = random_matrix(3, wide, other), out = random_matrix(4, rows, other);
  const double rounding = 1e-14 * static_cast<double>(rows + wide + 1);
  for (const SimdLevel level : available_simd_levels()) {
    set_simd_level(level);
    EXPECT_TRUE((inner_products(a, b, 2) - a.transpose() * b).isZero(rounding)) << to_text(level);
    EXPECT_TRUE((inner_products(a, 2) - a.transpose() * a).isZero(rounding)) << to_text(level);
    EXPECT_TRUE((product(a, small, 2) - a * small).isZero(rounding)) << to_text(level);
    MatrixXd sum = out;
    add_product(a, small, sum, 2);
    EXPECT_TRUE((sum - out - a * small).isZero(rounding)) << to_text(level);
  }
}

TEST_P(ProductsTest, AreTheSameBytesOnEveryPathAndNumberOfThreads) {
  const auto [rows, wide, other] = GetParam();
  const MatrixXd a = random_matrix(1, rows, wide), b = random_matrix(2, rows, other);
  const MatrixXd small = random_matrix(3, wide, other);
  set_simd_level(SimdLevel::kBaseline);
  const MatrixXd inner = inner_products(a, b, 1), square = inner_products(a, 1);
  const MatrixXd made = product(a, small, 1);
  for (const SimdLevel level : available_simd_levels()) {
    set_simd_level(level);
    for (const int threads : {1, 2, 5}) {
      EXPECT_EQ(inner_products(a, b, threads), inner);
      EXPECT_EQ(inner_products(b, a, threads), inner.transpose());
      EXPECT_EQ(inner_products(a, threads), square);
      EXPECT_EQ(product(a, small, threads), made);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ProductsTest,
                         testing::Values(Shape{0, 3, 2}, Shape{5, 0, 2}, Shape{5, 2, 0},
                                         Shape{1, 1, 1}, Shape{7, 3, 5}, Shape{8, 4, 6},
                                         Shape{513, 25, 31}, Shape{1930, 7, 50},
                                         Shape{600, 110, 400}));

}  // namespace
}  // namespace bathyal
