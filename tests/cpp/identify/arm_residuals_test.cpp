// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/arm_residuals.hpp"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "bathyal/geometry/rotation_vector.hpp"
#include "support/simulated_touches.hpp"

namespace bathyal {
namespace {

template <class T>
using Mat3 = Eigen::Matrix<T, 3, 3>;
template <class T>
using Column3 = Eigen::Matrix<T, 3, 1>;

template <class T>
Mat3<T> turn_about(int axis, const T& angle) {
  using std::cos, std::sin;
  Mat3<T> out = Mat3<T>::Identity();
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  out(i, i) = out(j, j) = cos(angle);
  out(j, i) = sin(angle);
  out(i, j) = -sin(angle);
  return out;
}

/// Rodrigues; of a vector that is not zero.
template <class T>
Mat3<T> rotation(const Column3<T>& vector) {
  using std::cos, std::sin;
  const T angle = vector.norm();
  const Column3<T> axis = vector / angle;
  Mat3<T> cross;
  cross << T(0), -axis[2], axis[1], axis[2], T(0), -axis[0], -axis[1], axis[0], T(0);
  return Mat3<T>::Identity() + sin(angle) * cross + (T(1) - cos(angle)) * (cross * cross);
}

template <class T>
struct Frame3 {
  Mat3<T> turn = Mat3<T>::Identity();
  Column3<T> shift = Column3<T>::Zero();

  explicit Frame3(const Pose& pose = Pose::Identity())
      : turn(pose.linear().cast<T>()), shift(pose.translation().cast<T>()) {}
  void then(const Mat3<T>& next_turn, const Column3<T>& next_shift) {
    shift += turn * next_shift;
    turn = (turn * next_turn).eval();
  }
};

/// What the columns mean, written down once more and straight: world_from_tool.
template <class T>
Frame3<T> forward(const ArmParameters& parameters, const std::vector<T>& x, const double* q,
                  int tool, int station) {
  struct Row {
    T theta, d, a, alpha, beta;
  };
  std::vector<Row> rows;
  for (const Joint& joint : parameters.arm.joints()) {
    const DhRow& r = joint.row;
    rows.push_back({T(r.theta), T(r.d), T(r.a), T(r.alpha), T(r.beta)});
  }
  Frame3<T> base(parameters.bases[station]), flange_from_tool(parameters.tools[tool]);
  Column3<T> base_turn = Column3<T>::Zero(), tool_turn = Column3<T>::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto [kind, index, axis] = parameters.slots[i];
    if (kind == ParameterKind::kTheta) rows[index].theta = x[i];
    if (kind == ParameterKind::kD) rows[index].d = x[i];
    if (kind == ParameterKind::kA) rows[index].a = x[i];
    if (kind == ParameterKind::kAlpha) rows[index].alpha = x[i];
    if (kind == ParameterKind::kBeta) rows[index].beta = x[i];
    if (kind == ParameterKind::kToolShift && index == tool) flange_from_tool.shift[axis] = x[i];
    if (kind == ParameterKind::kToolTurn && index == tool) tool_turn[axis] = x[i];
    if (kind == ParameterKind::kBaseShift && index == station) base.shift[axis] = x[i];
    if (kind == ParameterKind::kBaseTurn && index == station) base_turn[axis] = x[i];
  }
  if (base_turn.norm() > T(0)) base.turn = (rotation<T>(base_turn) * base.turn).eval();
  if (tool_turn.norm() > T(0)) {
    flange_from_tool.turn = (flange_from_tool.turn * rotation<T>(tool_turn)).eval();
  }
  Frame3<T> pose = base;
  pose.then(parameters.arm.root().linear().cast<T>(),
            parameters.arm.root().translation().cast<T>());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Joint& joint = parameters.arm.joints()[k];
    T theta = rows[k].theta, d = rows[k].d;
    if (joint.type == JointType::kRevolute) {
      theta += T(joint.multiplier * q[joint.coordinate] + joint.offset);
    } else if (joint.type == JointType::kPrismatic) {
      d += T(joint.multiplier * q[joint.coordinate] + joint.offset);
    }
    const Column3<T> none = Column3<T>::Zero();
    pose.then(turn_about<T>(2, theta), none);
    pose.then(turn_about<T>(0, rows[k].alpha), Column3<T>(rows[k].a, T(0), d));
    pose.then(turn_about<T>(1, rows[k].beta), none);
  }
  pose.then(parameters.arm.flange().linear().cast<T>(),
            parameters.arm.flange().translation().cast<T>());
  pose.then(flange_from_tool.turn, flange_from_tool.shift);
  return pose;
}

std::vector<Pose> some_poses(int count, std::uint64_t seed) {
  RandomStream random(seed);
  const auto any = [&] { return random.uniform(-0.5, 0.5); };
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) poses.push_back(pose_of(any(), any(), any(), any(), any()));
  return poses;
}

/// Every kind of column at once: an arm with turning, sliding, fixed and mimic joints, two tools,
/// two stations; tracked with rotations, or touches of points and a plane.
struct Everything {
  Arm arm;
  Measurement m;
  ArmParameters parameters;
  Eigen::VectorXd x;

  Everything(bool tracked, Parametrization parametrization)
      : arm(irregular_arm(3)), parameters{arm, {}, {}, {}, {}, {}} {
    if (tracked) {
      Tracked data = track(arm, 24, true, 5);
      set_groups(24, data.tool, data.station);
      data.weights = weights(24);
      m = to_measurement(arm, data);
    } else {
      Touches data;
      data.q = random_poses(arm, 24, 5);
      for (int i = 0; i < 24; ++i) data.point.push_back(i % 5 % 3);
      set_groups(24, data.tool, data.station);
      data.weights = weights(24);
      data.planes = {{"deck", {1, 6, 11, 16, 20}}, {"wall", {2, 7, 12, 17}}};
      data.known_distances = {{0, 1, 0.3}, {1, 2, 0.4}};
      data.known_points = {{2, Vec3(0.1, 0.2, 0.3)}};
      m = to_measurement(arm, data);
    }
    std::vector<PlaneGuess> planes;
    for (const Pose& pose : some_poses(static_cast<int>(m.plane_names.size()), 8)) {
      planes.push_back({pose.linear().col(2), pose.translation(), 0.1});
    }
    parameters = make_parameters(arm, m, some_poses(2, 6), some_poses(2, 7), planes,
                                 {parametrization, 0.9, true});
    RandomStream random(9);
    x = parameters.nominal();
    for (Index i = 0; i < x.size(); ++i) x[i] += random.uniform(-0.1, 0.1);
  }

  static void set_groups(int rows, std::vector<int>& tool, std::vector<int>& station) {
    for (int i = 0; i < rows; ++i) {
      tool.push_back(i % 2);
      station.push_back(i / 2 % 2);
    }
  }
  static std::vector<double> weights(int rows) {
    RandomStream random(4);
    std::vector<double> out;
    for (int i = 0; i < rows; ++i) out.push_back(random.uniform(0.5, 2.0));
    return out;
  }
};

TEST(ChainDerivatives, DerivativesAreThoseOfAutomaticDifferentiation) {
  std::set<ParameterKind> seen;
  for (const Parametrization kind : {Parametrization::kHayati, Parametrization::kDh}) {
    const Everything all(true, kind);
    const auto count = static_cast<int>(all.parameters.parameters.size());
    std::vector<int> wanted(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) wanted[i] = i;
    const ChainDerivatives chain(all.parameters, all.x, wanted);
    ChainFrames frames;
    Eigen::Matrix3Xd shift(3, count), turn(3, count);
    for (Index row = 0; row < all.m.rows(); ++row) {
      const double* q = all.m.q.row(row).data();
      const int tool = all.m.tool[row], station = all.m.station[row];
      const Pose pose = chain.tip(q, kNoRow, tool, station, frames, shift.data(), turn.data(), 3);
      for (int c = 0; c < count; ++c) {
        using Jet = ceres::Jet<double, 1>;
        std::vector<Jet> x(all.x.begin(), all.x.end());
        x[c].v[0] = 1.0;
        const Frame3<Jet> truth = forward(all.parameters, x, q, tool, station);
        Vec3 move;
        Eigen::Matrix3d spin, turned;
        for (int i = 0; i < 3; ++i) {
          move[i] = truth.shift[i].v[0];
          ASSERT_NEAR(pose.translation()[i], truth.shift[i].a, 1e-13);
          for (int j = 0; j < 3; ++j) {
            turned(i, j) = truth.turn(i, j).a;
            spin(i, j) = truth.turn(i, j).v[0];
          }
        }
        const Eigen::Matrix3d cross = spin * turned.transpose();  // d R Rᵀ is the turn's matrix
        const Vec3 axis(cross(2, 1), cross(0, 2), cross(1, 0));
        const std::string& name = all.parameters.parameters[c].name;
        EXPECT_LT((shift.col(c) - move).norm(), 1e-13) << name << " in row " << row;
        EXPECT_LT((turn.col(c) - axis).norm(), 1e-13) << name << " in row " << row;
        if (move.norm() + axis.norm() > 1e-3) seen.insert(all.parameters.slots[c].kind);
      }
    }
  }
  EXPECT_EQ(seen.size(), 9u) << "a kind of column was not moved by any test";
}

/// The whole Jacobian, centroids, planes, known things and priors included, by central differences.
void check_by_differences(ArmResiduals& system, const Everything& all) {
  system.set_noise({1e-3, 2e-3}, all.x);
  Eigen::VectorXd y = system.scaled(all.x);
  Eigen::VectorXd residuals(system.rows()), up(system.rows()), down(system.rows());
  Eigen::MatrixXd jacobian(system.rows(), system.columns());
  system.evaluate(y.data(), residuals.data(), jacobian.data());
  constexpr double kStep = 1e-2;  // of a mm or a mrad
  for (Index c = 0; c < system.columns(); ++c) {
    const double at = y[c];
    y[c] = at + kStep;
    system.evaluate(y.data(), up.data(), nullptr);
    y[c] = at - kStep;
    system.evaluate(y.data(), down.data(), nullptr);
    y[c] = at;
    const Eigen::VectorXd slope = (up - down) / (2.0 * kStep);
    EXPECT_LT((slope - jacobian.col(c)).cwiseAbs().maxCoeff(), 1e-6)
        << all.parameters.parameters[system.free()[c]].name;
  }
  system.evaluate(y.data(), up.data(), nullptr);
  EXPECT_EQ(up, residuals) << "the same residuals with and without derivatives";

  Eigen::MatrixXd both(system.rows(), system.columns() + 1);
  both << jacobian, residuals;
  const Eigen::MatrixXd square = both.transpose() * both;
  EXPECT_LT((system.normal_equations(y.data()) - square).cwiseAbs().maxCoeff(),
            1e-12 * square.cwiseAbs().maxCoeff());
  EXPECT_NEAR(system.cost(y.data()), residuals.squaredNorm(), 1e-12 * residuals.squaredNorm());
}

TEST(ArmResiduals, DerivativesOfTouchesAreTheirDifferences) {
  for (const Criterion criterion : {Criterion::kCentroid, Criterion::kPairs}) {
    for (const bool weighted : {false, true}) {
      Everything all(false, Parametrization::kHayati);
      all.parameters.parameters[2].prior_std = 1e-3;
      ArmResiduals system(all.parameters, all.m, criterion, weighted, 1);
      LinearConstraint row{Eigen::VectorXd::LinSpaced(all.x.size(), -1.0, 1.0), 0.5};
      system.set_linear_constraints({row});
      check_by_differences(system, all);
    }
  }
}

TEST(ArmResiduals, DerivativesOfTrackedPosesAreTheirDifferences) {
  Everything all(true, Parametrization::kHayati);
  all.parameters.parameters[2].prior_std = 1e-3;
  ArmResiduals system(all.parameters, all.m, Criterion::kCentroid, false, 1);
  std::vector<int> free = system.free();
  free.erase(free.begin() + 4);  // one of them held
  system.set_free(free);
  system.set_linear_constraints({{Eigen::VectorXd::LinSpaced(all.x.size(), -1.0, 1.0), 0.5}});
  check_by_differences(system, all);
}

/// Other directions and sizes for each row.
ArmResiduals::Whitening some_whitening(Index rows) {
  auto out = std::make_shared<ArmResiduals::RowWhitening>();
  RandomStream random(9);
  for (Index i = 0; i < rows; ++i) {
    const Vec3 load = 2.0 * Vec3(random.normal(), random.normal(), random.normal());
    const Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity() + load * load.transpose();
    out->factors.push_back(
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).operatorInverseSqrt());
  }
  return out;
}

TEST(ArmResiduals, DerivativesOfRowsThatAreWhitenedAreTheirDifferences) {
  for (const bool tracked : {false, true}) {
    Everything all(tracked, Parametrization::kHayati);
    ArmResiduals system(all.parameters, all.m, Criterion::kCentroid, false, 1);
    system.set_row_whitening(some_whitening(all.m.rows()));
    check_by_differences(system, all);
  }
}

/// By the inverse of their whole covariance, of which the engine never makes a matrix.
TEST(ArmResiduals, PosesWithAnErrorInCommonCostWhatTheirCovarianceSays) {
  Everything all(true, Parametrization::kHayati);
  ArmResiduals system(all.parameters, all.m, Criterion::kCentroid, false, 1);
  const Index n = all.m.rows();
  auto whitening = std::make_shared<ArmResiduals::RowWhitening>(*some_whitening(n));
  const Eigen::Matrix3d factor = whitening->factors[2];
  const Vec3 load(0.7, -1.1, 0.4);
  whitening->factors[1] = whitening->factors[4] = factor;
  whitening->shared.push_back({{1, 2, 4}, load * load.transpose()});
  system.set_row_whitening(whitening);
  check_by_differences(system, all);

  Eigen::VectorXd residuals(system.rows());
  system.evaluate(system.scaled(all.x).data(), residuals.data(), nullptr);
  const Eigen::Matrix3Xd off = system.deviations(all.x);
  const std::vector<int> poses{1, 2, 4};
  Eigen::VectorXd errors(9);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(9, 9);
  double whitened = 0.0;
  for (Index i = 0; i < 3; ++i) {
    errors.segment<3>(3 * i) = system.row_factor(poses[i]) * off.col(poses[i]);
    whitened += residuals.segment<3>(3 * poses[i]).squaredNorm();
    for (Index k = 0; k < 3; ++k) covariance.block<3, 3>(3 * i, 3 * k) += load * load.transpose();
  }
  const double expected = errors.dot(covariance.ldlt().solve(errors));
  EXPECT_NEAR(whitened, expected, 1e-9 * expected);
  EXPECT_LT((system.errors_of(residuals.head(3 * n)) - off).norm(), 1e-9 * off.norm());

  // Sources of each pose's own, alike in poses that were rounded alike.
  Eigen::MatrixXd loads = Eigen::MatrixXd::Random(3 * n, 2);
  for (const int pose : poses) loads.middleRows<3>(3 * pose) = loads.middleRows<3>(3);
  const Eigen::MatrixXd whitened_loads = system.whitened(loads);
  Eigen::MatrixXd unwhiten(3 * n, 3 * n);
  for (Index k = 0; k < 3 * n; ++k)
    unwhiten.col(k) = system.errors_of(Eigen::VectorXd::Unit(3 * n, k)).reshaped();
  const Eigen::MatrixXd whiten = unwhiten.inverse() * system.noise().position;
  for (const Index pose : {0, 1, 2}) {  // the first shares nothing
    Eigen::Matrix3d by_hand = Eigen::Matrix3d::Zero();
    for (Index other = 0; other < n; ++other) {
      const Eigen::MatrixXd moved =
          whiten.block<3, 3>(3 * pose, 3 * other) * loads.middleRows<3>(3 * other);
      by_hand += moved * moved.transpose() / system.weight(other);
    }
    const Eigen::MatrixXd own = whitened_loads.middleRows<3>(3 * pose);
    EXPECT_LT((own * own.transpose() - by_hand).norm(), 1e-9 * by_hand.norm());
  }
}

TEST(ArmResiduals, APointLiesWhereWhitenedTouchesCostLeast) {
  Everything all(false, Parametrization::kHayati);
  ArmResiduals system(all.parameters, all.m, Criterion::kCentroid, false, 1);
  system.set_row_whitening(some_whitening(all.m.rows()));
  const Eigen::Matrix3Xd off = system.deviations(all.x);
  Eigen::VectorXd residuals(system.rows());
  system.evaluate(system.scaled(all.x).data(), residuals.data(), nullptr);
  Eigen::Matrix3Xd pull = Eigen::Matrix3Xd::Zero(3, all.m.points());
  double all_pulls = 0.0;
  for (Index i = 0; i < all.m.rows(); ++i) {
    if (all.m.point[i] < 0) continue;
    const Eigen::Matrix3d factor = system.row_factor(i);
    EXPECT_LT((residuals.segment<3>(3 * i) - factor * off.col(i)).norm(), 1e-9);
    pull.col(all.m.point[i]) += factor * factor * off.col(i);
    all_pulls += (factor * factor * off.col(i)).norm();
  }
  EXPECT_LT(pull.norm(), 1e-9 * all_pulls);
}

/// Σ over pairs = m Σ about the mean; with weights Σ w Σ w‖ ‖².
TEST(ArmResiduals, BothCriteriaCostTheSame) {
  const Arm arm = ur10e();
  Touches touches = touch(built_arm(arm, 1e-3, 1), three_points(), 8, 2);
  const auto cost = [&](Criterion criterion, bool pair_weights) {
    const Measurement m = to_measurement(arm, touches);
    const ArmParameters parameters =
        make_parameters(arm, m, {Pose::Identity()}, {Pose::Identity()}, {}, {});
    const ArmResiduals system(parameters, m, criterion, pair_weights, 1);
    const Eigen::VectorXd y = Eigen::VectorXd::Zero(system.columns());
    return system.cost(y.data());
  };
  const double pairs = cost(Criterion::kPairs, false);
  EXPECT_NEAR(8.0 * cost(Criterion::kCentroid, false), pairs, 1e-10 * pairs);
  EXPECT_NEAR(cost(Criterion::kCentroid, true), pairs, 1e-10 * pairs);

  touches.point[23] = 0;  // 9, 8 and 7 touches
  touches.weights.assign(24, 1.0);
  touches.weights[3] = 2.0;
  const double uneven = cost(Criterion::kPairs, false);
  EXPECT_NEAR(cost(Criterion::kCentroid, true), uneven, 1e-10 * uneven);
  EXPECT_GT(std::abs(8.0 * cost(Criterion::kCentroid, false) - uneven), 1e-3 * uneven);
}

TEST(ArmResiduals, TheSameBytesForAnyNumberOfThreads) {
  const Arm arm = ur10e();
  const Tracked tracked = track(built_arm(arm, 1e-3, 1), 1000, true, 2);
  const Measurement m = to_measurement(arm, tracked);
  const ArmParameters parameters =
      make_parameters(arm, m, {Pose::Identity()}, {Pose::Identity()}, {}, {.free_base = true});
  const ArmResiduals one(parameters, m, Criterion::kCentroid, false, 1);
  const ArmResiduals three(parameters, m, Criterion::kCentroid, false, 3);
  const Eigen::VectorXd y = Eigen::VectorXd::Zero(one.columns());
  EXPECT_EQ(one.normal_equations(y.data()), three.normal_equations(y.data()));
  EXPECT_EQ(one.cost(y.data()), three.cost(y.data()));
  EXPECT_EQ(one.jacobian(parameters.nominal()), three.jacobian(parameters.nominal()));
}

TEST(ArmResiduals, NoiseByTheMedianIsThatOfAnAxisWhateverAFewRowsDo) {
  const Arm arm = ur10e();
  Tracked tracked = track(arm, 400, false, 2);
  RandomStream random(3);
  for (Index i = 0; i < tracked.position.size(); ++i) {
    tracked.position.data()[i] += 2e-4 * random.normal();
  }
  const auto noise = [&] {
    const Measurement m = to_measurement(arm, tracked);
    const ArmParameters parameters =
        make_parameters(arm, m, {Pose::Identity()}, {Pose::Identity()}, {}, {});
    ArmResiduals system(parameters, m, Criterion::kCentroid, false, 1);
    system.set_free({});
    return median_noise(system, system.deviations(parameters.nominal()).colwise().norm());
  };
  EXPECT_NEAR(noise(), 2e-4, 2e-5);
  for (Index i = 0; i < 400; i += 10) tracked.position(i, 0) += 0.05;
  EXPECT_NEAR(noise(), 2e-4, 4e-5);
}

TEST(RotationVector, LogUndoesExp) {
  RandomStream random(1);
  for (const double size : {0.0, 1e-12, 1e-5, 0.1, 1.0, 3.1}) {
    const Vec3 direction(random.normal(), random.normal(), random.normal());
    const Vec3 vector = size * direction.normalized();
    EXPECT_LT((vector_of(rotation_of(vector)) - vector).norm(), 1e-14 + 1e-13 * size);
  }
}

}  // namespace
}  // namespace bathyal
