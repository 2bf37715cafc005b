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

namespace bathyal {

std::vector<int> everyone(const Pool& pool) {
  std::vector<int> members(static_cast<std::size_t>(pool.size()));
  std::iota(members.begin(), members.end(), 0);
  return members;
}

std::vector<int> forms_of(const Pool& pool, const std::vector<int>& members) {
  std::vector<int> forms;
  for (const int member : members) forms.push_back(pool.form(member));
  std::sort(forms.begin(), forms.end());
  return forms;
}

std::vector<int> members_of(const Pool& pool, const std::vector<int>& forms) {
  std::vector<int> members;
  for (int m = 0; m < pool.size(); ++m) {
    if (std::find(forms.begin(), forms.end(), pool.form(m)) != forms.end()) members.push_back(m);
  }
  return members;
}

void Vantage::settle(const std::vector<int>& forms) {
  bare_.reset();
  last_.reset();
  subject_.settle(forms);
}

void Vantage::return_to(const Subject::Place& place) {
  bare_.reset();
  last_.reset();
  subject_.return_to(place);
}

const Ground& Vantage::ground(const std::vector<int>& forms) const {
  const Linearization& at = subject_.linearization();
  const auto with = [&](Eigen::MatrixXd basis) {
    const auto freedom = static_cast<double>(at.misfit.size() - basis.cols()) - at.lost;
    return Ground{std::move(basis), freedom};
  };
  if (!bare_) bare_ = with(orthonormal(at.base));
  if (forms.empty()) return *bare_;
  if (!last_ || last_->first != forms) {
    Eigen::MatrixXd basis = bare_->basis;
    append(basis, projected_columns(bare_->basis, {concatenate_columns(subject_.columns(forms))},
                                    num_threads_)
                      .front()
                      .columns);
    last_.emplace(forms, with(std::move(basis)));
  }
  return last_->second;
}

Pool Vantage::pool_of(const std::vector<int>& forms) const {
  const Ground& base = ground();
  return {base.basis,       subject_.linearization().misfit, base.freedom, forms,
          subject_.forms(), subject_.columns(forms),         num_threads_};
}

std::vector<Dependence> Vantage::dependences(const Ground& beside) const {
  std::vector<int> asked;
  for (int form = 0; form < static_cast<int>(subject_.forms().size()); ++form) {
    if (subject_.forms()[form].probe) asked.push_back(form);
  }
  const Eigen::VectorXd& misfit = subject_.linearization().misfit;
  const std::vector<ScannedForm> scanned =
      scan(subject_, asked, beside.basis, misfit, beside.freedom, num_threads_);
  const double total = misfit.squaredNorm() - (beside.basis.transpose() * misfit).squaredNorm();
  const auto rows = static_cast<double>(misfit.size());
  std::vector<Dependence> out;
  for (const ScannedForm& form : scanned) {
    if (form.width == 0.0 || !(beside.freedom > form.width + 1.0)) continue;
    Dependence d{form.form, form.explained, form.width};
    const double noise = (total - form.explained) / (beside.freedom - form.width);
    d.p = std::min(
        1.0, static_cast<double>(asked.size()) * f_tail(form.explained / form.width / noise,
                                                        form.width, beside.freedom - form.width));
    const double beyond = std::max(form.explained - form.width * noise, 0.0);
    d.size = std::sqrt(beyond / rows);
    d.share = total > 0.0 ? beyond / total : 0.0;
    d.gain = form.gain - std::log(subject_.forms()[form.form].trials);
    out.push_back(d);
  }
  std::stable_sort(out.begin(), out.end(), [](const Dependence& a, const Dependence& b) {
    return std::pair(a.p, -a.share) < std::pair(b.p, -b.share);
  });
  return out;
}

double Vantage::score_of(const std::vector<int>& forms, const Eigen::VectorXd& trust) const {
  const Ground& base = ground();
  const Pool pool = pool_of(forms);
  const auto fit = pool.judge(everyone(pool));
  if (!fit) return -std::numeric_limits<double>::infinity();
  // Units left out count as rows that a column of their own explains.
  double odd = 0.0, cost = 0.0;
  const Ground& whole = ground(forms);
  const std::vector<UnitTest> tests =
      test_units(subject_.linearization(), whole.basis, trust, whole.freedom);
  for (Index i = 0; i < trust.size(); ++i) {
    if (trust[i] > 0.0) continue;
    const UnitTest& test = tests[static_cast<std::size_t>(i)];
    odd += test.rows;
    cost += cost_of_freedom(test.rows, test.distance) + std::log(static_cast<double>(trust.size()));
  }
  // As judge counts, in metres: noise is another unit from explanation to explanation.
  const double rows = base.freedom + odd;
  return fit->score + 0.5 * base.freedom * std::log(fit->left) -
         0.5 * rows * std::log(fit->left * subject_.noise() * subject_.noise()) - cost;
}

}  // namespace bathyal
