// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/control/guidance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bathyal/base/check.hpp"

namespace bathyal {

void LineOfSightOptions::check() const {
  if (points.size() < 2) throw_argument("points", "2 or more", std::to_string(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw_argument("points", "finite numbers", "others");
    if (i > 0 && points[i] == points[i - 1]) {
      throw_argument("points", "points that differ from the one before",
                     "point " + std::to_string(i) + " equal to it");
    }
  }
  check_positive("lookahead", lookahead);
  check_not_negative("integral", integral);
  check_positive("acceptance", acceptance);
}

LineOfSightOutput line_of_sight(const LineOfSightOptions& options, LineOfSightState& state,
                                const Vec3& position, double time) {
  options.check();
  check_not_negative("time", time);
  const auto legs = static_cast<int>(options.points.size()) - 1;
  check_range("state.leg", state.leg, 0, legs - 1);
  const Eigen::Vector2d here = position.head<2>();
  const auto begin = [&] { return options.points[static_cast<std::size_t>(state.leg)]; };
  const auto end = [&] { return options.points[static_cast<std::size_t>(state.leg) + 1]; };
  const auto reached = [&] {
    const Eigen::Vector2d along = (end() - begin()).normalized();
    return (end() - here).norm() < options.acceptance || (here - end()).dot(along) > 0.0;
  };
  while (state.arrived == 0 && reached()) {
    if (state.leg + 1 == legs) {
      state.arrived = 1;
    } else {
      ++state.leg;
      state.integral = 0.0;
    }
  }
  const Eigen::Vector2d along = (end() - begin()).normalized(), off = here - begin();
  LineOfSightOutput output;
  output.cross_track = along.x() * off.y() - along.y() * off.x();
  const double seen = output.cross_track + options.integral * state.integral;
  const double ahead = options.lookahead;
  output.heading = std::atan2(along.y(), along.x()) - std::atan2(seen, ahead);
  state.integral += time * ahead * output.cross_track / (seen * seen + ahead * ahead);
  return output;
}

void BottomFollowOptions::check() const {
  check_positive("altitude", altitude);
  check_positive("lookahead", lookahead);
  check_not_negative("lead", lead);
  check_positive("steepest", steepest);
  check_positive("spacing", spacing);
}

BottomFollowOutput follow_bottom(const BottomFollowOptions& options, const Vec3& position,
                                 double heading, const BottomFunction& bottom) {
  options.check();
  if (!bottom) throw_argument("bottom", "a function", "none");
  const double c = std::cos(heading), s = std::sin(heading);
  const auto path = [&](double from) {
    double lowest = -std::numeric_limits<double>::infinity();
    const int count = static_cast<int>(std::floor(options.lookahead / options.spacing));
    for (int k = -count; k <= count; ++k) {
      const double way = from + k * options.spacing;
      const double height = bottom(position.x() + way * c, position.y() + way * s);
      const double slope = options.steepest * options.spacing * std::abs(k);
      lowest = std::max(lowest, height + options.altitude - slope);
    }
    return lowest;
  };
  constexpr double kHalf = 0.25;  // of the slope's span [m]
  const double before = path(options.lead - kHalf), after = path(options.lead + kHalf);
  BottomFollowOutput output;
  output.climb = std::clamp((after - before) / (2.0 * kHalf), -options.steepest, options.steepest);
  output.z = path(options.lead);
  if (!std::isfinite(output.z)) throw_argument("bottom", "finite heights", "others");
  return output;
}

}  // namespace bathyal
