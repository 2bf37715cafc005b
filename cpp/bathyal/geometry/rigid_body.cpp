// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/rigid_body.hpp"

#include <string>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

// Both are shares of the trace, which adds up as bodies do: what is allowed by itself is allowed
// in a sum.
constexpr double kAsymmetric = 1e-6;
constexpr double kBeyondTriangle = 1e-3;

void check_center(const std::string& name, const Vec3& center) {
  if (!center.allFinite()) throw_argument(name, "finite numbers", "nan or inf");
}

void check_inertia(const std::string& name, const Eigen::Matrix3d& inertia) {
  if (!inertia.allFinite()) throw_argument(name, "finite numbers", "nan or inf");
  const double largest = inertia.cwiseAbs().maxCoeff();
  if (largest == 0.0) return;
  const Eigen::Matrix3d scaled = inertia / largest;  // neither overflows nor underflows
  const double trace = scaled.trace();
  const double asymmetry = (scaled - scaled.transpose()).cwiseAbs().maxCoeff();
  if (!(asymmetry <= kAsymmetric * trace)) {
    const bool negative = asymmetry <= kAsymmetric;
    throw_argument(name, "a symmetric matrix with moments of 0 or more",
                   negative ? "a trace of " + to_text(trace * largest)
                            : "values that differ by " + to_text(asymmetry * largest));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(0.5 * (scaled + scaled.transpose()),
                                                              Eigen::EigenvaluesOnly);
  const Vec3 moments = solver.eigenvalues();  // increasing
  if (!(moments[2] - moments[1] - moments[0] <= kBeyondTriangle * trace)) {
    throw_argument(name,
                   "principal moments of a body: 0 or more, none above the sum of the two others",
                   to_text(moments[0] * largest) + ", " + to_text(moments[1] * largest) + " and " +
                       to_text(moments[2] * largest));
  }
}

Eigen::Matrix3d steiner(double mass, const Vec3& arm) {
  return mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
}

Vec3 weighted(double weight, const Vec3& point, double other_weight, const Vec3& other) {
  const double sum = weight + other_weight;
  return sum > 0.0 ? Vec3((weight * point + other_weight * other) / sum) : point;
}

}  // namespace

void RigidBody::check(std::string_view owner) const {
  const std::string prefix = owner.empty() ? "" : std::string(owner) + " ";
  check_not_negative(prefix + "mass", mass);
  check_center(prefix + "center_of_mass", center_of_mass);
  check_inertia(prefix + "inertia", inertia);
  check_not_negative(prefix + "volume", volume);
  check_center(prefix + "center_of_buoyancy", center_of_buoyancy);
}

RigidBody in_frame(const RigidBody& body, const Pose& new_from_body) {
  RigidBody moved = body;
  const Eigen::Matrix3d turn = new_from_body.linear();
  moved.center_of_mass = new_from_body * body.center_of_mass;
  moved.inertia = turn * body.inertia * turn.transpose();
  moved.center_of_buoyancy = new_from_body * body.center_of_buoyancy;
  return moved;
}

RigidBody combined(const RigidBody& one, const RigidBody& other) {
  RigidBody whole = one;
  whole.center_of_mass = weighted(one.mass, one.center_of_mass, other.mass, other.center_of_mass);
  whole.inertia += steiner(one.mass, one.center_of_mass - whole.center_of_mass) + other.inertia +
                   steiner(other.mass, other.center_of_mass - whole.center_of_mass);
  whole.mass += other.mass;
  whole.center_of_buoyancy =
      weighted(one.volume, one.center_of_buoyancy, other.volume, other.center_of_buoyancy);
  whole.volume += other.volume;
  return whole;
}

}  // namespace bathyal
