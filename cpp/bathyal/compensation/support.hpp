// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/effects/effect.hpp"

namespace bathyal {

/// Whether effects of the library use a covariate of that name: temperature, time, payload,
/// direction, gravity, session, row.
bool is_library_covariate(std::string_view name);

/// The covariates of recorded rows that effects use: of the library's those that are known in every
/// row, since others count as not recorded; all of the caller's own.
Covariates used_covariates(const EffectData& data);

/// The region that the training data of a model cover: beyond it the model extrapolates.
struct Support {
  /// Minimum and maximum of each column.
  struct Range {
    Eigen::VectorXd low;
    Eigen::VectorXd high;
  };
  /// An interval between two neighbouring training values of a joint.
  struct Gap {
    double low;
    double high;
  };
  Range joints;  ///< (n,) [rad] or [m]
  /// Of each joint, ascending, those wider than a 200th of its range; empty where unknown.
  std::vector<std::vector<Gap>> gaps;
  Range gravity;  ///< (3,) [m/s²], in the arm's base frame
  /// Of all others but `session`. `payload` is always present: 0 kg where it was not recorded.
  std::map<std::string, Range> covariates;
  std::vector<double> sessions;  ///< of the training data, ascending; empty without sessions

  /// \throw std::invalid_argument for ranges and gaps that are inverted, not finite, or of another
  ///         width; gaps beyond the range of their joint.
  void check(Index coordinates) const;

  /// Of `joint`, those wider than `period`.
  std::vector<Gap> gaps_wider_than(double period, Index joint) const;

  /// Moves joint values (N, n) out of gaps wider than `period`, to the nearer edge. True if any
  /// was in one.
  bool leave_gaps(double period, RowMatrix& q) const;

  /// (N,) at `values` of a joint, the nearest of which in the training data are `edges`: how far
  /// the value of a curve there still counts, against its average. 1 at the edge, falling to 0
  /// within half of `period`, or within the width of the training data behind the edge where that
  /// is less: a single pose does not determine a curve.
  Eigen::ArrayXd edge_weights(const Eigen::Ref<const Eigen::ArrayXd>& values,
                              const Eigen::Ref<const Eigen::ArrayXd>& edges, double period,
                              Index joint) const;

  /// Values evenly spaced over the training data of a joint: its range without gaps wider than
  /// `period`.
  Eigen::VectorXd training_values(Index joint, double period, Index count) const;
};

/// The support of recorded rows. NaN (unknown in that row) is ignored.
Support support_of(const RowMatrix& q, const Covariates& covariates);

/// Poses to predict, and the same poses clamped to the ranges of a support.
struct QueryRows {
  EffectData query;     ///< unknown values (NaN, a session without data) are at the low end
  EffectData low;       ///< within the support; unknown values at the low end
  EffectData high;      ///< within the support; unknown values at the high end
  bool beyond = false;  ///< whether the three differ
};

/// Covariates have N rows, or one for all. `payload` defaults to 0 kg, `gravity` to standard
/// gravity, straight down.
/// \throw std::invalid_argument for another number of rows or columns, infinite numbers.
QueryRows clamp_to_support(const Arm& arm, const Support& support, const RowMatrix& q,
                           const Covariates& covariates);

}  // namespace bathyal
