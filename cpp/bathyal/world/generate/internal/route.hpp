// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal::generate {

/// A smooth curve through points, by its length: a centripetal Catmull–Rom spline (Yuksel,
/// Schaefer, Keyser 2011, Parameterization and applications of Catmull–Rom curves), straight where
/// they are.
class RouteCurve {
 public:
  /// \throw std::invalid_argument that names `route`: fewer than two points, one that is not finite
  /// or further out than 10⁷ m, or two neighbours at one place.
  explicit RouteCurve(std::vector<Vec3> points);

  double length() const { return along_.back(); }
  Vec3 at(double along) const;

  /// Length [m] at each of the points.
  std::vector<double> knots() const;

 private:
  Vec3 evaluate(double parameter) const;  ///< i at point i

  std::vector<Vec3> points_;   ///< with one before the first and one after the last
  std::vector<double> along_;  ///< length at each sample, kSamples between two points
};

/// Linear between the values at rising `knots`, at least two; the first and last beyond them.
double between(const std::vector<double>& knots, const std::vector<double>& values, double at);

/// A tube's rings along a curve, without torsion (Wang, Jüttler, Zheng, Liu 2008, Computation of
/// rotation minimizing frames, by double reflection).
/// \throw std::invalid_argument that names `route` where it bends more tightly than the tube is
/// thick, and would cross itself.
std::vector<std::vector<Vec3>> tube_rings(const std::vector<Vec3>& center,
                                          const std::vector<double>& radius, int sides);

}  // namespace bathyal::generate
