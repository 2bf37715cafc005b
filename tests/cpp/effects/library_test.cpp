// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/plain_effects.hpp"

// What each effect of the library means, against formulas written down here.

namespace bathyal {
namespace {

const Scene& odd_scene() {
  static const Scene scene(irregular_arm(3));
  return scene;
}

TEST(Effects, HarmonicIsAWaveOfTheRecordedValue) {
  const Scene& scene = odd_scene();
  std::set<int> joints;
  for (const EffectVariant& v : variants_of("joint_harmonic", scene.data())) {
    if (!joints.insert(v.joint).second) continue;  // one order a joint
    const double k = v.settings.at("order");
    expect_means(scene, v, [&](Index i, const Eigen::VectorXd& p) {
      const double q = scene.q(i, v.joint);
      return wrong_joint(scene.arm, v.joint, p[0] * std::cos(k * q) + p[1] * std::sin(k * q));
    });
  }
  EXPECT_EQ(joints.size(), 4U);
}

TEST(Effects, MapIsASumOfWavesOverTheTurnOrTheTravel) {
  const Scene& scene = odd_scene();
  for (const int joint : {1, 2}) {  // slides, turns
    const double w =
        joint == 2 ? 1.0
                   : 2.0 * kPi / (1.5 * (scene.q.col(1).maxCoeff() - scene.q.col(1).minCoeff()));
    const auto maps = variants_where("joint_map", scene.data(), [&](const EffectVariant& v) {
      return v.joint == joint && v.settings.at("terms") == 3;
    });
    ASSERT_EQ(maps.size(), 1U);
    expect_means(scene, maps[0], [&](Index i, const Eigen::VectorXd& p) {
      double curve = 0.0;
      for (int term = 1; term <= 3; ++term) {
        const double angle = term * w * scene.q(i, joint);
        curve += p[2 * term - 2] * std::cos(angle) + p[2 * term - 1] * std::sin(angle);
      }
      return wrong_joint(scene.arm, joint, curve);
    });
  }
}

TEST(Effects, ScaleCouplingAndBacklashMoveOneJoint) {
  const Scene& scene = odd_scene();
  EXPECT_EQ(variants_of("joint_scale", scene.data()).size(), 4U);
  for (const EffectVariant& v : variants_of("joint_scale", scene.data())) {
    expect_means(scene, v, [&](Index i, const Eigen::VectorXd& p) {
      return wrong_joint(scene.arm, v.joint, p[0] * scene.q(i, v.joint));
    });
  }
  EXPECT_EQ(variants_of("joint_coupling", scene.data()).size(), 12U);
  for (const EffectVariant& v : variants_of("joint_coupling", scene.data())) {
    const int by = static_cast<int>(v.settings.at("by"));
    EXPECT_NE(by, v.joint);
    expect_means(scene, v, [&](Index i, const Eigen::VectorXd& p) {
      return wrong_joint(scene.arm, v.joint, p[0] * scene.q(i, by));
    });
  }
  EXPECT_EQ(variants_of("backlash", scene.data()).size(), 4U);
  for (const EffectVariant& v : variants_of("backlash", scene.data())) {
    expect_means(scene, v, [&](Index i, const Eigen::VectorXd& p) {
      const double direction = scene.covariates.at("direction")(i, v.joint);
      return wrong_joint(scene.arm, v.joint, -0.5 * p[0] * direction);
    });
  }
}

TEST(Effects, SessionsMoveTheBaseAndTheTool) {
  const Scene& scene = odd_scene();
  const RowMatrix& session = scene.covariates.at("session");
  const int flange = static_cast<int>(scene.arm.joints().size()) + 1;
  for (const auto& tried : {std::pair{"base_shift", 0}, std::pair{"tool_change", flange}}) {
    const char* name = tried.first;
    const int frame = tried.second;
    const auto variants = variants_of(name, scene.data());
    ASSERT_EQ(variants.size(), 5U);  // the last two move without a turn
    expect_means(scene, variants[4], [&](Index i, const Eigen::VectorXd& p) {
      if (session(i, 0) < 9.0) return Wrong{};
      return wrong_frame(frame, p.head<3>(), Vec3::Zero());
    });
    for (const auto& start : {std::pair{0, 7.0}, std::pair{1, 9.0}}) {
      const int index = start.first;
      const double from = start.second;
      EXPECT_EQ(variants[index].settings.at("from"), from);
      expect_means(scene, variants[index], [&](Index i, const Eigen::VectorXd& p) {
        if (session(i, 0) < from) return Wrong{};
        return wrong_frame(frame, p.head<3>(), p.segment<3>(3));
      });
    }
    EXPECT_EQ(variants[2].parameters[0].name, "shift_x_2");
    EXPECT_EQ(variants[2].parameters[11].name, "turn_z_3");
    expect_means(scene, variants[2], [&](Index i, const Eigen::VectorXd& p) {
      if (session(i, 0) == 4.0) return Wrong{};
      const Index at = session(i, 0) == 7.0 ? 0 : 6;
      return wrong_frame(frame, p.segment<3>(at), p.segment<3>(at + 3));
    });
  }
}

TEST(Effects, SlipMovesTheToolInAllLaterRows) {
  const Scene& scene = odd_scene();
  const RowMatrix& time = scene.covariates.at("time");
  const int flange = static_cast<int>(scene.arm.joints().size()) + 1;
  const auto moments = variants_of("tool_slip", scene.data());
  ASSERT_EQ(moments.size(), 35U);  // 3 … 37 of 40 rows
  for (const EffectVariant& v : {moments.front(), moments[14], moments.back()}) {
    const double before = v.settings.at("moment");
    int rows = 0;
    expect_means(scene, v, [&](Index i, const Eigen::VectorXd& p) {
      // Times are 100, 107 …: `before` of them come first.
      if (time(i, 0) < 100.0 + 7.0 * before - 1.0) return Wrong{};
      ++rows;
      return wrong_frame(flange, p.head<3>(), p.tail<3>());
    });
    EXPECT_EQ(rows, 40 - static_cast<int>(before));
  }
}

TEST(Effects, TemperatureGrowsLinksAndTimeMovesTheBase) {
  const Scene& scene = odd_scene();
  const RowMatrix& temperature = scene.covariates.at("temperature");
  const double mean = temperature.sum() / 40.0;
  expect_means(
      scene, variants_of("thermal", scene.data()).at(0),
      [&](Index i, const Eigen::VectorXd& p) {
        Wrong wrong;
        wrong.growth = p[0] * (temperature(i, 0) - mean);
        return wrong;
      },
      1e-3);
  expect_means(
      scene, variants_of("drift", scene.data()).at(0),
      [&](Index i, const Eigen::VectorXd& p) {
        const double since = scene.covariates.at("time")(i, 0) - 100.0;
        return wrong_frame(0, since * p.head<3>(), since * p.tail<3>());
      },
      1e-4);
}

/// Slope at `at` of the polynomial through values at times, by its coefficients.
Eigen::RowVectorXd slope_at(double at, const Eigen::VectorXd& times, const RowMatrix& values) {
  Eigen::MatrixXd powers(times.size(), times.size());
  for (Index k = 0; k < times.size(); ++k) {
    powers.col(k) = (times.array() - at).pow(static_cast<double>(k));
  }
  return powers.colPivHouseholderQr().solve(Eigen::MatrixXd(values)).row(1);
}

TEST(Effects, ClockShiftMovesJointsByTheirSpeed) {
  Scene scene = odd_scene();
  scene.covariates.erase("session");
  std::vector<Index> row_at(40);
  for (Index i = 0; i < 40; ++i) row_at[static_cast<std::size_t>(i * 17 % 40)] = i;
  expect_means(scene, variants_of("clock_shift", scene.data()).at(0),
               [&](Index i, const Eigen::VectorXd& p) {
                 const Index place = i * 17 % 40;
                 const Index first = std::clamp<Index>(place - 2, 0, 35);
                 Eigen::VectorXd times(5);
                 RowMatrix values(5, scene.q.cols());
                 for (Index k = 0; k < 5; ++k) {
                   times[k] = 7.0 * static_cast<double>(first + k);
                   values.row(k) = scene.q.row(row_at[static_cast<std::size_t>(first + k)]);
                 }
                 Wrong wrong;
                 wrong.joints = p[0] * slope_at(7.0 * static_cast<double>(place), times, values);
                 return wrong;
               });
}

TEST(Effects, ClockShiftKeepsToItsSession) {
  Scene scene(planar_arm(), 8);
  scene.covariates["time"].col(0) << 0, 1, 2, 3, 50, 51, 52, 53;
  scene.covariates["session"].col(0) << 1, 1, 1, 1, 2, 2, 2, 2;
  const EffectData data = scene.data();
  const EffectVariant v = variants_of("clock_shift", data).at(0);
  const auto perturbations = perturbations_of(*effect_named("clock_shift"), v, data);
  const Eigen::Vector4d times(0, 1, 2, 3);
  EXPECT_NEAR(perturbations[0][0].values(3, 0), slope_at(3, times, scene.q.topRows(4))[0], 1e-12);
  EXPECT_NEAR(perturbations[0][0].values(4, 0), slope_at(0, times, scene.q.bottomRows(4))[0],
              1e-12);
}

}  // namespace
}  // namespace bathyal
