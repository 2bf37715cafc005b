// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <set>
#include <vector>

#include "bathyal/diagnosis/vantage.hpp"

namespace bathyal {

/// Forms that explain what a base model leaves, and units that do not belong.
struct Explanation {
  std::vector<int> forms;
  Eigen::VectorXd trust;  ///< (units,) 0 of those that are left out
  double score = -std::numeric_limits<double>::infinity();
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
  /// The best set where the subject stands, from `start` on; scans look again beside it.
  std::vector<int> best_forms(std::vector<int> start, int scans);

  /// Library forms that are worth a pool.
  const std::vector<int>& candidates() const { return candidates_; }
  void remember(int form);

 private:
  void add_peaks(const Ground& beside);
  std::vector<int> sharpened(std::vector<int> forms);
  Explanation explain(Eigen::VectorXd trust);

  Vantage& vantage_;
  std::function<void()> still_at_it_;
  std::vector<int> candidates_;
  std::set<int> is_sharp_;  ///< forms of scans that were looked at closely
};

}  // namespace bathyal
