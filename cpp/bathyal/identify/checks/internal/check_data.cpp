// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/base/text.hpp"
#include "bathyal/identify/checks/internal/checks.hpp"

namespace bathyal::identify {

std::string joint_label(const Arm& arm, Index coordinate) {
  for (const Joint& joint : arm.joints()) {
    if (joint.coordinate != coordinate || joint.type == JointType::kFixed) continue;
    const std::string number = "joint " + std::to_string(coordinate + 1);
    return joint.name.empty() ? number : number + " (" + joint.name + ")";
  }
  return "no joint";
}

namespace {

using Warnings = std::vector<std::string>;

/// "deg" of a joint that turns, else "mm".
std::string joint_amount(const Arm& arm, Index coordinate, double amount) {
  for (const Joint& joint : arm.joints()) {
    if (joint.coordinate == coordinate) {
      return in_its_unit(amount, joint.type == JointType::kPrismatic ? "m" : "rad");
    }
  }
  return three_digits(amount);
}

void check_count(const CheckContext& context, Warnings& warnings) {
  const Measurement& m = context.measurement;
  const double equations = free_position_rows(m) +
                           static_cast<double>(context.system.known_rows()) +
                           static_cast<double>(context.system.rotation_rows());
  const auto unknown = static_cast<double>(context.system.columns());
  if (equations >= unknown) return;
  const auto more = static_cast<long>(std::ceil((unknown - equations) / 3.0));
  warnings.push_back(
      "Fewer equations than unknowns: " + counted(std::lround(equations), "equation") + " from " +
      counted(m.rows(), m.tracked ? "pose" : "touch", m.tracked ? "poses" : "touches") + " for " +
      counted(context.system.columns(), "unknown") +
      ". Undetermined parameters stay at, or near, nominal, and the small residual is no evidence "
      "of accuracy. Record at least " +
      counted(more, "more pose") + ", better 60 in all.");
}

void check_points(const CheckContext& context, Warnings& warnings) {
  const Measurement& m = context.measurement;
  if (m.tracked || m.points() == 0) return;
  std::vector<int> touches(static_cast<std::size_t>(m.points()), 0);
  for (const int p : m.point) {
    if (p >= 0) ++touches[p];
  }
  std::vector<std::string> lonely;
  for (int p = 0; p < m.points(); ++p) {
    const bool known = std::any_of(m.known_points.begin(), m.known_points.end(),
                                   [p](const KnownPoint& k) { return k.label == p; });
    if (touches[p] == 1 && !known) lonely.push_back(m.name_of(m.labels[p]));
  }
  if (!lonely.empty()) {
    warnings.push_back((lonely.size() == 1 ? "Point " : "Points ") + listed(lonely) +
                       (lonely.size() == 1 ? " was" : " were") +
                       " touched in one pose, which agrees with itself whatever the arm: it gives "
                       "no information. Touch each point in 20 poses and more.");
  }
  if (m.points() - static_cast<int>(lonely.size()) == 1 && m.plane_names.empty()) {
    warnings.push_back(
        "All comparable touches are of one point: the arm is determined near that position and "
        "extrapolated elsewhere. Touch two points more, far from it and from each other.");
  }
}

void check_joint_motion(const CheckContext& context, Warnings& warnings) {
  const RowMatrix& q = context.measurement.q;
  std::vector<std::string> still;
  std::vector<std::string> hardly;
  for (const Joint& joint : context.nominal.joints()) {
    if (joint.type == JointType::kFixed || !joint.follows.empty()) continue;
    const Index c = joint.coordinate;
    const double range = q.col(c).maxCoeff() - q.col(c).minCoeff();
    const std::string description = joint_label(context.nominal, c);
    if (range < Limits::kStill) {
      still.push_back(description);
    } else if (range <
               (joint.type == JointType::kPrismatic ? Limits::kHardlySlides : Limits::kHardly)) {
      hardly.push_back(description + " (" + joint_amount(context.nominal, c, range) + ")");
    }
  }
  if (!still.empty()) {
    warnings.push_back(
        "Never moved: " + listed(still) +
        ". The parameters of such a joint cannot be distinguished from its neighbours', and the "
        "identified arm is valid for that position only. Record poses that move it.");
  }
  if (!hardly.empty()) {
    warnings.push_back(
        "Hardly moved: " + listed(hardly) +
        ". The parameters of such a joint are poorly determined. Use more of its range.");
  }
}

void check_orientations(const CheckContext& context, Warnings& warnings) {
  const Measurement& m = context.measurement;
  if (m.tracked || m.points() == 0) return;
  const ChainDerivatives chain(context.system.arm_parameters(), context.fit.values, {});
  std::vector<Eigen::Matrix3d> turned;
  std::vector<Eigen::Matrix3d> sum(static_cast<std::size_t>(m.points()), Eigen::Matrix3d::Zero());
  ChainFrames frames;
  for (Index i = 0; i < m.rows(); ++i) {
    turned.push_back(chain
                         .tip(m.q.row(i).data(), m.perturbation_row(i), m.tool[i], m.station[i],
                              frames, nullptr, nullptr, 0)
                         .linear());
    if (m.point[i] >= 0) sum[m.point[i]] += turned.back();
  }
  double widest = 0.0;
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] < 0) continue;
    // Of turned and mean: |A - B|² = 8 sin²(angle / 2).
    const Eigen::Matrix3d mean = sum[m.point[i]] / sum[m.point[i]].norm() * std::sqrt(3.0);
    const double half = (turned[i] - mean).norm() / std::sqrt(8.0);
    widest = std::max(widest, 2.0 * std::asin(std::min(1.0, half)));
  }
  if (widest > Limits::kNarrow) return;
  warnings.push_back(
      "At no point did the tool turn by more than " + degrees(widest) +
      " from its mean attitude: such similar poses determine the parameters poorly, and errors "
      "elsewhere are larger than here. Lean the tool by 45 deg and more, to "
      "all sides, and turn it about its axis; bathyal.plan_touches chooses such "
      "poses.");
}

void check_limits(const CheckContext& context, Warnings& warnings) {
  const RowMatrix& q = context.measurement.q;
  std::vector<std::string> texts;
  for (Index j = 0; j < q.cols(); ++j) {
    long rows = 0;
    double most = 0.0;
    for (Index i = 0; i < q.rows(); ++i) {
      const double beyond =
          std::max(context.nominal.lower()[j] - q(i, j), q(i, j) - context.nominal.upper()[j]);
      if (beyond > Limits::kBeyondLimit) ++rows;
      most = std::max(most, beyond);
    }
    if (rows == 0) continue;
    texts.push_back(joint_label(context.nominal, j) + " in " + counted(rows, "row") +
                    ", by up to " + joint_amount(context.nominal, j, most));
  }
  if (texts.empty()) return;
  warnings.push_back("Recorded beyond the arm's limits: " + listed(texts) +
                     ". Such data may be of another arm, in another unit or with other joint "
                     "zeros; if the limits are wrong, set them right.");
}

void check_rank(const CheckContext& context, Warnings& warnings) {
  std::vector<std::string> lost;
  std::vector<std::string> held;
  for (const FitParameter& p : context.fit.parameters) {
    if (p.status == Status::kNotIdentifiable) lost.push_back(p.description);
    if (p.status == Status::kPrior) held.push_back(p.description);
  }
  if (!lost.empty()) {
    warnings.push_back(
        "Not identifiable, and left at nominal in undetermined directions: " + listed(lost) +
        ". These change together in directions that no pose here observes (see `trades` of each), "
        "and a "
        "tip far from the recorded poses may be off by more than any number here. Record more "
        "varied poses" +
        (context.measurement.tracked ? "." : ", and give a distance or the position of a point."));
  }
  if (!held.empty() && context.measurement.observes_scale()) {
    warnings.push_back(
        "Determined by a prior and not by the data: " + listed(held) +
        ". They are as accurate as the given tolerance; more varied poses would determine them.");
  }
}

}  // namespace

void check_data(const CheckContext& context, Warnings& warnings) {
  check_count(context, warnings);
  check_points(context, warnings);
  check_joint_motion(context, warnings);
  check_orientations(context, warnings);
  check_rank(context, warnings);
  check_limits(context, warnings);
}

}  // namespace bathyal::identify
