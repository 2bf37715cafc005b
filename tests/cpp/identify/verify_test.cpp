// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/verify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace bathyal {
namespace {

/// The corners of a box.
PointMatrix corners() {
  PointMatrix points(8, 3);
  for (int i = 0; i < 8; ++i) points.row(i) << (i & 1), 2 * (i >> 1 & 1), 3 * (i >> 2);
  return points;
}

PointView view(const PointMatrix& points) { return {points.data(), points.rows(), 3}; }

TEST(VerifyPositions, FramesDoNotCount) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(0.1, Vec3::UnitZ()).toRotationMatrix();
  pose.translation() = Vec3(5, 6, 7);
  const PointMatrix predicted = corners();
  const PointMatrix measured =
      (predicted * pose.linear().transpose()).rowwise() + pose.translation().transpose();
  const Verification result = verify_positions(view(predicted), view(measured));
  EXPECT_LT(result.rms_after, 1e-14);
  // A turn by φ moves what is r from the axis by 2 r sin(φ/2); here mean r² = 0.25 + 1.
  EXPECT_NEAR(result.rms_before, 2.0 * std::sin(0.05) * std::sqrt(1.25), 1e-12);
  EXPECT_TRUE(result.measured_from_predicted.isApprox(pose, 1e-12));
}

TEST(VerifyPositions, AStretchIsTold) {
  const PointMatrix predicted = corners();
  PointMatrix measured = predicted;
  measured.col(2) *= 1.001;  // ± 1.5 mm along z, all of it deviation
  const Verification result = verify_positions(view(predicted), view(measured));
  EXPECT_NEAR(result.rms_after, 1.5e-3, 1e-12);
  for (const double deviation : result.deviation) EXPECT_NEAR(deviation, 1.5e-3, 1e-12);
}

TEST(VerifyPositions, PairsNameTheRows) {
  const PointMatrix predicted = corners();
  const PointMatrix measured = predicted.colwise().reverse();
  std::vector<Index> pairs;
  for (Index i = 7; i >= 0; --i) pairs.push_back(i);
  EXPECT_LT(verify_positions(view(predicted), view(measured), pairs).rms_after, 1e-12);
  const auto refused = [&](std::vector<Index> wrong) {
    EXPECT_THROW(verify_positions(view(predicted), view(measured), wrong), std::invalid_argument);
  };
  refused({8, 6, 5, 4, 3, 2, 1, 0});
  refused({-1, 6, 5, 4, 3, 2, 1, 0});
  refused({6, 6, 5, 4, 3, 2, 1, 0});
  refused({7, 6, 5});
}

TEST(VerifyPositions, MistakesAreToldByTheCallersNames) {
  const PointMatrix predicted = corners();
  PointMatrix measured = predicted.topRows(7);
  const auto text_of = [&] {
    try {
      verify_positions(view(predicted), view(measured));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(text_of(), "`positions`: expected as many rows as `predicted` (8), got 7");
  measured = predicted;
  measured.rightCols(2).setZero();
  EXPECT_EQ(text_of().substr(0, 11), "`positions`");
  measured(3, 1) = std::nan("");
  EXPECT_EQ(text_of().substr(0, 11), "`positions`");
}

}  // namespace
}  // namespace bathyal
