// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/plan_check.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal::workspace {
namespace {

/// What moves is at rest for a straight motion of this duration, to 10⁻⁸ m at 10 m/s [s].
constexpr double kInstant = 1e-9;

}  // namespace

PlanCheck::PlanCheck(const Workspace& workspace, const PlanOptions& options)
    : workspace_(&workspace),
      options_(&options),
      times_{options.time},
      start_(std::chrono::steady_clock::now()) {}

bool PlanCheck::late() {
  if (!late_) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    late_ = passed.count() > options_->max_seconds;
  }
  return late_;
}

MotionCheck PlanCheck::straight(const JointMatrix& rows, double time) {
  MotionOptions motion;
  motion.tip_contact = options_->tip_contact;
  // A step that is seen next to the time, too.
  const double times[] = {time, std::max(time + kInstant, std::nextafter(time, INFINITY))};
  if (workspace_->moves()) motion.time = {times, static_cast<std::size_t>(rows.rows())};
  return workspace_->check_motion(view_of(rows), motion);
}

bool PlanCheck::is_free(const JointRow& q) {
  ++used_;
  const JointMatrix row = q;
  return std::ranges::all_of(times_, [&](double time) { return straight(row, time).free; });
}

double PlanCheck::free_share(const JointRow& from, const JointRow& to) {
  ++used_;
  JointMatrix rows(2, from.size());
  rows.row(0) = from;
  rows.row(1) = to;
  double share = 1.0;
  for (const double time : times_) {
    const MotionCheck check = straight(rows, time);
    if (!check.free) share = std::min(share, std::min(check.contact, 1.0 - 1e-9));
  }
  return share;
}

MotionCheck PlanCheck::motion(const JointMatrix& q, const std::vector<double>& time) {
  ++used_;
  std::vector<double> times = time;
  for (double& t : times) t += options_->time;
  MotionOptions motion;
  motion.time = times;
  motion.tip_contact = options_->tip_contact;
  return workspace_->check_motion(view_of(q), motion);
}

Clearance PlanCheck::clearance(const JointRow& q) const {
  const JointMatrix row = q;
  const double time[] = {options_->time};
  return workspace_->clearance(view_of(row), time, options_->tip_contact, 1)[0];
}

}  // namespace bathyal::workspace
