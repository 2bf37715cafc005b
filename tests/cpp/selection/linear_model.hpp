// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/selection/model.hpp"

namespace bathyal::selection {

inline constexpr Index kRows = 200, kRowsPerFold = 20;

/// A linear model of one base column, with noise of 1.
class LinearModel final : public Model {
 public:
  LinearModel() {
    observations_.order.resize(kRows);
    std::iota(observations_.order.begin(), observations_.order.end(), 0);
    observations_.replicate = observations_.order;
    observations_.session.assign(kRows, 0);
    observations_.group.assign(kRows, -1);
    RandomStream random(7);
    at_.residual.resize(kRows);
    for (double& value : at_.residual) value = random.normal();
    at_.jacobian = Eigen::VectorXd::Ones(kRows);
    at_.observation = observations_.order;
    at_.noise_rows = kRows;
  }

  /// A term with the derivatives `columns`.
  void add(const std::string& effect, const Eigen::MatrixXd& columns, bool lack_of_fit = false) {
    terms_.push_back({effect, -1, effect, effect, 1.0});
    terms_.back().lack_of_fit = lack_of_fit;
    columns_.push_back(columns);
  }
  /// One of four ways to describe a cause.
  void add_alias(const std::string& alias_group, const Eigen::MatrixXd& columns) {
    add(alias_group, columns);
    terms_.back().multiplicity = 4.0;
  }
  void add_scan(const std::vector<int>& family) { scans_.push_back(family); }
  Eigen::VectorXd& data() { return at_.residual; }
  std::vector<int>& replicates() { return observations_.replicate; }
  void add_context(const Eigen::MatrixXd& coordinates) { contexts_.push_back(coordinates); }
  void add_direction(const Eigen::MatrixXd& loads) { directions_.push_back(loads); }
  void set_base(const Eigen::VectorXd& column) { at_.jacobian = column; }

  const Observations& observations() const override { return observations_; }
  const std::vector<Term>& terms() const override { return terms_; }
  const std::vector<std::vector<int>>& scans() const override { return scans_; }
  const std::vector<VarianceComponent>& variance_components() const override {
    return variance_components_;
  }
  std::vector<int> refine(int) override { return {}; }
  std::vector<Eigen::MatrixXd> columns(std::span<const int> terms) const override {
    std::vector<Eigen::MatrixXd> out;
    for (const int term : terms) out.push_back(columns_[static_cast<std::size_t>(term)]);
    return out;
  }
  const Linearization& linearization() const override { return at_; }
  const std::vector<Eigen::MatrixXd>& contexts() const override { return contexts_; }
  std::vector<Eigen::MatrixXd> directions() const override { return directions_; }
  void fit(const std::vector<int>&) override {}
  std::shared_ptr<const Checkpoint> save() const override { return std::make_shared<Checkpoint>(); }
  void restore(const Checkpoint&) override {}
  void set_observation_weights(const Eigen::VectorXd&) override {}
  void set_variance_ratios(const Eigen::VectorXd&) override {}
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& loads) const override { return loads; }
  double noise() const override { return 1e-3; }

 private:
  Observations observations_;
  Linearization at_;
  std::vector<Term> terms_;
  std::vector<Eigen::MatrixXd> columns_;
  std::vector<std::vector<int>> scans_;
  std::vector<VarianceComponent> variance_components_;
  std::vector<Eigen::MatrixXd> contexts_;
  std::vector<Eigen::MatrixXd> directions_;
};

inline Eigen::VectorXd in_fold(Index fold, double size) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(kRows);
  column.segment(fold * kRowsPerFold, kRowsPerFold).setConstant(size);
  return column;
}

/// Normal columns of standard deviation `size`.
inline Eigen::VectorXd swing(std::uint64_t seed, double size) {
  Eigen::VectorXd column(kRows);
  RandomStream random(seed);
  for (double& value : column) value = size * random.normal();
  return column;
}

}  // namespace bathyal::selection
