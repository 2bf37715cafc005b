// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/compensation/corrected_arm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/effects/gravity_load.hpp"

namespace bathyal {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr std::size_t kGrain = 256;  ///< poses of one task
constexpr double kStep = 1e-6;       ///< of differences [rad] or [m]

void write_pose(const Pose& pose, double* out) { Eigen::Map<RowMajor4>{out} = pose.matrix(); }

/// Calls `body` with each perturbation and its counterpart in `other`.
/// \throw std::invalid_argument where `other` has other sites
template <class Body>
void for_each_pair(const FoundEffect& found, std::vector<std::vector<Perturbation>>& perturbations,
                   const std::vector<std::vector<Perturbation>>& other, const Body& body) {
  const auto same_site = [](const Perturbation& a, const Perturbation& b) {
    return a.site == b.site && a.index == b.index;
  };
  for (std::size_t p = 0; p < perturbations.size(); ++p) {
    if (!std::equal(perturbations[p].begin(), perturbations[p].end(), other[p].begin(),
                    other[p].end(), same_site)) {
      throw_argument("effect " + found.variant.effect, "the same sites in all rows", "others");
    }
    for (std::size_t i = 0; i < perturbations[p].size(); ++i) {
      body(perturbations[p][i].values, other[p][i].values);
    }
  }
}

using RowMask = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// Rows in which an effect does the same in two evaluations.
RowMask same_rows(const FoundEffect& found, std::vector<std::vector<Perturbation>>& one,
                  const std::vector<std::vector<Perturbation>>& other, Index rows) {
  RowMask same = RowMask::Constant(rows, true);
  for_each_pair(found, one, other, [&](const RowMatrix& a, const RowMatrix& b) {
    for (Index i = 0; i < rows; ++i) same[i] = same[i] && a.row(i) == b.row(i);
  });
  return same;
}

/// An empty table is zero.
template <class Table>
void subtract(const Table& other, Table& table) {
  if (table.size() == 0) table.setZero(other.rows(), other.cols());
  if (other.size() > 0) table -= other;
}

/// (up - down) · factor, in the memory of `up`.
EffectSum difference(EffectSum up, const EffectSum& down, double factor) {
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

struct CorrectedArm::Contribution {
  Perturbations perturbations;  ///< [p] of parameter p, as `use` says
  Eigen::Array<EffectUse, Eigen::Dynamic, 1> use;
};

struct CorrectedArm::Rows {
  EffectData data;
  EffectUses uses;
  EffectSum sum;

  JointMatrix moved() const { return data.q + sum.q; }
};

std::string describe(const FoundEffect& found) {
  const int joint = found.variant.joint;
  return found.variant.effect + (joint < 0 ? "" : " of joint " + std::to_string(joint + 1));
}

SupportMask within(const EffectUses& uses) {
  return uses.unaryExpr([](EffectUse use) { return use == EffectUse::kWithin; });
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
      throw_argument("effects", "each once", describe(found) + " twice, with the same settings");
    }
  }
  for (const FoundEffect& found : effects_) {
    double period = found.effect->period(found.variant);
    for (const FoundEffect& other : effects_) {
      if (other.variant.joint != found.variant.joint || !std::isfinite(period)) continue;
      period = std::min(period, other.effect->period(other.variant));
    }
    periods_.push_back(period);
  }
  for (std::size_t e = 0; e < effects_.size(); ++e) extrapolated_.push_back(is_extrapolated(e));
  support_.check(arm_.size());
  check_effects();
}

/// Effects of one alias group along one joint were fitted as one curve: none of them holds alone.
bool CorrectedArm::is_extrapolated(std::size_t effect) const {
  const FoundEffect& found = effects_[effect];
  if (!found.effect->extrapolates(found.variant)) return false;
  if (found.variant.joint < 0 || found.variant.alias_group.empty()) return true;
  return std::none_of(effects_.begin(), effects_.end(), [&](const FoundEffect& other) {
    return other.variant.joint == found.variant.joint &&
           other.variant.alias_group == found.variant.alias_group &&
           !other.effect->extrapolates(other.variant);
  });
}

/// One row of all covariates, within the support.
Covariates CorrectedArm::known_covariates() const {
  Covariates covariates;
  for (const auto& [name, range] : support_.covariates) covariates[name] = range.low.transpose();
  if (!support_.sessions.empty()) {
    covariates["session"] = RowMatrix::Constant(1, 1, support_.sessions.front());
  }
  covariates["gravity"] = support_.gravity.low.transpose();
  return covariates;
}

/// Evaluates the effects at one pose of the support: errors then occur here and not at first use.
void CorrectedArm::check_effects() const {
  const Covariates covariates = known_covariates();
  const auto payload = support_.covariates.find("payload");
  const bool loaded = masses_known(arm_) || (payload != support_.covariates.end() &&
                                             (payload->second.high.array() > 0.0).any());
  for (const FoundEffect& found : effects_) {
    if (!loaded && found.effect->needs_weight(found.variant)) {
      throw_argument("effect " + found.variant.effect,
                     "an arm whose links have masses, or a `payload` in the data",
                     "neither: no weight acts on the arm");
    }
    for (const std::string& name : found.effect->info().needs) {
      if (!covariates.contains(name)) {
        throw_argument("support", name + ", which " + describe(found) + " needs",
                       list_of(covariates));
      }
    }
  }
  const JointMatrix q = support_.joints.low.transpose();
  prepare(view_of(q), covariates);
}

CorrectedPoses CorrectedArm::forward(JointView q, const Covariates& covariates,
                                     int num_threads) const {
  return poses_of(prepare(q, covariates), num_threads);
}

CorrectedPoses CorrectedArm::forward_of_record(JointView q, const Covariates& covariates,
                                               int num_threads) const {
  return poses_of(prepare(q, covariates, true), num_threads);
}

CorrectedPoses CorrectedArm::poses_of(const Rows& rows, int num_threads) const {
  const JointMatrix moved = rows.moved();
  CorrectedPoses result{bathyal::forward(arm_, view_of(moved), num_threads), rows.uses};
  const auto count = static_cast<std::size_t>(moved.rows());
  parallel_for(count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    CorrectedFrames frames;
    for (std::size_t i = begin; i < end; ++i) {
      if (!rows.sum.chained[i]) continue;
      const auto row = static_cast<Index>(i);
      compute_corrected_frames(arm_, rows.data.q.row(row).data(), rows.sum, row, frames);
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
  CorrectedPoses result{bathyal::forward_links(arm_, view_of(moved), num_threads), rows.uses};
  const auto count = static_cast<std::size_t>(q.rows());
  parallel_for(count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    CorrectedFrames frames;
    for (std::size_t i = begin; i < end; ++i) {
      if (!rows.sum.chained[i]) continue;
      const auto row = static_cast<Index>(i);
      compute_corrected_frames(arm_, rows.data.q.row(row).data(), rows.sum, row, frames);
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
  const std::vector<EffectSum> by_joint = derivative_by_joint(rows.data.q, covariates);
  const auto count = static_cast<std::size_t>(q.rows());
  const std::size_t width = 6 * static_cast<std::size_t>(size());
  CorrectedJacobians result{std::vector<double>(count * width), rows.uses};
  parallel_for(count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    CorrectedFrames frames;
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Index>(i);
      compute_corrected_frames(arm_, rows.data.q.row(row).data(), rows.sum, row, frames);
      Eigen::MatrixXd numbers = corrected_jacobian(arm_, frames, rows.sum, by_joint, row);
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

std::vector<std::vector<Support::Gap>> CorrectedArm::gaps() const {
  std::vector<std::vector<Support::Gap>> gaps;
  for (Index j = 0; j < size(); ++j) {
    double period = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < effects_.size(); ++e) {
      const int joint = effects_[e].variant.joint;
      if (joint == j || joint < 0) period = std::min(period, periods_[e]);
    }
    gaps.push_back(support_.gaps_wider_than(period, j));
  }
  return gaps;
}

EffectUses CorrectedArm::effect_uses(JointView q, const Covariates& covariates) const {
  return prepare(q, covariates).uses;
}

std::vector<FixedEffect> CorrectedArm::fixed_effects(JointView q,
                                                     const Covariates& covariates) const {
  check_joint_values(arm_, q);
  const QueryRows rows = clamp_to_support(arm_, support_, q, covariates);
  const std::vector<char> usable = usable_effects(covariates);
  std::vector<FixedEffect> fixed;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    if (!usable[e]) continue;
    fixed.push_back(
        {effects_[e].variant, effects_[e].values, contribution(e, rows, true).perturbations});
  }
  return fixed;
}

/// Of a harmonic or curve along a joint: its average over the training values of that joint.
CorrectedArm::Perturbations CorrectedArm::average(std::size_t effect) const {
  constexpr Index kPlaces = 256;
  const FoundEffect& found = effects_[effect];
  JointMatrix q = support_.joints.low.transpose().replicate(kPlaces, 1);
  q.col(found.variant.joint) =
      support_.training_values(found.variant.joint, periods_[effect], kPlaces);
  Perturbations perturbations = perturbations_of(
      *found.effect, found.variant, clamp_to_support(arm_, support_, q, known_covariates()).query);
  for (std::vector<Perturbation>& of_parameter : perturbations) {
    for (Perturbation& perturbation : of_parameter)
      perturbation.values = perturbation.values.colwise().mean().eval();
  }
  return perturbations;
}

CorrectedArm::Contribution CorrectedArm::contribution(std::size_t effect, const QueryRows& rows,
                                                      bool usable) const {
  const FoundEffect& found = effects_[effect];
  const Index count = rows.query.rows();
  Contribution out;
  out.use.setConstant(count, usable ? EffectUse::kWithin : EffectUse::kOmitted);
  if (!usable) return out;
  out.perturbations = perturbations_of(*found.effect, found.variant, rows.query);
  if (found.effect->info().by_difference) return out;
  RowMatrix near = rows.low.q;
  const bool in_gap = support_.leave_gaps(periods_[effect], near);
  if (!rows.beyond && !in_gap) return out;
  const auto perturbations_at = [&](EffectData data) {
    data.q = near;
    return perturbations_of(*found.effect, found.variant, data);
  };
  Perturbations low = perturbations_at(rows.low);
  const Perturbations high = perturbations_at(rows.high);
  const RowMask inside = same_rows(found, out.perturbations, low, count) &&
                         same_rows(found, out.perturbations, high, count);
  if (inside.all()) return out;
  const RowMask known = same_rows(found, low, high, count);
  const EffectUse beyond = extrapolated_[effect] != 0 ? EffectUse::kExtrapolated : EffectUse::kHeld;
  for (Index i = 0; i < count; ++i) {
    if (!inside[i]) out.use[i] = known[i] ? beyond : EffectUse::kOmitted;
  }
  for_each_pair(found, out.perturbations, low, [&](RowMatrix& values, const RowMatrix& at_edge) {
    for (Index i = 0; i < count; ++i) {
      if (out.use[i] == EffectUse::kHeld) {
        values.row(i) = at_edge.row(i);
      } else if (out.use[i] == EffectUse::kOmitted) {
        values.row(i).setZero();
      }
    }
  });
  const int joint = found.variant.joint;
  if (joint < 0 || !std::isfinite(periods_[effect])) return out;
  // From the value at the edge to the average, so that the tip does not jump.
  const Eigen::ArrayXd share = support_.edge_weights(
      rows.query.q.col(joint).array(), near.col(joint).array(), periods_[effect], joint);
  for_each_pair(found, out.perturbations, average(effect),
                [&](RowMatrix& values, const RowMatrix& mean) {
                  for (Index i = 0; i < count; ++i) {
                    if (out.use[i] != EffectUse::kHeld) continue;
                    values.row(i) = mean.row(0) + share[i] * (values.row(i) - mean.row(0));
                  }
                });
  return out;
}

CorrectedArm::Rows CorrectedArm::prepare(JointView q, const Covariates& covariates,
                                         bool recording) const {
  check_joint_values(arm_, q);
  QueryRows rows = clamp_to_support(arm_, support_, q, covariates);
  rows.query.recording = rows.low.recording = rows.high.recording = recording;
  const std::vector<char> usable = usable_effects(covariates);
  EffectUses uses(q.rows(), static_cast<Index>(effects_.size()));
  EffectSum sum(arm_, q.rows());
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const Contribution own = contribution(e, rows, usable[e] != 0);
    uses.col(static_cast<Index>(e)) = own.use;
    sum.add(own.perturbations, effects_[e].values);
  }
  return {std::move(rows.query), std::move(uses), std::move(sum)};
}

std::vector<char> CorrectedArm::usable_effects(const Covariates& covariates) const {
  std::vector<char> usable(effects_.size(), 1);
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    for (const std::string& name : effects_[e].effect->info().needs) {
      if (covariates.contains(name)) continue;
      if (!covariates.empty()) {
        throw_argument("covariates", name + ", which " + describe(effects_[e]) + " needs",
                       list_of(covariates));
      }
      usable[e] = 0;
    }
  }
  return usable;
}

std::vector<EffectSum> CorrectedArm::derivative_by_joint(const JointMatrix& q,
                                                         const Covariates& covariates) const {
  std::vector<EffectSum> by_joint;
  JointMatrix stepped = q;
  for (Index j = 0; j < size(); ++j) {
    stepped.col(j) = q.col(j).array() + kStep;
    EffectSum up = prepare(view_of(stepped), covariates).sum;
    stepped.col(j) = q.col(j).array() - kStep;
    const EffectSum down = prepare(view_of(stepped), covariates).sum;
    by_joint.push_back(difference(std::move(up), down, 1.0 / (2.0 * kStep)));
    stepped.col(j) = q.col(j);
  }
  return by_joint;
}

}  // namespace bathyal
