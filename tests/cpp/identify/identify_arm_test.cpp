// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/identify_arm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/simulated_touches.hpp"

namespace bathyal {
namespace {

const FitParameter& parameter(const ArmFit& fit, const std::string& name) {
  const auto found = std::find_if(fit.parameters.begin(), fit.parameters.end(),
                                  [&](const FitParameter& p) { return p.name == name; });
  if (found == fit.parameters.end()) throw std::out_of_range(name);
  return *found;
}

double distance(const std::vector<Vec3>& points, int i, int j) {
  return (points[i] - points[j]).norm();
}

/// How far the found arm is from the true one over all its range, base and tool included.
double worst_tip(const Arm& found, const Arm& truth) {
  const JointMatrix q = random_poses(truth, 200, 77);
  double worst = 0.0;
  for (Index i = 0; i < q.rows(); ++i) {
    const std::span<const double> row(q.row(i).data(), static_cast<std::size_t>(q.cols()));
    const Pose a = row_frames(found, row).world_from_tool;
    const Pose b = row_frames(truth, row).world_from_tool;
    worst = std::max(worst, (a.translation() - b.translation()).norm());
  }
  return worst;
}

/// The same after removing a rigid motion, which touches of unknown points do not determine.
double worst_tip_aligned(const Arm& found, const Arm& truth) {
  const JointMatrix q = random_poses(truth, 200, 77);
  Eigen::Matrix3Xd a(3, q.rows()), b(3, q.rows());
  for (Index i = 0; i < q.rows(); ++i) {
    const std::span<const double> row(q.row(i).data(), static_cast<std::size_t>(q.cols()));
    a.col(i) = row_frames(found, row).world_from_tool.translation();
    b.col(i) = row_frames(truth, row).world_from_tool.translation();
  }
  const Eigen::Matrix4d motion = Eigen::umeyama(a, b, false);
  const Eigen::Matrix3Xd moved =
      (motion.topLeftCorner<3, 3>() * a).colwise() + motion.topRightCorner<3, 1>();
  return (moved - b).colwise().norm().maxCoeff();
}

/// 27 parameters, three points, 21 poses each: the ranks that the rules of the literature predict.
TEST(IdentifyArm, RankOfTheUr10e) {
  struct Case {
    Parametrization parametrization;
    int touched, with_distance, with_points;
  };
  for (const Case& known :
       {Case{Parametrization::kHayati, 20, 21, 23}, Case{Parametrization::kDh, 18, 19, 21}}) {
    // At the nominal arm, where parallel axes are exactly so.
    Arm drawing = ur10e();
    Touches touches = touch(built_arm(drawing, 0.0, 1), three_points(), 21, 2);
    const IdentifyOptions options{.parametrization = known.parametrization};
    ArmFit fit = identify_arm(drawing, touches, options);
    EXPECT_EQ(fit.parameters.size(), 27u);
    EXPECT_EQ(fit.rank, known.touched);
    EXPECT_EQ(fit.null_space.size(), 27u - known.touched);
    EXPECT_EQ(fit.scale_source, "prior on lengths (1 mm)");
    touches.known_distances = {{0, 1, distance(three_points(), 0, 1)}};
    fit = identify_arm(drawing, touches, options);
    EXPECT_EQ(fit.rank, known.with_distance);
    EXPECT_EQ(fit.scale_source, "known distance");
    touches.known_distances.clear();
    for (int p = 0; p < 3; ++p) touches.known_points.push_back({p, three_points()[p]});
    fit = identify_arm(drawing, touches, options);
    EXPECT_EQ(fit.rank, known.with_points);
    EXPECT_EQ(fit.scale_source, "known points");
  }
}

TEST(IdentifyArm, ExactTouchesGiveTheArmBack) {
  const Arm truth = built_arm(ur10e(), 1e-3, 1);
  Touches touches = touch(truth, three_points(), 21, 2);
  touches.known_distances = {{0, 1, distance(three_points(), 0, 1)}};
  for (const Criterion criterion : {Criterion::kCentroid, Criterion::kPairs}) {
    const ArmFit fit = identify_arm(ur10e(), touches, {.criterion = criterion});
    EXPECT_TRUE(fit.converged);
    EXPECT_GT(fit.rms_before, 1e-3);
    EXPECT_LT(fit.rms_after, 1e-10);
    EXPECT_LT(worst_tip_aligned(fit.arm, truth), 1e-9);
  }
}

TEST(IdentifyArm, ExactPositionsAndPosesGiveTheArmBack) {
  Arm truth = built_arm(ur10e(), 1e-3, 3);
  truth.set_base(pose_of(1.0, 2.0, 0.5, 0.2, -0.4));
  for (const bool rotations : {false, true}) {
    const ArmFit fit = identify_arm(ur10e(), track(truth, 60, rotations, 4));
    EXPECT_EQ(fit.rank, rotations ? 30 : 27);
    EXPECT_LT(fit.rms_after, 1e-10);
    EXPECT_LT(worst_tip(fit.arm, truth), 1e-9);
    EXPECT_EQ(fit.scale_source, "measured positions");
  }
}

/// A sliding joint, joints that follow others, one that is fixed.
TEST(IdentifyArm, SlidingAndFollowingJoints) {
  const Arm drawing = irregular_arm(3);
  Arm truth = built_arm(drawing, 1e-3, 5, drawing.tool().translation());
  truth.set_base(drawing.base());
  const ArmFit fit = identify_arm(drawing, track(truth, 80, true, 6));
  EXPECT_LT(fit.rms_after, 1e-10);
  EXPECT_LT(worst_tip(fit.arm, truth), 1e-9);
  for (const FitParameter& p : fit.parameters) EXPECT_NE(p.group, "row 3") << "row 3 is fixed";
}

/// Drawings with a sliding joint whose right angles and parallel axes hide from some columns what
/// they would see on any other arm: the residual is still the noise.
TEST(IdentifyArm, SlidingJointsAtSpecialAnglesLeaveTheNoise) {
  constexpr double kNoise = 1e-4;
  constexpr double kSquare = kPi / 2;
  // a, alpha, d, theta, beta
  const std::vector<std::vector<DhRow>> drawings{
      {{0.27, kSquare, 0.26, 0, 0}, {0.21, -kSquare, 0, 0, 0}, {0, kSquare, 0.27, 0, 0}},
      {{0, kSquare, 0.25, 0, 0}, {0.16, 0, 0.22, 0, 0}, {0, 0, 0.36, 0, 0}},
      {{0.31, kSquare, 0.22, 0, 0}, {0, kSquare, 0.08, 0, 0}, {0.2, 0, 0.27, 0, 0}},
      {{0.32, kSquare, 0, 0, 0},
       {0, 0, 0.28, 0, 0},
       {0, -kSquare, 0.29, 0, 0},
       {0, -kSquare, 0.19, 0, 0},
       {0, 0, 0.29, 0, 0}},
  };
  std::uint64_t seed = 0;
  for (const std::vector<DhRow>& rows : drawings) {
    for (const bool rotations : {false, true}) {
      SCOPED_TRACE(++seed);
      DhTable table;
      table.rows = rows;
      table.types.assign(rows.size(), JointType::kRevolute);
      table.types[1] = JointType::kPrismatic;
      DhArmOptions limits;
      limits.lower.assign(rows.size(), -2.0);
      limits.upper.assign(rows.size(), 2.0);
      limits.lower[1] = 0.0;
      limits.upper[1] = 0.5;
      const Arm drawing = arm_from_dh(table, limits);
      Tracked data = track(built_arm(drawing, 1e-3, seed), 200, rotations, seed);
      add_noise(kNoise, seed, data);
      const ArmFit fit = identify_arm(drawing, data);
      const double squares = fit.residuals.squaredNorm() / (kNoise * kNoise);
      const double freedom = fit.degrees_of_freedom;
      EXPECT_GT(freedom, 560.0);
      EXPECT_NEAR(squares, freedom, 4.0 * std::sqrt(2.0 * 600.0));
      EXPECT_TRUE(fit.warnings.empty());
    }
  }
}

TEST(IdentifyArm, SeveralToolsAndStations) {
  const Arm truth = built_arm(ur10e(), 1e-3, 7);
  const Vec3 second(-0.05, 0.1, 0.2);
  const Pose moved = pose_of(0.1, -0.05, 0.02, 0.1, 0.05);
  Touches touches;
  std::vector<Touches> parts;
  for (int tool = 0; tool < 2; ++tool) {
    for (int station = 0; station < 2; ++station) {
      Arm arm = truth;
      if (tool == 1) {
        Pose pose = Pose::Identity();
        pose.translation() = second;
        arm.set_tool(pose);
      }
      if (station == 1) arm.set_base(moved);
      parts.push_back(touch(arm, three_points(), 10, 10 + 2 * tool + station));
      touches.tool.insert(touches.tool.end(), 30, tool);
      touches.station.insert(touches.station.end(), 30, station);
    }
  }
  touches.q.resize(120, 6);
  for (std::size_t i = 0; i < 4; ++i) {
    touches.q.middleRows(30 * static_cast<Index>(i), 30) = parts[i].q;
    touches.point.insert(touches.point.end(), parts[i].point.begin(), parts[i].point.end());
  }
  touches.known_distances = {{0, 2, distance(three_points(), 0, 2)}};
  const ArmFit fit = identify_arm(ur10e(), touches);
  EXPECT_LT(fit.rms_after, 1e-9);
  EXPECT_LT(worst_tip_aligned(fit.arm, truth), 1e-8);
  ASSERT_EQ(fit.tools.size(), 2u);
  ASSERT_EQ(fit.bases.size(), 2u);
  // What a gauge turns at the flange turns both tools alike: their distance is the arm's own.
  const double apart = (truth.tool().translation() - second).norm();
  EXPECT_NEAR((fit.tools[0].translation() - fit.tools[1].translation()).norm(), apart, 1e-8);
  const Eigen::AngleAxisd turn(fit.bases[0].linear().transpose() * fit.bases[1].linear());
  EXPECT_NEAR(turn.angle(), Eigen::AngleAxisd(moved.linear()).angle(), 1e-8);
}

/// Touches of a plane hold the arm as points do, and its place is found.
TEST(IdentifyArm, APlaneTouchedInManyPlaces) {
  const Arm truth = built_arm(ur10e(), 1e-3, 9);
  std::vector<Vec3> places;
  RandomStream random(3);
  const Vec3 normal = Vec3(0.1, -0.2, 1.0).normalized();
  const Vec3 along = normal.unitOrthogonal();
  for (int i = 0; i < 40; ++i) {
    const double turn = random.uniform(-kPi, kPi);
    places.emplace_back(0.1 * normal +
                        random.uniform(0.5, 0.8) * (Eigen::AngleAxisd(turn, normal) * along));
  }
  const Touches on_plane = touch(truth, places, 1, 11);
  Touches touches = touch(truth, three_points(), 15, 12);
  const auto count = static_cast<int>(touches.q.rows());
  RowMatrix q(count + 40, 6);
  q << touches.q, on_plane.q;
  touches.q = q;
  TouchedPlane deck{"deck", {}};
  for (int i = 0; i < 40; ++i) {
    deck.rows.push_back(count + i);
    touches.point.push_back(0);
  }
  touches.planes = {deck};
  touches.known_distances = {{0, 1, distance(three_points(), 0, 1)}};
  const ArmFit fit = identify_arm(ur10e(), touches);
  EXPECT_LT(fit.rms_after, 1e-9);
  EXPECT_LT(worst_tip_aligned(fit.arm, truth), 1e-8);
  touches.planes[0].rows.pop_back();
  touches.point.back() = 7;  // a touch that belongs to no plane, and to a point of its own
  EXPECT_EQ(identify_arm(ur10e(), touches).point_labels.size(), 4u);
}

TEST(IdentifyArm, BothSolversReachTheSameCost) {
  Touches touches = touch(built_arm(ur10e(), 1e-3, 1), three_points(), 21, 2);
  add_scatter(1e-4, 3, touches);
  for (const Criterion criterion : {Criterion::kCentroid, Criterion::kPairs}) {
    IdentifyOptions options{.criterion = criterion, .noise = 1e-4};
    const ArmFit ours = identify_arm(ur10e(), touches, options);
    options.solver = Solver::kPaper;
    const ArmFit paper = identify_arm(ur10e(), touches, options);
    ASSERT_TRUE(ours.converged && paper.converged);
    EXPECT_NEAR(paper.history.back(), ours.history.back(), 1e-9 * ours.history.back());
    EXPECT_NEAR(paper.pairs_after, ours.pairs_after, 1e-8 * ours.pairs_after);
  }
}

TEST(IdentifyArm, PairsAndCentroidsAgreeWithTheScaleHeld) {
  Touches touches = touch(built_arm(ur10e(), 1e-3, 1), three_points(), 21, 2);
  add_scatter(1e-4, 3, touches);
  // One length at nominal holds the size, with a prior that weighs next to nothing.
  const IdentifyOptions centroid{.fixed = {"a_2"}, .length_prior = 1.0, .noise = 1e-4};
  IdentifyOptions pairs = centroid;
  pairs.criterion = Criterion::kPairs;
  IdentifyOptions weighted = centroid;
  weighted.pair_weights = true;
  const double a = identify_arm(ur10e(), touches, weighted).pairs_after;
  EXPECT_NEAR(identify_arm(ur10e(), touches, pairs).pairs_after, a, 1e-8 * a);
  EXPECT_NEAR(identify_arm(ur10e(), touches, centroid).pairs_after, a, 1e-3 * a);
}

TEST(IdentifyArm, ALossTakesOutliersLightly) {
  const Arm truth = built_arm(ur10e(), 1e-3, 1);
  Touches touches = touch(truth, three_points(), 21, 2);
  touches.known_distances = {{0, 1, distance(three_points(), 0, 1)}};
  add_scatter(2e-5, 3, touches);
  touches.q(5, 1) += 0.05;
  touches.q(40, 2) -= 0.04;
  const double square = worst_tip_aligned(identify_arm(ur10e(), touches).arm, truth);
  const double huber =
      worst_tip_aligned(identify_arm(ur10e(), touches, {.loss = Loss::kHuber}).arm, truth);
  const double cauchy =
      worst_tip_aligned(identify_arm(ur10e(), touches, {.loss = Loss::kCauchy}).arm, truth);
  EXPECT_LT(huber, 0.3 * square);
  EXPECT_LT(cauchy, 0.1 * square);
  EXPECT_LT(cauchy, 1e-3);
}

TEST(IdentifyArm, PruningPutsBackWhatIsNotSeenToDiffer) {
  Arm drawing = ur10e();
  std::vector<Joint> joints = drawing.joints();
  joints[2].row.a += 2e-3;
  joints[4].row.alpha += 3e-3;
  Arm truth("built", joints);
  Pose tool = Pose::Identity();
  tool.translation() = Vec3(0.02, -0.01, 0.15);
  truth.set_tool(tool);
  Touches touches = touch(truth, three_points(), 21, 2);
  touches.known_distances = {{0, 1, distance(three_points(), 0, 1)}};
  add_scatter(5e-5, 3, touches);
  const ArmFit full = identify_arm(drawing, touches);
  const ArmFit fit = identify_arm(drawing, touches, {.prune_sigma = 3.0});
  EXPECT_EQ(parameter(fit, "a_3").status, Status::kIdentified);
  EXPECT_NEAR(parameter(fit, "a_3").value, joints[2].row.a, 3e-4);
  EXPECT_EQ(parameter(fit, "alpha_5").status, Status::kIdentified);
  const auto pruned = std::count_if(fit.parameters.begin(), fit.parameters.end(),
                                    [](const auto& p) { return p.status == Status::kPruned; });
  EXPECT_GE(pruned, 8);
  for (const FitParameter& p : fit.parameters) {
    if (p.status == Status::kPruned) {
      EXPECT_EQ(p.value, p.nominal);
      EXPECT_EQ(p.std, 0.0);
    }
  }
  EXPECT_LT(worst_tip_aligned(fit.arm, truth), worst_tip_aligned(full.arm, truth));
}

/// Priors also count where base or planes were settled before.
TEST(IdentifyArm, PriorsHoldWhatTheyAreToldToHold) {
  const Arm truth = built_arm(ur10e(), 1e-3, 3);
  const Tracked tracked = track(truth, 60, false, 4);
  const double true_length = truth.joints()[2].row.a;
  const double nominal = ur10e().joints()[2].row.a;
  const ArmFit open = identify_arm(ur10e(), tracked, {.noise = 1e-4});
  const ArmFit held = identify_arm(ur10e(), tracked, {.priors = {{"a_3", 1e-9}}, .noise = 1e-4});
  EXPECT_NEAR(parameter(open, "a_3").value, true_length, 1e-9);
  EXPECT_NEAR(parameter(held, "a_3").value, nominal, 1e-8);
  EXPECT_EQ(parameter(held, "a_3").status, Status::kPrior);
  const ArmFit fixed = identify_arm(ur10e(), tracked, {.fixed = {"a_3"}});
  EXPECT_EQ(parameter(fixed, "a_3").value, nominal);
  EXPECT_EQ(parameter(fixed, "a_3").status, Status::kFixed);
}

TEST(IdentifyArm, TheSameBytesForAnyNumberOfThreads) {
  const Arm truth = built_arm(ur10e(), 1e-3, 3);
  Tracked tracked = track(truth, 700, true, 4);
  RandomStream random(8);
  for (Index i = 0; i < tracked.position.size(); ++i) {
    tracked.position.data()[i] += 1e-4 * random.normal();
  }
  const ArmFit one = identify_arm(ur10e(), tracked, {.num_threads = 1});
  const ArmFit three = identify_arm(ur10e(), tracked, {.num_threads = 3});
  EXPECT_EQ(one.values, three.values);
  EXPECT_EQ(one.covariance, three.covariance);
  EXPECT_EQ(one.history, three.history);
}

TEST(IdentifyArm, TipCovarianceIsToldInTheFrameOfTheBase) {
  Arm truth = built_arm(ur10e(), 1e-3, 3);
  Arm turned = truth;
  turned.set_base(pose_of(0.0, 0.0, 0.0, 1.0, 0.5));
  const RowMatrix q = random_poses(truth, 5, 9);
  const auto covariance = [&](const Arm& arm) {
    return tip_covariance(identify_arm(ur10e(), track(arm, 60, false, 4), {.noise = 1e-4}), q);
  };
  const auto straight = covariance(truth), other = covariance(turned);
  for (std::size_t i = 0; i < straight.size(); ++i) {
    EXPECT_LT((straight[i] - other[i]).norm(), 1e-5 * straight[i].norm());
  }
}

TEST(IdentifyArm, RefusesWhatItCannotRead) {
  const Touches touches = touch(built_arm(ur10e(), 1e-3, 1), three_points(), 4, 2);
  EXPECT_THROW(identify_arm(planar_arm(), touches), std::invalid_argument);
  EXPECT_THROW(identify_arm(ur10e(), touches, {.base = BaseChoice::kFree}), std::invalid_argument);
  EXPECT_THROW(identify_arm(ur10e(), touches, {.fixed = {"a_9"}}), std::invalid_argument);
  EXPECT_THROW(identify_arm(ur10e(), touches, {.priors = {{"length", 1.0}}}),
               std::invalid_argument);
  EXPECT_THROW(identify_arm(ur10e(), touches, {.max_iterations = 0}), std::invalid_argument);
  EXPECT_THROW(identify_arm(ur10e(), touches, {.prune_sigma = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
