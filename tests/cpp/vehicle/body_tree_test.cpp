// SPDX-License-Identifier: BSD-3-Clause
// Trees of bodies against a dense reference by Kane's method, and what a free tree conserves.
#include "bathyal/vehicle/tree/body_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "bathyal/vehicle/presets.hpp"
#include "bathyal/vehicle/tree/simulate_tree.hpp"

namespace bathyal {
namespace {

class Draw {
 public:
  explicit Draw(unsigned seed) : source_(seed) {}
  double number() { return std::uniform_real_distribution<double>(-1.0, 1.0)(source_); }
  Vec3 vec3(double size = 1.0) { return size * Vec3(number(), number(), number()); }
  Vec6 vec6(double size = 1.0) {
    Vec6 v;
    v << vec3(size), vec3(size);
    return v;
  }
  Mat6 positive(double size) {
    Mat6 part;
    for (int j = 0; j < 6; ++j) part.col(j) = vec6();
    return size * part * part.transpose();
  }
  Pose pose(double size = 0.4) {
    Pose pose = Pose::Identity();
    pose.linear() = Eigen::AngleAxisd(3.0 * number(), vec3().normalized()).toRotationMatrix();
    pose.translation() = vec3(size);
    return pose;
  }
  RigidBody body(double mass) {
    const Eigen::Matrix3d spread = positive(0.05 * mass).topLeftCorner<3, 3>();
    return {mass, vec3(0.1), spread.trace() * Eigen::Matrix3d::Identity() - spread, 0.8e-3 * mass,
            vec3(0.1)};
  }

 private:
  std::mt19937 source_;
};

/// Six links, the last two on a branch of their own, the first of these fixed; the third slides.
BodyTreeOptions any_tree(unsigned seed, bool water) {
  Draw draw(seed);
  BodyTreeOptions options;
  options.vehicle.body = draw.body(12.0);
  options.vehicle.body.center_of_buoyancy = Vec3::Zero();
  if (water) options.vehicle.added_mass = draw.positive(2.0);
  if (water) options.vehicle.linear_drag = draw.positive(3.0);
  for (const int parent : {-1, 0, 1, 2, 1, 4}) {
    TreeLink link;
    link.parent = parent;
    link.joint = options.links.size() == 2 ? TreeJoint::kPrismatic : TreeJoint::kRevolute;
    link.parent_from_link = draw.pose();
    link.axis = draw.vec3();
    link.body = draw.body(2.0);
    if (water) {
      link.added_mass = draw.positive(0.5);
      link.strips = {{draw.vec3(0.2), draw.vec3().normalized(), 6.0},
                     {draw.vec3(0.2), draw.vec3().normalized(), 9.0}};
    }
    options.links.push_back(link);
  }
  options.links[4].joint = TreeJoint::kFixed;
  options.tip = draw.vec3(0.3);
  return options;
}

BodyTreeState any_state(unsigned seed, std::size_t joints) {
  Draw draw(seed + 100);
  BodyTreeState state;
  state.base = {draw.pose(), draw.vec6(0.7)};
  for (std::size_t k = 0; k < joints; ++k) {
    state.q.push_back(3.0 * draw.number());
    state.rate.push_back(1.5 * draw.number());
  }
  return state;
}

TreeLoads any_loads(unsigned seed, std::size_t joints) {
  Draw draw(seed + 200);
  TreeLoads loads;
  loads.wrench = draw.vec6(10.0);
  loads.tip_wrench = draw.vec6(5.0);
  loads.flow = {draw.vec3(0.4), draw.vec3(0.3)};
  for (std::size_t k = 0; k < joints; ++k) loads.joints.push_back(k == 4 ? 0.0 : draw.number());
  return loads;
}

/// (6, 6) that takes a velocity of the hull to that of a frame at `hull_from`.
Mat6 moved(const Pose& hull_from) {
  Mat6 matrix = Mat6::Zero();
  const Eigen::Matrix3d back = hull_from.linear().transpose();
  for (int i = 0; i < 3; ++i) {
    matrix.block<3, 1>(0, i) = back.col(i);
    matrix.block<3, 1>(0, 3 + i) = back * Vec3(Vec3::Unit(i).cross(hull_from.translation()));
    matrix.block<3, 1>(3, 3 + i) = back.col(i);
  }
  return matrix;
}

std::vector<Pose> placed(const BodyTreeOptions& options, const Eigen::VectorXd& q) {
  std::vector<Pose> hull_from;
  for (std::size_t k = 0; k < options.links.size(); ++k) {
    const TreeLink& link = options.links[k];
    Pose joint = Pose::Identity();
    const Vec3 axis = link.axis.normalized();
    const double value = q[static_cast<Index>(k)];
    if (link.joint == TreeJoint::kRevolute) {
      joint.linear() = Eigen::AngleAxisd(value, axis).toRotationMatrix();
    } else if (link.joint == TreeJoint::kPrismatic) {
      joint.translation() = value * axis;
    }
    const Pose own = link.parent_from_link * joint;
    hull_from.push_back(link.parent < 0 ? own
                                        : hull_from[static_cast<std::size_t>(link.parent)] * own);
  }
  return hull_from;
}

/// Velocity of each link by that of hull and joints, the joints' columns from the axes of all
/// joints between.
std::vector<Eigen::MatrixXd> jacobians(const BodyTreeOptions& options, const Eigen::VectorXd& q) {
  const std::vector<Pose> hull_from = placed(options, q);
  std::vector<Eigen::MatrixXd> all;
  for (std::size_t k = 0; k < options.links.size(); ++k) {
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(6, 6 + q.size());
    own.leftCols<6>() = moved(hull_from[k]);
    for (int j = static_cast<int>(k); j >= 0;
         j = options.links[static_cast<std::size_t>(j)].parent) {
      const auto at = static_cast<std::size_t>(j);
      const Vec3 axis = options.links[at].axis.normalized();
      const Pose link_from_joint = hull_from[k].inverse() * hull_from[at];
      const Vec3 along = link_from_joint.linear() * axis;
      if (options.links[at].joint == TreeJoint::kRevolute) {
        own.block<3, 1>(0, 6 + j) = -along.cross(link_from_joint.translation());
        own.block<3, 1>(3, 6 + j) = along;
      } else if (options.links[at].joint == TreeJoint::kPrismatic) {
        own.block<3, 1>(0, 6 + j) = along;
      }
    }
    all.push_back(own);
  }
  return all;
}

struct Dense {
  Eigen::MatrixXd mass;
  Eigen::VectorXd force;  // mass · du/dt less the joints' efforts
};

/// Kane's equations: Σ Jᵀ (force − M J̇ u) = Σ Jᵀ M J du/dt, J̇ by differences of sixth order.
Dense dense(const BodyTree& tree, const BodyTreeState& state, const TreeLoads& loads) {
  const BodyTreeOptions& options = tree.options();
  const auto n = static_cast<Index>(tree.size());
  const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(state.q.data(), n);
  const Eigen::VectorXd rate = Eigen::Map<const Eigen::VectorXd>(state.rate.data(), n);
  Eigen::VectorXd u(6 + n);
  u << state.base.velocity, rate;
  Dense sum{Eigen::MatrixXd::Zero(6 + n, 6 + n), Eigen::VectorXd::Zero(6 + n)};
  sum.mass.topLeftCorner<6, 6>() = tree.vehicle().mass_matrix();
  sum.force.head<6>() = tree.vehicle().mass_matrix() *
                        tree.vehicle().acceleration(state.base, loads.wrench, loads.flow);
  const auto at = jacobians(options, q);
  const std::vector<Pose> hull_from = placed(options, q);
  constexpr double kStep = 4e-3;
  const std::array<double, 3> weights{45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0};
  std::vector<Eigen::MatrixXd> slopes(at.size(), Eigen::MatrixXd::Zero(6, 6 + n));
  for (int i = 0; i < 3; ++i) {
    const auto ahead = jacobians(options, q + (i + 1) * kStep * rate);
    const auto behind = jacobians(options, q - (i + 1) * kStep * rate);
    for (std::size_t k = 0; k < at.size(); ++k) {
      slopes[k] += weights[static_cast<std::size_t>(i)] / kStep * (ahead[k] - behind[k]);
    }
  }
  for (std::size_t k = 0; k < at.size(); ++k) {
    const TreeLink& link = options.links[k];
    const Vec6 velocity = at[k] * u;
    const Eigen::Matrix3d link_from_world =
        (state.base.world_from_vehicle.linear() * hull_from[k].linear()).transpose();
    Vec6 flow = Vec6::Zero(), flow_change = Vec6::Zero();
    flow.head<3>() = link_from_world * loads.flow.velocity;
    const Vec3 pushed = link_from_world * loads.flow.acceleration;
    flow_change.head<3>() = pushed - Vec3(velocity.tail<3>()).cross(Vec3(flow.head<3>()));
    const Vec6 through = velocity - flow;
    const Mat6 rigid = mass_matrix(link.body);
    Vec6 force = link.added_mass * flow_change - coriolis(link.added_mass, through) -
                 coriolis(rigid, velocity);
    for (const DragStrip& strip : link.strips) {
      Pose at_strip = Pose::Identity();
      at_strip.linear().col(2) = strip.axis;
      at_strip.linear().col(0) = strip.axis.unitOrthogonal();
      at_strip.linear().col(1) = strip.axis.cross(at_strip.linear().col(0));
      at_strip.translation() = strip.center;
      const Mat6 to_strip = moved(at_strip);
      const Vec6 past = to_strip * through;
      Vec6 push = Vec6::Zero();
      push.head<2>() = -strip.coefficient * past.head<2>().norm() * past.head<2>();
      force += to_strip.transpose() * push;
    }
    const Vec3 down = -link_from_world.col(2);
    const double gravity = options.vehicle.gravity, density = options.vehicle.water_density;
    const Vec3 weight = link.body.mass * gravity * down;
    const Vec3 lift = density * link.body.volume * (pushed - gravity * down);
    force.head<3>() += weight + lift;
    force.tail<3>() +=
        link.body.center_of_mass.cross(weight) + link.body.center_of_buoyancy.cross(lift);
    if (k + 1 == at.size()) {
      const Eigen::Matrix3d back = hull_from[k].linear().transpose();
      const Vec3 push = back * loads.tip_wrench.head<3>();
      force.head<3>() += push;
      force.tail<3>() += back * loads.tip_wrench.tail<3>() + options.tip.cross(push);
    }
    const Mat6 mass = rigid + link.added_mass;
    sum.mass += at[k].transpose() * mass * at[k];
    sum.force += at[k].transpose() * (force - mass * (slopes[k] * u));
  }
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Index row = 6 + static_cast<Index>(k);
    if (options.links[k].joint == TreeJoint::kFixed) sum.mass(row, row) = 1.0;  // to be solved
  }
  return sum;
}

class TreeOf : public testing::TestWithParam<unsigned> {};

TEST_P(TreeOf, EffortsGiveTheDenseReferencesAccelerations) {
  for (const bool water : {false, true}) {
    const BodyTree tree(any_tree(GetParam(), water));
    const BodyTreeState state = any_state(GetParam(), tree.size());
    const TreeLoads loads = any_loads(GetParam(), tree.size());
    Dense reference = dense(tree, state, loads);
    reference.force.tail(6) += Eigen::Map<const Eigen::VectorXd>(loads.joints.data(), 6);
    const Eigen::VectorXd expected = reference.mass.ldlt().solve(reference.force);
    TreeAcceleration found;
    tree.accelerations(state, loads, found);
    const double size = expected.cwiseAbs().maxCoeff();
    EXPECT_LT((found.base - expected.head<6>()).norm(), 1e-10 * size);
    for (Index k = 0; k < 6; ++k) {
      EXPECT_NEAR(found.joints[static_cast<std::size_t>(k)], expected[6 + k], 1e-10 * size);
    }
  }
}

TEST_P(TreeOf, MotionsGiveTheDenseReferencesEfforts) {
  const BodyTree tree(any_tree(GetParam(), true));
  const BodyTreeState state = any_state(GetParam(), tree.size());
  TreeLoads loads = any_loads(GetParam(), tree.size());
  loads.drive = JointDrive::kAcceleration;
  const Dense reference = dense(tree, state, loads);
  Eigen::VectorXd expected(12);
  expected.tail<6>() = Eigen::Map<const Eigen::VectorXd>(loads.joints.data(), 6);
  const Eigen::VectorXd pulled = reference.mass.topRightCorner<6, 6>() * expected.tail<6>();
  expected.head<6>() =
      reference.mass.topLeftCorner<6, 6>().ldlt().solve(reference.force.head<6>() - pulled);
  const Eigen::VectorXd efforts = (reference.mass * expected - reference.force).tail<6>();
  TreeAcceleration found;
  tree.accelerations(state, loads, found);
  EXPECT_LT((found.base - expected.head<6>()).norm(), 1e-10 * expected.norm());
  for (Index k = 0; k < 6; ++k) {
    EXPECT_NEAR(found.efforts[static_cast<std::size_t>(k)], efforts[k], 1e-10 * efforts.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, TreeOf, testing::Values(1u, 2u, 3u, 4u));

BodyTreeOptions undamped(unsigned seed) {
  BodyTreeOptions options = any_tree(seed, true);
  options.vehicle.linear_drag.setZero();
  for (TreeLink& link : options.links) {
    link.strips.clear();
  }
  return options;
}

TreeMotionRecord two_seconds(const BodyTree& tree) {
  SimulateTreeOptions how;
  how.duration = 2.0;
  how.step = 5e-4;
  return simulate_tree(tree, any_state(1, tree.size()), {}, {}, how);
}

TEST(FreeTree, KeepsMomentumAndEnergyWithoutGravity) {
  BodyTreeOptions options = undamped(1);
  options.vehicle.gravity = 0.0;
  const BodyTree tree(options);
  const TreeMotionRecord run = two_seconds(tree);
  const Momentum first = tree.momentum(run.state.front()), last = tree.momentum(run.state.back());
  EXPECT_LT((last - first).norm(), 1e-8 * first.norm());
  const double energy = tree.kinetic_energy(run.state.front());
  EXPECT_NEAR(tree.kinetic_energy(run.state.back()), energy, 1e-8 * energy);
  EXPECT_GT(std::abs(run.state.back().q[0] - run.state.front().q[0]), 0.1);  // it does move
}

TEST(FreeTree, KeepsEnergyUnderGravity) {
  const BodyTree tree(undamped(2));
  const TreeMotionRecord run = two_seconds(tree);
  const auto energy = [&](const BodyTreeState& state) {
    return tree.kinetic_energy(state) + tree.potential_energy(state);
  };
  const double scale = tree.kinetic_energy(run.state.front());
  EXPECT_NEAR(energy(run.state.back()), energy(run.state.front()), 1e-8 * scale);
  EXPECT_GT(std::abs(tree.kinetic_energy(run.state.back()) - scale), 0.01 * scale);
}

TEST(Tree, WithoutLinksIsTheVehicle) {
  const BodyTree tree({bluerov2_heavy(), {}, Vec3::Zero()});
  const BodyTreeState state = any_state(3, 0);
  const TreeLoads loads = any_loads(3, 0);
  TreeAcceleration found;
  tree.accelerations(state, loads, found);
  const Vec6 expected =
      tree.vehicle().acceleration(state.base, loads.wrench + loads.tip_wrench, loads.flow);
  EXPECT_LT((found.base - expected).norm(), 1e-12 * expected.norm());
}

TEST(Tree, IsCarriedByACurrentAsInAFrameThatMoves) {
  const BodyTree tree(any_tree(5, true));
  BodyTreeState state = any_state(5, tree.size());
  TreeLoads loads;
  TreeAcceleration still, carried;
  tree.accelerations(state, loads, still);
  loads.flow.velocity = Vec3(0.3, -0.2, 0.1);
  const Eigen::Matrix3d back = state.base.world_from_vehicle.linear().transpose();
  const Vec3 current = back * loads.flow.velocity;
  state.base.velocity.head<3>() += current;
  tree.accelerations(state, loads, carried);
  const Vec3 turned = Vec3(state.base.velocity.tail<3>()).cross(current);  // of components alone
  EXPECT_LT((carried.base.head<3>() - still.base.head<3>() + turned).norm(), 1e-10);
  EXPECT_LT((carried.base.tail<3>() - still.base.tail<3>()).norm(), 1e-10);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(carried.joints[k], still.joints[k], 1e-9);
}

TEST(Tree, CarriesOutAMotion) {
  const BodyTree tree(any_tree(6, true));
  const auto swing = [](double time, TreeJointMotion& motion) {
    motion.q.assign(6, 0.3 * std::sin(2.0 * time));
    motion.rate.assign(6, 0.6 * std::cos(2.0 * time));
    motion.acceleration.assign(6, -1.2 * std::sin(2.0 * time));
  };
  SimulateTreeOptions how;
  how.duration = 1.0;
  how.step = 2e-3;
  const TreeMotionRecord run = simulate_tree(tree, tree.rest(), {}, swing, how);
  EXPECT_NEAR(run.state.back().q[3], 0.3 * std::sin(2.0), 1e-12);
  // Efforts that were found carry the same motion out.
  TreeLoads loads;
  loads.drive = JointDrive::kAcceleration;
  loads.joints.assign(6, -1.2 * std::sin(2.0));
  TreeAcceleration held, free;
  tree.accelerations(run.state.back(), loads, held);
  loads.drive = JointDrive::kEffort;
  loads.joints = held.efforts;
  tree.accelerations(run.state.back(), loads, free);
  EXPECT_LT((free.base - held.base).norm(), 1e-9 * held.base.norm());
}

void expect_refused(const BodyTreeOptions& options, const std::string& field) {
  try {
    options.check();
    ADD_FAILURE() << field << " was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
  }
}

TEST(Tree, RefusesAJointThatMovesNothing) {
  BodyTreeOptions options{bluerov2_heavy(), {TreeLink{}}, Vec3::Zero()};
  const BodyTree tree(options);
  TreeAcceleration found;
  EXPECT_THROW(tree.accelerations(tree.rest(), {}, found), std::invalid_argument);
  TreeLoads loads;
  loads.drive = JointDrive::kAcceleration;
  EXPECT_NO_THROW(tree.accelerations(tree.rest(), loads, found));
}

TEST(Tree, RefusesBadInputByName) {
  BodyTreeOptions options = any_tree(1, true);
  options.links[2].parent = 4;
  expect_refused(options, "link 2 parent");
  options = any_tree(1, true);
  options.links[1].axis.setZero();
  expect_refused(options, "link 1 axis");
  options = any_tree(1, true);
  options.links[1].added_mass(0, 1) += 1.0;
  expect_refused(options, "link 1 added_mass");
  options = any_tree(1, true);
  options.links.assign(40, options.links[0]);
  expect_refused(options, "links");
  const BodyTree tree(any_tree(1, true));
  BodyTreeState state = tree.rest();
  state.q.pop_back();
  TreeAcceleration found;
  EXPECT_THROW(tree.accelerations(state, {}, found), std::invalid_argument);
  SimulateTreeOptions how;
  how.duration = 10.0;
  how.step = 5.0;
  EXPECT_THROW(simulate_tree(tree, tree.rest(), {}, {}, how), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
