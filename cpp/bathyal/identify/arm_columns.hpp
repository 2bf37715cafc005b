// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/identify/column.hpp"
#include "bathyal/identify/measurement.hpp"

// The unknowns of an arm as columns, and what each does to the tip. For use inside the room.

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
  kPlaneShift
};

struct Place {
  Part part = Part::kTheta;
  int index = 0;  ///< joint, tool, station or plane
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

/// An arm with everything about it that may be unknown.
struct ArmColumns {
  Arm arm;                  ///< nominal, with base and tool at identity
  std::vector<Pose> bases;  ///< of each station, world_from_base, at the start
  std::vector<Pose> tools;  ///< of each tool, flange_from_tool, at the start
  std::vector<PlaneGuess> planes;
  std::vector<Column> columns;
  std::vector<Place> places;  ///< of each column

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

/// The tip at each pose of a measurement and how it moves with each of `wanted` columns.
class TipWalk {
 public:
  /// `columns` must outlive it.
  TipWalk(const ArmColumns& columns, const Eigen::VectorXd& x, std::vector<int> wanted);

  const ArmState& state() const { return state_; }

  /// One pose; world_from_tool. `shift` and `turn` are (3, wanted), column after column with
  /// `stride` between them: d tip / d column, and the axis about which the tool turns per unit of
  /// the column; each may be null. `frames` is scratch.
  Pose tip(const double* q, int tool, int station, RowFrames& frames, double* shift, double* turn,
           Index stride) const;

  /// The axis about which the i-th wanted column, a plane's tilt, turns that plane's normal.
  Vec3 plane_turn(std::size_t i) const { return turn_axes_[i]; }

  /// d tip / d q, (3, n), and the tip.
  Eigen::Matrix3Xd joint_jacobian(const double* q, int tool, int station, RowFrames& frames,
                                  Vec3& tip) const;

 private:
  /// A row as Rz(value) or Tz(value), then what does not change from pose to pose.
  struct Step {
    Pose behind_from_moved;
    Vec3 x_of_row;  ///< x before the row's last turn, Ry(beta), in the frame behind it
  };
  void walk(const double* q, int station, RowFrames& frames) const;

  const ArmColumns& columns_;
  std::vector<int> wanted_;
  ArmState state_;
  std::vector<Step> steps_;
  std::vector<Pose> row_from_tool_;  ///< of each tool, from the frame behind the last row
  std::vector<Vec3> turn_axes_;      ///< of each wanted turn, in the frame that it turns in
};

}  // namespace bathyal
