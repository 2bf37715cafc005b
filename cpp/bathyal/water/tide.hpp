// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace bathyal {

/// One harmonic of a tide: amplitude · cos(rate · time − phase).
struct TideConstituent {
  double amplitude = 0.0;  ///< [m]
  double rate = 0.0;       ///< [rad/s]
  double phase = 0.0;      ///< [rad] at time 0
};

/// Rate [rad/s] of a constituent by its name: M2 S2 N2 K2 K1 O1 P1 Q1 M4 (Schureman 1958).
/// \throw std::invalid_argument for another name.
double tide_rate(const std::string& name);

/// Height of the sea surface above its mean by time. Constituents are as given: no nodal factors.
class Tide {
 public:
  Tide() = default;  ///< none

  /// \throw std::invalid_argument for numbers that are not finite, a negative amplitude or rate.
  explicit Tide(std::vector<TideConstituent> constituents);

  /// A table, linear between times, at the ends as there.
  /// \throw std::invalid_argument for no row, times [s] that do not rise, another count of heights
  /// [m], or numbers that are not finite.
  Tide(std::vector<double> time, std::vector<double> height);

  double height(double time) const;  ///< [m]
  double rate(double time) const;    ///< of the height [m/s]
  double highest() const;            ///< a bound of it, 0 or more [m]

  const std::vector<TideConstituent>& constituents() const { return constituents_; }
  const std::vector<double>& table_time() const { return time_; }      ///< empty without a table
  const std::vector<double>& table_height() const { return height_; }  ///< at each time [m]
  bool none() const { return constituents_.empty() && time_.empty(); }

 private:
  std::vector<TideConstituent> constituents_;
  std::vector<double> time_;
  std::vector<double> height_;
};

}  // namespace bathyal
