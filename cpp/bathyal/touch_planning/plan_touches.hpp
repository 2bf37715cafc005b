// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bathyal/touch_planning/forecast.hpp"

namespace bathyal {

/// What a plan optimises.
enum class TouchCriterion {
  kWorstTip,  ///< minimises the worst deviation of the tip over the workspace
  kDOptimal,  ///< maximises the determinant of the information, with priors and known distances
  kO1,        ///< Borm and Menq (1989, 1991): the product of the nonzero singular values
};
std::string_view to_text(TouchCriterion criterion);

/// For each row of (N, n) joint values whether the arm may hold that pose: N results.
using Feasible = std::function<std::vector<bool>(const RowMatrix& q)>;

struct PlanTouchesOptions {
  TouchCriterion criterion = TouchCriterion::kWorstTip;
  /// (3, k) positions of the points, world [m]; no column: `num_points` are chosen where the arm
  /// can reach from many sides, apart from each other.
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd(3, 0);
  int num_points = 3;  ///< 1 to 1 000
  /// Points, by their number 0 … k - 1, whose distance from each other will be measured.
  std::vector<std::pair<int, int>> known_distances;
  double distance_std = 1e-4;     ///< of such a distance [m], above 0
  std::vector<int> known_points;  ///< points whose position in the world will be measured
  double point_std = 1e-4;        ///< of such a position, per axis [m], above 0
  Feasible feasible;              ///< empty: all poses within the limits
  /// Minimum height in the world of all joints and the tip [m].
  std::optional<double> floor;
  int candidates = 600;  ///< poses to choose from, for each point; 2 to 10⁵
  int passes = 10;       ///< maximum number of exchange rounds, 0 to 10⁴
  ForecastOptions forecast;

  /// \throw std::invalid_argument
  void check() const;
};

/// Poses in which to touch.
struct TouchPlan {
  explicit TouchPlan(const Arm& planned_for) : arm(planned_for) {}

  Arm arm;                  ///< for which the plan is
  RowMatrix q;              ///< (N, n) within the limits, point by point, each pose near the last
  std::vector<int> point;   ///< (N,) 0 … k - 1
  Eigen::Matrix3Xd points;  ///< (3, k) world [m]
  std::vector<std::pair<int, int>> known_distances;  ///< as requested
  TouchCriterion criterion = TouchCriterion::kWorstTip;
  double value = 0.0;                 ///< of the criterion: metres, ln det, or O1
  double noise = 0.0;                 ///< assumed [m]
  TouchForecast forecast;             ///< of these touches
  int candidates = 0;                 ///< number of candidate poses, of all points
  std::vector<std::string> warnings;  ///< sentences
};

/// Chooses `count` poses that touch fixed points so that the arm identified from them is accurate
/// over its workspace.
///
/// Candidates are drawn over the whole range of the joints and moved onto each point by the least
/// joint motion, so that they cover every branch of elbow and wrist and every direction of the tool
/// that the limits, `floor` and `feasible` allow. The criterion selects among them: greedily, then
/// by exchange. Priors determine what touches do not, as in `identify_arm`; the tool is that of the
/// arm, which should be given to a centimetre. `feasible` is called in the calling thread, a few
/// times, with many rows. The same bytes for the same seed, for any number of threads.
/// \throw std::invalid_argument for options out of range, count below 2, a point out of reach or
///         one that no feasible pose touches, a `feasible` that returns another number of results.
TouchPlan plan_touches(const Arm& arm, int count, const PlanTouchesOptions& options = {});

/// One paragraph: what to touch, the predicted accuracy of the arm, and, unless the caller reports
/// them elsewhere, every warning.
std::string summarize(const TouchPlan& plan, bool with_warnings = true);

}  // namespace bathyal
