// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bathyal/arm/inverse.hpp"
#include "bathyal/compensation/effect_sum.hpp"
#include "bathyal/compensation/fixed_effect.hpp"
#include "bathyal/compensation/support.hpp"

namespace bathyal {

/// What a corrected arm does with an effect in a row.
enum class EffectUse : char {
  kWithin,        ///< its arguments lie within the support
  kExtrapolated,  ///< they lie beyond, and it follows from physics: evaluated as within
  kHeld,          ///< they lie beyond, and it follows a curve: held constant
  kOmitted,       ///< one of them is unknown
};
using EffectUses = Eigen::Array<EffectUse, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using SupportMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// (N, effects) which effects lie within the support in which row.
SupportMask within(const EffectUses& uses);

struct CorrectedPoses {
  std::vector<double> poses;  ///< world_from_tool, (N, 4, 4); of links (N, L, 4, 4)
  EffectUses uses;            ///< (N, effects)
};

struct CorrectedJacobians {
  std::vector<double> jacobians;  ///< (N, 6, n)
  EffectUses uses;
};

struct CorrectedInverse {
  InverseResult result;  ///< its errors are those of the corrected arm
  EffectUses uses;       ///< at the solution q
};

/// An arm with the result of a diagnosis: rigid geometry, effects with their values, and the
/// support of the training data.
///
/// Each pose is predicted independently: q is what the controller would record, and the effects
/// perturb joints, frames and lengths from there (effect_sum.hpp). An effect is within the support
/// in a row where its own arguments are: within the ranges of the training data, and in no gap
/// between joint values that is wider than its period (of harmonics and curves along one joint,
/// which were fitted together, the shortest). Where an argument that the effect depends on lies
/// beyond (the perturbation would differ at the nearest row within), an effect that follows from
/// physics with known arguments (Effect::extrapolates) is evaluated as within. Any other is held at
/// its value in the nearest row; a harmonic or curve along its joint, whose extrapolation is
/// undetermined, goes over from there to its average over the training data within half of its
/// period, or within the width of the stretch of training data at that edge where that is less.
/// What shares its joint and its alias group with an effect that is held was fitted together with
/// it, and is held too. The geometry was estimated together with the effects, so that omitting them
/// would give larger errors. An effect whose argument is unknown (NaN, a session without training
/// data) is omitted, as if the arm did not have it. Where all effects are omitted the result is
/// that of the rigid arm, to the last bit. Every result reports the use of each effect. An effect
/// that depends on changes from row to row (EffectInfo::by_difference) has no bounds.
///
/// Covariates, each (N, k) or one row for all: an effect that requires a missing one is omitted
/// when no covariates are given at all, and is an error when some are. `payload` defaults to 0 kg,
/// `gravity` to standard gravity. A base that moved and a tool that was changed follow `session`; a
/// tool that slipped follows `time`, without it `row` (the place in the record, counted from 0),
/// and without either has slipped.
class CorrectedArm {
 public:
  /// \throw std::invalid_argument for an effect without values, a joint that the arm does not have,
  ///         a support of another width or without a covariate that an effect requires, an effect
  ///         of weight on an arm without masses that carried nothing; and
  ///         whatever an effect throws when it is evaluated at one pose of the support.
  CorrectedArm(Arm arm, std::vector<FoundEffect> effects, Support support);

  const Arm& arm() const { return arm_; }  ///< the rigid part, with base and tool
  const std::vector<FoundEffect>& effects() const { return effects_; }
  const Support& support() const { return support_; }
  Index size() const { return arm_.size(); }
  void set_base(const Pose& world_from_base) { arm_.set_base(world_from_base); }
  void set_tool(const Pose& flange_from_tool) { arm_.set_tool(flange_from_tool); }

  /// world_from_tool of each pose q (N, n).
  /// \throw std::invalid_argument as bathyal::forward; covariates of another shape, or an
  ///         incomplete set.
  CorrectedPoses forward(JointView q, const Covariates& covariates = {}, int num_threads = 0) const;

  /// The same for the recording that the model was estimated from, all of its rows in the order in
  /// which they were taken: a tool that slipped at a row without a known time has not slipped
  /// before it.
  CorrectedPoses forward_of_record(JointView q, const Covariates& covariates = {},
                                   int num_threads = 0) const;

  /// world_from_link of every link, in the order of arm().links().
  CorrectedPoses forward_links(JointView q, const Covariates& covariates = {},
                               int num_threads = 0) const;

  /// As bathyal::jacobian. The derivative of the perturbed chain is analytic; the derivatives of
  /// the perturbations by the joints are central differences (of the perturbations, not of the
  /// pose) with a step of 1e-6 rad or m: for a harmonic of size c and order k their error is c (k³
  /// 2e-13 + k 1e-9).
  CorrectedJacobians jacobian(JointView q, const Covariates& covariates = {},
                              TipFrame frame = TipFrame::kWorld, int num_threads = 0) const;

  /// As bathyal::inverse by kDampedLeastSquares: the rigid arm is sent to the target minus the
  /// effects at the previous solution, until the corrected tip agrees to position_tolerance and
  /// angle_tolerance, 1e-9 m and rad unless given. A pose in the middle of a gap, where an effect
  /// held at one edge brings it nearer to the other, is kSingular, with the remaining error. Other
  /// statuses are those of the rigid arm: at the edge of its workspace a pose may be reported out
  /// of reach within the size of the effects.
  /// \throw std::invalid_argument as bathyal::inverse, and for kPseudoInverse.
  CorrectedInverse inverse(std::span<const double> targets, JointView starts,
                           const Covariates& covariates = {},
                           const InverseOptions& options = {}) const;

  /// Of each joint the gaps of the support in which effects are held: wider than the shortest
  /// period of those along it, and of those that are along no joint.
  std::vector<std::vector<Support::Gap>> gaps() const;

  /// What is done with each effect in each row, (N, effects).
  EffectUses effect_uses(JointView q, const Covariates& covariates = {}) const;

  /// Of each row the arguments that lie beyond the support and what is done with the effects that
  /// depend on them, as text for people; empty where every effect is within.
  std::vector<std::string> support_reasons(JointView q, const Covariates& covariates = {}) const;

  /// The effects at recorded rows, extrapolated, held constant or omitted as in every result.
  std::vector<FixedEffect> fixed_effects(JointView q, const Covariates& covariates) const;

 private:
  struct Rows;          ///< poses with the sum of the effects
  struct Contribution;  ///< of one effect, by row

  using Perturbations = std::vector<std::vector<Perturbation>>;

  Covariates known_covariates() const;
  void check_effects() const;
  Perturbations average(std::size_t effect) const;
  Contribution contribution(std::size_t effect, const QueryRows& rows, bool usable) const;
  Rows prepare(JointView q, const Covariates& covariates, bool recording = false) const;
  CorrectedPoses poses_of(const Rows& rows, int num_threads) const;
  bool is_extrapolated(std::size_t effect) const;
  std::vector<char> usable_effects(const Covariates& covariates) const;
  std::vector<EffectSum> derivative_by_joint(const JointMatrix& q,
                                             const Covariates& covariates) const;

  Arm arm_;
  std::vector<FoundEffect> effects_;
  std::vector<double> periods_;     ///< of each effect; of those along one joint the shortest
  std::vector<char> extrapolated_;  ///< whether each effect is, beyond the support
  Support support_;
};

/// "joint_harmonic of joint 3" (counted from 1), for people.
std::string describe(const FoundEffect& found);

}  // namespace bathyal
