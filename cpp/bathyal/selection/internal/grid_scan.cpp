// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/grid_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bathyal/base/parallel.hpp"
#include "bathyal/estimation/gram.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/selection/candidate_set.hpp"
#include "bathyal/selection/decisions.hpp"

namespace bathyal::selection {
namespace {

constexpr std::size_t kTermsAtOnce = 32;

}  // namespace

std::vector<ScannedTerm> scan(const Model& model, const std::vector<int>& terms,
                              const Eigen::MatrixXd& basis, const Eigen::VectorXd& residual,
                              double dof, int num_threads) {
  const Eigen::VectorXd unexplained_residual = residual - basis * (basis.transpose() * residual);
  const double total = unexplained_residual.squaredNorm();
  std::vector<ScannedTerm> out(terms.size());
  parallel_for(terms.size(), kTermsAtOnce, num_threads, [&](std::size_t begin, std::size_t end) {
    const std::vector<Eigen::MatrixXd> columns =
        model.columns(std::span(terms).subspan(begin, end - begin));
    // One product for all: with few columns it costs as much as with many.
    const Eigen::MatrixXd all = concatenate_columns(columns);
    const Eigen::MatrixXd all_shared = inner_products(basis, all, num_threads);
    const Eigen::VectorXd all_xtr = all.transpose() * unexplained_residual;
    Index first = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const auto own = all.middleCols(first, columns[i - begin].cols());
      const auto shared = all_shared.middleCols(first, own.cols());
      const auto xtr = all_xtr.segment(first, own.cols());
      first += own.cols();
      const double least = least_length(own);
      const Eigen::MatrixXd square = own.transpose() * own - shared.transpose() * shared;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(square);
      Eigen::VectorXd inverse = eigen.eigenvalues();
      double width = 0.0;
      for (double& value : inverse) {
        const bool seen = value > least * least;
        width += seen ? 1.0 : 0.0;
        value = seen ? 1.0 / (1.0 + value) : 0.0;
      }
      const Eigen::VectorXd along = eigen.eigenvectors().transpose() * xtr;
      out[i] = {terms[i], -std::numeric_limits<double>::infinity(), 0.0, width};
      const double still_free = dof - width;
      if (width == 0.0 || !(still_free > 0.0)) continue;
      out[i].explained = along.dot(inverse.asDiagonal() * along);
      const double rest = std::max(total - out[i].explained, 1e-12 * total);
      out[i].gain = 0.5 * dof * std::log(total / rest) -
                    complexity_penalty(width, out[i].explained / width / (rest / still_free)) -
                    Decisions::kTermPenalty;
    }
  });
  return out;
}

std::vector<int> peaks(const std::vector<ScannedTerm>& family, int count) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < family.size(); ++i) {
    const bool over_left = i == 0 || family[i].gain > family[i - 1].gain;
    const bool over_right = i + 1 == family.size() || family[i].gain >= family[i + 1].gain;
    if (std::isfinite(family[i].gain) && over_left && over_right) found.push_back(i);
  }
  std::stable_sort(found.begin(), found.end(),
                   [&](std::size_t a, std::size_t b) { return family[a].gain > family[b].gain; });
  std::vector<int> out;
  for (const std::size_t i : found) {
    if (static_cast<int>(out.size()) == count) break;
    out.push_back(family[i].term);
  }
  return out;
}

}  // namespace bathyal::selection
