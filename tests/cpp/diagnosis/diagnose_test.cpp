// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/diagnose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "bathyal/arm/dh.hpp"
#include "bathyal/arm/row_frames.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

Arm six_joints() {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  DhTable table;
  table.rows = {{0.0, kQuarter, 0.1273, 0.0},  {-0.612, 0.0, 0.0, 0.0},
                {-0.5723, 0.0, 0.0, 0.0},      {0.0, kQuarter, 0.163941, 0.0},
                {0.0, -kQuarter, 0.1157, 0.0}, {0.0, 0.0, 0.0922, 0.0}};
  table.types.assign(6, JointType::kRevolute);
  return arm_from_dh(table);
}

/// Poses, and measured tips of an arm with an error in joint 1.
Tracked wavy(double size, double noise, Index rows) {
  const Arm arm = six_joints();
  Tracked out;
  out.q = RowMatrix(rows, 6);
  out.position = RowMatrix(rows, 3);
  for (Index i = 0; i < rows; ++i) {
    RandomStream random(3, static_cast<std::uint64_t>(i));
    for (Index j = 0; j < 6; ++j) out.q(i, j) = random.uniform(-2.0, 2.0);
    Eigen::VectorXd q = out.q.row(i);
    q[1] += size * std::cos(2.0 * q[1]);
    const RowFrames frames = row_frames(arm, {q.data(), 6});
    for (Index axis = 0; axis < 3; ++axis) {
      out.position(i, axis) = frames.world_from_tool.translation()[axis] + noise * random.normal();
    }
  }
  return out;
}

TEST(Diagnose, NamesAnEccentricEncoder) {
  const Diagnosis found = diagnose(six_joints(), wavy(1e-3, 1e-4, 150));
  ASSERT_EQ(found.verdict, Verdict::kNamed);
  ASSERT_EQ(found.effects.size(), 1u);
  const NamedEffect& wave = found.effects[0];
  EXPECT_EQ(wave.name, "joint_harmonic");
  EXPECT_EQ(wave.joint, 1);
  EXPECT_GT(wave.gain, 0.9);
  for (const Estimate& e : wave.parameters) {
    if (e.name == "cos") {
      EXPECT_LT(e.low, 1e-3);
      EXPECT_GT(e.high, 1e-3);
    }
  }
  EXPECT_LT(found.held_out.rms_after, 1.2 * std::sqrt(3.0) * 1e-4);
  EXPECT_GT(found.held_out.rms_before, 3.0 * found.held_out.rms_after);
}

/// Regions of joint 0, given as groups: each is predicted from the others.
TEST(Diagnose, HoldsOutGivenGroups) {
  const Tracked measured = wavy(1e-3, 1e-4, 150);
  DiagnoseOptions options;
  for (const double q : measured.q.col(0))
    options.groups.push_back(q < -0.7 ? "left" : q < 0.7 ? "middle" : "right");
  const Diagnosis found = diagnose(six_joints(), measured, options);
  EXPECT_EQ(found.held_out.blocks, 3);
  EXPECT_EQ(found.held_out.how, "3 given groups were held out in turn");
  std::map<std::string, int> rows;
  for (const auto& part : found.held_out.parts) rows[part.name] = part.rows;
  for (const std::string name : {"left", "middle", "right"})
    EXPECT_EQ(rows["group " + name], std::ranges::count(options.groups, name)) << name;
  EXPECT_NE(found.held_out.before, diagnose(six_joints(), measured).held_out.before);
}

TEST(Diagnose, RefusesGroupsThatAreNone) {
  const Tracked measured = wavy(1e-3, 1e-4, 60);
  DiagnoseOptions options;
  options.groups.assign(59, "a");
  EXPECT_THROW(diagnose(six_joints(), measured, options), std::invalid_argument);
  options.groups.assign(60, "a");
  EXPECT_THROW(diagnose(six_joints(), measured, options), std::invalid_argument);
}

TEST(Diagnose, ReportsExtrapolatedRowsSeparately) {
  const Tracked measured = wavy(1e-3, 1e-4, 150);
  std::set<Index> ends;  // rows at an end of a joint's range: outside those of all other folds
  for (Index j = 0; j < 6; ++j) {
    Index row = 0;
    measured.q.col(j).minCoeff(&row);
    ends.insert(row);
    measured.q.col(j).maxCoeff(&row);
    ends.insert(row);
  }
  std::map<std::string, int> rows;
  for (const auto& part : diagnose(six_joints(), measured).held_out.parts) {
    rows[part.name] = part.rows;
  }
  EXPECT_GE(rows["beyond others' ranges"], static_cast<int>(ends.size()));
  EXPECT_LE(rows["beyond others' ranges"], static_cast<int>(ends.size()) + 6);
  EXPECT_EQ(rows["beyond others' ranges"] + rows["within others' ranges"], 150);
}

TEST(Diagnose, GivesTheSameBytesOnAnyNumberOfThreads) {
  const Tracked data = wavy(1e-3, 1e-4, 150);
  const Diagnosis one = diagnose(six_joints(), data, {.num_threads = 1});
  const Diagnosis two = diagnose(six_joints(), data, {.num_threads = 2});
  EXPECT_EQ(one.residuals_after, two.residuals_after);
  EXPECT_EQ(one.held_out.rms_after, two.held_out.rms_after);
  EXPECT_EQ(one.effects[0].parameters[1].value, two.effects[0].parameters[1].value);
}

TEST(Diagnose, NamesSessionsAsInTheRecord) {
  Tracked data = wavy(0.0, 1e-4, 120);
  RowMatrix session(120, 1);
  for (Index i = 0; i < 120; ++i) {
    session(i, 0) = i < 60 ? 7.0 : 20261121.0;
    if (i >= 60) data.position(i, 0) += 2e-3;
  }
  data.covariates["session"] = session;
  const Diagnosis found = diagnose(six_joints(), data);
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_EQ(found.effects[0].name, "base_shift");
  EXPECT_NE(found.effects[0].description.find("from session 20261121 on"), std::string::npos)
      << found.effects[0].description;
  ASSERT_GE(found.held_out.parts.size(), 2u);
  EXPECT_EQ(found.held_out.parts[0].name, "session 7");
  EXPECT_EQ(found.held_out.parts[1].name, "session 20261121");
}

TEST(Diagnose, SizesAreMetresWhereNoiseGrowsWithTheRange) {
  Tracked data = wavy(2e-3, 0.0, 300);
  for (Index i = 0; i < data.position.rows(); ++i) {
    RandomStream random(9, static_cast<std::uint64_t>(i));
    const double range = data.position.row(i).norm();
    for (Index axis = 0; axis < 3; ++axis) data.position(i, axis) += 3e-4 * range * random.normal();
  }
  const Diagnosis found = diagnose(six_joints(), data);
  const auto named = [&](const std::string& name) {
    const auto at = std::find_if(found.effects.begin(), found.effects.end(),
                                 [&](const NamedEffect& e) { return e.name == name; });
    return at == found.effects.end() ? NamedEffect{} : *at;
  };
  const double after = std::sqrt(found.residuals_after.squaredNorm() / 900.0);
  const double before = std::sqrt(found.residuals_before.squaredNorm() / 900.0);
  ASSERT_EQ(named("range_noise").parameters.size(), 1u);
  EXPECT_NEAR(found.noise, after, 0.3 * after);
  EXPECT_NEAR(named("joint_harmonic").size, std::sqrt(before * before - after * after),
              0.3 * before);
  EXPECT_GT(named("joint_harmonic").gain, 0.5);
}

TEST(Diagnose, TwelvePosesAreTooFewToHoldAnyOut) {
  const Diagnosis found = diagnose(six_joints(), wavy(1e-3, 1e-4, 12));
  EXPECT_EQ(found.verdict, Verdict::kNone);
  EXPECT_FALSE(found.warnings.empty());
}

TEST(Diagnose, RefusesAnEffectTwice) {
  std::vector<std::shared_ptr<const Effect>> effects = library_effects();
  effects.push_back(effects.front());
  EXPECT_THROW(diagnose(six_joints(), wavy(0.0, 1e-4, 60), {}, effects), std::invalid_argument);
}

TEST(Diagnose, FarFromTheOriginNothingChanges) {
  const Tracked data = wavy(1e-3, 1e-4, 150);
  const Vec3 far(1e6, -1e6, 1e6);
  Tracked moved = data;
  moved.position.rowwise() += far.transpose();
  Arm arm = six_joints();
  Pose base = Pose::Identity();
  base.translation() = far;
  arm.set_base(base);
  const Diagnosis near = diagnose(six_joints(), data);
  // A double has a resolution of 1e-10 m there; the search may converge to within a hundredth of
  // the noise.
  for (const Diagnosis& found : {diagnose(six_joints(), moved), diagnose(arm, moved)}) {
    ASSERT_EQ(found.verdict, near.verdict);
    ASSERT_EQ(found.effects.size(), near.effects.size());
    EXPECT_LT((found.residuals_after - near.residuals_after).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((found.held_out.after - near.held_out.after).cwiseAbs().maxCoeff(), 1e-6);
    for (std::size_t p = 0; p < near.effects[0].parameters.size(); ++p) {
      const Estimate& known = near.effects[0].parameters[p];
      EXPECT_NEAR(found.effects[0].parameters[p].value, known.value,
                  std::max(0.01 * known.std, known.name == "order" ? 1e-4 : 0.0));
    }
  }
}

TEST(Diagnose, CountsDuplicateRowsOnce) {
  const Tracked data = wavy(1e-3, 1e-4, 60);
  Tracked twice = data;
  twice.q.conservativeResize(120, Eigen::NoChange);
  twice.position.conservativeResize(120, Eigen::NoChange);
  twice.q.bottomRows(60) = data.q;
  twice.position.bottomRows(60) = data.position;
  const Diagnosis once = diagnose(six_joints(), data);
  const Diagnosis found = diagnose(six_joints(), twice);
  EXPECT_EQ(found.gain, once.gain);
  ASSERT_EQ(found.residuals_after.cols(), 120);
  EXPECT_EQ(found.residuals_after.leftCols(60), once.residuals_after);
  EXPECT_EQ(found.residuals_after.rightCols(60), once.residuals_after);
  EXPECT_EQ(found.warnings.size(), once.warnings.size() + 1);
}

TEST(Diagnose, CleanDataAreClean) {
  const Diagnosis found = diagnose(six_joints(), wavy(0.0, 1e-4, 150));
  EXPECT_EQ(found.verdict, Verdict::kClean);
}

}  // namespace
}  // namespace bathyal
