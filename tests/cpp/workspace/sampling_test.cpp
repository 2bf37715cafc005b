// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bathyal/workspace/sampling/static_trim.hpp"
#include "bathyal/workspace/sampling/vehicle_wrench.hpp"
#include "scene/meshes.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

/// The arm of the paper, its reach 1.3 m; z of its foot upwards.
Arm paper_arm() {
  DhTable table;
  const double a[] = {0.193, 0.552, 0.596};
  const double alpha[] = {kPi / 2, 0, 0};
  const double d[] = {-0.117, 0, 0};
  for (int i = 0; i < 3; ++i) {
    table.rows.push_back({a[i], alpha[i], d[i], 0, 0});
    table.types.push_back(JointType::kRevolute);
  }
  DhArmOptions options;
  options.lower = {-kPi / 2, -kPi / 2, -0.75 * kPi};
  options.upper = {kPi / 2, kPi, 0.75 * kPi};
  const Arm plain = arm_from_dh(table, options);
  std::vector<Link> links = plain.links();
  for (std::size_t k = 0; k < links.size(); ++k) {
    links[k].name = "link_" + std::to_string(k);
    links[k].body.mass = 3.0;
    links[k].body.volume = 1.5e-3;
    links[k].body.center_of_mass = links[k].body.center_of_buoyancy = Vec3(-0.2, 0.0, 0.0);
  }
  return Arm("paper", plain.joints(), links, plain.root(), plain.flange());
}

/// Ground of 4 × 4 m about z = `level`, waved by `height`, cut into triangles of `cell`.
TriangleMesh ground(double level, double height = 0.0, double cell = 0.1) {
  const auto count = static_cast<int>(std::round(4.0 / cell)) + 1;
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const double x = -1.0 + cell * i, y = -2.0 + cell * j;
      points.push_back({x, y, level + height * std::sin(9.0 * x) * std::cos(7.0 * y)});
      if (i + 1 == count || j + 1 == count) continue;
      const int k = i * count + j;
      triangles.push_back({k, k + count, k + count + 1});
      triangles.push_back({k, k + count + 1, k + 1});
    }
  }
  PointMatrix vertices(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    vertices.row(static_cast<Index>(i)) << points[i][0], points[i][1], points[i][2];
  }
  TriangleMatrix faces(static_cast<Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    faces.row(static_cast<Index>(i)) << triangles[i][0], triangles[i][1], triangles[i][2];
  }
  return TriangleMesh(Points(std::move(vertices)), Triangles(std::move(faces)));
}

struct Site {
  Workspace workspace;
  Vec3 target;
  SamplingOptions options;
};

/// Over the ground, the vehicle away from the origin and turned. `place` is in the vehicle's frame,
/// its z that of the ground there.
Site site(const Arm& arm, const Pose& mount, const Vec3& place, double height, double radius) {
  Surroundings around;
  around.vehicle_from_base = mount;
  Pose vehicle = Pose(Eigen::Translation3d(0.2, -0.1, 3.0));
  around.world_from_vehicle = vehicle;
  around.capsules = capsules_of_rows(arm, std::vector<double>{radius});
  around.scene = Scene({ground(vehicle.translation().z() + place.z(), height)});
  around.hull = Hull(test::box(Vec3(0.4, 0.3, 0.2), Vec3(-0.6, 0.0, 0.3)));
  Site made{Workspace(arm, around), vehicle * place, {}};
  const RayHit hit = around.scene->cast(made.target + Vec3(0, 0, 1), -Vec3::UnitZ());
  made.target.z() += 1.0 - hit.range;
  made.options.sample.body.mass = 0.8;
  made.options.sample.body.volume = 4e-4;
  return made;
}

Site paper_site(double height = 0.0) {
  Site made = site(paper_arm(), Pose::Identity(), Vec3(0.75, 0.2, -0.8), height, 0.03);
  made.options.q_start = {0.0, -kPi / 4, 50.0 / 180.0 * kPi};
  return made;
}

Site panda_site(double height = 0.0) {
  const Pose hanging(Eigen::Translation3d(0, 0, -0.1) * Eigen::AngleAxisd(kPi, Vec3::UnitX()));
  Site made = site(panda(), hanging, Vec3(0.5, 0.1, -0.9), height, 0.04);
  made.options.q_start = {0, -0.8, 0, -2.4, 0, 1.7, 0.8};
  return made;
}

/// The whole plan row by row: rows of phases, those that two share once.
JointMatrix all_rows(const SamplingPlan& plan) {
  JointMatrix q(static_cast<Index>(plan.time.size()), plan.phases.front().q.cols());
  for (const SamplingPhase& phase : plan.phases) {
    q.middleRows(static_cast<Index>(phase.first), phase.q.rows()) = phase.q;
  }
  return q;
}

/// Everything that a plan promises, from the rows handed out.
void check_plan(const Site& made) {
  const SamplingOptions& options = made.options;
  const SamplingPlan plan = plan_sampling(made.workspace, made.target, options);
  ASSERT_EQ(plan.status, SamplingStatus::kPlanned) << plan.reason;
  ASSERT_EQ(plan.phases.size(), 5U);
  const char* names[] = {"approach", "press", "grab", "lift", "transport"};
  const Workspace empty = made.workspace.attach(options.tool.capsules, options.tool.body);
  const Workspace loaded = empty.attach(options.sample.capsules, options.sample.body);
  const Pose vehicle = made.workspace.surroundings().world_from_vehicle.at(0.0);
  EXPECT_LT((plan.contact - made.target).norm(), 1e-6);
  EXPECT_NEAR(plan.depth, std::min(options.depth, options.force_limit / options.stiffness), 1e-15);
  for (std::size_t i = 0; i < 5; ++i) {
    const SamplingPhase& phase = plan.phases[i];
    SCOPED_TRACE(phase.name);
    EXPECT_EQ(phase.name, names[i]);
    ASSERT_EQ(phase.q.rows(), static_cast<Index>(phase.time.size()));
    const Workspace& held = i < 3 ? empty : loaded;
    const TipContact contact = i > 0 && i < 4 ? TipContact::kAllowed : TipContact::kForbidden;
    EXPECT_TRUE(held.check_motion(view_of(phase.q), {.tip_contact = contact}).free);
    const TipContact back = i == 1 || i == 2 ? TipContact::kAllowed : TipContact::kForbidden;
    EXPECT_TRUE(held.check_motion(view_of(phase.retreat), {.tip_contact = back}).free);
    EXPECT_TRUE(phase.retreat.row(0).isApprox(phase.q.bottomRows(1), 1e-9));
    if (i == 0) continue;
    EXPECT_TRUE(phase.q.row(0).isApprox(plan.phases[i - 1].q.bottomRows(1), 1e-9));
    EXPECT_EQ(phase.time.front(), plan.phases[i - 1].time.back());
  }
  const JointMatrix q = all_rows(plan);
  for (std::size_t i = 1; i < plan.time.size(); ++i) EXPECT_GT(plan.time[i], plan.time[i - 1]);
  EXPECT_EQ(Eigen::Map<const Eigen::RowVectorXd>(options.q_start.data(), q.cols()), q.row(0));
  // Pressing and lifting: straight through the target, to the depth.
  const Vec3 deepest = made.target + plan.depth * plan.direction;
  EXPECT_LT((vehicle * plan.phases[1].tip.back().translation() - deepest).norm(), 1e-5);
  for (const std::size_t i : {1, 3}) {
    for (const Pose& tip : plan.phases[i].tip) {
      const Vec3 from = vehicle * tip.translation() - made.target;
      EXPECT_LT(from.cross(plan.direction).norm(), options.line_tolerance);
      EXPECT_GT(from.dot(plan.direction), -options.standoff - 1e-6);
    }
    const SamplingPhase& phase = plan.phases[i];
    for (std::size_t k = 1; k < phase.tip.size(); ++k) {
      const double way = (phase.tip[k].translation() - phase.tip[k - 1].translation()).norm();
      EXPECT_LE(way, options.press_speed * (phase.time[k] - phase.time[k - 1]) * (1.0 + 1e-9));
    }
  }
  // Force and wrench.
  double most = 0.0;
  for (std::size_t i = 0; i < plan.time.size(); ++i) {
    const std::vector<double> tip = forward(made.workspace.arm(), view_of(JointMatrix(q.row(i))));
    const Vec3 place = vehicle * Vec3(tip[3], tip[7], tip[11]);
    const double pressed = std::max(0.0, (place - made.target).dot(plan.direction));
    EXPECT_NEAR(plan.contact_force[i], options.stiffness * pressed, 1e-3 * options.stiffness);
    EXPECT_LE(plan.contact_force[i], options.force_limit);
    most = std::max(most, plan.contact_force[i]);
    const Vec3 push = -plan.contact_force[i] * (vehicle.linear().transpose() * plan.direction);
    Eigen::Matrix<double, 1, 6, Eigen::RowMajor> contact;
    contact << push.transpose(), 0, 0, 0;
    const Workspace& held = i <= plan.phases[3].first ? empty : loaded;
    const std::vector<double> wrench =
        vehicle_wrench(held, view_of(JointMatrix(q.row(i))), Wrenches(contact.data(), 1, 6));
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(plan.wrench[6 * i + k], wrench[k], 1e-9);
  }
  EXPECT_NEAR(most, options.stiffness * plan.depth, 0.05);
}

TEST(Sampling, PaperArmOnAFlatBottom) { check_plan(paper_site()); }
TEST(Sampling, PaperArmOnARoughBottom) { check_plan(paper_site(0.05)); }
TEST(Sampling, PandaOnAFlatBottom) { check_plan(panda_site()); }
TEST(Sampling, PandaOnARoughBottom) { check_plan(panda_site(0.04)); }

TEST(Sampling, TheForceLimitKeepsTheTipHigher) {
  Site made = paper_site();
  made.options.force_limit = 40.0;
  const SamplingPlan plan = plan_sampling(made.workspace, made.target, made.options);
  ASSERT_EQ(plan.status, SamplingStatus::kPlanned) << plan.reason;
  EXPECT_NEAR(plan.depth, 40.0 / 5000.0, 1e-15);
  EXPECT_NEAR(*std::ranges::max_element(plan.contact_force), 40.0, 0.05);
}

TEST(Sampling, AThinCorerGoesDeepAndAThickOneDoesNot) {
  Site made = panda_site();
  made.options.tool_pose = Pose(Eigen::Translation3d(0.0, 0.0, 0.257));
  made.options.tool.capsules = {{Vec3(0, 0, -0.25), Vec3::Zero(), 0.01}};
  made.options.depth = 0.08;
  made.options.stiffness = 500.0;
  SamplingPlan plan = plan_sampling(made.workspace, made.target, made.options);
  ASSERT_EQ(plan.status, SamplingStatus::kPlanned) << plan.reason;
  EXPECT_NEAR(plan.depth, 0.08, 1e-15);
  made.options.tool.capsules.push_back(
      {Vec3(0.05, 0, -0.06), Vec3(0.05, 0, -0.06), 0.01});  // a stop
  plan = plan_sampling(made.workspace, made.target, made.options);
  EXPECT_EQ(plan.status, SamplingStatus::kPlanned) << plan.reason;  // within the depth
  made.options.tool.capsules.back() = {Vec3(0.15, 0, -0.06), Vec3(0.15, 0, -0.06), 0.01};
  plan = plan_sampling(made.workspace, made.target, made.options);
  EXPECT_EQ(plan.status, SamplingStatus::kCollision);
  EXPECT_NE(plan.reason.find("touches scene"), std::string::npos) << plan.reason;
}

TEST(Sampling, PandaPointsItsToolIntoTheBottom) {
  const Site made = panda_site(0.04);
  const SamplingPlan plan = plan_sampling(made.workspace, made.target, made.options);
  ASSERT_EQ(plan.status, SamplingStatus::kPlanned) << plan.reason;
  for (const std::size_t i : {1, 2, 3}) {
    for (const Pose& tip : plan.phases[i].tip) {
      EXPECT_GT(tip.linear().col(2).dot(plan.direction), std::cos(5e-3));
    }
  }
}

TEST(Sampling, ImpulseOfInertiaVanishesFromRestToRest) {
  Site made = paper_site();
  const SamplingPlan still = plan_sampling(made.workspace, made.target, made.options);
  made.options.inertia = true;
  const SamplingPlan moved = plan_sampling(made.workspace, made.target, made.options);
  ASSERT_EQ(moved.status, SamplingStatus::kPlanned);
  ASSERT_EQ(moved.time, still.time);
  const SamplingPhase& approach = moved.phases[0];
  Eigen::Matrix<double, 6, 1> impulse = impulse.Zero(), throughout = impulse.Zero();
  for (std::size_t i = 0; i < approach.time.size(); ++i) {
    const double before = i == 0 ? 0.0 : approach.time[i] - approach.time[i - 1];
    const double after =
        i + 1 == approach.time.size() ? 0.0 : approach.time[i + 1] - approach.time[i];
    Eigen::Matrix<double, 6, 1> inertia;
    for (std::size_t k = 0; k < 6; ++k)
      inertia[k] = moved.wrench[6 * i + k] - still.wrench[6 * i + k];
    impulse += 0.5 * (before + after) * inertia;
    throughout += 0.5 * (before + after) * inertia.cwiseAbs();
  }
  EXPECT_GT(throughout.maxCoeff(), 0.5);
  EXPECT_LT(impulse.cwiseAbs().maxCoeff(), 0.02 * throughout.maxCoeff());
}

TEST(Sampling, RefusalsSayWhy) {
  const auto status = [](const Site& made) {
    const SamplingPlan plan = plan_sampling(made.workspace, made.target, made.options);
    EXPECT_EQ(plan.reason.empty(), plan.status == SamplingStatus::kPlanned);
    EXPECT_EQ(plan.phases.empty(), plan.status != SamplingStatus::kPlanned);
    return plan.status;
  };
  Site far = paper_site();
  far.target += Vec3(1.0, 0.0, 0.0);
  EXPECT_EQ(status(far), SamplingStatus::kUnreachable);
  Site inside = paper_site();
  inside.target = Vec3(-0.4, -0.1, 3.3);
  EXPECT_EQ(status(inside), SamplingStatus::kForbidden);
  Site under = paper_site();
  under.target.z() -= 0.05;
  EXPECT_EQ(status(under), SamplingStatus::kForbidden);
  Site high = paper_site();
  high.target.z() += 0.2;
  EXPECT_EQ(status(high), SamplingStatus::kNoBottom);
  Site low = paper_site();
  low.options.q_start = {0.0, -kPi / 2, 0.0};  // through the bottom
  EXPECT_EQ(status(low), SamplingStatus::kStart);
  Site beyond = paper_site();
  beyond.options.q_transport = {2.0, 0.0, 0.0};
  EXPECT_EQ(status(beyond), SamplingStatus::kStart);
  const auto refused = [](const Site& made) {
    EXPECT_THROW(plan_sampling(made.workspace, made.target, made.options), std::invalid_argument);
  };
  Site broken = paper_site();
  broken.target.x() = NAN;
  refused(broken);
  broken = paper_site();
  broken.options.standoff = 0.0;
  refused(broken);
  broken = paper_site();
  broken.options.direction = Vec3::Zero();
  refused(broken);
  broken = paper_site();
  broken.options.q_start = {0.0};
  refused(broken);
  broken = paper_site();
  broken.workspace = broken.workspace.with_vehicle_pose(
      Trajectory({0.0, 1.0}, {Pose::Identity(), pose_of(0, 0, 1, 0, 0)}));
  refused(broken);
}

TEST(Sampling, SameSeedSameBytesOnAnyThreadsAndAStowedStart) {
  Site made = panda_site(0.04);
  made.options.q_start.clear();
  made.options.num_threads = 1;
  const SamplingPlan one = plan_sampling(made.workspace, made.target, made.options);
  ASSERT_EQ(one.status, SamplingStatus::kPlanned) << one.reason;
  made.options.num_threads = 4;
  const SamplingPlan four = plan_sampling(made.workspace, made.target, made.options);
  EXPECT_EQ(one.time, four.time);
  EXPECT_EQ(one.wrench, four.wrench);
  EXPECT_EQ(all_rows(one), all_rows(four));
}

}  // namespace
}  // namespace bathyal
