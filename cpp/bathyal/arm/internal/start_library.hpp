// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/arm/inverse_problem.hpp"

namespace bathyal::arm {

/// Poses drawn once for a call, to begin searches from.
class StartLibrary {
 public:
  StartLibrary(const Arm& arm, const InverseProblem& problem, std::uint64_t seed);

  /// A figure of merit of every start for a target, the least is best: how far its tool is, and how
  /// near its joints are to their limits [m²].
  void score(const PlainPose& target, std::vector<double>& scores) const;

  const double* start(std::size_t index) const {
    return starts_.data() + static_cast<Index>(index) * starts_.cols();
  }

 private:
  const InverseProblem& problem_;
  JointMatrix starts_;
  std::vector<double> poses_;
  std::vector<double> limit_scores_;
};

}  // namespace bathyal::arm
