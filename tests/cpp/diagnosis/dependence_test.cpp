// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "bathyal/base/random.hpp"
#include "bathyal/diagnosis/arm/internal/lack_of_fit.hpp"
#include "bathyal/diagnosis/diagnosis.hpp"
#include "bathyal/diagnosis/internal/seconds.hpp"
#include "diagnosis/small_arms.hpp"

namespace bathyal::diagnosis {
namespace {

using Kind = Dependence::Kind;

TEST(Dependence, AsTextCountsJointsFromOne) {
  EXPECT_EQ(to_text(Dependence{}), "");
  EXPECT_EQ(to_text(Dependence{Kind::kPosition}), "position");
  EXPECT_EQ(to_text(Dependence{Kind::kJoints, {2}}), "joint 3");
  EXPECT_EQ(to_text(Dependence{Kind::kJoints, {1, 2}}), "joints 2 and 3");
  EXPECT_EQ(to_text(Dependence{Kind::kTime}), "time");
  EXPECT_EQ(to_text(Dependence{Kind::kTime, {}, 12.1}), "time, period 12.1 s");
  EXPECT_EQ(to_text(Dependence{Kind::kOrder}), "the order of the rows");
  EXPECT_EQ(to_text(Dependence{Kind::kApproach, {0}}), "the last move of joint 1");
  EXPECT_EQ(to_text(Dependence{Kind::kSession}), "session");
  EXPECT_EQ(to_text(Dependence{Kind::kCovariate, {}, {}, "temperature"}), "temperature");
  EXPECT_EQ(to_text(Dependence{Kind::kCovariate, {}, {}, "direction", 2}), "direction 3");
  EXPECT_EQ(seconds(1.0 / 3.0), "0.3333 s");
}

constexpr Index kRows = 30;

RowMatrix joints() {
  RowMatrix q(kRows, 2);
  RandomStream random(8);
  for (double& value : q.reshaped()) value = random.uniform(-2.0, 2.0);
  return q;
}

std::set<Kind> kinds_of(const std::vector<LackOfFitTerm>& terms) {
  std::set<Kind> out;
  for (const LackOfFitTerm& term : terms) out.insert(term.dependence.kind);
  return out;
}

TEST(LackOfFitTerms, AreThoseThatTheDataAllow) {
  const Arm arm = two_joints();
  const EffectData bare = make_effect_data(arm, joints(), {}, false);
  EXPECT_EQ(kinds_of(make_lack_of_fit_terms(bare, {})),
            (std::set<Kind>{Kind::kJoints, Kind::kOrder, Kind::kApproach}));
  Covariates covariates;
  covariates["time"] = RowMatrix(Eigen::VectorXd::LinSpaced(kRows, 0.0, 58.0));
  covariates["temperature"] = RowMatrix(Eigen::VectorXd::LinSpaced(kRows, 5.0, 8.0));
  const EffectData all = make_effect_data(arm, joints(), covariates, false);
  const Eigen::Matrix3Xd position = Eigen::Matrix3Xd::Random(3, kRows);
  EXPECT_EQ(kinds_of(make_lack_of_fit_terms(all, position)),
            (std::set<Kind>{Kind::kPosition, Kind::kJoints, Kind::kTime, Kind::kApproach,
                            Kind::kCovariate}));
}

TEST(LackOfFitTerms, NameTheJointInErrorAndThePeriod) {
  const Arm arm = two_joints();
  Covariates covariates;
  covariates["time"] = RowMatrix(Eigen::VectorXd::LinSpaced(kRows, 0.0, 58.0));
  const EffectData data = make_effect_data(arm, joints(), covariates, false);
  double last = 1e300;
  int periods = 0;
  for (const LackOfFitTerm& term : make_lack_of_fit_terms(data, {})) {
    for (const Perturbation& one : term.perturbations()) {
      EXPECT_EQ(one.site == PerturbationSite::kJoint, term.joint >= 0) << term.description;
      if (term.joint >= 0) {
        EXPECT_EQ(one.index, term.joint) << term.description;
      }
    }
    if (!term.dependence.period || term.family != 0) continue;
    EXPECT_LT(*term.dependence.period, last);
    EXPECT_NE(term.description.find(seconds(*term.dependence.period)), std::string::npos);
    last = *term.dependence.period;
    ++periods;
  }
  EXPECT_GT(periods, 20);
  EXPECT_NEAR(last, 4.0, 0.1);  // two poses
}

}  // namespace
}  // namespace bathyal::diagnosis
