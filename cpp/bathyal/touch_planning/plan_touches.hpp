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

/// What a plan makes as good as it can.
enum class TouchCriterion {
  kWorstTip,  ///< the worst deviation of the tip over the workspace falls
  kDOptimal,  ///< the determinant of the information grows, priors and known distances included
  kO1,        ///< Borm and Menq (1989, 1991): the product of the singular values that are not zero
};
std::string_view to_text(TouchCriterion criterion);

/// For each row of (N, n) joint values whether the arm may be held so: N answers.
using Feasible = std::function<std::vector<bool>(const RowMatrix& q)>;

struct PlanTouchesOptions {
  TouchCriterion criterion = TouchCriterion::kWorstTip;
  /// (3, k) where the points stand, world [m]; no column: `num_points` are chosen where the arm
  /// can reach from many sides, apart from each other.
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd(3, 0);
  int num_points = 3;  ///< 1 to 1 000
  /// Points, by their number 0 … k - 1, whose distance from each other will be told.
  std::vector<std::pair<int, int>> known_distances;
  double distance_std = 1e-4;     ///< of such a distance [m], above 0
  std::vector<int> known_points;  ///< numbers of points whose place in the world will be told
  double point_std = 1e-4;        ///< of such a place, per axis [m], above 0
  Feasible feasible;              ///< empty: all poses within the limits
  /// Height in the world that no joint and no tip may go below [m].
  std::optional<double> floor;
  int candidates = 600;  ///< poses to choose from, for each point; 2 to 10⁵
  int passes = 10;       ///< at most so many rounds of exchange, 0 to 10⁴
  ForecastOptions forecast;

  /// \throw std::invalid_argument
  void check() const;
};

/// Poses in which to touch.
struct TouchPlan {
  explicit TouchPlan(const Arm& planned_for) : arm(planned_for) {}

  Arm arm;                  ///< that was planned for
  RowMatrix q;              ///< (N, n) within the limits, point by point, each pose near the last
  std::vector<int> point;   ///< (N,) 0 … k - 1
  Eigen::Matrix3Xd points;  ///< (3, k) world [m]
  std::vector<std::pair<int, int>> known_distances;  ///< as asked for
  TouchCriterion criterion = TouchCriterion::kWorstTip;
  double value = 0.0;                 ///< of the criterion: metres, ln det, or O1
  double noise = 0.0;                 ///< that was reckoned with [m]
  TouchForecast forecast;             ///< of these touches
  int candidates = 0;                 ///< poses that were chosen from, of all points
  std::vector<std::string> warnings;  ///< sentences
};

/// Chooses `count` poses that touch fixed points such that the arm that `identify_arm` finds from
/// them goes right wherever it goes.
///
/// Candidates are poses drawn over all of the joints' range and brought onto each point by the
/// least joint motion, so that they hold every branch of elbow and wrist and the tool in every
/// direction that the limits, `floor` and `feasible` leave. Of these the criterion chooses:
/// greedily, then by exchange. Priors hold what touches never tell, as they do in `identify_arm`;
/// the tool is that of the arm, which should be told to a centimetre. `feasible` is called in the
/// calling thread, a few times, with many rows. The same bytes for the same seed, whatever the
/// number of threads.
/// \throw std::invalid_argument for options out of range, count below 2, a point out of reach or
///        one that nothing feasible touches, a `feasible` that gives another number of answers.
TouchPlan plan_touches(const Arm& arm, int count, const PlanTouchesOptions& options = {});

/// One paragraph in plain words: what to touch, how right the arm will go afterwards, and, unless
/// they are told elsewhere, every warning.
std::string summarize(const TouchPlan& plan, bool with_warnings = true);

}  // namespace bathyal
