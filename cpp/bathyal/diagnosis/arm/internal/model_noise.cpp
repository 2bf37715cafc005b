// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "bathyal/diagnosis/arm/internal/model.hpp"

// The variance of the rows, and the weights of the observations.

namespace bathyal {
namespace {

constexpr double kNoiseSettled = 5e-3;  ///< relative

}  // namespace

bool ArmSubject::is_left_out(Index row) const {
  return problem_.system->observation_weights()[row] < kLeftOut * 2.0;
}

Eigen::Array2d ArmSubject::free_rows() const {
  Eigen::Array2d rows(free_position_rows(m_),
                      static_cast<double>(problem_.system->rotation_rows()));
  for (Index i = 0; i < m_.rows(); ++i) {
    if (!is_left_out(i)) continue;
    rows[0] -= !m_.tracked && m_.plane[i] >= 0 ? 1.0 : 3.0;
    if (m_.has_rotation()) rows[1] -= 3.0;
  }
  return rows;
}

bool ArmSubject::update_noise() {
  ArmResiduals& system = *problem_.system;
  const auto taken = static_cast<double>(system.columns() - held_.rows() + held_.cols());
  const Index positions = system.position_rows();
  Eigen::VectorXd residuals(system.rows());
  const Eigen::VectorXd y = system.scaled(x_);
  system.evaluate(y.data(), residuals.data(), nullptr);
  const double all = static_cast<double>(positions + system.rotation_rows());
  const Eigen::Array2d free = free_rows();
  Noise noise = system.noise();
  const Noise old = noise;
  // Columns take of each kind of row its share.
  const auto estimate = [&](double squares, double rows, double share, double now) {
    const double freedom = rows - taken * share;
    return freedom > 0.5 ? std::max(now * std::sqrt(squares / freedom), kLeastNoise) : now;
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

void ArmSubject::set_trust(const Eigen::VectorXd& trust) {
  std::vector<double> factors(static_cast<std::size_t>(trust.size()));
  for (Index i = 0; i < trust.size(); ++i) {
    factors[i] = trust[i] > 0.0 ? std::max(trust[i], kLeftOut) : kLeftOut;
  }
  problem_.system->set_observation_weights(std::move(factors));
}

/// Errors of a pose's rows have the covariance 1 + Σ ratio · loads loadsᵀ.
void ArmSubject::set_noise_forms(const Eigen::VectorXd& ratios) {
  auto whitening =
      std::make_shared<std::vector<Eigen::Matrix3d>>(static_cast<std::size_t>(m_.rows()));
  for (Index i = 0; i < m_.rows(); ++i) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
    for (Index f = 0; f < ratios.size(); ++f) {
      const auto loads = noise_forms_[static_cast<std::size_t>(f)].loads.middleRows<3>(3 * i);
      covariance += ratios[f] * (loads * loads.transpose());
    }
    (*whitening)[i] =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).operatorInverseSqrt();
  }
  problem_.system->set_row_whitening(std::move(whitening));
}

}  // namespace bathyal
