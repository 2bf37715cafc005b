// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "bathyal/vehicle/tree/body_tree.hpp"

namespace bathyal {

/// Sets the loads of a moment; what it leaves stays as it was. `joints` are efforts, and are not
/// looked at where a joint motion is given.
using TreeLoadsFunction =
    std::function<void(double time, const BodyTreeState& state, TreeLoads& loads)>;

/// Coordinates, rates and accelerations that are carried out, one a link.
struct TreeJointMotion {
  std::vector<double> q = {};
  std::vector<double> rate = {};
  std::vector<double> acceleration = {};
};
/// Sets the motion of a moment.
using TreeJointMotionFunction = std::function<void(double time, TreeJointMotion& motion)>;

struct SimulateTreeOptions {
  double duration = 0.0;  ///< [s], 0 or more
  double step = 0.01;     ///< [s], above 0
  double start = 0.0;     ///< time of the first state [s]

  /// \throw std::invalid_argument
  void check() const;
};

/// States one step apart, the first and the last among them.
struct TreeMotionRecord {
  std::vector<double> time;
  std::vector<BodyTreeState> state;
};

/// Advances a tree step by step, in deep water, as `simulate` does a vehicle alone: by
/// Runge–Kutta's method of fourth order.
class TreeIntegrator {
 public:
  /// \param loads null: none. \param motion null: the joints move under their efforts; else they
  /// follow it.
  TreeIntegrator(BodyTree tree, TreeLoadsFunction loads, TreeJointMotionFunction motion);

  /// The loads at a state, and the joints set to their motion, if there is one.
  /// \throw std::invalid_argument for a motion of another count than links
  const TreeLoads& at(double time, BodyTreeState& state);

  /// \throw Error where the motion runs away: it is no longer finite
  void step(double time, double step, BodyTreeState& state);

 private:
  using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 13 + 2 * BodyTree::kMostLinks, 1>;

  void set_state(const Numbers& flat);
  Numbers rate(double time, const Numbers& flat);

  BodyTree tree_;
  TreeLoadsFunction loads_;
  TreeJointMotionFunction motion_;
  BodyTreeState state_;  // and what follows: filled anew at each stage
  TreeLoads loads_now_;
  TreeJointMotion motion_now_;
  TreeAcceleration found_;
};

/// A whole motion by TreeIntegrator; with a joint motion, coordinates and rates of `start` are not
/// looked at.
/// \throw std::invalid_argument for a step beyond the stability limit of the fastest mode at the
///        first state, a pose that is not rigid, numbers of another count than links
/// \throw Error where the motion runs away: it is no longer finite
TreeMotionRecord simulate_tree(const BodyTree& tree, const BodyTreeState& start,
                               const TreeLoadsFunction& loads,
                               const TreeJointMotionFunction& motion,
                               const SimulateTreeOptions& options);

/// The largest step at which no mode of a tree about a state grows where it should not [s]; the
/// joints are held, or free.
double largest_stable_step(const BodyTree& tree, const BodyTreeState& state, const TreeLoads& loads,
                           bool joints_held);

}  // namespace bathyal
