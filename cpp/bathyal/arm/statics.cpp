// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/statics.hpp"

#include <string>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kTorqueGrain = 256;  ///< poses of one task

/// Force and its moment about the origin of the arm's base.
struct Load {
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();

  void add(const Vec3& more, const Vec3& place) {
    force += more;
    moment += place.cross(more);
  }
};

/// What the drives of `arm` hold against `pull`, on everything behind them, from the tool inward.
class Balance {
 public:
  Balance(const Arm& arm, const StaticsOptions& options) : arm_(arm), options_(options) {
    // About the base's origin: moments keep their digits in survey coordinates.
    arm_.set_base(Pose(arm.base().linear()));
    gravity_ = arm.base().linear() * options.gravity;
  }

  /// `wrench`: of the tool on its surroundings, or null. Adds to `torque`, size() numbers.
  void solve(std::span<const double> q, const double* wrench, double* torque) {
    compute_row_frames(arm_, q, frames_);
    const Pose& tool = frames_.world_from_tool;
    Load load;
    if (wrench != nullptr) {
      const bool turned = options_.frame == TipFrame::kTool;
      const Eigen::Matrix3d axes =
          turned ? Eigen::Matrix3d(tool.linear()) : Eigen::Matrix3d::Identity();
      load.add(-(axes * Eigen::Map<const Vec3>(wrench)), tool.translation());
      load.moment -= axes * Eigen::Map<const Vec3>(wrench + 3);
    }
    add_body(tool, options_.payload, load);
    for (std::size_t k = arm_.joints().size(); k-- > 0;) {
      const Link& link = arm_.links()[k + 1];
      add_body(frames_.world_from_row[k + 1] * link.row_from_link, link.body, load);
      hold(arm_.joints()[k], frames_.world_from_row[k], load, torque);
    }
  }

 private:
  void add_body(const Pose& frame, const RigidBody& body, Load& load) const {
    load.add(body.mass * gravity_, frame * body.center_of_mass);
    load.add(-options_.water_density * body.volume * gravity_, frame * body.center_of_buoyancy);
  }

  static void hold(const Joint& joint, const Pose& frame, const Load& load, double* torque) {
    if (joint.type == JointType::kFixed) return;
    const Vec3 axis = frame.linear().col(2);
    const Vec3 moment = load.moment - frame.translation().cross(load.force);
    const double pull = axis.dot(joint.type == JointType::kRevolute ? moment : load.force);
    torque[joint.coordinate] -= joint.multiplier * pull;
  }

  Arm arm_;
  const StaticsOptions& options_;
  Vec3 gravity_;
  RowFrames frames_;
};

}  // namespace

void StaticsOptions::check() const {
  if (!gravity.allFinite()) throw_argument("gravity", "finite numbers", "nan or inf");
  check_not_negative("water_density", water_density);
  check_not_negative("payload", payload.mass);
  check_not_negative("payload_volume", payload.volume);
  if (!payload.center_of_mass.allFinite() || !payload.center_of_buoyancy.allFinite()) {
    throw_argument("payload_center", "finite numbers", "nan or inf");
  }
}

std::vector<double> statics(const Arm& arm, JointView q, Wrenches wrenches,
                            const StaticsOptions& options) {
  check_joint_values(arm, q);
  options.check();
  if (wrenches.rows() > 1 && wrenches.rows() != q.rows()) {
    throw_argument("wrench", "one, or " + std::to_string(q.rows()) + ", one a pose",
                   std::to_string(wrenches.rows()));
  }
  if (!wrenches.allFinite()) throw_argument("wrench", "finite numbers", "nan or inf");
  const std::size_t size = static_cast<std::size_t>(arm.size());
  std::vector<double> torques(static_cast<std::size_t>(q.rows()) * size);
  const std::size_t wrench_step = wrenches.rows() > 1 ? 6 : 0;
  const double* wrench = wrenches.rows() > 0 ? wrenches.data() : nullptr;
  parallel_for(static_cast<std::size_t>(q.rows()), kTorqueGrain, options.num_threads,
               [&](std::size_t begin, std::size_t end) {
                 Balance balance(arm, options);
                 for (std::size_t i = begin; i < end; ++i) {
                   balance.solve({q.data() + i * size, size},
                                 wrench == nullptr ? nullptr : wrench + i * wrench_step,
                                 torques.data() + i * size);
                 }
               });
  return torques;
}

}  // namespace bathyal
