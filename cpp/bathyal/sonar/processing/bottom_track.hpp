// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace bathyal {

/// How the first return of the bottom is found.
enum class BottomPicker {
  kLikelihood,  ///< where a row's power changes most likely, on a path continuous over the pings
  kThreshold,   ///< where the power rises above that of the water before it, ping by ping
};

struct BottomTrackOptions {
  BottomPicker picker = BottomPicker::kLikelihood;
  std::int64_t first_sample = 0;  ///< nothing nearer is taken for the bottom
  double threshold_db = 6.0;      ///< kThreshold: above the mean of the water's logarithms

  /// \throw std::invalid_argument
  void check() const;
};

/// No bottom in this ping.
inline constexpr std::int64_t kNoBottom = -1;

/// Sample of the bottom's first return in each row of one beam. Neighbouring pings are taken to be
/// heard from neighbouring places; rows are near to far and may end in NaN.
///
/// kLikelihood compares, at every sample, one exponential distribution of the power (speckle) in
/// the 24 samples before and the 8 after with two, and finds by dynamic programming the path of
/// highest likelihood that moves at most 8 samples from ping to ping, each of which costs 1.
/// kThreshold averages the logarithm of the power over three pings and three samples, and asks for
/// eight samples in a row above that of the sixty before them; a median of five pings follows.
/// The two share nothing but their input.
///
/// \param power (pings, samples), pings `stride` apart.
/// \throw std::invalid_argument for sizes that do not fit.
std::vector<std::int64_t> track_bottom(std::span<const float> power, std::int64_t pings,
                                       std::int64_t samples, std::int64_t stride,
                                       const BottomTrackOptions& options);

}  // namespace bathyal
