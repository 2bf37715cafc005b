// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/devices/tether.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

constexpr double kLightest = 1e-6;  // weight over stiffness · strain below which it is a string

/// A cable in its plane: x square to the load, z against it; the far end at (x, z) from the fixed.
struct Planar {
  double x, z, weight, length, stiffness;

  /// Where the far end lies under a force (h, v) on it that holds it (Irvine, eq. 2.24, 2.25).
  Eigen::Vector2d end(double h, double v) const {
    const double low = v - weight * length, top = std::hypot(h, v), bottom = std::hypot(h, low);
    return {h / weight * (std::asinh(v / h) - std::asinh(low / h)) + h * length / stiffness,
            (top - bottom) / weight + (v - 0.5 * weight * length) * length / stiffness};
  }

  Eigen::Matrix2d slope(double h, double v) const {
    const double low = v - weight * length, top = std::hypot(h, v), bottom = std::hypot(h, low);
    Eigen::Matrix2d d;
    d(0, 0) = (std::asinh(v / h) - std::asinh(low / h)) / weight -
              (v / top - low / bottom) / weight + length / stiffness;
    d(0, 1) = d(1, 0) = h / weight * (1.0 / top - 1.0 / bottom);
    d(1, 1) = (v / top - low / bottom) / weight + length / stiffness;
    return d;
  }

  /// Starting values of Jonkman (2007), Dynamics Modeling and Loads Analysis of an Offshore
  /// Floating Wind Turbine, eq. 2-37 to 2-39.
  Eigen::Vector2d guess() const {
    const double chord = std::hypot(x, z);
    const double slack =
        length > chord
            ? std::sqrt(std::max(3.0 * ((length * length - z * z) / (x * x) - 1.0), 1e-6))
            : 0.2;
    return {std::abs(0.5 * weight * x / slack), 0.5 * weight * (z / std::tanh(slack) + length)};
  }

  /// Horizontal and vertical force that hold the far end: Newton's method, each step halved until
  /// it comes nearer.
  Eigen::Vector2d held() const {
    constexpr int kMostSteps = 100;
    Eigen::Vector2d force = guess();
    const Eigen::Vector2d aim(x, z);
    Eigen::Vector2d off = end(force[0], force[1]) - aim;
    for (int k = 0; k < kMostSteps && off.norm() > 1e-10 * length; ++k) {
      const Eigen::Vector2d step = slope(force[0], force[1]).inverse() * off;
      double share = 1.0;
      while (share > 1e-9) {
        const Eigen::Vector2d tried = force - share * step;
        if (tried[0] > 0.0) {
          const Eigen::Vector2d left = end(tried[0], tried[1]) - aim;
          if (left.norm() < off.norm()) {
            force = tried;
            off = left;
            break;
          }
        }
        share *= 0.5;
      }
      if (share <= 1e-9) break;
    }
    return force;
  }
};

/// A weightless string: nothing when slack, a spring when taut.
Vec3 string_force(const Vec3& span, double length, double stiffness) {
  const double chord = span.norm();
  if (chord <= length) return Vec3::Zero();
  return -stiffness * (chord / length - 1.0) / chord * span;
}

}  // namespace

void TetherOptions::check() const {
  if (!anchor.allFinite()) throw_argument("anchor", "finite numbers", "others");
  if (!attachment.allFinite()) throw_argument("attachment", "finite numbers", "others");
  check_positive("length", length);
  check_finite("weight", weight);
  check_not_negative("diameter", diameter);
  check_not_negative("drag", drag);
  check_positive("stiffness", stiffness);
  check_positive("water_density", water_density);
}

Vec3 catenary_force(const Vec3& span, const Vec3& load, double length, double stiffness) {
  const double weight = load.norm();
  if (weight * length < kLightest * std::min(stiffness, 1.0)) {
    return string_force(span, length, stiffness);
  }
  const Vec3 up = -load / weight;
  const double z = span.dot(up);
  const Vec3 level = span - z * up;
  const double x = std::max(level.norm(), 1e-6 * length);  // straight up and down: a hair aside
  const Vec3 aside = level.norm() > 0.0 ? Vec3(level.normalized()) : Vec3(Vec3::Zero());
  const Eigen::Vector2d held = Planar{x, z, weight, length, stiffness}.held();
  return -held[0] * aside - held[1] * up;  // the cable pulls the other way
}

Vec6 tether_wrench(const TetherOptions& tether, const Pose& world_from_vehicle,
                   const Vec3& relative_water) {
  const Vec3 arm = world_from_vehicle.linear() * tether.attachment;
  const Vec3 span = world_from_vehicle.translation() + arm - tether.anchor;
  const double chord = span.norm();
  const Vec3 along = chord > 0.0 ? Vec3(span / chord) : Vec3(Vec3::UnitZ());
  const Vec3 across = relative_water - relative_water.dot(along) * along;
  // what meets the flow is the chord, not what hangs slack
  const double met = std::min(chord / tether.length, 1.0);
  const Vec3 load = Vec3(0.0, 0.0, -tether.weight) + 0.5 * tether.water_density * tether.drag *
                                                         tether.diameter * met * across.norm() *
                                                         across;
  const Vec3 force = catenary_force(span, load, tether.length, tether.stiffness);
  Vec6 wrench;
  wrench << world_from_vehicle.linear().transpose() * force,
      tether.attachment.cross(world_from_vehicle.linear().transpose() * force);
  return wrench;
}

}  // namespace bathyal
