// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/internal/sampling_search.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/workspace/internal/contact_text.hpp"
#include "bathyal/workspace/internal/postures.hpp"

namespace bathyal::workspace {
namespace {

constexpr Index kSamplingStarts = 32;          // of the search for postures before contact
constexpr std::size_t kSamplingPostures = 12;  // of those, that are tried
constexpr int kSearches = 4;                   // without a path, that use max_checks up
constexpr double kSamePosture = 1e-3;          // [rad], [m]
constexpr double kOnBottom = 1e-3;             // under it, of a target on the bottom [m]

JointMatrix one_row(std::span<const double> values) {
  return Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Index>(values.size()));
}

std::span<const double> values_of(const JointMatrix& row) {
  return {row.data(), static_cast<std::size_t>(row.size())};
}

TimedMotion reversed(const TimedMotion& motion) {
  TimedMotion back;
  back.q = motion.q.colwise().reverse();
  for (auto time = motion.time.rbegin(); time != motion.time.rend(); ++time) {
    back.time.push_back(motion.time.back() - *time);
  }
  return back;
}

/// From a moment on.
MotionCheck checked(const Workspace& ws, const TimedMotion& motion, double start,
                    TipContact tip_contact) {
  std::vector<double> time = motion.time;
  for (double& moment : time) moment += start;
  return ws.check_motion(view_of(motion.q), {.time = time, .tip_contact = tip_contact});
}

}  // namespace

SamplingSearch::SamplingSearch(const Workspace& workspace, const Vec3& target,
                               const SamplingOptions& options)
    : target_(target),
      options_(options),
      site_(sampling_site(with_tool(workspace, options), target, options)),
      empty_(with_tool(workspace, options).with_tip_depth(site_.depth)),
      loaded_(empty_.attach(options.sample.capsules, options.sample.body)),
      limits_(complete_limits(workspace.arm(), options.limits)),
      start_(options.q_start),
      checks_left_(options.max_checks) {
  if (start_.empty()) start_ = stowed_posture(empty_, options.time, options.seed);
  transport_ = options.q_transport.empty() ? start_ : options.q_transport;
}

bool SamplingSearch::find() {
  if (!check_ends() || !check_place()) return false;
  return std::ranges::any_of(postures_before_contact(), [&](const JointMatrix& before) {
    return checks_left_ > 0 && try_posture(before);
  });
}

bool SamplingSearch::try_posture(const JointMatrix& before) {
  legs_.clear();
  end_ = options_.time;
  return find_line(before) &&  // sooner done than a plan
         plan_leg(empty_, "approach", one_row(start_), before, SamplingStatus::kNoApproach) &&
         press_and_lift() &&
         plan_leg(loaded_, "transport", before, one_row(transport_),
                  SamplingStatus::kNoTransport) &&
         check_retreats();
}

bool SamplingSearch::refuse(SamplingStatus status, std::string reason) {
  status_ = status;
  reason_ = std::move(reason);
  return false;
}

bool SamplingSearch::check_ends() {
  if (start_.empty()) {
    return refuse(SamplingStatus::kStart,
                  "No free posture was found to start from; give `q_start`.");
  }
  return check_end(empty_, start_, "start") && check_end(loaded_, transport_, "transport posture");
}

bool SamplingSearch::check_end(const Workspace& ws, const std::vector<double>& end,
                               const std::string& name) {
  const JointMatrix q = one_row(end);
  if (!within_limits(arm(), view_of(q))[0]) {
    return refuse(SamplingStatus::kStart, "The " + name + " is outside the joint limits.");
  }
  const Clearance clear = ws.clearance(view_of(q), {&options_.time, 1})[0];
  if (clear.least() > 0.0) return true;
  return refuse(SamplingStatus::kStart, "In the " + name + " " + contact_text(ws, clear) + ".");
}

bool SamplingSearch::check_place() {
  PointMatrix point(1, 3);
  point.row(0) = target_.transpose();
  const TargetCheck check = empty_.check_target(PointView(point.data(), 1, 3), options_.time,
                                                options_.seed, options_.num_threads)[0];
  if (check.status == TargetIndicator::kHull) {
    return refuse(SamplingStatus::kForbidden, "The target is inside the hull.");
  }
  if (check.status == TargetIndicator::kKeepOut) {
    const KeepOut& which = empty_.surroundings().keepouts[static_cast<std::size_t>(check.keepout)];
    return refuse(SamplingStatus::kForbidden,
                  "The target is inside the keep-out \"" + which.name() + "\".");
  }
  if (!site_.has_bottom) {
    return refuse(SamplingStatus::kNoBottom, "No bottom lies within " + to_text(options_.standoff) +
                                                 " m of the target along the direction.");
  }
  if (site_.under > std::max(site_.depth, kOnBottom)) {
    return refuse(SamplingStatus::kForbidden,
                  "The target is " + to_text(site_.under) + " m under the bottom.");
  }
  return true;
}

/// Free ones, different from each other, those near to the start first.
std::vector<JointMatrix> SamplingSearch::postures_before_contact() {
  JointMatrix starts(kSamplingStarts, arm().size());
  starts.row(0) = one_row(start_);
  RandomStream random(options_.seed);
  for (Index i = 1; i < kSamplingStarts; ++i) {
    starts.row(i) = drawn_posture(arm(), random);
  }
  const JointMatrix q = reaching(arm(), site_.before, site_.aim, starts, options_.num_threads);
  refuse(SamplingStatus::kUnreachable, "No posture reaches the place before contact.");
  if (q.rows() == 0) return {};
  refuse(SamplingStatus::kCollision, "Every posture found before contact touches something.");
  const std::vector<Clearance> clear = empty_.clearance(
      view_of(q), {&options_.time, 1}, TipContact::kForbidden, options_.num_threads);
  std::vector<Index> order(static_cast<std::size_t>(q.rows()));
  std::iota(order.begin(), order.end(), 0);
  const JointMatrix from = one_row(start_);
  std::ranges::stable_sort(order, {},
                           [&](Index i) { return (q.row(i) - from.row(0)).cwiseAbs().maxCoeff(); });
  std::vector<JointMatrix> postures;
  for (const Index i : order) {
    const bool known = std::ranges::any_of(postures, [&](const JointMatrix& other) {
      return (other.row(0) - q.row(i)).cwiseAbs().maxCoeff() < kSamePosture;
    });
    if (known || !(clear[static_cast<std::size_t>(i)].least() > 0.0)) continue;
    postures.emplace_back(q.row(i));
    if (postures.size() == kSamplingPostures) break;
  }
  return postures;
}

bool SamplingSearch::find_line(const JointMatrix& before) {
  const auto rows = follow_line(arm(), values_of(before), site_.before, site_.deepest, site_.aim,
                                options_.line_tolerance);
  const LineTiming timing{limits_, options_.step, options_.press_speed, options_.line_tolerance};
  auto down = rows ? time_line(arm(), *rows, site_.before, site_.deepest, timing) : std::nullopt;
  if (!down) {
    return refuse(SamplingStatus::kUnreachable,
                  "The tip cannot be pressed straight from before contact to its depth.");
  }
  down_ = std::move(*down);
  return true;
}

bool SamplingSearch::press_and_lift() {
  TimedMotion hold;
  hold.q = down_.q.bottomRows(1).replicate(2, 1);
  hold.time = {0.0, options_.grab_time};
  return add_in_bottom(kPress, "press", down_) && add_in_bottom(kGrab, "grab", hold) &&
         add_in_bottom(kLift, "lift", reversed(down_));
}

bool SamplingSearch::plan_leg(const Workspace& ws, const std::string& name, const JointMatrix& from,
                              const JointMatrix& to, SamplingStatus otherwise) {
  PlanOptions planning;
  planning.seed = options_.seed;
  planning.max_checks = std::max(1, std::min(checks_left_, options_.max_checks / kSearches));
  planning.limits = limits_;
  planning.timing.step = options_.step;
  planning.time = end_;
  const std::span<const double> goal = values_of(to);
  Plan plan =
      plan_motion(ws, values_of(from), std::vector<double>(goal.begin(), goal.end()), planning);
  checks_left_ -= plan.checks;
  if (plan.status != PlanStatus::kSolved) {
    return refuse(otherwise, "No " + name + ": " + plan.reason);
  }
  add_leg(name, {std::move(plan.path), std::move(plan.time), {}});
  return true;
}

bool SamplingSearch::add_in_bottom(std::size_t leg, const std::string& name, TimedMotion motion) {
  const MotionCheck check = checked(held(leg), motion, end_, TipContact::kAllowed);
  if (!check.free) {
    return refuse(SamplingStatus::kCollision,
                  "In the phase \"" + name + "\" " + contact_text(held(leg), check) + ".");
  }
  add_leg(name, std::move(motion));
  return true;
}

void SamplingSearch::add_leg(const std::string& name, TimedMotion motion) {
  end_ += motion.time.back();
  legs_.push_back({name, std::move(motion), {}});
}

/// Each way back, with what is held and from when its phase ends.
bool SamplingSearch::check_retreats() {
  legs_[kApproach].retreat = reversed(legs_[kApproach].motion);
  legs_[kPress].retreat = legs_[kGrab].retreat = reversed(legs_[kPress].motion);
  legs_[kLift].retreat = legs_[kTransport].motion;
  legs_[kTransport].retreat = reversed(legs_[kTransport].motion);
  double end = options_.time;
  for (std::size_t i = 0; i < kLegCount; ++i) {
    end += legs_[i].motion.time.back();
    const bool buried = i == kPress || i == kGrab;
    const MotionCheck check = checked(held(i), legs_[i].retreat, end,
                                      buried ? TipContact::kAllowed : TipContact::kForbidden);
    if (!check.free) {
      return refuse(SamplingStatus::kNoRetreat,
                    "The way back from \"" + legs_[i].name + "\" is not free when it is needed.");
    }
  }
  return true;
}

}  // namespace bathyal::workspace
