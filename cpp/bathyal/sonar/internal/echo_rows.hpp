// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal::sonar {

/// What a ray brings back.
struct Return {
  double weight = 0.0;  ///< power
  double range = 0.0;   ///< of its middle [m]
  double half = 0.0;    ///< of the ranges that its cell covers [m]
  double incidence_cosine = 0.0;
  std::int32_t material = -1;
  Vec3 point = Vec3::Zero();
  Vec3 slide = Vec3::Zero();  ///< along the surface for 1 m of range, within the cell
};

/// The strongest return of a sample.
struct Strongest {
  double weight = 0.0;  ///< 0: none
  double range = 0.0;
  double incidence_cosine = 0.0;
  std::int32_t material = -1;
  Vec3 point = Vec3::Zero();
};

/// The samples of a row that rays put their power into.
class EchoRow {
 public:
  EchoRow(std::size_t samples, double sample_length)
      : power(samples, 0.0), strongest(samples), sample_length_(sample_length) {}

  /// Spreads a return evenly over the ranges of its cell; what lies outside of the row is lost.
  void add(const Return& back);

  /// Adds a row that was filled after this one: of equals, this one's return stays the strongest.
  void add(const EchoRow& later);

  std::vector<double> power;
  std::vector<Strongest> strongest;

 private:
  void put(std::size_t sample, double weight, const Return& back);

  double sample_length_;
};

}  // namespace bathyal::sonar
