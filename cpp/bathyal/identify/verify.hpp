// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// How far positions an arm predicts lie from measured ones, their frames laid upon each other.
struct Verification {
  Pose measured_from_predicted = Pose::Identity();  ///< the alignment
  double rms_before = 0.0;        ///< √mean‖e‖² with the centroids removed only [m]
  double rms_after = 0.0;         ///< √mean‖e‖² aligned [m]
  std::vector<Index> pairs;       ///< (N,) row of `positions` that belongs to each prediction
  PointMatrix residual;           ///< (N, 3) measured less predicted, aligned, measured frame [m]
  std::vector<double> deviation;  ///< (N,) ‖residual‖ [m]
};

/// The check of Yukhimets and Gubankov (2023): both clouds' centroids are removed and the predicted
/// one is turned onto the measured one, so that neither the instrument's frame nor where the arm
/// stands count. `pairs` names for each prediction the row of `positions` it belongs to; empty
/// pairs row to row. \throw std::invalid_argument as align, and for other than one row for each
/// prediction, rows that are not there, or one named twice.
Verification verify_positions(PointView predicted, PointView positions,
                              const std::vector<Index>& pairs = {});

}  // namespace bathyal
