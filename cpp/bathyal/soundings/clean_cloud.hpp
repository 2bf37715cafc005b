// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {

/// Which of several soundings at one x, y stays.
enum class SamePlace { kKeep, kShallowest, kDeepest };

/// What clean_cloud does beyond dropping points that are not finite and exact duplicates.
struct CleanOptions {
  /// Soundings of equal x, y and different z: all stay, or only the highest, or only the lowest.
  SamePlace same_place = SamePlace::kKeep;
  /// Spikes lie further from the median height of their neighbours in plan than this many robust
  /// standard deviations (1.4826 × the median of absolute deviations: of the neighbours or of the
  /// whole cloud, whichever is larger). 0: spikes are not looked for; 0 or more.
  double spike_sigma = 0.0;
  double spike_height = 0.1;  ///< and at least this far [m], 0 or more
  int spike_neighbours = 16;  ///< 3 to 64
  /// Statistical outliers: the mean distance to their nearest neighbours (3-D) is above that of all
  /// points by more than this many standard deviations. 0: not looked for; 0 or more.
  double outlier_sigma = 0.0;
  int outlier_neighbours = 12;  ///< 1 to 64
  double voxel = 0.0;           ///< edge of the cubes that keep one sounding each [m]; 0: none
  int num_threads = 0;          ///< 0: all

  /// \throw std::invalid_argument
  void check() const;
};

/// How many soundings each step dropped, in the order of the steps.
struct CleanReport {
  Index before = 0;
  Index not_finite = 0;  ///< x, y or z is NaN or infinite
  Index duplicates = 0;  ///< equal x, y and z, all but one
  Index same_place = 0;  ///< share x, y with a sounding of another z; counted, dropped or not
  Index same_place_dropped = 0;
  Index spikes = 0;
  Index outliers = 0;
  Index thinned = 0;  ///< by voxels
  Index after = 0;

  std::string text() const;  ///< for people: one line a step that found something
};

struct CleanResult {
  PointCloud cloud;
  CleanReport report;
  Indices rows;  ///< (N,) which row of the given cloud each sounding was
};

/// Drops points that are no soundings and, as the options request, redundant ones and outliers;
/// reports how many and why.
///
/// Points that are not finite go first, then exact duplicates (the first row stays), then, each
/// only where its option is set and in this order: soundings at one x, y but the chosen one;
/// spikes; statistical outliers (the rule of Rusu et al. 2008, "Towards 3D point cloud based object
/// maps for household environments"); all soundings of a voxel but the one nearest to their
/// centroid, so that every sounding that stays was measured. Voxels begin at multiples of their
/// edge. Attributes and datum follow. Rows keep their order, and which positions stay does not
/// depend on it, nor on num_threads. An empty cloud, or one of which nothing stays, gives an empty
/// cloud. \throw std::invalid_argument for options out of range, more than 2³¹ − 1 points, or a
/// voxel so small that its cells cannot be counted exactly.
CleanResult clean_cloud(const PointCloud& cloud, const CleanOptions& options = {});

}  // namespace bathyal
