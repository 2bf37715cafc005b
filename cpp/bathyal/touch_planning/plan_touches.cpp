// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/touch_planning/plan_touches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "bathyal/base/check.hpp"
#include "bathyal/estimation/optimal_design.hpp"
#include "bathyal/estimation/rank.hpp"
#include "bathyal/touch_planning/internal/candidates.hpp"
#include "bathyal/touch_planning/internal/plan_warnings.hpp"
#include "bathyal/touch_planning/internal/tip_model.hpp"

namespace bathyal {

using namespace touch_planning;

namespace {

// Limits of what fits into memory and ends within hours.
constexpr int kMostTouches = 100'000;
constexpr int kMostPoints = 1000;
constexpr int kMostCandidates = 100'000;  ///< for each point
constexpr int kMostPasses = 10'000;

constexpr double kLengthUnit = 1e-3;  ///< of lengths among scaled columns [m]
/// Prior std of a point with an unknown position: vague compared with touches [m].
constexpr double kVague = 1.0;

/// Candidates of all points, stacked.
struct Candidates {
  RowMatrix q;
  std::vector<int> point;
};

/// A measurement without rows that has the kind of the planned touches.
Measurement kind_of(const PlanTouchesOptions& options) {
  Measurement kind;
  for (const int point : options.known_points) kind.known_points.push_back({point, Vec3::Zero()});
  return kind;
}

Candidates gather(const Arm& arm, const TouchModel& model, const Eigen::Matrix3Xd& points,
                  const PlanTouchesOptions& options) {
  Candidates all{RowMatrix(0, arm.size()), {}};
  for (int p = 0; p < static_cast<int>(points.cols()); ++p) {
    const RowMatrix found = poses_on_point(arm, model, points.col(p), p, options);
    RowMatrix joined(all.q.rows() + found.rows(), arm.size());
    joined << all.q, found;
    all.q = std::move(joined);
    all.point.insert(all.point.end(), static_cast<std::size_t>(found.rows()), p);
  }
  return all;
}

/// Information before any touch: priors of the parameters, vague priors of the points, distances
/// and points that will be measured.
Eigen::MatrixXd prior_information(const TouchModel& model, const Eigen::Matrix3Xd& points,
                                  const PlanTouchesOptions& options) {
  const auto columns = static_cast<Index>(model.free.size());
  const Index unknowns = columns + 3 * points.cols();
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(unknowns, std::pow(kLengthUnit / kVague, 2));
  for (Index i = 0; i < columns; ++i) {
    const Parameter& column = model.parameters.parameters[model.free[i]];
    diagonal[i] = std::pow(column.scale / column.prior_std, 2);
  }
  for (const int p : options.known_points) {
    diagonal.segment<3>(columns + 3 * p).array() += std::pow(kLengthUnit / options.point_std, 2);
  }
  Eigen::MatrixXd information = diagonal.asDiagonal();
  for (const auto& [first, second] : options.known_distances) {
    const Vec3 unit = (points.col(second) - points.col(first)).normalized();
    Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns);
    row.segment<3>(columns + 3 * second) = kLengthUnit / options.distance_std * unit;
    row.segment<3>(columns + 3 * first) = -kLengthUnit / options.distance_std * unit;
    information += row * row.transpose();
  }
  return information;
}

OptimalDesign make_design(const TouchModel& model, const Candidates& candidates,
                          const Eigen::Matrix3Xd& points, const RowMatrix& workspace,
                          const PlanTouchesOptions& options) {
  OptimalDesign design;
  const double noise = options.forecast.noise;
  const int threads = options.forecast.num_threads;
  design.touches = tip_derivatives(model, candidates.q, threads) / noise;
  design.point = candidates.point;
  design.points = static_cast<int>(points.cols());
  design.point_weight = kLengthUnit / noise;
  design.prior = prior_information(model, points, options);
  if (options.criterion == TouchCriterion::kWorstTip) {
    design.tips = tip_derivatives(model, workspace, threads);
  }
  return design;
}

/// The same problem for O1: only the parameters that the candidates determine together, without
/// priors.
void drop_priors(OptimalDesign& design) {
  constexpr double kRegularisation = 1e-6;  // of a touch's information: regularises the first ones
  Eigen::MatrixXd rows = design.touches.transpose();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * design.points, rows.cols());
  std::vector<double> count(static_cast<std::size_t>(design.points), 0.0);
  for (std::size_t i = 0; i < design.point.size(); ++i) {
    sum.middleRows<3>(3 * design.point[i]) += rows.middleRows<3>(3 * static_cast<Index>(i));
    count[design.point[i]] += 1.0;
  }
  for (std::size_t i = 0; i < design.point.size(); ++i) {
    const int p = design.point[i];
    rows.middleRows<3>(3 * static_cast<Index>(i)) -= sum.middleRows<3>(3 * p) / count[p];
  }
  const RankReport rank = numerical_rank(rows);
  const Eigen::MatrixXd observable = rank.directions.leftCols(rank.rank);
  design.touches = observable.transpose() * design.touches;
  const Index unknowns = rank.rank + 3 * design.points;
  design.prior = Eigen::MatrixXd::Identity(unknowns, unknowns) * kRegularisation *
                 design.point_weight * design.point_weight;
}

/// Point by point, each pose the nearest of the remaining ones to the previous pose, starting near
/// the middle of the joints: minimises the motion of the arm.
std::vector<int> ordered(const Candidates& candidates, std::vector<int> remaining) {
  std::vector<int> order;
  Eigen::RowVectorXd last = candidates.q.colwise().mean();
  while (!remaining.empty()) {
    const auto far = [&](int touch) {
      return std::make_pair(candidates.point[touch],
                            (candidates.q.row(touch) - last).squaredNorm());
    };
    const auto next = std::min_element(remaining.begin(), remaining.end(),
                                       [&](int a, int b) { return far(a) < far(b); });
    last = candidates.q.row(*next);
    order.push_back(*next);
    remaining.erase(next);
  }
  return order;
}

Touches touches_of(const TouchPlan& plan, const PlanTouchesOptions& options) {
  Touches touches;
  touches.q = plan.q;
  touches.point = plan.point;
  const std::set<int> touched(plan.point.begin(), plan.point.end());
  for (const auto& [first, second] : options.known_distances) {
    if (!touched.contains(first) || !touched.contains(second)) continue;
    touches.known_distances.push_back(
        {first, second, (plan.points.col(first) - plan.points.col(second)).norm()});
  }
  touches.distance_std = options.distance_std;
  for (const int point : options.known_points) {
    if (touched.contains(point)) touches.known_points.push_back({point, plan.points.col(point)});
  }
  touches.point_std = options.point_std;
  return touches;
}

/// The two touched points farthest from each other, and the gain of measuring their distance;
/// nothing where the scale is observed, or one point is touched.
std::optional<DistanceAdvice> distance_advice(const Arm& arm, const TouchPlan& plan,
                                              Touches touches, const ForecastOptions& options) {
  if (!touches.known_distances.empty() || !touches.known_points.empty()) return std::nullopt;
  DistanceAdvice advice;
  double farthest = 0.0;
  const std::set<int> touched(plan.point.begin(), plan.point.end());
  for (const int first : touched) {
    for (const int second : touched) {
      const double apart = (plan.points.col(first) - plan.points.col(second)).norm();
      if (apart <= farthest) continue;
      farthest = apart;
      advice.first = first;
      advice.second = second;
    }
  }
  if (farthest == 0.0) return std::nullopt;
  touches.known_distances = {{advice.first, advice.second, farthest}};
  advice.worst_tip_std = forecast_touches(arm, touches, options).worst_tip_std;
  return advice;
}

double value_of(const TouchPlan& plan) {
  switch (plan.criterion) {
    case TouchCriterion::kWorstTip:
      return plan.forecast.worst_tip_std;
    case TouchCriterion::kDOptimal:
      return plan.forecast.log_det;
    case TouchCriterion::kO1:
      return plan.forecast.o1;
  }
  return 0.0;
}

void check_numbers(std::string_view name, int number, Index points) {
  if (number < 0 || number >= points) {
    throw_argument(name, "numbers of points, 0 … " + std::to_string(points - 1),
                   std::to_string(number));
  }
}

void check_known(const PlanTouchesOptions& options, const Eigen::Matrix3Xd& points) {
  for (const auto& [first, second] : options.known_distances) {
    check_numbers("known_distances", first, points.cols());
    check_numbers("known_distances", second, points.cols());
    if (first == second || points.col(first) == points.col(second)) {
      throw_argument("known_distances", "two points apart",
                     "points " + std::to_string(first) + " and " + std::to_string(second));
    }
  }
  for (const int point : options.known_points) check_numbers("known_points", point, points.cols());
}

}  // namespace

std::string_view to_text(TouchCriterion criterion) {
  switch (criterion) {
    case TouchCriterion::kWorstTip:
      return "worst_tip";
    case TouchCriterion::kDOptimal:
      return "d_optimal";
    case TouchCriterion::kO1:
      return "o1";
  }
  return "";
}

void PlanTouchesOptions::check() const {
  forecast.check();
  if (!points.allFinite()) throw_argument("points", "finite numbers", "nan or inf");
  check_range("num_points", num_points, 1, kMostPoints);
  check_positive("distance_std", distance_std);
  check_positive("point_std", point_std);
  if (floor) check_finite("floor", *floor);
  check_range("candidates", candidates, 2, kMostCandidates);
  check_range("passes", passes, 0, kMostPasses);
}

TouchPlan plan_touches(const Arm& arm, int count, const PlanTouchesOptions& options) {
  options.check();
  if (count < 2) throw_argument("count", "2 or more touches", std::to_string(count));
  check_range("count", count, 2, kMostTouches);
  check_workspace(arm, options.forecast);
  const TouchModel model = make_touch_model(arm, kind_of(options), options.forecast);
  const bool given = options.forecast.workspace.rows() > 0;
  const RowMatrix workspace = given ? options.forecast.workspace : allowed_workspace(arm, options);

  TouchPlan plan(arm);
  plan.criterion = options.criterion;
  plan.known_distances = options.known_distances;
  plan.points =
      options.points.cols() > 0 ? options.points : choose_points(arm, model, workspace, options);
  check_known(options, plan.points);
  const Candidates candidates = gather(arm, model, plan.points, options);
  plan.candidates = static_cast<int>(candidates.point.size());

  OptimalDesign design = make_design(model, candidates, plan.points, workspace, options);
  if (options.criterion == TouchCriterion::kO1) drop_priors(design);
  const std::vector<int> chosen = ordered(
      candidates, exchange_select(design, count, options.passes, options.forecast.num_threads));
  plan.q = candidates.q(chosen, Eigen::all);
  for (const int touch : chosen) plan.point.push_back(candidates.point[touch]);

  ForecastOptions forecast = options.forecast;
  forecast.workspace = workspace;
  const Touches touches = touches_of(plan, options);
  plan.forecast = forecast_touches(arm, touches, forecast);
  plan.value = value_of(plan);
  plan.noise = forecast.noise;
  plan.warnings =
      warnings_of(arm, plan, count, options, distance_advice(arm, plan, touches, forecast));
  return plan;
}

}  // namespace bathyal
