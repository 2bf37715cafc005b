// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/working_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/selection/internal/grid_scan.hpp"
#include "bathyal/selection/outlier_test.hpp"
#include "bathyal/selection/variance_components.hpp"

namespace bathyal::selection {

std::vector<int> all_members(const CandidateSet& candidates) {
  std::vector<int> members(static_cast<std::size_t>(candidates.size()));
  std::iota(members.begin(), members.end(), 0);
  return members;
}

std::vector<int> terms_of(const CandidateSet& candidates, const std::vector<int>& members) {
  std::vector<int> terms;
  for (const int member : members) terms.push_back(candidates.term_index(member));
  std::sort(terms.begin(), terms.end());
  return terms;
}

std::vector<int> members_of(const CandidateSet& candidates, const std::vector<int>& terms) {
  std::vector<int> members;
  for (int m = 0; m < candidates.size(); ++m) {
    if (std::find(terms.begin(), terms.end(), candidates.term_index(m)) != terms.end())
      members.push_back(m);
  }
  return members;
}

void WorkingPoint::fit(const std::vector<int>& terms) {
  before_.reset();
  last_.reset();
  model_.fit(terms);
}

bool WorkingPoint::whiten_by_known() {
  const std::vector<VarianceComponent>& components = model_.variance_components();
  Eigen::VectorXd ratios = Eigen::VectorXd::Zero(static_cast<Index>(components.size()));
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(model_.observations().count());
  for (std::size_t f = 0; f < components.size(); ++f) {
    if (!(components[f].known > 0.0)) continue;
    const VarianceComponentFit fit = fit_variance_component(components[f], model_.linearization(),
                                                            nuisance().basis, all, model_.noise());
    if (fit.share > Decisions::kMinKnownShare) ratios[static_cast<Index>(f)] = fit.ratio;
  }
  if (ratios.isZero(0.0)) return false;
  set_variance_ratios(ratios);
  fit({});
  return true;
}

void WorkingPoint::restore(const Model::Checkpoint& checkpoint) {
  before_.reset();
  last_.reset();
  model_.restore(checkpoint);
}

const NuisanceBasis& WorkingPoint::nuisance(const std::vector<int>& terms) const {
  const Linearization& at = model_.linearization();
  const auto with = [&](Eigen::MatrixXd basis) {
    const auto dof = static_cast<double>(at.residual.size() - basis.cols()) - at.constrained_dof;
    return NuisanceBasis{std::move(basis), dof};
  };
  if (!before_) before_ = with(orthonormal(at.jacobian));
  if (terms.empty()) return *before_;
  if (!last_ || last_->first != terms) {
    Eigen::MatrixXd basis = before_->basis;
    append(basis, projected_columns(before_->basis, {concatenate_columns(model_.columns(terms))},
                                    num_threads_)
                      .front()
                      .columns);
    last_.emplace(terms, with(std::move(basis)));
  }
  return last_->second;
}

CandidateSet WorkingPoint::candidate_set(const std::vector<int>& terms) const {
  const NuisanceBasis& base = nuisance();
  return {base.basis,     model_.linearization().residual, base.dof,    terms,
          model_.terms(), model_.columns(terms),           num_threads_};
}

std::vector<LackOfFit> WorkingPoint::lack_of_fit(const NuisanceBasis& nuisance) const {
  std::vector<int> asked;
  for (int term = 0; term < static_cast<int>(model_.terms().size()); ++term) {
    if (model_.terms()[term].lack_of_fit) asked.push_back(term);
  }
  const Eigen::VectorXd& residual = model_.linearization().residual;
  const std::vector<ScannedTerm> scanned =
      scan(model_, asked, nuisance.basis, residual, nuisance.dof, num_threads_);
  const double total =
      residual.squaredNorm() - (nuisance.basis.transpose() * residual).squaredNorm();
  const auto rows = static_cast<double>(residual.size());
  std::vector<LackOfFit> out;
  for (const ScannedTerm& term : scanned) {
    if (term.width == 0.0 || !(nuisance.dof > term.width + 1.0)) continue;
    LackOfFit d{term.term, term.explained, term.width};
    const FTest test = f_test(term.explained, term.width, total, nuisance.dof);
    d.p = std::min(1.0, Decisions::kStructureTests * static_cast<double>(asked.size()) * test.p);
    d.size = std::sqrt(test.explained / rows);
    d.share = test.share;
    d.gain = term.gain - std::log(model_.terms()[term.term].multiplicity);
    out.push_back(d);
  }
  std::stable_sort(out.begin(), out.end(), [](const LackOfFit& a, const LackOfFit& b) {
    return std::pair(a.p, -a.share) < std::pair(b.p, -b.share);
  });
  return out;
}

double WorkingPoint::score(const std::vector<int>& terms, const Eigen::VectorXd& weights) const {
  const NuisanceBasis& base = nuisance();
  const CandidateSet candidates = candidate_set(terms);
  const auto fit = candidates.evaluate(all_members(candidates));
  if (!fit) return -std::numeric_limits<double>::infinity();
  // Excluded observations count as rows, each explained by a column of its own.
  double outlier_rows = 0.0, cost = 0.0;
  const NuisanceBasis& whole = nuisance(terms);
  const std::vector<ObservationTest> tests =
      test_observations(model_.linearization(), whole.basis, weights, whole.dof);
  for (Index i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0.0) continue;
    const ObservationTest& test = tests[static_cast<std::size_t>(i)];
    outlier_rows += test.rows;
    cost += complexity_penalty(test.rows, test.distance) +
            std::log(static_cast<double>(weights.size()));
  }
  // As CandidateSet::evaluate, in metres: the unit of residuals differs between selections.
  const double rows = base.dof + outlier_rows;
  return fit->score + 0.5 * base.dof * std::log(fit->residual_sum) -
         0.5 * rows * std::log(fit->residual_sum * model_.noise() * model_.noise()) - cost;
}

}  // namespace bathyal::selection
