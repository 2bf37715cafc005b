// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/identify/model/arm_parameters.hpp"
#include "bathyal/touch_planning/forecast.hpp"

// The model of the tip that forecasts and plans of touches share.

namespace bathyal::touch_planning {

/// The parameters of an arm with their priors, and the indices of the free ones: without those that
/// base and tool can represent.
struct TouchModel {
  ArmParameters parameters;
  std::vector<int> free;
};

/// \throw std::invalid_argument for a workspace of another number of joints
void check_workspace(const Arm& arm, const ForecastOptions& options);

/// `measurement` gives the kind of the touches: with known points the base is known.
TouchModel make_touch_model(const Arm& arm, const Measurement& measurement,
                            const ForecastOptions& options);

/// (columns, 3 N) derivative of the tip by each free parameter, in m per unit of its scale: three
/// columns a pose, one for each coordinate.
Eigen::MatrixXd tip_derivatives(const TouchModel& model, const RowMatrix& q, int num_threads);

/// The joint values nearest to those of `q` at which the tip is on the target of the row (3, N).
RowMatrix joints_on_targets(const TouchModel& model, const RowMatrix& q,
                            const Eigen::Matrix3Xd& targets, int num_threads);

/// Position of the tip, (3, N) in the world.
Eigen::Matrix3Xd tips_of(const TouchModel& model, const RowMatrix& q, int num_threads);

/// Sum of the lengths of rows and tool, at least a decimetre [m].
double length_of(const Arm& arm);

/// (count, n) poses drawn uniformly within the limits; of joints with a wider range, within a full
/// turn about zero or as near to it as possible; of prismatic ones without limits, within the
/// length of the arm.
RowMatrix random_poses(const Arm& arm, Index count, std::uint64_t seed);

}  // namespace bathyal::touch_planning
