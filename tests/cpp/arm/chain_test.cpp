// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3 random_vector(RandomStream& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

Eigen::Matrix3d random_rotation(RandomStream& random) {
  return Eigen::AngleAxisd(random.uniform(-kPi, kPi), random_vector(random, 1.0).normalized())
      .toRotationMatrix();
}

/// What a designer would draw, and what a parser hands on: right angles, parallel, coincident and
/// intersecting axes, axes askew by a hair, and anything at all.
Pose random_origin(RandomStream& random) {
  Pose pose = Pose::Identity();
  switch (random.next() % 6) {
    case 0:  // nothing between them
      break;
    case 1:  // along an axis
      pose.translation() = Vec3::Unit(static_cast<Index>(random.next() % 3)) * 0.3;
      break;
    case 2:  // a right angle
      pose.linear() = Eigen::AngleAxisd(kPi / 2, Vec3::Unit(static_cast<Index>(random.next() % 3)))
                          .toRotationMatrix();
      pose.translation() = random_vector(random, 1.0);
      break;
    case 3:  // askew by a hair, perhaps turned over
      pose.linear() =
          (Eigen::AngleAxisd(random.uniform(-1e-4, 1e-4), random_vector(random, 1.0).normalized()) *
           Eigen::AngleAxisd(random.next() % 2 == 0 ? 0.0 : kPi, Vec3::UnitX()))
              .toRotationMatrix();
      pose.translation() = random_vector(random, 1.0);
      break;
    default:
      pose.linear() = random_rotation(random);
      pose.translation() = random_vector(random, 1.0);
  }
  return pose;
}

Vec3 random_axis(RandomStream& random) {
  if (random.next() % 2 == 0) {
    return Vec3::Unit(static_cast<Index>(random.next() % 3)) * (random.next() % 2 == 0 ? 1 : -1);
  }
  return random_vector(random, 3.0);
}

Link random_link(RandomStream& random, const std::string& name) {
  Link link;
  link.name = name;
  if (random.next() % 4 == 0) return link;
  link.body.mass = random.uniform(0.1, 5.0);
  link.body.center_of_mass = random_vector(random, 0.2);
  const Eigen::Matrix3d turn = random_rotation(random);
  link.body.inertia = turn * Vec3(0.1, 0.2, 0.25).asDiagonal() * turn.transpose();
  link.body.volume = random.uniform(0.0, 0.01);
  link.body.center_of_buoyancy = random_vector(random, 0.2);
  return link;
}

JointChain random_chain(std::uint64_t seed) {
  RandomStream random(seed);
  JointChain chain;
  chain.name = "random";
  const int count = 1 + static_cast<int>(random.next() % 9);
  chain.links.push_back({random_link(random, "link 0"), {}});
  int coordinates = 0;
  for (int k = 0; k < count; ++k) {
    ChainJoint joint;
    joint.joint.name = std::to_string(k);
    joint.parent_from_joint = random_origin(random);
    joint.axis = random_axis(random);
    const auto kind = random.next() % 6;
    joint.joint.type = kind == 0   ? JointType::kFixed
                       : kind == 1 ? JointType::kPrismatic
                                   : JointType::kRevolute;
    if (k + 1 == count && coordinates == 0) joint.joint.type = JointType::kRevolute;
    if (joint.joint.type != JointType::kFixed) {
      if (coordinates > 0 && random.next() % 5 == 0) {
        joint.joint.coordinate = 0;
        joint.joint.multiplier = -0.5;
        joint.joint.offset = 0.25;
      } else {
        joint.joint.coordinate = coordinates++;
      }
    }
    chain.joints.push_back(joint);
    ChainLink link{random_link(random, "link " + std::to_string(k + 1)), {}};
    if (random.next() % 3 == 0) {
      link.attached.push_back({random_origin(random), random_link(random, "attached")});
    }
    chain.links.push_back(link);
  }
  return chain;
}

/// base_from_link for every link, by the URDF's own product.
std::vector<Pose> chain_frames(const JointChain& chain, const std::vector<double>& q) {
  std::vector<Pose> frames{Pose::Identity()};
  for (const ChainJoint& joint : chain.joints) {
    Pose motion = Pose::Identity();
    const double value = joint_value(joint.joint, q);
    if (joint.joint.type == JointType::kRevolute) {
      motion.linear() = Eigen::AngleAxisd(value, joint.axis.normalized()).toRotationMatrix();
    } else if (joint.joint.type == JointType::kPrismatic) {
      motion.translation() = value * joint.axis.normalized();
    }
    frames.push_back(frames.back() * joint.parent_from_joint * motion);
  }
  return frames;
}

std::vector<double> random_q(const Arm& arm, std::uint64_t seed) {
  RandomStream random(seed, 1);
  std::vector<double> q;
  for (Index k = 0; k < arm.size(); ++k) q.push_back(random.uniform(-3.0, 3.0));
  return q;
}

double difference(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

/// Every link, every frame on a link and the flange of the arm are where the chain has them.
void expect_same_motion(const JointChain& chain, const Arm& arm, double tolerance) {
  for (std::uint64_t draw = 0; draw < 3; ++draw) {
    const std::vector<double> q = random_q(arm, draw);
    const std::vector<Pose> expected = chain_frames(chain, q);
    const RowFrames frames = row_frames(arm, q);
    EXPECT_LE(difference(frames.world_from_tool, expected.back()), tolerance);
    std::size_t found = 0;
    for (std::size_t k = 0; k < arm.links().size(); ++k) {
      const Link& link = arm.links()[k];
      const Pose world_from_link = frames.world_from_row[k] * link.row_from_link;
      for (std::size_t j = 0; j < chain.links.size(); ++j) {
        const std::string& name = chain.links[j].link.name;
        if (name.empty()) continue;
        if (name == link.name) {
          EXPECT_LE(difference(world_from_link, expected[j]), tolerance) << name;
          ++found;
        }
        for (const Frame& frame : link.frames) {
          if (frame.name != name) continue;
          EXPECT_LE(difference(world_from_link * frame.link_from_frame, expected[j]), tolerance);
          ++found;
        }
      }
    }
    EXPECT_EQ(found, static_cast<std::size_t>(std::count_if(
                         chain.links.begin(), chain.links.end(),
                         [](const ChainLink& link) { return !link.link.name.empty(); })));
  }
}

TEST(ArmFromChain, MovesAsTheChainDoes) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const JointChain chain = random_chain(seed);
    expect_same_motion(chain, arm_from_chain(chain), 1e-13);
  }
}

TEST(ArmFromChain, NearlyParallelAxesTakeHayatisRow) {
  for (const double angle : {0.0, 1e-9, 0.09, 0.11, kPi - 0.09, kPi - 0.11, kPi}) {
    JointChain chain;
    chain.joints.resize(2);
    chain.links.resize(3);
    for (int k = 0; k < 2; ++k) chain.joints[static_cast<std::size_t>(k)].joint.coordinate = k;
    chain.joints[1].parent_from_joint.translation() = Vec3(0.4, 0.0, 0.2);
    chain.joints[1].parent_from_joint.linear() =
        Eigen::AngleAxisd(angle, Vec3(1.0, 1.0, 0.0).normalized()).toRotationMatrix();
    const Arm arm = arm_from_chain(chain);
    const DhRow& row = arm.joints()[0].row;
    EXPECT_EQ(row.d == 0.0, std::sin(angle) < kNearlyParallel) << angle;
    EXPECT_TRUE(row.d == 0.0 || row.beta == 0.0) << angle;
    expect_same_motion(chain, arm, 1e-14);
  }
}

TEST(ArmFromChain, GivesAPlainTableOnRequest) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    JointChain chain = random_chain(seed);
    const Arm arm = arm_from_chain(chain, {0.0});
    double longest = 1.0;
    for (const Joint& joint : arm.joints()) {
      EXPECT_LE(std::abs(joint.row.beta), 1e-15);
      longest = std::max({longest, std::abs(joint.row.d), std::abs(joint.row.a)});
    }
    expect_same_motion(chain, arm, 1e-13 * longest);
  }
  EXPECT_THROW(arm_from_chain(random_chain(0), {-1.0}), std::invalid_argument);
  EXPECT_THROW(arm_from_chain(random_chain(0), {std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
}

TEST(ArmFromChain, FindsTheTableAMakerWouldWrite) {
  // The shoulder and elbow of a UR10e as its URDF has them.
  JointChain chain;
  chain.joints.resize(3);
  chain.links.resize(4);
  for (int k = 0; k < 3; ++k) chain.joints[static_cast<std::size_t>(k)].joint.coordinate = k;
  chain.joints[0].parent_from_joint.translation().z() = 0.1807;
  chain.joints[1].parent_from_joint.linear() =
      Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()).toRotationMatrix();
  chain.joints[2].parent_from_joint.translation().x() = -0.6127;
  const Arm arm = arm_from_chain(chain);
  EXPECT_EQ(arm.root().matrix(), Eigen::Matrix4d::Identity());
  const DhRow& first = arm.joints()[0].row;
  EXPECT_DOUBLE_EQ(first.d, 0.1807);
  EXPECT_DOUBLE_EQ(first.alpha, kPi / 2);
  EXPECT_EQ(first.theta, 0.0);
  const DhRow& second = arm.joints()[1].row;
  EXPECT_DOUBLE_EQ(second.a, -0.6127);
  EXPECT_EQ(second.theta, 0.0);
  EXPECT_EQ(second.alpha, 0.0);
}

TEST(ArmFromChain, AddsUpWhatIsFixedTogether) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const JointChain chain = random_chain(seed);
    const Arm arm = arm_from_chain(chain);
    const std::vector<double> q = random_q(arm, seed);
    const std::vector<Pose> at = chain_frames(chain, q);
    double mass = 0.0, volume = 0.0, arm_mass = 0.0, arm_volume = 0.0;
    Vec3 moment = Vec3::Zero(), arm_moment = Vec3::Zero();
    Vec3 lift = Vec3::Zero(), arm_lift = Vec3::Zero();
    // About the base: what a rigid arm would weigh against being turned there.
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(), arm_inertia = inertia;
    const auto add = [](const Pose& from_link, const Link& link, double& m, double& v, Vec3& s,
                        Vec3& b, Eigen::Matrix3d& i) {
      const Vec3 c = from_link * link.body.center_of_mass;
      m += link.body.mass;
      v += link.body.volume;
      s += link.body.mass * c;
      b += link.body.volume * (from_link * link.body.center_of_buoyancy);
      i += from_link.linear() * link.body.inertia * from_link.linear().transpose() +
           link.body.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
    };
    for (std::size_t k = 0; k < chain.links.size(); ++k) {
      add(at[k], chain.links[k].link, mass, volume, moment, lift, inertia);
      for (const Attached& attached : chain.links[k].attached) {
        add(at[k] * attached.link_from_body, attached.body, mass, volume, moment, lift, inertia);
      }
    }
    const RowFrames frames = row_frames(arm, q);
    for (std::size_t k = 0; k < arm.links().size(); ++k) {
      add(frames.world_from_row[k] * arm.links()[k].row_from_link, arm.links()[k], arm_mass,
          arm_volume, arm_moment, arm_lift, arm_inertia);
    }
    EXPECT_NEAR(arm_mass, mass, 1e-12);
    EXPECT_NEAR(arm_volume, volume, 1e-12);
    EXPECT_LE((arm_moment - moment).norm(), 1e-10);
    EXPECT_LE((arm_lift - lift).norm(), 1e-10);
    EXPECT_LE((arm_inertia - inertia).norm(), 1e-9);
  }
}

/// Where the spheres of a link are, from its own frame.
std::vector<Vec3> places(const std::vector<Shape>& shapes, const Pose& from_link) {
  std::vector<Vec3> points;
  for (const Shape& shape : shapes)
    points.push_back(from_link * shape.body_from_shape.translation());
  return points;
}

TEST(ArmFromChain, KeepsShapesWhereTheyAre) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    JointChain chain = random_chain(seed);
    RandomStream random(seed);
    const auto add_shape = [&](Link& link) {
      Shape& shape = link.collision.emplace_back();
      shape.kind = ShapeKind::kSphere;
      shape.body_from_shape.translation() = random_vector(random, 0.3);
      link.visual = link.collision;
    };
    for (ChainLink& link : chain.links) {
      add_shape(link.link);
      for (Attached& attached : link.attached) add_shape(attached.body);
    }
    const Arm arm = arm_from_chain(chain);
    const std::vector<double> q = random_q(arm, seed);
    const std::vector<Pose> at = chain_frames(chain, q);
    std::vector<Vec3> expected, collision, visual, again;
    const auto append = [](std::vector<Vec3>& points, const std::vector<Vec3>& more) {
      points.insert(points.end(), more.begin(), more.end());
    };
    for (std::size_t k = 0; k < chain.links.size(); ++k) {
      append(expected, places(chain.links[k].link.collision, at[k]));
      for (const Attached& attached : chain.links[k].attached) {
        append(expected, places(attached.body.collision, at[k] * attached.link_from_body));
      }
    }
    const RowFrames frames = row_frames(arm, q);
    const JointChain back = chain_from_arm(arm);
    const std::vector<Pose> back_at = chain_frames(back, q);
    for (std::size_t k = 0; k < arm.links().size(); ++k) {
      const Pose from_link = frames.world_from_row[k] * arm.links()[k].row_from_link;
      append(collision, places(arm.links()[k].collision, from_link));
      append(visual, places(arm.links()[k].visual, from_link));
      append(again, places(back.links[k].link.collision, back_at[k]));
    }
    ASSERT_EQ(collision.size(), expected.size());
    ASSERT_EQ(visual.size(), expected.size());
    ASSERT_EQ(again.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_LE((collision[i] - expected[i]).norm(), 1e-12);
      EXPECT_LE((visual[i] - expected[i]).norm(), 1e-12);
      EXPECT_LE((again[i] - expected[i]).norm(), 1e-12);
    }
  }
}

TEST(ChainFromArm, MovesAsTheArmDoes) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const JointChain chain = random_chain(seed);
    const Arm arm = arm_from_chain(chain);
    const JointChain back = chain_from_arm(arm);
    expect_same_motion(back, arm_from_chain(back), 1e-13);
    const std::vector<double> q = random_q(arm, seed);
    EXPECT_LE(difference(chain_frames(back, q).back(), row_frames(arm, q).world_from_tool), 1e-13);
    // Links that came from a chain keep their frames; the flange is the one link more.
    ASSERT_EQ(back.links.size(), arm.links().size() + 1);
    for (std::size_t k = 0; k < arm.links().size(); ++k) {
      EXPECT_LE(difference(chain_frames(back, q)[k],
                           row_frames(arm, q).world_from_row[k] * arm.links()[k].row_from_link),
                1e-12);
    }
  }
}

TEST(ChainFromArm, KeepsRowsWhoseFramesLieBeyondTheAxis) {
  // A table as from a book: the frame after a row lies on the next axis, not on its own.
  Joint first, second;
  first.coordinate = 0;
  first.row = {0.3, kPi / 2, 0.1, 0.2, 0.0};
  second.coordinate = 1;
  second.row = {0.5, 0.01, 0.0, -0.4, 0.02};
  Link foot, upper, lower;
  upper.body.mass = 2.0;
  upper.body.center_of_mass = Vec3(-0.1, 0.0, 0.0);
  const Arm arm("table", {first, second}, {foot, upper, lower});
  const JointChain chain = chain_from_arm(arm);
  const std::vector<double> q{0.7, -1.1};
  EXPECT_LE(difference(chain_frames(chain, q).back(), row_frames(arm, q).world_from_tool), 1e-15);
  const Vec3 center = row_frames(arm, q).world_from_row[1] * upper.body.center_of_mass;
  const Vec3 back = chain_frames(chain, q)[1] * chain.links[1].link.body.center_of_mass;
  EXPECT_LE((center - back).norm(), 1e-15);
}

TEST(ArmFromChain, RefusesWhatIsNoChain) {
  JointChain chain;
  chain.joints.resize(1);
  chain.links.resize(2);
  chain.joints[0].joint.coordinate = 0;
  EXPECT_EQ(arm_from_chain(chain).size(), 1);
  JointChain bad = chain;
  bad.joints[0].axis.setZero();
  EXPECT_THROW(arm_from_chain(bad), std::invalid_argument);
  bad = chain;
  bad.joints[0].axis.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(arm_from_chain(bad), std::invalid_argument);
  bad = chain;
  bad.joints[0].parent_from_joint.linear() *= 1.1;
  EXPECT_THROW(arm_from_chain(bad), std::invalid_argument);
  bad = chain;
  bad.links.pop_back();
  EXPECT_THROW(arm_from_chain(bad), std::invalid_argument);
  bad = chain;
  bad.joints[0].joint.type = JointType::kFixed;
  EXPECT_THROW(arm_from_chain(bad), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
