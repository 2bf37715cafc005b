// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bathyal/compensation/support.hpp"
#include "bathyal/diagnosis/diagnosis.hpp"
#include "bathyal/effects/effect.hpp"
#include "bathyal/identify/fit/arm_fit.hpp"
#include "bathyal/identify/identify_arm.hpp"

namespace bathyal {

struct DiagnoseOptions {
  Parametrization parametrization = Parametrization::kHayati;
  std::vector<std::string> fixed = {};  ///< names of parameters to hold at nominal
  /// Prior standard deviation of every a and d about nominal [m], above 0; without it that of
  /// identify_arm: none where the data determine the scale of the arm.
  std::optional<double> length_prior = {};
  int blocks = 10;  ///< folds of the cross-validation, 3 … 50
  /// Odds of an alternative against the best explanation from which the verdict is ambiguous, 0
  /// … 1.
  double rival_odds = 0.1;
  /// Unexplained structure, as a share of the variance that the effects explain, from which the
  /// verdict is unknown; 0 or more.
  double leftover = 0.03;
  /// (N,) name of the group of each row (a placement, a day), 2 or more: they are the folds, held
  /// out whole in turn, and `blocks` is not used. Empty: folds are made.
  std::vector<std::string> groups = {};
  /// Folds of a nested cross-validation (HeldOut::Nested), each a whole diagnosis: 2 … 50, or given
  /// groups where there are some; 0: none. Of tracked poses only.
  int nested = 0;
  int num_next_poses = 8;  ///< of `next_poses`, 0 to 1 000
  int num_threads = 0;     ///< 0 = all; the same bytes for any number

  void check() const;
};

/// Called with the share of the work that is done, 0 … 1, and what comes next, also within a long
/// stage; may throw to stop.
using DiagnosisProgress = std::function<void(double done, const std::string& stage)>;

/// Errors of an arm's model, by its measurements.
struct Diagnosis {
  explicit Diagnosis(const Arm& arm) : fit(arm), arm(arm) {}

  Verdict verdict = Verdict::kNone;
  std::vector<NamedEffect> effects;  ///< largest first; partial when the verdict is unknown
  std::vector<Cause> ambiguous;      ///< causes that these data cannot distinguish, the four
                                     ///< most likely in the place of each effect
  RowMatrix next_poses;              ///< (m, n) poses that would distinguish them
  std::vector<Structure> lack_of_fit_before;  ///< of geometry alone, beyond noise;
                                              ///< where none is, the most significant
  Structure unexplained;                      ///< lack of fit of the effects; size 0 when none
  HeldOut held_out;
  double gain = 0.0;               ///< (r₀² - r₁²) / (r₀² - σ²) of held-out rms
  ArmFit fit;                      ///< geometry alone
  Arm arm;                         ///< geometry fitted together with the effects
  std::vector<FoundEffect> found;  ///< the effects that move the arm
  Support support;                 ///< of the data: with `arm` and `found` it makes a CorrectedArm
  double noise = 0.0;              ///< standard deviation of a measurement, per axis [m]
  std::string noise_source;        ///< "repeats of 12 poses" …
  bool noise_is_measured = false;  ///< by repeats; otherwise it is what the model itself leaves
  double detectable = 0.0;         ///< smallest size of an effect that is found, per axis [m]
  Eigen::Matrix3Xd residuals_before;  ///< (3, N) geometry alone [m]
  Eigen::Matrix3Xd residuals_after;   ///< (3, N) with the effects [m]
  std::vector<std::string> warnings;  ///< sentences
};

/// Tests the best rigid model of the arm for lack of fit, names the causes, and measures the gain
/// on held-out data. docs/how_it_diagnoses.md explains how each step decides. A covariate that is
/// missing (NaN) in some rows is not used; rows that repeat another to the last digit count once;
/// warnings say so.
/// \throw std::invalid_argument for bad data or options, another number of joints, an effect that
/// is
///        given twice; for an effect that these data cannot show because no weight acts on the arm
///        (links without masses, no recorded payload), unless all of the library are given
Diagnosis diagnose(const Arm& arm, const Touches& touches, const DiagnoseOptions& options = {},
                   const std::vector<std::shared_ptr<const Effect>>& effects = library_effects(),
                   const DiagnosisProgress& progress = {});
Diagnosis diagnose(const Arm& arm, const Tracked& tracked, const DiagnoseOptions& options = {},
                   const std::vector<std::shared_ptr<const Effect>>& effects = library_effects(),
                   const DiagnosisProgress& progress = {});

}  // namespace bathyal
