// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/internal/filter_steps.hpp"

#include <cmath>

#include "bathyal/geometry/rotation_vector.hpp"
#include "bathyal/navigation/internal/chi_square.hpp"

namespace bathyal {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;

Quaterniond quaternion_of(const Eigen::Vector4d& xyzw) { return Quaterniond(xyzw); }

/// exp of a rotation vector; the series keeps turns of 10⁻⁹ rad.
Quaterniond turn_by(const Vec3& vector) {
  const double half = 0.5 * vector.norm();
  const double sine_over = half < 1e-4 ? 0.5 - half * half / 12.0 : 0.5 * std::sin(half) / half;
  const Vec3 imaginary = sine_over * vector;
  return Quaterniond(std::cos(half), imaginary.x(), imaginary.y(), imaginary.z()).normalized();
}

double square(double value) { return value * value; }

void add_noise(NavigationMatrix& p, int at, double variance) {
  for (int i = 0; i < 3; ++i) p(at + i, at + i) += variance;
}

void fade_current(NavigationMatrix& p, double kept) {
  p.middleCols<2>(kCurrent) *= kept;
  p.middleRows<2>(kCurrent) *= kept;
}

/// P ← F P Fᵀ
void transport(NavigationMatrix& p, const Transition& step) {
  constexpr int kTop = Transition::kTop;
  constexpr int kRest = kNavigationErrors - kTop;
  const Eigen::Matrix<double, kTop, kNavigationErrors> rows = step.top * p;
  p.topLeftCorner<kTop, kTop>().noalias() = rows * step.top.transpose();
  p.topRightCorner<kTop, kRest>() = rows.rightCols<kRest>();
  p.bottomLeftCorner<kRest, kTop>() = rows.rightCols<kRest>().transpose();
  fade_current(p, step.current_kept);
}

/// Of quantities that keep their value but for noise; the current fades.
void age(const NavigationOptions& options, NavigationEstimate& estimate, double dt,
         const Transition& step) {
  NavigationMatrix& p = estimate.covariance;
  add_noise(p, kAttitude, square(options.gyro_noise) * dt);
  add_noise(p, kGyroBias, square(options.gyro_walk) * dt);
  add_noise(p, kAccelBias, square(options.accel_walk) * dt);
  estimate.current *= step.current_kept;
  const double fresh = square(options.current) * (1.0 - square(step.current_kept));
  p(kCurrent, kCurrent) += fresh;
  p(kCurrent + 1, kCurrent + 1) += fresh;
  estimate.time += dt;
}

/// \param lean by which an error of attitude changes the velocity \param turn dt times the attitude
/// in the middle of the step
Transition inertial_transition(const Matrix3d& lean, const Matrix3d& turn, double dt) {
  Transition step;
  step.top.block<3, 3>(kVelocity, kAttitude) = lean;
  step.top.block<3, 3>(kVelocity, kGyroBias) = -0.5 * lean * turn;
  step.top.block<3, 3>(kVelocity, kAccelBias) = -turn;
  step.top.block<3, 3>(kAttitude, kGyroBias) = -turn;
  step.top.block<3, 9>(kPosition, kAttitude) =
      0.5 * dt * step.top.block<3, 9>(kVelocity, kAttitude);
  step.top.block<3, 3>(kPosition, kVelocity).diagonal().setConstant(dt);
  return step;
}

/// The same as transport(), by the blocks that are not 0.
void transport_inertial(NavigationMatrix& p, const Transition& step) {
  constexpr int kTop = Transition::kTop;
  constexpr int kRest = kNavigationErrors - kTop;
  const double dt = step.top(kPosition, kVelocity);
  const Eigen::Matrix<double, 3, 9> push = step.top.block<3, 9>(kVelocity, kAttitude);
  const Matrix3d turn = step.top.block<3, 3>(kAttitude, kGyroBias);
  Eigen::Matrix<double, kTop, kNavigationErrors> rows = p.topRows<kTop>();
  const Eigen::Matrix<double, 3, kNavigationErrors> gained =
      push.lazyProduct(p.middleRows<9>(kAttitude));
  rows.middleRows<3>(kPosition) += dt * rows.middleRows<3>(kVelocity) + 0.5 * dt * gained;
  rows.middleRows<3>(kVelocity) += gained;
  rows.middleRows<3>(kAttitude) += turn.lazyProduct(p.middleRows<3>(kGyroBias));
  const Eigen::Matrix<double, kTop, 3> across =
      rows.middleCols<9>(kAttitude).lazyProduct(push.transpose());
  auto corner = p.topLeftCorner<kTop, kTop>();
  corner = rows.leftCols<kTop>();
  corner.middleCols<3>(kPosition) += dt * rows.middleCols<3>(kVelocity) + 0.5 * dt * across;
  corner.middleCols<3>(kVelocity) += across;
  corner.middleCols<3>(kAttitude) += rows.middleCols<3>(kGyroBias).lazyProduct(turn.transpose());
  p.topRightCorner<kTop, kRest>() = rows.rightCols<kRest>();
  p.bottomLeftCorner<kRest, kTop>() = rows.rightCols<kRest>().transpose();
  fade_current(p, step.current_kept);
}

/// Strapdown: rates and forces are the means over the step.
Transition go_inertial(const NavigationOptions& options, NavigationEstimate& estimate, double dt,
                       const Vec3& rate, const Vec3& force) {
  const Quaterniond start = quaternion_of(estimate.attitude);
  const Vec3 turn = (rate - estimate.gyro_bias) * dt;
  const Matrix3d middle = (start * turn_by(0.5 * turn)).toRotationMatrix();
  const Vec3 push = middle * (force - estimate.accel_bias);
  const Vec3 acceleration = push - Vec3(0.0, 0.0, options.gravity);
  estimate.attitude = (start * turn_by(turn)).normalized().coeffs();
  estimate.position += dt * estimate.velocity + 0.5 * dt * dt * acceleration;
  estimate.velocity += dt * acceleration;

  Transition step = inertial_transition(-dt * cross_matrix(push), dt * middle, dt);
  step.current_kept = std::exp(-dt / options.current_time);
  NavigationMatrix& p = estimate.covariance;
  transport_inertial(p, step);
  const double density = square(options.accel_noise);
  add_noise(p, kPosition, density * dt * dt * dt / 3.0);
  add_noise(p, kVelocity, density * dt);
  for (int i = 0; i < 3; ++i) {
    p(kPosition + i, kVelocity + i) += 0.5 * density * dt * dt;
    p(kVelocity + i, kPosition + i) += 0.5 * density * dt * dt;
  }
  age(options, estimate, dt, step);
  return step;
}

/// How the velocity that is reckoned from a log hangs on the errors, in the world: the log reads
/// (1 + scale) (1 − [mount]×) times the velocity through the water.
Eigen::Matrix<double, 3, kNavigationErrors> reckoned_slope(const Matrix3d& turn, const Vec3& body,
                                                           const Vec3& log, double scale) {
  Eigen::Matrix<double, 3, kNavigationErrors> slope =
      Eigen::Matrix<double, 3, kNavigationErrors>::Zero();
  slope.block<3, 3>(0, kAttitude) = -cross_matrix(turn * body);
  slope.col(kLogScale) = -turn * body / (1.0 + scale);
  slope.block<3, 3>(0, kLogMount) = -turn * cross_matrix(log) / (1.0 + scale);
  slope.block<2, 2>(0, kCurrent).setIdentity();
  return slope;
}

Transition go_reckoned(const NavigationOptions& options, NavigationEstimate& estimate, double dt,
                       const Quaterniond& turn, const Vec3& log, double walk) {
  Transition step;
  step.current_kept = std::exp(-dt / options.current_time);
  estimate.attitude = (quaternion_of(estimate.attitude) * turn).normalized().coeffs();
  const Matrix3d now = quaternion_of(estimate.attitude).toRotationMatrix();
  const Vec3 body = (log + estimate.log_mount.cross(log)) / (1.0 + estimate.log_scale);
  Vec3 velocity = now * body;
  velocity.head<2>() += step.current_kept * estimate.current;
  const Vec3 before = estimate.input == 2 ? estimate.velocity : velocity;
  estimate.position += 0.5 * dt * (before + velocity);
  estimate.velocity = velocity;

  Eigen::Matrix<double, 3, kNavigationErrors> slope =
      reckoned_slope(now, body, log, estimate.log_scale);
  slope.middleCols<2>(kCurrent) *= step.current_kept;
  step.top.middleRows<3>(kVelocity) = slope;
  step.top.middleRows<3>(kPosition) += 0.5 * dt * slope;
  step.top.block<3, 3>(kPosition, kVelocity).diagonal().setConstant(0.5 * dt);
  NavigationMatrix& p = estimate.covariance;
  transport(p, step);
  add_noise(p, kPosition, (square(options.log_walk) + square(walk)) * dt);
  add_noise(p, kVelocity, square(options.log_noise));
  age(options, estimate, dt, step);
  return step;
}

}  // namespace

Transition apply_prediction(const NavigationOptions& options, NavigationEstimate& estimate,
                            const NavigationInput& input) {
  const double dt = input.time - estimate.time;
  const bool goes_on = estimate.input == input.kind;
  Transition step;
  if (input.kind == 1) {
    if (goes_on && dt > 0.0) {
      step = go_inertial(options, estimate, dt, 0.5 * (estimate.rate + input.first),
                         0.5 * (estimate.force + input.second));
    }
    estimate.rate = input.first;
  } else {
    const Quaterniond turn =
        goes_on ? quaternion_of(estimate.reported).conjugate() * quaternion_of(input.attitude)
                : Quaterniond::Identity();
    step = go_reckoned(options, estimate, goes_on ? dt : 0.0, turn, input.second, input.first.x());
    if (goes_on && input.time > estimate.input_time) {
      // since the last report, not since the attitude that was held for a reading in between: that
      // would swing by what was held too far
      const Quaterniond held = turn_by(estimate.rate * (estimate.time - estimate.input_time));
      const Quaterniond last = quaternion_of(estimate.reported) * held.conjugate();
      const Quaterniond turned = last.conjugate() * quaternion_of(input.attitude);
      estimate.rate = vector_of(turned.toRotationMatrix()) / (input.time - estimate.input_time);
    }
    estimate.reported = input.attitude;
  }
  estimate.force = input.second;
  estimate.input = input.kind;
  estimate.input_time = input.time;
  estimate.time = input.time;
  return step;
}

Transition hold_until(const NavigationOptions& options, NavigationEstimate& estimate, double time) {
  const double dt = time - estimate.time;
  if (estimate.input == 1) return go_inertial(options, estimate, dt, estimate.rate, estimate.force);
  Transition step;
  if (estimate.input == 2) {
    const Quaterniond turn = turn_by(estimate.rate * dt);
    estimate.reported = (quaternion_of(estimate.reported) * turn).normalized().coeffs();
    step = go_reckoned(options, estimate, dt, turn, estimate.force, 0.0);
  }
  estimate.time = time;
  return step;
}

NavigationUpdate apply_reading(const NavigationOptions& options, NavigationEstimate& estimate,
                               const SensorOptions& device, const SensorReading& reading,
                               Correction& correction) {
  NavigationUpdate result;
  if (!reading.valid || !observes_motion(reading.kind)) return result;
  const Observation seen = observe(options, estimate, device, reading);
  if (!seen.slope.allFinite()) return result;  // roll and yaw of a vehicle on end
  result.used = true;
  result.count = reading.count;
  NavigationMatrix& p = estimate.covariance;
  Correction& c = correction;
  c.slope = seen.slope;
  c.innovation = seen.innovation;
  const Gain cross = p * seen.slope.transpose();
  ObservationMatrix covariance = seen.slope * cross;
  covariance.diagonal() += seen.variance;
  const Eigen::LDLT<ObservationMatrix> solver(covariance);
  c.inverse = solver.solve(ObservationMatrix::Identity(reading.count, reading.count));
  result.covariance.topLeftCorner(reading.count, reading.count) = covariance;
  for (int i = 0; i < reading.count; ++i) {
    result.innovation[static_cast<std::size_t>(i)] = seen.innovation[i];
  }
  result.nis = seen.innovation.dot(c.inverse * seen.innovation);
  result.accepted =
      std::isfinite(result.nis) &&
      (options.gate >= 1.0 || chi_square_tail(result.nis, reading.count) >= 1.0 - options.gate);
  if (!result.accepted) return result;
  c.gain = cross * c.inverse;
  // (I − KH) P (I − KH)ᵀ + K R Kᵀ, factor by factor: H is thin.
  p.noalias() -= c.gain * cross.transpose();
  const Gain again = p * seen.slope.transpose() - c.gain * seen.variance.asDiagonal();
  p.noalias() -= again * c.gain.transpose();
  p = (0.5 * (p + p.transpose())).eval();
  add_error(estimate, c.gain * seen.innovation);
  return result;
}

void add_error(NavigationEstimate& estimate, const NavigationVector& error) {
  estimate.position += error.segment<3>(kPosition);
  estimate.velocity += error.segment<3>(kVelocity);
  estimate.attitude = (turn_by(error.segment<3>(kAttitude)) * quaternion_of(estimate.attitude))
                          .normalized()
                          .coeffs();
  estimate.gyro_bias += error.segment<3>(kGyroBias);
  estimate.accel_bias += error.segment<3>(kAccelBias);
  estimate.log_scale += error[kLogScale];
  estimate.log_mount += error.segment<3>(kLogMount);
  estimate.current += error.segment<2>(kCurrent);
  estimate.fix_lever += error.segment<3>(kFixLever);
}

}  // namespace bathyal
