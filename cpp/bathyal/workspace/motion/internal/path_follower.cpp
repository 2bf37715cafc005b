// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bathyal::workspace {
namespace {

using Eigen::VectorXd;

constexpr double kMostChange = 0.2;  // of a coordinate between two rows [rad], [m]
constexpr double kMostTurn = 0.05;   // of the tool between two rows [rad]
constexpr double kSettled = 1e-3;    // of the tolerances, to which a row is solved
constexpr int kMostIterations = 20;  // for one row
constexpr int kMostHalvings = 4;     // of the way to a row
constexpr double kComfort = 0.1;     // of what a step could take towards the middle of the limits
constexpr double kTouching = 1e-9;   // standoff [m]

double least_standoff(const ToolPath& path) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < path.size(); ++j) {
    least = std::min(least, (path.position[j] - path.surface[j]).dot(path.approach[j]));
  }
  return least;
}

StepRules rules_of(const Workspace& ws, const FollowOptions& options, TipContact tip_contact) {
  return {VectorXd::Constant(ws.arm().size(), kMostChange), options.clearance, options.influence,
          0.5, tip_contact};
}

void set_halt(const TipStep& step, FollowCut& halt) {
  const auto nearest = std::ranges::min_element(step.pairs, {}, &NearPair::distance);
  halt.reason = CutReason::kSingular;
  if (nearest != step.pairs.end()) {
    halt.reason = CutReason::kCollision;
    halt.link = nearest->link, halt.obstacle = nearest->obstacle;
    halt.other_link = nearest->other_link;
  } else if (!step.limits.empty()) {
    halt.reason = CutReason::kLimit;
    halt.coordinate = step.limits.front();
  }
}

}  // namespace

PathFollower::PathFollower(const Workspace& ws, const Bodies& bodies, const ToolPath& path,
                           const FollowOptions& options)
    : ws_(ws),
      path_(path),
      options_(options),
      tip_contact_(options.tip_contact.value_or(
          least_standoff(path) <= kTouching ? TipContact::kAllowed : TipContact::kForbidden)),
      vehicle_from_world_(ws.surroundings().world_from_vehicle.at(options.time).inverse()),
      stepper_(bodies, ws.surroundings().world_from_vehicle, rules_of(ws, options, tip_contact_)) {}

TipTarget PathFollower::target(std::int32_t sample, double fraction) const {
  Pose pose = path_.frame(static_cast<std::size_t>(sample));
  if (fraction > 0.0) {
    const Pose next = path_.frame(static_cast<std::size_t>(sample) + 1);
    pose.translation() += fraction * (next.translation() - pose.translation());
    const Eigen::Quaterniond from(pose.linear()), to(next.linear());
    pose.linear() = from.slerp(fraction, to).toRotationMatrix();
  }
  return {vehicle_from_world_ * pose, options_.task, Vec3::UnitZ()};
}

TipTarget PathFollower::lifted(std::int32_t sample, double height) const {
  TipTarget up = target(sample);
  up.pose.translation() -= height * up.pose.linear().col(2);  // the tool's z is −a_j
  return up;
}

std::optional<VectorXd> PathFollower::settle(const VectorXd& q, const TipTarget& target,
                                             double comfort, FollowCut& halt) {
  VectorXd at = q;
  TipStep step;
  for (int i = 0; i <= kMostIterations; ++i) {
    stepper_.set(at, options_.time);
    const TipError error = stepper_.error(target);
    // A row that only meets the tolerance will do in the end, where bounds hold it there.
    const double share = i == kMostIterations ? 1.0 : kSettled;
    if ((i > 0 || comfort == 0.0) && error.distance() <= share * options_.position_tolerance &&
        error.angle() <= share * options_.angle_tolerance) {
      return at;
    }
    step = stepper_.step(target, error, i == 0 ? comfort : 0.0);
    at = (at + step.change).cwiseMax(ws_.arm().lower()).cwiseMin(ws_.arm().upper());
  }
  set_halt(step, halt);
  return std::nullopt;
}

bool PathFollower::leg_is_free(const VectorXd& from, const VectorXd& to, FollowCut& halt) const {
  JointMatrix leg(2, from.size());
  leg << from.transpose(), to.transpose();
  const MotionCheck check = ws_.check_motion(view_of(leg), {.tip_contact = tip_contact_});
  if (check.free) return true;
  halt.reason = CutReason::kCollision;
  halt.link = check.link, halt.obstacle = check.obstacle, halt.other_link = check.other_link;
  return false;
}

bool PathFollower::advance_to(std::int32_t sample, double fraction, int depth, double comfort,
                              Stretch& stretch) {
  const PathRow& last = stretch.rows.back();
  const double from = last.sample == sample ? last.fraction : 0.0;
  const std::optional<VectorXd> q = settle(last.q, target(sample, fraction), comfort, stretch.halt);
  if (q && (*q - last.q).cwiseAbs().maxCoeff() <= kMostChange) {
    if (!leg_is_free(last.q, *q, stretch.halt)) return false;
    const bool arrived = fraction >= 1.0;
    stretch.rows.push_back({*q, arrived ? sample + 1 : sample, arrived ? 0.0 : fraction});
    return true;
  }
  if (q) stretch.halt.reason = CutReason::kSingular;
  if (depth == kMostHalvings) return false;
  const double middle = 0.5 * (from + fraction);
  return advance_to(sample, middle, depth + 1, 0.5 * comfort, stretch) &&
         advance_to(sample, fraction, depth + 1, 0.5 * comfort, stretch);
}

bool PathFollower::advance(std::int32_t sample, Stretch& stretch) {
  const Pose from = target(sample).pose, to = target(sample + 1).pose;
  const double way = (to.translation() - from.translation()).norm();
  const double turn = Eigen::AngleAxisd(to.linear() * from.linear().transpose()).angle();
  const int parts =
      std::max(1, static_cast<int>(std::ceil(std::max(way / options_.step, turn / kMostTurn))));
  const double comfort = kComfort * std::min(1.0, way / options_.step / parts);
  const std::size_t rows = stretch.rows.size();
  for (int i = 1; i <= parts; ++i) {
    const double fraction = i == parts ? 1.0 : static_cast<double>(i) / parts;
    if (!advance_to(sample, fraction, 0, comfort, stretch)) {
      stretch.rows.resize(rows);
      return false;
    }
  }
  return true;
}

Stretch PathFollower::follow(const VectorXd& q, std::int32_t first) {
  Stretch stretch;
  stretch.first = stretch.last = first;
  const std::optional<VectorXd> settled = settle(q, target(first), 0.0, stretch.halt);
  if (!settled || !leg_is_free(*settled, *settled, stretch.halt)) return stretch;
  stretch.rows.push_back({*settled, first, 0.0});
  for (;;) {
    if (stretch.last + 1 == size() || gap_after(stretch.last)) {
      stretch.complete = true;
      return stretch;
    }
    if (!advance(stretch.last, stretch)) return stretch;
    ++stretch.last;
  }
}

}  // namespace bathyal::workspace
