// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/internal/hilbert_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

using namespace terrain;

/// Half of the points crowd in a millionth of the area, and a tenth are repeated.
PointMatrix crowded_points(Index count) {
  PointMatrix points(count, 3);
  RandomStream random(4);
  for (Index i = 0; i < count; ++i) {
    const double size = i % 2 == 0 ? 1000.0 : 1.0;
    points.row(i) << 5e5 + random.uniform(0.0, size), 6e6 + random.uniform(0.0, size),
        random.uniform(-60.0, -50.0);
    if (i % 10 == 9) points.row(i).leftCols<2>() = points.row(i / 2).leftCols<2>();
  }
  return points;
}

std::vector<std::int32_t> order_of(const PointMatrix& points, int num_threads = 1) {
  const PageVector<std::int32_t> rows =
      hilbert_order(PointView(points.data(), points.rows(), 3), num_threads);
  return {rows.begin(), rows.end()};
}

TEST(HilbertOrder, HoldsEveryPlaceOnceByItsLowestPoint) {
  const PointMatrix points = crowded_points(20000);
  const std::vector<std::int32_t> rows = order_of(points);
  const auto place = [&](std::int32_t i) { return std::pair(points(i, 0), points(i, 1)); };
  std::vector<std::int32_t> all(20000), expected;
  std::iota(all.begin(), all.end(), 0);
  std::sort(all.begin(), all.end(), [&](std::int32_t a, std::int32_t b) {
    return std::tuple(place(a), points(a, 2)) < std::tuple(place(b), points(b, 2));
  });
  for (const std::int32_t i : all) {
    if (expected.empty() || place(expected.back()) != place(i)) expected.push_back(i);
  }
  std::vector<std::int32_t> sorted = rows;
  std::sort(sorted.begin(), sorted.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(sorted, expected);
  EXPECT_LT(rows.size(), 20000U);
}

TEST(HilbertOrder, IsAMatterOfThePointsAndNotOfTheirRowsOrThreads) {
  const PointMatrix points = crowded_points(30000);
  std::vector<std::int32_t> shuffle(30000);
  std::iota(shuffle.begin(), shuffle.end(), 0);
  RandomStream random(9);
  for (std::size_t i = shuffle.size(); i > 1; --i) {
    std::swap(shuffle[i - 1], shuffle[random.next() % i]);
  }
  PointMatrix shuffled(30000, 3);
  for (Index i = 0; i < 30000; ++i)
    shuffled.row(i) = points.row(shuffle[static_cast<std::size_t>(i)]);
  const std::vector<std::int32_t> rows = order_of(points);
  std::vector<std::int32_t> back = order_of(shuffled, 3);
  for (std::int32_t& row : back) row = shuffle[static_cast<std::size_t>(row)];
  EXPECT_EQ(back, rows);
}

/// A random order of n points in a unit square walks 0.52 n; the curve walks about 0.9 √n.
TEST(HilbertOrder, KeepsNeighboursClose) {
  PointMatrix points(40000, 3);
  RandomStream random(1);
  for (Index i = 0; i < points.rows(); ++i) {
    points.row(i) << random.uniform(), random.uniform(), 0.0;
  }
  const std::vector<std::int32_t> rows = order_of(points);
  double length = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    length += (points.row(rows[i]) - points.row(rows[i - 1])).norm();
  }
  EXPECT_LT(length, 1.0 * std::sqrt(40000.0));
}

TEST(HilbertOrder, NothingAndOnePlace) {
  EXPECT_TRUE(order_of(PointMatrix(0, 3)).empty());
  EXPECT_EQ(order_of(PointMatrix::Constant(7000, 3, 1e-300)), std::vector<std::int32_t>{0});
}

}  // namespace
}  // namespace bathyal
