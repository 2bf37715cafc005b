// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/candidate_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "bathyal/estimation/gram.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/selection/decisions.hpp"

namespace bathyal::selection {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

/// Least share of a candidate's squared length outside the span of the set's other members.
constexpr double kMinShare = 1e-8;

/// Whether each column keeps more than `least` after projection off those before it.
bool is_independent(const Eigen::LLT<Eigen::MatrixXd>& root,
                    const Eigen::Ref<const Eigen::ArrayXd>& least) {
  return root.info() == Eigen::Success &&
         (root.matrixLLT().diagonal().array().square() > least).all();
}

/// The share a column must keep: two aliases would each get half of the value at hardly any
/// penalty. A column with a tight prior may be nearly collinear without harm.
Eigen::ArrayXd min_share(const Eigen::Ref<const Eigen::VectorXd>& prior_precision, double least) {
  constexpr double kHeld = 3.0, kAlike = 1e-3;
  return (kHeld * prior_precision.array()).min(kAlike).max(least);
}

}  // namespace

double complexity_penalty(double width, double f) {
  return 0.5 * width * (std::log1p(f) + f / (1.0 + f));
}

CandidateSet::CandidateSet(const Eigen::MatrixXd& basis, const Eigen::VectorXd& residual,
                           double dof, std::span<const int> terms, std::span<const Term> all,
                           std::vector<Eigen::MatrixXd> columns, int num_threads)
    : residual_(residual - basis * (basis.transpose() * residual)),
      total_(residual_.squaredNorm()),
      dof_(dof),
      num_threads_(num_threads) {
  const std::vector<ProjectedColumns> beside_basis =
      projected_columns(basis, std::move(columns), num_threads);
  Index wide = 0;
  std::map<std::string, int> alias_groups;
  for (std::size_t i = 0; i < beside_basis.size(); ++i) {
    const Index width = beside_basis[i].length.size();
    if (width == 0) continue;
    const Term& term = all[static_cast<std::size_t>(terms[i])];
    const int alias_group =
        alias_groups.emplace(term.alias_group, static_cast<int>(alias_groups.size())).first->second;
    members_.push_back({terms[i], &term, wide, width,
                        std::log(term.multiplicity) + Decisions::kTermPenalty, alias_group});
    wide += width;
  }
  stack_.resize(residual.size(), wide);
  prior_precision_.resize(wide);
  wide = 0;
  for (const ProjectedColumns& one : beside_basis) {
    const Index width = one.length.size();
    stack_.middleCols(wide, width) = one.columns;
    prior_precision_.segment(wide, width) = one.length.cwiseAbs2().cwiseInverse();
    wide += width;
  }
  square_ = inner_products(stack_, num_threads);
  square_.diagonal() += prior_precision_;
  xtr_ = stack_.transpose() * residual_;
}

double CandidateSet::share_outside(int one, int other) const {
  if (width(one) > width(other)) std::swap(one, other);
  const Eigen::MatrixXd within = columns(other).transpose() * columns(one);
  return 1.0 - within.colwise().squaredNorm().minCoeff();
}

std::vector<Index> CandidateSet::columns_of(std::span<const int> members) const {
  std::vector<Index> out;
  for (const int m : members) {
    for (Index c = 0; c < members_[m].width; ++c) out.push_back(members_[m].first + c);
  }
  return out;
}

std::optional<SetFit> CandidateSet::evaluate(std::span<const int> members) const {
  const std::vector<Index> which = columns_of(members);
  const auto wide = static_cast<Index>(which.size());
  SetFit out;
  out.dof = dof_ - static_cast<double>(wide);
  if (!(out.dof > 0.0)) return std::nullopt;
  if (members.empty()) {
    out.residual_sum = total_;
    out.score = -0.5 * dof_ * std::log(out.residual_sum);
    return out;
  }
  const Eigen::LLT<Eigen::MatrixXd> root(Eigen::MatrixXd(square_(which, which)));
  Eigen::MatrixXd by_data = square_(which, which);
  by_data.diagonal() -= prior_precision_(which);
  if (!is_independent(Eigen::LLT<Eigen::MatrixXd>(by_data),
                      min_share(prior_precision_(which), kMinShare))) {
    return std::nullopt;
  }
  const Eigen::VectorXd xtr = xtr_(which);
  const Eigen::VectorXd values = root.solve(xtr);
  out.residual_sum = std::max(total_ - xtr.dot(values), 1e-12 * total_);
  out.score = -0.5 * dof_ * std::log(out.residual_sum);
  const Eigen::MatrixXd inverse = root.matrixL().solve(Eigen::MatrixXd::Identity(wide, wide));
  Index at = 0;
  for (const int m : members) {
    const Index k = members_[m].width;
    const Eigen::VectorXd own = values.segment(at, k);
    const Eigen::MatrixXd spread =
        inverse.middleCols(at, k).transpose() * inverse.middleCols(at, k);
    const double wald = own.dot(spread.llt().solve(own));
    out.f.push_back(wald / static_cast<double>(k) / out.noise());
    out.width.push_back(static_cast<int>(k));
    out.score -= complexity_penalty(static_cast<double>(k), out.f.back()) + members_[m].cost;
    at += k;
  }
  return out;
}

double CandidateSet::marginal_score(std::span<const int> members, const SetFit& fit,
                                    std::size_t i) const {
  const double width = fit.width[i], f = fit.f[i];
  return 0.5 * dof_ * std::log1p(width * f / fit.dof) - complexity_penalty(width, f) -
         members_[members[i]].cost;
}

double CandidateSet::score_with(int member, std::span<const int> others, const SetFit& base,
                                const Eigen::MatrixXd& square, const Eigen::VectorXd& xtr) const {
  const Member& own = members_[member];
  bool kin = false;
  for (const int other : others) {
    if (members_[other].alias_group != own.alias_group) continue;
    if (!(members_[other].term->combinable && own.term->combinable)) return kNever;
    kin = true;
  }
  const auto k = static_cast<double>(own.width);
  if (!(base.dof > k + 1.0)) return kNever;
  const Eigen::LLT<Eigen::MatrixXd> root(square);
  if (!is_independent(root, min_share(prior_precision_.segment(own.first, own.width),
                                      kin ? Decisions::kMinShareInAliasGroup : kMinShare))) {
    return kNever;
  }
  const double explained = root.matrixL().solve(xtr).squaredNorm();
  const double left = std::max(base.residual_sum - explained, 1e-12 * total_);
  const double f = explained / k / (left / (base.dof - k));
  return base.score + 0.5 * dof_ * std::log(base.residual_sum / left) - complexity_penalty(k, f) -
         own.cost;
}

/// A Schur complement, of which only the diagonal blocks are needed.
CandidateSet::Projection CandidateSet::project(std::span<const int> members) const {
  const std::vector<Index> which = columns_of(members);
  Projection out;
  out.root.compute(Eigen::MatrixXd(square_(which, which)));
  out.projected = out.root.matrixL().solve(Eigen::MatrixXd(square_(which, Eigen::all)));
  out.explained = out.root.matrixL().solve(Eigen::VectorXd(xtr_(which)));
  out.xtr = xtr_ - out.projected.transpose() * out.explained;
  return out;
}

Eigen::VectorXd CandidateSet::forward_scores(std::span<const int> members) const {
  Eigen::VectorXd scores = Eigen::VectorXd::Constant(size(), kNever);
  const std::optional<SetFit> now = evaluate(members);
  if (!now || size() == 0) return scores;
  const auto [root, projected, explained, xtr] = project(members);
  for (int m = 0; m < size(); ++m) {
    const auto [first, k] = std::pair(members_[m].first, members_[m].width);
    scores[m] =
        score_with(m, members, *now,
                   square_.block(first, first, k, k) -
                       projected.middleCols(first, k).transpose() * projected.middleCols(first, k),
                   xtr.segment(first, k));
  }
  return scores;
}

Eigen::MatrixXd CandidateSet::exchange_scores(std::span<const int> members) const {
  Eigen::MatrixXd scores =
      Eigen::MatrixXd::Constant(static_cast<Index>(members.size()), size(), kNever);
  const std::optional<SetFit> now = evaluate(members);
  if (!now || members.empty()) return scores;
  const auto [root, projected, explained, xtr] = project(members);
  const Index wide = projected.rows();
  const Eigen::MatrixXd inverse = root.matrixL().solve(Eigen::MatrixXd::Identity(wide, wide));
  Index at = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Index k = members_[members[i]].width;
    // Downdate without member i: its coefficient in the others' regression on the set, times its
    // own column projected off the set's other members.
    const Eigen::MatrixXd own = inverse.middleCols(at, k);
    const Eigen::LLT<Eigen::MatrixXd> spread(own.transpose() * own);
    const Eigen::MatrixXd back = spread.matrixL().solve(own.transpose() * projected);
    const Eigen::VectorXd value = spread.matrixL().solve(own.transpose() * explained);
    at += k;
    SetFit rest = *now;
    rest.dof += static_cast<double>(k);
    rest.residual_sum += value.squaredNorm();
    rest.score += 0.5 * dof_ * std::log(now->residual_sum / rest.residual_sum) +
                  complexity_penalty(static_cast<double>(k), now->f[i]) + members_[members[i]].cost;
    std::vector<int> others(members.begin(), members.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    for (int m = 0; m < size(); ++m) {
      if (m == members[i]) continue;
      const auto [first, w] = std::pair(members_[m].first, members_[m].width);
      const auto projected_here = projected.middleCols(first, w);
      const auto back_here = back.middleCols(first, w);
      scores(static_cast<Index>(i), m) = score_with(
          m, others, rest,
          square_.block(first, first, w, w) - projected_here.transpose() * projected_here +
              back_here.transpose() * back_here,
          xtr.segment(first, w) + back_here.transpose() * value);
    }
  }
  return scores;
}

}  // namespace bathyal::selection
