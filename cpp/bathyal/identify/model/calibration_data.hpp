// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/effects/measurements.hpp"

// Touches and tracked poses in one form, with points counted 0, 1, … : what the rest of the room
// works on. For use inside it.

namespace bathyal {

struct Measurement {
  RowMatrix q;
  std::vector<double> weights;  ///< (N,) mean 1
  std::vector<int> tool;        ///< (N,)
  std::vector<int> station;     ///< (N,)
  std::vector<int> actions;     ///< (N,) rows of effects' actions; empty: 0 … N - 1
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
  Index action_row(Index row) const { return actions.empty() ? row : actions[row]; }
  int points() const { return static_cast<int>(labels.size()); }
  /// The name of a label, else its number.
  std::string name_of(int label) const;
  bool has_rotation() const { return !rotation.empty(); }
  /// Whether the frame of the measurements is the world that the caller knows.
  bool in_world() const { return tracked || !known_points.empty(); }
  /// Whether the data hold a length of their own.
  bool tells_scale() const { return in_world() || !distances.empty(); }
};

/// Rows of positions less what the touched points themselves take: 3 Σ(m_i - 1), a row for each
/// touch of a plane, 3 N when tracked.
double free_position_rows(const Measurement& measurement);

/// J of Yukhimets, Gubankov 2023, eq 7, from deviations about the centroids [m²]: Σ over pairs =
/// m Σ about the mean. Touches count alike whatever their weights.
double pair_sum(const Measurement& measurement, const Eigen::Matrix3Xd& deviations);

/// Items of `all` at `rows`; none of a list that says nothing.
template <class Item>
std::vector<Item> picked(const std::vector<Item>& all, const std::vector<int>& rows) {
  std::vector<Item> some;
  for (const int row : rows) {
    if (!all.empty()) some.push_back(all[row]);
  }
  return some;
}

/// Some rows of it, with all that is known of the points.
Measurement some_of(const Measurement& measurement, const std::vector<int>& rows);

/// \throw std::invalid_argument when the data are bad by themselves, or have another number of
///        joints than the arm.
Measurement to_measurement(const Arm& arm, const Touches& touches);
Measurement to_measurement(const Arm& arm, const Tracked& tracked);

}  // namespace bathyal
