// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/geometry/shared_array.hpp"
#include "bathyal/navigation/navigation_filter.hpp"

namespace bathyal {

/// A track reckoned from attitudes and a velocity log.
struct ReckonedTrack {
  std::vector<double> time;  ///< [s]
  PointMatrix attitude;      ///< roll, pitch, yaw [rad], as rotation_of_angles takes them
  PointMatrix velocity;      ///< in the vehicle [m/s]
};

/// Fixes of the position at times within the track's.
struct PositionFixes {
  std::vector<double> time;   ///< [s], rising
  PointMatrix position;       ///< in the world [m]
  Vec3 noise{0.1, 0.1, 0.1};  ///< standard deviations along x, y, z [m]
};

struct SmoothedTrack {
  std::vector<NavigationEstimate> estimate;  ///< one a row of the track
  std::vector<NavigationUpdate> fixes;       ///< one a fix
};

/// What is usual of a vehicle with an attitude reference and a velocity log: heading within 2°,
/// scale within 1 %, a current of 0.1 m/s that keeps for five minutes, fixes within 2 m of the log.
NavigationOptions reckoning_options();

/// The whole track through its fixes: forward by NavigationFilter::predict_motion, then smoothed.
/// Where it begins is unknown but for its fixes: options.initial_position, devices and lag are not
/// used. A velocity that repeats the row before it to the last bit is an old value that is held: it
/// is replaced by what lies linearly between the fresh ones; after the last fresh one it is kept.
/// \throw std::invalid_argument for a track of fewer than two rows, no fix, times that do not rise
///        or lie outside the track, other counts of rows, numbers that are not finite, a noise that
///        is not above 0, or as options.check()
SmoothedTrack smooth_reckoning(const ReckonedTrack& track, const PositionFixes& fixes,
                               const NavigationOptions& options);

/// Of each row: its values are not those of the row before (the first row's always are not).
std::vector<bool> fresh_rows(const PointMatrix& rows);

}  // namespace bathyal
