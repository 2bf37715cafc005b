// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/candidate_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "bathyal/estimation/gram.hpp"
#include "bathyal/estimation/orthogonal.hpp"

namespace bathyal {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

/// Share of a candidate's column that the set's other members must leave to it.
constexpr double kIndependent = 1e-8;
/// The same of a member of its own cause: with less it is made of the other.
constexpr double kAnother = 0.1;

/// Whether each column of a square keeps `least` beside those before it.
bool is_independent(const Eigen::LLT<Eigen::MatrixXd>& root,
                    const Eigen::Ref<const Eigen::ArrayXd>& least) {
  return root.info() == Eigen::Success &&
         (root.matrixLLT().diagonal().array().square() > least).all();
}

/// What a column must keep beside the others: of two words for one thing, prior and data would let
/// each hold half, at next to no cost of freedom. Of a column that the prior holds tightly the data
/// may say little by itself, and that is no harm.
Eigen::ArrayXd least_kept(const Eigen::Ref<const Eigen::VectorXd>& held_by, double least) {
  constexpr double kHeld = 3.0, kAlike = 1e-3;
  return (kHeld * held_by.array()).min(kAlike).max(least);
}

}  // namespace

double cost_of_freedom(double width, double f) {
  return 0.5 * width * (std::log1p(f) + f / (1.0 + f));
}

Pool::Pool(const Eigen::MatrixXd& basis, const Eigen::VectorXd& misfit, double freedom,
           std::span<const int> forms, std::span<const Form> all,
           std::vector<Eigen::MatrixXd> columns, int num_threads)
    : misfit_(misfit - basis * (basis.transpose() * misfit)),
      total_(misfit_.squaredNorm()),
      freedom_(freedom),
      num_threads_(num_threads) {
  const std::vector<ProjectedColumns> beside =
      projected_columns(basis, std::move(columns), num_threads);
  Index wide = 0;
  std::map<std::string, int> causes;
  for (std::size_t i = 0; i < beside.size(); ++i) {
    const Index width = beside[i].length.size();
    if (width == 0) continue;
    const Form& about = all[static_cast<std::size_t>(forms[i])];
    const int cause = causes.emplace(about.cause, static_cast<int>(causes.size())).first->second;
    members_.push_back({forms[i], &about, wide, width, std::log(about.trials) + kNameCost, cause});
    wide += width;
  }
  stack_.resize(misfit.size(), wide);
  held_by_.resize(wide);
  wide = 0;
  for (const ProjectedColumns& one : beside) {
    const Index width = one.length.size();
    stack_.middleCols(wide, width) = one.columns;
    held_by_.segment(wide, width) = one.length.cwiseAbs2().cwiseInverse();
    wide += width;
  }
  square_ = inner_products(stack_, num_threads);
  square_.diagonal() += held_by_;
  against_ = stack_.transpose() * misfit_;
}

std::vector<Index> Pool::columns_of(std::span<const int> members) const {
  std::vector<Index> out;
  for (const int m : members) {
    for (Index c = 0; c < members_[m].width; ++c) out.push_back(members_[m].first + c);
  }
  return out;
}

std::optional<SetFit> Pool::judge(std::span<const int> members) const {
  const std::vector<Index> which = columns_of(members);
  const auto wide = static_cast<Index>(which.size());
  SetFit out;
  out.freedom = freedom_ - static_cast<double>(wide);
  if (!(out.freedom > 0.0)) return std::nullopt;
  if (members.empty()) {
    out.left = total_;
    out.score = -0.5 * freedom_ * std::log(out.left);
    return out;
  }
  const Eigen::LLT<Eigen::MatrixXd> root(Eigen::MatrixXd(square_(which, which)));
  Eigen::MatrixXd by_data = square_(which, which);
  by_data.diagonal() -= held_by_(which);
  if (!is_independent(Eigen::LLT<Eigen::MatrixXd>(by_data),
                      least_kept(held_by_(which), kIndependent))) {
    return std::nullopt;
  }
  const Eigen::VectorXd against = against_(which);
  const Eigen::VectorXd values = root.solve(against);
  out.left = std::max(total_ - against.dot(values), 1e-12 * total_);
  out.score = -0.5 * freedom_ * std::log(out.left);
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
    out.score -= cost_of_freedom(static_cast<double>(k), out.f.back()) + members_[m].cost;
    at += k;
  }
  return out;
}

double Pool::worth(std::span<const int> members, const SetFit& fit, std::size_t i) const {
  const double width = fit.width[i], f = fit.f[i];
  return 0.5 * freedom_ * std::log1p(width * f / fit.freedom) - cost_of_freedom(width, f) -
         members_[members[i]].cost;
}

double Pool::score_with(int member, std::span<const int> others, const SetFit& base,
                        const Eigen::MatrixXd& square, const Eigen::VectorXd& against) const {
  const Member& own = members_[member];
  bool kin = false;
  for (const int other : others) {
    if (members_[other].cause != own.cause) continue;
    if (!(members_[other].about->shares && own.about->shares)) return kNever;
    kin = true;
  }
  const auto k = static_cast<double>(own.width);
  if (!(base.freedom > k + 1.0)) return kNever;
  const Eigen::LLT<Eigen::MatrixXd> root(square);
  if (!is_independent(root, least_kept(held_by_.segment(own.first, own.width),
                                       kin ? kAnother : kIndependent))) {
    return kNever;
  }
  const double explained = root.matrixL().solve(against).squaredNorm();
  const double left = std::max(base.left - explained, 1e-12 * total_);
  const double f = explained / k / (left / (base.freedom - k));
  return base.score + 0.5 * freedom_ * std::log(base.left / left) - cost_of_freedom(k, f) -
         own.cost;
}

/// A Schur complement, of which only the blocks along the diagonal are wanted.
Pool::Taken Pool::taken_by(std::span<const int> members) const {
  const std::vector<Index> which = columns_of(members);
  Taken out;
  out.root.compute(Eigen::MatrixXd(square_(which, which)));
  out.taken = out.root.matrixL().solve(Eigen::MatrixXd(square_(which, Eigen::all)));
  out.explained = out.root.matrixL().solve(Eigen::VectorXd(against_(which)));
  out.against = against_ - out.taken.transpose() * out.explained;
  return out;
}

Eigen::VectorXd Pool::scores_beside(std::span<const int> members) const {
  Eigen::VectorXd scores = Eigen::VectorXd::Constant(size(), kNever);
  const std::optional<SetFit> now = judge(members);
  if (!now || size() == 0) return scores;
  const auto [root, taken, explained, against] = taken_by(members);
  for (int m = 0; m < size(); ++m) {
    const auto [first, k] = std::pair(members_[m].first, members_[m].width);
    scores[m] = score_with(m, members, *now,
                           square_.block(first, first, k, k) -
                               taken.middleCols(first, k).transpose() * taken.middleCols(first, k),
                           against.segment(first, k));
  }
  return scores;
}

Eigen::MatrixXd Pool::scores_instead(std::span<const int> members) const {
  Eigen::MatrixXd scores =
      Eigen::MatrixXd::Constant(static_cast<Index>(members.size()), size(), kNever);
  const std::optional<SetFit> now = judge(members);
  if (!now || members.empty()) return scores;
  const auto [root, taken, explained, against] = taken_by(members);
  const Index wide = taken.rows();
  const Eigen::MatrixXd inverse = root.matrixL().solve(Eigen::MatrixXd::Identity(wide, wide));
  Index at = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Index k = members_[members[i]].width;
    // Without member i, what it took of others comes back to them: by its part of their regression
    // on the set, times what the set's other members leave of it.
    const Eigen::MatrixXd own = inverse.middleCols(at, k);
    const Eigen::LLT<Eigen::MatrixXd> spread(own.transpose() * own);
    const Eigen::MatrixXd back = spread.matrixL().solve(own.transpose() * taken);
    const Eigen::VectorXd value = spread.matrixL().solve(own.transpose() * explained);
    at += k;
    SetFit rest = *now;
    rest.freedom += static_cast<double>(k);
    rest.left += value.squaredNorm();
    rest.score += 0.5 * freedom_ * std::log(now->left / rest.left) +
                  cost_of_freedom(static_cast<double>(k), now->f[i]) + members_[members[i]].cost;
    std::vector<int> others(members.begin(), members.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    for (int m = 0; m < size(); ++m) {
      if (m == members[i]) continue;
      const auto [first, w] = std::pair(members_[m].first, members_[m].width);
      const auto taken_here = taken.middleCols(first, w);
      const auto back_here = back.middleCols(first, w);
      scores(static_cast<Index>(i), m) =
          score_with(m, others, rest,
                     square_.block(first, first, w, w) - taken_here.transpose() * taken_here +
                         back_here.transpose() * back_here,
                     against.segment(first, w) + back_here.transpose() * value);
    }
  }
  return scores;
}

}  // namespace bathyal
