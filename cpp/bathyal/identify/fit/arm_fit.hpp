// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/estimation/rank.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

namespace bathyal {

/// What became of an unknown.
enum class Status {
  kIdentified,       ///< the data tell it
  kGauge,            ///< held at nominal: base or tool can do all that it could do
  kPrior,            ///< the data do not tell it, a prior does
  kNotIdentifiable,  ///< neither tells it; it stands at, or near, its nominal value
  kFixed,            ///< held at nominal by the caller
  kPruned,           ///< was within so many sigma of nominal, and put back there
};
std::string_view to_text(Status status);

struct FitParameter {
  std::string name;      ///< "theta_3"
  std::string words;     ///< "theta of row 3"
  std::string unit;      ///< "m" or "rad"
  std::string group;     ///< "row 3", "tool", "base"
  double nominal = 0.0;  ///< of a tool or a base: where the search started
  double value = 0.0;
  double std = 0.0;  ///< 0 when held, infinite when not identifiable
  Status status = Status::kIdentified;
  std::vector<Trade> trades;  ///< what it moves with unseen; empty when identified
};

/// A touch, or a tracked pose, that lies far from where the others want it.
struct Outlier {
  int row = 0;
  int label = 0;          ///< of its point; -1 of a tracked pose or a plane's row
  double distance = 0.0;  ///< from where it should be [m]
  /// Label of the point where it would fit, when there is one: then the labels look swapped.
  std::optional<int> fits;
};

/// A known distance beside the one found.
struct FoundDistance {
  int first = 0;  ///< labels
  int second = 0;
  double told = 0.0;   ///< [m]
  double found = 0.0;  ///< [m]
};

/// The arm found by identify_arm and how far to trust it.
struct ArmFit {
  explicit ArmFit(const Arm& nominal) : arm(nominal), columns{nominal, {}, {}, {}, {}, {}} {}

  Arm arm;                  ///< with the base of station 0 and tool 0 set
  std::vector<Pose> bases;  ///< world_from_base of each station
  std::vector<Pose> tools;  ///< flange_from_tool of each tool
  std::vector<FitParameter> parameters;
  Eigen::MatrixXd covariance;  ///< of all parameters in their units; what is not seen counts 0

  double rms_before = 0.0;  ///< nominal rows, start's tool and base: √mean‖e‖² [m]
  double rms_after = 0.0;   ///< [m]
  /// `rms_after` times told by found lengths: what it would be had the arm kept its size [m].
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

  int rank = 0;                     ///< of the data by all columns, without priors
  Eigen::VectorXd singular_values;  ///< per mm and mrad, in units of position noise 1 mm
  std::vector<std::string> unseen;  ///< the null directions in words
  double noise = 0.0;               ///< found or told standard deviation, per axis [m]
  double rotation_noise = 0.0;      ///< [rad]
  double degrees_of_freedom = 0.0;  ///< position rows less what points and columns take

  std::string scale_source;  ///< what the arm's size rests on
  double scale = 1.0;        ///< lengths found by nominal lengths, in the least-squares sense
  double scale_std = 0.0;    ///< relative standard deviation of the arm's size

  std::vector<int> point_labels;  ///< of the touched points
  Eigen::Matrix3Xd points;        ///< where they were found, world (3, n) [m]
  std::vector<FoundDistance> distances;
  Eigen::Matrix3Xd residuals;         ///< (3, N) tip minus centroid, or minus measured [m]
  Eigen::Matrix3Xd residuals_before;  ///< the same of what `rms_before` tells [m]
  std::vector<Outlier> outliers;
  std::vector<std::string> warnings;  ///< sentences
  /// Probability that residuals without structure would depend on the joints as much as these do;
  /// 1 when it cannot be asked.
  double structure_p = 1.0;

  /// What tip_covariance needs.
  ArmColumns columns;
  Eigen::VectorXd values;  ///< of all columns
  Eigen::MatrixXd blind;   ///< (P, k) changes that neither data nor priors hold
};

/// Covariance (N) of the tip that `fit.arm` foretells at each row of `q`, in the frame of its base,
/// [m²]: gauge counts nothing, the arm's size counts. Where something that nobody could tell moves
/// the tip, the diagonal is infinite.
/// \throw std::invalid_argument for another number of joints, or numbers that are not finite
std::vector<Eigen::Matrix3d> tip_covariance(const ArmFit& fit, const RowMatrix& q,
                                            int num_threads = 0);

}  // namespace bathyal
