// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "bathyal/selection/candidate_set.hpp"
#include "bathyal/selection/model.hpp"

namespace bathyal::selection {

/// The column space of the base model, and of terms fitted with it, at a working point.
struct NuisanceBasis {
  Eigen::MatrixXd basis;  ///< (M, b) orthonormal
  double dof = 0.0;       ///< residual degrees of freedom
};

/// Test of one lack-of-fit term: structure in the residuals, whatever its cause.
struct LackOfFit {
  int term = 0;
  double explained = 0.0;
  double width = 0.0;
  double p = 1.0;     ///< corrected for all lack-of-fit terms and Decisions::kStructureTests
  double size = 0.0;  ///< per row [noise]
  double share = 0.0;
  double gain = 0.0;  ///< in log evidence, corrected for multiplicity
};

/// A model at its current estimate, with what follows from the linearization there.
class WorkingPoint {
 public:
  /// `model` must outlive it.
  WorkingPoint(Model& model, int num_threads) : model_(model), num_threads_(num_threads) {}

  const Model& model() const { return model_; }
  int num_threads() const { return num_threads_; }
  const Term& term(int term) const { return model_.terms()[term]; }

  /// Fits the model; all that was derived at the last estimate is discarded.
  void fit(const std::vector<int>& terms);
  std::shared_ptr<const Model::Checkpoint> save() const { return model_.save(); }
  void restore(const Model::Checkpoint& checkpoint);
  /// Takes effect with the next `fit`.
  void set_observation_weights(const Eigen::VectorXd& weights) {
    model_.set_observation_weights(weights);
  }
  void set_variance_ratios(const Eigen::VectorXd& ratios) { model_.set_variance_ratios(ratios); }
  /// Whitens the rows of the base model by the components that the record itself shows, as far as
  /// they matter given what it leaves; returns whether any does. Without that a search would take
  /// what replicates share of them for structure.
  bool whiten_by_known();
  /// Terms of a scan between `term` and its neighbours, made on demand.
  std::vector<int> refine(int term) { return model_.refine(term); }

  /// Valid until the next call with other terms; that without terms until the next `fit`.
  const NuisanceBasis& nuisance(const std::vector<int>& terms = {}) const;
  CandidateSet candidate_set(const std::vector<int>& terms) const;
  /// The test of each lack-of-fit term given `nuisance`, most significant first.
  std::vector<LackOfFit> lack_of_fit(const NuisanceBasis& nuisance) const;
  /// Log evidence of `terms`, and of excluding observations whose weight is 0, comparable between
  /// working points; -inf where the terms are collinear.
  double score(const std::vector<int>& terms, const Eigen::VectorXd& weights) const;

 private:
  Model& model_;
  int num_threads_;
  mutable std::optional<NuisanceBasis> before_;
  mutable std::optional<std::pair<std::vector<int>, NuisanceBasis>> last_;
};

/// All members of a candidate set.
std::vector<int> all_members(const CandidateSet& candidates);
/// Term indices of members, ascending; members whose term is one of `terms`.
std::vector<int> terms_of(const CandidateSet& candidates, const std::vector<int>& members);
std::vector<int> members_of(const CandidateSet& candidates, const std::vector<int>& terms);

}  // namespace bathyal::selection
