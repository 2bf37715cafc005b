// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/arm.hpp"

#include <gtest/gtest.h>

namespace bathyal {
namespace {

Joint joint(int coordinate, double multiplier = 1.0) {
  Joint joint;
  joint.name = std::to_string(coordinate);
  joint.coordinate = coordinate;
  joint.multiplier = multiplier;
  return joint;
}

TEST(Arm, LimitsOfAFollowerBoundItsLeader) {
  Joint leader = joint(0);
  leader.lower = -1.0;
  leader.upper = 1.0;
  Joint follower = joint(0, -2.0);
  follower.lower = -1.0;
  follower.upper = 4.0;
  const Arm arm("two", {leader, follower});
  EXPECT_EQ(arm.size(), 1);
  EXPECT_EQ(arm.lower()[0], -1.0);
  EXPECT_EQ(arm.upper()[0], 0.5);
}

TEST(Arm, RefusesWhatIsNoArm) {
  EXPECT_THROW(Arm("none", {}), std::invalid_argument);
  EXPECT_THROW(Arm("skips", {joint(1)}), std::invalid_argument);
  Joint crossed = joint(0);
  crossed.lower = 1.0;
  crossed.upper = 0.0;
  EXPECT_THROW(Arm("crossed", {crossed}), std::invalid_argument);
  Arm arm("one", {joint(0)});
  Pose skewed = Pose::Identity();
  skewed.linear()(0, 1) = 0.1;
  EXPECT_THROW(arm.set_tool(skewed), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
