// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/internal/model_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bathyal/compensation/corrected_arm.hpp"

namespace bathyal::diagnosis {
namespace {

using PoseNumbers = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

/// [m], and of the largest coordinate: rounding of the two computations.
constexpr double kTipRounding = 1e-9;

/// (3, N) distance of tips less residuals from the measured position, from the point's mean, or
/// from the touched plane.
Eigen::Matrix3Xd misses_of_model(const Eigen::Matrix3Xd& tips, const Diagnosis& found,
                                 const ArmModel& arm_model, const Measurement& m) {
  Eigen::Matrix3Xd out = tips - found.residuals_after;
  if (m.tracked) return out - m.position;
  std::map<int, std::vector<Index>> touches;
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] >= 0) touches[m.point[i]].push_back(i);
  }
  for (const auto& [point, rows] : touches) {
    const Vec3 center = out(Eigen::all, rows).rowwise().mean();
    for (const Index i : rows) out.col(i) -= center;
  }
  const std::vector<PlaneGuess> planes = arm_model.state().planes;
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] >= 0) continue;
    const PlaneGuess& plane = planes[m.plane[i]];
    out.col(i) = (plane.normal.dot(out.col(i) - plane.center) - plane.offset) * plane.normal;
  }
  return out;
}

/// Covariates that are not the library's.
bool lacks_own_covariate(const Covariates& covariates, Index row) {
  return std::any_of(covariates.begin(), covariates.end(), [row](const auto& covariate) {
    return !is_library_covariate(covariate.first) &&
           covariate.second.row(row).array().isNaN().any();
  });
}

}  // namespace

Eigen::Matrix3Xd tips_of_model(const Diagnosis& found, const ArmModel& arm_model,
                               const Measurement& measurement, const Covariates& covariates,
                               int num_threads) {
  const Measurement& m = measurement;
  const CorrectedArm model(found.arm, found.found, found.support);
  const CorrectedPoses poses =
      model.forward_of_record({m.q.data(), m.q.rows(), m.q.cols()}, covariates, num_threads);
  const ArmState state = arm_model.state();
  const Pose base = state.bases[0].inverse(), tool = state.tools[0].inverse();
  Eigen::Matrix3Xd tips(3, m.rows());
  for (Index i = 0; i < m.rows(); ++i) {
    Pose pose;
    pose.matrix() = Eigen::Map<const PoseNumbers>(&poses.poses[16 * static_cast<std::size_t>(i)]);
    if (m.tool[i] > 0) pose = pose * tool * state.tools[m.tool[i]];
    if (m.station[i] > 0) pose = state.bases[m.station[i]] * base * pose;
    tips.col(i) = pose.translation();
  }
  return tips;
}

void check_model(const Diagnosis& found, const ArmModel& arm_model, const Measurement& measurement,
                 int num_threads) {
  const Covariates covariates = used_covariates(arm_model.data());
  const Eigen::Matrix3Xd tips =
      tips_of_model(found, arm_model, measurement, covariates, num_threads);
  const Eigen::Matrix3Xd misses = misses_of_model(tips, found, arm_model, measurement);
  const double least = kTipRounding * (1.0 + tips.cwiseAbs().maxCoeff());
  for (Index i = 0; i < misses.cols(); ++i) {
    if (misses.col(i).norm() <= least || lacks_own_covariate(covariates, i)) continue;
    throw Error("diagnose: the model that was found gives another tip in row " + std::to_string(i) +
                " than it was fitted with, by " + millimetres(misses.col(i).norm()) +
                ": an effect acts differently than in the fit, for the same row and variant");
  }
}

}  // namespace bathyal::diagnosis
