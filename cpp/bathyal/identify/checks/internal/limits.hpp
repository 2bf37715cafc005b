// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::identify {

/// The constants that decide a warning of an identification, each with what it decides. Warnings
/// are for people, who act on them by hand: the thresholds are farther out than those of
/// selection::Decisions, which decide what a model is made of.
struct Limits {
  // Another arm, or one far from its drawing.
  /// Residual [rms], as a share of the length of the chain, from which it cannot be this arm.
  static constexpr double kWrongArmShare = 0.01;
  static constexpr double kFolded = 0.5;  ///< [rad] from which a row was turned over by the search
  static constexpr double kFoldedSigma = 3.0;  ///< of it: else it is undetermined
  /// How far the parameters of a row may lie from nominal before the search counts as diverged:
  /// more than tolerances of makers and assembly [m], [rad].
  static constexpr double kFarLength = 10e-3;
  static constexpr double kFarAngle = 0.05;
  static constexpr double kFarSigma = 4.0;  ///< of a reported change from nominal
  static constexpr double kStrain = 6.0;    ///< a change by more of the prior's std is reported too

  // Rows that contradict the others.
  static constexpr double kFalseAlarm = 0.01;  ///< probability that a clean fit has an outlier
  static constexpr double kMinSigma = 6.0;  ///< below it a residual may be in the tail of the noise
  static constexpr double kMinDistance = 5e-5;  ///< [m] no touch is an outlier at less
  static constexpr double kMaxMeanRatio = 1.5;  ///< mean over median square of normal residuals
  /// A row belongs to another point that is nearer than this share of its distance from its own.
  static constexpr double kDistanceRatio = 0.2;

  // Residuals that depend on the joints.
  static constexpr double kStructureP = 1e-3;      ///< p-value up to which it is reported
  static constexpr double kStructureShare = 0.02;  ///< of the variance, from which it is
  static constexpr double kStructureSize = 1e-5;   ///< [m] likewise: no arm is asked for less
  static constexpr double kJointP = 0.01;          ///< p-value up to which a joint is named
  static constexpr double kStructureDof = 5.0;  ///< left for the noise: with less there is no test

  // The noise.
  static constexpr double kNoiseRatio = 1.5;  ///< found over given, from which they contradict
  static constexpr double kFewDof = 10.0;     ///< with fewer the noise is a rough guess

  // Lengths.
  static constexpr double kLoosePrior = 3e-3;   ///< [m] more than makers allow themselves
  static constexpr double kShrunk = 0.01;       ///< an arm smaller by this share under such a prior
  static constexpr double kMostStretch = 0.02;  ///< of the arm: no maker misses by more
  /// A given length is wrong by more than this share (the scale is known no better) and length [m].
  static constexpr double kLengthShare = 0.03;
  static constexpr double kLengthLeast = 3e-3;
  static constexpr double kLengthSigma = 4.0;  ///< of a small contradiction

  // Poses.
  static constexpr double kStill = 1e-3;         ///< [rad] or [m] a joint that never moved
  static constexpr double kHardly = 0.35;        ///< [rad] one that hardly moved: 20 deg
  static constexpr double kHardlySlides = 0.02;  ///< [m]
  static constexpr double kNarrow = 0.44;        ///< [rad] the tool's attitudes are alike: 25 deg
  static constexpr double kBeyondLimit = 2e-3;   ///< [rad] or [m] a joint beyond its limits
};

}  // namespace bathyal::identify
