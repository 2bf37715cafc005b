// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/internal/filter_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/geometry/rotation_vector.hpp"
#include "bathyal/navigation/internal/chi_square.hpp"
#include "navigation/simulated_run.hpp"

namespace bathyal {
namespace {

constexpr double kOff = 1e-6;

/// An estimate with nothing at zero.
NavigationEstimate estimate_of(int input) {
  NavigationEstimate e;
  e.position = Vec3(3.0, -4.0, -12.0);
  e.velocity = Vec3(1.2, 0.4, -0.1);
  e.attitude = Eigen::Quaterniond(rotation_of(Vec3(0.2, -0.3, 1.1))).coeffs();
  e.gyro_bias = Vec3(0.01, -0.02, 0.03);
  e.accel_bias = Vec3(-0.1, 0.2, 0.1);
  e.log_scale = 0.04;
  e.log_mount = Vec3(0.02, -0.01, 0.03);
  e.current = Eigen::Vector2d(0.3, -0.2);
  e.fix_lever = Vec3(0.5, 0.2, 0.1);
  e.input = input;
  e.rate = Vec3(0.1, -0.2, 0.3);
  e.force = input == 1 ? Vec3(0.4, 0.3, 9.7) : Vec3(1.3, 0.1, -0.1);
  e.reported = Eigen::Quaterniond(rotation_of(Vec3(0.2, -0.3, 1.0))).coeffs();
  return e;
}

NavigationEstimate moved(NavigationEstimate estimate, int error, double by) {
  NavigationVector off = NavigationVector::Zero();
  off[error] = by;
  add_error(estimate, off);
  return estimate;
}

class Slopes : public testing::TestWithParam<SensorKind> {};

TEST_P(Slopes, AreTheDifferencesOfWhatIsPredicted) {
  NavigationOptions options;
  SensorOptions device = test::device("device", GetParam(), 1.0, {});
  device.vehicle_from_sensor.translation() = Vec3(0.7, -0.3, 0.4);
  device.vehicle_from_sensor.linear() = rotation_of(Vec3(0.1, 0.4, -0.6));
  device.beacons = {Vec3(10.0, 20.0, -5.0), Vec3(-30.0, 5.0, 0.0)};
  SensorReading reading;
  reading.kind = GetParam();
  reading.count = device.channel_count();
  const NavigationEstimate estimate = estimate_of(1);
  const Observation here = observe(options, estimate, device, reading);
  for (int j = 0; j < kNavigationErrors; ++j) {
    const Observation above = observe(options, moved(estimate, j, kOff), device, reading);
    const Observation below = observe(options, moved(estimate, j, -kOff), device, reading);
    const ObservationVector slope = (below.innovation - above.innovation) / (2.0 * kOff);
    EXPECT_LT((slope - here.slope.col(j)).norm(), 1e-7) << "error " << j;
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, Slopes,
                         testing::Values(SensorKind::depth, SensorKind::dvl, SensorKind::compass,
                                         SensorKind::gps, SensorKind::usbl, SensorKind::lbl,
                                         SensorKind::current));

/// Rows of the transition against differences of what the prediction makes of moved estimates.
void expect_transition(const NavigationEstimate& estimate, const NavigationInput& input) {
  NavigationOptions options;
  NavigationEstimate middle = estimate;
  const Transition step = apply_prediction(options, middle, input);
  for (int j = 0; j < kNavigationErrors; ++j) {
    NavigationEstimate above = moved(estimate, j, kOff), below = moved(estimate, j, -kOff);
    apply_prediction(options, above, input);
    apply_prediction(options, below, input);
    Eigen::Matrix<double, 9, 1> slope;
    slope << above.position - below.position, above.velocity - below.velocity,
        vector_of(above.world_from_vehicle().linear() *
                  below.world_from_vehicle().linear().transpose());
    slope /= 2.0 * kOff;
    EXPECT_LT((slope - step.top.col(j)).norm(), 2e-4) << "error " << j;
    EXPECT_NEAR((above.current - below.current).norm() / (2.0 * kOff),
                j == kCurrent || j == kCurrent + 1 ? step.current_kept : 0.0, 1e-7);
  }
}

TEST(Transition, OfInertialSamplesIsTheDifferenceOfWhatIsPredicted) {
  NavigationInput input;
  input.kind = 1;
  input.time = 0.02;
  input.first = Vec3(0.2, -0.1, 0.35);
  input.second = Vec3(0.5, 0.2, 9.9);
  expect_transition(estimate_of(1), input);
}

TEST(Transition, OfAReckonedMotionIsTheDifferenceOfWhatIsPredicted) {
  NavigationInput input;
  input.kind = 2;
  input.time = 0.5;
  input.attitude = Eigen::Quaterniond(rotation_of(Vec3(0.25, -0.3, 1.1))).coeffs();
  input.second = Vec3(1.4, 0.2, 0.0);
  NavigationEstimate estimate = estimate_of(2);
  expect_transition(estimate, input);
}

/// Without noise the covariance goes by the transition's own rows.
TEST(Transition, OfInertialSamplesCarriesTheCovariance) {
  NavigationInput input;
  input.kind = 1;
  input.time = 0.3;
  input.first = Vec3(0.2, -0.1, 0.35);
  input.second = Vec3(0.5, 0.2, 9.9);
  NavigationEstimate estimate = estimate_of(1);
  const NavigationMatrix any = NavigationMatrix::Identity() + 0.3 * NavigationMatrix::Ones();
  estimate.covariance = any;
  const Transition step = apply_prediction(NavigationOptions(), estimate, input);
  NavigationMatrix f = NavigationMatrix::Identity();
  f.topRows<Transition::kTop>() = step.top;
  f(kCurrent, kCurrent) = f(kCurrent + 1, kCurrent + 1) = step.current_kept;
  EXPECT_LT((estimate.covariance - f * any * f.transpose()).norm(), 1e-12);
}

/// Tables: 95 % points of 1, 3, 6 and 12 degrees of freedom.
TEST(ChiSquare, TailsAreAsInTheTables) {
  EXPECT_NEAR(chi_square_tail(3.8415, 1), 0.05, 1e-5);
  EXPECT_NEAR(chi_square_tail(7.8147, 3), 0.05, 1e-5);
  EXPECT_NEAR(chi_square_tail(12.5916, 6), 0.05, 1e-5);
  EXPECT_NEAR(chi_square_tail(21.0261, 12), 0.05, 1e-5);
  EXPECT_EQ(chi_square_tail(0.0, 3), 1.0);
}

}  // namespace
}  // namespace bathyal
