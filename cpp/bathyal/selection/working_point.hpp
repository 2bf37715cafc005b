// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "bathyal/selection/candidate_set.hpp"
#include "bathyal/selection/model.hpp"

namespace bathyal {

/// What the columns of the base model, and of forms beside it, span where a subject stands.
struct Ground {
  Eigen::MatrixXd basis;  ///< (M, b) orthonormal
  double freedom = 0.0;   ///< that they leave
};

/// What a probe adds to a model: structure that is there, whether it has a name or not.
struct Dependence {
  int form = 0;
  double explained = 0.0;
  double width = 0.0;
  double p = 1.0;     ///< all probes counted
  double size = 0.0;  ///< per row [noise]
  double share = 0.0;
  double gain = 0.0;  ///< in log evidence, its trials counted
};

/// A subject where it stands, and what is seen from there.
class Vantage {
 public:
  /// `subject` must outlive it.
  Vantage(Subject& subject, int num_threads) : subject_(subject), num_threads_(num_threads) {}

  const Subject& subject() const { return subject_; }
  int num_threads() const { return num_threads_; }
  const Form& form(int form) const { return subject_.forms()[form]; }

  /// Fits and stands there. What was seen from the last place is forgotten.
  void settle(const std::vector<int>& forms);
  std::shared_ptr<const Subject::Place> place() const { return subject_.place(); }
  void return_to(const Subject::Place& place);
  /// Counts from the next `settle` on.
  void set_trust(const Eigen::VectorXd& trust) { subject_.set_trust(trust); }
  void set_noise_forms(const Eigen::VectorXd& ratios) { subject_.set_noise_forms(ratios); }
  /// Forms of a scan between `form` and its neighbours, made on demand.
  std::vector<int> finer(int form) { return subject_.finer(form); }

  /// Stays until the next call with other forms; that of no forms until the next `settle`.
  const Ground& ground(const std::vector<int>& forms = {}) const;
  Pool pool_of(const std::vector<int>& forms) const;
  /// What each probe adds to what stands, those beyond noise first.
  std::vector<Dependence> dependences(const Ground& beside) const;
  /// Log evidence of `forms`, and of units left out where `trust` is 0, comparable from place to
  /// place; -inf where the forms are not independent.
  double score_of(const std::vector<int>& forms, const Eigen::VectorXd& trust) const;

 private:
  Subject& subject_;
  int num_threads_;
  mutable std::optional<Ground> bare_;
  mutable std::optional<std::pair<std::vector<int>, Ground>> last_;
};

/// All members of a pool.
std::vector<int> everyone(const Pool& pool);
/// Forms of members, rising; members that are one of `forms`.
std::vector<int> forms_of(const Pool& pool, const std::vector<int>& members);
std::vector<int> members_of(const Pool& pool, const std::vector<int>& forms);

}  // namespace bathyal
