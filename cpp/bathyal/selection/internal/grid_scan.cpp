// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/grid_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bathyal/base/parallel.hpp"
#include "bathyal/estimation/gram.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/selection/candidate_set.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kFormsAtOnce = 32;

}  // namespace

std::vector<ScannedForm> scan(const Subject& subject, const std::vector<int>& forms,
                              const Eigen::MatrixXd& basis, const Eigen::VectorXd& misfit,
                              double freedom, int num_threads) {
  const Eigen::VectorXd left = misfit - basis * (basis.transpose() * misfit);
  const double total = left.squaredNorm();
  std::vector<ScannedForm> out(forms.size());
  parallel_for(forms.size(), kFormsAtOnce, num_threads, [&](std::size_t begin, std::size_t end) {
    const std::vector<Eigen::MatrixXd> columns =
        subject.columns(std::span(forms).subspan(begin, end - begin));
    // All at once: a product with a few columns costs as much as one with many.
    const Eigen::MatrixXd all = concatenate_columns(columns);
    const Eigen::MatrixXd all_shared = inner_products(basis, all, num_threads);
    const Eigen::VectorXd all_against = all.transpose() * left;
    Index first = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const auto own = all.middleCols(first, columns[i - begin].cols());
      const auto shared = all_shared.middleCols(first, own.cols());
      const auto against = all_against.segment(first, own.cols());
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
      const Eigen::VectorXd along = eigen.eigenvectors().transpose() * against;
      out[i] = {forms[i], -std::numeric_limits<double>::infinity(), 0.0, width};
      const double still_free = freedom - width;
      if (width == 0.0 || !(still_free > 0.0)) continue;
      out[i].explained = along.dot(inverse.asDiagonal() * along);
      const double rest = std::max(total - out[i].explained, 1e-12 * total);
      out[i].gain = 0.5 * freedom * std::log(total / rest) -
                    cost_of_freedom(width, out[i].explained / width / (rest / still_free)) -
                    kNameCost;
    }
  });
  return out;
}

std::vector<int> peaks(const std::vector<ScannedForm>& family, int count) {
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
    out.push_back(family[i].form);
  }
  return out;
}

}  // namespace bathyal
