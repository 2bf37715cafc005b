// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bathyal/selection/autocorrelation.hpp"
#include "bathyal/selection/folds.hpp"
#include "bathyal/selection/lack_of_fit.hpp"
#include "bathyal/selection/model.hpp"
#include "bathyal/selection/outlier_test.hpp"
#include "bathyal/selection/pure_error.hpp"
#include "bathyal/selection/term_selection.hpp"
#include "bathyal/selection/variance_components.hpp"
#include "bathyal/selection/working_point.hpp"

namespace bathyal::selection {

/// Called with the share of the work that is done, 0 … 1, and what comes next; throws to stop.
using Progress = std::function<void(double done, const std::string& stage)>;

struct SelectionOptions {
  int num_threads = 0;
  int folds = 10;  ///< of the cross-validation
  /// (observations,) 0 …: given groups, which are held out whole in turn (folds_of_groups); empty:
  /// the folds are made (make_folds).
  std::vector<int> groups = {};
};

/// A selected term and its evidence.
struct SelectedTerm {
  int term = 0;
  double explained = 0.0;         ///< increase of the residual sum of squares without it
  double f = 0.0;                 ///< Wald's statistic per column
  double width = 0.0;             ///< columns
  double p = 1.0;                 ///< by Fisher's F, corrected for multiplicity
  double size = 0.0;              ///< rms contribution given all other terms, per row [noise]
  double held_out_without = 0.0;  ///< mean squared prediction error per row without it [noise²]
  double held_out_with = 0.0;
};

struct AlternativeTerm {
  int term = 0;         ///< selected
  int replacement = 0;  ///< the term that could take its place
  double odds = 0.0;
};

/// The terms that explain the residuals of a model.
struct SelectionResult {
  bool held_out = false;  ///< there were data enough for cross-validation
  Folds folds;
  std::vector<SelectedTerm> terms;
  std::vector<SelectedTerm> lack_of_fit;  ///< structure that the terms do not explain
  /// Likeness of near residuals given the terms and `lack_of_fit`, beyond noise, most significant
  /// first.
  std::vector<Autocorrelation> autocorrelation;
  PureErrorTest pure_error;  ///< given the same
  /// Lack-of-fit components of the remaining variance, beyond noise, most significant first.
  std::vector<VarianceComponentFit> scatter;
  std::vector<AlternativeTerm> alternatives;  ///< by term, most likely first
  std::vector<LackOfFit> lack_of_fit_before;  ///< of the base model, most significant first
  std::vector<int> outliers;                  ///< observations excluded
  double base_noise = 0.0;                    ///< unit of lack_of_fit_before.size [m]
  std::vector<VarianceComponentFit> noise;    ///< variance components that were selected
  double base_squares = 0.0;                  ///< residual sum of squares of the base model
  double explained = 0.0;                     ///< sum of squares by the terms, less noise
  double unexplained = 0.0;                   ///< sum of squares by the lack of fit, less noise
  double dof = 0.0;                           ///< residual
  double detectable = 0.0;                    ///< smallest size per row that is selected [noise]
  Eigen::VectorXd error_before;               ///< (M,) held out, base model alone [noise]
  Eigen::VectorXd error_after;                ///< (M,) with the terms
  double p_value = 1.0;                       ///< of the held-out gain, by sign flips of folds
};

/// Selects terms, tests them on held-out folds and reports what they leave unexplained; the model
/// is fitted with the selected terms. The search starts from `shortlist` where it is not empty.
SelectionResult select_terms(Model& model, const SelectionOptions& options,
                             const Progress& progress, const Shortlist& shortlist = {});

/// Terms that explain the residuals of the base model, without cross-validation: the start of a
/// search in more observations. Progress is reported as the first part of that search.
Shortlist shortlist_terms(Model& model, int num_threads, const Progress& progress);

}  // namespace bathyal::selection
