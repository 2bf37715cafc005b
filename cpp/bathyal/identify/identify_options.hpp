// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bathyal/estimation/least_squares.hpp"
#include "bathyal/identify/model/arm_parameters.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

namespace bathyal {

enum class Loss { kSquare, kHuber, kCauchy };
enum class ToolStart { kAuto, kArm, kEstimate };
enum class BaseChoice { kAuto, kFree, kFixed };

struct IdentifyOptions {
  Parametrization parametrization = Parametrization::kHayati;
  double nearly_parallel = kNearlyParallel;  ///< sine below which beta replaces d, 0 … 0.5
  Criterion criterion = Criterion::kCentroid;
  /// Weighs a point by the number of its touches, as the sum over pairs does: the centroid form
  /// then costs what kPairs costs. kPairs always does.
  bool pair_weights = false;
  Solver solver = Solver::kLevenbergMarquardt;
  int max_iterations = 100;  ///< of one search, 1 or more
  /// kAuto: the tool of the arm where it has one, else an estimate (eq 12-16).
  ToolStart tool_start = ToolStart::kAuto;
  /// kAuto: free for tracked poses, fixed for touches.
  BaseChoice base = BaseChoice::kAuto;
  std::vector<std::string> fixed = {};  ///< names of parameters fixed at nominal

  std::optional<double> length_prior =
      {};  ///< std of every a and d about its nominal value [m], above 0
  std::optional<double> angle_prior = {};     ///< of every theta, alpha, beta [rad], above 0
  std::map<std::string, double> priors = {};  ///< by parameter's name, in its unit, above 0
  /// The length prior where the data do not determine the scale and none is given [m].
  double size_prior = 1e-3;

  std::optional<double> noise =
      {};  ///< known std of a touch or position, per axis [m]; else estimated
  std::optional<double> rotation_noise = {};  ///< of a measured rotation, per axis [rad]
  Loss loss = Loss::kSquare;
  std::optional<double> loss_width = {};   ///< [m], above 0; else 3 × the robust std of a residual
  std::optional<double> prune_sigma = {};  ///< resets parameters within so many std to nominal
  int num_threads = 0;                     ///< 0 = all; the same bytes for any number

  void check() const;
};

}  // namespace bathyal
