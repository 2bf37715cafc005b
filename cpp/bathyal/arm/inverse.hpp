// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bathyal/arm/kinematics.hpp"

namespace bathyal {

/// What of the tool's pose must meet the target.
enum class InverseTask {
  kPose,
  kPosition,      ///< the tool centre point alone
  kPositionAxis,  ///< and one axis of the tool; the turn about it is free
};

enum class InverseMethod {
  /// Levenberg-Marquardt with damping in proportion to the squared error (Sugihara 2011), joints at
  /// their limits held by an active set, several starts.
  kDampedLeastSquares,
  /// Equal steps along the straight line to the target, each by the pseudo-inverse of the Jacobian
  /// (Maevskiy, Zanin 2020), without damping, limits or second start: to compare with.
  kPseudoInverse,
};

enum class InverseStatus {
  kReached,
  kLimit,       ///< reached by no start within the limits, and by one without them
  kSingular,    ///< no start comes through, though the pose lies within the limits: the search is
                ///< stuck
  kOutOfReach,  ///< no start comes to the target, with limits or without
};

std::string_view to_text(InverseStatus status);

struct InverseOptions {
  InverseTask task = InverseTask::kPose;
  InverseMethod method = InverseMethod::kDampedLeastSquares;
  Vec3 axis = Vec3::UnitZ();  ///< of kPositionAxis, in the tool's frame; any length but zero
  /// [m] above 0; when nothing is said 1e-6, and 1e-2 for kPseudoInverse as in the paper.
  std::optional<double> position_tolerance = std::nullopt;
  std::optional<double> angle_tolerance =
      std::nullopt;         ///< [rad] above 0; when nothing is said as many as above
  int max_iterations = 60;  ///< of one start, 1 to 10⁶
  int max_starts = 64;      ///< 1 to 10⁶; the given one is the first
  int candidates = 1;       ///< the search goes on until so many starts have reached, 1 to 10⁶
  /// Steps that a redundant arm takes towards the middle of its limits once it has reached, 0 to
  /// 10⁶; when nothing is said 0 from a given start, which it would leave, else 10.
  std::optional<int> centering_steps = std::nullopt;
  int steps = 100;         ///< of kPseudoInverse along the line, 1 to 10⁶
  std::uint64_t seed = 0;  ///< of the starts
  int num_threads = 0;

  /// \throw std::invalid_argument
  void check() const;
};

struct InverseResult {
  /// (N, n), within the limits, but by kPseudoInverse; where nothing was reached, the nearest
  /// found.
  JointMatrix q;
  std::vector<InverseStatus> status;
  /// Left of position and angle together, a radian weighing a fifth of the lengths of the arm [m].
  std::vector<double> error;
  std::vector<double> position_error;  ///< left at q [m]
  std::vector<double> angle_error;     ///< left at q [rad]; 0 for kPosition
  std::vector<int> iterations;         ///< over all starts
  std::vector<int> starts;             ///< that were tried
};

/// Coordinates q that bring the tool to world_from_tool targets, (N, 4, 4) row-major.
///
/// `starts` has no row, one for all targets, or one a target. A target is tried from its start,
/// then from poses drawn within the limits (joints without limits: within half a turn of zero;
/// sliding ones: within the arm's length), those first whose tool lies nearest to the target. Of
/// several candidates that reach, the one nearest to the start (without one: to the middle of the
/// limits) is taken. Turning joints whose limits allow a whole turn come out as near to the start
/// as whole turns bring them. The result of a target does not depend on the others.
/// \throw std::invalid_argument for targets that are not rigid or not finite, starts of another
///        shape or beyond the limits (the row is named), options out of range.
InverseResult inverse(const Arm& arm, std::span<const double> targets, JointView starts,
                      const InverseOptions& options = {});

}  // namespace bathyal
