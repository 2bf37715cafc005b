// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bathyal/workspace/motion/plan.hpp"
#include "bathyal/workspace/sampling/internal/sampling_site.hpp"

namespace bathyal::workspace {

/// Approach, press, grab, lift, transport: indices of legs.
enum SamplingLegs : std::size_t { kApproach, kPress, kGrab, kLift, kTransport, kLegCount };

/// A motion and the way back from its end, each from time 0.
struct SamplingLeg {
  std::string name;
  TimedMotion motion;
  TimedMotion retreat;
};

/// Looks for the motions of one sample. What is held changes in between: there are two workspaces.
class SamplingSearch {
 public:
  SamplingSearch(const Workspace& workspace, const Vec3& target, const SamplingOptions& options);

  /// Whether all legs were found; else status() and reason() say why not: of the posture before
  /// contact that was tried last.
  bool find();

  const Workspace& held(std::size_t leg) const { return leg < kLift ? empty_ : loaded_; }
  const SamplingSite& site() const { return site_; }
  const std::vector<SamplingLeg>& legs() const { return legs_; }
  SamplingStatus status() const { return status_; }
  const std::string& reason() const { return reason_; }

 private:
  const Arm& arm() const { return empty_.arm(); }
  bool refuse(SamplingStatus status, std::string reason);

  bool check_ends();
  bool check_end(const Workspace& ws, const std::vector<double>& end, const std::string& name);
  bool check_place();
  std::vector<JointMatrix> postures_before_contact();

  bool try_posture(const JointMatrix& before);
  bool find_line(const JointMatrix& before);
  bool press_and_lift();
  bool check_retreats();

  /// Adds the leg that plan_motion finds; false with the reason.
  bool plan_leg(const Workspace& ws, const std::string& name, const JointMatrix& from,
                const JointMatrix& to, SamplingStatus otherwise);
  /// Adds a leg that may touch the scene by its tip; false where it touches more.
  bool add_in_bottom(std::size_t leg, const std::string& name, TimedMotion motion);
  void add_leg(const std::string& name, TimedMotion motion);

  Vec3 target_;
  SamplingOptions options_;
  SamplingSite site_;
  Workspace empty_;   ///< with the tool
  Workspace loaded_;  ///< and with the sample
  MotionLimits limits_;
  std::vector<double> start_, transport_;
  SamplingStatus status_ = SamplingStatus::kPlanned;
  std::string reason_;
  TimedMotion down_;  ///< from before contact to the depth
  std::vector<SamplingLeg> legs_;
  double end_ = 0.0;     ///< of the last leg [s]
  int checks_left_ = 0;  ///< of max_checks
};

}  // namespace bathyal::workspace
