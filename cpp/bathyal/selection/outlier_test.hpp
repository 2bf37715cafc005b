// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/selection/folds.hpp"
#include "bathyal/selection/model.hpp"

// Units that do not belong, and noise that is not the same for all. For use inside the room.

namespace bathyal {

/// A unit beside what the others foretell of it.
struct UnitTest {
  double distance = 0.0;  ///< squared, in units of its own variance had it not been used; per row
  double p = 1.0;         ///< by Fisher's F, of this unit alone
  double rows = 0.0;      ///< of it that the others foretell
};

/// Each unit's rows against a fit to all others (deleted residuals, leverage counted). `trust`
/// says which ones the fit leaves out already.
std::vector<UnitTest> test_units(const Linearization& at, const Eigen::MatrixXd& basis,
                                 const Eigen::VectorXd& trust, double freedom);

/// The share of chance that names one innocent unit.
inline constexpr double kOddUnit = 0.001;

/// `trust` with 0 for units that do not belong, and with those taken back that do.
Eigen::VectorXd leave_out_odd(const Linearization& at, const Eigen::MatrixXd& basis,
                              const Eigen::VectorXd& trust, double freedom);

/// A noise form, fitted.
struct NoiseFit {
  int form = 0;
  double parameter = 0.0;      ///< in its unit
  double std = 0.0;            ///< of it
  double gain = 0.0;           ///< log likelihood over that of equal noise
  double held_out_gain = 0.0;  ///< the same on blocks that it did not see
  double share = 0.0;          ///< of the noise's variance that it makes
  double ratio = 0.0;          ///< Subject::set_noise_forms
};

/// `basis` as above; `noise` of a position row [m]. `trust` is 0 or 1.
NoiseFit fit_noise(const NoiseForm& form, const Linearization& at, const Eigen::MatrixXd& basis,
                   const Eigen::VectorXd& trust, double noise, const Blocks& blocks);

}  // namespace bathyal
