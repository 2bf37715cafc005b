// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
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
  int blocks = 10;                      ///< that are held out in turn, 3 … 50
  /// Odds of a rival against the best explanation from which the two cannot be told apart, 0 … 1.
  double rival_odds = 0.05;
  /// Structure left over, as a share of the variance that the names removed, from which they are
  /// not the cause; 0 or more.
  double leftover = 0.25;
  int num_next_poses = 8;  ///< of `next_poses`, 0 to 1 000
  int num_threads = 0;     ///< 0 = all; the same bytes for any number

  void check() const;
};

/// Called with the share of the work that is done, 0 … 1, and what comes next, also within a long
/// stage; may throw to stop.
using DiagnosisProgress = std::function<void(double done, const std::string& stage)>;

/// What the model of an arm gets wrong, by its measurements.
struct Diagnosis {
  explicit Diagnosis(const Arm& arm) : fit(arm), arm(arm) {}

  Verdict verdict = Verdict::kNone;
  std::vector<NamedEffect> effects;  ///< those that explain most first; partial when unknown
  std::vector<Cause> ambiguous;      ///< all causes among which these data cannot choose
  RowMatrix next_poses;              ///< (m, n) poses that would tell them apart
  std::vector<Structure> lack_of_fit_before;  ///< in the residuals of geometry alone, beyond noise;
                                              ///< where none is, the least unlikely of all
  Structure unexplained;                      ///< beside all that was named; size 0 when nothing
  HeldOut held_out;
  double gain = 0.0;               ///< (r₀² - r₁²) / (r₀² - σ²) of held-out rms
  ArmFit fit;                      ///< geometry alone
  Arm arm;                         ///< geometry found together with the effects
  std::vector<FoundEffect> found;  ///< the effects that move the arm
  Support support;                 ///< of the data: with `arm` and `found` it makes a CorrectedArm
  double noise = 0.0;              ///< standard deviation of a measurement, per axis [m]
  std::string noise_source;        ///< "repeats of 12 poses" …
  double detectable = 0.0;         ///< size of an effect that would have been found, per axis [m]
  Eigen::Matrix3Xd residuals_before;  ///< (3, N) geometry alone [m]
  Eigen::Matrix3Xd residuals_after;   ///< (3, N) with the effects [m]
  std::vector<std::string> warnings;  ///< sentences
};

/// Shows what the best rigid model of the arm gets wrong, names the cause, and measures the gain on
/// data that it did not use. See docs/how_it_diagnoses.md for how each step decides.
/// A covariate that is missing (NaN) in some rows is not used; rows that repeat another to the last
/// digit count once; warnings say so.
/// \throw std::invalid_argument for bad data or options, another number of joints, an effect that
///        is given twice
Diagnosis diagnose(const Arm& arm, const Touches& touches, const DiagnoseOptions& options = {},
                   const std::vector<std::shared_ptr<const Effect>>& effects = library_effects(),
                   const DiagnosisProgress& progress = {});
Diagnosis diagnose(const Arm& arm, const Tracked& tracked, const DiagnoseOptions& options = {},
                   const std::vector<std::shared_ptr<const Effect>>& effects = library_effects(),
                   const DiagnosisProgress& progress = {});

}  // namespace bathyal
