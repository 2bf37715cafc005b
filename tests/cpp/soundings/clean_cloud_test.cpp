// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/clean_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>
#include <vector>

#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

PointCloud cloud_of(const std::vector<Vec3>& rows) {
  PointMatrix points(static_cast<Index>(rows.size()), 3);
  Values::Matrix number(points.rows());
  for (Index i = 0; i < points.rows(); ++i) {
    points.row(i) = rows[static_cast<std::size_t>(i)];
    number(i) = static_cast<double>(i);
  }
  return PointCloud(points, {{"number", Values(number)}}, {"EPSG:32602", "MLLW"});
}

std::vector<std::int32_t> rows_of(const CleanResult& result) {
  return {result.rows.data(), result.rows.data() + result.rows.rows()};
}

/// A gentle bottom at survey coordinates, with noise of a centimetre.
std::vector<Vec3> bottom(int count) {
  std::vector<Vec3> rows;
  for (int i = 0; i < count; ++i) {
    RandomStream random(11, static_cast<std::uint64_t>(i));
    const double x = random.uniform(0, 20);
    const double y = random.uniform(0, 20);
    rows.emplace_back(620000 + x, 7246000 + y, -50 + 0.1 * x + 0.01 * random.normal());
  }
  return rows;
}

/// By brute force: mean distance to the k nearest of the others.
std::vector<double> mean_distances(const std::vector<Vec3>& rows, int k) {
  std::vector<double> means;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<double> distances;
    for (std::size_t j = 0; j < rows.size(); ++j) {
      if (j != i) distances.push_back((rows[j] - rows[i]).norm());
    }
    std::sort(distances.begin(), distances.end());
    means.push_back(std::accumulate(distances.begin(), distances.begin() + k, 0.0) / k);
  }
  return means;
}

TEST(CleanCloud, DropsOnlyWhatIsNotFiniteAndExactDuplicatesUnlessAsked) {
  const PointCloud cloud = cloud_of({{1, 2, 3},
                                     {NAN, 0, 0},
                                     {1, 2, 3},
                                     {1, 2, 4},
                                     {0, INFINITY, 0},
                                     {0, 0, -INFINITY},
                                     {1, 2, 3},
                                     {-1, 0, 0}});
  const CleanResult result = clean_cloud(cloud);
  EXPECT_EQ(rows_of(result), (std::vector<std::int32_t>{0, 3, 7}));
  EXPECT_EQ(result.report.before, 8);
  EXPECT_EQ(result.report.not_finite, 3);
  EXPECT_EQ(result.report.duplicates, 2);
  EXPECT_EQ(result.report.same_place, 2);
  EXPECT_EQ(result.report.same_place_dropped, 0);
  EXPECT_EQ(result.report.after, 3);
  EXPECT_EQ(result.cloud.points().row(1), Eigen::RowVector3d(1, 2, 4));
  EXPECT_EQ(result.cloud.attributes().at("number").data()[2], 7.0);
  EXPECT_EQ(result.cloud.datum().crs, "EPSG:32602");
  EXPECT_NE(result.report.text().find("3 of 8 soundings kept"), std::string::npos);
  EXPECT_NE(result.report.text().find("2 dropped: exact duplicates"), std::string::npos);
}

TEST(CleanCloud, SharesACloudThatIsCleanAlready) {
  const PointCloud cloud = cloud_of({{1, 2, 3}, {0, 0, 0}});
  EXPECT_EQ(clean_cloud(cloud).cloud.points().data(), cloud.points().data());
}

TEST(CleanCloud, ChoosesAmongSoundingsAtOnePlace) {
  const PointCloud cloud = cloud_of({{5, 5, -3}, {5, 5, -1}, {5, 5, -2}, {6, 5, -9}, {5, 5, -1}});
  CleanOptions options;
  options.same_place = SamePlace::kShallowest;
  EXPECT_EQ(rows_of(clean_cloud(cloud, options)), (std::vector<std::int32_t>{1, 3}));
  options.same_place = SamePlace::kDeepest;
  const CleanResult deepest = clean_cloud(cloud, options);
  EXPECT_EQ(rows_of(deepest), (std::vector<std::int32_t>{0, 3}));
  EXPECT_EQ(deepest.report.duplicates, 1);
  EXPECT_EQ(deepest.report.same_place, 3);
  EXPECT_EQ(deepest.report.same_place_dropped, 2);
}

TEST(CleanCloud, FindsSpikesAndNothingElse) {
  std::vector<Vec3> rows = bottom(4000);
  const std::set<std::int32_t> spikes = {17, 400, 2222, 3999};
  for (const std::int32_t i : spikes)
    rows[static_cast<std::size_t>(i)].z() += i % 2 == 0 ? 0.7 : -0.7;
  CleanOptions options;
  options.spike_sigma = 6.0;
  const CleanResult result = clean_cloud(cloud_of(rows), options);
  EXPECT_EQ(result.report.spikes, 4);
  for (const std::int32_t row : rows_of(result)) EXPECT_EQ(spikes.count(row), 0U);
  options.spike_height = 1.0;
  EXPECT_EQ(clean_cloud(cloud_of(rows), options).report.spikes, 0);
}

TEST(CleanCloud, DropsOutliersByTheirMeanDistanceAsBruteForceDoes) {
  std::vector<Vec3> rows = bottom(700);
  rows.emplace_back(620010, 7246010, -20);
  rows.emplace_back(620040, 7246040, -50);
  CleanOptions options;
  options.outlier_sigma = 2.0;
  options.outlier_neighbours = 6;
  const std::vector<double> means = mean_distances(rows, 6);
  const auto count = static_cast<double>(means.size());
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / count;
  double variance = 0.0;
  for (const double m : means) variance += (m - mean) * (m - mean) / (count - 1.0);
  std::vector<std::int32_t> expected;
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (means[i] <= mean + 2.0 * std::sqrt(variance))
      expected.push_back(static_cast<std::int32_t>(i));
  }
  EXPECT_LT(expected.size(), rows.size());
  EXPECT_EQ(rows_of(clean_cloud(cloud_of(rows), options)), expected);
}

TEST(CleanCloud, KeepsTheMeasuredPointNearestToTheCentroidOfEachVoxel) {
  const PointCloud cloud = cloud_of(
      {{0.1, 0.1, 0.1}, {0.5, 0.5, 0.5}, {0.8, 0.8, 0.8}, {-0.1, 0.5, 0.5}, {1.0, 0.5, 0.5}});
  CleanOptions options;
  options.voxel = 1.0;
  const CleanResult result = clean_cloud(cloud, options);
  EXPECT_EQ(rows_of(result), (std::vector<std::int32_t>{1, 3, 4}));
  EXPECT_EQ(result.report.thinned, 2);
  options.voxel = 1e-300;
  EXPECT_THROW(clean_cloud(cloud, options), std::invalid_argument);
}

TEST(CleanCloud, LeavesOneSoundingAVoxel) {
  CleanOptions options;
  options.voxel = 0.5;
  const CleanResult result = clean_cloud(cloud_of(bottom(20000)), options);
  std::set<std::vector<double>> cells;
  for (Index i = 0; i < result.cloud.size(); ++i) {
    const Vec3 p = result.cloud.points().row(i);
    cells.insert({std::floor(p.x() / 0.5), std::floor(p.y() / 0.5), std::floor(p.z() / 0.5)});
  }
  EXPECT_EQ(static_cast<Index>(cells.size()), result.cloud.size());
}

std::set<std::vector<double>> positions(const PointCloud& cloud) {
  std::set<std::vector<double>> result;
  for (Index i = 0; i < cloud.size(); ++i) {
    const Vec3 p = cloud.points().row(i);
    result.insert({p.x(), p.y(), p.z()});
  }
  return result;
}

TEST(CleanCloud, DoesNotDependOnTheOrderOfRowsNorOnThreads) {
  std::vector<Vec3> rows = bottom(70000);
  for (int i = 0; i < 300; ++i) {
    rows[static_cast<std::size_t>(7 * i)] = rows[static_cast<std::size_t>(7 * i + 1)];
    rows[static_cast<std::size_t>(7 * i + 2)].z() += 1.0;
  }
  // A grid, where every neighbour has others equally far.
  for (int i = 0; i < 2500; ++i) rows.emplace_back(620100 + i % 50, 7246000 + i / 50, -50);
  std::vector<Vec3> turned(rows.rbegin(), rows.rend());
  CleanOptions options;
  options.same_place = SamePlace::kShallowest;
  options.spike_sigma = 5.0;
  options.spike_neighbours = 10;
  options.outlier_sigma = 3.0;
  options.outlier_neighbours = 5;
  options.voxel = 0.3;
  options.num_threads = 1;
  const CleanResult one = clean_cloud(cloud_of(rows), options);
  options.num_threads = 8;
  const CleanResult eight = clean_cloud(cloud_of(rows), options);
  EXPECT_EQ(rows_of(one), rows_of(eight));
  EXPECT_GT(one.report.spikes, 200);
  EXPECT_GT(one.report.outliers, 0);
  EXPECT_EQ(positions(clean_cloud(cloud_of(turned), options).cloud), positions(one.cloud));
}

TEST(CleanCloud, TakesFewAndEqualPoints) {
  CleanOptions all;
  all.same_place = SamePlace::kDeepest;
  all.spike_sigma = 3.0;
  all.outlier_sigma = 3.0;
  all.voxel = 0.1;
  EXPECT_EQ(clean_cloud(PointCloud(), all).cloud.size(), 0);
  EXPECT_EQ(clean_cloud(cloud_of({{NAN, NAN, NAN}}), all).cloud.size(), 0);
  EXPECT_EQ(clean_cloud(cloud_of({{1, 2, 3}}), all).cloud.size(), 1);
  EXPECT_EQ(clean_cloud(cloud_of({{1, 2, 3}, {2, 2, 3}}), all).cloud.size(), 2);
  EXPECT_EQ(clean_cloud(cloud_of(std::vector<Vec3>(5000, Vec3(1, 2, 3))), all).cloud.size(), 1);
  EXPECT_EQ(clean_cloud(cloud_of({{0, 0, 0}, {0, -0.0, 0}})).cloud.size(), 1);
  // All at one place in plan: the tree splits by rank, so it cannot run off.
  std::vector<Vec3> column;
  for (int i = 0; i < 3000; ++i) column.emplace_back(1, 2, 0.001 * i);
  CleanOptions spikes;
  spikes.spike_sigma = 3.0;
  EXPECT_LE(clean_cloud(cloud_of(column), spikes).cloud.size(), 3000);
}

TEST(CleanCloud, RefusesOptionsOutOfRange) {
  const auto refused = [](double CleanOptions::*field, double value) {
    CleanOptions options;
    options.*field = value;
    EXPECT_THROW(clean_cloud(PointCloud(), options), std::invalid_argument);
  };
  refused(&CleanOptions::spike_sigma, -1.0);
  refused(&CleanOptions::spike_height, NAN);
  refused(&CleanOptions::outlier_sigma, INFINITY);
  refused(&CleanOptions::voxel, -0.1);
  CleanOptions options;
  options.spike_neighbours = 65;
  EXPECT_THROW(clean_cloud(PointCloud(), options), std::invalid_argument);
  options = {};
  options.outlier_neighbours = 0;
  EXPECT_THROW(clean_cloud(PointCloud(), options), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
