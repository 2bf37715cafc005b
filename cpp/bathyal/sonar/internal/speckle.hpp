// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/sonar/internal/pulse.hpp"

namespace bathyal::sonar {

/// Complex amplitudes of a row.
struct Amplitudes {
  std::vector<double> real, imaginary;

  void resize(std::size_t count) {
    real.resize(count);
    imaginary.resize(count);
  }
};

/// A circular complex normal number with a mean power of 1.
struct Phasor {
  double real = 0.0, imaginary = 0.0;
};
Phasor circular(RandomStream& random);

/// Gamma distributed with a mean of 1 (Marsaglia, Tsang 2000).
double texture(RandomStream& random, double shape);

/// What many scatterers in each sample bring of a mean `power`: √(P/2) (g₁ + i g₂), of the K
/// distribution times √texture. Sample i draws from a stream of its own, (key, i).
void draw_speckle(const ReceiverOptions& options, const double* power, std::uint64_t key,
                  Amplitudes& to);

/// to[i] = Σ shape[k] from[i − first − k].
void convolve(const std::vector<double>& shape, std::ptrdiff_t first,
              const std::vector<double>& from, std::vector<double>& to);

}  // namespace bathyal::sonar
