// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "bathyal/compensation/fixed_effect.hpp"
#include "bathyal/identify/fit/redundancy.hpp"
#include "bathyal/identify/identify_arm.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

// What an identification knows before it searches. For use inside the room.

namespace bathyal {

/// The unknowns of an arm, what is known of them beside the data, and where the search starts.
/// Stays in place: `system` looks at `columns`, and the caller's arm, data and options must outlive
/// it.
struct ArmProblem {
  /// \throw std::invalid_argument for names that no column has, and a free base that nothing holds
  ArmProblem(const Arm& arm, const Measurement& measurement, const IdentifyOptions& options,
             const std::vector<HeldEffect>& effects = {});
  ArmProblem(const ArmProblem&) = delete;
  ArmProblem& operator=(const ArmProblem&) = delete;

  const Arm& arm;
  const Measurement& measurement;
  const IdentifyOptions& options;
  bool base_free = false;  ///< that of the first station
  ArmColumns columns;
  std::vector<int> fixed;          ///< columns that the caller holds at nominal, effects among them
  std::vector<GaugeColumn> gauge;  ///< columns that base and tool make superfluous
  std::optional<double> length_prior;  ///< asked for, or standing in for a scale [m]
  bool size_told = false;              ///< by the data, whatever the priors say
  std::optional<ArmSystem> system;     ///< over the columns that are left free
  Eigen::VectorXd start;               ///< values of all columns

  ColumnChoice choice() const;
  /// The std of every a and d that has no prior of its own [m].
  void set_length_prior(double std);
  /// The travel of a sliding joint is known, so that touches tell the size of an arm that has one:
  /// no change of the size is among those that are `unseen`. The prior that stood in for it goes
  /// then, unless the caller holds a length; true when it did, and what is seen must be asked anew.
  bool drop_size_prior(const Eigen::MatrixXd& unseen);

 private:
  void find_columns();
  void hold(const std::vector<HeldEffect>& effects);
  void set_priors();
  void settle_frames();
  void free_the_rest();
  void set_first_noise();
};

/// Derivative of the arm's size by the columns: Σ L (x - L) / Σ L² over the rows' lengths L. Where
/// they are all zero there is nothing but the tool that could shrink.
Eigen::VectorXd size_derivative(const ArmColumns& columns);

}  // namespace bathyal
