// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

struct SonarOptions;
struct Echo;

/// How an echo's energy is spread over range.
enum class PulseModel {
  kNone,
  kRectangle,  ///< over the pulse's length: c τ / 2 beyond the range it comes from
  kChirp,      ///< compressed under a Hann window: 1.44 c / (2 B) about it at half power, side
               ///< lobes from −31.5 dB down
};

enum class SpeckleModel {
  kNone,
  kRayleigh,  ///< many scatterers a cell: intensity with a contrast of 1
  kK,         ///< patches of them: contrast √(1 + 2/ν)
};

/// What the receiver makes of the power that arrives, in this order. All of it is off unless set.
struct ReceiverOptions {
  PulseModel pulse = PulseModel::kNone;
  SpeckleModel speckle = SpeckleModel::kNone;
  double speckle_shape = 4.0;  ///< ν of the K distribution, 0.1 to 1000
  bool noise = false;  ///< of the sea, in the receiver's band, less what its directivity keeps out
  std::optional<double> noise_level;  ///< spectral [dB re 1 µPa²/Hz]; unset: ambient_noise() at
                                      ///< the frequency and wind_speed
  bool tvg = false;                   ///< gain over range
  double tvg_spreading = 30.0;        ///< [dB] a decade of range, 0 at 1 m
  double tvg_absorption = 0.0;        ///< [dB/m] of the way there and back, 2 R
  double tvg_offset = 0.0;            ///< at all ranges [dB]
  double dropout_rate = 0.0;          ///< part of the pings that bring nothing, 0 to 1
  double beam_dropout_rate = 0.0;     ///< part of the rows that do, of the other pings, 0 to 1
  int bits = 0;                       ///< of the samples' amplitude, 0 (not quantised) to 32
  double full_scale = -10.0;          ///< intensity at which it clips [dB]

  void check() const;
};

/// What the random numbers of a ping come from. Speckle belongs to the place: a sonar that rests
/// hears the same, and one that has moved by a quarter of a wavelength, or turned by an
/// eighth of its beam, another. Noise and dropouts belong to the time.
struct ReceiverKey {
  std::uint64_t seed = 0;
  Pose world_from_sonar = Pose::Identity();
  double time = 0.0;  ///< [s]
};

struct Received {
  std::vector<double> intensity;  ///< (beams, samples)
  std::int64_t clipped = 0;       ///< samples at full scale
  bool dropped = false;           ///< all of it is 0
};

/// The echo of a ping as it is recorded: pulse and speckle, noise, gain, converter, dropouts. Every
/// step but the gain and clipping keeps the mean of what it is given.
///
/// A sample of the echo is the power from its own length Δ. A pulse spreads it over its own: c τ /
/// 2, compressed c / (2 B). Where the intensity of a real receiver grows with the pulse, for more
/// of the bottom is heard at once, this one falls by Δ / pulse, signal and noise alike: their ratio
/// is that of the real one, with the noise of the band B, or of 1 / τ after compression. Without a
/// pulse a sample is the cell, and the noise that of the bandwidth.
///
/// Of a dropout the intensity is 0, which files of amplitudes can hold, and NaN they cannot; with
/// noise on no other sample is exactly 0.
///
/// \param num_threads rows are drawn by their own numbers: any number gives the same bytes.
Received receive(const SonarOptions& options, const Echo& echo, const ReceiverKey& key,
                 int num_threads = 1);

/// Mean intensity of the noise, before the gain.
double noise_intensity(const SonarOptions& options, double sound_speed);

}  // namespace bathyal
