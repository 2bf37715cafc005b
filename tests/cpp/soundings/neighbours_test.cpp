// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/soundings/internal/clean_steps.hpp"
#include "bathyal/soundings/internal/parallel_sort.hpp"

namespace bathyal {
namespace {

using namespace soundings;

Soundings random_soundings(int count) {
  RandomStream random(21);
  Soundings soundings;
  for (int i = 0; i < count; ++i) {
    // Half of them on a coarse grid, where many are equally far.
    const double x = random.uniform(0, 10);
    const double y = random.uniform(0, 10);
    const double z = random.uniform(0, 2);
    soundings.push_back(i % 2 == 0 ? Sounding{x, y, z, i}
                                   : Sounding{std::round(x), std::round(y), std::round(z), i});
  }
  return soundings;
}

template <int kDimensions>
void expect_brute_force(int count, int wanted) {
  const Soundings soundings = random_soundings(count);
  const Neighbours<kDimensions> neighbours(soundings, 3);
  std::vector<std::vector<double>> found(soundings.size());
  neighbours.for_each(wanted, 3, [&](std::size_t i, const auto& near) {
    found[i].assign(near.squared.begin(), near.squared.begin() + near.count);
  });
  for (std::size_t i = 0; i < soundings.size(); ++i) {
    std::vector<double> squared;
    for (std::size_t j = 0; j < soundings.size(); ++j) {
      if (j == i) continue;
      const double dx = soundings[j].x - soundings[i].x;
      const double dy = soundings[j].y - soundings[i].y;
      const double dz = kDimensions == 3 ? soundings[j].z - soundings[i].z : 0.0;
      squared.push_back(dx * dx + dy * dy + dz * dz);
    }
    std::sort(squared.begin(), squared.end());
    squared.resize(std::min(squared.size(), static_cast<std::size_t>(wanted)));
    ASSERT_EQ(found[i], squared) << i;
  }
}

TEST(Neighbours, AreThoseOfBruteForce) {
  for (const int wanted : {1, 5, 64}) {
    expect_brute_force<2>(1500, wanted);
    expect_brute_force<3>(1500, wanted);
  }
}

TEST(Neighbours, AreFewerWhereThereAreNoMore) {
  expect_brute_force<2>(1, 5);
  expect_brute_force<3>(2, 5);
  expect_brute_force<3>(40, 64);
}

TEST(ParallelSort, IsTheSortForAnyNumberOfThreads) {
  RandomStream random(5);
  std::vector<std::uint64_t> values(200000);
  for (std::uint64_t& value : values) value = random.next();
  std::vector<std::uint64_t> expected = values;
  std::sort(expected.begin(), expected.end());
  for (const int num_threads : {1, 4}) {
    std::vector<std::uint64_t> sorted = values;
    parallel_sort(sorted, std::less<>(), num_threads);
    EXPECT_EQ(sorted, expected);
  }
}

TEST(CleanSteps, ThinningKeepsTheSoundingNearestToTheCentroidOfAVoxel) {
  CleanOptions options;
  options.voxel = 1.0;
  const Soundings soundings{
      {0.1, 0.1, 0.1, 2}, {0.5, 0.5, 0.5, 0}, {0.9, 0.8, 0.9, 1}, {3.2, 0.1, 0.1, 3}};
  EXPECT_EQ(mark_thinned(soundings, options), (Marks{1, 0, 1, 0}));
}

}  // namespace
}  // namespace bathyal
