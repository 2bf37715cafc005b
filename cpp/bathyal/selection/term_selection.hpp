// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "bathyal/selection/working_point.hpp"

namespace bathyal {

/// Forms that explain what a base model leaves, and units that do not belong.
struct Explanation {
  std::vector<int> forms;
  Eigen::VectorXd trust;  ///< (units,) 0 of those that are left out
};

/// What a look at some of the units finds.
struct FirstLook {
  std::vector<int> forms;
  std::vector<int> candidates;  ///< that more units may put in their place, and they themselves
};

/// Looks for explanations among the forms of the library: those of scans by their peaks, looked at
/// again beside what was found, and where the subject stands when it was fitted.
class Explainer {
 public:
  /// `vantage` must outlive it. `still_at_it` is called often; it may throw to stop.
  Explainer(Vantage& vantage, std::function<void()> still_at_it);

  /// The best explanation; the subject stands at it. The subject must stand without forms, all
  /// units trusted.
  Explanation best();
  /// The same from what a look at some of the units found: no forms but its own are asked.
  Explanation best_from(const FirstLook& look);
  /// `found` looked at again where rows weigh another way; the subject must stand at its forms.
  Explanation again(const Explanation& found) { return step_from(found, 1); }
  /// What stands, and what may take a place in it where there are more units.
  FirstLook look_at(const std::vector<int>& forms) const;
  /// Library forms that are worth a pool.
  const std::vector<int>& candidates() const { return candidates_; }
  void remember(int form);

 private:
  /// An explanation, how good it is, and where the subject stood at it.
  struct Seen {
    Explanation explanation;
    double score = 0.0;
    std::shared_ptr<const Subject::Place> place;
  };
  void add_peaks(const Ground& beside);
  std::vector<int> sharpened(std::vector<int> forms);
  /// The best set where the subject stands, from `start` on; so many `scans` look again beside it.
  std::vector<int> best_forms(std::vector<int> start, int scans);
  Explanation step_from(const Explanation& now, int scans);
  Seen explain(Eigen::VectorXd trust);

  Vantage& vantage_;
  std::function<void()> still_at_it_;
  std::vector<int> candidates_;
  std::set<int> is_sharp_;  ///< forms of scans that were looked at closely
};

}  // namespace bathyal
