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
  double half = 0.0;    ///< of the ranges that its cell covers [m], to first order
  double least = 0.0;   ///< distance of the facet's plane: nothing of it is nearer [m]
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

/// Samples first … of a row, as far as rays put power into them.
struct EchoPart {
  std::size_t first = 0;
  std::vector<double> power;
  std::vector<Strongest> strongest;
};

/// A row that rays put their power into, used again and again.
class EchoRow {
 public:
  /// Empty.
  void reset(std::size_t samples, double sample_length);

  /// Spreads a return evenly over the ranges of its cell; what lies outside of the row is lost.
  void add(const Return& back);

  /// Adds what another row holds: of equally strong returns, that of this row stays.
  void add(const EchoPart& later);

  /// What has been added; the row is empty then.
  EchoPart take();

 private:
  void touch(std::size_t first, std::size_t last);
  void put(std::size_t sample, double weight, const Return& back);

  std::vector<double> power_;
  std::vector<Strongest> strongest_;
  std::size_t first_ = 0, end_ = 0;  ///< touched; all else is 0
  double sample_length_ = 1.0;
};

}  // namespace bathyal::sonar
