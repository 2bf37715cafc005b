// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/statics.hpp"

#include <gtest/gtest.h>

#include "bathyal/arm/row_frames.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

const Wrenches kNone(nullptr, 0, 6);

TEST(Statics, AWeightHangsOnALever) {
  Arm arm = planar_arm();  // turned up: its plane is vertical
  arm.set_base(Pose(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX())));
  StaticsOptions options;
  options.gravity = Vec3(0.0, -9.80665, 0.0);  // in the base frame
  options.payload.mass = 2.0;
  const JointMatrix q = JointMatrix::Zero(1, 2);
  const std::vector<double> torque = statics(arm, view_of(q), kNone, options);
  EXPECT_NEAR(torque[0], 2.0 * 9.80665 * 0.9, 1e-12);
  EXPECT_NEAR(torque[1], 2.0 * 9.80665 * 0.4, 1e-12);
  options.payload.volume = 2.0 / options.water_density;  // it floats
  for (const double left : statics(arm, view_of(q), kNone, options)) EXPECT_NEAR(left, 0.0, 1e-12);
}

/// What the weights and buoyancies hold in store at q.
double energy(const Arm& arm, const JointMatrix& q, const StaticsOptions& options) {
  const RowFrames frames = row_frames(arm, {q.data(), static_cast<std::size_t>(q.size())});
  const Vec3 gravity = arm.base().linear() * options.gravity;
  const auto stored = [&](const Pose& frame, const RigidBody& body) {
    return -body.mass * gravity.dot(frame * body.center_of_mass) +
           options.water_density * body.volume * gravity.dot(frame * body.center_of_buoyancy);
  };
  double sum = stored(frames.world_from_tool, options.payload);
  for (std::size_t k = 0; k < arm.links().size(); ++k) {
    const Link& link = arm.links()[k];
    sum += stored(frames.world_from_row[k] * link.row_from_link, link.body);
  }
  return sum;
}

TEST(Statics, AreTheDerivativeOfTheEnergyAndJTransposed) {
  StaticsOptions options;
  options.gravity = Vec3(1.0, -2.0, -9.0);
  options.payload.mass = 3.0;
  options.payload.center_of_mass = Vec3(0.1, 0.2, -0.1);
  options.payload.volume = 1e-3;
  options.payload.center_of_buoyancy = Vec3(-0.1, 0.0, 0.2);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Arm arm = irregular_arm(seed);
    const JointMatrix q = random_poses(arm, 1, seed);
    const Eigen::Matrix<double, 1, 6, Eigen::RowMajor> push =
        (Eigen::Matrix<double, 1, 6>() << 5.0, -3.0, 2.0, 0.5, -0.4, 0.3).finished();
    for (const TipFrame frame : {TipFrame::kWorld, TipFrame::kTool}) {
      options.frame = frame;
      const std::vector<double> torque =
          statics(arm, view_of(q), Wrenches(push.data(), 1, 6), options);
      const std::vector<double> columns = jacobian(arm, view_of(q), frame);
      const JointView J(columns.data(), 6, arm.size());
      for (Index j = 0; j < arm.size(); ++j) {
        JointMatrix more = q, less = q;
        more(0, j) += 1e-5;
        less(0, j) -= 1e-5;
        const double slope = (energy(arm, more, options) - energy(arm, less, options)) / 2e-5;
        EXPECT_NEAR(torque[j], slope + J.col(j).dot(push.row(0)), 1e-7);
      }
    }
  }
}

TEST(Statics, SameForAnyThreadsAndFarFromTheOrigin) {
  Arm arm = irregular_arm(4);
  const JointMatrix q = random_poses(arm, 600, 5);
  StaticsOptions options;
  options.num_threads = 1;
  const std::vector<double> one = statics(arm, view_of(q), kNone, options);
  options.num_threads = 8;
  EXPECT_EQ(statics(arm, view_of(q), kNone, options), one);
  Pose far = arm.base();
  far.translation() = Vec3(6e5, 7.2e6, -50.0);
  arm.set_base(far);
  EXPECT_EQ(statics(arm, view_of(q), kNone, options), one);
}

TEST(Statics, Refusals) {
  const Arm arm = planar_arm();
  const JointMatrix q = JointMatrix::Zero(3, 2);
  const std::vector<double> pushes(12, 0.0);
  EXPECT_THROW(statics(arm, view_of(q), Wrenches(pushes.data(), 2, 6)), std::invalid_argument);
  const std::vector<double> broken(6, NAN);
  EXPECT_THROW(statics(arm, view_of(q), Wrenches(broken.data(), 1, 6)), std::invalid_argument);
  StaticsOptions options;
  options.water_density = -1.0;
  EXPECT_THROW(statics(arm, view_of(q), kNone, options), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
