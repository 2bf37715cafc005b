// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/explainer.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/diagnosis/odd_units.hpp"
#include "bathyal/diagnosis/scan.hpp"
#include "bathyal/diagnosis/set_search.hpp"

namespace bathyal {
namespace {

constexpr int kMostPasses = 4;  ///< of naming and standing at what was named
constexpr int kMostScans = 4;   ///< in the first of them; later ones start where it ended
constexpr int kPeaks = 4;       ///< of each scan that are looked at closely
constexpr int kFinerRounds = 3;
/// Log evidence: two and a half standard deviations of an order.
constexpr double kPlainBonus = 3.0;

}  // namespace

/// All library forms that no scan has: those come by their peaks.
Explainer::Explainer(Vantage& vantage, std::function<void()> still_at_it)
    : vantage_(vantage), still_at_it_(std::move(still_at_it)) {
  std::set<int> scanned;
  for (const std::vector<int>& family : vantage_.subject().scans()) {
    scanned.insert(family.begin(), family.end());
  }
  for (int form = 0; form < static_cast<int>(vantage_.subject().forms().size()); ++form) {
    if (!vantage_.form(form).probe && !scanned.contains(form)) candidates_.push_back(form);
  }
}

void Explainer::remember(int form) {
  if (std::find(candidates_.begin(), candidates_.end(), form) == candidates_.end()) {
    candidates_.push_back(form);
  }
}

/// The best of each scan beside what stands already.
void Explainer::add_peaks(const Ground& beside) {
  for (const std::vector<int>& family : vantage_.subject().scans()) {
    if (vantage_.form(family.front()).probe) continue;
    still_at_it_();
    const std::vector<ScannedForm> scanned =
        scan(vantage_.subject(), family, beside.basis, vantage_.subject().linearization().misfit,
             beside.freedom, vantage_.num_threads());
    for (const int form : peaks(scanned, kPeaks)) remember(form);
  }
}

/// Each form of a scan where it fits best, between the points of its grid.
std::vector<int> Explainer::sharpened(std::vector<int> forms) {
  for (int& form : forms) {
    if (!is_sharp_.insert(form).second) continue;
    for (int round = 0; round < kFinerRounds; ++round) {
      std::vector<int> near = vantage_.finer(form);
      if (near.empty()) break;
      std::vector<int> others = forms;
      std::erase(others, form);
      const Ground& beside = vantage_.ground(others);
      near.push_back(form);
      const std::vector<ScannedForm> scanned =
          scan(vantage_.subject(), near, beside.basis, vantage_.subject().linearization().misfit,
               beside.freedom, vantage_.num_threads());
      const auto worth = [&](const ScannedForm& s) {
        return s.gain + (vantage_.form(s.form).plain ? kPlainBonus : 0.0);
      };
      const auto best = std::max_element(
          scanned.begin(), scanned.end(),
          [&](const ScannedForm& a, const ScannedForm& b) { return worth(a) < worth(b); });
      form = best->form;
      if (vantage_.form(form).plain) break;
    }
    is_sharp_.insert(form);
    remember(form);
  }
  std::sort(forms.begin(), forms.end());
  return forms;
}

std::vector<int> Explainer::best_forms(std::vector<int> start, int scans) {
  std::vector<int> forms = std::move(start);
  for (int round = 0; round < scans; ++round) {
    still_at_it_();
    const Pool pool = vantage_.pool_of(candidates_);
    const std::vector<int> set =
        forms.empty() ? find_best_set(pool) : improve_set(pool, members_of(pool, forms));
    const bool same = forms == forms_of(pool, set);
    forms = forms_of(pool, set);
    if (forms.empty() || (same && round > 0)) break;
    const std::size_t known = candidates_.size();
    add_peaks(vantage_.ground(forms));
    if (candidates_.size() == known) break;
  }
  return sharpened(std::move(forms));
}

/// Names and odd units in turn, until both stay.
Explanation Explainer::explain(Eigen::VectorXd trust) {
  Explanation out{{}, trust, 0.0};
  vantage_.set_trust(trust);
  vantage_.settle({});
  for (int pass = 0; pass < kMostPasses; ++pass) {
    still_at_it_();
    const std::vector<int> forms = best_forms(out.forms, pass == 0 ? kMostScans : 1);
    vantage_.settle(forms);
    const Ground& whole = vantage_.ground(forms);
    const Eigen::VectorXd next =
        leave_out_odd(vantage_.subject().linearization(), whole.basis, out.trust, whole.freedom);
    const bool same = next == out.trust;
    const bool settled = same && (forms == out.forms || forms.empty());
    out.forms = forms;
    out.trust = next;
    if (!same) {
      vantage_.set_trust(next);
      vantage_.settle(forms);
    }
    if (settled) break;
  }
  out.score = vantage_.score_of(out.forms, out.trust);
  return out;
}

Explanation Explainer::best() {
  const Linearization& at = vantage_.subject().linearization();
  const Ground& base = vantage_.ground();
  add_peaks(base);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(vantage_.subject().units().count());
  const Eigen::VectorXd without_odd = leave_out_odd(at, base.basis, all, base.freedom);
  // Gross errors hide causes, and causes look like gross errors: both orders are tried.
  Explanation best = explain(all);
  if (without_odd != all) {
    Explanation other = explain(without_odd);
    if (other.score > best.score) best = std::move(other);
  }
  vantage_.set_trust(best.trust);
  vantage_.settle(best.forms);
  return best;
}

}  // namespace bathyal
