// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace bathyal {

struct AllanDeviation {
  std::vector<double> interval;   ///< averaging times [s]
  std::vector<double> deviation;  ///< in the unit of the data
};

/// Overlapping Allan deviation of equally spaced samples of a rate (IEEE Std 952-1997, annex C):
/// σ²(mτ₀) = Σ (θₖ₊₂ₘ − 2θₖ₊ₘ + θₖ)² / (2 m² τ₀² (N − 2m + 1)), θ the integral of the rate. White
/// noise of density n falls as n/√τ, a random walk of k per √s rises as k √(τ/3).
/// \param factors averaging times as numbers of samples, each 1 to N / 2; empty: 1, 2, 4, …, N / 4
/// \throw std::invalid_argument for fewer than 4 samples, one that is not finite, a sample rate
/// [Hz]
///        not above 0, or a factor out of its range
AllanDeviation allan_deviation(const std::vector<double>& rate_data, double sample_rate,
                               std::vector<std::int64_t> factors = {});

}  // namespace bathyal
