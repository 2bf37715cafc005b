// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <vector>

#include "bathyal/workspace/internal/contact_text.hpp"
#include "bathyal/workspace/internal/postures.hpp"
#include "bathyal/workspace/motion/plan.hpp"

namespace bathyal::workspace {

/// What a planner asks a workspace, counted.
class PlanCheck {
 public:
  PlanCheck(const Workspace& workspace, const PlanOptions& options);

  const Workspace& workspace() const { return *workspace_; }
  const Arm& arm() const { return workspace_->arm(); }
  const PlanOptions& options() const { return *options_; }
  int used() const { return used_; }

  /// Whether no more may be asked.
  bool spent() { return used_ >= options_->max_checks || late(); }
  /// Whether the safety stop is why.
  bool late();

  /// Straight motions are to be free at this time, too.
  void also_at(double time) { times_.push_back(time); }

  bool is_free(const JointRow& q);

  /// How far the straight motion goes before its first contact, 0 … 1; 1 is all the way.
  double free_share(const JointRow& from, const JointRow& to);

  /// Of rows at their times after the start.
  MotionCheck motion(const JointMatrix& q, const std::vector<double>& time);

  /// Of one posture, at the time of the start.
  Clearance clearance(const JointRow& q) const;

 private:
  MotionCheck straight(const JointMatrix& rows, double time);

  const Workspace* workspace_;
  const PlanOptions* options_;
  std::vector<double> times_;
  std::chrono::steady_clock::time_point start_;
  bool late_ = false;
  int used_ = 0;
};

}  // namespace bathyal::workspace
