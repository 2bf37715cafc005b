// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/effect_parameters.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "bathyal/identify/fit/redundancy.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"
#include "support/plain_effects.hpp"

// Effects among the columns of an arm: derivatives, searches, bookkeeping.

namespace bathyal {
namespace {

/// One form of each effect, and of gravity's all.
std::vector<EffectVariant> one_of_each(const EffectData& data) {
  std::vector<EffectVariant> out;
  for (const auto& effect : library_effects()) {
    const std::vector<EffectVariant> variants = effect->variants(data);
    if (variants.empty()) continue;
    out.push_back(variants[variants.size() / 2]);
    if (effect->info().name == "link_compliance") out.push_back(variants.front());
  }
  return out;
}

void add_all(ArmParameters& parameters, const std::vector<EffectVariant>& variants,
             const EffectData& data) {
  for (const EffectVariant& v : variants) {
    add_effect(parameters, v, perturbations_of(*effect_named(v.effect), v, data));
  }
}

/// Values off nominal, effects so that joints and frames move by about `size` each.
Eigen::VectorXd somewhere(const ArmParameters& parameters, double size, std::uint64_t seed) {
  RandomStream random(seed);
  Eigen::VectorXd x = parameters.nominal();
  for (Index i = 0; i < x.size(); ++i) {
    x[i] += size / 1e-3 * parameters.parameters[i].scale * random.uniform(-1.0, 1.0);
  }
  return x;
}

void expect_slopes(ArmResiduals& system, const ArmParameters& parameters,
                   const Eigen::VectorXd& x) {
  Eigen::VectorXd y = system.scaled(x);
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
    EXPECT_LT((slope - jacobian.col(c)).cwiseAbs().maxCoeff(), 3e-6)
        << parameters.parameters[system.free()[c]].name;
  }
}

/// Two tools and two stations, rotations, every effect at once, each off zero: what one of them
/// does to the derivative by another, and to those of the arm's own columns.
TEST(EffectColumns, DerivativesOfTrackedPosesAreTheirDifferences) {
  const Scene scene(irregular_arm(3));
  const EffectData data = scene.data();
  Measurement m = measurement_of(scene.arm, scene.q, true);
  m.tools = m.stations = 2;
  for (std::size_t i = 0; i < 40; ++i) {
    m.tool[i] = static_cast<int>(i % 2);
    m.station[i] = static_cast<int>(i / 2 % 2);
    m.rotation[i] = plain_forward(scene.arm, scene.q.row(i), {}).linear();
  }
  const std::vector<Pose> two{pose_of(0.1, 0.2, 0.3, 0.4, 0.5), pose_of(-0.3, 0.2, -0.1, 0.5, 0.2)};
  ArmParameters parameters = make_parameters(scene.arm, m, two, two, {}, {.free_base = true});
  add_all(parameters, one_of_each(data), data);
  const Eigen::VectorXd x = somewhere(parameters, 0.02, 5);
  ArmResiduals system(parameters, m, Criterion::kCentroid, false, 1);
  system.set_noise({1e-3, 2e-3}, x);
  EXPECT_GT(parameters.perturbations.size(), 40U);
  expect_slopes(system, parameters, x);
}

TEST(EffectColumns, DerivativesOfTouchesAreTheirDifferences) {
  const Scene scene(irregular_arm(4));
  const EffectData data = scene.data(false);
  Touches touches;
  touches.q = scene.q;
  for (int i = 0; i < 40; ++i) touches.point.push_back(i % 3);
  touches.planes = {{"deck", {1, 6, 11, 16, 20}}};
  touches.known_distances = {{0, 1, 0.3}};
  const Measurement m = to_measurement(scene.arm, touches);
  ArmParameters parameters = make_parameters(scene.arm, m, {scene.arm.base()}, {scene.arm.tool()},
                                             {{Vec3::UnitZ(), Vec3::Zero(), 0.1}}, {});
  add_all(parameters, one_of_each(data), data);
  const Eigen::VectorXd x = somewhere(parameters, 0.02, 6);
  for (const Criterion criterion : {Criterion::kCentroid, Criterion::kPairs}) {
    ArmResiduals system(parameters, m, criterion, false, 1);
    system.set_noise({1e-3, 2e-3}, parameters.nominal());
    expect_slopes(system, parameters, x);
  }
}

TEST(EffectColumns, JointDerivativeHoldsWhatEffectsDo) {
  const Scene scene(irregular_arm(3));
  const EffectData data = scene.data();
  const Measurement m = measurement_of(scene.arm, scene.q, true);
  ArmParameters parameters = columns_of(scene.arm, m);
  add_all(parameters, one_of_each(data), data);
  const ChainDerivatives chain(parameters, somewhere(parameters, 0.05, 5), {});
  ChainFrames frames;
  for (Index row = 0; row < 5; ++row) {
    Eigen::VectorXd q = scene.q.row(row);
    Vec3 tip;
    const Eigen::Matrix3Xd jacobian = chain.joint_jacobian(q.data(), row, 0, 0, frames, tip);
    const auto at = [&] {
      return Vec3(chain.tip(q.data(), row, 0, 0, frames, nullptr, nullptr, 0).translation());
    };
    EXPECT_LT((tip - at()).norm(), 1e-14);
    for (Index j = 0; j < q.size(); ++j) {
      q[j] += 1e-5;
      const Vec3 up = at();
      q[j] -= 2e-5;
      const Vec3 slope = (up - at()) / 2e-5;
      q[j] += 1e-5;
      EXPECT_LT((slope - jacobian.col(j)).norm(), 1e-8);
    }
  }
}

/// A known effect is estimated together with the geometry, from realistic measurements.
TEST(EffectColumns, SearchFindsTheSizes) {
  Scene scene(built_arm(ur10e(), 1e-3, 1), 200);
  const EffectData data = scene.data(false);
  const auto of = [&](const std::string& name, auto good) {
    return variants_where(name, data, good).at(0);
  };
  const std::vector<EffectVariant> hidden{
      of("joint_harmonic",
         [](const auto& v) { return v.joint == 2 && v.settings.at("order") == 2.0; }),
      of("joint_coupling", [](const auto& v) { return v.joint == 4 && v.settings.at("by") == 3; }),
      of("backlash", [](const auto& v) { return v.joint == 1; }),
      of("thermal", [](const auto&) { return true; }), of("base_shift", [](const auto& v) {
        return v.settings.contains("from") && v.settings.at("from") == 9.0;
      })};
  Tracked tracked;
  tracked.q = scene.q;
  tracked.position.resize(200, 3);
  const auto time_order = [&](Index i) { return scene.covariates.at("temperature")(i, 0); };
  const double mean = scene.covariates.at("temperature").mean();
  const Put shift{{1e-3, -2e-3, 5e-4}, {1e-3, 0.0, -2e-3}};
  for (Index i = 0; i < 200; ++i) {
    const Eigen::VectorXd q = scene.q.row(i);
    Wrong wrong;
    wrong.joints = Eigen::VectorXd::Zero(6);
    wrong.joints[2] = 3e-3 * std::cos(2.0 * q[2]) - 1e-3 * std::sin(2.0 * q[2]);
    wrong.joints[4] = 2e-3 * q[3];
    wrong.joints[1] = -0.5 * 4e-3 * scene.covariates.at("direction")(i, 1);
    wrong.growth = 2.3e-5 * (time_order(i) - mean);
    if (scene.covariates.at("session")(i, 0) == 9.0) wrong.behind[0] = shift;
    tracked.position.row(i) = plain_forward(scene.arm, q, wrong).translation().transpose();
  }
  const Measurement m = to_measurement(ur10e(), tracked);
  Arm drawing = ur10e();
  ArmParameters parameters =
      make_parameters(drawing, m, {Pose::Identity()}, {scene.arm.tool()}, {}, {.free_base = true});
  const std::size_t geometry = parameters.parameters.size();
  add_all(parameters, hidden, data);
  const auto gauge = find_redundant(parameters, m, {.free_base = true}, false, {});
  EXPECT_EQ(gauge.size(), 6U) << "effects are none of its business";
  std::vector<int> free;
  for (int i = 0; i < static_cast<int>(parameters.parameters.size()); ++i) {
    if (std::none_of(gauge.begin(), gauge.end(), [i](const auto& g) { return g.column == i; })) {
      free.push_back(i);
    }
  }
  ArmResiduals system(parameters, m, Criterion::kCentroid, false, 1);
  system.set_free(free);
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(system.columns());
  const Eigen::VectorXd x = system.values(solve_least_squares(system, start).y);
  Eigen::VectorXd truth(11);
  truth << 3e-3, -1e-3, 2e-3, 4e-3, 2.3e-5, shift.shift, shift.turn;
  // Redundant lengths are at nominal, a millimetre off, and grow by that much less.
  EXPECT_LT(system.deviations(x).norm(), 1e-5);
  EXPECT_LT((x.tail(11) - truth).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_NEAR(x[x.size() - 7], 2.3e-5, 1e-8);

  // The same values held act as the free ones did, and without them the arm alone does worse.
  for (std::size_t i = 0; i < parameters.parameters.size(); ++i)
    parameters.parameters[i].nominal = x[i];
  std::erase_if(free, [&](int c) { return c >= static_cast<int>(geometry); });
  system.set_free(free);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(system.columns());
  EXPECT_EQ(system.values(nothing), parameters.nominal());
  EXPECT_LT(system.deviations(system.values(nothing)).norm(), 1e-5);
  truncate_parameters(parameters, geometry);
  EXPECT_EQ(parameters.perturbations.size(), 0U);
  const Eigen::VectorXd alone = system.values(solve_least_squares(system, nothing).y);
  EXPECT_GT(system.deviations(alone).norm(), 1e-3);
}

TEST(EffectColumns, NamesAreUniqueAndTellTheForm) {
  const Scene scene(irregular_arm(3));
  const EffectData data = scene.data();
  ArmParameters parameters = columns_of(scene.arm, measurement_of(scene.arm, scene.q, true));
  std::set<std::string> names;
  for (const auto& effect : library_effects()) {
    for (const EffectVariant& v : effect->variants(data)) {
      EXPECT_TRUE(names.insert(variant_name(v)).second) << variant_name(v);
      EXPECT_EQ(v.effect, effect->info().name);
      EXPECT_FALSE(v.alias_group.empty());
      for (const EffectParameter& p : v.parameters) EXPECT_FALSE(p.unit.empty()) << p.name;
    }
  }
  const EffectVariant v = variants_of("joint_coupling", data).front();
  const int first = add_effect(parameters, v, perturbations_of(*effect_named(v.effect), v, data));
  EXPECT_EQ(parameters.parameters[first].name, "joint_coupling(joint=0,by=1).ratio");
  EXPECT_EQ(parameters.parameters[first].group, "joint_coupling(joint=0,by=1)");
  EXPECT_EQ(parameters.slots[first].kind, ParameterKind::kEffect);
  EXPECT_EQ(geometry_parameters(parameters), static_cast<std::size_t>(first));
}

/// A unit of each column moves the tip of an arm of a metre or two by about a millimetre.
TEST(EffectColumns, ScalesAreAlike) {
  const Scene scene(irregular_arm(3));
  const EffectData data = scene.data();
  const Measurement m = measurement_of(scene.arm, scene.q, false);
  ArmParameters parameters = columns_of(scene.arm, m);
  const auto first = static_cast<Index>(parameters.parameters.size());
  add_all(parameters, one_of_each(data), data);
  ArmResiduals system(parameters, m, Criterion::kCentroid, false, 1);
  system.set_noise({1.0, 1.0}, parameters.nominal());
  const Eigen::MatrixXd jacobian = system.jacobian(parameters.nominal());
  for (Index c = first; c < jacobian.cols(); ++c) {
    const double rms = jacobian.col(c).norm() / std::sqrt(40.0);
    EXPECT_GT(rms, 1e-4) << parameters.parameters[c].name;
    EXPECT_LT(rms, 2e-2) << parameters.parameters[c].name;
  }
}

TEST(EffectColumns, TheSameBytesForAnyNumberOfThreads) {
  const Scene scene(irregular_arm(3), 700);
  const EffectData data = scene.data();
  Measurement m = measurement_of(scene.arm, scene.q, true);
  ArmParameters parameters = columns_of(scene.arm, m);
  add_all(parameters, one_of_each(data), data);
  const Eigen::VectorXd x = somewhere(parameters, 0.01, 5);
  const ArmResiduals one(parameters, m, Criterion::kCentroid, false, 1);
  const ArmResiduals three(parameters, m, Criterion::kCentroid, false, 3);
  const Eigen::VectorXd y = one.scaled(x);
  EXPECT_EQ(one.normal_equations(y.data()), three.normal_equations(y.data()));
  EXPECT_EQ(one.jacobian(x), three.jacobian(x));
}

/// A subset of the rows gives those rows of the whole.
TEST(EffectColumns, RowsOfAPartKeepTheirActions) {
  const Scene scene(irregular_arm(3));
  const EffectData data = scene.data();
  const Measurement m = measurement_of(scene.arm, scene.q, false);
  ArmParameters parameters = columns_of(scene.arm, m);
  add_all(parameters, one_of_each(data), data);
  const Eigen::VectorXd x = somewhere(parameters, 0.01, 5);
  std::vector<int> rows;
  for (int i = 0; i < m.rows(); i += 3) rows.push_back(i);
  const Measurement third = subset(m, rows);
  const Eigen::Matrix3Xd all =
      ArmResiduals(parameters, m, Criterion::kCentroid, false, 1).deviations(x);
  const Eigen::Matrix3Xd some =
      ArmResiduals(parameters, third, Criterion::kCentroid, false, 1).deviations(x);
  for (Index i = 0; i < some.cols(); ++i) EXPECT_EQ(some.col(i), all.col(3 * i));
}

TEST(EffectColumns, PosesOfNoRowAreThoseOfTheArmAlone) {
  const Scene scene(irregular_arm(3));
  const EffectData data = scene.data();
  ArmParameters parameters = columns_of(scene.arm, measurement_of(scene.arm, scene.q, false));
  const auto alone = static_cast<Index>(parameters.parameters.size());
  add_all(parameters, one_of_each(data), data);
  Eigen::VectorXd x = parameters.nominal();
  x.tail(x.size() - alone).setConstant(0.1);
  std::vector<int> wanted(parameters.parameters.size());
  std::iota(wanted.begin(), wanted.end(), 0);
  const ChainDerivatives chain(parameters, x, wanted);
  ChainFrames frames;
  Eigen::Matrix3Xd shift(3, x.size());
  const Pose pose =
      chain.tip(scene.q.row(0).data(), kNoRow, 0, 0, frames, shift.data(), nullptr, 3);
  EXPECT_LT((pose.matrix() - plain_forward(scene.arm, scene.q.row(0), {}).matrix()).norm(), 1e-12);
  EXPECT_TRUE(shift.rightCols(x.size() - alone).isZero(0.0));
}

}  // namespace
}  // namespace bathyal
