// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/identify/fit/residual_noise.hpp"

// The variance of the rows and its components, and the weights of the observations.

namespace bathyal::diagnosis {
namespace {

constexpr double kNoiseSettled = 5e-3;  ///< relative

/// Number of each row, equal where joint values were logged alike; empty where none are.
std::vector<int> rounded_alike(const Measurement& m) {
  Eigen::MatrixXd logged(m.rows(), m.q.cols() + 3);
  logged.leftCols(m.q.cols()) = m.q;
  for (Index i = 0; i < m.rows(); ++i)
    logged.row(i).tail<3>() << m.weights[i], m.station[i], m.tool[i];
  std::vector<int> out = selection::find_replicates(logged, 0.0);
  if (*std::ranges::max_element(out) + 1 == m.rows()) out.clear();
  return out;
}

}  // namespace

/// (3 N, n) d tip / d value of each joint, rows times the roots of their weights.
Eigen::MatrixXd ArmModel::joint_loads() const {
  Eigen::MatrixXd out(3 * m_.rows(), m_.q.cols());
  const ChainDerivatives walk(problem_.parameters, x_, {});
  ChainFrames frames;
  Vec3 tip;
  for (Index i = 0; i < m_.rows(); ++i) {
    out.middleRows<3>(3 * i) =
        std::sqrt(m_.weights[i]) *
        walk.joint_jacobian(m_.q.row(i).data(), i, m_.tool[i], m_.station[i], frames, tip);
  }
  return out;
}

void ArmModel::gather_variance_components() {
  const double step = quantisation_step(m_.q, nominal_);
  if (!m_.tracked && !(step > 0.0)) return;
  Eigen::MatrixXd by_joint = joint_loads();
  if (m_.tracked) gather_range_noise();
  if (m_.tracked) gather_scatter(by_joint);
  if (!(step > 0.0)) return;
  for (const Joint& joint : nominal_.joints()) {  // the step is one of angles
    if (joint.type == JointType::kPrismatic) by_joint.col(joint.coordinate).setZero();
  }
  by_joint /= std::sqrt(12.0);  // uniform over a step of 1
  variance_components_.push_back(
      {"quantisation", "joint values logged in steps", "step", "rad", 1.0, std::move(by_joint)});
  variance_components_.back().known = step;
  if (m_.tracked) variance_components_.back().source = rounded_alike(m_);
}

/// By tips of the model: measured ones contain the errors themselves.
void ArmModel::gather_range_noise() {
  const Eigen::VectorXd range = ranges();
  Eigen::MatrixXd loads(3 * m_.rows(), 3);
  for (Index i = 0; i < m_.rows(); ++i) {
    loads.middleRows<3>(3 * i) = std::sqrt(m_.weights[i]) * range[i] * Eigen::Matrix3d::Identity();
  }
  variance_components_.push_back(
      {"range_noise", "noise that grows with the range", "rate", "1", 1.0, std::move(loads)});
}

/// What may move from pose to pose: a joint, the base as it turns, the reading along the line of
/// sight.
void ArmModel::gather_scatter(const Eigen::MatrixXd& by_joint) {
  const auto add = [this](const std::string& words, int joint, Eigen::MatrixXd loads) {
    selection::VarianceComponent& component = variance_components_.emplace_back();
    component.description = words;
    component.lack_of_fit = true;
    component.joint = joint;
    component.loads = std::move(loads);
  };
  for (Index j = 0; j < by_joint.cols(); ++j) {
    add("a scatter of joint " + std::to_string(j + 1) + " from pose to pose", static_cast<int>(j),
        by_joint.col(j));
  }
  const std::vector<Vec3> world = tips();
  Eigen::MatrixXd turn(3 * m_.rows(), 3), sight(3 * m_.rows(), 1);
  for (Index i = 0; i < m_.rows(); ++i) {
    const double root = std::sqrt(m_.weights[i]);
    const Vec3& tip = world[static_cast<std::size_t>(i)];
    const Vec3 reach = tip - fit_.bases[m_.station[i]].translation();
    for (int axis = 0; axis < 3; ++axis)
      turn.block<3, 1>(3 * i, axis) = root * Vec3::Unit(axis).cross(reach);
    sight.middleRows<3>(3 * i) = root * tip.normalized();
  }
  add("a scatter of the base's attitude from pose to pose", -1, std::move(turn));
  add("a scatter along the line of sight", -1, std::move(sight));
}

/// Parameters use up degrees of freedom of each kind of row by its share: the trace of its hat
/// matrix would need the rows of every step.
bool ArmModel::update_noise() {
  ArmResiduals& system = *problem_.system;
  const double taken =
      static_cast<double>(system.columns() - observable_.rows() + observable_.cols());
  const Index positions = system.position_rows(), rotations = system.rotation_rows();
  const double share = static_cast<double>(positions) / static_cast<double>(positions + rotations);
  Eigen::VectorXd residuals(system.rows());
  const Eigen::VectorXd y = system.scaled(x_);
  system.evaluate(y.data(), residuals.data(), nullptr);
  const Noise old = system.noise();
  const Noise noise = residual_noise(system,
                                     {residuals.head(positions).squaredNorm(),
                                      residuals.segment(positions, rotations).squaredNorm()},
                                     {taken * share, taken * (1.0 - share)}, problem_.options);
  system.set_noise(noise, x_);
  return relative_change(noise, old) > kNoiseSettled;
}

void ArmModel::set_observation_weights(const Eigen::VectorXd& weights) {
  std::vector<double> factors(static_cast<std::size_t>(weights.size()));
  for (Index i = 0; i < weights.size(); ++i) {
    factors[i] = weights[i] > 0.0 ? std::max(weights[i], selection::kExcludedWeight)
                                  : selection::kExcludedWeight;
  }
  problem_.system->set_observation_weights(std::move(factors));
}

/// Whitens by the covariance 1 + Σ ratio · loads loadsᵀ of a pose's rows; replicates that share the
/// sources of a component have that part of the error in common.
void ArmModel::set_variance_ratios(const Eigen::VectorXd& ratios) {
  auto whitening = std::make_shared<ArmResiduals::RowWhitening>();
  std::map<int, ArmResiduals::RowWhitening::SharedError> shared;
  for (Index i = 0; i < m_.rows(); ++i) {
    Eigen::Matrix3d own = Eigen::Matrix3d::Identity(), common = Eigen::Matrix3d::Zero();
    int source = -1;
    for (Index f = 0; f < ratios.size(); ++f) {
      const selection::VarianceComponent& component =
          variance_components_[static_cast<std::size_t>(f)];
      const auto loads = component.loads.middleRows<3>(3 * i);
      const bool is_own = component.source.empty();
      (is_own ? own : common) += ratios[f] * (loads * loads.transpose());
      if (!is_own) source = component.source[static_cast<std::size_t>(i)];
    }
    whitening->factors.push_back(
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(own).operatorInverseSqrt());
    if (common.isZero(0.0)) continue;
    ArmResiduals::RowWhitening::SharedError& error = shared[source];
    error.poses.push_back(static_cast<int>(i));
    error.covariance = whitening->factors.back() * common * whitening->factors.back();
  }
  for (auto& [source, error] : shared) whitening->shared.push_back(std::move(error));
  problem_.system->set_row_whitening(std::move(whitening));
}

Eigen::MatrixXd ArmModel::whitened(const Eigen::MatrixXd& loads) const {
  return problem_.system->whitened(loads);
}

}  // namespace bathyal::diagnosis
