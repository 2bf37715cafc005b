// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/current.hpp"

#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/water/internal/rising.hpp"

namespace bathyal {

Current::Current(double x, double y) : depth_{0.0}, velocity_{{x, y}} {
  check_finite("current", x);
  check_finite("current", y);
}

Current::Current(std::vector<double> depth, std::vector<Eigen::Vector2d> velocity,
                 std::vector<double> time)
    : depth_(std::move(depth)), velocity_(std::move(velocity)), time_(std::move(time)) {
  if (depth_.empty()) throw_argument("depth", "at least one depth", "none");
  check_rising("depth", depth_);
  check_rising("time", time_);
  const std::size_t rows = depth_.size() * (time_.empty() ? 1 : time_.size());
  if (velocity_.size() != rows) {
    throw_argument("velocity", std::to_string(rows) + " rows, one a depth and time",
                   std::to_string(velocity_.size()));
  }
  for (const Eigen::Vector2d& v : velocity_) {
    if (!v.allFinite()) throw_argument("velocity", "finite numbers", "a row that is not");
  }
}

Eigen::Vector2d Current::at_row(std::size_t first, double depth) const {
  const Interval in = interval_of(depth_, depth);
  const Eigen::Vector2d low = velocity_[first + in.low];
  return low + in.share * (velocity_[first + in.high] - low);
}

Eigen::Vector2d Current::at(double depth, double time) const {
  if (still()) return Eigen::Vector2d::Zero();
  if (time_.empty()) return at_row(0, depth);
  const Interval in = interval_of(time_, time);
  const Eigen::Vector2d low = at_row(in.low * depth_.size(), depth);
  return low + in.share * (at_row(in.high * depth_.size(), depth) - low);
}

}  // namespace bathyal
