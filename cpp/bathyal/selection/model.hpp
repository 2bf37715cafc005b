// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <string>
#include <vector>

// The interface between term selection and a model with its measurement: rows, columns, candidate
// terms, groups of observations. An arm is one such model; sonars and vehicles may be others.

namespace bathyal::selection {

using Eigen::Index;

/// A candidate term, one way in which the model may be wrong: columns that enter or leave a set
/// together.
struct Term {
  std::string effect;  ///< "joint_harmonic"; of a lack-of-fit term: what the residuals depend on
  int joint = -1;
  std::string alias_group;    ///< terms of one group describe the same physical cause
  std::string description;    ///< for people
  double multiplicity = 1.0;  ///< terms of its effect that are tried, itself included
  bool preferred = false;     ///< taken where it fits as well as its neighbours in a scan
  bool combinable = false;    ///< may be selected with others of its alias group, if independent
  bool continuous = false;    ///< its setting is refined by every fit
  bool lack_of_fit = false;   ///< tests for structure, and is no cause
};

/// A source of heteroscedastic, correlated noise.
struct VarianceComponent {
  std::string effect;
  std::string description;
  std::string parameter;  ///< standard deviation of its sources
  std::string unit;
  double multiplicity = 1.0;
  Eigen::MatrixXd loads;  ///< (noise rows, k) d row / d source, k sources an observation [m]
  double known = 0.0;     ///< the parameter, where the record itself gives it; else 0
  /// (observations,) replicates of one number share their sources; empty: each has its own.
  std::vector<int> source = {};
  bool lack_of_fit = false;  ///< tests for structure, and is no cause
  int joint = -1;            ///< of such a one
};

/// The measured items (poses), and what is known of each apart from the model.
struct Observations {
  std::vector<int> order;      ///< rank of each in time
  bool timed = true;           ///< the times are known; else `order` is that of the list
  std::vector<int> replicate;  ///< observations of one number are replicates, held out together
  std::vector<int> session;    ///< 0 …; all 0 when there is but one
  std::vector<int> group;      ///< 0 …, sharing an unknown (a touched point); -1: none
  Index count() const { return static_cast<Index>(order.size()); }
};

/// A model at its current estimate: residual and derivatives by its own parameters.
struct Linearization {
  Eigen::VectorXd residual;      ///< (M,) measured less base model, in units of noise
  Eigen::MatrixXd jacobian;      ///< (M, b) d modelled / d parameters of the base model
  std::vector<int> observation;  ///< (M,) of each row; -1: a row that is never held out
  Index noise_rows = 0;          ///< rows, from the first, that variance components apply to
  double constrained_dof = 0.0;  ///< rows that carry no degree of freedom

  /// (observations,) the rows of each.
  std::vector<std::vector<Index>> rows_by_observation(Index observations) const {
    std::vector<std::vector<Index>> rows(static_cast<std::size_t>(observations));
    for (Index r = 0; r < residual.size(); ++r) {
      if (observation[r] >= 0) rows[observation[r]].push_back(r);
    }
    return rows;
  }
};

/// Weight of an excluded observation: its rows stay in place and count for nothing.
inline constexpr double kExcludedWeight = 1e-12;

/// A model that may be wrong, with its measurement.
class Model {
 public:
  virtual ~Model() = default;
  virtual const Observations& observations() const = 0;

  /// In a fixed order; those of a scan are in `scans` too.
  virtual const std::vector<Term>& terms() const = 0;
  /// Indices of terms that differ in one setting only (order, moment, period), by its value.
  virtual const std::vector<std::vector<int>>& scans() const = 0;
  virtual const std::vector<VarianceComponent>& variance_components() const = 0;

  /// New terms between `term` of a scan and its neighbours, made on demand, or terms near it; empty
  /// where there are none.
  virtual std::vector<int> refine(int term) = 0;

  /// (M, k) of each term: d modelled / d parameters at the current estimate, each parameter in
  /// units of the largest plausible size, which is its prior standard deviation. Safe to call from
  /// several threads.
  virtual std::vector<Eigen::MatrixXd> columns(std::span<const int> terms) const = 0;
  virtual const Linearization& linearization() const = 0;

  /// (N, d) each: coordinates, each of unit spread, in which near observations should have
  /// residuals that are no more alike than those of strangers. No NaN.
  virtual const std::vector<Eigen::MatrixXd>& contexts() const = 0;
  /// (M, d) each: d rows / d a shift of each observation along d axes, at the current estimate.
  virtual std::vector<Eigen::MatrixXd> directions() const = 0;

  /// Fits the base model together with `terms`, which become the active set. The setting of a
  /// continuous term is fitted too.
  virtual void fit(const std::vector<int>& terms) = 0;

  /// An estimate that can be restored without a fit.
  struct Checkpoint {
    virtual ~Checkpoint() = default;
  };
  virtual std::shared_ptr<const Checkpoint> save() const = 0;
  virtual void restore(const Checkpoint& checkpoint) = 0;

  /// Factors on the weight (1 / variance) of each observation; 0 excludes it. Takes effect with the
  /// next `fit`.
  virtual void set_observation_weights(const Eigen::VectorXd& weights) = 0;
  /// (components,) their variances over that of the homoscedastic noise [per m²], from which the
  /// covariance of each row's errors follows. Takes effect with the next `fit`.
  virtual void set_variance_ratios(const Eigen::VectorXd& ratios) = 0;
  /// (noise rows, k) d row / d source, as the rows are whitened by those covariances, of `loads` of
  /// sources that no two observations share.
  virtual Eigen::MatrixXd whitened(const Eigen::MatrixXd& loads) const = 0;
  /// Standard deviation of a position row at the current estimate [m].
  virtual double noise() const = 0;
};

}  // namespace bathyal::selection
