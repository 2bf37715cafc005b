// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/estimation/rank.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

namespace bathyal {

/// Status of a parameter after the fit.
enum class Status {
  kIdentified,       ///< determined by the data
  kGauge,            ///< redundant, fixed at nominal: base or tool can represent it
  kPrior,            ///< determined by a prior, not by the data
  kNotIdentifiable,  ///< determined by neither; at, or near, its nominal value
  kFixed,            ///< fixed at nominal by the caller
  kPruned,           ///< within so many sigma of nominal, and reset to it
};
std::string_view to_text(Status status);

struct FitParameter {
  std::string name;         ///< "theta_3"
  std::string description;  ///< "theta of row 3"
  std::string unit;         ///< "m" or "rad"
  std::string group;        ///< "row 3", "tool", "base"
  double nominal = 0.0;     ///< of a tool or a base: where the search started
  double value = 0.0;
  double std = 0.0;  ///< 0 when fixed, infinite when not identifiable
  Status status = Status::kIdentified;
  std::vector<NullSpacePartner> partners;  ///< of an unobservable change; empty when identified
};

/// A touch, or a tracked pose, that contradicts the others.
struct Outlier {
  int row = 0;
  int label = 0;          ///< of its point; -1 of a tracked pose or a plane's row
  double distance = 0.0;  ///< from its expected position [m]
  /// Label of the point that it agrees with, if any: labels were probably swapped.
  std::optional<int> fits;
};

/// A known distance and its estimate.
struct DistanceComparison {
  int first = 0;  ///< labels
  int second = 0;
  double given = 0.0;      ///< [m]
  double estimated = 0.0;  ///< [m]
};

/// Result of identify_arm: the arm with its uncertainty.
struct ArmFit {
  explicit ArmFit(const Arm& nominal) : arm(nominal), arm_parameters{nominal, {}, {}, {}, {}, {}} {}

  Arm arm;                  ///< with the base of station 0 and tool 0 set
  std::vector<Pose> bases;  ///< world_from_base of each station
  std::vector<Pose> tools;  ///< flange_from_tool of each tool
  std::vector<FitParameter> parameters;
  Eigen::MatrixXd
      covariance;  ///< of all parameters in their units; unobservable directions count 0

  double rms_before = 0.0;  ///< nominal rows, start's tool and base: √mean‖e‖² [m]
  double rms_after = 0.0;   ///< [m]
  /// `rms_after` times given by estimated lengths: its value at the true scale [m].
  double rms_after_scaled = 0.0;
  std::vector<double> point_rms_before;  ///< of each point [m]; of each station when tracked
  std::vector<double> point_rms_after;
  double rotation_rms_before = 0.0;  ///< of tracked poses with a rotation [rad]
  double rotation_rms_after = 0.0;
  double pairs_before = 0.0;  ///< J of Yukhimets, Gubankov 2023, eq 7 [m²]; 0 when tracked
  double pairs_after = 0.0;

  std::vector<double> history;  ///< sum of squares [m²] at the start and after each step
  int iterations = 0;           ///< accepted steps
  bool converged = false;

  int rank = 0;                         ///< of the data by all parameters, without priors
  Eigen::VectorXd singular_values;      ///< per mm and mrad, in units of position noise 1 mm
  std::vector<std::string> null_space;  ///< descriptions of the unobservable directions
  double noise = 0.0;                   ///< estimated or given standard deviation, per axis [m]
  double rotation_noise = 0.0;          ///< [rad]
  double degrees_of_freedom = 0.0;      ///< position rows minus those of points and parameters

  std::string scale_source;  ///< what determines the scale of the arm
  double scale = 1.0;        ///< estimated by nominal lengths, in the least-squares sense
  double scale_std = 0.0;    ///< relative standard deviation of the scale

  std::vector<int> point_labels;  ///< of the touched points
  Eigen::Matrix3Xd points;        ///< their estimated positions, world (3, n) [m]
  std::vector<DistanceComparison> distances;
  Eigen::Matrix3Xd residuals;         ///< (3, N) tip minus centroid, or minus measured [m]
  Eigen::Matrix3Xd residuals_before;  ///< the same for `rms_before` [m]
  std::vector<Outlier> outliers;
  std::vector<std::string> warnings;  ///< sentences
  /// Probability that residuals without structure would depend on the joints as much as these do; 1
  /// when it was not tested.
  double structure_p = 1.0;

  /// Inputs of tip_covariance.
  ArmParameters arm_parameters;
  Eigen::VectorXd values;        ///< of all parameters
  Eigen::MatrixXd undetermined;  ///< (P, k) changes that neither data nor priors hold
};

/// Covariance (N) of the tip predicted by `fit.arm` at each row of `q`, in the frame of its base,
/// [m²]: gauge freedom does not count, the scale of the arm counts. Where an undetermined direction
/// moves the tip, the diagonal is infinite.
/// \throw std::invalid_argument for another number of joints, or numbers that are not finite
std::vector<Eigen::Matrix3d> tip_covariance(const ArmFit& fit, const RowMatrix& q,
                                            int num_threads = 0);

}  // namespace bathyal
