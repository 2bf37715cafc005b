// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "bathyal/effects/effect.hpp"
#include "bathyal/estimation/parameter.hpp"
#include "bathyal/identify/model/calibration_data.hpp"

// The unknowns of an arm as columns; what each does to the tip: tip_walk.hpp. For use inside the
// room.

namespace bathyal {

enum class Parametrization {
  kHayati,  ///< beta in place of d where an axis is nearly parallel to the next one
  kDh,      ///< theta, d, a, alpha in every row
};

/// Which number of the arm a column is.
enum class Part {
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

struct Place {
  Part part = Part::kTheta;
  int index = 0;  ///< joint, tool, station, plane or list of actions
  int axis = 0;   ///< 0, 1, 2 of shifts and turns
};

/// Whether a column belongs to a row of the arm, and whether it is one of the row's lengths.
inline bool is_row(const Place& place) { return place.part <= Part::kBeta; }
inline bool is_length(const Place& place) {
  return place.part == Part::kD || place.part == Part::kA;
}

/// A plane that was touched: normal · (X - center) = offset.
struct PlaneGuess {
  Vec3 normal = Vec3::UnitZ();
  Vec3 center = Vec3::Zero();  ///< among its touches, so that a tilt does not move them far
  double offset = 0.0;
};

/// The two axes about which a plane's columns tilt it.
std::array<Vec3, 2> tilt_axes(const PlaneGuess& plane);

/// An arm with everything about it that may be unknown.
struct ArmColumns {
  Arm arm;                  ///< nominal, with base and tool at identity
  std::vector<Pose> bases;  ///< of each station, world_from_base, at the start
  std::vector<Pose> tools;  ///< of each tool, flange_from_tool, at the start
  std::vector<PlaneGuess> planes;
  std::vector<Column> columns;
  std::vector<Place> places;  ///< of each column
  /// What effects' columns do (effect_columns.hpp), a list for each; their columns stand last.
  /// Copies share them: a number for each row of the data is much.
  std::vector<std::shared_ptr<const std::vector<Action>>> actions = {};

  Eigen::VectorXd nominal() const;
};

struct ColumnChoice {
  Parametrization parametrization = Parametrization::kHayati;
  double nearly_parallel = kNearlyParallel;  ///< sine between axes
  bool free_base = false;                    ///< columns for the base of the first station
};

/// Columns in the order rows, tools, bases, planes. Fixed joints have none: their neighbours' rows
/// say the same. `arm` gives nominal rows; bases, tools and planes are where the search starts.
ArmColumns make_columns(const Arm& arm, const Measurement& measurement, std::vector<Pose> bases,
                        std::vector<Pose> tools, std::vector<PlaneGuess> planes,
                        const ColumnChoice& choice);

/// The arm, bases, tools and planes at the values `x` of all columns.
struct ArmState {
  Arm arm;
  std::vector<Pose> bases;
  std::vector<Pose> tools;
  std::vector<PlaneGuess> planes;
};
ArmState state_at(const ArmColumns& columns, const Eigen::VectorXd& x);

}  // namespace bathyal
