// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/effects/measurements.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "bathyal/identify/model/calibration_data.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Touches good_touches() {
  Touches touches;
  touches.q.resize(5, 2);
  touches.q << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0;
  touches.point = {3, 3, 8, 8, 8};
  return touches;
}

Tracked good_tracked() {
  Tracked tracked;
  tracked.q = good_touches().q;
  tracked.position.setRandom(5, 3);
  return tracked;
}

/// What `check` says; empty when it is content.
template <class Data>
std::string said(Data data, const std::function<void(Data&)>& spoil) {
  spoil(data);
  try {
    data.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string of_touches(const std::function<void(Touches&)>& spoil) {
  return said<Touches>(good_touches(), spoil);
}

bool names(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Touches, GoodOnesAreTaken) {
  EXPECT_EQ(of_touches([](Touches&) {}), "");
  EXPECT_EQ(said<Tracked>(good_tracked(), [](Tracked&) {}), "");
}

TEST(Touches, DegreesAreRefusedWithTheWayOut) {
  const std::string text = of_touches([](Touches& t) { t.q(2, 1) = -30.0; });
  EXPECT_TRUE(names(text, "`q`: expected radians"));
  EXPECT_TRUE(names(text, "`q_deg`"));
  EXPECT_TRUE(names(text, "unit=\"deg\""));
  EXPECT_TRUE(names(text, "got -30 at row 2, joint 1"));
  // Two turns either way are radians still.
  EXPECT_EQ(of_touches([](Touches& t) { t.q(2, 1) = -12.5; }), "");
}

TEST(Touches, EachArgumentIsRefusedByItsName) {
  EXPECT_TRUE(names(of_touches([](Touches& t) { t.q(0, 0) = kNan; }), "`q`: expected finite"));
  EXPECT_TRUE(names(of_touches([](Touches& t) { t.q.setConstant(0.3); }), "poses that differ"));
  EXPECT_TRUE(names(of_touches([](Touches& t) { t.point.pop_back(); }), "`point`: expected 5"));
  EXPECT_TRUE(names(of_touches([](Touches& t) {
                      t.point = {1, 2, 3, 4, 5};
                    }),
                    "a point that is touched in two poses or more, got one pose for each of 5"));
  EXPECT_TRUE(names(of_touches([](Touches& t) { t.weights = {1, 1, 0, 1, 1}; }), "`weights`"));
  EXPECT_TRUE(names(of_touches([](Touches& t) { t.tool = {0, 2, 0, 2, 0}; }), "`tool`"));
  EXPECT_TRUE(names(of_touches([](Touches& t) { t.station = {1, 1, 1, 1, 1}; }), "`station`"));
  EXPECT_TRUE(names(of_touches([](Touches& t) {
                      t.known_distances = {{3, 4, 0.1}};
                    }),
                    "`known_distances`: expected labels that occur in `point`, got 4"));
  EXPECT_TRUE(names(of_touches([](Touches& t) {
                      t.known_distances = {{3, 3, 0.1}};
                    }),
                    "point 3 with itself"));
  EXPECT_TRUE(names(of_touches([](Touches& t) {
                      t.known_distances = {{3, 8, kNan}};
                    }),
                    "`known_distances`"));
  EXPECT_TRUE(names(of_touches([](Touches& t) {
                      t.known_points = {{3, Vec3::Zero()}, {3, Vec3::Ones()}};
                    }),
                    "3 twice"));
  EXPECT_TRUE(names(of_touches([](Touches& t) {
                      t.planes = {{"deck", {0, 1, 2, 9}}};
                    }),
                    "`planes deck`: expected rows of `q`"));
  EXPECT_TRUE(names(of_touches([](Touches& t) {
                      t.planes = {{"deck", {0, 1, 2, 2}}};
                    }),
                    "one plane only"));
  EXPECT_TRUE(names(of_touches([](Touches& t) { t.covariates["load"].setZero(3, 1); }),
                    "`covariates load`"));
  EXPECT_TRUE(names(of_touches([](Touches& t) { t.covariates["load"].resize(5, 0); }),
                    "`covariates load`: expected one column"));
  EXPECT_TRUE(
      names(of_touches([](Touches& t) { t.covariates["load"] = RowMatrix::Constant(5, 1, 1e200); }),
            "`covariates load`: expected finite"));
  EXPECT_EQ(of_touches([](Touches& t) { t.covariates["load"] = RowMatrix::Constant(5, 1, kNan); }),
            "");
  EXPECT_TRUE(names(of_touches([](Touches& t) {
                      t.weights = {1.0, 1.0, 1.0, 1.0, 1e-30};
                    }),
                    "`weights`: expected numbers within"));
}

TEST(Touches, APlaneMakesUpForPointsTouchedOnce) {
  EXPECT_EQ(of_touches([](Touches& t) {
              t.point = {1, 2, 3, 4, 5};
              t.planes = {{"deck", {0, 1, 2, 3}}};
            }),
            "");
}

TEST(Tracked, EachArgumentIsRefusedByItsName) {
  const auto of = [](const std::function<void(Tracked&)>& spoil) {
    return said<Tracked>(good_tracked(), spoil);
  };
  EXPECT_TRUE(
      names(of([](Tracked& t) { t.position(1, 1) = kNan; }), "`position`: expected finite"));
  EXPECT_TRUE(names(of([](Tracked& t) { t.position(1, 1) = 2e9; }), "at row 1"));
  EXPECT_TRUE(names(of([](Tracked& t) { t.position.conservativeResize(4, 3); }), "`position`"));
  EXPECT_TRUE(names(of([](Tracked& t) {
                      Pose mirror = Pose::Identity();
                      mirror.linear()(0, 0) = -1.0;
                      t.pose.assign(5, mirror);
                    }),
                    "`pose`: expected rotations of determinant 1"));
  EXPECT_TRUE(names(of([](Tracked& t) {
                      t.q.conservativeResize(1, 2);
                      t.position.conservativeResize(1, 3);
                    }),
                    "two poses or more"));
}

TEST(Measurement, AnotherNumberOfJointsIsRefused) {
  try {
    to_measurement(ur10e(), good_touches());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(names(error.what(), "`q`: expected 6 columns"));
  }
}

TEST(Measurement, LabelsAreCountedInRisingOrder) {
  Touches touches = good_touches();
  touches.point = {8, 8, -2, -2, 8};
  touches.known_distances = {{8, -2, 0.5}};
  touches.weights = {1, 1, 2, 2, 4};
  const Measurement m = to_measurement(planar_arm(), touches);
  EXPECT_EQ(m.labels, (std::vector<int>{-2, 8}));
  EXPECT_EQ(m.point, (std::vector<int>{1, 1, 0, 0, 1}));
  EXPECT_EQ(m.distances[0].first, 1);
  EXPECT_EQ(m.distances[0].second, 0);
  EXPECT_DOUBLE_EQ(m.weights[4], 2.0);  // of mean 1
  EXPECT_DOUBLE_EQ(free_position_rows(m), 9.0);
}

TEST(Measurement, SomeRowsAreThoseRows) {
  const Measurement m = to_measurement(planar_arm(), good_tracked());
  const Measurement some = subset(m, {0, 3});
  ASSERT_EQ(some.rows(), 2);
  EXPECT_EQ(some.q.row(1), m.q.row(3));
  EXPECT_EQ(some.position.col(1), m.position.col(3));
  EXPECT_EQ(some.station.size(), 2U);
  EXPECT_EQ(some.perturbation_rows, (std::vector<int>{0, 3}));
}

}  // namespace
}  // namespace bathyal
