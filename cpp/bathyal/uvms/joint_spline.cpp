// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/uvms/joint_spline.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

void check_rows(const std::vector<double>& time, JointView rows) {
  if (rows.rows() == 0) throw_argument("q", "a row or more", "none");
  if (time.size() != static_cast<std::size_t>(rows.rows())) {
    throw_argument("time", std::to_string(rows.rows()) + ", one a row of q",
                   std::to_string(time.size()));
  }
  for (std::size_t k = 0; k < time.size(); ++k) {
    check_finite("time", time[k]);
    if (k > 0 && !(time[k] > time[k - 1])) {
      throw_argument("time", "rising times", to_text(time[k]) + " after " + to_text(time[k - 1]));
    }
  }
  if (!rows.allFinite()) throw_argument("q", "finite numbers", "nan or inf");
}

}  // namespace

JointSpline::JointSpline(std::vector<double> q)
    : size_(q.size()), time_{0.0}, rows_(std::move(q)), slope_(size_, 0.0) {
  for (const double value : rows_) check_finite("q", value);
}

JointSpline::JointSpline(std::vector<double> time, JointView rows)
    : size_(static_cast<std::size_t>(rows.cols())), time_(std::move(time)) {
  check_rows(time_, rows);
  rows_.assign(rows.data(), rows.data() + rows.size());
  slope_.assign(rows_.size(), 0.0);
  const std::size_t count = time_.size();
  if (count < 3) return;
  // Rates that leave the second derivative continuous, those of the ends 0: a tridiagonal system,
  // solved by elimination (Thomas).
  std::vector<double> above(count, 0.0);
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double before = time_[k] - time_[k - 1], after = time_[k + 1] - time_[k];
    const double pivot = 2.0 * (before + after) - after * above[k - 1];
    above[k] = before / pivot;
    for (std::size_t j = 0; j < size_; ++j) {
      const double* at = rows_.data() + k * size_ + j;
      const double rise = (at[0] - *(at - size_)) / before, next = (at[size_] - at[0]) / after;
      double& slope = slope_[k * size_ + j];
      slope = (3.0 * (after * rise + before * next) - after * slope_[(k - 1) * size_ + j]) / pivot;
    }
  }
  for (std::size_t k = count - 1; k-- > 1;) {
    for (std::size_t j = 0; j < size_; ++j) {
      slope_[k * size_ + j] -= above[k] * slope_[(k + 1) * size_ + j];
    }
  }
}

void JointSpline::at(double time, std::vector<double>& q, std::vector<double>& rate,
                     std::vector<double>& acceleration) const {
  q.resize(size_);
  rate.assign(size_, 0.0);
  acceleration.assign(size_, 0.0);
  const auto after = std::upper_bound(time_.begin(), time_.end(), time) - time_.begin();
  if (after == 0 || after == std::ssize(time_)) {
    const std::size_t row = after == 0 ? 0 : time_.size() - 1;
    std::copy_n(rows_.begin() + static_cast<std::ptrdiff_t>(row * size_), size_, q.begin());
    return;
  }
  const auto k = static_cast<std::size_t>(after);
  const double whole = time_[k] - time_[k - 1], s = (time - time_[k - 1]) / whole;
  for (std::size_t j = 0; j < size_; ++j) {
    const double from = rows_[(k - 1) * size_ + j], rise = rows_[k * size_ + j] - from;
    const double m0 = whole * slope_[(k - 1) * size_ + j], m1 = whole * slope_[k * size_ + j];
    const double c2 = 3.0 * rise - 2.0 * m0 - m1, c3 = m0 + m1 - 2.0 * rise;
    q[j] = from + s * (m0 + s * (c2 + s * c3));
    rate[j] = (m0 + s * (2.0 * c2 + s * 3.0 * c3)) / whole;
    acceleration[j] = (2.0 * c2 + 6.0 * s * c3) / (whole * whole);
  }
}

}  // namespace bathyal
