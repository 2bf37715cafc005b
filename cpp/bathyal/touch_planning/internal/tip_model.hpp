// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/identify/model/arm_parameters.hpp"
#include "bathyal/touch_planning/forecast.hpp"

// What a forecast and a plan of touches share. For use inside the room.

namespace bathyal {

/// An arm's columns with their priors, and those that are free: not left to base and tool.
struct TouchModel {
  ArmColumns columns;
  std::vector<int> free;
};

/// \throw std::invalid_argument for a workspace of another number of joints
void check_workspace(const Arm& arm, const ForecastOptions& options);

/// `measurement` says what kind the touches are of: with known points the base is known.
TouchModel make_touch_model(const Arm& arm, const Measurement& measurement,
                            const ForecastOptions& options);

/// (columns, 3 N) derivative of the tip by each free column, in m per unit of the column's scale:
/// three columns a pose, one a coordinate.
Eigen::MatrixXd tip_derivatives(const TouchModel& model, const RowMatrix& q, int num_threads);

/// The joint values nearest to those of `q` at which the tip stands on the row's target (3, N).
RowMatrix settled_on(const TouchModel& model, const RowMatrix& q, const Eigen::Matrix3Xd& targets,
                     int num_threads);

/// Where the tip stands, (3, N) in the world.
Eigen::Matrix3Xd tips_of(const TouchModel& model, const RowMatrix& q, int num_threads);

/// Sum of the rows' lengths and the tool's, and not less than a decimetre [m].
double length_of(const Arm& arm);

/// (count, n) poses drawn uniformly within the limits; of joints that turn further, within a whole
/// turn about zero or as near to it as may be; of sliding ones without limits, within the arm's
/// length.
RowMatrix random_poses(const Arm& arm, Index count, std::uint64_t seed);

}  // namespace bathyal
