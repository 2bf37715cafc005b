// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/vehicle_wrench.hpp"

#include <gtest/gtest.h>

#include "bathyal/arm/row_frames.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

using Row6 = Eigen::Matrix<double, 1, 6, Eigen::RowMajor>;
using Rows6 = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

const Wrenches kUntouched(nullptr, 0, 6);

Rows6 table(const std::vector<double>& values) {
  return Eigen::Map<const Rows6>(values.data(), static_cast<Index>(values.size() / 6), 6);
}

/// An arm whose links have inertias, too.
Arm heavy_arm(std::uint64_t seed) {
  const Arm plain = irregular_arm(seed);
  RandomStream random(seed + 100);
  std::vector<Link> links = plain.links();
  for (Link& link : links) {
    Eigen::Matrix3d part;
    for (double& value : part.reshaped()) value = random.uniform(-0.3, 0.3);
    const Eigen::Matrix3d spread = part * part.transpose();
    link.body.inertia = spread.trace() * Eigen::Matrix3d::Identity() - spread;
  }
  Arm arm("heavy", plain.joints(), links, plain.root(), plain.flange());
  arm.set_tool(plain.tool());
  return arm;
}

RigidBody sample() {
  RigidBody body;
  body.mass = 1.3;
  body.center_of_mass = Vec3(0.1, -0.2, 0.15);
  body.inertia = Vec3(0.02, 0.03, 0.04).asDiagonal();
  body.volume = 6e-4;
  body.center_of_buoyancy = Vec3(0.05, -0.2, 0.1);
  return body;
}

Workspace hanging(const Arm& arm, const Pose& world_from_vehicle = Pose::Identity()) {
  Surroundings around;
  around.vehicle_from_base = pose_of(0.3, -0.1, -0.2, 0.4, 0.7);
  around.world_from_vehicle = world_from_vehicle;
  return Workspace(arm, around).attach({}, sample());
}

TEST(VehicleWrench, AWeightOnALeverPitchesTheNoseDown) {
  const Arm arm = planar_arm();  // reaches 0.9 along x; its links weigh nothing
  RigidBody ball;
  ball.mass = 2.0;
  const JointMatrix q = JointMatrix::Zero(1, 2);
  const Rows6 wrench =
      table(vehicle_wrench(Workspace(arm, {}).attach({}, ball), view_of(q), kUntouched));
  const double weight = 2.0 * 9.80665;
  const Row6 expected = (Row6() << 0, 0, -weight, 0, 0.9 * weight, 0).finished();
  EXPECT_NEAR((wrench - expected).norm(), 0.0, 1e-12);
}

TEST(VehicleWrench, ABottomThatPushesUpLiftsTheNose) {
  const Row6 contact = (Row6() << 0, 0, 10, 0, 0, 0.5).finished();
  const JointMatrix q = JointMatrix::Zero(1, 2);
  const Rows6 wrench = table(
      vehicle_wrench(Workspace(planar_arm(), {}), view_of(q), Wrenches(contact.data(), 1, 6)));
  EXPECT_NEAR((wrench - (Row6() << 0, 0, 10, 0, -9, 0.5).finished()).norm(), 0.0, 1e-12);
}

/// Each body's weight and buoyancy with its lever, one by one.
Row6 weighed(const Workspace& ws, std::span<const double> q, const Vec3& gravity, double density) {
  const RowFrames frames = row_frames(ws.arm(), q);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const auto add = [&](const Pose& frame, const RigidBody& body) {
    const Vec3 weight = body.mass * gravity, lift = -density * body.volume * gravity;
    force += weight + lift;
    moment += (frame * body.center_of_mass).cross(weight);
    moment += (frame * body.center_of_buoyancy).cross(lift);
  };
  for (std::size_t k = 0; k < ws.arm().links().size(); ++k) {
    add(frames.world_from_row[k] * ws.arm().links()[k].row_from_link, ws.arm().links()[k].body);
  }
  add(frames.world_from_tool, ws.attached());
  return (Row6() << force.transpose(), moment.transpose()).finished();
}

TEST(VehicleWrench, IsTheSumOverLinksAndSampleInAnyAttitude) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Pose world_from_vehicle = pose_of(4.0, 5.0, -6.0, 0.3, -0.5);
    const Workspace ws = hanging(heavy_arm(seed), world_from_vehicle);
    const JointMatrix q = random_poses(ws.arm(), 5, seed);
    const Rows6 wrench = table(vehicle_wrench(ws, view_of(q), kUntouched));
    const Vec3 gravity = world_from_vehicle.linear().transpose() * Vec3(0, 0, -9.80665);
    for (Index i = 0; i < q.rows(); ++i) {
      const Row6 expected =
          weighed(ws, {q.row(i).data(), static_cast<std::size_t>(q.cols())}, gravity, 1025.0);
      EXPECT_NEAR((wrench.row(i) - expected).norm(), 0.0, 1e-10);
    }
  }
}

TEST(VehicleWrench, AVehicleThatTurnsOverTimeTurnsGravity) {
  const Pose pitched = pose_of(0, 0, 0, 0, 0.4);
  Surroundings around;
  around.world_from_vehicle = Trajectory({0.0, 1.0}, {Pose::Identity(), pitched});
  RigidBody ball;
  ball.mass = 1.0;
  const Workspace ws = Workspace(planar_arm(), around).attach({}, ball);
  const JointMatrix q = JointMatrix::Zero(2, 2);
  const std::vector<double> time{0.0, 1.0};
  WrenchOptions options;
  options.time = time;
  const Rows6 wrench = table(vehicle_wrench(ws, view_of(q), kUntouched, options));
  EXPECT_NEAR(wrench(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(wrench(1, 0), 9.80665 * std::sin(0.4), 1e-9);  // nose down: weight pulls forward
  EXPECT_NEAR(wrench(1, 4), 0.9 * 9.80665 * std::cos(0.4), 1e-9);
}

TEST(VehicleWrench, AboutTheFirstAxisIsWhatItsDriveHolds) {
  for (const std::uint64_t seed : {4, 5}) {
    Arm arm = ur10e();
    std::vector<Link> links = arm.links();
    RandomStream random(seed);
    for (std::size_t k = 1; k < links.size(); ++k) {  // the foot is not the drive's
      links[k].body.mass = random.uniform(1, 5);
      links[k].body.volume = random.uniform(0, 3e-3);
      links[k].body.center_of_mass = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0.2);
    }
    arm = Arm("ur", arm.joints(), links, arm.root(), arm.flange());
    const Workspace ws = hanging(arm);
    const JointMatrix q = random_poses(arm, 4, seed);
    StaticsOptions still;
    still.gravity = ws.arm().base().linear().transpose() * still.gravity;
    still.payload = sample();
    const Row6 push = (Row6() << 3.0, -4.0, 5.0, 0.2, -0.1, 0.3).finished();
    const Row6 contact = -push;
    const std::vector<double> torque =
        statics(ws.arm(), view_of(q), Wrenches(push.data(), 1, 6), still);
    const Rows6 wrench = table(vehicle_wrench(ws, view_of(q), Wrenches(contact.data(), 1, 6)));
    const Pose foot = ws.arm().base() * ws.arm().root();
    for (Index i = 0; i < q.rows(); ++i) {
      const Vec3 force = wrench.row(i).head<3>(), moment = wrench.row(i).tail<3>();
      const double pull = foot.linear().col(2).dot(moment - foot.translation().cross(force));
      EXPECT_NEAR(torque[static_cast<std::size_t>(i * q.cols())], -pull, 1e-9);
    }
  }
}

/// q(t) of each coordinate, smooth, with its derivatives.
struct Swing {
  JointMatrix q, velocity, acceleration;
  Swing(const JointMatrix& start, double t) : q(start), velocity(start), acceleration(start) {
    for (Index j = 0; j < start.cols(); ++j) {
      const double w = 1.0 + 0.3 * static_cast<double>(j), amplitude = 0.8;
      q(0, j) += amplitude * std::sin(w * t);
      velocity(0, j) = amplitude * w * std::cos(w * t);
      acceleration(0, j) = -amplitude * w * w * std::sin(w * t);
    }
  }
};

TEST(VehicleWrench, InertiaIsTheDerivativeOfMomentumAndThatOfTheCentres) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Workspace ws = hanging(heavy_arm(seed));
    const JointMatrix start = random_poses(ws.arm(), 1, seed);
    const double t = 0.7, step = 1e-5;
    const Swing now(start, t), before(start, t - step), after(start, t + step);
    const auto momentum = [&](const Swing& at) {
      return table(arm_momentum(ws, view_of(at.q), view_of(at.velocity)));
    };
    WrenchOptions options;
    const Rows6 still = table(vehicle_wrench(ws, view_of(now.q), kUntouched, options));
    options.velocity = &now.velocity;
    options.acceleration = &now.acceleration;
    const Rows6 moved = table(vehicle_wrench(ws, view_of(now.q), kUntouched, options));
    const Rows6 rate = (momentum(after) - momentum(before)) / (2.0 * step);
    EXPECT_NEAR((still - moved - rate).norm(), 0.0, 1e-6 * rate.norm());
    // Linear momentum is the derivative of Σ m r, which weight shows: moment = Σ m r × g.
    WrenchOptions dry;
    dry.water_density = 0.0;
    const auto pull = [&](const Swing& at) {
      return Rows6(table(vehicle_wrench(ws, view_of(at.q), kUntouched, dry)));
    };
    const Vec3 change = (pull(after) - pull(before)).row(0).tail<3>() / (2.0 * step);
    const Vec3 p = momentum(now).row(0).head<3>();
    EXPECT_NEAR((change - p.cross(Vec3(0, 0, -9.80665))).norm(), 0.0, 1e-6 * p.norm());
  }
}

TEST(VehicleWrench, NetImpulseIsTheChangeOfMomentum) {
  const Workspace ws = hanging(heavy_arm(6));
  const JointMatrix start = random_poses(ws.arm(), 1, 6);
  constexpr Index kSteps = 400;
  const double end = 1.3, step = end / kSteps;
  Rows6 impulse = Rows6::Zero(1, 6);
  for (Index i = 0; i <= kSteps; ++i) {  // Simpson's rule
    const Swing at(start, step * static_cast<double>(i));
    WrenchOptions options;
    const Rows6 still = table(vehicle_wrench(ws, view_of(at.q), kUntouched, options));
    options.velocity = &at.velocity;
    options.acceleration = &at.acceleration;
    const Rows6 moved = table(vehicle_wrench(ws, view_of(at.q), kUntouched, options));
    const double weight = i == 0 || i == kSteps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    impulse += weight * step / 3.0 * (moved - still);
  }
  const Swing first(start, 0.0), last(start, end);
  const Rows6 change = table(arm_momentum(ws, view_of(last.q), view_of(last.velocity))) -
                       table(arm_momentum(ws, view_of(first.q), view_of(first.velocity)));
  EXPECT_NEAR((impulse + change).norm(), 0.0, 1e-8 * change.norm());
}

TEST(VehicleWrench, RatesByDifferencesAddUpToNothingAndAreSecondOrder) {
  const std::vector<double> time{0.0, 0.1, 0.15, 0.3, 0.5};
  JointMatrix q(5, 1);
  for (Index i = 0; i < 5; ++i) q(i, 0) = 2.0 * std::pow(time[static_cast<std::size_t>(i)], 2);
  const JointRates rates = joint_rates(view_of(q), time);
  for (const Index i : {1, 2, 3}) {
    EXPECT_NEAR(rates.velocity(i, 0), 4.0 * time[static_cast<std::size_t>(i)], 1e-12);
    EXPECT_NEAR(rates.acceleration(i, 0), 4.0, 1e-12);
  }
  EXPECT_EQ(rates.velocity(0, 0), 0.0);
  EXPECT_EQ(rates.velocity(4, 0), 0.0);
  const double halves[] = {0.05, 0.075, 0.1, 0.175, 0.1};
  double sum = 0.0;
  for (Index i = 0; i < 5; ++i) sum += halves[i] * rates.acceleration(i, 0);
  EXPECT_NEAR(sum, 0.0, 1e-12);
}

TEST(VehicleWrench, SameForAnyThreads) {
  const Workspace ws = hanging(heavy_arm(8));
  const JointMatrix q = random_poses(ws.arm(), 600, 8);
  WrenchOptions options;
  options.num_threads = 1;
  const std::vector<double> one = vehicle_wrench(ws, view_of(q), kUntouched, options);
  options.num_threads = 8;
  EXPECT_EQ(vehicle_wrench(ws, view_of(q), kUntouched, options), one);
}

TEST(VehicleWrench, Refusals) {
  const Workspace ws(planar_arm(), {});
  const JointMatrix q = JointMatrix::Zero(3, 2), fewer = JointMatrix::Zero(2, 2);
  const std::vector<double> pushes(12, 0.0), broken(6, NAN), times(2, 0.0);
  const auto refused = [&](Wrenches contact, const WrenchOptions& options) {
    EXPECT_THROW(vehicle_wrench(ws, view_of(q), contact, options), std::invalid_argument);
  };
  refused(Wrenches(pushes.data(), 2, 6), {});
  refused(Wrenches(broken.data(), 1, 6), {});
  WrenchOptions options;
  options.velocity = &fewer;
  refused(kUntouched, options);
  options = {};
  options.time = times;
  refused(kUntouched, options);
  options = {};
  options.water_density = NAN;
  refused(kUntouched, options);
  EXPECT_THROW(joint_rates(view_of(q), times), std::invalid_argument);
  EXPECT_THROW(joint_rates(view_of(fewer), times), std::invalid_argument);  // do not rise
}

}  // namespace
}  // namespace bathyal
