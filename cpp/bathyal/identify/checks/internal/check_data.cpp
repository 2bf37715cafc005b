// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/base/text.hpp"
#include "bathyal/identify/checks/internal/checks.hpp"

namespace bathyal {

std::string joint_words(const Arm& arm, Index coordinate) {
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

void doubt_count(const Case& seen, Warnings& warnings) {
  const Measurement& m = seen.measurement;
  const double equations = free_position_rows(m) + static_cast<double>(seen.system.known_rows()) +
                           static_cast<double>(seen.system.rotation_rows());
  const auto unknown = static_cast<double>(seen.system.columns());
  if (equations >= unknown) return;
  const auto more = static_cast<long>(std::ceil((unknown - equations) / 3.0));
  warnings.push_back(
      "Fewer equations than unknowns: " + counted(std::lround(equations), "equation") + " from " +
      counted(m.rows(), m.tracked ? "pose" : "touch", m.tracked ? "poses" : "touches") + " for " +
      counted(seen.system.columns(), "unknown") +
      ". What they cannot tell stays at, or near, nominal, and the small residual is none of the "
      "arm's merit. Record at least " +
      counted(more, "more pose") + ", better 60 in all.");
}

void doubt_points(const Case& seen, Warnings& warnings) {
  const Measurement& m = seen.measurement;
  if (m.tracked || m.points() == 0) return;
  std::vector<int> touches(static_cast<std::size_t>(m.points()), 0);
  for (const int p : m.point) {
    if (p >= 0) ++touches[p];
  }
  std::vector<std::string> lonely;
  for (int p = 0; p < m.points(); ++p) {
    const bool told = std::any_of(m.known_points.begin(), m.known_points.end(),
                                  [p](const KnownPoint& known) { return known.label == p; });
    if (touches[p] == 1 && !told) lonely.push_back(m.name_of(m.labels[p]));
  }
  if (!lonely.empty()) {
    warnings.push_back((lonely.size() == 1 ? "Point " : "Points ") + listed(lonely) +
                       (lonely.size() == 1 ? " was" : " were") +
                       " touched in one pose, which agrees with itself whatever the arm: it tells "
                       "nothing. Touch each point in 20 poses and more.");
  }
  if (m.points() - static_cast<int>(lonely.size()) == 1 && m.plane_names.empty()) {
    warnings.push_back(
        "All comparable touches are of one point: the arm is known about that place and guessed "
        "elsewhere. Touch two points more, far from it and from each other.");
  }
}

void doubt_joints(const Case& seen, Warnings& warnings) {
  constexpr double kStill = 1e-3;         // [rad] or [m]
  constexpr double kHardly = 0.35;        // [rad], 20 deg
  constexpr double kHardlySlides = 0.02;  // [m]
  const RowMatrix& q = seen.measurement.q;
  std::vector<std::string> still;
  std::vector<std::string> hardly;
  for (const Joint& joint : seen.nominal.joints()) {
    if (joint.type == JointType::kFixed || !joint.follows.empty()) continue;
    const Index c = joint.coordinate;
    const double range = q.col(c).maxCoeff() - q.col(c).minCoeff();
    const std::string words = joint_words(seen.nominal, c);
    if (range < kStill) {
      still.push_back(words);
    } else if (range < (joint.type == JointType::kPrismatic ? kHardlySlides : kHardly)) {
      hardly.push_back(words + " (" + joint_amount(seen.nominal, c, range) + ")");
    }
  }
  if (!still.empty()) {
    warnings.push_back("Never moved: " + listed(still) +
                       ". Nothing tells such a joint's parameters from its neighbours', and the "
                       "arm found holds for that position only. Record poses that move it.");
  }
  if (!hardly.empty()) {
    warnings.push_back("Hardly moved: " + listed(hardly) +
                       ". Little tells such a joint's parameters. Use more of its range.");
  }
}

void doubt_leaning(const Case& seen, Warnings& warnings) {
  constexpr double kNarrow = 0.44;  // [rad], 25 deg
  const Measurement& m = seen.measurement;
  if (m.tracked || m.points() == 0) return;
  const TipWalk walk(seen.system.arm_columns(), seen.fit.values, {});
  std::vector<Eigen::Matrix3d> turned;
  std::vector<Eigen::Matrix3d> sum(static_cast<std::size_t>(m.points()), Eigen::Matrix3d::Zero());
  WalkFrames frames;
  for (Index i = 0; i < m.rows(); ++i) {
    turned.push_back(walk.tip(m.q.row(i).data(), m.action_row(i), m.tool[i], m.station[i], frames,
                              nullptr, nullptr, 0)
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
  if (widest > kNarrow) return;
  warnings.push_back("At no point did the tool turn by more than " + degrees(widest) +
                     " from its mean attitude: poses so alike tell parameters apart badly, and "
                     "errors elsewhere are larger than here. Lean the tool by 45 deg and more, to "
                     "all sides, and turn it about its axis; bathyal.plan_touches chooses such "
                     "poses.");
}

void doubt_limits(const Case& seen, Warnings& warnings) {
  constexpr double kBeyond = 2e-3;  // [rad] or [m]
  const RowMatrix& q = seen.measurement.q;
  std::vector<std::string> texts;
  for (Index j = 0; j < q.cols(); ++j) {
    long rows = 0;
    double most = 0.0;
    for (Index i = 0; i < q.rows(); ++i) {
      const double beyond =
          std::max(seen.nominal.lower()[j] - q(i, j), q(i, j) - seen.nominal.upper()[j]);
      if (beyond > kBeyond) ++rows;
      most = std::max(most, beyond);
    }
    if (rows == 0) continue;
    texts.push_back(joint_words(seen.nominal, j) + " in " + counted(rows, "row") + ", by up to " +
                    joint_amount(seen.nominal, j, most));
  }
  if (texts.empty()) return;
  warnings.push_back("Recorded beyond the arm's limits: " + listed(texts) +
                     ". Such data may be of another arm, in another unit or with other joint "
                     "zeros; if the limits are wrong, set them right.");
}

void doubt_rank(const Case& seen, Warnings& warnings) {
  std::vector<std::string> lost;
  std::vector<std::string> held;
  for (const FitParameter& p : seen.fit.parameters) {
    if (p.status == Status::kNotIdentifiable) lost.push_back(p.words);
    if (p.status == Status::kPrior) held.push_back(p.words);
  }
  if (!lost.empty()) {
    warnings.push_back(
        "Not found, and left at nominal where the data do not tell: " + listed(lost) +
        ". These move together in ways that no pose here feels (`trades` of each says how), and a "
        "tip far from the recorded poses may be off by more than any number here. Record more "
        "varied poses" +
        (seen.measurement.tracked ? "." : ", and tell a distance or the place of a point."));
  }
  if (!held.empty() && seen.measurement.tells_scale()) {
    warnings.push_back("Held by a prior and not told by the data: " + listed(held) +
                       ". They are as good as the tolerance given; more varied poses would tell "
                       "them.");
  }
}

}  // namespace

void doubt_data(const Case& seen, Warnings& warnings) {
  doubt_count(seen, warnings);
  doubt_points(seen, warnings);
  doubt_joints(seen, warnings);
  doubt_leaning(seen, warnings);
  doubt_rank(seen, warnings);
  doubt_limits(seen, warnings);
}

}  // namespace bathyal
