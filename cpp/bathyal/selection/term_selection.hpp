// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "bathyal/selection/working_point.hpp"

namespace bathyal::selection {

/// Terms that explain the residuals of a base model, and which observations are outliers.
struct Selection {
  std::vector<int> terms;
  Eigen::VectorXd weights;  ///< (observations,) 0 of those that are excluded
};

/// The result of a search in a subset of the observations.
struct Shortlist {
  std::vector<int> terms;
  std::vector<int> candidates;  ///< terms, and what more observations may select instead
};

/// Searches the library's terms: those of scans enter by their peaks, and are scanned again given
/// the terms found so far, and at the new working point after each fit.
class TermSelector {
 public:
  /// `working_point` must outlive it. `check_stop` is called often; it may throw to stop.
  TermSelector(WorkingPoint& working_point, std::function<void()> check_stop);

  /// The best selection; the model is fitted with it.
  /// \pre the model is fitted without terms and with all observations
  Selection select();
  /// The same from a shortlist: no other terms are tried.
  Selection select_from(const Shortlist& from);
  /// `found` updated for other row weights.
  /// \pre the model is fitted with its terms
  Selection reselect(const Selection& found) { return next_selection(found, 1); }
  /// `terms`, and candidates that more observations may select instead.
  Shortlist shortlist(const std::vector<int>& terms) const;
  /// Library terms that enter the candidate set.
  const std::vector<int>& candidates() const { return candidates_; }
  void add_candidate(int term);
  /// Those of its alias group with which `term` may not be combined and that are plausible by
  /// themselves.
  void add_kin(int term);

 private:
  /// A selection, its score, and the model's estimate with it.
  struct ScoredSelection {
    Selection selection;
    double score = 0.0;
    std::shared_ptr<const Model::Checkpoint> checkpoint;
  };
  void add_peaks(const NuisanceBasis& nuisance);
  std::vector<int> simplified(std::vector<int> terms);
  std::vector<int> refined(std::vector<int> terms);
  /// The best set at the working point, from `start` on, with at most `scans` further scans given
  /// it.
  std::vector<int> best_terms(std::vector<int> start, int scans);
  Selection next_selection(const Selection& now, int scans);
  ScoredSelection search(Eigen::VectorXd weights);

  WorkingPoint& working_point_;
  std::function<void()> check_stop_;
  std::vector<int> candidates_;
  std::set<int> refined_;  ///< terms of scans whose setting was refined
};

}  // namespace bathyal::selection
