// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/effects/measurements.hpp"
#include "bathyal/identify/model/arm_parameters.hpp"

namespace bathyal {

/// Prior assumptions about an arm and its touches.
struct ForecastOptions {
  Parametrization parametrization = Parametrization::kHayati;
  double nearly_parallel = kNearlyParallel;  ///< sine below which beta replaces d, 0 … 0.5
  double noise = 1e-4;                       ///< std of one touch, per axis [m], above 0
  double length_prior = 1e-3;                ///< std of every a and d about nominal [m], above 0
  double angle_prior = 2e-3;                 ///< of every theta, alpha, beta [rad], above 0
  double tool_prior = 1e-2;                  ///< of each coordinate of the tool's tip [m], above 0
  /// (S, n) poses in which the tip's deviation counts; empty: `workspace_poses` drawn at random.
  RowMatrix workspace;
  int workspace_poses = 400;  ///< 1 to 10⁶
  std::uint64_t seed = 0;
  int num_threads = 0;  ///< 0 = all; the same bytes for any number

  /// \throw std::invalid_argument
  void check() const;
};

/// Predicted result of identifying an arm from touches.
struct TouchForecast {
  RowMatrix workspace;          ///< (S, n) poses for which the deviation is predicted
  std::vector<double> tip_std;  ///< (S,) √trace of the tip's covariance there [m]
  double worst_tip_std = 0.0;   ///< [m]
  double median_tip_std = 0.0;  ///< [m]

  int parameters = 0;                   ///< as many as ArmFit::parameters
  int free = 0;                         ///< of them, those that base and tool cannot represent
  int rank = 0;                         ///< of the data by the free ones, without priors
  Eigen::VectorXd singular_values;      ///< (free,) descending, mm at the tip per mm and mrad
  std::vector<std::string> null_space;  ///< descriptions of the undetermined directions
  std::vector<std::string> null_space_leading;  ///< the parameter of largest share in each of them
  /// Borm and Menq (1989): (Π σ)^(1/r) / √N over the r = rank singular values above zero.
  double o1 = 0.0;
  /// ln det of the free parameters' information, priors included, per mm and mrad.
  double log_det = 0.0;
};

/// The covariance that `identify_arm` will report with these priors, to first order at the nominal
/// arm, and the resulting deviation of the tip over the workspace: in the frame of the base, gauge
/// freedom does not count, the scale of the arm counts, as in `tip_covariance`. Recorded touches
/// that scatter are first moved onto their point.
/// \throw std::invalid_argument for invalid touches or options, another number of joints, several
///         tools or stations, touched planes.
TouchForecast forecast_touches(const Arm& arm, const Touches& touches,
                               const ForecastOptions& options = {});

}  // namespace bathyal
