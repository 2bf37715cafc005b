// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "bathyal/geometry/pose.hpp"
#include "bathyal/water/speed_profile.hpp"

namespace bathyal::sonar {

/// The paths of sound that leave a depth at all angles, as chains of straight chords: an exact path
/// for each of 513 launch angles, of which what differs from the straight line is linear between.
/// All chords take the same time, and none lies farther than 2 cm from its arc.
class BentPaths {
 public:
  /// \param depth of the sonar [m]
  /// \param range as far as paths go, counted by the sound speed at the sonar [m]
  BentPaths(const SpeedProfile& profile, double depth, double range, int num_threads);

  /// A ray as it leaves.
  struct Launch {
    std::size_t row = 0;
    double part = 0.0;
    Vec3 level = Vec3::UnitX();  ///< its horizontal direction
    double along = 1.0, down = 0.0;
  };
  Launch launch(const Vec3& direction) const;

  int chords() const { return chords_; }
  double chord_range() const { return chord_range_; }  ///< of a chord's time

  /// Where the end of a number of chords lies, from the launch. Halves are middles of their arcs.
  Vec3 place(const Launch& launch, double ends) const;

  /// What a path is like at the end of a number of chords.
  struct State {
    double turned = 0.0;  ///< downwards since the launch [rad]
    double speed = 0.0;   ///< of sound [m/s]
    double tube = 1.0;    ///< area of a tube of rays over that of straight ones, 0.1 to 10
  };
  State state(const Launch& launch, int ends) const;

  /// A direction that has turned down.
  static Vec3 turned(const Launch& launch, double angle);

  /// Range along a straight way between two depths, by the times that sound takes [m].
  double slow_range(double length, double from_depth, double to_depth) const;

 private:
  struct Point {
    double out = 0.0, down = 0.0;  ///< from the straight line's [m]
    State state;
  };
  void fill(double depth, int num_threads);
  void fill_tubes();
  bool close_enough(double depth, int chords) const;
  const Point& at(std::size_t row, std::size_t half) const { return points_[row * halves_ + half]; }

  SpeedProfile profile_;
  double range_, speed_;
  int chords_ = 1;
  std::size_t halves_ = 0;  ///< points of a path: ends and middles of chords
  double chord_range_ = 0.0;
  std::vector<Point> points_;
};

}  // namespace bathyal::sonar
