// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {

/// A simulated multibeam survey over a bottom that is known exactly.
struct SurveyOptions {
  std::uint64_t seed = 0;  ///< the same seed and options give the same bytes

  // The place: x east along the lines, y north across them, z up.
  Vec3 origin{431200.0, 6172650.0, -38.0};  ///< south-west corner, and the bottom's mean height [m]
  double length = 60.0;                     ///< along the lines [m], above 0
  double width = 40.0;                      ///< across them [m], above 0

  // The bottom.
  double wave_height = 0.5;     ///< sand waves, trough to crest [m], 0 or more
  double wave_length = 9.0;     ///< from crest to crest [m], above 0
  double ripple_height = 0.04;  ///< ripples on them [m], 0 or more
  double roughness = 0.15;      ///< rms of the long undulation [m], 0 or more
  int boulders = 30;            ///< how many, 0 or more
  double boulder_radius = 1.3;  ///< of the largest [m], above 0; the smallest have a fifth of it
  double trench_depth = 1.1;    ///< of a trench across the lines [m], 0 for none
  double trench_width = 3.5;    ///< between the tops of its walls [m], above 0

  // The survey.
  int lines = 2;                   ///< side by side, at equal distances over the width, 1 or more
  double altitude = 8.0;           ///< of the sounder above the bottom's mean height [m], above 0
  double opening = 2.0943951;      ///< of the fan of beams [rad], from above 0 to 2.8
  int beams = 256;                 ///< a ping, at equal angles, 2 or more
  double ping_spacing = 0.12;      ///< along the line [m], above 0
  double lost_width = 2.0;         ///< pings lost on the first line, as a length [m], 0 or more
  double range_noise = 0.006;      ///< standard deviation of a range, its constant part [m]
  double range_noise_rate = 8e-4;  ///< and the part that grows with the range [m/m]
  double angle_noise = 6e-4;       ///< standard deviation of a beam's angle [rad], 0 or more
  double spike_fraction = 0.0;  ///< of soundings that are echoes from fish above the bottom, 0 to 1

  int num_threads = 0;  ///< 0: all

  /// \throw std::invalid_argument, also for more than 10⁸ soundings, and for heights, depths and a
  /// boulder's radius above 20 km.
  void check() const;
};

/// The bottom of a generated survey: sand waves with crests that meander and lee sides that are
/// steep, ripples, a slow undulation, boulders half buried with a scour around each, a trench.
class GeneratedSeabed {
 public:
  explicit GeneratedSeabed(const SurveyOptions& options);

  /// True height [m] at survey coordinates x, y [m], anywhere.
  double height(double x, double y) const { return local_height(x - x0_, y - y0_) + z0_; }

  /// Relative to the origin, of a place relative to the origin.
  double local_height(double x, double y) const;

  /// Nothing rises above it, relative to the origin [m].
  double highest() const { return highest_; }

 private:
  struct Wave {
    double kx, ky, phase, amplitude;
  };
  struct Boulder {
    double x, y, along, across, cosine, sine, height;
  };

  double sand_wave(double x, double y) const;
  double trench(double x, double y) const;
  double boulders(double x, double y) const;

  double x0_, y0_, z0_;
  double wave_height_, wave_number_, ripple_height_;
  double trench_depth_, trench_half_, trench_x_, trench_phase_;
  double highest_;
  std::vector<Wave> undulation_;
  std::vector<Wave> meander_;
  std::vector<Boulder> boulders_;
};

/// Sails the lines over the bottom: every beam meets it where it does first, so boulders cast
/// shadows and the spacing is uneven; a stripe of pings is lost on the first line; noise grows with
/// range. Attributes: "uncertainty", the standard deviation of z [m], and "intensity", the
/// backscatter by Lambert's law with speckle [dB]. Rows go line by line, ping by ping, beam by
/// beam.
PointCloud generate_survey(const SurveyOptions& options = {});

/// The true height [m] at survey coordinates x, y [m] of the survey that these options give.
/// \throw std::invalid_argument for a place that is not finite.
Values survey_height(const Values& x, const Values& y, const SurveyOptions& options = {});

}  // namespace bathyal
