// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm_subject.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bathyal/arm/dh.hpp"
#include "bathyal/arm/row_frames.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

Arm three_joints() {
  DhTable table;
  table.rows = {
      {0.1, std::numbers::pi / 2.0, 0.3, 0.0}, {0.5, 0.0, 0.0, 0.0}, {0.4, 0.0, 0.0, 0.0}};
  table.types.assign(3, JointType::kRevolute);
  return arm_from_dh(table);
}

/// Poses in which joint 1 moves by a third of a turn only, and has an error of two waves.
Tracked little_moved(double size) {
  const Arm arm = three_joints();
  Tracked out;
  out.q = RowMatrix(150, 3);
  out.position = RowMatrix(150, 3);
  for (Index i = 0; i < out.q.rows(); ++i) {
    RandomStream random(5, static_cast<std::uint64_t>(i));
    for (Index j = 0; j < 3; ++j) out.q(i, j) = random.uniform(-2.0, 2.0);
    out.q(i, 0) *= 0.5;
    Eigen::VectorXd q = out.q.row(i);
    q[0] += size * (std::cos(4.0 * q[0]) - std::sin(7.0 * q[0]));
    const RowFrames frames = row_frames(arm, {q.data(), 3});
    for (Index axis = 0; axis < 3; ++axis) {
      out.position(i, axis) = frames.world_from_tool.translation()[axis] + 1e-4 * random.normal();
    }
  }
  return out;
}

/// The largest value that a curve of twelve waves along joint 1 is fitted with.
double largest_value(double size) {
  const Arm arm = three_joints();
  const IdentifyOptions options;
  const Measurement measurement = to_measurement(arm, little_moved(size));
  ArmSubject subject(arm, measurement, {}, options, library_effects());
  for (int form = 0; form < static_cast<int>(subject.forms().size()); ++form) {
    const Form& about = subject.forms()[form];
    if (about.effect != "joint_map" || about.joint != 0) continue;
    const EffectVariant& variant = subject.variant(form);
    if (variant.parameters.size() < 20) continue;
    subject.settle({form});
    return subject.found().front().values.cwiseAbs().maxCoeff();
  }
  ADD_FAILURE() << "no curve of twelve waves";
  return 0.0;
}

TEST(ArmSubject, NumbersThatTheDataHardlyTellAreHeldToTheSizeOfTheOthers) {
  // Plausible are 2e-2 rad, and by themselves such waves over a third of a turn run up to that.
  EXPECT_LT(largest_value(1e-3), 4e-3);
  EXPECT_LT(largest_value(1e-4), 1e-3);
}

}  // namespace
}  // namespace bathyal
