// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/touch_planning/internal/plan_warnings.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "bathyal/base/text.hpp"

namespace bathyal::touch_planning {
namespace {

std::string poses(std::size_t count) { return counted(static_cast<long>(count), "pose"); }
std::string points(std::size_t count) { return counted(static_cast<long>(count), "point"); }

std::map<int, int> touches_by_point(const TouchPlan& plan) {
  std::map<int, int> count;
  for (const int point : plan.point) ++count[point];
  return count;
}

bool scale_is_given(const PlanTouchesOptions& options) {
  return !options.known_distances.empty() || !options.known_points.empty();
}

void warn_of_poses(const TouchPlan& plan, int count, const PlanTouchesOptions& options,
                   std::vector<std::string>& out) {
  const auto placed = static_cast<std::size_t>(plan.points.cols());
  const std::size_t touched = touches_by_point(plan).size();
  if (options.points.cols() == 0 && placed < static_cast<std::size_t>(options.num_points)) {
    out.push_back("Only " + points(placed) + " apart from each other could be found.");
  }
  if (plan.point.size() < static_cast<std::size_t>(count)) {
    out.push_back("Only " + poses(plan.point.size()) +
                  " that may be held were found: the plan has so many, not " +
                  std::to_string(count) + ". More points would give more.");
  } else if (static_cast<std::size_t>(plan.candidates) <
             static_cast<std::size_t>(options.candidates) * placed) {
    out.push_back("There were only " + poses(static_cast<std::size_t>(plan.candidates)) +
                  " to choose from: few of the poses that touch the points are feasible.");
  }
  if (touched < placed) {
    out.push_back(std::to_string(count) + " touches are too few for two of each of " +
                  points(placed) + ": only " + points(touched) + " will be touched.");
  }
}

void warn_of_unknowns(const TouchPlan& plan, const PlanTouchesOptions& options,
                      std::vector<std::string>& out) {
  const TouchForecast& forecast = plan.forecast;
  const std::size_t touched = touches_by_point(plan).size();
  const std::size_t numbers = 3 * (plan.point.size() - touched);
  if (numbers < static_cast<std::size_t>(forecast.free)) {
    out.push_back(std::to_string(plan.point.size()) + " touches of " + points(touched) + " give " +
                  std::to_string(numbers) + " numbers for " + std::to_string(forecast.free) +
                  " unknowns: more touches are needed.");
  }
  const std::size_t expected = scale_is_given(options) ? 0 : 1;
  if (forecast.null_space.size() > expected) {
    std::string text = "These touches do not determine " +
                       counted(static_cast<long>(forecast.null_space.size()), "combination") +
                       " of the arm's parameters; the priors determine ";
    for (std::size_t i = 0; i < forecast.null_space_leading.size(); ++i) {
      text += (i == 0 ? "" : ", ") + forecast.null_space_leading[i];
    }
    out.push_back(text + ", each together with others.");
  }
}

void warn_of_scale(const TouchPlan& plan, const PlanTouchesOptions& options,
                   const std::optional<DistanceAdvice>& advice, std::vector<std::string>& out) {
  if (scale_is_given(options)) return;
  std::string text =
      "Touches alone do not determine the scale of the arm: it will be determined by the "
      "prior of " +
      millimetres(options.forecast.length_prior) + " on its lengths.";
  if (advice) {
    const double apart = (plan.points.col(advice->first) - plan.points.col(advice->second)).norm();
    text += " Measure the distance between points " + std::to_string(advice->first) + " and " +
            std::to_string(advice->second) + " (" + three_digits(apart) + " m" + ") to " +
            millimetres(options.distance_std) + ", and the worst deviation falls from " +
            millimetres(plan.forecast.worst_tip_std) + " to " + millimetres(advice->worst_tip_std) +
            ".";
  }
  out.push_back(text);
}

void warn_of_joints(const Arm& arm, const TouchPlan& plan, std::vector<std::string>& out) {
  constexpr double kLittleTurn = 10.0 * std::numbers::pi / 180.0;
  constexpr double kLittleSlide = 0.01;  // [m]
  for (const Joint& joint : arm.joints()) {
    if (joint.type == JointType::kFixed || !joint.follows.empty()) continue;
    const auto values = plan.q.col(joint.coordinate);
    const double range = values.maxCoeff() - values.minCoeff();
    const bool slides = joint.type == JointType::kPrismatic;
    if (range > (slides ? kLittleSlide : kLittleTurn)) continue;
    const std::string moved = in_its_unit(range, slides ? "m" : "rad");
    out.push_back("Joint " + std::to_string(joint.coordinate + 1) +
                  (joint.name.empty() ? "" : " (" + joint.name + ")") + " moves by " + moved +
                  " only: errors behind it cannot be distinguished from errors before it.");
  }
}

}  // namespace

std::vector<std::string> warnings_of(const Arm& arm, const TouchPlan& plan, int count,
                                     const PlanTouchesOptions& options,
                                     const std::optional<DistanceAdvice>& advice) {
  std::vector<std::string> out;
  warn_of_poses(plan, count, options, out);
  warn_of_unknowns(plan, options, out);
  warn_of_scale(plan, options, advice, out);
  warn_of_joints(arm, plan, out);
  if (arm.tool().translation() == Vec3::Zero()) {
    out.push_back(
        "The arm has no tool: the plan touches with the middle of its flange. Set the "
        "tool to a centimetre or so before planning.");
  }
  return out;
}

}  // namespace bathyal::touch_planning

namespace bathyal {

std::string summarize(const TouchPlan& plan, bool with_warnings) {
  using namespace touch_planning;
  const TouchForecast& forecast = plan.forecast;
  const std::map<int, int> touches = touches_by_point(plan);
  std::string shares;
  for (const auto& [point, count] : touches) {
    shares += (shares.empty() ? "" : " + ") + std::to_string(count);
  }
  std::string text =
      "Touch " + points(touches.size()) + " in " + poses(plan.point.size()) +
      (touches.size() > 1 ? " (" + shares + ")" : "") +
      ", each held still. The predicted deviation of an arm identified from them is " +
      millimetres(forecast.worst_tip_std) + " at the worst of " + poses(forecast.tip_std.size()) +
      " over its workspace and " + millimetres(forecast.median_tip_std) +
      " at the median one (one standard deviation, 3-D), for touches accurate to " +
      millimetres(plan.noise) + " per axis. The touches determine " +
      std::to_string(forecast.rank) + " of the " + std::to_string(forecast.free) +
      " parameters that base and tool do not represent.";
  if (!with_warnings) return text;
  for (const std::string& warning : plan.warnings) text += " " + warning;
  return text;
}

}  // namespace bathyal
