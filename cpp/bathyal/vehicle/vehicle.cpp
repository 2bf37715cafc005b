// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/vehicle.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr double kSymmetric = 1e-9;  // of the largest entry
constexpr double kBalanced = 1e-6;   // of the size

Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

void check_matrix(std::string_view name, const Mat6& matrix) {
  if (!matrix.allFinite()) throw_argument(name, "finite numbers", "others");
}

void check_added_mass(const Mat6& added) {
  check_matrix("added_mass", added);
  const double scale = added.cwiseAbs().maxCoeff();
  if ((added - added.transpose()).cwiseAbs().maxCoeff() > kSymmetric * scale) {
    throw_argument("added_mass", "a symmetric (6, 6) matrix", "one that is not");
  }
  const double least = Eigen::SelfAdjointEigenSolver<Mat6>(added).eigenvalues()[0];
  if (least < -1e-9 * scale) {
    throw_argument("added_mass", "a matrix without negative eigenvalues", to_text(least));
  }
}

void check_parts(const std::vector<VehiclePart>& parts) {
  double whole = 0.0, size = 0.0;
  Vec3 moment = Vec3::Zero();
  for (const VehiclePart& part : parts) {
    if (!part.center.allFinite()) throw_argument("parts", "finite centres", "others");
    check_positive("parts radius", part.radius);
    check_positive("parts volume", part.volume);
    whole += part.volume;
    moment += part.volume * part.center;
    size = std::max(size, part.center.norm() + part.radius);
  }
  if (moment.norm() > kBalanced * whole * size) {
    throw_argument("parts", "volumes that balance about the origin, the centre of buoyancy",
                   "a centre " + to_text(moment.norm() / whole) + " m off");
  }
}

/// What is held drops out of the equations.
Vec6 solved(const Mat6& mass, const Vec6& force, const FreeAxes& free) {
  std::array<int, 6> rows{};
  int count = 0;
  for (int i = 0; i < 6; ++i) {
    if (free[static_cast<std::size_t>(i)]) rows[static_cast<std::size_t>(count++)] = i;
  }
  Eigen::MatrixXd part(count, count);
  Eigen::VectorXd right(count);
  for (int i = 0; i < count; ++i) {
    const int row = rows[static_cast<std::size_t>(i)];
    right[i] = force[row];
    for (int j = 0; j < count; ++j) part(i, j) = mass(row, rows[static_cast<std::size_t>(j)]);
  }
  Vec6 result = Vec6::Zero();
  if (count == 0) return result;
  const Eigen::VectorXd found = part.llt().solve(right);
  for (int i = 0; i < count; ++i) result[rows[static_cast<std::size_t>(i)]] = found[i];
  return result;
}

/// R_D of Carlson (1979), by duplication.
double carlson_rd(double x, double y, double z) {
  double sum = 0.0, factor = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double root =
        std::sqrt(x) * std::sqrt(y) + std::sqrt(y) * std::sqrt(z) + std::sqrt(z) * std::sqrt(x);
    sum += factor / (std::sqrt(z) * (z + root));
    factor *= 0.25;
    x = 0.25 * (x + root);
    y = 0.25 * (y + root);
    z = 0.25 * (z + root);
  }
  return 3.0 * sum + factor / (z * std::sqrt(z));  // all three are equal by now
}

/// Added moment of inertia about the axis that is square to half axes b and c, over the mass of the
/// water displaced (Lamb, art. 115).
double turning(double b, double c, double beta, double gamma) {
  const double difference = b * b - c * c, sum = b * b + c * c;
  if (std::abs(difference) < 1e-9 * sum) return 0.0;
  return 0.2 * difference * difference * (gamma - beta) / (2.0 * difference + sum * (beta - gamma));
}

}  // namespace

void VehicleOptions::check() const {
  body.check();
  check_positive("mass", body.mass);
  check_not_negative("volume", body.volume);
  if (body.center_of_buoyancy != Vec3::Zero()) {
    throw_argument("center_of_buoyancy", "the origin of the vehicle's frame", "another point");
  }
  check_added_mass(added_mass);
  check_matrix("linear_drag", linear_drag);
  check_not_negative("gravity", gravity);
  check_positive("water_density", water_density);
  for (const ForceTerm& term : terms) {
    for (const int axis : {term.row, term.a, term.b}) check_range("terms", axis, 0, 5);
    check_finite("terms", term.coefficient);
  }
  check_parts(parts);
  const Mat6 total = bathyal::mass_matrix(body) + added_mass;
  if (Eigen::LLT<Mat6>(total).info() != Eigen::Success) {
    throw_argument("inertia", "one that makes the mass matrix positive definite",
                   "one that does not");
  }
}

Mat6 mass_matrix(const RigidBody& body) {
  const Eigen::Matrix3d arm = cross_matrix(body.center_of_mass);
  Mat6 mass = Mat6::Zero();
  mass.topLeftCorner<3, 3>() = body.mass * Eigen::Matrix3d::Identity();
  mass.topRightCorner<3, 3>() = -body.mass * arm;
  mass.bottomLeftCorner<3, 3>() = body.mass * arm;
  mass.bottomRightCorner<3, 3>() = body.inertia - body.mass * arm * arm;
  return mass;
}

Vec6 coriolis(const Mat6& mass, const Vec6& velocity) {
  const Vec6 momentum = mass * velocity;
  const Vec3 linear = momentum.head<3>(), angular = momentum.tail<3>();
  const Vec3 v = velocity.head<3>(), w = velocity.tail<3>();
  Vec6 force;
  force << w.cross(linear), w.cross(angular) + v.cross(linear);
  return force;
}

Vehicle::Vehicle(VehicleOptions options) {
  options.check();
  rigid_ = bathyal::mass_matrix(options.body);
  mass_ = rigid_ + options.added_mass;
  inverse_ = mass_.llt().solve(Mat6::Identity());
  options_ = std::make_shared<const VehicleOptions>(std::move(options));
}

Vec6 Vehicle::hydrostatic(const Pose& world_from_vehicle) const {
  const RigidBody& body = options_->body;
  const Vec3 down = -world_from_vehicle.linear().row(2).transpose();
  const Vec3 weight = body.mass * options_->gravity * down;
  const Vec3 buoyancy = -options_->water_density * body.volume * options_->gravity * down;
  Vec6 wrench;
  wrench << weight + buoyancy, body.center_of_mass.cross(weight);
  return wrench;
}

Vec6 Vehicle::drag(const Vec6& relative) const {
  Vec6 force = -options_->linear_drag * relative;
  for (const ForceTerm& term : options_->terms) {
    const double b = relative[term.b];
    force[term.row] += term.coefficient * relative[term.a] * (term.absolute ? std::abs(b) : b);
  }
  return force;
}

Vec6 Vehicle::force(const VehicleState& state, const Vec6& wrench, const Flow& flow) const {
  const Eigen::Matrix3d vehicle_from_world = state.world_from_vehicle.linear().transpose();
  const Vec3 turning_rate = state.velocity.tail<3>();
  Vec6 water = Vec6::Zero(), water_change = Vec6::Zero();
  water.head<3>() = vehicle_from_world * flow.velocity;
  const Vec3 pushed = vehicle_from_world * flow.acceleration;
  water_change.head<3>() = pushed - turning_rate.cross(water.head<3>());
  const Vec6 relative = state.velocity - water;
  Vec6 force = wrench + hydrostatic(state.world_from_vehicle) + drag(relative) -
               coriolis(rigid_, state.velocity) - coriolis(options_->added_mass, relative) +
               options_->added_mass * water_change;
  force.head<3>() += options_->water_density * options_->body.volume * pushed;
  return force;
}

Vec6 Vehicle::acceleration(const VehicleState& state, const Vec6& wrench, const Flow& flow,
                           const FreeAxes& free) const {
  const Vec6 total = force(state, wrench, flow);
  if (free == kAllFree) return inverse_ * total;
  return solved(mass_, total, free);
}

Mat6 ellipsoid_added_mass(const Vec3& half_axes, double water_density) {
  for (const double axis : {half_axes.x(), half_axes.y(), half_axes.z()}) {
    check_positive("half_axes", axis);
  }
  check_positive("water_density", water_density);
  const double a = half_axes.x(), b = half_axes.y(), c = half_axes.z();
  const double product = a * b * c;
  const double alpha = 2.0 / 3.0 * product * carlson_rd(b * b, c * c, a * a);
  const double beta = 2.0 / 3.0 * product * carlson_rd(c * c, a * a, b * b);
  const double gamma = 2.0 / 3.0 * product * carlson_rd(a * a, b * b, c * c);
  const double displaced = water_density * 4.0 / 3.0 * M_PI * product;
  Vec6 diagonal;
  diagonal << alpha / (2.0 - alpha), beta / (2.0 - beta), gamma / (2.0 - gamma),
      turning(b, c, beta, gamma), turning(c, a, gamma, alpha), turning(a, b, alpha, beta);
  return (displaced * diagonal).asDiagonal();
}

}  // namespace bathyal
