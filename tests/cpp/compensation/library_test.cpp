// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "bathyal/compensation/corrected_arm.hpp"
#include "bathyal/geometry/rotation_vector.hpp"
#include "support/plain_effects.hpp"

// Corrected arms that carry the effects of the library: the chain of identification is another one,
// and must come to the same.

namespace bathyal {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

JointView view(const RowMatrix& q) { return {q.data(), q.rows(), q.cols()}; }

Pose pose_of(const std::vector<double>& poses, Index row) {
  Pose pose;
  pose.matrix() = Eigen::Map<const RowMajor4>(&poses[16 * static_cast<std::size_t>(row)]);
  return pose;
}

/// One form of each effect with values at which joints and frames move by about `size`, and the
/// columns of identification at the same.
struct Library {
  explicit Library(const Scene& of, double size, const std::string& only = "")
      : scene(of),
        measurement(measurement_of(scene.arm, scene.q, true)),
        parameters(columns_of(scene.arm, measurement)),
        x(parameters.nominal()) {
    const EffectData data = scene.data();
    for (const auto& effect : library_effects()) {
      const std::vector<EffectVariant> variants = effect->variants(data);
      if (variants.empty() || (!only.empty() && effect->info().name != only)) continue;
      add(effect, variants[variants.size() / 2], data, size);
    }
  }

  void add(const std::shared_ptr<const Effect>& effect, const EffectVariant& variant,
           const EffectData& data, double size) {
    const int first = add_effect(parameters, variant, perturbations_of(*effect, variant, data));
    const auto count = static_cast<Index>(variant.parameters.size());
    FoundEffect& one = found.emplace_back(FoundEffect{effect, variant, Eigen::VectorXd(count)});
    x.conservativeResize(x.size() + count);
    for (Index p = 0; p < count; ++p) {
      const double sign = p % 2 == 0 ? 1.0 : -0.7;
      one.values[p] = sign * size / 1e-3 * parameters.parameters[first + p].scale;
      x[first + p] = one.values[p];
    }
  }

  CorrectedArm model() const { return {scene.arm, found, support_of(scene.q, scene.covariates)}; }

  const Scene& scene;
  Measurement measurement;
  ArmParameters parameters;
  Eigen::VectorXd x;
  std::vector<FoundEffect> found;
};

void expect_the_chain_of_identification(const Library& library) {
  const Scene& scene = library.scene;
  const ChainDerivatives chain(library.parameters, library.x, {});
  ChainFrames frames;
  const CorrectedPoses found = library.model().forward(view(scene.q), scene.covariates);
  EXPECT_TRUE(within(found.uses).all());
  double moved = 0.0;
  for (Index i = 0; i < scene.q.rows(); ++i) {
    const double* q = scene.q.row(i).data();
    const Pose identified = chain.tip(q, i, 0, 0, frames, nullptr, nullptr, 0);
    EXPECT_LT((identified.matrix() - pose_of(found.poses, i).matrix()).cwiseAbs().maxCoeff(),
              1e-12);
    const Pose rigid = plain_forward(scene.arm, scene.q.row(i), {});
    moved = std::max(moved, (identified.translation() - rigid.translation()).norm());
  }
  EXPECT_GT(moved, 1e-4);
}

TEST(CorrectedLibrary, EachEffectIsThatOfIdentification) {
  const Scene scene(irregular_arm(3));
  int tried = 0;
  for (const auto& effect : library_effects()) {
    const Library library(scene, 1e-3, effect->info().name);
    if (library.found.empty()) continue;
    SCOPED_TRACE(effect->info().name);
    expect_the_chain_of_identification(library);
    ++tried;
  }
  EXPECT_EQ(tried, 15);
}

TEST(CorrectedLibrary, AllTogetherAreThoseOfIdentification) {
  const Scene scene(irregular_arm(4));
  expect_the_chain_of_identification(Library(scene, 5e-3));
}

TEST(CorrectedLibrary, JacobianIsTheDerivativeOfForward) {
  const Scene scene(irregular_arm(5), 12);
  const Library library(scene, 1e-3);
  const CorrectedArm model = library.model();
  // In the middle of the support, where no step leaves it.
  RowMatrix q = scene.q;
  const Eigen::RowVectorXd middle = q.colwise().mean();
  for (Index i = 0; i < q.rows(); ++i) q.row(i) = middle + 0.5 * (q.row(i) - middle);
  const CorrectedJacobians found = model.jacobian(view(q), scene.covariates);
  constexpr double kStep = 2e-6;
  for (Index j = 0; j < q.cols(); ++j) {
    RowMatrix up = q, down = q;
    up.col(j).array() += kStep;
    down.col(j).array() -= kStep;
    const CorrectedPoses above = model.forward(view(up), scene.covariates);
    const CorrectedPoses below = model.forward(view(down), scene.covariates);
    for (Index i = 0; i < q.rows(); ++i) {
      const Pose a = pose_of(above.poses, i), b = pose_of(below.poses, i);
      Eigen::Vector<double, 6> numeric;
      numeric << (a.translation() - b.translation()) / (2.0 * kStep),
          vector_of(a.linear() * b.linear().transpose()) / (2.0 * kStep);
      const JointView jacobian(&found.jacobians[static_cast<std::size_t>(6 * q.cols() * i)], 6,
                               q.cols());
      EXPECT_LT((numeric - jacobian.col(j)).cwiseAbs().maxCoeff(), 1e-7) << i << " " << j;
    }
  }
}

/// Rows mean the same in any data set: nothing is derived from the other rows.
TEST(CorrectedLibrary, ARowMeansTheSameAlone) {
  const Scene scene(irregular_arm(3));
  Library library(scene, 1e-3);
  std::erase_if(library.found, [](const FoundEffect& f) { return f.effect->info().by_difference; });
  const CorrectedArm model = library.model();
  const CorrectedPoses all = model.forward(view(scene.q), scene.covariates);
  for (const Index row : {0, 17, 39}) {
    Covariates alone;
    for (const auto& [name, values] : scene.covariates) alone[name] = values.row(row);
    const RowMatrix q = scene.q.row(row);
    const CorrectedPoses one = model.forward(view(q), alone);
    EXPECT_LT(
        (pose_of(all.poses, row).matrix() - pose_of(one.poses, 0).matrix()).cwiseAbs().maxCoeff(),
        1e-13);
  }
}

TEST(CorrectedLibrary, IdentificationHoldsEffects) {
  const Scene scene(ur10e(), 80);
  const Library library(scene, 1e-3, "joint_harmonic");
  const CorrectedArm model = library.model();
  const std::vector<FixedEffect> held = model.fixed_effects(view(scene.q), scene.covariates);
  ASSERT_EQ(held.size(), 1U);
  EXPECT_EQ(held[0].values, library.found[0].values);
  RowMatrix far = scene.q;
  far.row(3).setConstant(50.0);
  far.row(5).setConstant(60.0);
  const RowMatrix beyond =
      model.fixed_effects(view(far), scene.covariates)[0].perturbations[0][0].values;
  EXPECT_EQ(beyond.row(3), beyond.row(5));  // at the average over the support
  EXPECT_NE(beyond.row(3), held[0].perturbations[0][0].values.row(3));
  EXPECT_EQ(beyond.row(4), held[0].perturbations[0][0].values.row(4));
}

}  // namespace
}  // namespace bathyal
