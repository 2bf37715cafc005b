// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"

namespace bathyal {
namespace {

double angle_between(const Pose& one, const Pose& other) {
  return Eigen::Quaterniond(one.linear()).angularDistance(Eigen::Quaterniond(other.linear()));
}

}  // namespace

Trajectory::Trajectory(const Pose& pose) : time_{0.0}, pose_{pose} { check_rigid("pose", pose); }

Trajectory::Trajectory(std::vector<double> time, std::vector<Pose> pose)
    : time_(std::move(time)), pose_(std::move(pose)) {
  if (time_.empty()) throw_argument("time", "one time or more", "none");
  if (pose_.size() != time_.size()) {
    throw_argument("pose", "one for each of " + std::to_string(time_.size()) + " times",
                   std::to_string(pose_.size()));
  }
  for (std::size_t i = 0; i < time_.size(); ++i) {
    const std::string row = " (row " + std::to_string(i) + ")";
    if (!std::isfinite(time_[i])) throw_argument("time", "finite times", to_text(time_[i]) + row);
    if (i > 0 && !(time_[i] > time_[i - 1])) {
      throw_argument("time", "rising times", to_text(time_[i]) + row);
    }
    check_rigid("pose" + row, pose_[i]);
  }
  for (std::size_t i = 0; i + 1 < time_.size(); ++i) {
    const double duration = time_[i + 1] - time_[i];
    rates_.push_back({(pose_[i + 1].translation() - pose_[i].translation()).norm() / duration,
                      angle_between(pose_[i], pose_[i + 1]) / duration});
  }
}

Pose Trajectory::at(double time) const {
  if (!(time > time_.front())) return pose_.front();
  if (!(time < time_.back())) return pose_.back();
  const auto after = std::ranges::upper_bound(time_, time);
  const auto i = static_cast<std::size_t>(after - time_.begin()) - 1;
  const double fraction = (time - time_[i]) / (time_[i + 1] - time_[i]);
  Pose pose = Pose::Identity();
  pose.translation() =
      (1.0 - fraction) * pose_[i].translation() + fraction * pose_[i + 1].translation();
  pose.linear() = Eigen::Quaterniond(pose_[i].linear())
                      .slerp(fraction, Eigen::Quaterniond(pose_[i + 1].linear()))
                      .toRotationMatrix();
  return pose;
}

Trajectory::Rates Trajectory::max_rates(double from, double to) const {
  Rates greatest;
  for (std::size_t i = 0; i < rates_.size(); ++i) {
    if (time_[i + 1] <= from || time_[i] >= to) continue;
    greatest.linear = std::max(greatest.linear, rates_[i].linear);
    greatest.angular = std::max(greatest.angular, rates_[i].angular);
  }
  return greatest;
}

}  // namespace bathyal
