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

/// Which effect counts in which row, (N, effects).
using SupportMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct CorrectedPoses {
  std::vector<double> poses;  ///< world_from_tool, (N, 4, 4); of links (N, L, 4, 4)
  SupportMask in_support;     ///< which effects counted, neither held nor left out
};

struct CorrectedJacobians {
  std::vector<double> jacobians;  ///< (N, 6, n)
  SupportMask in_support;
};

struct CorrectedInverse {
  InverseResult result;    ///< its errors are those of the corrected arm
  SupportMask in_support;  ///< at the q that was found
};

/// An arm with what a diagnosis found inside: rigid geometry, effects with their values, and the
/// support of the data that taught them.
///
/// Poses are foretold one by one: q is what the controller would record, and the effects move
/// joints, frames and lengths from there (correction.hpp). An effect counts in a row where its own
/// arguments lie within the support: within the ranges that taught it, and in no gap between joint
/// values that is wider than its period (of waves and curves along one joint, which were found
/// together, the shortest). Where one lies beyond and the effect looks at it (it would
/// move something else at the nearest row within), the effect is held: a wave or curve along its
/// joint at its average over what was taught, for beyond that it may do anything; what is smooth at
/// what it does in the nearest row. Its geometry was found beside the effects, so that without them
/// the arm would be further off than either. An effect that looks at what is not known (NaN, a
/// session that nobody saw) is left out, as if the arm did not have it. Where all effects are left
/// out the answer is the rigid arm's, to the last bit. Every answer says which effects counted. An
/// effect that looks at what changes from row to row (EffectInfo::by_difference) has no bounds.
///
/// Covariates, each (N, k) or one row for all: where an effect needs one that is not told it is
/// left out when no covariates are told at all, and refused when some are. `payload` counts 0 kg,
/// `gravity` the standard's unless told. A base that moved and a tool that was changed follow
/// `session`; a tool that slipped follows `time`, and without it has slipped.
class CorrectedArm {
 public:
  /// \throw std::invalid_argument for an effect without values, a joint that the arm has not, a
  ///        support of another width or without a covariate that an effect needs; whatever an
  ///        effect throws that is tried on one pose of the support.
  CorrectedArm(Arm arm, std::vector<FoundEffect> effects, Support support);

  const Arm& arm() const { return arm_; }  ///< the rigid part, with base and tool
  const std::vector<FoundEffect>& effects() const { return effects_; }
  const Support& support() const { return support_; }
  Index size() const { return arm_.size(); }
  void set_base(const Pose& world_from_base) { arm_.set_base(world_from_base); }
  void set_tool(const Pose& flange_from_tool) { arm_.set_tool(flange_from_tool); }

  /// world_from_tool of each pose q (N, n).
  /// \throw std::invalid_argument as bathyal::forward; covariates of another shape, or one that an
  ///        effect needs and that is missing among others.
  CorrectedPoses forward(JointView q, const Covariates& covariates = {}, int num_threads = 0) const;

  /// The same of the recording that taught the model, all of its rows in the order in which they
  /// were taken: a tool that slipped at a row, of which no time is known, has not slipped before.
  CorrectedPoses forward_of_record(JointView q, const Covariates& covariates = {},
                                   int num_threads = 0) const;

  /// world_from_link of every link, in the order of arm().links().
  CorrectedPoses forward_links(JointView q, const Covariates& covariates = {},
                               int num_threads = 0) const;

  /// As bathyal::jacobian. The chain is derived as it stands; how an effect changes with the joints
  /// comes from central differences of what it moves (not of the pose), 1e-6 rad or m apart: of a
  /// harmonic of size c and order k they are off by c (k³ 2e-13 + k 1e-9).
  CorrectedJacobians jacobian(JointView q, const Covariates& covariates = {},
                              TipFrame frame = TipFrame::kWorld, int num_threads = 0) const;

  /// As bathyal::inverse by kDampedLeastSquares: the rigid arm is sent where the target lies less
  /// what the effects do at the pose found before, until the corrected tip agrees to
  /// position_tolerance and angle_tolerance, 1e-9 m and rad unless given. A pose in the middle of a
  /// gap, where an effect held at one edge brings it nearer to the other, is kSingular, with the
  /// error that is left. Statuses else are those of the rigid arm: on the edge of what it
  /// reaches a pose may be called out of reach by as little as the effects amount to.
  /// \throw std::invalid_argument as bathyal::inverse, and for kPseudoInverse.
  CorrectedInverse inverse(std::span<const double> targets, JointView starts,
                           const Covariates& covariates = {},
                           const InverseOptions& options = {}) const;

  /// Of each joint the gaps of the support in which effects are held: wider than the shortest
  /// period of those along it, and of those that are along no joint.
  std::vector<std::vector<Support::Gap>> gaps() const;

  /// Which effects count in which row, (N, effects).
  SupportMask in_support(JointView q, const Covariates& covariates = {}) const;

  /// What each effect does in recorded rows, held and left out as in every answer.
  std::vector<HeldEffect> held(JointView q, const Covariates& covariates) const;

 private:
  struct Rows;  ///< poses with what the effects move there
  struct Part;  ///< what one effect does in rows

  using Actions = std::vector<std::vector<Action>>;

  Covariates known_covariates() const;
  void try_effects() const;
  Actions average(std::size_t effect) const;
  Part part(std::size_t effect, const AskedRows& rows, bool told) const;
  Rows prepare(JointView q, const Covariates& covariates, bool recording = false) const;
  CorrectedPoses poses_of(const Rows& rows, int num_threads) const;
  std::vector<char> told(const Covariates& covariates) const;
  std::vector<Correction> correction_by_joint(const JointMatrix& q,
                                              const Covariates& covariates) const;

  Arm arm_;
  std::vector<FoundEffect> effects_;
  std::vector<double> periods_;  ///< of each effect; of those along one joint the shortest
  Support support_;
};

/// "joint_harmonic of joint 3" (counted from 1), for people.
std::string words_of(const FoundEffect& found);

}  // namespace bathyal
