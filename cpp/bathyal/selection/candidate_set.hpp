// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bathyal/selection/model.hpp"

// Candidate terms, projected off a base model, as one Gram matrix: any subset is then evaluated
// without a pass over the rows, however many there are.

namespace bathyal::selection {

/// Complexity penalty on the log evidence of k = `width` columns whose values have Wald's statistic
/// `f` per column: (k/2) (ln(1 + F) + F / (1 + F)). For large F this is (k/2) (ln F + 1), that of a
/// normal prior as wide as the values; at F = 0 it is 0.
double complexity_penalty(double width, double f);

/// Fit of a subset of the candidates. Values are along each candidate's orthonormal columns.
struct SetFit {
  double residual_sum = 0.0;  ///< residual sum of squares, the prior penalty included
  double dof = 0.0;           ///< of it
  double score = 0.0;         ///< log evidence, see CandidateSet::evaluate
  std::vector<double> f;      ///< of each candidate, given the others: Wald's statistic per column
  std::vector<int> width;     ///< columns of each candidate
  double noise() const { return residual_sum / dof; }  ///< variance
};

class CandidateSet {
 public:
  /// `basis`: orthonormal columns of the base model; `residual` (M,); `dof` of the base model's
  /// fit. `columns` are those of `terms`, which are indices in `all`; `all` must outlive the set.
  /// Terms that are collinear with the base model are no members.
  CandidateSet(const Eigen::MatrixXd& basis, const Eigen::VectorXd& residual, double dof,
               std::span<const int> terms, std::span<const Term> all,
               std::vector<Eigen::MatrixXd> columns, int num_threads);

  int size() const { return static_cast<int>(members_.size()); }
  int term_index(int member) const { return members_[member].term_index; }
  const Term& term(int member) const { return *members_[member].term; }
  Index width(int member) const { return members_[member].width; }
  /// (M, k) orthonormal, and orthogonal to the basis.
  auto columns(int member) const {
    return stack_.middleCols(members_[member].first, members_[member].width);
  }
  /// Largest share of the squares of the narrower one's columns outside the span of the other's.
  double share_outside(int one, int other) const;
  /// (W,) of all members' columns in turn.
  const Eigen::VectorXd& prior_precision() const { return prior_precision_; }
  double total() const { return total_; }  ///< residual sum of squares of the base model
  double dof() const { return dof_; }      ///< of it
  int num_threads() const { return num_threads_; }

  /// Fit of a subset; nothing when its members are not independent.
  ///
  /// Values have a normal prior of the plausible size (ProjectedColumns::length): without it, weak
  /// directions shared by several members reach values at which the linearization is meaningless.
  ///
  /// The score is -(ν/2) ln(RSS) - Σ [ complexity_penalty(k, F) + ln(multiplicity) +
  /// Decisions::kTermPenalty
  /// ]: the likelihood with the noise integrated out, less the penalty for k columns under a normal
  /// prior as wide as the values (empirical Bayes, George and Foster 2000), less that for picking
  /// one of `multiplicity` terms (Chen and Chen 2008).
  std::optional<SetFit> evaluate(std::span<const int> members) const;

  /// Log evidence for candidate `i` of a set, given the other members at their values.
  double marginal_score(std::span<const int> members, const SetFit& fit, std::size_t i) const;

  /// The score of `members` with each candidate added (approximate: the others' penalties are not
  /// updated); -inf for collinear ones and for those whose alias group is in the set already.
  Eigen::VectorXd forward_scores(std::span<const int> members) const;

  /// (members, size()): the same for the set without each of its members in turn, all from one
  /// factorization of the whole set.
  Eigen::MatrixXd exchange_scores(std::span<const int> members) const;

 private:
  struct Member {
    int term_index;
    const Term* term;
    Index first;
    Index width;
    double cost;      ///< ln(multiplicity) + Decisions::kTermPenalty
    int alias_group;  ///< number of term->alias_group
  };
  /// All columns projected on a set's: the Gram matrix of what remains is
  /// square - projectedᵀ projected, and its product with the residual is `xtr`.
  struct Projection {
    Eigen::LLT<Eigen::MatrixXd> root;  ///< of the set's Gram matrix
    Eigen::MatrixXd projected;         ///< (k, W)
    Eigen::VectorXd explained;         ///< (k,)
    Eigen::VectorXd xtr;               ///< (W,)
  };
  std::vector<Index> columns_of(std::span<const int> members) const;
  Projection project(std::span<const int> members) const;
  /// The approximate score of `others` and `member`. `base` is the fit of `others`; `square` and
  /// `xtr` are the member's after projection off them. kNever where it cannot be added.
  double score_with(int member, std::span<const int> others, const SetFit& base,
                    const Eigen::MatrixXd& square, const Eigen::VectorXd& xtr) const;

  Eigen::VectorXd residual_;
  double total_;
  double dof_;
  std::vector<Member> members_;
  Eigen::MatrixXd stack_;            ///< (M, W) all candidates' columns
  Eigen::VectorXd prior_precision_;  ///< (W,) 1 / variance of the columns' values before the data
  Eigen::MatrixXd square_;           ///< (W, W) stackᵀ stack + diag(prior_precision)
  Eigen::VectorXd xtr_;              ///< (W,) stackᵀ residual
  int num_threads_;
};

}  // namespace bathyal::selection
