// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/devices/fin.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

constexpr double kBlend = 50.0;  // steepness of the passage to the flat plate [1/rad]

void check_direction(std::string_view name, const Vec3& direction) {
  if (!direction.allFinite() || !(direction.norm() > 0.0)) {
    throw_argument(name, "a finite vector of a length above 0", "another");
  }
}

}  // namespace

void FinOptions::check() const {
  if (!position.allFinite()) throw_argument("position", "finite numbers", "others");
  if (!published.allFinite()) throw_argument("published", "finite numbers", "others");
  check_direction("forward", forward);
  check_direction("shaft", shaft);
  if (std::abs(forward.normalized().dot(shaft.normalized())) > 1e-6) {
    throw_argument("shaft", "a direction square to `forward`", "another");
  }
  check_not_negative("area", area);
  check_not_negative("lift_slope", lift_slope);
  check_not_negative("drag", drag);
  check_not_negative("induced_drag", induced_drag);
  check_positive("stall", stall);
  check_positive("water_density", water_density);
  check_positive("limit", limit);
  check_not_negative("rate", rate);
  check_not_negative("lag", lag);
}

Fin::Fin(FinOptions options) : options_(std::move(options)) {
  options_.check();
  options_.forward.normalize();
  options_.shaft.normalize();
  side_ = options_.shaft.cross(options_.forward);
}

FinState Fin::advanced(const FinState& state, double command, double time) const {
  const double asked = std::clamp(command, -options_.limit, options_.limit);
  const double share = options_.lag > 0.0 ? -std::expm1(-time / options_.lag) : 1.0;
  double change = share * (asked - state.angle);
  if (options_.rate > 0.0) {
    change = std::clamp(change, -options_.rate * time, options_.rate * time);
  }
  return {state.angle + change};
}

std::pair<double, double> Fin::coefficients(double attack) const {
  const double up = std::exp(-kBlend * (attack - options_.stall));
  const double down = std::exp(kBlend * (attack + options_.stall));
  // the published form, (1 + up + down) / ((1 + up)(1 + down)), written so that nothing overflows
  const double stalled = std::abs(attack) > options_.stall + 10.0 / kBlend
                             ? 1.0
                             : (1.0 + up + down) / ((1.0 + up) * (1.0 + down));
  const double sine = std::sin(attack), cosine = std::cos(attack);
  const double attached = options_.lift_slope * attack;
  const double lift = (1.0 - stalled) * attached + stalled * 2.0 * sine * std::abs(sine) * cosine;
  const double drag = options_.drag +
                      (1.0 - stalled) * options_.induced_drag * attached * attached +
                      stalled * 2.0 * std::abs(sine) * sine * sine;
  return {lift, drag};
}

Vec6 Fin::wrench(double angle, const Vec6& relative) const {
  if (options_.area == 0.0) {
    return relative[0] * std::abs(relative[0]) * angle * options_.published;
  }
  const Vec3 velocity = relative.head<3>() + relative.tail<3>().cross(options_.position);
  const double along = velocity.dot(options_.forward), across = velocity.dot(side_);
  const double square = along * along + across * across;
  if (!(square > 0.0)) return Vec6::Zero();
  const double flow = std::atan2(across, along);
  const auto [lift, drag] = coefficients(std::remainder(angle - flow, 2.0 * M_PI));
  const double speed = std::sqrt(square);
  const Vec3 ahead = (along * options_.forward + across * side_) / speed;
  const Vec3 force = 0.5 * options_.water_density * options_.area * square *
                     (lift * options_.shaft.cross(ahead) - drag * ahead);
  Vec6 result;
  result << force, options_.position.cross(force);
  return result;
}

}  // namespace bathyal
