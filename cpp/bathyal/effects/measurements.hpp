// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Quantities recorded in addition to the poses: name to (N, k) numbers. Identification of the
/// geometry does not use them; diagnosis does.
using Covariates = std::map<std::string, RowMatrix>;

/// A known distance between two touched points, by their labels.
struct KnownDistance {
  int first = 0;
  int second = 0;
  double distance = 0.0;  ///< [m]
};

/// Known position of a touched point, in the frame of the measurements (world of Arm::base()).
struct KnownPoint {
  int label = 0;
  Vec3 position = Vec3::Zero();  ///< [m]
};

/// A plane that was touched in many places, and the rows that touched it.
struct TouchedPlane {
  std::string name;
  std::vector<int> rows;
};

/// Joint values recorded while the tool's tip touched fixed points: what Yukhimets and Gubankov
/// (2023) record, by eq 5. N rows, one a touch.
struct Touches {
  RowMatrix q;             ///< (N, n) [rad], [m] of prismatic joints
  std::vector<int> point;  ///< (N,) label of the point that the row touched; of a plane's row: any
  std::vector<KnownDistance> known_distances;
  double distance_std = 1e-4;  ///< of a known distance [m], above 0
  std::vector<KnownPoint> known_points;
  double point_std = 1e-4;           ///< of a known point, per axis [m], above 0
  std::vector<TouchedPlane> planes;  ///< a row belongs to one plane at most
  std::vector<double> weights;       ///< (N,) 1 / variance up to a factor, above 0; empty: equal
  std::vector<int> tool;             ///< (N,) which tool, 0 … ; empty: one
  std::vector<int> station;          ///< (N,) position of the base, 0 … ; empty: one
  Covariates covariates;             ///< each (N, k)
  std::map<int, std::string> names;  ///< of labels, for reports; a label may have none

  /// \throw std::invalid_argument for lengths that differ, numbers that are not finite (NaN of a
  ///         covariate marks a row without it), joint values that must be degrees, no two touches
  ///         of one point, poses that are all equal, labels without a touch, points farther than
  ///         10⁹ m, weights that differ by more than 10¹².
  void check() const;
};

/// Joint values recorded together with the measured position of the tool's tip, or its whole pose.
struct Tracked {
  RowMatrix q;                  ///< (N, n) [rad], [m] of prismatic joints
  RowMatrix position;           ///< (N, 3) of the tip, world [m]
  std::vector<Pose> pose;       ///< (N,) world_from_tool; empty: only `position` was measured
  std::vector<double> weights;  ///< (N,) 1 / variance up to a factor, above 0; empty: equal
  std::vector<int> tool;        ///< (N,) which tool (which target on it), 0 … ; empty: one
  std::vector<int> station;     ///< (N,) position of the base or the tracker; empty: one
  Covariates covariates;        ///< each (N, k)

  /// \throw std::invalid_argument as Touches::check
  void check() const;
};

}  // namespace bathyal
