// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// A sea state: the JONSWAP spectrum (Hasselmann and others 1973); of `peak_enhancement` 1 it is
/// Pierson and Moskowitz's (1964).
struct SeaState {
  double height = 1.0;            ///< significant, 4 √m₀ [m], 0 or more
  double period = 8.0;            ///< of the peak [s], 0.5 to 60
  double peak_enhancement = 3.3;  ///< γ, 1 to 20
  double direction = 0.0;         ///< the waves travel towards, about z from x [rad]
  double spreading = 10.0;  ///< s of cos²ˢ(½Δ) about it, 0 to 1 000; infinite: long-crested
  int components = 200;     ///< 1 to 10 000
  double depth = std::numeric_limits<double>::infinity();  ///< of the water [m], above 0
  std::uint64_t seed = 0;

  void check() const;
};

/// One Airy wave: elevation a cos(k·x − ω t + φ).
struct WaveComponent {
  double amplitude = 0.0;                            ///< [m]
  double frequency = 0.0;                            ///< ω [rad/s]
  Eigen::Vector2d number = Eigen::Vector2d::Zero();  ///< k [rad/m], the way the wave travels
  double phase = 0.0;                                ///< φ [rad]
};

/// k [rad/m] of ω² = g k tanh(k depth).
double wave_number(double frequency, double depth);

/// Linear (Airy) waves: a sum of components. Velocities and accelerations above and below the mean
/// surface are those of Wheeler's stretching (1970): the depth under the actual surface takes the
/// place of the depth under the mean one.
class Waves {
 public:
  Waves() = default;  ///< a flat surface

  /// Frequencies between 0.5 and 4 of the peak's, one drawn in each of `components` equal bands,
  /// so that the surface does not repeat; amplitudes scaled so that Σ ½a² is height²/16.
  explicit Waves(const SeaState& sea);

  /// One long-crested wave. \param height crest to trough [m]
  static Waves regular(double height, double period, double direction = 0.0,
                       double depth = std::numeric_limits<double>::infinity(), double phase = 0.0);

  /// Components as given, all of one depth. \throw std::invalid_argument for numbers that are not
  /// finite, a negative amplitude, or a frequency or wave number that is not above 0.
  static Waves of(std::vector<WaveComponent> components,
                  double depth = std::numeric_limits<double>::infinity());

  bool flat() const { return components_.empty(); }
  double depth() const { return depth_; }  ///< [m]
  const std::vector<WaveComponent>& components() const { return components_; }

  /// Of the surface above its mean [m].
  double elevation(double x, double y, double time) const;
  double elevation_rate(double x, double y, double time) const;  ///< ∂/∂t [m/s]

  /// How the water moves in its orbits at z above the mean surface; 0 above the actual surface and
  /// below the bottom.
  struct Motion {
    Vec3 velocity = Vec3::Zero();      ///< [m/s]
    Vec3 acceleration = Vec3::Zero();  ///< ∂/∂t of the velocity in a fixed place [m/s²]
  };
  Motion motion(const Vec3& point, double time) const;

 private:
  std::vector<WaveComponent> components_;
  double depth_ = std::numeric_limits<double>::infinity();
};

}  // namespace bathyal
