// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/term_selection.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/selection/internal/grid_scan.hpp"
#include "bathyal/selection/internal/subset_search.hpp"
#include "bathyal/selection/outlier_test.hpp"

namespace bathyal {
namespace {

constexpr int kMostPasses = 6;         ///< of naming and standing at what was named
constexpr double kSettledScore = 0.5;  ///< log evidence: less is no better
constexpr double kFarBehind = 20.0;    ///< the same: four times the units make up for no more
constexpr int kMostScans = 4;          ///< in the first of them; later ones start where it ended
constexpr int kPeaks = 4;              ///< of each scan that are looked at closely
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

/// Each form of a scan where it fits best, between the points of its grid. All of them move at
/// once, each beside the others as they stand; a move that the set does not gain by is not made.
std::vector<int> Explainer::sharpened(std::vector<int> forms) {
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (is_sharp_.insert(forms[i]).second) moving.push_back(i);
  }
  for (int round = 0; round < kFinerRounds && !moving.empty(); ++round) {
    still_at_it_();
    std::vector<int> asked = forms;
    std::vector<std::vector<int>> near;
    for (const std::size_t i : moving) {
      near.push_back(vantage_.finer(forms[i]));
      asked.insert(asked.end(), near.back().begin(), near.back().end());
    }
    const Pool pool = vantage_.pool_of(asked);
    std::vector<int> set = members_of(pool, forms);
    const auto now = pool.judge(set);
    if (!now) break;
    const auto worth = [&](double score, int form) {
      return score + (vantage_.form(form).plain ? kPlainBonus : 0.0);
    };
    double best = now->score;
    const Eigen::MatrixXd instead = pool.scores_instead(set);
    std::vector<std::size_t> still;
    for (std::size_t k = 0; k < moving.size(); ++k) {
      int& form = forms[moving[k]];
      const auto place =
          std::find_if(set.begin(), set.end(), [&](int m) { return pool.form(m) == form; });
      if (place == set.end()) continue;
      const Eigen::VectorXd scores = instead.row(place - set.begin());
      int chosen = *place;
      double most = worth(now->score, form);
      for (const int m : members_of(pool, near[k])) {
        if (worth(scores[m], pool.form(m)) > most) {
          chosen = m;
          most = worth(scores[m], pool.form(m));
        }
      }
      if (chosen != *place) {
        const int old = std::exchange(*place, chosen);
        const auto moved = pool.judge(set);
        if (moved && worth(moved->score, pool.form(chosen)) > worth(best, form)) {
          best = moved->score;
          form = pool.form(chosen);
          is_sharp_.insert(form);
        } else {
          *place = old;
        }
      }
      if (!near[k].empty() && !vantage_.form(form).plain) still.push_back(moving[k]);
    }
    moving = still;
  }
  for (const int form : forms) remember(form);
  std::sort(forms.begin(), forms.end());
  return forms;
}

std::vector<int> Explainer::best_forms(std::vector<int> start, int scans) {
  std::vector<int> forms = std::move(start);
  for (int round = 0; round < std::max(scans, 1); ++round) {
    still_at_it_();
    const Pool pool = vantage_.pool_of(candidates_);
    const std::vector<int> set =
        forms.empty() ? find_best_set(pool) : improve_set(pool, members_of(pool, forms));
    const bool same = forms == forms_of(pool, set);
    forms = forms_of(pool, set);
    if (forms.empty() || (same && round > 0)) break;
    if (scans == 0) break;
    const std::size_t known = candidates_.size();
    add_peaks(vantage_.ground(forms));
    if (candidates_.size() == known) break;
  }
  return sharpened(std::move(forms));
}

/// Names, then odd units, one step on from `now`, where the subject stands.
Explanation Explainer::step_from(const Explanation& now, int scans) {
  Explanation next{best_forms(now.forms, scans), now.trust};
  vantage_.settle(next.forms);
  const Ground& whole = vantage_.ground(next.forms);
  next.trust =
      leave_out_odd(vantage_.subject().linearization(), whole.basis, now.trust, whole.freedom);
  if (next.trust != now.trust) {
    vantage_.set_trust(next.trust);
    vantage_.settle(next.forms);
  }
  return next;
}

/// Such steps until both stay; the best that was seen, for they may go in rounds.
Explainer::Seen Explainer::explain(Eigen::VectorXd trust) {
  Explanation now{{}, std::move(trust)};
  vantage_.set_trust(now.trust);
  vantage_.settle({});
  Seen best;
  int worse = 0;
  for (int pass = 0; pass < kMostPasses && worse < 2; ++pass) {
    still_at_it_();
    const Explanation next = step_from(now, now.forms.empty() ? kMostScans : 1);
    const double score = vantage_.score_of(next.forms, next.trust);
    worse = pass == 0 || score > best.score + kSettledScore ? 0 : worse + 1;
    if (pass == 0 || score > best.score) best = {next, score, vantage_.place()};
    const bool stays = next.trust == now.trust && (next.forms == now.forms || next.forms.empty());
    if (stays) break;
    now = next;
  }
  return best;
}

Explanation Explainer::best() {
  const Linearization& at = vantage_.subject().linearization();
  const Ground& base = vantage_.ground();
  add_peaks(base);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(vantage_.subject().units().count());
  const Eigen::VectorXd without_odd = leave_out_odd(at, base.basis, all, base.freedom);
  // Gross errors hide causes, and causes look like gross errors: both orders are tried.
  Seen best = explain(all);
  if (without_odd != all) {
    Seen other = explain(without_odd);
    if (other.score > best.score) best = std::move(other);
  }
  vantage_.return_to(*best.place);
  return best.explanation;
}

Explanation Explainer::best_from(const FirstLook& look) {
  candidates_ = look.candidates;
  // What a fit does not move (the moment of a slip) is looked at again where there are more units.
  for (const int form : candidates_) {
    const Form& about = vantage_.form(form);
    if (about.moves || about.plain) is_sharp_.insert(form);
  }
  const Explanation found{look.forms, Eigen::VectorXd::Ones(vantage_.subject().units().count())};
  vantage_.set_trust(found.trust);
  vantage_.settle(found.forms);
  return step_from(found, 0);
}

FirstLook Explainer::look_at(const std::vector<int>& forms) const {
  const Pool pool = vantage_.pool_of(candidates_);
  const std::vector<int> set = members_of(pool, forms);
  const auto now = pool.judge(set);
  if (!now) return {forms, candidates_};
  const Eigen::VectorXd beside = pool.scores_beside(set);
  const Eigen::MatrixXd instead = pool.scores_instead(set);
  FirstLook out{forms, forms};
  for (int m = 0; m < pool.size(); ++m) {
    const bool stands = std::find(set.begin(), set.end(), m) != set.end();
    const double best = set.empty() ? beside[m] : std::max(beside[m], instead.col(m).maxCoeff());
    if (!stands && best > now->score - kFarBehind) out.candidates.push_back(pool.form(m));
  }
  return out;
}

}  // namespace bathyal
