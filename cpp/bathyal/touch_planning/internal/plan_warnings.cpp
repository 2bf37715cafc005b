// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/touch_planning/internal/plan_warnings.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "bathyal/base/text.hpp"

namespace bathyal {
namespace {

std::string poses(std::size_t count) { return counted(static_cast<long>(count), "pose"); }
std::string points(std::size_t count) { return counted(static_cast<long>(count), "point"); }

std::map<int, int> touches_by_point(const TouchPlan& plan) {
  std::map<int, int> count;
  for (const int point : plan.point) ++count[point];
  return count;
}

bool tells_size(const PlanTouchesOptions& options) {
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
                  " to choose from: few of those that touch the points may be held.");
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
  const std::size_t expected = tells_size(options) ? 0 : 1;
  if (forecast.unseen.size() > expected) {
    std::string text = "These touches cannot tell " +
                       counted(static_cast<long>(forecast.unseen.size()), "combination") +
                       " of the arm's parameters; with the priors stay ";
    for (std::size_t i = 0; i < forecast.unseen.size(); ++i) {
      // A direction's words begin with what leads it.
      text += (i == 0 ? "" : ", ") + forecast.unseen[i].substr(0, forecast.unseen[i].find(" +1"));
    }
    out.push_back(text + ", each with others.");
  }
}

void warn_of_size(const TouchPlan& plan, const PlanTouchesOptions& options,
                  const std::optional<DistanceAdvice>& advice, std::vector<std::string>& out) {
  if (tells_size(options)) return;
  std::string text =
      "Touches alone cannot tell the arm from a smaller one: its size will rest on "
      "the prior of " +
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
                  " only: what is wrong behind it cannot be told from what is wrong before it.");
  }
}

}  // namespace

std::vector<std::string> warnings_of(const Arm& arm, const TouchPlan& plan, int count,
                                     const PlanTouchesOptions& options,
                                     const std::optional<DistanceAdvice>& advice) {
  std::vector<std::string> out;
  warn_of_poses(plan, count, options, out);
  warn_of_unknowns(plan, options, out);
  warn_of_size(plan, options, advice, out);
  warn_of_joints(arm, plan, out);
  if (arm.tool().translation() == Vec3::Zero()) {
    out.push_back(
        "The arm has no tool: the plan touches with the middle of its flange. Set the "
        "tool to a centimetre or so before planning.");
  }
  return out;
}

std::string summarize(const TouchPlan& plan, bool with_warnings) {
  const TouchForecast& forecast = plan.forecast;
  const std::map<int, int> touches = touches_by_point(plan);
  std::string shares;
  for (const auto& [point, count] : touches) {
    shares += (shares.empty() ? "" : " + ") + std::to_string(count);
  }
  std::string text =
      "Touch " + points(touches.size()) + " in " + poses(plan.point.size()) +
      (touches.size() > 1 ? " (" + shares + ")" : "") +
      ", each held still. An arm identified from them is foretold to stray " +
      millimetres(forecast.worst_tip_std) + " at the worst of " + poses(forecast.tip_std.size()) +
      " all over its workspace and " + millimetres(forecast.median_tip_std) +
      " at the median one (one standard deviation, 3-D), where a touch is true to " +
      millimetres(plan.noise) + " per axis. Touches tell " + std::to_string(forecast.rank) +
      " of the " + std::to_string(forecast.free) + " parameters that base and tool leave.";
  if (!with_warnings) return text;
  for (const std::string& warning : plan.warnings) text += " " + warning;
  return text;
}

}  // namespace bathyal
