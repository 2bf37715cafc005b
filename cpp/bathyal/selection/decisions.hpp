// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace bathyal::selection {

/// The constants that decide a verdict, a name or what is excluded, each with what it decides.
/// docs/how_it_diagnoses explains them; what only concerns numerics or time is where it is used,
/// and what a caller may choose is in SelectionOptions and DiagnoseOptions.
struct Decisions {
  // Which terms are selected (log evidence).
  /// Prior odds against any term: together with `multiplicity` it bounds false positives on clean
  /// data (tests/simulated_cases/score_card.py measures how often).
  static constexpr double kTermPenalty = 4.5;
  /// A set replaces another one from this gain on.
  static constexpr double kMinScoreGain = 0.5;
  /// A setting that is plausible by itself, as a whole order, is taken although another one scores
  /// better by less: two and a half standard deviations of an order.
  static constexpr double kPreferredBonus = 3.0;
  /// A set that scores worse by more in a shortlist is dropped: four times the observations recover
  /// no more.
  static constexpr double kFarBehind = 20.0;
  /// An alternative that is less likely than a selected term by more is not reported.
  static constexpr double kMaxLogOddsDeficit = 20.0;
  /// With a smaller share of its squared length outside the span of another term of its alias
  /// group, a term has the same shape: the odds between the two stay below ten up to an effect of
  /// fifty of its standard deviations.
  static constexpr double kSameShape = 0.002;
  /// With a smaller share of its squared length outside the span of its alias group, a term is a
  /// combination of the others there, and not selected with them.
  static constexpr double kMinShareInAliasGroup = 0.1;
  /// A selected term with a larger corrected p-value is dropped.
  static constexpr double kMaxPValue = 0.05;

  // Whether structure is left.
  /// Corrected p-value up to which structure is beyond noise: the one such threshold.
  static constexpr double kBeyondNoise = 0.002;
  /// Kinds of tests that ask whether there is structure at all: lack-of-fit terms, the likeness of
  /// near residuals, pure error, scatter along what may move. Each counts the others.
  static constexpr double kStructureTests = 4.0;
  /// A lack-of-fit term is tried in place of selected terms from this gain on [log evidence].
  static constexpr double kReplacementGain = 2.0;
  /// Structure replaces none of more selected terms: so many approximate anything.
  static constexpr std::size_t kManyTerms = 6;
  /// Degrees of freedom from which replicates estimate the noise.
  static constexpr double kMinPureErrorDof = 12.0;

  // What can be held out.
  static constexpr int kMinFolds = 3;  ///< fewer allow no cross-validation
  static constexpr int kMinGivenGroups =
      2;  ///< of given groups: fewer leave nothing to predict from
  /// Degrees of freedom with fewer of which nothing is held out, and nothing named.
  static constexpr double kMinDof = 10.0;
  /// Whole groups (touched points) are folds from so many on: fewer would each be too large a share
  /// to hold out.
  static constexpr int kMinGroups = 6;

  // What is excluded, and how the noise is.
  /// Family-wise significance level of the outlier test.
  static constexpr double kOutlierLevel = 0.001;
  /// Share of observations: more are no exception, and none is excluded.
  static constexpr double kMaxOutliers = 0.2;
  /// Share of the variance from which a variance component that the record itself shows is named.
  static constexpr double kMinKnownShare = 0.04;
};

}  // namespace bathyal::selection
