// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/corrected_arm.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"

namespace bathyal {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr std::size_t kGrain = 256;  ///< poses of one task
constexpr double kStep = 1e-6;       ///< of differences [rad] or [m]

JointView view_of(const JointMatrix& q) { return {q.data(), q.rows(), q.cols()}; }

void write_pose(const Pose& pose, double* out) { Eigen::Map<RowMajor4>{out} = pose.matrix(); }

/// Whether an effect moves the same in one row of two evaluations.
bool same_row(const std::vector<Action>& one, const std::vector<Action>& other, Index row) {
  if (one.size() != other.size()) return false;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i].site != other[i].site || one[i].index != other[i].index) return false;
    if (one[i].values.row(row) != other[i].values.row(row)) return false;
  }
  return true;
}

/// What one side of a difference does not move stands still there.
template <class Table>
void subtract(const Table& other, Table& table) {
  if (table.size() == 0) table.setZero(other.rows(), other.cols());
  if (other.size() > 0) table -= other;
}

/// (up - down) · factor, in the memory of `up`.
Correction difference(Correction up, const Correction& down, double factor) {
  up.q = factor * (up.q - down.q);
  subtract(down.lengths, up.lengths);
  up.lengths *= factor;
  for (std::size_t k = 0; k < up.frames.size(); ++k) {
    subtract(down.frames[k], up.frames[k]);
    up.frames[k] *= factor;
  }
  return up;
}

std::string list_of(const Covariates& covariates) {
  std::string names;
  for (const auto& [name, values] : covariates) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace

struct CorrectedArm::Rows {
  EffectData data;
  SupportMask mask;
  Correction correction;

  JointMatrix moved() const { return data.q + correction.q; }
};

std::string words_of(const FoundEffect& found) {
  const int joint = found.variant.joint;
  return found.variant.effect + (joint < 0 ? "" : " of joint " + std::to_string(joint + 1));
}

CorrectedArm::CorrectedArm(Arm arm, std::vector<FoundEffect> effects, Support support)
    : arm_(std::move(arm)), effects_(std::move(effects)), support_(std::move(support)) {
  for (const FoundEffect& found : effects_) {
    const std::string name = "effect " + found.variant.effect;
    if (found.effect == nullptr) throw_argument(name, "an effect", "none");
    const auto parameters = static_cast<Index>(found.variant.parameters.size());
    if (found.values.size() != parameters || !found.values.allFinite()) {
      throw_argument(name,
                     "a finite value of each of " + std::to_string(parameters) + " parameters",
                     std::to_string(found.values.size()) + " values");
    }
    if (found.variant.joint < -1 || found.variant.joint >= arm_.size()) {
      throw_argument(name, "a joint from 0 to " + std::to_string(arm_.size() - 1) + ", or none",
                     std::to_string(found.variant.joint));
    }
    for (const auto& [setting, value] : found.variant.settings) {
      check_finite(name + " setting " + setting, value);
    }
    const auto alike = [&found](const FoundEffect& other) {
      return other.variant.effect == found.variant.effect &&
             other.variant.joint == found.variant.joint &&
             other.variant.settings == found.variant.settings;
    };
    if (std::count_if(effects_.begin(), effects_.end(), alike) > 1) {
      throw_argument("effects", "each once", words_of(found) + " twice, with the same settings");
    }
  }
  support_.check(arm_.size());
  try_effects();
}

/// One pose in the support shows at once what would else wait for the first use.
void CorrectedArm::try_effects() const {
  Covariates covariates;
  for (const auto& [name, range] : support_.covariates) covariates[name] = range.low.transpose();
  if (!support_.sessions.empty()) {
    covariates["session"] = RowMatrix::Constant(1, 1, support_.sessions.front());
  }
  covariates["gravity"] = support_.gravity.low.transpose();
  for (const FoundEffect& found : effects_) {
    for (const std::string& name : found.effect->info().needs) {
      if (!covariates.contains(name)) {
        throw_argument("support", name + ", which " + words_of(found) + " needs",
                       list_of(covariates));
      }
    }
  }
  const RowMatrix q = support_.joints.low.transpose();
  const AskedRows rows = ask(arm_, support_, q, covariates);
  correction(rows.asked, SupportMask::Constant(1, static_cast<Index>(effects_.size()), true));
}

CorrectedPoses CorrectedArm::forward(JointView q, const Covariates& covariates,
                                     int num_threads) const {
  const Rows rows = prepare(q, covariates);
  const JointMatrix moved = rows.moved();
  CorrectedPoses result{bathyal::forward(arm_, view_of(moved), num_threads), rows.mask};
  const auto count = static_cast<std::size_t>(q.rows());
  parallel_for(count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    CorrectedFrames frames;
    for (std::size_t i = begin; i < end; ++i) {
      if (!rows.correction.chained[i]) continue;
      const auto row = static_cast<Index>(i);
      compute_corrected_frames(arm_, rows.data.q.row(row).data(), rows.correction, row, frames);
      write_pose(frames.world_from_tool, &result.poses[16 * i]);
    }
  });
  return result;
}

CorrectedPoses CorrectedArm::forward_links(JointView q, const Covariates& covariates,
                                           int num_threads) const {
  const Rows rows = prepare(q, covariates);
  const JointMatrix moved = rows.moved();
  const std::size_t width = 16 * arm_.links().size();
  CorrectedPoses result{bathyal::forward_links(arm_, view_of(moved), num_threads), rows.mask};
  const auto count = static_cast<std::size_t>(q.rows());
  parallel_for(count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    CorrectedFrames frames;
    for (std::size_t i = begin; i < end; ++i) {
      if (!rows.correction.chained[i]) continue;
      const auto row = static_cast<Index>(i);
      compute_corrected_frames(arm_, rows.data.q.row(row).data(), rows.correction, row, frames);
      for (std::size_t k = 0; k < arm_.links().size(); ++k) {
        write_pose(frames.start_of_row(arm_, k) * arm_.links()[k].row_from_link,
                   &result.poses[width * i + 16 * k]);
      }
    }
  });
  return result;
}

CorrectedJacobians CorrectedArm::jacobian(JointView q, const Covariates& covariates, TipFrame frame,
                                          int num_threads) const {
  const Rows rows = prepare(q, covariates);
  const std::vector<Correction> by_joint = correction_by_joint(rows.data, rows.mask);
  const auto count = static_cast<std::size_t>(q.rows());
  const std::size_t width = 6 * static_cast<std::size_t>(size());
  CorrectedJacobians result{std::vector<double>(count * width), rows.mask};
  parallel_for(count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    CorrectedFrames frames;
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Index>(i);
      compute_corrected_frames(arm_, rows.data.q.row(row).data(), rows.correction, row, frames);
      Eigen::MatrixXd numbers = corrected_jacobian(arm_, frames, rows.correction, by_joint, row);
      if (frame == TipFrame::kTool) {
        const Eigen::Matrix3d tool_from_world = frames.world_from_tool.linear().transpose();
        numbers.topRows(3) = (tool_from_world * numbers.topRows(3)).eval();
        numbers.bottomRows(3) = (tool_from_world * numbers.bottomRows(3)).eval();
      }
      Eigen::Map<JointMatrix>{&result.jacobians[i * width], 6, size()} = numbers;
    }
  });
  return result;
}

SupportMask CorrectedArm::in_support(JointView q, const Covariates& covariates) const {
  check_joint_values(arm_, q);
  return mask_of(ask(arm_, support_, q, covariates), told(covariates));
}

std::vector<HeldEffect> CorrectedArm::held(JointView q, const Covariates& covariates) const {
  check_joint_values(arm_, q);
  const AskedRows rows = ask(arm_, support_, q, covariates);
  const SupportMask mask = mask_of(rows, told(covariates));
  std::vector<HeldEffect> held;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const auto column = mask.col(static_cast<Index>(e));
    if (!column.any()) continue;
    const FoundEffect& found = effects_[e];
    held.push_back(
        {found.variant, found.values, actions_of(*found.effect, found.variant, rows.asked)});
    for (std::vector<Action>& actions : held.back().actions) {
      for (Action& action : actions) {
        for (Index i = 0; i < column.size(); ++i) {
          if (!column[i]) action.values.row(i).setZero();
        }
      }
    }
  }
  return held;
}

CorrectedArm::Rows CorrectedArm::prepare(JointView q, const Covariates& covariates) const {
  check_joint_values(arm_, q);
  AskedRows rows = ask(arm_, support_, q, covariates);
  SupportMask mask = mask_of(rows, told(covariates));
  Correction sum = correction(rows.asked, mask);
  return {std::move(rows.asked), std::move(mask), std::move(sum)};
}

std::vector<char> CorrectedArm::told(const Covariates& covariates) const {
  std::vector<char> told(effects_.size(), 1);
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    for (const std::string& name : effects_[e].effect->info().needs) {
      if (covariates.contains(name)) continue;
      if (!covariates.empty()) {
        throw_argument("covariates", name + ", which " + words_of(effects_[e]) + " needs",
                       list_of(covariates));
      }
      told[e] = 0;
    }
  }
  return told;
}

SupportMask CorrectedArm::mask_of(const AskedRows& rows, const std::vector<char>& told) const {
  const Index count = rows.asked.rows();
  SupportMask mask = SupportMask::Constant(count, static_cast<Index>(effects_.size()), true);
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const auto column = static_cast<Index>(e);
    if (!told[e]) mask.col(column).setConstant(false);
    if (!told[e] || !rows.beyond || effects_[e].effect->info().by_difference) continue;
    const std::vector<Action> asked = moves_of(effects_[e], rows.asked);
    const std::vector<Action> low = moves_of(effects_[e], rows.low);
    const std::vector<Action> high = moves_of(effects_[e], rows.high);
    for (Index i = 0; i < count; ++i) {
      mask(i, column) = same_row(asked, low, i) && same_row(asked, high, i);
    }
  }
  return mask;
}

Correction CorrectedArm::correction(const EffectData& data, const SupportMask& mask) const {
  Correction sum(arm_, data.rows());
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const auto column = static_cast<Index>(e);
    if (mask.col(column).any()) sum.add(moves_of(effects_[e], data), mask.col(column));
  }
  return sum;
}

std::vector<Correction> CorrectedArm::correction_by_joint(const EffectData& data,
                                                          const SupportMask& mask) const {
  std::vector<Correction> by_joint;
  EffectData stepped = data;
  for (Index j = 0; j < size(); ++j) {
    stepped.q.col(j) = data.q.col(j).array() + kStep;
    Correction up = correction(stepped, mask);
    stepped.q.col(j) = data.q.col(j).array() - kStep;
    by_joint.push_back(difference(std::move(up), correction(stepped, mask), 1.0 / (2.0 * kStep)));
    stepped.q.col(j) = data.q.col(j);
  }
  return by_joint;
}

}  // namespace bathyal
