// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/tip_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bathyal/arm/inverse_problem.hpp"
#include "bathyal/workspace/motion/motion_timing.hpp"

namespace bathyal::workspace {
namespace {

using Eigen::VectorXd;

constexpr int kPatience = 40;     // steps without getting nearer
constexpr double kNearer = 1e-3;  // of the error, that counts as getting nearer
constexpr int kMostNudges = 3;    // out of a singular posture
constexpr int kShortenings = 4;   // of a step that would touch something
constexpr double kLimitTolerance = 1e-9;
constexpr double kRankTolerance = 1e-6;  // of the pseudo-inverse, as in the room `arm`

/// Rows of a motion as they grow, each leg checked before it is taken.
class CheckedRows {
 public:
  CheckedRows(const Workspace& ws, std::span<const double> q_start, const MoveOptions& options)
      : ws_(ws), options_(options), moves_(ws.moves()) {
    values_.assign(q_start.begin(), q_start.end());
    outside(last(), found_.coordinate);
    if (found_.coordinate >= 0) {
      found_.end = TipMotion::End::kBeyondLimit;
    } else {
      take_contact(ws.check_motion(view(values_), motion_options(1)));
    }
  }

  bool sound() const { return found_.end == TipMotion::End::kReached; }
  std::size_t size() const { return values_.size() / width(); }
  double time() const { return options_.time + options_.period * static_cast<double>(size() - 1); }

  VectorXd last() const {
    return Eigen::Map<const VectorXd>(values_.data() + values_.size() - width(), ws_.arm().size());
  }

  /// The leg to a posture: taken where it is within the limits and free; else `contact()` says why
  /// not.
  bool take(const VectorXd& q) {
    TipMotion halted;
    outside(q, halted.coordinate);
    if (halted.coordinate >= 0) {
      halted.end = TipMotion::End::kBeyondLimit;
      refused_ = halted;
      return false;
    }
    std::vector<double> leg(values_.end() - static_cast<std::ptrdiff_t>(width()), values_.end());
    leg.insert(leg.end(), q.begin(), q.end());
    const MotionCheck check = ws_.check_motion(view(leg), motion_options(2));
    if (!check.free) {
      refused_ = {TipMotion::End::kContact, {}, check.link, check.obstacle, check.other_link, -1};
      return false;
    }
    values_.insert(values_.end(), q.begin(), q.end());
    return true;
  }

  const TipMotion& refused() const { return refused_; }

  /// The first `count` rows, and the end given.
  TipMotion finished(TipMotion end, std::size_t count) const {
    end.rows = view(values_).topRows(static_cast<Index>(count));
    return end;
  }
  TipMotion unsound() const { return finished(found_, 1); }

 private:
  std::size_t width() const { return static_cast<std::size_t>(ws_.arm().size()); }

  JointView view(const std::vector<double>& values) const {
    return {values.data(), static_cast<Index>(values.size() / width()), ws_.arm().size()};
  }

  MotionOptions motion_options(std::size_t rows) {
    MotionOptions options{.tip_contact = options_.tip_contact};
    if (!moves_) return options;
    times_ = {time(), time() + options_.period};
    options.time = {times_.data(), rows};
    return options;
  }

  void outside(const VectorXd& q, int& coordinate) const {
    const Arm& arm = ws_.arm();
    for (Index k = 0; k < arm.size() && coordinate < 0; ++k) {
      if (q[k] < arm.lower()[k] - kLimitTolerance || q[k] > arm.upper()[k] + kLimitTolerance) {
        coordinate = static_cast<int>(k);
      }
    }
  }

  void take_contact(const MotionCheck& check) {
    if (check.free) return;
    found_ = {TipMotion::End::kContact, {}, check.link, check.obstacle, check.other_link, -1};
  }

  const Workspace& ws_;
  const MoveOptions& options_;
  bool moves_;
  std::vector<double> values_;
  std::array<double, 2> times_{};
  TipMotion found_, refused_;
};

VectorXd change_in_period(const Arm& arm, const MoveOptions& options) {
  const std::vector<double> rates =
      options.velocity.empty() ? default_limits(arm).velocity : options.velocity;
  return options.period * Eigen::Map<const VectorXd>(rates.data(), arm.size());
}

StepRules rules_of(const Arm& arm, const MoveOptions& options) {
  StepRules rules{change_in_period(arm, options), options.clearance, options.influence};
  // ξ (d − d_s) / (d_i − d_s) in a period; never past d_s.
  rules.approach =
      std::min(1.0, options.approach * options.period / (options.influence - options.clearance));
  rules.tip_contact = options.tip_contact;
  return rules;
}

Vec3 shortened(const Vec3& vector, double most) {
  const double length = vector.norm();
  return length > most ? Vec3(most / length * vector) : vector;
}

/// The nearest that a motion has come, and how long ago.
struct Progress {
  double distance = std::numeric_limits<double>::infinity(), angle = distance;
  std::size_t rows = 1;
  int without = 0;

  void look(const TipError& error, double tolerance, std::size_t count) {
    const bool nearer = error.distance() < distance * (1.0 - kNearer);
    const bool turned = error.distance() < std::max(distance, tolerance) * (1.0 + kNearer) &&
                        error.angle() < angle * (1.0 - kNearer);
    ++without;
    if (!nearer && !turned) return;
    distance = error.distance(), angle = error.angle();
    rows = count;
    without = 0;
  }
};

/// A small change of every coordinate, the same each time: out of a posture in which no first-order
/// step leads on.
VectorXd nudged(const Arm& arm, const VectorXd& q, const VectorXd& change, int count) {
  VectorXd to = q;
  for (Index k = 0; k < q.size(); ++k) {
    const double sign = (k + count) % 2 == 0 ? 1.0 : -1.0;
    const double step = sign * change[k] / (1.0 + 0.3 * static_cast<double>(k));
    to[k] =
        q[k] + step > arm.upper()[k] || q[k] + step < arm.lower()[k] ? q[k] - step : q[k] + step;
    to[k] = std::clamp(to[k], arm.lower()[k], arm.upper()[k]);
  }
  return to;
}

/// What held the last steps.
TipMotion halted_by(const TipStep& step, const CheckedRows& rows, bool refused) {
  TipMotion end;
  end.end = TipMotion::End::kHalted;
  if (!step.limits.empty()) end.coordinate = step.limits.front();
  const auto nearest = std::ranges::min_element(step.pairs, {}, &NearPair::distance);
  if (nearest != step.pairs.end()) {
    end.link = nearest->link, end.obstacle = nearest->obstacle;
    end.other_link = nearest->other_link;
  } else if (refused) {
    end.link = rows.refused().link, end.obstacle = rows.refused().obstacle;
    end.other_link = rows.refused().other_link;
  }
  return end;
}

}  // namespace

TipMotion damped_motion(const Workspace& ws, std::span<const double> q_start,
                        const TipTarget& target, const MoveOptions& options) {
  CheckedRows rows(ws, q_start, options);
  if (!rows.sound()) return rows.unsound();
  const Bodies bodies = make_bodies(ws.arm(), ws.surroundings());
  const StepRules rules = rules_of(ws.arm(), options);
  TipStepper stepper(bodies, ws.surroundings().world_from_vehicle, rules);
  const double position_tolerance = options.position_tolerance.value_or(1e-4);
  const double angle_tolerance = options.angle_tolerance.value_or(1e-3);

  Progress progress;
  TipStep step;
  bool refused = false;
  int nudges = 0;
  for (int count = 0; count < options.max_steps; ++count) {
    stepper.set(rows.last(), rows.time());
    const TipError error = stepper.error(target);
    progress.look(error, position_tolerance, rows.size());
    if (error.distance() <= position_tolerance && error.angle() <= angle_tolerance) {
      return rows.finished({}, rows.size());
    }
    step = stepper.step(target,
                        {shortened(error.offset, options.speed * options.period),
                         shortened(error.turn, options.angular_rate * options.period)},
                        1.0);
    if (progress.without > kPatience) {
      const bool singular = step.pairs.empty() && step.limits.empty() && !refused;
      if (!singular || nudges == kMostNudges ||
          !rows.take(nudged(ws.arm(), stepper.q(), rules.change, nudges++))) {
        break;
      }
      progress.without = 0;
      continue;
    }
    VectorXd change = step.change;
    refused = true;
    for (int i = 0; i <= kShortenings && refused; ++i, change *= 0.5) {
      const VectorXd to =
          (stepper.q() + change).cwiseMax(ws.arm().lower()).cwiseMin(ws.arm().upper());
      refused = !rows.take(to);
    }
    if (refused) break;
  }
  return rows.finished(halted_by(step, rows, refused), progress.rows);
}

TipMotion pseudo_inverse_motion(const Workspace& ws, std::span<const double> q_start,
                                const TipTarget& target, const MoveOptions& options) {
  CheckedRows rows(ws, q_start, options);
  if (!rows.sound()) return rows.unsound();
  InverseOptions inverse_options;
  inverse_options.method = InverseMethod::kPseudoInverse;
  inverse_options.task = target.task;
  inverse_options.axis = target.axis;
  inverse_options.position_tolerance = options.position_tolerance;
  inverse_options.angle_tolerance = options.angle_tolerance;
  const bathyal::arm::InverseProblem problem(ws.arm(), inverse_options);
  bathyal::arm::TipState state(problem.program.view, problem.task);
  const bathyal::arm::PlainPose goal = problem.relative(bathyal::arm::plain(target.pose));
  const Eigen::Index needed = target.task == InverseTask::kPose       ? 6
                              : target.task == InverseTask::kPosition ? 3
                                                                      : 5;
  TipMotion halted;
  halted.end = TipMotion::End::kHalted;
  for (int count = 0; count <= options.steps + inverse_options.max_iterations; ++count) {
    const VectorXd q = rows.last();
    state.evaluate(goal, q.data());
    // The k-th of `steps` takes 1 / (steps − k) of the rest: equal parts of the way.
    const int left = std::max(options.steps - count, 1);
    if (left == 1 && state.position_error() <= problem.position_tolerance &&
        state.angle_error() <= problem.angle_tolerance) {
      return rows.finished({}, rows.size());
    }
    using Rows = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Rows> jacobian(state.jacobian(), 6, q.size());
    const Eigen::Map<const Vec6> residual(state.residual());
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(kRankTolerance);
    if (svd.rank() < std::min(needed, q.size())) break;
    const VectorXd to = q + svd.solve(residual / left);
    if (!to.allFinite()) break;
    if (!rows.take(to)) return rows.finished(rows.refused(), rows.size());
  }
  return rows.finished(halted, rows.size());
}

std::vector<double> tip_durations(const Arm& arm, const JointMatrix& rows, double speed,
                                  double angular_rate) {
  std::vector<double> least(static_cast<std::size_t>(std::max<Index>(0, rows.rows() - 1)));
  const std::vector<double> poses = forward(arm, view_of(rows), 1);
  for (std::size_t i = 0; i < least.size(); ++i) {
    const Pose from = pose_of_rows(&poses[16 * i]), to = pose_of_rows(&poses[16 * (i + 1)]);
    const double way = (to.translation() - from.translation()).norm();
    const Eigen::Matrix3d turn = to.linear() * from.linear().transpose();
    const double angle = Eigen::AngleAxisd(turn).angle();
    least[i] = std::max(way / speed, angle / angular_rate);
  }
  return least;
}

}  // namespace bathyal::workspace
