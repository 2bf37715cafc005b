// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/scene/scene.hpp"

namespace bathyal::generate {

/// Height [m] of the uppermost surface at each place, by rays from above; z of the places is not
/// read. NaN where there is none.
std::vector<double> heights_below(const Scene& terrain, const std::vector<Vec3>& places,
                                  int num_threads);

/// What a tube meets at the stations of its line.
struct Contact {
  std::vector<double> bottom;  ///< under the middle of the tube [m]
  std::vector<double> rest;    ///< height of its middle line where it touches [m]
};

/// The lowest middle line at which a round tube touches at each station, by five rays across it.
/// \throw std::invalid_argument that names `route` for a place with no terrain below.
Contact touch_terrain(const Scene& terrain, const std::vector<Vec3>& places,
                      const std::vector<double>& radius, int num_threads);

/// The line that a chain of the same weight everywhere takes over obstacles: z'' = 1/sag where it
/// is free, at most that where it rests (small slopes). It is the concave envelope of
/// rest − s²/(2 sag) from above, plus s²/(2 sag); sag = ∞ gives the straight chords of the
/// envelope.
std::vector<double> hang(const std::vector<double>& along, const std::vector<double>& rest,
                         double sag);

}  // namespace bathyal::generate
