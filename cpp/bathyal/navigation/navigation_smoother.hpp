// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/navigation/navigation_filter.hpp"

namespace bathyal {

/// A filter that keeps a record of all it did (some 12 kB a step), and what of it a smoother makes.
class NavigationRecord {
 public:
  explicit NavigationRecord(NavigationOptions options);
  ~NavigationRecord();
  NavigationRecord(NavigationRecord&&) noexcept;
  NavigationRecord& operator=(NavigationRecord&&) noexcept;

  const NavigationFilter& filter() const { return filter_; }
  std::vector<NavigationStep>& steps() { return steps_; }
  void clear();

  /// The best estimate at each input's time given all readings, those after it too, and its
  /// covariance: the modified Bryson–Frazier smoother (Bierman 1973, "Fixed interval smoothing with
  /// discrete measurements"), which inverts no covariance.
  std::vector<NavigationEstimate> smoothed() const;

 private:
  NavigationFilter filter_;
  std::vector<NavigationStep> steps_;
};

}  // namespace bathyal
