// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// Deviation of positions that an arm predicts from measured ones, after alignment of the frames.
struct Verification {
  Pose measured_from_predicted = Pose::Identity();  ///< the alignment
  double rms_before = 0.0;        ///< √mean‖e‖² with the centroids removed only [m]
  double rms_after = 0.0;         ///< √mean‖e‖² aligned [m]
  std::vector<Index> pairs;       ///< (N,) row of `positions` that belongs to each prediction
  PointMatrix residual;           ///< (N, 3) measured less predicted, aligned, measured frame [m]
  std::vector<double> deviation;  ///< (N,) ‖residual‖ [m]
};

/// The check of Yukhimets and Gubankov (2023): both clouds' centroids are removed and the predicted
/// cloud is rotated onto the measured one, so that neither the frame of the instrument nor the
/// position of the arm matters. `pairs` gives for each prediction the row of `positions` it belongs
/// to; empty pairs row by row.
/// \throw std::invalid_argument as align, and for other than one row for each prediction, rows that
///         do not exist, or one given twice.
Verification verify_positions(PointView predicted, PointView positions,
                              const std::vector<Index>& pairs = {});

}  // namespace bathyal
