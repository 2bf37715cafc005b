// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "bathyal/effects/effect.hpp"
#include "bathyal/estimation/parameter.hpp"
#include "bathyal/identify/model/calibration_data.hpp"

// The unknown parameters of an arm; their derivatives: chain_derivatives.hpp.

namespace bathyal {

enum class Parametrization {
  kHayati,  ///< beta in place of d where an axis is nearly parallel to the next one
  kDh,      ///< theta, d, a, alpha in every row
};

/// What a parameter changes.
enum class ParameterKind {
  kTheta,
  kD,
  kA,
  kAlpha,
  kBeta,
  kToolShift,
  kToolTurn,
  kBaseShift,
  kBaseTurn,
  kPlaneTurn,
  kPlaneShift,
  kEffect
};

struct ParameterSlot {
  ParameterKind kind = ParameterKind::kTheta;
  int index = 0;  ///< joint, tool, station, plane or list of perturbations
  int axis = 0;   ///< 0, 1, 2 of shifts and turns
};

/// Whether a parameter belongs to a row of the arm, and whether it is one of its lengths.
inline bool is_row(const ParameterSlot& place) { return place.kind <= ParameterKind::kBeta; }
inline bool is_length(const ParameterSlot& place) {
  return place.kind == ParameterKind::kD || place.kind == ParameterKind::kA;
}

/// Estimate of a touched plane: normal · (X - center) = offset.
struct PlaneGuess {
  Vec3 normal = Vec3::UnitZ();
  Vec3 center = Vec3::Zero();  ///< near its touches, so that a tilt does not move them far
  double offset = 0.0;
};

/// The two axes of rotation of the tilt parameters of a plane.
std::array<Vec3, 2> tilt_axes(const PlaneGuess& plane);

/// An arm with all its unknown parameters.
struct ArmParameters {
  Arm arm;                  ///< nominal, with base and tool at identity
  std::vector<Pose> bases;  ///< of each station, world_from_base, at the start
  std::vector<Pose> tools;  ///< of each tool, flange_from_tool, at the start
  std::vector<PlaneGuess> planes;
  std::vector<Parameter> parameters;
  std::vector<ParameterSlot> slots;  ///< of each parameter
  /// Perturbations of the effect parameters (effect_parameters.hpp), a list for each; these are the
  /// last parameters. Copies share them, as each holds numbers for every row of the data.
  std::vector<std::shared_ptr<const std::vector<Perturbation>>> perturbations = {};

  Eigen::VectorXd nominal() const;
};

struct ParameterChoice {
  Parametrization parametrization = Parametrization::kHayati;
  double nearly_parallel = kNearlyParallel;  ///< sine between axes
  bool free_base = false;                    ///< parameters for the base of the first station
};

/// Parameters in the order rows, tools, bases, planes. Fixed joints have none: those of
/// neighbouring rows are equivalent. `arm` gives nominal rows; bases, tools and planes are the
/// starting point of the search.
ArmParameters make_parameters(const Arm& arm, const Measurement& measurement,
                              std::vector<Pose> bases, std::vector<Pose> tools,
                              std::vector<PlaneGuess> planes, const ParameterChoice& choice);

/// The arm, bases, tools and planes at the values `x` of all parameters.
struct ArmState {
  Arm arm;
  std::vector<Pose> bases;
  std::vector<Pose> tools;
  std::vector<PlaneGuess> planes;
};
ArmState state_at(const ArmParameters& parameters, const Eigen::VectorXd& x);

}  // namespace bathyal
