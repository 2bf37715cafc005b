// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/fold_least_squares.hpp"

#include "bathyal/base/parallel.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/estimation/gram.hpp"

namespace bathyal::selection {
namespace {

/// Relative to a column's square: keeps at 0 what the other folds do not determine.
constexpr double kRidge = 1e-8;

}  // namespace

FoldLeastSquares::FoldLeastSquares(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns,
                                   const Eigen::VectorXd& prior_precision,
                                   const std::vector<int>& observation, const Folds& folds,
                                   int num_threads)
    : residual_(residual),
      columns_(columns),
      num_threads_(num_threads),
      rows_(static_cast<std::size_t>(folds.count)),
      fold_squares_(static_cast<std::size_t>(folds.count)) {
  std::vector<Index> known;
  for (Index r = 0; r < residual.size(); ++r) {
    (observation[r] < 0 ? known : rows_[folds.fold_of[observation[r]]]).push_back(r);
  }
  const auto square_of = [&](const std::vector<Index>& rows) {
    Eigen::MatrixXd part(static_cast<Index>(rows.size()), columns.cols() + 1);
    part << columns(rows, Eigen::all), residual(rows);
    return inner_products(part, num_threads);
  };
  parallel_for(rows_.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) fold_squares_[b] = square_of(rows_[b]);
  });
  square_ = square_of(known);
  square_.diagonal().head(prior_precision.size()) += prior_precision;
  for (std::size_t b = 0; b < fold_squares_.size(); ++b) {
    square_ += fold_squares_[b];
    rows_held_out_ += static_cast<double>(rows_[b].size());
  }
}

FoldLeastSquares::Others FoldLeastSquares::others(const std::vector<Index>& which,
                                                  std::size_t fold) const {
  const Index last = columns_.cols();
  Eigen::MatrixXd square = square_(which, which) - fold_squares_[fold](which, which);
  square.diagonal().array() += kRidge;
  Others out{Eigen::LLT<Eigen::MatrixXd>(square), square_(which, last)};
  out.values -= fold_squares_[fold](which, last);
  out.root.solveInPlace(out.values);
  return out;
}

double FoldLeastSquares::fold_press(const std::vector<Index>& which, const Eigen::VectorXd& values,
                                    std::size_t fold) const {
  const Index last = columns_.cols();
  const Eigen::VectorXd xtr = fold_squares_[fold](which, last);
  return fold_squares_[fold](last, last) - 2.0 * values.dot(xtr) +
         values.dot(fold_squares_[fold](which, which) * values);
}

Eigen::VectorXd FoldLeastSquares::press(const std::vector<Index>& which) const {
  Eigen::VectorXd out(static_cast<Index>(fold_squares_.size()));
  parallel_for(fold_squares_.size(), 1, num_threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      out[static_cast<Index>(b)] = fold_press(which, others(which, b).values, b);
    }
  });
  return out;
}

double FoldLeastSquares::log_predictive_density(const std::vector<Index>& which) const {
  const Index last = columns_.cols();
  Eigen::MatrixXd square = square_(which, which);
  square.diagonal().array() += kRidge;
  const Eigen::LLT<Eigen::MatrixXd> all(square);
  const auto half_log_determinant = [](const Eigen::LLT<Eigen::MatrixXd>& root) {
    return root.matrixLLT().diagonal().array().log().sum();
  };
  Eigen::VectorXd out(static_cast<Index>(fold_squares_.size()));
  parallel_for(fold_squares_.size(), 1, num_threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      // Errors e = residual - X v of a fold have covariance 1 + X A⁻¹ Xᵀ, A being the Gram matrix
      // of the others: by Woodbury and Sylvester, all of it follows from Gram matrices.
      const Others known = others(which, b);
      const Eigen::VectorXd along =
          fold_squares_[b](which, last) - fold_squares_[b](which, which) * known.values;
      const double distance =
          fold_press(which, known.values, b) - all.matrixL().solve(along).squaredNorm();
      out[static_cast<Index>(b)] =
          -0.5 * distance - half_log_determinant(all) + half_log_determinant(known.root);
    }
  });
  return out.sum();
}

HeldOutErrors FoldLeastSquares::errors(const std::vector<Index>& which) const {
  HeldOutErrors out{Eigen::VectorXd::Zero(residual_.size()),
                    Eigen::VectorXd::Zero(static_cast<Index>(fold_squares_.size()))};
  for (std::size_t b = 0; b < rows_.size(); ++b) {
    const Eigen::VectorXd error =
        residual_(rows_[b]) - columns_(rows_[b], which) * others(which, b).values;
    out.error(rows_[b]) = error;
    out.by_fold[static_cast<Index>(b)] = error.squaredNorm();
  }
  return out;
}

double sign_flip_p(const Eigen::VectorXd& gains) {
  constexpr Index kAllOf = 16;
  const bool all = gains.size() <= kAllOf;
  const std::uint64_t count = std::uint64_t{1}
                              << static_cast<unsigned>(std::min(gains.size(), kAllOf));
  const double found = gains.sum();
  const double rounding = 1e-12 * gains.cwiseAbs().sum();
  RandomStream random(0);
  std::uint64_t as_large = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    double sum = 0.0;
    for (Index b = 0; b < gains.size(); ++b) {
      const bool flip = all ? (k >> static_cast<unsigned>(b) & 1U) != 0 : random.uniform() < 0.5;
      sum += flip ? -gains[b] : gains[b];
    }
    if (sum >= found - rounding) ++as_large;
  }
  return static_cast<double>(as_large) / static_cast<double>(count);
}

}  // namespace bathyal::selection
