// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/row_timing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bathyal::workspace {
namespace {

constexpr double kShortest = 1e-4;  // of a leg [s]: times rise
constexpr int kMostSweeps = 100;
constexpr double kMostStretch = 1e9;

/// Legs between rows, each with the time it takes.
class Legs {
 public:
  Legs(const JointMatrix& rows, std::span<const double> acceleration)
      : count_(rows.rows() - 1), acceleration_(acceleration) {
    change_ = rows.bottomRows(count_) - rows.topRows(count_);
    duration_.assign(static_cast<std::size_t>(count_), kShortest);
  }

  Index count() const { return count_; }
  double& duration(Index leg) { return duration_[static_cast<std::size_t>(leg)]; }
  const JointMatrix& change() const { return change_; }

  /// Makes the rates of the two legs at a row near enough to each other (at the first and last row,
  /// that of the leg to rest): slows one, the other or both, whichever takes the least time.
  /// Whether it had to.
  bool join(Index row) {
    const double before = row > 0 ? duration(row - 1) : 0.0;
    const double after = row < count_ ? duration(row) : 0.0;
    if (joins(row, before, after)) return false;
    double least = std::numeric_limits<double>::infinity();
    double best_before = before, best_after = after;
    for (const auto& [of_before, of_after] : {std::pair(1.0, 0.0), {0.0, 1.0}, {1.0, 1.0}}) {
      const double one = of_before, other = of_after;  // clang 14 captures no bindings
      const auto stretched = [&](double by) {
        return std::pair(before * (1.0 + one * by), after * (1.0 + other * by));
      };
      const auto fits = [&](double by) {
        const auto [first, second] = stretched(by);
        return joins(row, first, second);
      };
      double low = 0.0, high = 0.01;
      while (high < kMostStretch && !fits(high)) low = high, high *= 2.0;
      if (high >= kMostStretch) continue;
      while (high - low > 1e-6 * (1.0 + low)) {
        const double middle = 0.5 * (low + high);
        (fits(middle) ? high : low) = middle;
      }
      const auto [first, second] = stretched(high);
      if (first + second < least) {
        least = first + second;
        best_before = first;
        best_after = second;
      }
    }
    if (row > 0) duration(row - 1) = best_before;
    if (row < count_) duration(row) = best_after;
    return true;
  }

  bool joins(Index row) const {
    return joins(row, row > 0 ? duration_[static_cast<std::size_t>(row - 1)] : 0.0,
                 row < count_ ? duration_[static_cast<std::size_t>(row)] : 0.0);
  }

 private:
  bool joins(Index row, double before, double after) const {
    const double between = 0.5 * (before + after);
    for (Index k = 0; k < change_.cols(); ++k) {
      const double rate = row > 0 ? change_(row - 1, k) / before : 0.0;
      const double next = row < count_ ? change_(row, k) / after : 0.0;
      if (std::abs(next - rate) > acceleration_[static_cast<std::size_t>(k)] * between) {
        return false;
      }
    }
    return true;
  }

  Index count_;
  std::span<const double> acceleration_;
  JointMatrix change_;
  std::vector<double> duration_;
};

}  // namespace

std::vector<double> row_times(const JointMatrix& rows, std::span<const double> velocity,
                              std::span<const double> acceleration,
                              std::span<const double> least_duration) {
  std::vector<double> time(static_cast<std::size_t>(rows.rows()), 0.0);
  if (rows.rows() < 2) return time;
  Legs legs(rows, acceleration);
  for (Index i = 0; i < legs.count(); ++i) {
    double& duration = legs.duration(i);
    duration = std::max(duration, least_duration[static_cast<std::size_t>(i)]);
    for (Index k = 0; k < rows.cols(); ++k) {
      duration =
          std::max(duration, std::abs(legs.change()(i, k)) / velocity[static_cast<std::size_t>(k)]);
    }
  }
  // Each sweep only slows: a stop ahead is felt by the legs before it in the sweep that runs back.
  bool changed = true;
  for (int sweep = 0; changed && sweep < kMostSweeps; ++sweep) {
    changed = false;
    for (Index row = 0; row <= legs.count(); ++row) changed |= legs.join(row);
    for (Index row = legs.count(); row >= 0; --row) changed |= legs.join(row);
  }
  const auto all_join = [&] {
    for (Index row = 0; row <= legs.count(); ++row) {
      if (!legs.joins(row)) return false;
    }
    return true;
  };
  while (changed && !all_join()) {  // all slower by one factor comes to an end in any case
    for (Index i = 0; i < legs.count(); ++i) legs.duration(i) *= 1.1;
  }
  for (Index i = 0; i < legs.count(); ++i) {
    time[static_cast<std::size_t>(i) + 1] = time[static_cast<std::size_t>(i)] + legs.duration(i);
  }
  return time;
}

}  // namespace bathyal::workspace
