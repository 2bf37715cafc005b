// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/speed_profile.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/water/internal/rising.hpp"

namespace bathyal {

SpeedProfile::SpeedProfile(double speed)
    : SpeedProfile(std::vector<double>{0.0}, std::vector<double>{speed}) {}

SpeedProfile::SpeedProfile(std::vector<double> depth, std::vector<double> speed)
    : depth_(std::move(depth)), speed_(std::move(speed)), gradient_(depth_.size() + 1, 0.0) {
  if (depth_.empty()) throw_argument("depth", "at least one depth", "none");
  check_rising("depth", depth_);
  if (speed_.size() != depth_.size()) {
    throw_argument("sound_speed", std::to_string(depth_.size()) + " speeds, one a depth",
                   std::to_string(speed_.size()));
  }
  for (const double c : speed_) check_positive("sound_speed", c);
  for (std::size_t i = 1; i < depth_.size(); ++i) {
    gradient_[i] = (speed_[i] - speed_[i - 1]) / (depth_[i] - depth_[i - 1]);
  }
}

double SpeedProfile::speed(double depth) const {
  const Interval in = interval_of(depth_, depth);
  return speed_[in.low] + in.share * (speed_[in.high] - speed_[in.low]);
}

double SpeedProfile::top(std::size_t layer) const {
  return layer == 0 ? -std::numeric_limits<double>::infinity() : depth_[layer - 1];
}

double SpeedProfile::bottom(std::size_t layer) const {
  return layer == depth_.size() ? std::numeric_limits<double>::infinity() : depth_[layer];
}

std::size_t SpeedProfile::layer(double depth) const {
  return static_cast<std::size_t>(std::upper_bound(depth_.begin(), depth_.end(), depth) -
                                  depth_.begin());
}

}  // namespace bathyal
