// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "bathyal/geometry/rotation_vector.hpp"

namespace bathyal {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

SensorOptions sensor(SensorKind kind, double rate = 1.0) {
  SensorOptions options;
  options.name = sensor_kind_name(kind);
  options.kind = kind;
  options.rate = rate;
  return options;
}

SensorTruth at_time(double time) {
  SensorTruth truth;
  truth.time = time;
  return truth;
}

void expect_values(const SensorReading& reading, const std::vector<double>& expected,
                   double tolerance = 1e-12) {
  ASSERT_EQ(reading.count, static_cast<int>(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(reading.values[i], expected[i], tolerance) << i;
  }
}

TEST(Sensor, MeasuresTheTruthInItsUnits) {
  SensorTruth truth;
  truth.world_from_vehicle.translation() = Vec3(3.0, 4.0, -20.0);
  truth.velocity << 1.5, 0.1, -0.2, 0.0, 0.0, 0.3;
  truth.water_velocity = Vec3(0.5, 0.0, 0.0);
  truth.altitude = 7.0;
  truth.propeller_rate = 12.0;
  truth.leak = 0.4;
  expect_values(ideal_reading(sensor(SensorKind::depth), truth), {20.0});
  expect_values(ideal_reading(sensor(SensorKind::altimeter), truth), {7.0});
  expect_values(ideal_reading(sensor(SensorKind::rpm), truth), {12.0});
  expect_values(ideal_reading(sensor(SensorKind::leak), truth), {0.4});
  expect_values(ideal_reading(sensor(SensorKind::dvl), truth), {1.5, 0.1, -0.2});
  expect_values(ideal_reading(sensor(SensorKind::current), truth), {-1.0, -0.1, 0.2});
  // v̇ = 0 in the turning frame: the centripetal acceleration is ω × v.
  expect_values(ideal_reading(sensor(SensorKind::imu), truth), {0.0, 0.0, 0.3, -0.03, 0.45, 9.81});
}

TEST(Sensor, AMountTurnsAndMovesWhatIsFelt) {
  SensorOptions options = sensor(SensorKind::imu);
  options.vehicle_from_sensor.linear() = rotation_of(Vec3(0.0, 0.0, std::numbers::pi / 2.0));
  options.vehicle_from_sensor.translation() = Vec3(2.0, 0.0, 0.0);
  SensorTruth truth;
  truth.velocity << 0.0, 0.0, 0.0, 0.0, 0.0, 0.5;
  truth.acceleration << 0.0, 0.0, 0.0, 0.0, 0.0, 0.1;
  // In the vehicle: −ω² r along x, ω̇ r along y; the sensor's x is the vehicle's y.
  expect_values(ideal_reading(options, truth), {0.0, 0.0, 0.5, 0.2, 0.5, 9.81});
  options.kind = SensorKind::dvl;
  expect_values(ideal_reading(options, truth), {1.0, 0.0, 0.0});
}

TEST(Sensor, CompassAnglesMakeTheAttitudeAgain) {
  SensorTruth truth;
  truth.world_from_vehicle.linear() = rotation_of(Vec3(0.3, -0.7, 1.9));
  const SensorReading reading = ideal_reading(sensor(SensorKind::compass), truth);
  const Eigen::Matrix3d again = (Eigen::AngleAxisd(reading.values[2], Vec3::UnitZ()) *
                                 Eigen::AngleAxisd(reading.values[1], Vec3::UnitY()) *
                                 Eigen::AngleAxisd(reading.values[0], Vec3::UnitX()))
                                    .toRotationMatrix();
  EXPECT_LT((again - truth.world_from_vehicle.linear()).norm(), 1e-12);
}

TEST(Sensor, GpsIsValidOnlyAboveTheSurface) {
  const SensorOptions gps = sensor(SensorKind::gps);
  SensorTruth truth;
  truth.world_from_vehicle.translation().z() = -0.5;
  EXPECT_FALSE(ideal_reading(gps, truth).valid);
  truth.surface = -0.6;  // in a trough
  EXPECT_TRUE(ideal_reading(gps, truth).valid);
}

TEST(Sensor, AUsblFixIsLateByTheTwoWayTravelTime) {
  SensorOptions usbl = sensor(SensorKind::usbl);
  usbl.beacons = {Vec3(600.0, 0.0, 0.0)};
  SensorTruth truth = at_time(10.0);
  truth.world_from_vehicle.translation() = Vec3(0.0, 0.0, -800.0);
  const SensorReading reading = ideal_reading(usbl, truth);
  EXPECT_EQ(reading.time, 10.0);
  EXPECT_NEAR(reading.arrival - reading.time, 1.3333, 1e-4);
  usbl.range = 999.0;
  EXPECT_FALSE(ideal_reading(usbl, truth).valid);
}

TEST(Sensor, NothingToMeasureIsSaid) {
  SensorOptions altimeter = sensor(SensorKind::altimeter);
  SensorTruth truth;
  truth.altitude = kNaN;
  EXPECT_FALSE(ideal_reading(altimeter, truth).valid);
  SensorOptions dvl = sensor(SensorKind::dvl);
  dvl.range = 30.0;
  EXPECT_FALSE(ideal_reading(dvl, truth).valid);
  truth.altitude = 29.0;
  EXPECT_TRUE(ideal_reading(dvl, truth).valid);
}

TEST(Sensor, SamplesAtItsRate) {
  const SensorOptions options = sensor(SensorKind::depth, 5.0);
  SensorState state;
  int count = 0;
  for (int k = 0; k < 1000; ++k) {
    const auto reading = sample(options, state, at_time(0.01 * k), 1);
    if (!reading) continue;
    EXPECT_NEAR(reading->time, 0.2 * count, 1e-9);
    EXPECT_EQ(reading->index, count);
    ++count;
  }
  EXPECT_EQ(count, 50);
  EXPECT_NEAR(next_time(options, state), 10.0, 1e-12);
}

std::vector<double> noise_of(const SensorOptions& options, std::uint64_t seed, int count) {
  SensorState state;
  std::vector<double> values;
  for (int k = 0; k < count; ++k) {
    const auto reading = sample(options, state, at_time(next_time(options, state)), seed);
    if (reading) values.push_back(reading->values[0]);
  }
  return values;
}

TEST(Sensor, NoiseHangsOnSeedNameAndIndexAlone) {
  SensorOptions options = sensor(SensorKind::depth);
  options.channels[0] = {.noise = 1.0, .bias = 1.0};
  const std::vector<double> first = noise_of(options, 7, 20);
  EXPECT_EQ(first, noise_of(options, 7, 20));
  EXPECT_NE(first, noise_of(options, 8, 20));
  options.name = "depth two";
  EXPECT_NE(first, noise_of(options, 7, 20));
  options.name = "depth";
  SensorState late;  // begins with the sixth sample
  EXPECT_EQ(sample(options, late, at_time(5.0), 7)->values[0], first[5]);
}

double deviation(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double v : values) {
    sum += v;
    squares += v * v;
  }
  const auto n = static_cast<double>(values.size());
  return std::sqrt(squares / n - sum * sum / (n * n));
}

TEST(Sensor, ErrorsHaveTheSizesAskedFor) {
  SensorOptions options = sensor(SensorKind::depth);
  options.channels[0] = {.noise = 0.3};
  EXPECT_NEAR(deviation(noise_of(options, 1, 40000)), 0.3, 0.005);
  options.channels[0] = {.markov = 0.2, .markov_time = 4.0};
  EXPECT_NEAR(deviation(noise_of(options, 1, 40000)), 0.2, 0.006);
  options.channels[0] = {.outlier_rate = 0.1, .outlier_size = 10.0};
  EXPECT_NEAR(deviation(noise_of(options, 1, 40000)), std::sqrt(10.0), 0.1);
  options.channels[0] = {};
  options.dropout = 0.25;
  EXPECT_NEAR(static_cast<double>(noise_of(options, 1, 40000).size()) / 40000.0, 0.75, 0.01);
  std::vector<double> biases;
  options.dropout = 0.0;
  options.channels[0] = {.bias = 0.5};
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const std::vector<double> two = noise_of(options, seed, 2);
    EXPECT_EQ(two[0], two[1]);
    biases.push_back(two[0]);
  }
  EXPECT_NEAR(deviation(biases), 0.5, 0.02);
}

TEST(Sensor, QuantumRounds) {
  SensorOptions options = sensor(SensorKind::depth);
  options.channels[0] = {.noise = 1.0, .quantum = 0.25};
  for (const double value : noise_of(options, 1, 100)) {
    EXPECT_EQ(value, 0.25 * std::round(value / 0.25));
  }
}

void expect_refused(const SensorOptions& options, const std::string& field) {
  try {
    options.check();
    ADD_FAILURE() << field << " was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).rfind("`" + field, 0), 0U) << error.what();
  }
}

TEST(Sensor, RefusesBadOptions) {
  SensorOptions good = sensor(SensorKind::depth);
  EXPECT_NO_THROW(good.check());
  SensorOptions bad = good;
  bad.name.clear();
  expect_refused(bad, "name");
  bad = good;
  bad.rate = -1.0;
  expect_refused(bad, "rate");
  bad = good;
  bad.latency = kNaN;
  expect_refused(bad, "latency");
  bad = good;
  bad.dropout = 1.5;
  expect_refused(bad, "dropout");
  bad = good;
  bad.channels[2].noise = -0.1;
  expect_refused(bad, "channels[2].noise");
  bad = good;
  bad.channels[0].markov = 1.0;
  expect_refused(bad, "channels[0].markov_time");
  expect_refused(sensor(SensorKind::usbl), "beacons");
  EXPECT_THROW(sensor_kind("sextant"), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
