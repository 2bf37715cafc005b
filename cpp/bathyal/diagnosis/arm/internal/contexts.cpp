// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/contexts.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace bathyal::diagnosis {
namespace {

using Kind = Dependence::Kind;

/// Columns of mean 0 and standard deviation 1, without those that do not vary.
Eigen::MatrixXd standardized(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd out(columns.rows(), 0);
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    const Eigen::VectorXd centred = columns.col(c).array() - columns.col(c).mean();
    const double std = std::sqrt(centred.squaredNorm() / static_cast<double>(columns.rows()));
    if (!(std > 1e-12 * columns.col(c).cwiseAbs().maxCoeff())) continue;
    out.conservativeResize(Eigen::NoChange, out.cols() + 1);
    out.rightCols(1) = centred / std;
  }
  return out;
}

}  // namespace

Contexts make_contexts(const EffectData& data, const Eigen::Matrix3Xd& position,
                       const Eigen::VectorXd& range) {
  Contexts out;
  const auto add = [&out](Dependence dependence, const Eigen::MatrixXd& columns) {
    Eigen::MatrixXd coordinates = standardized(columns);
    if (coordinates.cols() == 0) return;
    out.dependence.push_back(std::move(dependence));
    out.coordinates.push_back(std::move(coordinates));
  };
  const int n = static_cast<int>(data.q.cols());
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  if (n > 2) add({Kind::kJoints, all}, data.q);
  for (int i = 0; i < n; ++i) {
    add({Kind::kJoints, {i}}, data.q.col(i));
    for (int j = i + 1; j < n; ++j) {
      const std::vector<int> both{i, j};
      add({Kind::kJoints, both}, data.q(Eigen::all, both));
    }
  }
  if (position.cols() > 0) add({Kind::kPosition}, position.transpose());
  if (range.size() > 0) add({Kind::kRange}, range);
  Eigen::VectorXd rank(data.rows());
  Eigen::MatrixXd last_move = Eigen::MatrixXd::Zero(data.rows(), n);
  for (Eigen::Index k = 0; k < data.rows(); ++k) {
    const int row = data.order[static_cast<std::size_t>(k)];
    rank[row] = static_cast<double>(k);
    if (k > 0)
      last_move.row(row) =
          data.q.row(row) - data.q.row(data.order[static_cast<std::size_t>(k - 1)]);
  }
  add({data.has("time") ? Kind::kTime : Kind::kOrder}, rank);
  for (int i = 0; i < n; ++i) add({Kind::kApproach, {i}}, last_move.col(i));
  for (const auto& [name, table] : data.covariates) {
    if (name == "time" || name == "session" || !data.has(name)) continue;
    for (Eigen::Index c = 0; c < table.cols(); ++c) {
      Dependence on{Kind::kCovariate, {}, {}, name};
      if (table.cols() > 1) on.component = static_cast<int>(c);
      add(std::move(on), table.col(c));
    }
  }
  return out;
}

std::string describe(int direction, const Dependence& context) {
  const std::string name = to_text(context);
  if (direction == kBaseAxes) return "what shifts the tip in the base's axes with " + name;
  if (direction == kToolAxes) return "what shifts the tip in the tool's axes with " + name;
  if (direction == kSight) return "what is measured too long or short with " + name;
  return "what moves joint " + std::to_string(direction - kFirstJoint + 1) + " with " + name;
}

}  // namespace bathyal::diagnosis
