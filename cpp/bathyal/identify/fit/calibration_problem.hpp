// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "bathyal/compensation/fixed_effect.hpp"
#include "bathyal/identify/fit/redundancy.hpp"
#include "bathyal/identify/identify_options.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

// The estimation problem of a calibration, before the search.

namespace bathyal {

/// The unknowns of an arm, prior knowledge of them, and the starting point of the search. Not
/// movable: `system` refers to `parameters`, and the arm, data and options of the caller must
/// outlive it.
struct CalibrationProblem {
  /// \throw std::invalid_argument for names that no parameter has, and a free base that nothing
  ///         determines
  CalibrationProblem(const Arm& arm, const Measurement& measurement, const IdentifyOptions& options,
                     const std::vector<FixedEffect>& effects = {});
  CalibrationProblem(const CalibrationProblem&) = delete;
  CalibrationProblem& operator=(const CalibrationProblem&) = delete;

  const Arm& arm;
  const Measurement& measurement;
  const IdentifyOptions& options;
  bool base_free = false;  ///< that of the first station
  ArmParameters parameters;
  std::vector<int> fixed;  ///< parameters fixed by the caller, effects among them
  std::vector<RedundantParameter> redundant;  ///< that base and tool can represent
  std::optional<double> length_prior;         ///< given, or the default for an unobserved scale [m]
  bool scale_observed = false;                ///< by the data, whatever the priors say
  std::optional<ArmResiduals> system;         ///< over the free parameters
  Eigen::VectorXd start;                      ///< values of all parameters

  ParameterChoice choice() const;
  /// Std of every a and d that has no prior of its own [m].
  void set_length_prior(double std);
  /// The travel of a prismatic joint is known, so that touches may determine the scale of an arm
  /// that has one: no change of the scale is then in the `null_space`. The default prior is dropped
  /// in that case, unless the caller fixes a length; true when it was, and observability must be
  /// evaluated again.
  bool drop_scale_prior(const Eigen::MatrixXd& null_space);

 private:
  void find_columns();
  void fix_effects(const std::vector<FixedEffect>& effects);
  void set_priors();
  void fit_frames();
  void free_remaining();
  void set_initial_noise();
};

/// Derivative of the scale of the arm by the parameters: Σ L (x - L) / Σ L² over the lengths L of
/// the rows; 0 where they are all zero, since only the tool could then shrink.
Eigen::VectorXd scale_derivative(const ArmParameters& parameters);

}  // namespace bathyal
