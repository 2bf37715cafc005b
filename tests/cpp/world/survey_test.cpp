// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/survey/survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace bathyal {
namespace {

SurveyOptions small() {
  SurveyOptions options;
  options.seed = 5;
  options.length = 30.0;
  options.beams = 96;
  options.ping_spacing = 0.25;
  return options;
}

bool same_bytes(const Values& a, const Values& b) {
  return a.rows() == b.rows() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.rows()) * sizeof(double)) == 0;
}

TEST(Survey, IsTheSameBytesForAnyNumberOfThreads) {
  SurveyOptions options = small();
  options.num_threads = 1;
  const PointCloud one = generate_survey(options);
  options.num_threads = 8;
  const PointCloud eight = generate_survey(options);
  EXPECT_EQ(one.points(), eight.points());
  for (const char* name : {"uncertainty", "intensity"}) {
    EXPECT_TRUE(same_bytes(one.attributes().at(name), eight.attributes().at(name)));
  }
  options.seed = 6;
  EXPECT_NE(generate_survey(options).points()(0, 2), one.points()(0, 2));
}

TEST(Survey, LiesOnTheTrueBottomWithinItsUncertainty) {
  const SurveyOptions options = small();
  const PointCloud cloud = generate_survey(options);
  const GeneratedSeabed seabed(options);
  std::vector<double> off;
  for (Index i = 0; i < cloud.size(); ++i) {
    const Vec3 p = cloud.points().row(i);
    off.push_back(std::abs(p.z() - seabed.height(p.x(), p.y())) /
                  cloud.attributes().at("uncertainty").data()[i]);
  }
  std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2),
                   off.end());
  // The median of |normal noise| is 0.6745 of its standard deviation.
  EXPECT_NEAR(off[off.size() / 2], 0.6745, 0.05);
}

TEST(Survey, MeetsAFlatBottomExactlyWithoutNoise) {
  SurveyOptions options = small();
  options.wave_height = options.ripple_height = options.roughness = options.trench_depth = 0.0;
  options.boulders = 0;
  options.range_noise = options.range_noise_rate = options.angle_noise = 0.0;
  const PointCloud cloud = generate_survey(options);
  for (Index i = 0; i < cloud.size(); ++i) {
    ASSERT_NEAR(cloud.points()(i, 2), options.origin.z(), 2e-4);
  }
}

TEST(Survey, LosesAStripeOfPingsOnTheFirstLineOnly) {
  SurveyOptions options = small();
  const Index with = generate_survey(options).size();
  options.lost_width = 0.0;
  const Index without = generate_survey(options).size();
  EXPECT_EQ(without, 2 * 121 * 96);
  EXPECT_EQ(without - with, 8 * 96);
}

TEST(Survey, HasSpikesWhereAsked) {
  SurveyOptions options = small();
  const PointCloud plain = generate_survey(options);
  options.spike_fraction = 0.01;
  const PointCloud spiky = generate_survey(options);
  Index spikes = 0;
  for (Index i = 0; i < plain.size(); ++i) {
    const double up = spiky.points()(i, 2) - plain.points()(i, 2);
    EXPECT_GE(up, 0.0);
    spikes += up > 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(spikes) / static_cast<double>(plain.size()), 0.01, 0.003);
}

TEST(Survey, NothingOfTheBottomRisesAboveItsHighest) {
  const SurveyOptions options = small();
  const GeneratedSeabed seabed(options);
  double highest = -INFINITY;
  for (int i = 0; i < 90000; ++i) {
    highest = std::max(highest, seabed.local_height(0.1 * (i % 300), 0.1333 * (i / 300)));
  }
  EXPECT_LE(highest, seabed.highest());
  EXPECT_GT(highest, 0.3);
}

TEST(Survey, RefusesOptionsOutOfRange) {
  for (double SurveyOptions::*field :
       {&SurveyOptions::length, &SurveyOptions::width, &SurveyOptions::wave_length,
        &SurveyOptions::altitude, &SurveyOptions::ping_spacing, &SurveyOptions::opening,
        &SurveyOptions::boulder_radius, &SurveyOptions::trench_width}) {
    for (const double value :
         {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
      SurveyOptions options = small();
      options.*field = value;
      EXPECT_THROW(generate_survey(options), std::invalid_argument);
    }
  }
  SurveyOptions options = small();
  options.beams = 1;
  EXPECT_THROW(generate_survey(options), std::invalid_argument);
  options = small();
  options.origin.x() = NAN;
  EXPECT_THROW(generate_survey(options), std::invalid_argument);
  options = small();
  options.ping_spacing = 1e-9;
  EXPECT_THROW(generate_survey(options), std::invalid_argument);
  options = small();
  options.altitude = 0.2;
  options.wave_height = 2.0;
  EXPECT_THROW(generate_survey(options), std::invalid_argument);
  EXPECT_THROW(survey_height(Values(Values::Matrix::Zero(2)), Values(Values::Matrix::Zero(3))),
               std::invalid_argument);
  for (const double bad : {static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    const Values zero(Values::Matrix::Zero(1)), place(Values::Matrix::Constant(1, bad));
    EXPECT_THROW(survey_height(place, zero), std::invalid_argument);
    EXPECT_THROW(survey_height(zero, place), std::invalid_argument);
  }
}

TEST(Survey, RefusesHeightsThatNoBeamCouldBeFollowedTo) {
  for (double SurveyOptions::*field :
       {&SurveyOptions::altitude, &SurveyOptions::wave_height, &SurveyOptions::ripple_height,
        &SurveyOptions::roughness, &SurveyOptions::boulder_radius, &SurveyOptions::trench_depth}) {
    SurveyOptions options = small();
    options.*field = 1e12;
    EXPECT_THROW(generate_survey(options), std::invalid_argument);
  }
  SurveyOptions options = small();
  options.altitude = 20000.0;
  EXPECT_GT(generate_survey(options).size(), 0);
}

}  // namespace
}  // namespace bathyal
