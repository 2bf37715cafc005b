// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "bathyal/diagnosis/arm/internal/model.hpp"

// The variance of the rows, and the weights of the observations.

namespace bathyal::diagnosis {
namespace {

constexpr double kNoiseSettled = 5e-3;  ///< relative

}  // namespace

bool ArmModel::is_excluded(Index row) const {
  return problem_.system->observation_weights()[row] < selection::kExcludedWeight * 2.0;
}

Eigen::Array2d ArmModel::free_rows() const {
  Eigen::Array2d rows(free_position_rows(m_),
                      static_cast<double>(problem_.system->rotation_rows()));
  for (Index i = 0; i < m_.rows(); ++i) {
    if (!is_excluded(i)) continue;
    rows[0] -= !m_.tracked && m_.plane[i] >= 0 ? 1.0 : 3.0;
    if (m_.has_rotation()) rows[1] -= 3.0;
  }
  return rows;
}

bool ArmModel::update_noise() {
  ArmResiduals& system = *problem_.system;
  const auto taken =
      static_cast<double>(system.columns() - observable_.rows() + observable_.cols());
  const Index positions = system.position_rows();
  Eigen::VectorXd residuals(system.rows());
  const Eigen::VectorXd y = system.scaled(x_);
  system.evaluate(y.data(), residuals.data(), nullptr);
  const double all = static_cast<double>(positions + system.rotation_rows());
  const Eigen::Array2d free = free_rows();
  Noise noise = system.noise();
  const Noise old = noise;
  // Parameters use up degrees of freedom of each kind of row by its share.
  const auto estimate = [&](double squares, double rows, double share, double now) {
    const double dof = rows - taken * share;
    return dof > 0.5 ? std::max(now * std::sqrt(squares / dof), kLeastNoise) : now;
  };
  if (!problem_.options.noise) {
    noise.position = estimate(residuals.head(positions).squaredNorm(), free[0],
                              static_cast<double>(positions) / all, old.position);
  }
  if (m_.has_rotation() && !problem_.options.rotation_noise) {
    noise.rotation = estimate(residuals.segment(positions, system.rotation_rows()).squaredNorm(),
                              free[1], 1.0 - static_cast<double>(positions) / all, old.rotation);
  }
  system.set_noise(noise, x_);
  return std::abs(noise.position / old.position - 1.0) > kNoiseSettled ||
         std::abs(noise.rotation / old.rotation - 1.0) > kNoiseSettled;
}

void ArmModel::set_observation_weights(const Eigen::VectorXd& weights) {
  std::vector<double> factors(static_cast<std::size_t>(weights.size()));
  for (Index i = 0; i < weights.size(); ++i) {
    factors[i] = weights[i] > 0.0 ? std::max(weights[i], selection::kExcludedWeight)
                                  : selection::kExcludedWeight;
  }
  problem_.system->set_observation_weights(std::move(factors));
}

/// Whitens by the covariance 1 + Σ ratio · loads loadsᵀ of a pose's rows.
void ArmModel::set_variance_ratios(const Eigen::VectorXd& ratios) {
  auto whitening =
      std::make_shared<std::vector<Eigen::Matrix3d>>(static_cast<std::size_t>(m_.rows()));
  for (Index i = 0; i < m_.rows(); ++i) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
    for (Index f = 0; f < ratios.size(); ++f) {
      const auto loads =
          variance_components_[static_cast<std::size_t>(f)].loads.middleRows<3>(3 * i);
      covariance += ratios[f] * (loads * loads.transpose());
    }
    (*whitening)[i] =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).operatorInverseSqrt();
  }
  problem_.system->set_row_whitening(std::move(whitening));
}

}  // namespace bathyal::diagnosis
