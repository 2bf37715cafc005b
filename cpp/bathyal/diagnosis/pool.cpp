// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/pool.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bathyal/base/parallel.hpp"
#include "bathyal/diagnosis/orthonormal.hpp"

namespace bathyal {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

/// Share of a candidate's column that the set's other members must leave to it.
constexpr double kIndependent = 1e-8;
/// The same of a member of its own cause: with less it is made of the other.
constexpr double kAnother = 0.1;

}  // namespace

double cost_of_freedom(double width, double f) {
  return 0.5 * width * (std::log1p(f) + f / (1.0 + f));
}

Pool::Pool(const Eigen::MatrixXd& basis, const Eigen::VectorXd& misfit, double freedom)
    : basis_(basis),
      misfit_(misfit - basis * (basis.transpose() * misfit)),
      total_(misfit_.squaredNorm()),
      freedom_(freedom),
      stack_(misfit.size(), 0) {}

int Pool::add(std::span<const int> forms, std::span<const Form> all,
              const std::vector<Eigen::MatrixXd>& columns, int num_threads) {
  std::vector<Eigen::MatrixXd> beside(columns.size());
  parallel_for(columns.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) beside[i] = orthonormal_beside(basis_, columns[i]);
  });
  const Index old = stack_.cols();
  Index wide = old;
  int taken = 0;
  for (std::size_t i = 0; i < beside.size(); ++i) {
    if (beside[i].cols() == 0) continue;
    const Form& about = all[static_cast<std::size_t>(forms[i])];
    members_.push_back(
        {forms[i], &about, wide, beside[i].cols(), std::log(about.trials) + kNameCost});
    wide += beside[i].cols();
    ++taken;
  }
  stack_.conservativeResize(Eigen::NoChange, wide);
  for (std::size_t i = 0, m = members_.size() - static_cast<std::size_t>(taken); i < beside.size();
       ++i) {
    if (beside[i].cols() == 0) continue;
    stack_.middleCols(members_[m].first, members_[m].width) = beside[i];
    ++m;
  }
  // The new columns against all, a strip of the square by each thread.
  Eigen::MatrixXd square(wide, wide);
  square.topLeftCorner(old, old) = square_;
  constexpr Index kStrip = 64;
  const Index fresh = wide - old;
  parallel_for(static_cast<std::size_t>(fresh), kStrip, num_threads,
               [&](std::size_t begin, std::size_t end) {
                 const auto first = old + static_cast<Index>(begin);
                 const auto count = static_cast<Index>(end - begin);
                 square.middleCols(first, count).noalias() =
                     stack_.transpose() * stack_.middleCols(first, count);
               });
  square.bottomLeftCorner(fresh, old) = square.topRightCorner(old, fresh).transpose();
  square_ = std::move(square);
  against_ = stack_.transpose() * misfit_;
  return taken;
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
  const auto wide = static_cast<double>(which.size());
  SetFit out;
  out.freedom = freedom_ - wide;
  if (!(out.freedom > 0.0)) return std::nullopt;
  const Eigen::MatrixXd square = square_(which, which);
  const Eigen::VectorXd against = against_(which);
  const Eigen::LDLT<Eigen::MatrixXd> solver(square);
  if (wide > 0.0 && !(solver.vectorD().minCoeff() > kIndependent)) return std::nullopt;
  const Eigen::VectorXd values = solver.solve(against);
  out.left = std::max(total_ - against.dot(values), 1e-12 * total_);
  out.score = -0.5 * freedom_ * std::log(out.left);
  const Eigen::MatrixXd inverse =
      solver.solve(Eigen::MatrixXd::Identity(square.rows(), square.cols()));
  Index at = 0;
  for (const int m : members) {
    const Index k = members_[m].width;
    const Eigen::VectorXd own = values.segment(at, k);
    const Eigen::MatrixXd spread = inverse.block(at, at, k, k);
    const double wald = own.dot(spread.ldlt().solve(own));
    out.f.push_back(wald / static_cast<double>(k) / out.noise());
    out.width.push_back(static_cast<int>(k));
    out.score -= cost_of_freedom(static_cast<double>(k), out.f.back()) + members_[m].cost;
    at += k;
  }
  return out;
}

Eigen::VectorXd Pool::scores_beside(std::span<const int> members) const {
  Eigen::VectorXd scores = Eigen::VectorXd::Constant(size(), kNever);
  const std::optional<SetFit> now = judge(members);
  if (!now) return scores;
  const std::vector<Index> which = columns_of(members);
  // What the set leaves of each candidate and of the misfit: a Schur complement, of which only the
  // blocks along the diagonal are wanted.
  const Eigen::LLT<Eigen::MatrixXd> root(Eigen::MatrixXd(square_(which, which)));
  const Eigen::MatrixXd taken = root.matrixL().solve(Eigen::MatrixXd(square_(which, Eigen::all)));
  const Eigen::VectorXd against =
      against_ - taken.transpose() * root.matrixL().solve(Eigen::VectorXd(against_(which)));
  for (int m = 0; m < size(); ++m) {
    const Member& member = members_[m];
    const bool kin = std::any_of(members.begin(), members.end(), [&](int other) {
      return members_[other].about->cause == member.about->cause;
    });
    const bool stands_alone = std::any_of(members.begin(), members.end(), [&](int other) {
      return members_[other].about->cause == member.about->cause &&
             !(members_[other].about->shares && member.about->shares);
    });
    if (stands_alone || !(now->freedom > static_cast<double>(member.width) + 1.0)) continue;
    const auto taken_here = taken.middleCols(member.first, member.width);
    const Eigen::LDLT<Eigen::MatrixXd> solver(
        square_.block(member.first, member.first, member.width, member.width) -
        taken_here.transpose() * taken_here);
    if (!(solver.vectorD().minCoeff() > (kin ? kAnother : kIndependent))) continue;
    const Eigen::VectorXd own = against.segment(member.first, member.width);
    const double explained = own.dot(solver.solve(own));
    const double left = std::max(now->left - explained, 1e-12 * total_);
    const double k = static_cast<double>(member.width);
    const double f = explained / k / (left / (now->freedom - k));
    scores[m] = now->score + 0.5 * freedom_ * std::log(now->left / left) - cost_of_freedom(k, f) -
                member.cost;
  }
  return scores;
}

}  // namespace bathyal
