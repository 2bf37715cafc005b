// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bathyal/selection/folds.hpp"
#include "bathyal/selection/working_point.hpp"

namespace bathyal::selection {

/// Terms of the library, and lack-of-fit terms that were selected with them.
struct ActiveSet {
  std::vector<int> terms;
  std::vector<int> lack_of_fit;
  std::vector<int> all() const;
};

/// A lack-of-fit term that scores better than several selected terms in their place.
struct Replacement {
  int lack_of_fit = 0;
  std::vector<int> rest;  ///< the terms that stay
  double gain = 0.0;      ///< in log evidence, over the active set
};

/// Lack of fit of a selection: lack-of-fit terms take part in the search, and may replace a term
/// that was only the nearest approximation to the structure in the residuals.
class LackOfFitCheck {
 public:
  /// All references must outlive it. `candidates` are the terms that may replace a selected one.
  /// `check_stop` is called often; it may throw to stop.
  LackOfFitCheck(WorkingPoint& working_point, const std::vector<int>& candidates,
                 const Folds& folds, const Eigen::VectorXd& weights,
                 std::function<void()> check_stop);

  /// The active set after a search that includes lack-of-fit terms; the model is fitted with its
  /// `terms`.
  ActiveSet select(const std::vector<int>& terms);

  /// Lack of fit that remains, most significant first, each given those before it: terms that did
  /// not replace a selected one and whose evidence exceeds their penalty. Where terms were
  /// `refuted` since, the structure that they described is still there: then all that is beyond
  /// noise.
  std::vector<LackOfFit> remaining(const ActiveSet& active, bool refuted) const;

 private:
  std::vector<int> significant(const ActiveSet& active) const;
  std::vector<Replacement> replacements(const ActiveSet& active) const;
  std::optional<ActiveSet> replaced(const ActiveSet& active);
  std::vector<int> predictive(const ActiveSet& active, const std::vector<int>& lack_of_fit_terms);
  bool is_improvement(const ActiveSet& next, const ActiveSet& active);
  double log_predictive_density(const std::vector<int>& terms) const;

  WorkingPoint& working_point_;
  const std::vector<int>& candidates_;
  const Folds& folds_;
  const Eigen::VectorXd& weights_;
  std::function<void()> check_stop_;
  std::vector<int> unplaced_;  ///< lack-of-fit terms beyond noise that replace no term
};

}  // namespace bathyal::selection
