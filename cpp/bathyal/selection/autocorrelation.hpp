// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bathyal/selection/model.hpp"

namespace bathyal::selection {

/// Whether the residuals of like observations are alike: of one context, along one direction.
struct Autocorrelation {
  int context = 0;         ///< index in Model::contexts()
  int direction = 0;       ///< index in Model::directions()
  double moran = 0.0;      ///< Moran's I: e'Ke / e'e
  double p = 1.0;          ///< corrected for all pairs of a context and a direction
  double explained = 0.0;  ///< sum of squares that near observations have in common
};

/// Moran's I of the residuals of a fit, for each pair of a context and a direction: most
/// significant first.
///
/// S joins each observation to its nearest neighbours in the context, D resolves its rows along
/// the direction. e'D S D'e / e'e has exact moments for the residuals e of a least-squares fit
/// with normal errors (Cliff and Ord 1981, chapter 8; Tiefelsdorf 2000): what the fit itself
/// induces is accounted for. The tail is that of a shifted gamma distribution with the same three
/// cumulants; near the threshold it is that of the whole spectrum, by the saddlepoint approximation
/// (Kuonen 1999). It assumes no form of the dependence: what is smooth in the context shows.
///
/// `basis`: (M, b) orthonormal columns of all that was fitted, `dof` its residual degrees of
/// freedom; `weights`: (N,), 0 of excluded observations. Of more than kMaxObservations, evenly
/// spaced ones are tested.
std::vector<Autocorrelation> test_autocorrelation(const Model& model, const Eigen::MatrixXd& basis,
                                                  double dof, const Eigen::VectorXd& weights,
                                                  int num_threads);

}  // namespace bathyal::selection
