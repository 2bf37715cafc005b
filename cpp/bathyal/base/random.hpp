// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace bathyal {

/// A stream of random numbers that is the same on every machine, compiler and thread count (the
/// standard's distributions are not). `RandomStream(seed, index)` gives element `index` a stream of
/// its own, so a parallel loop draws the same numbers however it is split.
/// SplitMix64 (Steele, Lea, Flood 2014).
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed, std::uint64_t index = 0)
      : state_(mix(seed + kStep) ^ mix(mix(index) + kStep)) {}

  std::uint64_t next() {
    state_ += kStep;
    return mix(state_);
  }

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Normal with mean 0 and standard deviation 1 (Box and Muller 1958; the second value is dropped
  /// so that a draw never depends on what was drawn before it).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15U;

  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_;
};

/// A stream of its own for a device, a channel and a sample: what else there is changes nothing.
inline RandomStream keyed_stream(std::uint64_t seed, std::string_view device, std::uint64_t channel,
                                 std::uint64_t sample) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char c : device) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  RandomStream of_device(seed, hash);
  RandomStream of_channel(of_device.next(), channel);
  return RandomStream(of_channel.next(), sample);
}

}  // namespace bathyal
