// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/control/allocation.hpp"

#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/control/internal/bounded_least_squares.hpp"

namespace bathyal {
namespace {

using control_internal::Columns;
using control_internal::Rows;
using control_internal::Unknowns;

constexpr std::array<int, 6> kKept{2, 5, 0, 1, 3, 4};  // heave, yaw, surge, sway, roll, pitch
constexpr double kIndependent = 1e-3;                  // of a row's length

}  // namespace

void AllocationOptions::check() const {
  for (const double weight : weights) check_positive("weights", weight);
  check_positive("effort", effort);
}

Allocation::Allocation(std::vector<Thruster> thrusters, AllocationOptions options)
    : thrusters_(std::move(thrusters)), options_(options) {
  options_.check();
  if (thrusters_.empty() || thrusters_.size() > control_internal::kMost) {
    throw_argument("thrusters", "1 to 32 thrusters", std::to_string(thrusters_.size()));
  }
  matrix_.resize(6, static_cast<Eigen::Index>(thrusters_.size()));
  for (std::size_t i = 0; i < thrusters_.size(); ++i) {
    matrix_.col(static_cast<Eigen::Index>(i)) = thrusters_[i].column();
  }
}

std::uint32_t Allocation::working(const std::vector<int>& failed) const {
  std::uint32_t all = 0;
  for (std::size_t i = 0; i < thrusters_.size(); ++i) all |= 1U << i;
  for (const int row : failed) {
    check_range("failed", row, 0, static_cast<double>(thrusters_.size() - 1));
    all &= ~(1U << static_cast<unsigned>(row));
  }
  return all;
}

std::uint32_t Allocation::lost_axes(std::uint32_t working) const {
  using Row = Eigen::Matrix<double, 1, control_internal::kMost>;  // of a fixed length, with zeros
  std::array<Row, 6> kept;
  std::size_t count = 0;
  std::uint32_t lost = 0;
  for (const int axis : kKept) {
    const double whole = matrix_.row(axis).norm();
    Row row = Row::Zero();
    for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
      if ((working >> j & 1U) != 0) row[j] = matrix_(axis, j);
    }
    for (int again = 0; again < 2; ++again) {
      for (std::size_t k = 0; k < count; ++k) row -= kept[k].dot(row) * kept[k];
    }
    if (row.norm() > kIndependent * whole) {
      kept[count++] = row.normalized();
    } else {
      lost |= 1U << axis;
    }
  }
  return lost;
}

AllocationRank Allocation::rank(const std::vector<int>& failed) const {
  const std::uint32_t lost = lost_axes(working(failed));
  AllocationRank result;
  for (int axis = 0; axis < 6; ++axis) {
    if ((lost >> axis & 1U) != 0) result.lost.push_back(axis);
  }
  result.rank = 6 - static_cast<int>(result.lost.size());
  return result;
}

void Allocation::allocate(const Vec6& wrench, double voltage, const std::vector<int>& failed,
                          AllocationResult& result) const {
  if (!wrench.allFinite()) throw_argument("wrench", "finite numbers", "others");
  check_not_negative("voltage", voltage);
  const std::uint32_t works = working(failed), lost = lost_axes(works);
  const Eigen::Index count = matrix_.cols();
  Columns a = Columns::Zero(6 + count, count);
  Rows b = Rows::Zero(6 + count);
  Unknowns low(count), high(count);
  for (int axis = 0; axis < 6; ++axis) {
    const double largest = matrix_.row(axis).cwiseAbs().maxCoeff();
    if ((lost >> axis & 1U) != 0 || !(largest > 0.0)) continue;
    const double weight = options_.weights[static_cast<std::size_t>(axis)] / largest;
    a.row(axis) = weight * matrix_.row(axis);
    b[axis] = weight * wrench[axis];
  }
  for (Eigen::Index j = 0; j < count; ++j) {
    a(6 + j, j) = options_.effort;
    const Thruster& thruster = thrusters_[static_cast<std::size_t>(j)];
    const bool on = (works >> j & 1U) != 0;
    low[j] = on ? std::min(thruster.steady(-1.0, voltage).thrust, 0.0) : 0.0;
    high[j] = on ? std::max(thruster.steady(1.0, voltage).thrust, 0.0) : 0.0;
  }
  const Unknowns found = control_internal::bounded_least_squares(a, b, low, high);
  result.thrust.assign(found.begin(), found.end());
  result.command.resize(thrusters_.size());
  result.saturated = false;
  for (std::size_t i = 0; i < thrusters_.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    result.command[i] = thrusters_[i].command_for(found[j], voltage);
    const bool on = (works >> j & 1U) != 0;
    result.saturated = result.saturated || (on && (found[j] <= low[j] || found[j] >= high[j]));
  }
  result.achieved.noalias() = matrix_ * found;  // else Eigen takes a temporary from the heap
}

}  // namespace bathyal
