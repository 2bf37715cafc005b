// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "bathyal/selection/folds.hpp"
#include "bathyal/selection/working_point.hpp"

namespace bathyal {

/// Corrected p-value up to which structure is beyond noise, wherever that is asked.
inline constexpr double kBeyondNoise = 0.002;

/// Names, and probes of structure beside them.
struct Standing {
  std::vector<int> names;
  std::vector<int> probes;
  std::vector<int> all() const;
};

/// Structure that names leave: probes take part in the search, and may show that a name was only
/// the nearest thing to what is there.
class BeyondNames {
 public:
  /// All must outlive it, and `candidates` are the forms that a name may give way to.
  /// `still_at_it` is called often; it may throw to stop.
  BeyondNames(Vantage& vantage, const std::vector<int>& candidates, const Blocks& blocks,
              const Eigen::VectorXd& trust, std::function<void()> still_at_it);

  /// What stands once structure has taken part; the subject stands at its names.
  Standing look(const std::vector<int>& names);

  /// Structure beside what stands, likeliest first, each beside those before it: what took no
  /// name's place, where it is worth its freedom. Where names were `refuted` since, what they stood
  /// for is still there: all that is beyond noise.
  std::vector<Dependence> left_by(const Standing& standing, bool refuted) const;

 private:
  std::vector<int> beyond_noise(const Standing& standing) const;
  std::vector<int> foretelling(const Standing& standing, const std::vector<int>& probes);
  bool holds(const Standing& next, const Standing& standing);
  double foretold_by(const std::vector<int>& forms) const;

  Vantage& vantage_;
  const std::vector<int>& candidates_;
  const Blocks& blocks_;
  const Eigen::VectorXd& trust_;
  std::function<void()> still_at_it_;
  std::vector<int> without_place_;  ///< probes beyond noise that take no name's place
};

}  // namespace bathyal
