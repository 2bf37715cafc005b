// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/sonar/processing/bottom_track.hpp"
#include "bathyal/sonar/processing/mosaic.hpp"

namespace bathyal {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Rows of speckle: water of power 1, and from `first(ping)` on a bottom of `contrast`.
template <class First>
std::vector<float> rows_with_bottom(int pings, int samples, double contrast, const First& first) {
  std::mt19937 random(7);
  std::exponential_distribution<double> speckle(1.0);
  std::vector<float> power;
  for (int p = 0; p < pings; ++p) {
    for (int i = 0; i < samples; ++i) {
      power.push_back(static_cast<float>(speckle(random) * (i < first(p) ? 1.0 : contrast)));
    }
  }
  return power;
}

int swell(int ping) { return 200 + static_cast<int>(std::lround(60.0 * std::sin(0.02 * ping))); }

class BottomTrack : public testing::TestWithParam<BottomPicker> {};

TEST_P(BottomTrack, FollowsASwellingBottom) {
  constexpr int kPings = 2500, kSamples = 500;  // more than a block
  const auto power = rows_with_bottom(kPings, kSamples, 30.0, swell);
  BottomTrackOptions options;
  options.picker = GetParam();
  const auto found = track_bottom(power, kPings, kSamples, kSamples, options);
  ASSERT_EQ(found.size(), std::size_t{kPings});
  int near = 0;
  for (int p = 0; p < kPings; ++p) {
    const auto off = found[static_cast<std::size_t>(p)] - swell(p);
    near += std::abs(off) <= 2;
    EXPECT_LE(std::abs(off), 8) << p;
  }
  EXPECT_GT(near, 0.98 * kPings);
}

TEST_P(BottomTrack, FindsNoneInWater) {
  const auto power = rows_with_bottom(40, 300, 1.0, [](int) { return 1000; });
  BottomTrackOptions options;
  options.picker = GetParam();
  int found = 0;
  for (const auto pick : track_bottom(power, 40, 300, 300, options)) found += pick != kNoBottom;
  // the best path through speckle has gains above the least here and there
  EXPECT_LE(found, GetParam() == BottomPicker::kThreshold ? 0 : 30);
}

TEST_P(BottomTrack, OrdinaryOddities) {
  BottomTrackOptions options;
  options.picker = GetParam();
  EXPECT_TRUE(track_bottom({}, 0, 100, 100, options).empty());
  EXPECT_EQ(track_bottom({}, 2, 0, 0, options), std::vector<std::int64_t>(2, kNoBottom));
  const std::vector<float> silence(300, 0.0F), unknown(300, kNan), one{1.0F};
  EXPECT_EQ(track_bottom(silence, 3, 100, 100, options), std::vector<std::int64_t>(3, kNoBottom));
  EXPECT_EQ(track_bottom(unknown, 3, 100, 100, options), std::vector<std::int64_t>(3, kNoBottom));
  EXPECT_EQ(track_bottom(one, 1, 1, 1, options), std::vector<std::int64_t>{kNoBottom});
  EXPECT_THROW(track_bottom(silence, 4, 100, 100, options), std::invalid_argument);
  options.first_sample = -1;
  EXPECT_THROW(track_bottom(silence, 3, 100, 100, options), std::invalid_argument);
}

TEST_P(BottomTrack, ARowWithoutWaterNoise) {
  std::vector<float> power(4 * 300, 0.0F);
  for (int p = 0; p < 4; ++p) {
    for (int i = 120; i < 280; ++i) power[static_cast<std::size_t>(300 * p + i)] = 5.0F;
    for (int i = 280; i < 300; ++i) power[static_cast<std::size_t>(300 * p + i)] = kNan;
  }
  BottomTrackOptions options;
  options.picker = GetParam();
  for (const auto pick : track_bottom(power, 4, 300, 300, options))
    EXPECT_LE(std::abs(pick - 120), 1);
}

INSTANTIATE_TEST_SUITE_P(Pickers, BottomTrack,
                         testing::Values(BottomPicker::kLikelihood, BottomPicker::kThreshold));

TEST(GroundRows, LosesNoPower) {
  // one metre a sample, the bottom 30 m below: what comes from 30 m to 50 m lies on 0 m to 40 m
  const auto power = rows_with_bottom(1, 100, 4.0, [](int) { return 30; });
  const SidescanRows rows{power, 1, 1, 100, 1.0};
  const std::vector<double> first{30.0};
  for (const double spacing : {0.25, 1.0, 8.0}) {
    const GroundRows ground = to_ground(rows, first, spacing);
    double sum = 0.0, truth = 0.0;
    const auto bins = static_cast<std::int64_t>(40.0 / spacing);
    for (std::int64_t k = 0; k < bins; ++k) {
      const double near = std::hypot(30.0, spacing * static_cast<double>(k));
      const double far = std::hypot(30.0, spacing * static_cast<double>(k + 1));
      sum += ground.power[static_cast<std::size_t>(k)] * (far - near);
    }
    for (int i = 30; i < 50; ++i) truth += power[static_cast<std::size_t>(i)];
    EXPECT_NEAR(sum, truth, 1e-3 * truth) << spacing;
    EXPECT_EQ(ground.bins, static_cast<std::int64_t>(std::sqrt(100.0 * 100 - 30 * 30) / spacing));
  }
}

TEST(GroundRows, ARowWithoutABottomIsUnknown) {
  const std::vector<float> power(20, 1.0F);
  const GroundRows ground =
      to_ground({power, 2, 1, 10, 1.0}, std::vector<double>{2.0, std::nan("")}, 1.0);
  EXPECT_TRUE(std::isfinite(ground.power[0]));
  EXPECT_TRUE(std::isnan(ground.power[static_cast<std::size_t>(ground.bins)]));
  EXPECT_THROW(to_ground({power, 2, 1, 10, 1.0}, std::vector<double>{2.0}, 1.0),
               std::invalid_argument);
  EXPECT_THROW(to_ground({power, 2, 1, 10, 1.0}, std::vector<double>{2.0, 2.0}, 1e-12),
               std::invalid_argument);
}

/// Pings 0.4 m apart towards the heading, port 1, starboard 2, one bright bin at starboard 5.5 m.
struct Line {
  std::vector<float> power;
  std::vector<RowPlace> places;
  static constexpr std::int64_t kPings = 40, kBins = 40;

  explicit Line(double heading) {
    for (std::int64_t p = 0; p < kPings; ++p) {
      const double along = 0.4 * static_cast<double>(p);
      places.push_back({along * std::sin(heading), along * std::cos(heading), heading});
      for (std::int64_t k = 0; k < kBins; ++k) power.push_back(1.0F);
      for (std::int64_t k = 0; k < kBins; ++k) power.push_back(k == 22 && p == 20 ? 200.0F : 2.0F);
    }
  }
  SidescanRows rows() const { return {power, kPings, 2, kBins, 0.25}; }
};

const std::vector<Side> kSides{Side::kPort, Side::kStarboard};

TEST(Mosaic, PutsATargetWhereItIs) {
  for (const double heading : {0.0, 1.0, 2.5, -2.0}) {
    const Line line(heading);
    const Mosaic mosaic = mosaic_of(line.rows(), kSides, line.places, {0.25, 1.0});
    const auto brightest =
        std::max_element(mosaic.power.begin(), mosaic.power.end(),
                         [](float a, float b) { return std::isnan(a) || (b > a); });
    const auto cell = brightest - mosaic.power.begin();
    const double x = mosaic.west + 0.25 * (static_cast<double>(cell % mosaic.columns) + 0.5);
    const double y = mosaic.north - 0.25 * (static_cast<double>(cell / mosaic.columns) + 0.5);
    const RowPlace& at = line.places[20];
    EXPECT_NEAR(x, at.x + 5.625 * std::cos(heading), 0.26) << heading;
    EXPECT_NEAR(y, at.y - 5.625 * std::sin(heading), 0.26) << heading;
  }
}

TEST(Mosaic, LeavesNoHolesBetweenPings) {
  for (const double heading : {0.0, 0.7, 2.5}) {
    const Line line(heading);
    const Mosaic mosaic = mosaic_of(line.rows(), kSides, line.places, {0.25, 1.0});
    std::int64_t known = 0;
    for (const float power : mosaic.power) known += std::isfinite(power);
    const double area = 0.25 * 0.25 * static_cast<double>(known);
    EXPECT_NEAR(area, 312.0, 0.04 * 312.0) << heading;
    const Mosaic gaps = mosaic_of(line.rows(), kSides, line.places, {0.1, 0.2});
    std::int64_t fewer = 0;
    for (const float power : gaps.power) fewer += std::isfinite(power);
    EXPECT_LT(0.01 * static_cast<double>(fewer), 0.5 * area);
  }
}

TEST(Mosaic, LeavesOutPingsWithoutAPlace) {
  Line line(0.0);
  line.places[3].heading = std::nan("");
  EXPECT_EQ(mosaic_of(line.rows(), kSides, line.places, {}).left_out, 1);
  for (auto& place : line.places) place.x = std::nan("");
  EXPECT_THROW(mosaic_of(line.rows(), kSides, line.places, {}), Error);
  EXPECT_THROW(mosaic_of(Line(0.0).rows(), kSides, line.places, {0.0, 1.0}), std::invalid_argument);
  Line far(0.0);
  far.places[39].x = 1e9;
  EXPECT_THROW(mosaic_of(far.rows(), kSides, far.places, {}), std::invalid_argument);
  EXPECT_THROW(mosaic_of(far.rows(), std::vector<Side>{Side::kPort}, far.places, {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
