// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

struct SonarOptions;
struct Echo;

/// How an echo's energy is spread over range.
enum class PulseModel {
  kNone,
  kRectangle,  ///< over the pulse's length: c τ / 2 beyond the range it comes from
  kChirp,      ///< compressed, to c / (2 B) about it, with side lobes below −31 dB
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
  double speckle_shape = 4.0;   ///< ν of the K distribution, 0.1 to 1000
  bool noise = false;           ///< of the sea, within the bandwidth
  double noise_level = 30.0;    ///< spectral level [dB re 1 µPa²/Hz]
  double dropout_rate = 0.0;    ///< part of the pings that bring nothing, 0 to 1
  bool tvg = false;             ///< gain over range, to the order of R = 1 m
  double tvg_spreading = 30.0;  ///< [dB] a decade of range
  double tvg_absorption = 0.0;  ///< [dB/m] of the way there and back, 2 R
  int bits = 0;                 ///< of the samples' amplitude, 0 (not quantised) to 32
  double full_scale = -40.0;    ///< intensity at which it clips [dB]

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

/// The echo of a ping as it is recorded.
Received receive(const SonarOptions& options, const Echo& echo, const ReceiverKey& key);

}  // namespace bathyal
