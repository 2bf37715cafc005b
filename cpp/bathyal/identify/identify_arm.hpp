// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bathyal/effects/measurements.hpp"
#include "bathyal/identify/fit/arm_fit.hpp"

namespace bathyal {

class CorrectedArm;

enum class Loss { kSquare, kHuber, kCauchy };
enum class ToolStart { kAuto, kArm, kEstimate };
enum class BaseChoice { kAuto, kFree, kFixed };

struct IdentifyOptions {
  Parametrization parametrization = Parametrization::kHayati;
  double nearly_parallel =
      kNearlyParallel;  ///< sine below which beta takes the place of d, 0 … 0.5
  Criterion criterion = Criterion::kCentroid;
  /// Weighs a point by the number of its touches, as the sum over pairs does: the centroid form
  /// then costs what kPairs costs. kPairs always does.
  bool pair_weights = false;
  Solver solver = Solver::kLevenbergMarquardt;
  int max_iterations = 100;  ///< of one search, 1 or more
  /// kAuto takes the arm's tool where it has one, else estimates it (eq 12-16).
  ToolStart tool_start = ToolStart::kAuto;
  /// kAuto: free for tracked poses, fixed for touches.
  BaseChoice base = BaseChoice::kAuto;
  std::vector<std::string> fixed = {};  ///< names of parameters to hold at nominal

  std::optional<double> length_prior =
      {};  ///< std of every a and d about its nominal value [m], above 0
  std::optional<double> angle_prior = {};     ///< of every theta, alpha, beta [rad], above 0
  std::map<std::string, double> priors = {};  ///< by parameter's name, in its unit, above 0
  /// The length prior that stands in where nothing tells the arm's size and none is given [m].
  double size_prior = 1e-3;

  std::optional<double> noise =
      {};  ///< known std of a touch or position, per axis [m]; else estimated
  std::optional<double> rotation_noise = {};  ///< of a measured rotation, per axis [rad]
  Loss loss = Loss::kSquare;
  std::optional<double> loss_width = {};   ///< [m], above 0; else 3 × the robust std of a residual
  std::optional<double> prune_sigma = {};  ///< puts parameters within so many std back to nominal
  int num_threads = 0;                     ///< 0 = all; the same bytes for any number

  void check() const;
};

/// Finds the true geometry of an arm (Yukhimets, Gubankov 2023).
///
/// Unknown are each moving joint's row (Hayati and Mirmirani's beta in place of d where the next
/// axis is nearly parallel), the tool and, for tracked poses, the base. What base and tool can do
/// as well is held at nominal (`Status::kGauge`). Touches of one point need only agree; an arm that
/// shrinks would make them, so that their sum of squares says nothing of the arm's size: known
/// distances or points or a joint that slides tell it, or a prior on the lengths holds it, and
/// `scale_source` says which. Scatter is recorded in joint values and a smaller arm shows less of
/// it: the least sum of squares lies at an arm too small by (degrees of freedom) · (relative std of
/// the size)². A told size is freed of that by steps along the derivatives of exact touches, which
/// leave the sum a little above its least. Where a prior holds the size, the sum alone decides, as
/// in the paper, and a loose prior lets the arm shrink.
///
/// Directions that the data do not see stay at nominal. Noise is estimated from the residuals with
/// 3 Σ(m_i - 1) - rank degrees of freedom and sets the weight of what is known beside the touches.
/// Rank and standard deviations are those of exact touches: each pose is first moved by the least
/// joint motion that brings its tip onto its point, for scatter would pass for information about
/// the arm's size.
///
/// \throw std::invalid_argument for bad data or options, or another number of joints.
ArmFit identify_arm(const Arm& arm, const Touches& touches, const IdentifyOptions& options = {});
ArmFit identify_arm(const Arm& arm, const Tracked& tracked, const IdentifyOptions& options = {});

/// The same of an arm with effects inside: they act as they were found, each in the rows where it
/// counts (CorrectedArm::in_support, by the data's covariates), while the geometry is sought anew.
/// Their values stand among the parameters, held. The fit's arm is the rigid part alone.
/// \throw std::invalid_argument also for covariates as CorrectedArm::forward
ArmFit identify_arm(const CorrectedArm& model, const Touches& touches,
                    const IdentifyOptions& options = {});
ArmFit identify_arm(const CorrectedArm& model, const Tracked& tracked,
                    const IdentifyOptions& options = {});

}  // namespace bathyal
