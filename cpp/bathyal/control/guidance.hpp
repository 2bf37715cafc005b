// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// Follows straight legs between points, in the level plane.
struct LineOfSightOptions {
  std::vector<Eigen::Vector2d> points;  ///< (K, 2) in the world [m], two or more, each apart
  double lookahead = 8.0;               ///< ahead on the line, that the bow points to [m], above 0
  double integral = 0.3;    ///< gain on the offset that a current makes [m/s], 0 or more
  double acceptance = 4.0;  ///< a point this near is reached [m], above 0

  /// \throw std::invalid_argument that names the field
  void check() const;
};

struct LineOfSightState {
  int leg = 0;            ///< from point `leg` to the next
  double integral = 0.0;  ///< [m]
  int arrived = 0;        ///< 1 past the last point
};

struct LineOfSightOutput {
  double heading = 0.0;      ///< to steer, about z from x [rad]
  double cross_track = 0.0;  ///< to port of the leg [m]
};

/// Integral line of sight (Børhaug, Pavlov, Pettersen 2008; Fossen 2011, sect. 10.3): steers
/// α − atan((y + σ i) / Δ), di/dt = Δ y / ((y + σ i)² + Δ²), with y the offset to port of the leg
/// of course α. A new leg keeps nothing of the last one's integral, as it lies elsewhere to the
/// current.
/// \throw std::invalid_argument as the options' check
LineOfSightOutput line_of_sight(const LineOfSightOptions& options, LineOfSightState& state,
                                const Vec3& position, double time);

/// Height of the bottom at a place of the world, as a chart or a sonar that looks ahead gives it.
using BottomFunction = std::function<double(double x, double y)>;

/// Keeps a distance to an uneven bottom.
struct BottomFollowOptions {
  double altitude = 3.0;    ///< over the bottom [m], above 0
  double lookahead = 25.0;  ///< how far ahead the bottom is known [m], above 0
  double lead = 3.0;        ///< steers for the path so far ahead, for the vehicle's own lag [m]
  double steepest = 0.25;   ///< climb and fall of the path, height over way, above 0
  double spacing = 0.5;     ///< of the samples ahead [m], above 0

  /// \throw std::invalid_argument that names the field
  void check() const;
};

struct BottomFollowOutput {
  double z = 0.0;      ///< to steer [m]
  double climb = 0.0;  ///< of that path
};

/// The lowest path that is nowhere nearer to the bottom than `altitude` (measured upwards), and
/// nowhere climbs or falls more than `steepest`, over the bottom ahead and as far behind. \param
/// heading the way over ground, about z from x [rad]
BottomFollowOutput follow_bottom(const BottomFollowOptions& options, const Vec3& position,
                                 double heading, const BottomFunction& bottom);

}  // namespace bathyal
