// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/scale_bias.hpp"

#include <limits>

#include "bathyal/estimation/gram.hpp"

namespace bathyal {
namespace {

constexpr int kMaxSteps = 20;
constexpr double kConverged = 1e-8;  ///< in units of the parameter scales: 0.01 nm and nrad

}  // namespace

Eigen::VectorXd remove_scale_bias(const ArmResiduals& system, const Eigen::VectorXd& minimum,
                                  const LeastSquaresOptions& options) {
  Eigen::VectorXd x = minimum;
  Eigen::MatrixXd both(system.rows(), system.columns() + 1);
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps && last > kConverged; ++step) {
    ArmResiduals consistent = system;
    consistent.set_joints(consistent_joints(system, x));
    const Eigen::VectorXd y = system.scaled(x);
    system.evaluate(y.data(), both.col(system.columns()).data(), nullptr);
    both.leftCols(system.columns()) = consistent.jacobian(x);
    const Eigen::VectorXd move =
        damped_step(inner_products(both, system.num_threads()), 0.0, options);
    if (!(move.norm() < last)) return step < 2 ? minimum : x;
    last = move.norm();
    x = system.values(y + move);
  }
  return x;
}

}  // namespace bathyal
