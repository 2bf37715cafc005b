// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/effects/effect.hpp"

namespace bathyal {

/// Whether the library's effects know a covariate of that name: temperature, time, payload,
/// direction, gravity, session.
bool is_library_covariate(std::string_view name);

/// What effects used of recorded rows: of the library's covariates those that no row lacks, for the
/// others count as not recorded; all of the caller's own.
Covariates used_covariates(const EffectData& data);

/// What the data that taught a model covered: beyond it the model is a guess.
struct Support {
  /// Least and greatest of each column.
  struct Range {
    Eigen::VectorXd low;
    Eigen::VectorXd high;
  };
  /// A stretch between two neighbours among what a joint was taught.
  struct Gap {
    double low;
    double high;
  };
  Range joints;  ///< (n,) [rad] or [m]
  /// Of each joint, rising, those wider than a 200th of its range; empty where nobody told.
  std::vector<std::vector<Gap>> gaps;
  Range gravity;  ///< (3,) [m/s²], in the arm's base frame
  /// Of all others but `session`. `payload` is always there: 0 kg where nobody told it.
  std::map<std::string, Range> covariates;
  std::vector<double> sessions;  ///< that were seen, rising; empty where none were told

  /// \throw std::invalid_argument for ranges and gaps that are crossed, not finite, or of another
  ///        width; gaps beyond their joint's range.
  void check(Index coordinates) const;

  /// Of `joint`, those wider than `period`.
  std::vector<Gap> gaps_wider_than(double period, Index joint) const;

  /// Brings joint values (N, n) out of gaps wider than `period`, to the nearer edge. True where any
  /// was in one.
  bool leave_gaps(double period, RowMatrix& q) const;

  /// Values spread evenly over what a joint was taught: its range less gaps wider than `period`.
  Eigen::VectorXd taught(Index joint, double period, Index count) const;
};

/// The support of recorded rows. Values that are NaN (not known in that row) teach nothing.
Support support_of(const RowMatrix& q, const Covariates& covariates);

/// Poses to foretell, and the same poses brought within the ranges of a support.
struct AskedRows {
  EffectData asked;  ///< what is not known (NaN, a session that nobody saw) stands at its low end
  EffectData low;    ///< within the support; what is not known at the low end
  EffectData high;   ///< within the support; what is not known at the high end
  bool beyond = false;  ///< whether the three differ at all
};

/// Covariates have N rows, or one that counts for all. Without `payload` 0 kg, without `gravity`
/// the standard's, straight down.
/// \throw std::invalid_argument for another number of rows or columns, infinite numbers.
AskedRows ask(const Arm& arm, const Support& support, const RowMatrix& q,
              const Covariates& covariates);

}  // namespace bathyal
