// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

// Products of tall matrices (many rows, some hundred columns), which dominate the cost of least
// squares. The same bytes on every SIMD path and for any number of threads.

namespace bathyal {

/// (k, l) aᵀ b.
Eigen::MatrixXd inner_products(const Eigen::Ref<const Eigen::MatrixXd>& a,
                               const Eigen::Ref<const Eigen::MatrixXd>& b, int num_threads);

/// (k, k) aᵀ a.
Eigen::MatrixXd inner_products(const Eigen::Ref<const Eigen::MatrixXd>& a, int num_threads);

/// out (M, l) += a b
void add_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                 const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> out,
                 int num_threads);

/// (M, l) a b.
Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                        const Eigen::Ref<const Eigen::MatrixXd>& b, int num_threads);

}  // namespace bathyal
