// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace bathyal {

/// Rows of a side-scan: power, (pings, beams, samples), near to far; NaN where nothing is known.
struct SidescanRows {
  std::span<const float> power;
  std::int64_t pings = 0, beams = 0, samples = 0;
  double sample_length = 0.0;  ///< [m], sample i is from i to i + 1 of them

  std::span<const float> row(std::int64_t ping, std::int64_t beam) const {
    return power.subspan(static_cast<std::size_t>((ping * beams + beam) * samples),
                         static_cast<std::size_t>(samples));
  }
  /// \throw std::invalid_argument
  void check() const;
};

/// Rows laid on a level bottom: bin k of the result is the mean power of what came from the ground
/// range k · spacing to (k + 1) · spacing, where ground² = slant² − first², `first` being the slant
/// range of the first return. Means weigh each sample by the part of it inside, so that no power is
/// lost or made. \param first (pings, beams) [m]; NaN gives a row of NaN.
/// \return (pings, beams, bins), as far as the longest row reaches.
/// \throw std::invalid_argument
struct GroundRows {
  std::vector<float> power;
  std::int64_t pings = 0, beams = 0, bins = 0;
  double spacing = 0.0;

  SidescanRows rows() const { return {power, pings, beams, bins, spacing}; }
};
GroundRows to_ground(const SidescanRows& slant, std::span<const double> first, double spacing);

/// Where a ping's row lies: its middle, and the heading clockwise from y. NaN: nobody knows, the
/// ping is left out.
struct RowPlace {
  double x = 0.0, y = 0.0, heading = 0.0;
};

/// Which way a beam's row goes.
enum class Side { kPort, kStarboard };

struct MosaicOptions {
  double spacing = 0.1;  ///< of the cells [m]
  double gap = 1.0;      ///< the widest between neighbouring pings that is filled [m]

  /// \throw std::invalid_argument
  void check() const;
};

/// An image of the bottom from above, north (y) up.
struct Mosaic {
  std::vector<float> power;  ///< (rows, columns), north to south; NaN: nothing was heard from there
  std::int64_t rows = 0, columns = 0;
  double west = 0.0, north = 0.0;  ///< outer corner of the first cell [m]
  double spacing = 0.0;
  std::int64_t left_out = 0;  ///< pings without a place
};

/// Each cell is the mean power of all bins whose middle lies in it; cells that none lies in,
/// between neighbouring pings of one line, are interpolated between those two pings. \throw
/// std::invalid_argument, Error for an image that the memory does not hold
Mosaic mosaic_of(const SidescanRows& ground, std::span<const Side> sides,
                 std::span<const RowPlace> places, const MosaicOptions& options);

}  // namespace bathyal
