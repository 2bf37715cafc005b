// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/identify/fit/residual_noise.hpp"

// The variance of the rows, and the weights of the observations.

namespace bathyal::diagnosis {
namespace {

constexpr double kNoiseSettled = 5e-3;  ///< relative

}  // namespace

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

}  // namespace bathyal::diagnosis
