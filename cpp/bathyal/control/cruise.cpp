// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/control/cruise.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

constexpr double kOff = 1e-5;

/// Gains K that give A − b Kᵀ the eigenvalues `poles` (complex ones in pairs).
template <int N>
Eigen::Matrix<double, N, 1> ackermann(const Eigen::Matrix<double, N, N>& a,
                                      const Eigen::Matrix<double, N, 1>& b,
                                      const std::array<std::complex<double>, N>& poles,
                                      std::string_view fin) {
  Eigen::Matrix<double, N, N> reach;
  reach.col(0) = b;
  for (int k = 1; k < N; ++k) reach.col(k) = a * reach.col(k - 1);
  const Eigen::FullPivLU<Eigen::Matrix<double, N, N>> lu(reach.transpose());
  if (!lu.isInvertible()) {
    throw_argument(fin, "a fin that turns the vehicle", "one that does not");
  }
  Eigen::Matrix<std::complex<double>, N, N> product =
      Eigen::Matrix<std::complex<double>, N, N>::Identity();
  for (const std::complex<double>& pole : poles) {
    product = (a.template cast<std::complex<double>>() -
               pole * Eigen::Matrix<std::complex<double>, N, N>::Identity()) *
              product;
  }
  Eigen::Matrix<double, N, 1> last = Eigen::Matrix<double, N, 1>::Unit(N - 1);
  return (lu.solve(last).transpose() * product.real()).transpose();
}

/// Accelerations in two directions with all fins and their slopes by velocity, pitch and a fin.
struct Linear {
  Eigen::Matrix2d by_velocity;
  Eigen::Vector2d by_pitch, by_fin;
};

Linear linear_about(const VehicleSystem& system, double speed, int first, int second, int fin) {
  const auto change = [&](const Eigen::Vector2d& off, double pitch, double angle) {
    VehicleState state;
    state.velocity[0] = speed;
    state.velocity[first] += off[0];
    state.velocity[second] += off[1];
    state.world_from_vehicle.linear() = Eigen::AngleAxisd(pitch, Vec3::UnitY()).toRotationMatrix();
    Vec6 wrench = Vec6::Zero();
    for (std::size_t i = 0; i < system.fins().size(); ++i) {
      const bool moved = static_cast<int>(i) == fin;
      wrench += system.fins()[i].wrench(moved ? angle : 0.0, state.velocity);
    }
    const Vec6 found = system.vehicle().acceleration(state, wrench);
    return Eigen::Vector2d(found[first], found[second]);
  };
  const auto slope = [&](const Eigen::Vector2d& off, double pitch, double angle) {
    return Eigen::Vector2d((change(off, pitch, angle) - change(-off, -pitch, -angle)) /
                           (2.0 * kOff));
  };
  Linear linear;
  linear.by_velocity.col(0) = slope({kOff, 0.0}, 0.0, 0.0);
  linear.by_velocity.col(1) = slope({0.0, kOff}, 0.0, 0.0);
  linear.by_pitch = slope({0.0, 0.0}, kOff, 0.0);
  linear.by_fin = slope({0.0, 0.0}, 0.0, kOff);
  return linear;
}

std::complex<double> pole_of(double frequency, double damping) {
  const std::complex<double> root = std::sqrt(std::complex<double>(damping * damping - 1.0));
  return frequency * (-damping + root);
}
std::complex<double> other_pole_of(double frequency, double damping) {
  const std::complex<double> root = std::sqrt(std::complex<double>(damping * damping - 1.0));
  return frequency * (-damping - root);
}

/// The fastest of a matrix' own modes as a real pole, at least three times `frequency`.
template <class Matrix>
double fast_pole(const Matrix& a, double frequency) {
  const double fastest = a.eigenvalues().cwiseAbs().maxCoeff();
  return -std::max(fastest, 3.0 * frequency);
}

double wrapped(double angle) { return std::remainder(angle, 2.0 * M_PI); }

}  // namespace

void CruiseOptions::check() const {
  check_positive("speed", speed);
  check_positive("heading_frequency", heading_frequency);
  check_positive("depth_frequency", depth_frequency);
  check_positive("speed_frequency", speed_frequency);
  check_positive("damping", damping);
  check_positive("integral", integral);
  check_positive("most_pitch", most_pitch);
}

CruiseControl::CruiseControl(const VehicleSystem& system, CruiseOptions options)
    : options_(options), vehicle_(system.vehicle()) {
  options_.check();
  const auto fins = static_cast<double>(system.fins().size());
  check_range("rudder", options_.rudder, 0, fins - 1);
  check_range("stern_plane", options_.stern_plane, 0, fins - 1);
  check_range("propeller", options_.propeller, 0,
              static_cast<double>(system.thrusters().size()) - 1);
  rudder_limit_ = system.fins()[static_cast<std::size_t>(options_.rudder)].options().limit;
  plane_limit_ = system.fins()[static_cast<std::size_t>(options_.stern_plane)].options().limit;
  const Thruster& propeller = system.thrusters()[static_cast<std::size_t>(options_.propeller)];
  const double voltage = system.options().supply_voltage;
  least_thrust_ = propeller.steady(-1.0, voltage).thrust;
  most_thrust_ = propeller.steady(1.0, voltage).thrust;

  const double zeta = options_.damping, wh = options_.heading_frequency;
  const Linear yaw = linear_about(system, options_.speed, 1, 5, options_.rudder);
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  a.topLeftCorner<2, 2>() = yaw.by_velocity;
  a(2, 1) = 1.0;
  a(3, 2) = 1.0;
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  b.head<2>() = yaw.by_fin;
  yaw_ = ackermann<4>(a, b,
                      {pole_of(wh, zeta), other_pole_of(wh, zeta), -options_.integral * wh,
                       fast_pole(yaw.by_velocity, wh)},
                      "rudder");

  const double wz = options_.depth_frequency;
  const Linear dive = linear_about(system, options_.speed, 2, 4, options_.stern_plane);
  Eigen::Matrix<double, 5, 5> c = Eigen::Matrix<double, 5, 5>::Zero();
  c.topLeftCorner<2, 2>() = dive.by_velocity;
  c.block<2, 1>(0, 2) = dive.by_pitch;
  c(2, 1) = 1.0;
  c(3, 0) = 1.0;  // ż = w − u θ: the bow goes down as the pitch is positive
  c(3, 2) = -options_.speed;
  c(4, 3) = 1.0;
  Eigen::Matrix<double, 5, 1> d = Eigen::Matrix<double, 5, 1>::Zero();
  d.head<2>() = dive.by_fin;
  const Eigen::Matrix3d own = c.topLeftCorner<3, 3>();
  dive_ = ackermann<5>(c, d,
                       {pole_of(wz, zeta), other_pole_of(wz, zeta), -options_.integral * wz,
                        -4.0 * wz, fast_pole(own, wz)},
                       "stern_plane");
}

CruiseOutput CruiseControl::step(CruiseState& state, const VehicleState& measured,
                                 const Vec6& relative, const CruiseTarget& target,
                                 double time) const {
  check_positive("time", time);
  const Eigen::Matrix3d& turn = measured.world_from_vehicle.linear();
  const double heading = std::atan2(turn(1, 0), turn(0, 0));
  const double pitch = std::asin(std::clamp(-turn(2, 0), -1.0, 1.0));
  // a fin's force goes with the speed's square
  const double pace = std::max(std::abs(relative[0]), 0.3 * options_.speed) / options_.speed;
  CruiseOutput output;

  const double off = wrapped(heading - target.heading);
  const double rudder =
      -(yaw_[0] * relative[1] + yaw_[1] * relative[5] + yaw_[2] * off + yaw_[3] * state.heading) /
      (pace * pace);
  output.rudder = std::clamp(rudder, -rudder_limit_, rudder_limit_);
  if (rudder == output.rudder) state.heading += time * off;

  const double asked_pitch = -std::atan(target.climb);
  const double widest = std::abs(dive_[2] / dive_[3]) * options_.most_pitch;
  const double above = measured.world_from_vehicle.translation().z() - target.z;
  const double depth = std::clamp(above, -widest, widest);
  const double plane =
      -(dive_[0] * relative[2] + dive_[1] * relative[4] + dive_[2] * (pitch - asked_pitch) +
        dive_[3] * depth + dive_[4] * state.depth) /
      (pace * pace);
  output.stern_plane = std::clamp(plane, -plane_limit_, plane_limit_);
  if (plane == output.stern_plane && depth == above) state.depth += time * depth;

  const double slow = target.speed - relative[0], ws = options_.speed_frequency;
  Vec6 steady = Vec6::Zero();
  steady[0] = target.speed;
  const double mass = vehicle_.mass_matrix()(0, 0);
  const double thrust = -vehicle_.drag(steady)[0] +
                        mass * (2.0 * options_.damping * ws * slow + ws * ws * state.speed);
  output.thrust = std::clamp(thrust, least_thrust_, most_thrust_);
  if (thrust == output.thrust) state.speed += time * slow;
  return output;
}

}  // namespace bathyal
