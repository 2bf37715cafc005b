// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bathyal/selection/model.hpp"

// Candidates beside a base model, as one square of inner products: a set of them is then judged
// without looking at the rows again, however many there are.

namespace bathyal {

/// ln of the odds against a name, whatever it is: with `trials` it keeps clean data clean (the
/// score card, tests/simulated_cases/score_card.py, shows how often).
inline constexpr double kNameCost = 4.5;

/// What the freedom of `width` columns takes from the log evidence when their values were found
/// with Wald's statistic `f` per column: (k/2) (ln(1 + F) + F / (1 + F)), that of a normal prior as
/// wide as the values where F is large, (k/2) (ln F + 1), and 0 where it is 0.
double cost_of_freedom(double width, double f);

/// What a set of candidates explains. Candidates' values are along their orthonormal columns.
struct SetFit {
  double left = 0.0;       ///< sum of squares that remains, what holds the values counted in
  double freedom = 0.0;    ///< of it
  double score = 0.0;      ///< log evidence, see Pool::judge
  std::vector<double> f;   ///< of each candidate, given the others: Wald's statistic per column
  std::vector<int> width;  ///< columns of each candidate
  double noise() const { return left / freedom; }  ///< variance
};

class Pool {
 public:
  /// `basis`: orthonormal columns of the base model; `misfit` (M,); `freedom` that is left when the
  /// base model has been fitted. `columns` are those of `forms`, which are places in `all`, and
  /// `all` must outlive the pool. Forms that the base model swallows are no members.
  Pool(const Eigen::MatrixXd& basis, const Eigen::VectorXd& misfit, double freedom,
       std::span<const int> forms, std::span<const Form> all, std::vector<Eigen::MatrixXd> columns,
       int num_threads);

  int size() const { return static_cast<int>(members_.size()); }
  int form(int member) const { return members_[member].form; }
  const Form& about(int member) const { return *members_[member].about; }
  Index width(int member) const { return members_[member].width; }
  /// (M, k) orthonormal, and orthogonal to the basis.
  auto columns(int member) const {
    return stack_.middleCols(members_[member].first, members_[member].width);
  }
  /// (W,) of all members' columns in turn: the prior's part of their squares.
  const Eigen::VectorXd& held_by() const { return held_by_; }
  double total() const { return total_; }      ///< sum of squares beside the base model
  double freedom() const { return freedom_; }  ///< of it
  int num_threads() const { return num_threads_; }

  /// The set, fitted; nothing when its members are not independent.
  ///
  /// Values are held to what is plausible (Beside::length), or weak directions of several members
  /// would send each other to values at which columns mean nothing.
  ///
  /// The score is -(ν/2) ln(left) - Σ [ cost_of_freedom(k, F) + ln(trials) + kNameCost ]: the
  /// likelihood with the noise integrated out, less what a candidate's freedom costs: of its k
  /// columns by a normal prior whose width is that of the values found (George and Foster 2000,
  /// empirical Bayes), of `trials` forms that one of them was picked (Chen and Chen 2008).
  std::optional<SetFit> judge(std::span<const int> members) const;

  /// Log evidence for candidate `i` of a set by itself, given the others as they are.
  double worth(std::span<const int> members, const SetFit& fit, std::size_t i) const;

  /// The score that each member would give as an addition to `members` (quick: without what the
  /// others' costs change); -inf for those of a cause that the set has, and dependent ones.
  Eigen::VectorXd scores_beside(std::span<const int> members) const;

  /// (members, size()): the same beside the set without each of its members in turn. One look at
  /// the whole set tells all of it, since what a member takes of the others follows from there.
  Eigen::MatrixXd scores_instead(std::span<const int> members) const;

 private:
  struct Member {
    int form;
    const Form* about;
    Index first;
    Index width;
    double cost;  ///< ln(trials) + kNameCost
    int cause;    ///< number of about->cause
  };
  /// What a set takes of all columns: it leaves square - takenᵀ taken of them, and `against` of the
  /// misfit.
  struct Taken {
    Eigen::LLT<Eigen::MatrixXd> root;  ///< of the set's square
    Eigen::MatrixXd taken;             ///< (k, W)
    Eigen::VectorXd explained;         ///< (k,)
    Eigen::VectorXd against;           ///< (W,)
  };
  std::vector<Index> columns_of(std::span<const int> members) const;
  Taken taken_by(std::span<const int> members) const;
  /// The quick score of `member` beside `others`, whose fit is `base` and which leave `square` and
  /// `against` of its columns; kNever where it cannot stand there.
  double score_with(int member, std::span<const int> others, const SetFit& base,
                    const Eigen::MatrixXd& square, const Eigen::VectorXd& against) const;

  Eigen::VectorXd misfit_;
  double total_;
  double freedom_;
  std::vector<Member> members_;
  Eigen::MatrixXd stack_;    ///< (M, W) all candidates' columns
  Eigen::VectorXd held_by_;  ///< (W,) 1 / variance of the columns' values before the data
  Eigen::MatrixXd square_;   ///< (W, W) stackᵀ stack, and held_by on the diagonal
  Eigen::VectorXd against_;  ///< (W,) stackᵀ misfit
  int num_threads_;
};

}  // namespace bathyal
