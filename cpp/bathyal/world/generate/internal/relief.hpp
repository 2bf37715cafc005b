// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace bathyal::generate {

/// A sum of plane waves of random phase whose power follows k^−exponent: a Gaussian relief of known
/// rms and spectrum, 32 waves an octave, at directions spread by the golden angle.
class Relief {
 public:
  Relief(std::uint64_t seed, std::uint64_t stream, double rms, double exponent, double longest,
         double shortest);

  double at(double x, double y) const;

  /// sin and cos of k x of each wave at each of some x: what the places of a column share.
  struct Columns {
    std::size_t count = 0;
    std::vector<double> sine, cosine;  ///< wave by wave
  };
  Columns columns(const double* x, std::size_t count) const;

  /// Heights at all columns of one y: the same bytes as at().
  void row(const Columns& columns, double y, double* height) const;

 private:
  struct Wave {
    double kx, ky, phase, amplitude;
  };
  std::vector<Wave> waves_;
};

}  // namespace bathyal::generate
