// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/rounded_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bathyal::workspace {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Rows up to which stopping at a corner is compared with rounding it.
constexpr std::size_t kMostCompared = 40;

/// Of the shorter leg at a corner; what is not turning is there to change speed.
constexpr double kShareOfLeg = 0.4;

// The weight of the second leg's direction, S(x) = 3x² − 2x³, over a corner's way 2d, x = 0 … 1.
constexpr double kCornerDeviation = 0.1875;  // at its middle, of d |w − u|: 2 ∫ S over half the way
constexpr double kMaxSlope = 1.5;            // |S'|
constexpr double kMaxCurvature = 6.0;        // |S''|

/// ∫ S from 0 to x: the way of the second leg.
double turn_integral(double x) { return x * x * x * (1.0 - 0.5 * x); }

/// Douglas and Peucker's choice of rows between `first` and `last`: a row stays where the straight
/// line leaves it by more than its share of tolerance, in any coordinate.
void keep_between(JointView rows, const std::vector<double>& tolerance, std::size_t first,
                  std::size_t last, std::vector<bool>& keep) {
  if (last <= first + 1) return;
  const auto row = [&](std::size_t i) { return rows.row(static_cast<Index>(i)); };
  const Eigen::RowVectorXd span = row(last) - row(first);
  const double square = span.squaredNorm();
  std::size_t farthest = first;
  double most = 1.0;  // in tolerances
  for (std::size_t i = first + 1; i < last; ++i) {
    const Eigen::RowVectorXd off = row(i) - row(first);
    const double along = square > 0.0 ? std::clamp(off.dot(span) / square, 0.0, 1.0) : 0.0;
    const double away = (off - along * span).cwiseAbs().maxCoeff();
    // Rows on the line to rounding never are corners.
    const double scale = 1e-12 * (1.0 + row(i).cwiseAbs().maxCoeff());
    const double excess = away / std::max(scale, 0.5 * tolerance[i]);
    if (excess > most) {
      most = excess;
      farthest = i;
    }
  }
  if (farthest == first) return;
  keep[farthest] = true;
  keep_between(rows, tolerance, first, farthest, keep);
  keep_between(rows, tolerance, farthest, last, keep);
}

std::vector<std::size_t> kept_rows(JointView rows, const std::vector<double>& tolerance) {
  const auto count = static_cast<std::size_t>(rows.rows());
  std::vector<bool> keep(count, false);
  keep.front() = keep.back() = true;
  // The path may turn back on itself: no dropped row may lie beyond the ends of its line.
  std::size_t last = 0;
  const auto turns_back = [&](std::size_t i) {
    const auto at = [&](std::size_t k) { return rows.row(static_cast<Index>(k)); };
    return (at(i) - at(i - 1)).dot(at(i + 1) - at(i)) < 0.0;
  };
  for (std::size_t i = 1; i < count; ++i) {
    if (i + 1 < count && !turns_back(i)) continue;
    keep[i] = true;
    keep_between(rows, tolerance, last, i, keep);
    last = i;
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < count; ++i) {
    if (!keep[i]) continue;
    const bool same = !kept.empty() &&
                      rows.row(static_cast<Index>(i)) == rows.row(static_cast<Index>(kept.back()));
    if (!same) kept.push_back(i);
  }
  return kept;
}

/// The least limit / |rate| over the coordinates.
double least_ratio(const std::vector<double>& limit, const Eigen::RowVectorXd& rate) {
  double least = kInfinity;
  for (Index k = 0; k < rate.size(); ++k) {
    if (rate[k] != 0.0)
      least = std::min(least, limit[static_cast<std::size_t>(k)] / std::abs(rate[k]));
  }
  return least;
}

Piece leg_piece(double length, const Eigen::RowVectorXd& direction, const MotionLimits& limits) {
  return {length, least_ratio(limits.velocity, direction),
          least_ratio(limits.acceleration, direction), least_ratio(limits.jerk, direction)};
}

/// With S over the way 2d: q' = u + S (w − u), q'' = S' (w − u) / 2d, q''' = S'' (w − u) / 4d².
Piece corner_piece(double half, const Eigen::RowVectorXd& u, const Eigen::RowVectorXd& w,
                   const MotionLimits& limits) {
  const Eigen::RowVectorXd turn = w - u;
  const double way = 2.0 * half;
  const double speed = std::min(least_ratio(limits.velocity, u), least_ratio(limits.velocity, w));
  const double bend = std::sqrt(least_ratio(limits.acceleration, turn) * way / kMaxSlope);
  const double jerk = std::cbrt(least_ratio(limits.jerk, turn) * way * way / kMaxCurvature);
  return {way, std::min({speed, bend, jerk}), 0.0, 0.0};
}

}  // namespace

RoundedPath::RoundedPath(JointView rows, const MotionLimits& limits,
                         const std::vector<double>& tolerance)
    : kept_(kept_rows(rows, tolerance)) {
  const auto count = kept_.size();
  points_.resize(static_cast<Index>(count), rows.cols());
  for (std::size_t i = 0; i < count; ++i) {
    points_.row(static_cast<Index>(i)) = rows.row(static_cast<Index>(kept_[i]));
  }
  directions_ = points_.bottomRows(points_.rows() - 1) - points_.topRows(points_.rows() - 1);
  const Eigen::Map<const Eigen::RowVectorXd> speed(limits.velocity.data(), rows.cols());
  for (Index i = 0; i < directions_.rows(); ++i) {
    lengths_.push_back(directions_.row(i).cwiseQuotient(speed).norm());
    directions_.row(i) /= lengths_.back();
  }
  half_.assign(count, 0.0);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const auto row = static_cast<Index>(i);
    const double turn = (directions_.row(row) - directions_.row(row - 1)).cwiseAbs().maxCoeff();
    const double within = 0.5 * tolerance[kept_[i]] / (kCornerDeviation * turn);
    half_[i] = std::min(within, kShareOfLeg * std::min(lengths_[i - 1], lengths_[i]));
  }
  pieces_ = pieces_with(half_, limits);
  if (count > 2 && count <= kMostCompared) stop_where_faster(limits);
}

std::vector<Piece> RoundedPath::pieces_with(const std::vector<double>& half,
                                            const MotionLimits& limits) const {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < half.size(); ++i) {
    const auto row = static_cast<Index>(i);
    if (i > 0) {
      // A stop is a corner without length.
      pieces.push_back(half[i] > 0.0 ? corner_piece(half[i], directions_.row(row - 1),
                                                    directions_.row(row), limits)
                                     : Piece{});
    }
    pieces.push_back(leg_piece(lengths_[i] - half[i] - half[i + 1], directions_.row(row), limits));
  }
  return pieces;
}

void RoundedPath::stop_where_faster(const MotionLimits& limits) {
  const double rounded = duration(speed_profile(pieces_));
  std::vector<double> half = half_;
  for (std::size_t i = 1; i + 1 < half.size(); ++i) {
    std::vector<double> stopping = half_;
    stopping[i] = 0.0;
    if (duration(speed_profile(pieces_with(stopping, limits))) < rounded) half[i] = 0.0;
  }
  std::vector<Piece> pieces = pieces_with(half, limits);
  if (!(duration(speed_profile(pieces)) < rounded)) return;
  half_ = std::move(half);
  pieces_ = std::move(pieces);
}

double RoundedPath::at(std::size_t piece, double way, Eigen::Ref<Eigen::RowVectorXd> q) const {
  const std::size_t i = piece / 2;  // the leg, or the one before the corner
  const auto row = static_cast<Index>(i);
  const auto along = [&](std::size_t leg, double share) {
    const auto from = static_cast<double>(kept_[leg]), to = static_cast<double>(kept_[leg + 1]);
    return from + std::clamp(share, 0.0, 1.0) * (to - from);
  };
  if (piece % 2 == 0) {
    const double on_leg = half_[i] + way;
    q = points_.row(row) + on_leg * directions_.row(row);
    return along(i, on_leg / lengths_[i]);
  }
  const double half = half_[i + 1], s = way - half, x = way / (2.0 * half);
  q = points_.row(row + 1) + s * directions_.row(row) +
      2.0 * half * turn_integral(x) * (directions_.row(row + 1) - directions_.row(row));
  return s < 0.0 ? along(i, 1.0 + s / lengths_[i]) : along(i + 1, s / lengths_[i + 1]);
}

}  // namespace bathyal::workspace
