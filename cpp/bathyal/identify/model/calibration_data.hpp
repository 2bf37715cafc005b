// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/effects/measurements.hpp"

// Touches and tracked poses in a common form, with points counted 0, 1, …

namespace bathyal {

struct Measurement {
  RowMatrix q;
  std::vector<double> weights;         ///< (N,) mean 1
  std::vector<int> tool;               ///< (N,)
  std::vector<int> station;            ///< (N,)
  std::vector<int> perturbation_rows;  ///< (N,) rows of effects' actions; empty: 0 … N - 1
  int tools = 1;
  int stations = 1;

  // Of touches.
  std::vector<int> point;   ///< (N,) index into `labels`, -1 for a plane's row and tracked poses
  std::vector<int> labels;  ///< as the caller numbered them, in rising order
  std::map<int, std::string> names;  ///< of labels that the caller named
  std::vector<int> plane;            ///< (N,) index into `plane_names`, -1
  std::vector<std::string> plane_names;
  std::vector<KnownDistance> distances;  ///< between indices of points
  std::vector<KnownPoint> known_points;  ///< label is an index
  double distance_std = 1e-4;
  double point_std = 1e-4;

  // Of tracked poses.
  bool tracked = false;
  Eigen::Matrix3Xd position;              ///< (3, N)
  std::vector<Eigen::Matrix3d> rotation;  ///< (N,), empty when only positions were measured

  Index rows() const { return q.rows(); }
  Index perturbation_row(Index row) const {
    return perturbation_rows.empty() ? row : perturbation_rows[row];
  }
  int points() const { return static_cast<int>(labels.size()); }
  /// The name of a label, else its number.
  std::string name_of(int label) const;
  bool has_rotation() const { return !rotation.empty(); }
  /// Whether the frame of the measurements is the world frame of the caller.
  bool in_world() const { return tracked || !known_points.empty(); }
  /// Whether the data contain a known length.
  bool observes_scale() const { return in_world() || !distances.empty(); }
};

/// Position rows minus those that the unknown touched points use: 3 Σ(m_i - 1), a row for each
/// touch of a plane, 3 N when tracked.
double free_position_rows(const Measurement& measurement);

/// J of Yukhimets, Gubankov 2023, eq 7, from deviations about the centroids [m²]: Σ over pairs = m
/// Σ about the mean. Touches count alike whatever their weights.
double pair_sum(const Measurement& measurement, const Eigen::Matrix3Xd& deviations);

/// Items of `all` at `rows`; none of an empty list.
template <class Item>
std::vector<Item> picked(const std::vector<Item>& all, const std::vector<int>& rows) {
  std::vector<Item> out;
  for (const int row : rows) {
    if (!all.empty()) out.push_back(all[row]);
  }
  return out;
}

/// The measurement restricted to `rows`, with everything known about the points.
Measurement subset(const Measurement& measurement, const std::vector<int>& rows);

/// \throw std::invalid_argument for invalid data, or another number of joints than the arm.
Measurement to_measurement(const Arm& arm, const Touches& touches);
Measurement to_measurement(const Arm& arm, const Tracked& tracked);

}  // namespace bathyal
