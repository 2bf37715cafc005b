// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bathyal/selection/model.hpp"

namespace bathyal {

inline constexpr int kLeastBlocks = 3;  ///< fewer hold nothing out

/// Which units are held out together: (units,) block numbers 0 … count - 1.
struct Blocks {
  std::vector<int> of;
  int count = 0;
  std::string how;  ///< a sentence
};

/// Positions of rows `q` that lie within `near` of one another in every column, as numbers that
/// near-twins share; twins of twins are twins.
std::vector<int> find_twins(const Eigen::Ref<const Eigen::MatrixXd>& q, double near);

/// `wanted` blocks of units that follow one another in time, or of runs of units from all over a
/// list without times, cut inside each session alike, twins always in one block; by points, where
/// units have them and there are enough. Sessions of fewer units than blocks are dealt out over
/// them one after another. Fewer blocks where there are few units; one, which cannot be held out,
/// where twins chain everything together.
Blocks make_blocks(const Units& units, int wanted = 10);

}  // namespace bathyal
