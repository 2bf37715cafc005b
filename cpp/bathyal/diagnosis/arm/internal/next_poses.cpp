// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/next_poses.hpp"

#include <algorithm>
#include <numeric>

#include "bathyal/base/random.hpp"
#include "bathyal/compensation/corrected_arm.hpp"

namespace bathyal::diagnosis {
namespace {

constexpr Index kCandidates = 600;
constexpr std::size_t kMaxAlternatives = 4;
constexpr double kApart = 0.15;  ///< of a joint's range, in one joint at least

/// Poses within the ranges of the data, where the models are supported.
RowMatrix draw_poses(const Support& support) {
  const Index n = support.joints.low.size();
  RowMatrix q(kCandidates, n);
  for (Index i = 0; i < kCandidates; ++i) {
    RandomStream random(0, static_cast<std::uint64_t>(i));
    for (Index j = 0; j < n; ++j) {
      q(i, j) = random.uniform(support.joints.low[j], support.joints.high[j]);
    }
  }
  return q;
}

/// Covariates of the last row in time: the next poses are recorded after it.
Covariates last_of(const EffectData& data) {
  Covariates out;
  for (const auto& [name, table] : data.covariates) out[name] = table.row(data.order.back());
  return out;
}

Eigen::Matrix3Xd tips(const ArmModel& arm_model, const Support& support, const RowMatrix& q,
                      const Covariates& covariates) {
  const CorrectedArm arm(arm_model.arm(), arm_model.found(), support);
  const std::vector<double> poses = arm.forward({q.data(), q.rows(), q.cols()}, covariates).poses;
  Eigen::Matrix3Xd out(3, q.rows());
  for (Index i = 0; i < q.rows(); ++i) {
    for (Index axis = 0; axis < 3; ++axis) out(axis, i) = poses[16 * i + 4 * axis + 3];
  }
  return out;
}

}  // namespace

RowMatrix next_poses(ArmModel& arm_model, const selection::SelectionResult& found,
                     double rival_odds, int count) {
  const Support support = support_of(arm_model.data().q, arm_model.data().covariates);
  const RowMatrix q = draw_poses(support);
  const Covariates covariates = last_of(arm_model.data());
  std::vector<int> terms;
  for (const selection::SelectedTerm& chosen : found.terms) terms.push_back(chosen.term);
  const Eigen::Matrix3Xd best = tips(arm_model, support, q, covariates);
  Eigen::VectorXd apart = Eigen::VectorXd::Zero(kCandidates);
  std::size_t asked = 0;
  for (const selection::AlternativeTerm& alternative : found.alternatives) {
    if (alternative.odds < rival_odds || asked == kMaxAlternatives) continue;
    ++asked;
    std::vector<int> others = terms;
    std::replace(others.begin(), others.end(), alternative.term, alternative.replacement);
    arm_model.fit(others);
    apart += (tips(arm_model, support, q, covariates) - best).colwise().squaredNorm().transpose();
  }
  arm_model.fit(terms);

  std::vector<Index> order(static_cast<std::size_t>(kCandidates));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return apart[a] > apart[b]; });
  const Eigen::RowVectorXd near = kApart * (support.joints.high - support.joints.low).transpose();
  std::vector<Index> taken;
  for (const Index i : order) {
    if (static_cast<int>(taken.size()) == count || !(apart[i] > 0.0)) break;
    const bool near_another = std::any_of(taken.begin(), taken.end(), [&](Index other) {
      return ((q.row(i) - q.row(other)).cwiseAbs().array() <= near.array()).all();
    });
    if (!near_another) taken.push_back(i);
  }
  return q(taken, Eigen::all);
}

}  // namespace bathyal::diagnosis
