// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

struct IcpOptions {
  int max_iterations = 200;  ///< 1 or more

  void check() const;
};

/// For each row of `predicted` the row of `positions` that is nearest after the iterative closest
/// point algorithm (Besl, McKay 1992; PCL), starting with aligned centroids: the pairing of
/// Yukhimets and Gubankov (2023) where it was not recorded which measurement belongs to which pose.
/// It finds the pairs only where the clouds start closer to each other than the distance between
/// their points. Positions without a prediction remain unpaired. PCL computes in float32 about the
/// centroids.
/// \throw std::invalid_argument for fewer than three rows on either side, fewer positions than
///         predictions, or rows that are not finite.
/// \throw Error when it does not converge, and where two rows are nearest to the same position: at
///         least one of the pairs is then wrong, and with it every figure that depends on it.
std::vector<Index> pair_by_icp(PointView predicted, PointView positions,
                               const IcpOptions& options = {});

}  // namespace bathyal
