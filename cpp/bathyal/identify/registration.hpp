// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

struct IcpOptions {
  int max_iterations = 200;  ///< 1 or more

  void check() const;
};

/// For each row of `predicted` the row of `positions` that the iterative closest point algorithm
/// (Besl, McKay 1992), as PCL has it, leaves nearest, from both centroids laid upon each other: the
/// pairing of Yukhimets and Gubankov (2023) where nobody wrote down which measurement belongs to
/// which pose. It finds the pairs only where the clouds start closer to each other than their
/// points lie apart. Positions that nobody predicted are left over. PCL works in float32 about the
/// centroids. \throw std::invalid_argument for fewer than three rows on either side, fewer
/// positions than predictions, or rows that are not finite. \throw Error when it does not converge,
/// and where two rows end up nearest to the same position: one of them is wrong then, and with it
/// every figure that came of it.
std::vector<Index> pair_by_icp(PointView predicted, PointView positions,
                               const IcpOptions& options = {});

}  // namespace bathyal
