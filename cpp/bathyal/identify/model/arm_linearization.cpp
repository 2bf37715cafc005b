// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/arm_linearization.hpp"

#include <utility>

namespace bathyal {

selection::Linearization to_linearization(const ArmResiduals& system, Eigen::VectorXd residual,
                                          const Eigen::Ref<const Eigen::MatrixXd>& jacobian) {
  const Measurement& m = system.measurement();
  const Index rows = system.rows();
  const Index seen = jacobian.cols();
  const bool turns = m.has_rotation();
  selection::Linearization out;
  out.residual = std::move(residual);
  out.jacobian = Eigen::MatrixXd::Zero(rows, seen + 3 * m.points());
  out.jacobian.leftCols(seen) = jacobian;
  out.observation.assign(static_cast<std::size_t>(rows), -1);
  out.noise_rows = system.position_rows();
  for (Index i = 0; i < m.rows(); ++i) {
    if (system.is_excluded(i)) out.constrained_dof += system.axes(i) + (turns ? 3.0 : 0.0);
    out.constrained_dof += 3.0 - system.axes(i);  // rows without information
    for (Index axis = 0; axis < 3; ++axis) {
      out.observation[3 * i + axis] = static_cast<int>(i);
      if (turns) out.observation[3 * m.rows() + 3 * i + axis] = static_cast<int>(i);
    }
    if (!m.tracked && m.point[i] >= 0) {
      out.jacobian.block<3, 3>(3 * i, seen + 3 * m.point[i]) = system.row_factor(i);
    }
  }
  return out;
}

}  // namespace bathyal
