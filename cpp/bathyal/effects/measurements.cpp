// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/effects/measurements.hpp"

#include <algorithm>
#include <numbers>
#include <set>
#include <string_view>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

std::string rows_text(std::size_t rows) {
  return std::to_string(rows) + (rows == 1 ? " row" : " rows");
}

void check_length(std::string_view name, std::size_t length, Index rows) {
  if (length != static_cast<std::size_t>(rows)) {
    throw_argument(name, rows_text(static_cast<std::size_t>(rows)) + ", as many as `q`",
                   rows_text(length));
  }
}

/// Two turns in either direction: a larger number is an angle in degrees rather than in radians.
constexpr double kMostRadians = 4.0 * std::numbers::pi;
/// [m] Beyond it the spacing of doubles exceeds a tenth of a micrometre.
constexpr double kFarthest = 1e9;
constexpr double kMostCovariate = 1e100;  ///< squares of larger numbers overflow
/// Of the largest weight: a row of less is lost in rounding errors.
constexpr double kLeastWeight = 1e-12;

void check_joints(const RowMatrix& q) {
  if (q.rows() == 0 || q.cols() == 0) {
    throw_argument("q", "at least one row and one joint",
                   "shape (" + std::to_string(q.rows()) + ", " + std::to_string(q.cols()) + ")");
  }
  for (Index i = 0; i < q.rows(); ++i) {
    for (Index j = 0; j < q.cols(); ++j) {
      const std::string place = " at row " + std::to_string(i) + ", joint " + std::to_string(j);
      if (!std::isfinite(q(i, j))) throw_argument("q", "finite numbers", to_text(q(i, j)) + place);
      if (std::abs(q(i, j)) > kMostRadians) {
        throw_argument("q",
                       "radians within two turns (metres of sliding joints); give degrees as "
                       "`q_deg`, of a file by unit=\"deg\"",
                       to_text(q(i, j)) + place);
      }
    }
  }
  if (q.rows() > 1 && (q.rowwise() - q.row(0)).cwiseAbs().maxCoeff() == 0.0) {
    throw_argument("q", "poses that differ",
                   rows_text(static_cast<std::size_t>(q.rows())) + " that are all equal");
  }
}

void check_weights(const std::vector<double>& weights, Index rows) {
  if (weights.empty()) return;
  check_length("weights", weights.size(), rows);
  for (const double weight : weights) check_positive("weights", weight);
  const auto [least, most] = std::minmax_element(weights.begin(), weights.end());
  if (*least < kLeastWeight * *most) {
    throw_argument("weights", "numbers within a factor of " + to_text(1.0 / kLeastWeight),
                   to_text(*least) + " next to " + to_text(*most) + "; leave such rows out");
  }
}

/// Counted from 0 without a gap, as tools and stations are.
void check_numbers(std::string_view name, const std::vector<int>& numbers, Index rows) {
  if (numbers.empty()) return;
  check_length(name, numbers.size(), rows);
  const std::set<int> used(numbers.begin(), numbers.end());
  if (*used.begin() != 0 || *used.rbegin() != static_cast<int>(used.size()) - 1) {
    throw_argument(name, "numbers that count from 0 without a gap",
                   std::to_string(*used.begin()) + " … " + std::to_string(*used.rbegin()) +
                       ", of which " + std::to_string(used.size()) + " are used");
  }
}

void check_covariates(const Covariates& covariates, Index rows) {
  for (const auto& [name, values] : covariates) {
    const std::string argument = "covariates " + name;
    if (values.cols() == 0) throw_argument(argument, "one column or more", "none");
    check_length(argument, static_cast<std::size_t>(values.rows()), rows);
    for (Index i = 0; i < values.size(); ++i) {
      const double value = values.data()[i];
      if (std::isnan(value) || std::abs(value) <= kMostCovariate) continue;
      throw_argument(argument, "finite numbers, or nan in rows without one",
                     to_text(value) + " at row " + std::to_string(i / values.cols()));
    }
  }
}

void check_positions(const RowMatrix& position) {
  for (Index i = 0; i < position.rows(); ++i) {
    const std::string place = " at row " + std::to_string(i);
    for (const double value : position.row(i)) {
      if (!std::isfinite(value)) {
        throw_argument("position", "finite numbers", to_text(value) + place);
      }
      if (std::abs(value) > kFarthest) {
        throw_argument("position", "metres within " + to_text(kFarthest) + " of the origin",
                       to_text(value) + place);
      }
    }
  }
}

void check_planes(const Touches& touches) {
  std::set<int> seen;
  for (const TouchedPlane& plane : touches.planes) {
    const std::string name = "planes " + plane.name;
    if (plane.rows.size() < 4) {
      throw_argument(name, "four rows or more (three lie on a plane anyway)",
                     rows_text(plane.rows.size()));
    }
    for (const int row : plane.rows) {
      if (row < 0 || row >= touches.q.rows()) {
        throw_argument(name, "rows of `q`, 0 … " + std::to_string(touches.q.rows() - 1),
                       std::to_string(row));
      }
      if (!seen.insert(row).second) {
        throw_argument(name, "rows that belong to one plane only, once", std::to_string(row));
      }
    }
  }
}

}  // namespace

void Touches::check() const {
  check_joints(q);
  check_length("point", point.size(), q.rows());
  check_weights(weights, q.rows());
  check_numbers("tool", tool, q.rows());
  check_numbers("station", station, q.rows());
  check_covariates(covariates, q.rows());
  check_planes(*this);
  check_positive("distance_std", distance_std);
  check_positive("point_std", point_std);

  std::set<int> on_plane;
  for (const TouchedPlane& plane : planes) on_plane.insert(plane.rows.begin(), plane.rows.end());
  std::map<int, int> count;
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (!on_plane.contains(static_cast<int>(i))) ++count[point[i]];
  }
  const auto touched = [&](std::string_view name, int label) {
    if (!count.contains(label)) {
      throw_argument(name, "labels that occur in `point`", std::to_string(label));
    }
  };
  for (const KnownDistance& known : known_distances) {
    touched("known_distances", known.first);
    touched("known_distances", known.second);
    if (known.first == known.second) {
      throw_argument("known_distances", "two points",
                     "point " + std::to_string(known.first) + " with itself");
    }
    check_positive("known_distances", known.distance);
  }
  std::set<int> known_labels;
  for (const KnownPoint& known : known_points) {
    touched("known_points", known.label);
    if (!known_labels.insert(known.label).second) {
      throw_argument("known_points", "each point once", std::to_string(known.label) + " twice");
    }
    if (!(known.position.cwiseAbs().maxCoeff() <= kFarthest)) {
      throw_argument("known_points", "metres within " + to_text(kFarthest) + " of the origin",
                     "others of point " + std::to_string(known.label));
    }
  }
  for (const auto& [label, name] : names) {
    if (std::find(point.begin(), point.end(), label) == point.end()) {
      throw_argument("names", "labels that occur in `point`",
                     std::to_string(label) + " (" + name + ")");
    }
  }
  const bool compared = std::any_of(count.begin(), count.end(),
                                    [](const auto& point_count) { return point_count.second > 1; });
  if (!compared && known_points.empty() && planes.empty()) {
    throw_argument("point", "a point that is touched in two poses or more",
                   "one pose for each of " + std::to_string(count.size()) + " points");
  }
}

void Tracked::check() const {
  check_joints(q);
  if (q.rows() < 2) throw_argument("q", "two poses or more", "one");
  if (position.cols() != 3) {
    throw_argument("position", "shape (N, 3)", std::to_string(position.cols()) + " columns");
  }
  check_length("position", static_cast<std::size_t>(position.rows()), q.rows());
  check_positions(position);
  if (!pose.empty()) check_length("pose", pose.size(), q.rows());
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const Eigen::Matrix3d r = pose[i].linear();
    if (!((r * r.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-6) ||
        r.determinant() < 0.0) {
      throw_argument("pose", "rotations of determinant 1",
                     "another matrix in row " + std::to_string(i));
    }
  }
  check_weights(weights, q.rows());
  check_numbers("tool", tool, q.rows());
  check_numbers("station", station, q.rows());
  check_covariates(covariates, q.rows());
}

}  // namespace bathyal
