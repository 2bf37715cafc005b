// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/internal/checks.hpp"

#include <gtest/gtest.h>

#include "bathyal/identify/identify_arm.hpp"
#include "support/simulated_touches.hpp"

namespace bathyal::identify {
namespace {

/// Tracked poses of an arm, their fit, and its residuals.
struct Fitted {
  explicit Fitted(const Tracked& tracked)
      : arm(ur10e()), measurement(to_measurement(arm, tracked)), fit(identify_arm(arm, tracked)) {
    system.emplace(fit.arm_parameters, measurement, Criterion::kCentroid, false, 1);
    std::vector<int> free;
    for (int i = 0; i < static_cast<int>(fit.parameters.size()); ++i) {
      if (fit.parameters[i].status == Status::kIdentified) free.push_back(i);
    }
    system->set_free(free);
    system->set_noise({fit.noise, fit.noise}, fit.values);
  }

  Arm arm;
  Measurement measurement;
  ArmFit fit;
  std::optional<ArmResiduals> system;
};

Tracked measured() {
  Tracked tracked = track(built_arm(ur10e(), 1e-3, 5), 80, false, 3);
  add_noise(1e-4, 3, tracked);
  return tracked;
}

TEST(FindOutliers, NamesTheRowThatIsOffAndNoOther) {
  Tracked tracked = measured();
  const Fitted good(tracked);
  EXPECT_TRUE(find_outliers(*good.system, good.fit.values).outliers.empty());
  tracked.position(17, 1) += 0.02;
  const Fitted bad(tracked);
  const OutlierSearch search = find_outliers(*bad.system, bad.fit.values);
  EXPECT_TRUE(search.refitted);
  ASSERT_EQ(search.outliers.size(), 1U);
  EXPECT_EQ(search.outliers[0].row, 17);
  EXPECT_NEAR(search.outliers[0].distance, 0.02, 1e-3);
  EXPECT_LT(search.observation_weights[17], 1e-6);
}

TEST(ResidualStructure, FindsTheJointThatResidualsDependOn) {
  Tracked tracked = measured();
  const std::vector<double> equal(80, 1.0);
  const Fitted good(tracked);
  EXPECT_GT(test_residual_structure(*good.system, good.fit.values, equal).p, 1e-3);
  for (Index i = 0; i < tracked.q.rows(); ++i) {
    tracked.position(i, 2) += 1e-3 * std::sin(tracked.q(i, 3));
  }
  const Fitted bad(tracked);
  const ResidualStructure structure = test_residual_structure(*bad.system, bad.fit.values, equal);
  EXPECT_LT(structure.p, 1e-6);
  EXPECT_EQ(structure.coordinate, 3);
  EXPECT_GT(structure.share, 0.5);
}

TEST(AllWarnings, AreNoneForGoodDataAndNameAJointAtRest) {
  const Fitted good(measured());
  const auto warnings_of = [](const Fitted& f, const ArmFit& fit) {
    const OutlierSearch search = find_outliers(*f.system, f.fit.values);
    const ResidualStructure structure;
    return all_warnings({f.measurement, *f.system, f.arm, fit, structure, search});
  };
  EXPECT_TRUE(warnings_of(good, good.fit).empty());
  ArmFit stopped = good.fit;
  stopped.converged = false;
  ASSERT_EQ(warnings_of(good, stopped).size(), 1U);
  EXPECT_NE(warnings_of(good, stopped)[0].find("had not converged"), std::string::npos);

  Tracked at_rest = measured();
  at_rest.q.col(3).setConstant(0.4);
  const Arm built = built_arm(ur10e(), 1e-3, 5);
  for (Index i = 0; i < at_rest.q.rows(); ++i) {
    at_rest.position.row(i) =
        row_frames(built, {at_rest.q.row(i).data(), 6}).world_from_tool.translation().transpose();
  }
  add_noise(1e-4, 4, at_rest);
  const Fitted poor(at_rest);
  std::vector<std::string> texts;
  check_data({poor.measurement, *poor.system, poor.arm, poor.fit, {}, {}}, texts);
  ASSERT_FALSE(texts.empty());
  EXPECT_NE(texts[0].find("Never moved: joint 4"), std::string::npos) << texts[0];
}

}  // namespace
}  // namespace bathyal::identify
