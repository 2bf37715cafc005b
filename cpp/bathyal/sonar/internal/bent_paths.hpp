// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "bathyal/geometry/pose.hpp"
#include "bathyal/water/sound_path.hpp"
#include "bathyal/water/speed_profile.hpp"

namespace bathyal::sonar {

/// The paths of sound that leave a depth: an exact path every 0.35° of launch, at steps of equal
/// time; what differs from the straight line is linear between. Rays are cast along chords of
/// as many steps as stay within 2 cm of the arc.
class BentPaths {
 public:
  /// \param depth of the sonar [m]
  /// \param range as far as paths go, counted by the sound speed at the sonar [m]
  /// \param steepest_up, steepest_down launch angles below the horizontal between which rays leave
  BentPaths(const SpeedProfile& profile, double depth, double range, double steepest_up,
            double steepest_down, int num_threads);

  /// A ray as it leaves.
  struct Launch {
    std::size_t row = 0;
    double part = 0.0;
    Vec3 level = Vec3::UnitX();  ///< its horizontal direction
    double along = 1.0, down = 0.0;
  };
  Launch launch(const Vec3& direction) const;

  /// Steps at which the chords of a ray end: few where it runs straight, many where it bends.
  const std::vector<int>& chord_ends(const Launch& launch) const { return ends_[launch.row]; }

  double step_range() const { return range_ / static_cast<double>(steps_); }  ///< of its time

  /// Where the end of a number of steps lies, from the launch.
  Vec3 place(const Launch& launch, int steps) const;

  /// What a path is like there.
  struct State {
    double turned = 0.0;  ///< downwards since the launch [rad]
    double speed = 0.0;   ///< of sound [m/s]
    double tube = 1.0;    ///< area of a tube of rays over that of straight ones, 0.1 to 10
  };
  State state(const Launch& launch, int steps) const;

  /// A direction that has turned down.
  static Vec3 turned(const Launch& launch, double angle);

  /// Range along a straight way between two depths, by the times that sound takes [m].
  double slow_range(double length, double from_depth, double to_depth) const;

 private:
  struct Point {
    double out = 0.0, down = 0.0;  ///< from the straight line's [m]
    State state;
  };
  double angle_of(std::size_t row) const;
  SoundPath path_of(double depth, std::size_t row) const;
  void fill(double depth, int num_threads);
  void fill_tubes();
  void fill_chords();
  bool near_chord(std::size_t row, std::size_t first, std::size_t end) const;
  bool close_enough(double depth, int chords) const;
  const Point& at(std::size_t row, std::size_t step) const {
    return points_[row * (steps_ + 1) + step];
  }

  SpeedProfile profile_;
  double range_, speed_;
  double low_ = 0.0, apart_ = 1.0;  ///< launch angle of row 0, and from row to row [rad]
  std::size_t rows_ = 0;
  std::size_t steps_ = 0;
  std::vector<Point> points_;
  std::vector<std::vector<int>> ends_;  ///< between each row and the next
};

}  // namespace bathyal::sonar
