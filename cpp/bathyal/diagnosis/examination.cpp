// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/examination.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "bathyal/diagnosis/hold_out.hpp"
#include "bathyal/diagnosis/orthonormal.hpp"
#include "bathyal/diagnosis/scan.hpp"
#include "bathyal/identify/f_distribution.hpp"

namespace bathyal {
namespace {

constexpr int kMostPasses = 4;  ///< of naming and standing at what was named
constexpr int kMostScans = 4;   ///< in the first of them; later ones start where it ended
constexpr int kPeaks = 4;       ///< of each scan that are looked at closely
constexpr int kMostProbes = 6;  ///< that are asked at once
constexpr int kFinerRounds = 3;
constexpr double kPlainBonus =
    3.0;  ///< log evidence: two and a half standard deviations of an order
constexpr double kLeastFreedom = 10.0;

void append(Eigen::MatrixXd& columns, const Eigen::MatrixXd& more) {
  columns.conservativeResize(Eigen::NoChange, columns.cols() + more.cols());
  columns.rightCols(more.cols()) = more;
}

class Examiner {
 public:
  Examiner(Subject& subject, const ExaminationOptions& options, const Progress& progress)
      : subject_(subject), options_(options), progress_(progress) {}

  Examination run();

 private:
  /// What the columns of the base model, and of forms beside it, span where the subject stands.
  struct Ground {
    Eigen::MatrixXd basis;
    double freedom = 0.0;
  };
  /// An explanation of everything: forms, and units that do not belong.
  struct Explanation {
    std::vector<int> forms;
    Eigen::VectorXd trust;
    double score = -std::numeric_limits<double>::infinity();
  };

  void tell(double done, const std::string& stage) {
    done_ = done;
    stage_ = stage;
    tell_again();
  }
  /// Within a long stage: whoever listens may want to stop.
  void tell_again() const {
    if (progress_) progress_(done_, stage_);
  }
  bool is_probe(int form) const { return subject_.forms()[form].probe; }

  /// Fits and stands there. What was looked at from the last place is forgotten.
  void settle(const std::vector<int>& forms) {
    bare_.reset();
    last_.reset();
    subject_.settle(forms);
  }
  /// Stays until the next call with other forms; that of no forms until the next `settle`.
  const Ground& ground(const std::vector<int>& forms) const;
  Pool pool_of(const Ground& base, const std::vector<int>& forms) const;
  std::vector<int> forms_of(const Pool& pool, const std::vector<int>& set) const;
  std::vector<int> sharpened(std::vector<int> forms);

  void gather_candidates();
  void remember(int form);
  void add_peaks(const Ground& beside);
  std::vector<int> members_of(const Pool& pool, const std::vector<int>& forms) const;
  std::vector<int> best_forms(std::vector<int> start, int scans);
  Explanation explain(Eigen::VectorXd trust);
  double score_of(const std::vector<int>& forms, const Eigen::VectorXd& trust) const;
  void choose_explanation();
  void weigh_noise();

  std::vector<Dependence> dependences(const Ground& beside) const;
  void look_beyond_names();
  void drop_what_is_not_needed();
  void drop_what_foretells_nothing();
  void tell_evidence();
  void tell_rivals();
  void tell_detectable();

  Subject& subject_;
  const ExaminationOptions& options_;
  const Progress& progress_;
  mutable std::optional<Ground> bare_;  ///< where the subject stands, without forms
  mutable std::optional<std::pair<std::vector<int>, Ground>> last_;  ///< and with those last asked
  std::vector<int> candidates_;                                      ///< library forms worth a pool
  std::set<int> is_sharp_;  ///< forms of scans that were looked at closely
  std::vector<int> names_;
  std::vector<int> probes_;
  Eigen::VectorXd trust_;
  Examination out_;
  double done_ = 0.0;
  std::string stage_;
};

const Examiner::Ground& Examiner::ground(const std::vector<int>& forms) const {
  const Linearization& at = subject_.linearization();
  const auto with = [&](Eigen::MatrixXd basis) {
    const auto freedom = static_cast<double>(at.misfit.size() - basis.cols()) - at.lost;
    return Ground{std::move(basis), freedom};
  };
  if (!bare_) bare_ = with(orthonormal(at.base));
  if (forms.empty()) return *bare_;
  if (!last_ || last_->first != forms) {
    Eigen::MatrixXd basis = bare_->basis;
    append(basis, orthonormal_beside(bare_->basis, side_by_side(subject_.columns(forms))).columns);
    last_.emplace(forms, with(std::move(basis)));
  }
  return last_->second;
}

Pool Examiner::pool_of(const Ground& base, const std::vector<int>& forms) const {
  Pool pool(base.basis, subject_.linearization().misfit, base.freedom);
  pool.add(forms, subject_.forms(), subject_.columns(forms), options_.num_threads);
  return pool;
}

std::vector<int> Examiner::forms_of(const Pool& pool, const std::vector<int>& set) const {
  std::vector<int> forms;
  for (const int member : set) forms.push_back(pool.form(member));
  std::sort(forms.begin(), forms.end());
  return forms;
}

/// All library forms that no scan has: those come by their peaks.
void Examiner::gather_candidates() {
  std::set<int> scanned;
  for (const std::vector<int>& family : subject_.scans()) {
    scanned.insert(family.begin(), family.end());
  }
  for (int form = 0; form < static_cast<int>(subject_.forms().size()); ++form) {
    if (!is_probe(form) && !scanned.contains(form)) candidates_.push_back(form);
  }
}

void Examiner::remember(int form) {
  if (std::find(candidates_.begin(), candidates_.end(), form) == candidates_.end()) {
    candidates_.push_back(form);
  }
}

/// The best of each scan beside what stands already.
void Examiner::add_peaks(const Ground& beside) {
  for (const std::vector<int>& family : subject_.scans()) {
    if (is_probe(family.front())) continue;
    tell_again();
    const std::vector<ScannedForm> scanned =
        scan(subject_, family, beside.basis, subject_.linearization().misfit, beside.freedom,
             options_.num_threads);
    for (const int form : peaks(scanned, kPeaks)) remember(form);
  }
}

/// Each form of a scan where it fits best, between the points of its grid.
std::vector<int> Examiner::sharpened(std::vector<int> forms) {
  for (int& form : forms) {
    if (!is_sharp_.insert(form).second) continue;
    for (int round = 0; round < kFinerRounds; ++round) {
      std::vector<int> near = subject_.finer(form);
      if (near.empty()) break;
      std::vector<int> others = forms;
      std::erase(others, form);
      const Ground& beside = ground(others);
      near.push_back(form);
      const std::vector<ScannedForm> scanned =
          scan(subject_, near, beside.basis, subject_.linearization().misfit, beside.freedom,
               options_.num_threads);
      const auto worth = [&](const ScannedForm& s) {
        return s.gain + (subject_.forms()[s.form].plain ? kPlainBonus : 0.0);
      };
      const auto best = std::max_element(
          scanned.begin(), scanned.end(),
          [&](const ScannedForm& a, const ScannedForm& b) { return worth(a) < worth(b); });
      form = best->form;
      if (subject_.forms()[form].plain) break;
    }
    is_sharp_.insert(form);
    remember(form);
  }
  std::sort(forms.begin(), forms.end());
  return forms;
}

std::vector<int> Examiner::members_of(const Pool& pool, const std::vector<int>& forms) const {
  std::vector<int> members;
  for (int m = 0; m < pool.size(); ++m) {
    if (std::find(forms.begin(), forms.end(), pool.form(m)) != forms.end()) members.push_back(m);
  }
  return members;
}

/// The best set where the subject stands, from `start` on; scans look again beside it.
std::vector<int> Examiner::best_forms(std::vector<int> start, int scans) {
  const Ground& base = ground({});
  std::vector<int> forms = std::move(start);
  for (int round = 0; round < scans; ++round) {
    tell_again();
    const Pool pool = pool_of(base, candidates_);
    const std::vector<int> set =
        forms.empty() ? find_best_set(pool) : improve_set(pool, members_of(pool, forms));
    const bool same = forms == forms_of(pool, set);
    forms = forms_of(pool, set);
    if (forms.empty() || (same && round > 0)) break;
    const std::size_t known = candidates_.size();
    add_peaks(ground(forms));
    if (candidates_.size() == known) break;
  }
  return sharpened(std::move(forms));
}

double Examiner::score_of(const std::vector<int>& forms, const Eigen::VectorXd& trust) const {
  const Ground& base = ground({});
  const Pool pool = pool_of(base, forms);
  std::vector<int> all(static_cast<std::size_t>(pool.size()));
  std::iota(all.begin(), all.end(), 0);
  const auto fit = pool.judge(all);
  if (!fit) return -std::numeric_limits<double>::infinity();
  // Units left out count as rows that a column of their own explains.
  double odd = 0.0, cost = 0.0;
  const Ground& whole = ground(forms);
  const std::vector<UnitTest> tests =
      test_units(subject_.linearization(), whole.basis, trust, whole.freedom);
  for (Index i = 0; i < trust.size(); ++i) {
    if (trust[i] > 0.0) continue;
    odd += 3.0;
    cost += cost_of_freedom(3.0, tests[static_cast<std::size_t>(i)].distance) +
            std::log(static_cast<double>(trust.size()));
  }
  // As judge counts, in metres: noise is another unit from explanation to explanation.
  const double rows = base.freedom + odd;
  return fit->score + 0.5 * base.freedom * std::log(fit->left) -
         0.5 * rows * std::log(fit->left * subject_.noise() * subject_.noise()) - cost;
}

/// Names and odd units in turn, until both stay.
Examiner::Explanation Examiner::explain(Eigen::VectorXd trust) {
  Explanation out{{}, trust, 0.0};
  subject_.set_trust(trust);
  settle({});
  for (int pass = 0; pass < kMostPasses; ++pass) {
    tell_again();
    const std::vector<int> forms = best_forms(out.forms, pass == 0 ? kMostScans : 1);
    settle(forms);
    const Ground& whole = ground(forms);
    const Eigen::VectorXd next =
        leave_out_odd(subject_.linearization(), whole.basis, out.trust, whole.freedom);
    const bool same = next == out.trust;
    const bool settled = same && (forms == out.forms || forms.empty());
    out.forms = forms;
    out.trust = next;
    if (!same) {
      subject_.set_trust(next);
      settle(forms);
    }
    if (settled) break;
  }
  out.score = score_of(out.forms, out.trust);
  return out;
}

/// Gross errors hide causes, and causes look like gross errors: both orders are tried.
void Examiner::choose_explanation() {
  const auto units = subject_.units().count();
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(units);
  subject_.set_trust(all);
  settle({});
  gather_candidates();
  const Ground& base = ground({});
  out_.shown = dependences(base);
  out_.base_noise = subject_.noise();
  tell(0.2, "looking for causes");
  add_peaks(base);
  const Eigen::VectorXd without_odd =
      leave_out_odd(subject_.linearization(), base.basis, all, base.freedom);
  Explanation best = explain(all);
  if (without_odd != all) {
    Explanation other = explain(without_odd);
    if (other.score > best.score) best = std::move(other);
  }
  subject_.set_trust(best.trust);
  settle(best.forms);
  names_ = best.forms;
  trust_ = best.trust;
}

void Examiner::weigh_noise() {
  const Ground& whole = ground(names_);
  for (int f = 0; f < static_cast<int>(subject_.noise_forms().size()); ++f) {
    const NoiseForm& form = subject_.noise_forms()[f];
    NoiseFit fit = fit_noise(form, subject_.linearization(), whole.basis, trust_, subject_.noise(),
                             out_.blocks);
    fit.form = f;
    // A record that shows its step needs no proof that it has one, only that it matters.
    constexpr double kMatters = 0.04;
    const bool named = form.known > 0.0
                           ? fit.share > kMatters
                           : fit.gain > kNameCost + cost_of_freedom(1.0, 2.0 * fit.gain) &&
                                 fit.held_out_gain > 0.0;
    if (named) out_.noise.push_back(std::move(fit));
  }
}

/// What each probe adds to what stands, those beyond noise first.
std::vector<Dependence> Examiner::dependences(const Ground& beside) const {
  std::vector<int> asked;
  for (int form = 0; form < static_cast<int>(subject_.forms().size()); ++form) {
    if (is_probe(form)) asked.push_back(form);
  }
  const Eigen::VectorXd& misfit = subject_.linearization().misfit;
  const std::vector<ScannedForm> scanned =
      scan(subject_, asked, beside.basis, misfit, beside.freedom, options_.num_threads);
  const double total = misfit.squaredNorm() - (beside.basis.transpose() * misfit).squaredNorm();
  const auto rows = static_cast<double>(misfit.size());
  std::vector<Dependence> out;
  for (const ScannedForm& form : scanned) {
    if (form.width == 0.0 || !(beside.freedom > form.width + 1.0)) continue;
    Dependence d{form.form, form.explained, form.width, 1.0, 0.0, 0.0};
    const double noise = (total - form.explained) / (beside.freedom - form.width);
    d.p = std::min(
        1.0, static_cast<double>(asked.size()) * f_tail(form.explained / form.width / noise,
                                                        form.width, beside.freedom - form.width));
    const double beyond = std::max(form.explained - form.width * noise, 0.0);
    d.size = std::sqrt(beyond / rows);
    d.share = total > 0.0 ? beyond / total : 0.0;
    out.push_back(d);
  }
  std::stable_sort(out.begin(), out.end(), [](const Dependence& a, const Dependence& b) {
    return std::pair(a.p, -a.share) < std::pair(b.p, -b.share);
  });
  return out;
}

/// Structure that the names leave: probes take part in the search, and may show that a name was
/// only the nearest thing to what it is.
void Examiner::look_beyond_names() {
  for (int round = 0; round < kMostPasses; ++round) {
    tell_again();
    std::vector<int> standing = names_;
    standing.insert(standing.end(), probes_.begin(), probes_.end());
    const std::vector<Dependence> beyond = dependences(ground(standing));
    std::vector<int> asked = candidates_;
    asked.insert(asked.end(), probes_.begin(), probes_.end());
    const std::size_t known = asked.size();
    for (const Dependence& d : beyond) {
      if (d.p > kBeyondNoise || asked.size() == known + kMostProbes) break;
      asked.push_back(d.form);
    }
    if (asked.size() == known) return;
    const Pool pool = pool_of(ground({}), asked);
    const std::vector<int> set =
        standing.empty() ? find_best_set(pool) : improve_set(pool, members_of(pool, standing));
    std::vector<int> names, probes;
    for (const int form : forms_of(pool, set)) {
      (is_probe(form) ? probes : names).push_back(form);
    }
    if (names == names_ && probes == probes_) return;
    if (names != names_) {
      // What the search promised must hold where the fit ends.
      const double before = score_of(standing, trust_);
      settle(names);
      if (!(score_of(forms_of(pool, set), trust_) > before)) {
        settle(names_);
        return;
      }
    }
    names_ = names;
    probes_ = probes;
  }
}

/// Where the search looked, a name may have been worth it that is not where the fit ended.
void Examiner::drop_what_is_not_needed() {
  for (;;) {
    const Pool pool = pool_of(ground({}), names_);
    std::vector<int> all(static_cast<std::size_t>(pool.size()));
    std::iota(all.begin(), all.end(), 0);
    const std::vector<int> needed = forms_of(pool, improve_set(pool, all));
    if (needed == names_) return;
    names_ = needed;
    settle(names_);
  }
}

/// A name must foretell what it has not seen.
void Examiner::drop_what_foretells_nothing() {
  for (;;) {
    drop_what_is_not_needed();
    const Linearization& at = subject_.linearization();
    const Ground& base = ground({});
    const Pool pool = pool_of(base, names_);
    Eigen::MatrixXd columns = base.basis;
    std::vector<Index> basis(static_cast<std::size_t>(base.basis.cols()));
    std::iota(basis.begin(), basis.end(), Index{0});
    std::vector<int> kept;
    std::vector<std::vector<Index>> own;
    for (int m = 0; m < pool.size(); ++m) {
      const Index old = columns.cols();
      append(columns, pool.columns(m));
      own.emplace_back(static_cast<std::size_t>(pool.width(m)));
      std::iota(own.back().begin(), own.back().end(), old);
      kept.push_back(pool.form(m));
    }
    Eigen::VectorXd held_by = Eigen::VectorXd::Zero(columns.cols());
    held_by.tail(pool.held_by().size()) = pool.held_by();
    const HoldOut held(at.misfit, columns, held_by, at.unit, out_.blocks, options_.num_threads);
    const HeldOutErrors before = held.errors(basis);
    const auto all_but = [&](std::size_t without) {
      std::vector<Index> which = basis;
      for (std::size_t i = 0; i < own.size(); ++i) {
        if (i != without) which.insert(which.end(), own[i].begin(), own[i].end());
      }
      return which;
    };
    std::size_t worst = own.size();
    for (;;) {
      const std::vector<Index> all = all_but(own.size());
      const double with = held.density(all);
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < own.size(); ++i) {
        const double gain = with - held.density(all_but(i));
        if (gain < least) {
          least = gain;
          worst = i;
        }
      }
      const double squares = held.squares(all).sum();
      // Some that only make up for each other may each be needed, and together gain nothing.
      if (!own.empty() && (!(least > 0.0) || squares >= before.of_block.sum())) {
        kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(worst));
        own.erase(own.begin() + static_cast<std::ptrdiff_t>(worst));
        continue;
      }
      if (static_cast<int>(kept.size()) < pool.size()) break;
      out_.names.clear();
      for (std::size_t i = 0; i < kept.size(); ++i) {
        Chosen chosen;
        chosen.form = kept[i];
        chosen.held_out_with = squares / held.rows();
        chosen.held_out_without = held.squares(all_but(i)).sum() / held.rows();
        out_.names.push_back(chosen);
      }
      const HeldOutErrors after = held.errors(all);
      out_.error_before = before.error;
      out_.error_after = after.error;
      out_.luck = sign_flip_p(before.of_block - after.of_block);
      return;
    }
    names_ = kept;
    std::sort(names_.begin(), names_.end());
    settle(names_);
  }
}

void Examiner::tell_evidence() {
  const Ground& base = ground({});
  std::vector<int> all = names_;
  all.insert(all.end(), probes_.begin(), probes_.end());
  const Pool pool = pool_of(base, all);
  std::vector<int> named, everything;
  for (int m = 0; m < pool.size(); ++m) {
    everything.push_back(m);
    if (!pool.about(m).probe) named.push_back(m);
  }
  const auto whole = pool.judge(everything);
  const auto names_only = pool.judge(named);
  out_.base_squares = pool.total();
  if (!whole || !names_only) return;
  out_.freedom = names_only->freedom;
  const auto width_of = [&](const std::vector<int>& members) {
    double width = 0.0;
    for (const int m : members) width += static_cast<double>(pool.width(m));
    return width;
  };
  const double noise = whole->noise();
  out_.removed = std::max(pool.total() - names_only->left - width_of(named) * noise, 0.0);
  out_.left_over = std::max(
      names_only->left - whole->left - (width_of(everything) - width_of(named)) * noise, 0.0);
  const auto rows = static_cast<double>(subject_.linearization().misfit.size());
  std::set<std::string> effects;
  for (const Form& form : subject_.forms()) {
    if (!form.probe) effects.insert(form.effect);
  }
  for (std::size_t i = 0; i < everything.size(); ++i) {
    const int m = everything[i];
    const double width = whole->width[i], f = whole->f[i];
    Chosen chosen;
    chosen.form = pool.form(m);
    if (!pool.about(m).probe) {
      chosen = *std::find_if(out_.names.begin(), out_.names.end(),
                             [&](const Chosen& c) { return c.form == pool.form(m); });
    }
    chosen.f = f;
    chosen.width = width;
    chosen.explained = f * width * noise;
    chosen.size = std::sqrt(std::max(f * width - width, 0.0) / rows);
    chosen.p = std::min(1.0, pool.about(m).trials * static_cast<double>(effects.size()) *
                                 f_tail(f, width, whole->freedom));
    if (pool.about(m).probe) {
      out_.probes.push_back(chosen);
    } else {
      *std::find_if(out_.names.begin(), out_.names.end(),
                    [&](const Chosen& c) { return c.form == chosen.form; }) = chosen;
    }
  }
}

void Examiner::tell_rivals() {
  if (names_.empty()) return;
  for (const int form : names_) remember(form);
  const Pool pool = pool_of(ground({}), candidates_);
  for (const Rival& rival : find_rivals(pool, members_of(pool, names_))) {
    out_.rivals.push_back({pool.form(rival.member), pool.form(rival.instead), rival.odds});
  }
}

/// Of a form with two columns among fifty: the size at which its evidence would have been enough.
void Examiner::tell_detectable() {
  constexpr double kWidth = 2.0, kTrials = 50.0;
  const auto rows = static_cast<double>(subject_.linearization().misfit.size());
  double explained = 20.0;
  for (int round = 0; round < 50; ++round) {
    explained = 2.0 * (kNameCost + std::log(kTrials) + cost_of_freedom(kWidth, explained / kWidth));
  }
  out_.detectable = std::sqrt(explained / rows);
}

Examination Examiner::run() {
  tell(0.1, "looking at what geometry leaves");
  out_.blocks = make_blocks(subject_.units(), options_.blocks);
  choose_explanation();
  tell_detectable();
  out_.trust = trust_;
  const Ground& whole = ground(names_);
  out_.held_out = out_.blocks.count >= kLeastBlocks && whole.freedom >= kLeastFreedom;
  if (!out_.held_out) {
    settle({});
    names_.clear();
    return std::move(out_);
  }
  weigh_noise();
  if (!out_.noise.empty()) {
    // Rows count by their own noise from here on, and what was named is asked again.
    for (const NoiseFit& fit : out_.noise) out_.trust.array() /= fit.factor.array();
    subject_.set_trust(out_.trust);
    settle(names_);
    names_ = best_forms(names_, 1);
    settle(names_);
  }
  tell(0.6, "looking for what is left");
  look_beyond_names();
  tell(0.8, "measuring the gain");
  drop_what_foretells_nothing();
  tell_evidence();
  tell_rivals();
  for (Index i = 0; i < trust_.size(); ++i) {
    if (!(trust_[i] > 0.0)) out_.odd.push_back(static_cast<int>(i));
  }
  tell(1.0, "done");
  return std::move(out_);
}

}  // namespace

Examination examine(Subject& subject, const ExaminationOptions& options, const Progress& progress) {
  return Examiner(subject, options, progress).run();
}

}  // namespace bathyal
