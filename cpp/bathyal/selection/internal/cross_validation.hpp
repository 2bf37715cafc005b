// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "bathyal/selection/internal/fold_least_squares.hpp"
#include "bathyal/selection/working_point.hpp"

namespace bathyal {

/// Forms beside the base model, by what they foretell of rows that they have not seen. Forms are
/// told by their places in `forms()`; those that the base model swallows are none of them.
class FormsHeldOut {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// `vantage` and `blocks` must outlive it, and the subject must stay where it stands.
  FormsHeldOut(const Vantage& vantage, const std::vector<int>& forms, const Blocks& blocks);
  FormsHeldOut(const FormsHeldOut&) = delete;
  FormsHeldOut& operator=(const FormsHeldOut&) = delete;

  const std::vector<int>& forms() const { return forms_; }
  void drop(std::size_t place);

  // Of all forms, or of all but one.
  double density(std::size_t without = kNone) const { return held_.density(all_but(without)); }
  double squares(std::size_t without = kNone) const {
    return held_.squares(all_but(without)).sum();
  }
  /// Of those of `forms` that it has.
  double density_of(const std::vector<int>& forms) const;
  HeldOutErrors errors() const { return held_.errors(all_but(kNone)); }
  HeldOutErrors errors_of_base() const { return held_.errors(basis_); }
  double rows() const { return held_.rows(); }

 private:
  FormsHeldOut(const Vantage& vantage, const Pool& pool, const Blocks& blocks);
  std::vector<Index> all_but(std::size_t without) const;

  Eigen::MatrixXd columns_;
  Eigen::VectorXd held_by_;
  HoldOut held_;
  std::vector<Index> basis_;
  std::vector<int> forms_;
  std::vector<std::vector<Index>> own_;  ///< columns of each
};

}  // namespace bathyal
