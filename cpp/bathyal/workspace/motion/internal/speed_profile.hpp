// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace bathyal::workspace {

/// A stretch of a path and the limits along it.
struct Piece {
  double length = 0.0;
  double speed = 0.0;
  double acceleration = 0.0;  ///< 0: the speed is constant
  double jerk = 0.0;
};

/// A time of constant jerk.
struct Phase {
  std::size_t piece = 0;
  double start = 0.0;  ///< [s]
  double duration = 0.0;
  double way = 0.0;  ///< at the start, from the start of the piece
  double speed = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;

  double way_at(double time) const {
    const double t = time - start;
    return way + t * (speed + t * (acceleration / 2.0 + t * jerk / 6.0));
  }
};

/// The fastest motion from rest to rest along pieces that has no acceleration where two meet.
std::vector<Phase> speed_profile(const std::vector<Piece>& pieces);

/// Of phases, one at least [s].
inline double duration(const std::vector<Phase>& phases) {
  return phases.back().start + phases.back().duration;
}

}  // namespace bathyal::workspace
