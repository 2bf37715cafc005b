// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/write_xyz.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/soundings/text_table.hpp"

namespace bathyal {
namespace {

/// Of this process alone: the tests run side by side.
std::string path() {
  return testing::TempDir() + "bathyal_write_xyz_" + std::to_string(getpid()) + ".xyz";
}

std::string written(const PointCloud& cloud, const WriteXyzOptions& options = {}) {
  write_xyz(path(), cloud, options);
  std::ifstream file(path(), std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  std::remove(path().c_str());
  return text;
}

PointCloud random_cloud(Index rows) {
  RandomStream random(3);
  PointMatrix points(rows, 3);
  for (Index i = 0; i < points.size(); ++i) {
    double value = NAN;
    while (!std::isfinite(value)) value = std::bit_cast<double>(random.next());
    // Half of them any double at all, half like survey coordinates, some of those exact ties.
    if (i % 2 == 0) value = std::round(random.uniform(-1e7, 1e7) * 1024.0) / 1024.0;
    if (i % 7 == 0) value = random.uniform(-1.0, 1.0) * 1e-4;
    points.data()[i] = value;
  }
  return PointCloud(points);
}

TEST(WriteXyz, RoundsFixedDecimalsAsPrintfDoes) {
  const PointCloud cloud = random_cloud(3000);
  for (const int decimals : {0, 1, 3, 9, 12, 17}) {
    WriteXyzOptions options;
    options.decimals = decimals;
    std::string expected;
    char number[400];
    for (Index i = 0; i < 3 * cloud.size(); ++i) {
      std::snprintf(number, sizeof number, "%.*f", decimals, cloud.points().data()[i]);
      expected.append(number).append(i % 3 == 2 ? "\n" : " ");
    }
    EXPECT_EQ(written(cloud, options), expected) << decimals;
  }
}

TEST(WriteXyz, ShortestTextReadsBackToTheSameBits) {
  const PointCloud cloud = random_cloud(20000);
  const TextTable table = parse_text_table(written(cloud));
  ASSERT_EQ(table.rows, cloud.size());
  for (Index i = 0; i < 3 * cloud.size(); ++i) {
    ASSERT_EQ(table.table.data()[i], cloud.points().data()[i]);
  }
}

TEST(WriteXyz, IsTheSameForAnyNumberOfThreads) {
  const PointCloud cloud = random_cloud(150000);  // more than one batch
  WriteXyzOptions one;
  one.num_threads = 1;
  WriteXyzOptions eight;
  eight.num_threads = 8;
  EXPECT_EQ(written(cloud, one), written(cloud, eight));
}

TEST(WriteXyz, WritesHeaderAttributesAndWords) {
  PointMatrix points(1, 3);
  points << 1.5, NAN, -INFINITY;
  const PointCloud cloud(points, {{"b", Values(Values::Matrix::Constant(1, 7.25))}});
  WriteXyzOptions options;
  options.header = true;
  options.separator = ',';
  options.attributes = {"b"};
  EXPECT_EQ(written(cloud, options), "x,y,z,b\n1.5,nan,-inf,7.25\n");
  options.decimals = 1;
  EXPECT_EQ(written(cloud, options), "x,y,z,b\n1.5,nan,-inf,7.2\n");
  EXPECT_EQ(written(PointCloud()), "");
}

TEST(WriteXyz, Refuses) {
  WriteXyzOptions options;
  options.attributes = {"depth"};
  EXPECT_THROW(write_xyz(path(), PointCloud(), options), std::invalid_argument);
  options = {};
  options.decimals = 18;
  EXPECT_THROW(write_xyz(path(), PointCloud(), options), std::invalid_argument);
  options = {};
  options.separator = 'x';
  EXPECT_THROW(write_xyz(path(), PointCloud(), options), std::invalid_argument);
  EXPECT_THROW(write_xyz("/no such folder/f.xyz", PointCloud()), Error);
  EXPECT_THROW(write_xyz("/dev/full", random_cloud(10)), Error);
}

}  // namespace
}  // namespace bathyal
