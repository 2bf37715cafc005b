// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/geometry/rotation_vector.hpp"
#include "bathyal/navigation/dead_reckoning.hpp"
#include "bathyal/navigation/navigation_filter.hpp"

namespace bathyal::test {

/// A motion by formulas alone, all its derivatives exact to a central difference of 10⁻⁴ s: swings
/// in position and attitude about a run of 1.2 m/s along x.
inline SensorTruth truth_at(double t) {
  const auto position = [](double s) {
    return Vec3(1.2 * s + 2.0 * std::sin(0.11 * s), 15.0 * std::sin(0.05 * s),
                -20.0 + 3.0 * std::cos(0.07 * s));
  };
  const auto turn = [](double s) {
    return rotation_of_angles(Vec3(0.1 * std::sin(0.5 * s), 0.15 * std::sin(0.31 * s),
                                   0.8 * std::sin(0.06 * s) + 0.02 * s));
  };
  const double h = 1e-4;
  const auto body_velocity = [&](double s) {
    const Eigen::Matrix3d r = turn(s);
    const Eigen::Matrix3d spin = r.transpose() * (turn(s + h) - turn(s - h)) / (2.0 * h);
    Vec6 v;
    v << r.transpose() * (position(s + h) - position(s - h)) / (2.0 * h), spin(2, 1), spin(0, 2),
        spin(1, 0);
    return v;
  };
  SensorTruth truth;
  truth.time = t;
  truth.world_from_vehicle.linear() = turn(t);
  truth.world_from_vehicle.translation() = position(t);
  truth.velocity = body_velocity(t);
  truth.acceleration = (body_velocity(t + h) - body_velocity(t - h)) / (2.0 * h);
  truth.altitude = 8.0;
  truth.water_velocity = Vec3(0.2, -0.1, 0.0);
  truth.surface = -100.0;  // gps is heard all the time
  return truth;
}

inline SensorOptions device(const std::string& name, SensorKind kind, double rate,
                            std::vector<double> noise) {
  SensorOptions options;
  options.name = name;
  options.kind = kind;
  options.rate = rate;
  for (std::size_t i = 0; i < noise.size(); ++i) options.channels[i].noise = noise[i];
  return options;
}

/// What the filter is off by, in its own error's order.
inline NavigationVector error_of(const NavigationEstimate& estimate, const SensorTruth& truth,
                                 const Vec3& gyro_bias, const Vec3& accel_bias) {
  NavigationVector error = NavigationVector::Zero();
  const Eigen::Matrix3d r = truth.world_from_vehicle.linear();
  error.segment<3>(0) = truth.world_from_vehicle.translation() - estimate.position;
  error.segment<3>(3) = r * truth.velocity.head<3>() - estimate.velocity;
  const Eigen::AngleAxisd turn(r * estimate.world_from_vehicle().linear().transpose());
  error.segment<3>(6) = turn.angle() * turn.axis();
  error.segment<3>(9) = gyro_bias - estimate.gyro_bias;
  error.segment<3>(12) = accel_bias - estimate.accel_bias;
  return error;
}

/// An imu of 50 Hz, dvl, depth, compass and gps, each with its noise, and the filter's options.
inline NavigationOptions usual_options() {
  NavigationOptions options;
  const double gyro = 2e-4, accel = 2e-3, rate = 50.0;
  options.gyro_noise = gyro;
  options.accel_noise = accel;
  options.initial_position.setConstant(1.0);
  options.initial_velocity.setConstant(0.1);
  options.initial_attitude = Vec3(0.01, 0.01, 0.03);
  options.initial_gyro_bias = 1e-4;
  options.initial_accel_bias = 5e-3;
  options.gyro_walk = 1e-6;
  options.accel_walk = 1e-5;
  const double g = gyro * std::sqrt(rate), a = accel * std::sqrt(rate);
  SensorOptions imu = device("imu", SensorKind::imu, rate, {g, g, g, a, a, a});
  for (std::size_t i = 0; i < 6; ++i) {
    imu.channels[i].bias = i < 3 ? options.initial_gyro_bias : options.initial_accel_bias;
    imu.channels[i].walk = i < 3 ? options.gyro_walk : options.accel_walk;
  }
  options.devices = {imu, device("dvl", SensorKind::dvl, 5.0, {0.01, 0.01, 0.01}),
                     device("depth", SensorKind::depth, 5.0, {0.05}),
                     device("compass", SensorKind::compass, 2.0, {0.005, 0.005, 0.02}),
                     device("gps", SensorKind::gps, 0.2, {0.5, 0.5, 1.0})};
  options.devices[1].vehicle_from_sensor.translation() = Vec3(0.4, 0.0, -0.2);
  return options;
}

/// The start as wrong as the options say, drawn by the seed.
inline NavigationState wrong_start(const NavigationFilter& filter, std::uint64_t seed) {
  const NavigationOptions& o = filter.options();
  RandomStream draw(seed, 77);
  const auto off = [&](const Vec3& deviation) {
    const double x = draw.normal(), y = draw.normal(), z = draw.normal();
    return Vec3(deviation.cwiseProduct(Vec3(x, y, z)));
  };
  const SensorTruth truth = truth_at(0.0);
  const Eigen::Matrix3d r = truth.world_from_vehicle.linear();
  Pose pose = truth.world_from_vehicle;
  pose.translation() += off(o.initial_position);
  pose.linear() = rotation_of(-off(o.initial_attitude)) * r;
  return filter.start(0.0, pose, r * truth.velocity.head<3>() + off(o.initial_velocity));
}

/// Runs all devices and the filter until `end`, and hands every estimate just after it changed to
/// `each(truth, state)` at whole seconds. Readings come at their arrival.
template <class Each>
void run(const NavigationFilter& filter, NavigationState& state, std::uint64_t seed, double end,
         const Each& each, std::vector<NavigationStep>* record = nullptr) {
  const auto& devices = filter.options().devices;
  std::vector<SensorState> sensors(devices.size());
  std::multimap<double, std::pair<int, SensorReading>> coming;
  const double step = 1.0 / devices[0].rate;
  const auto steps = static_cast<int>(std::lround(end / step));
  for (int k = 0; k <= steps; ++k) {
    const SensorTruth truth = truth_at(k * step);
    for (std::size_t d = 0; d < devices.size(); ++d) {
      const auto reading = sample(devices[d], sensors[d], truth, seed);
      if (!reading) continue;
      if (d == 0) filter.update(state, 0, *reading, record);
      if (d > 0) coming.insert({reading->arrival, {static_cast<int>(d), *reading}});
    }
    while (!coming.empty() && coming.begin()->first <= truth.time + 1e-9) {
      filter.update(state, coming.begin()->second.first, coming.begin()->second.second, record);
      coming.erase(coming.begin());
    }
    if (k > 0 && k % static_cast<int>(devices[0].rate) == 0) each(truth, state, sensors);
  }
}

/// Biases of the imu at its last sample: what a sample without noise is off by.
inline Vec6 imu_bias(const SensorOptions& imu, const SensorState& state, std::uint64_t seed) {
  SensorOptions quiet = imu;
  for (SensorChannel& c : quiet.channels) c.noise = c.walk = 0.0;
  SensorState again = state;
  --again.index;
  SensorTruth rest;
  rest.time = state.time;
  rest.gravity = 0.0;
  return Eigen::Map<const Vec6>(sample(quiet, again, rest, seed)->values.data());
}

/// Normalised square of the first 15 errors: 15 on the mean where the covariance is right.
inline double nees(const NavigationEstimate& estimate, const NavigationVector& error) {
  const Eigen::Matrix<double, 15, 1> e = error.head<15>();
  const Eigen::Matrix<double, 15, 15> p = estimate.covariance.topLeftCorner<15, 15>();
  return e.dot(p.ldlt().solve(e));
}

}  // namespace bathyal::test
