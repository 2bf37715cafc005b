// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/estimation/gram.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/identify/model/effect_parameters.hpp"

// Results at the current estimate.

namespace bathyal::diagnosis {

std::vector<FoundEffect> ArmModel::found() const {
  std::vector<FoundEffect> out;
  auto at = static_cast<Index>(geometry_);
  for (const int term : active_) {
    const Source& source = sources_[term];
    const auto wide = static_cast<Index>(source.variant.parameters.size());
    out.push_back({source.effect, source.variant, x_.segment(at, wide)});
    at += wide;
  }
  return out;
}

double ArmModel::dof() const {
  const Eigen::MatrixXd& base = linearization_.jacobian;
  const auto effects = static_cast<Index>(problem_.parameters.parameters.size() - geometry_);
  return static_cast<double>(base.rows() - base.cols() - effects) - linearization_.constrained_dof;
}

Eigen::MatrixXd ArmModel::covariance() const {
  const ArmResiduals& system = *problem_.system;
  const Eigen::MatrixXd jacobian = derivatives(x_);
  const Index effects = jacobian.cols() - observable_.rows();
  const Eigen::MatrixXd scanned = setting_derivatives();
  Eigen::MatrixXd all(jacobian.rows(), observable_.cols() + effects + scanned.cols());
  all << product(jacobian, admissible_changes(), system.num_threads()), scanned;
  Eigen::VectorXd scale(all.cols());
  for (Index c = 0; c < scale.size(); ++c) {
    const double length = all.col(c).norm();
    scale[c] = length > 0.0 ? 1.0 / length : 0.0;
    all.col(c) *= scale[c];
  }
  const RankReport rank =
      numerical_rank(qr_factor(all, system.num_threads()), kCollinearityTolerance);
  const Eigen::MatrixXd root = scale.asDiagonal() * rank.directions.leftCols(rank.rank) *
                               rank.singular_values.head(rank.rank).cwiseInverse().asDiagonal();
  Eigen::MatrixXd own = root.bottomRows(effects + scanned.cols());
  for (Index i = 0; i < effects; ++i) {
    own.row(i) *= problem_.parameters.parameters[geometry_ + static_cast<std::size_t>(i)].scale;
  }
  const Eigen::VectorXd y = system.scaled(x_);
  double squares = system.cost(y.data());
  for (Index i = 0; i < effects; ++i) {  // less the prior penalty
    const Parameter& column =
        problem_.parameters.parameters[geometry_ + static_cast<std::size_t>(i)];
    squares -= std::pow(y[observable_.rows() + i] * column.scale / column.prior_std, 2);
  }
  return squares / dof() * (own * own.transpose());
}

Arm ArmModel::arm() const { return arm_at(x_); }

Arm ArmModel::arm_at(const Eigen::VectorXd& x) const {
  const ArmState state = state_at(problem_.parameters, x);
  Arm arm = state.arm;
  arm.set_base(state.bases[0]);
  arm.set_tool(state.tools[0]);
  return arm;
}

Eigen::Matrix3Xd ArmModel::deviations() const {
  if (m_.tracked || active_.empty()) return problem_.system->deviations(x_);
  EffectData recorded = data_;
  recorded.q = m_.q;
  ArmParameters parameters = problem_.parameters;
  truncate_parameters(parameters, geometry_);
  for (const int term : active_) {
    const Source& source = sources_[term];
    add_effect(parameters, source.variant,
               bathyal::perturbations_of(*source.effect, source.variant, recorded));
  }
  ArmResiduals system(parameters, m_, Criterion::kCentroid, false, problem_.system->num_threads());
  system.set_observation_weights(problem_.system->observation_weights());
  system.set_row_whitening(problem_.system->row_whitening());
  return system.deviations(x_);
}

Eigen::Matrix3Xd ArmModel::in_metres(const Eigen::VectorXd& rows) const {
  return problem_.system->errors_of(rows);
}

double ArmModel::mean_noise() const {
  const std::vector<Eigen::Matrix3d> covariances = problem_.system->error_covariances();
  double variances = 0.0, rows = 0.0;
  for (Index i = 0; i < m_.rows(); ++i) {
    if (problem_.system->is_excluded(i)) continue;
    variances += m_.weights[i] * covariances[i].trace();
    rows += 3.0;
  }
  return rows > 0.0 ? std::sqrt(variances / rows) : noise();
}

double ArmModel::mean_unit() const {
  const std::vector<Eigen::Matrix3d> covariances = problem_.system->error_covariances();
  double precisions = 0.0, rows = 0.0;
  for (Index i = 0; i < m_.rows(); ++i) {
    if (problem_.system->is_excluded(i)) continue;
    precisions += covariances[i].inverse().trace() / m_.weights[i];
    rows += 3.0;
  }
  return rows > 0.0 ? std::sqrt(rows / precisions) : noise();
}

}  // namespace bathyal::diagnosis
