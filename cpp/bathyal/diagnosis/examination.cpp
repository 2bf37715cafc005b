// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/examination.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "bathyal/diagnosis/forms_held_out.hpp"
#include "bathyal/diagnosis/orthonormal.hpp"
#include "bathyal/diagnosis/set_search.hpp"
#include "bathyal/identify/f_distribution.hpp"

namespace bathyal {
namespace {

constexpr int kMostRounds = 4;  ///< of looking for structure beside names
constexpr int kMostProbes = 6;  ///< that are asked at once
constexpr std::size_t kManyNames = 6;
constexpr double kLeastFreedom = 10.0;
constexpr double kChance = 0.05;  ///< corrected p-value from which a name is no better than luck

class Examiner {
 public:
  Examiner(Subject& subject, const ExaminationOptions& options, const Progress& progress)
      : subject_(subject),
        options_(options),
        progress_(progress),
        vantage_(subject, options.num_threads),
        explainer_(vantage_, [this] { tell_again(); }) {
    std::set<std::string> effects;
    for (const Form& form : subject_.forms()) {
      if (!form.probe) effects.insert(form.effect);
    }
    effects_ = static_cast<double>(effects.size());
  }

  Examination run(const FirstLook& look);

 private:
  void tell(double done, const std::string& stage) {
    done_ = done;
    stage_ = stage;
    tell_again();
  }
  /// Within a long stage: whoever listens may want to stop.
  void tell_again() const {
    if (progress_) progress_(done_, stage_);
  }
  bool is_probe(int form) const { return vantage_.form(form).probe; }

  void choose_explanation(const FirstLook& look);
  void weigh_noise();
  void look_beyond_names();
  double foretold_by(const std::vector<int>& forms) const;
  void drop_probes_that_foretell_nothing(const std::vector<int>& standing, std::vector<int>& asked,
                                         std::size_t known);
  void drop_what_is_not_needed();
  void look_at_what_dropped_names_leave();
  void tell_other_structure();
  void drop_what_foretells_nothing();
  double chance(const Pool& pool, int member, const SetFit& fit, std::size_t i) const;
  void tell_evidence();
  void tell_rivals();
  void tell_detectable();

  const Subject& subject_;
  const ExaminationOptions& options_;
  const Progress& progress_;
  Vantage vantage_;
  Explainer explainer_;
  double effects_;  ///< that could be named
  std::vector<int> names_;
  std::vector<int> probes_;
  std::vector<int> other_structure_;  ///< beyond noise, that takes no name's place
  Eigen::VectorXd trust_;
  Examination out_;
  double done_ = 0.0;
  std::string stage_;
};

void Examiner::choose_explanation(const FirstLook& look) {
  vantage_.set_trust(Eigen::VectorXd::Ones(subject_.units().count()));
  vantage_.settle({});
  out_.shown = vantage_.dependences(vantage_.ground());
  out_.base_noise = subject_.noise();
  tell(look.forms.empty() ? 0.2 : 0.5, "looking for causes");
  const Explanation best = look.forms.empty() ? explainer_.best() : explainer_.best_from(look);
  names_ = best.forms;
  trust_ = best.trust;
}

void Examiner::weigh_noise() {
  const Ground& whole = vantage_.ground(names_);
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

/// ln of how likely held-out rows are, comparable from place to place.
double Examiner::foretold_by(const std::vector<int>& forms) const {
  const FormsHeldOut held(vantage_, forms, out_.blocks);
  return held.density() - held.rows() * std::log(subject_.noise());
}

/// Structure takes the place of names only where it foretells, as they must.
void Examiner::drop_probes_that_foretell_nothing(const std::vector<int>& standing,
                                                 std::vector<int>& asked, std::size_t known) {
  std::vector<int> all = standing;
  all.insert(all.end(), asked.begin() + static_cast<std::ptrdiff_t>(known), asked.end());
  const FormsHeldOut held(vantage_, all, out_.blocks);
  const double without = held.density_of(standing);
  other_structure_.clear();
  for (std::size_t i = known; i < asked.size();) {
    std::vector<int> with = standing;
    with.push_back(asked[i]);
    if (held.density_of(with) > without) {
      ++i;
    } else {
      other_structure_.push_back(asked[i]);
      asked.erase(asked.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

/// Structure that the names leave: probes take part in the search, and may show that a name was
/// only the nearest thing to what it is.
void Examiner::look_beyond_names() {
  for (int round = 0; round < kMostRounds; ++round) {
    tell_again();
    std::vector<int> standing = names_;
    standing.insert(standing.end(), probes_.begin(), probes_.end());
    const std::vector<Dependence> beyond = vantage_.dependences(vantage_.ground(standing));
    std::vector<int> asked = explainer_.candidates();
    asked.insert(asked.end(), probes_.begin(), probes_.end());
    const std::size_t known = asked.size();
    for (const Dependence& d : beyond) {
      if (d.p > kBeyondNoise || asked.size() == known + kMostProbes) break;
      asked.push_back(d.form);
    }
    if (asked.size() == known) return;
    if (names_.size() > kManyNames) {
      // So many describe more than they explain, and structure beside them is told as that.
      other_structure_.assign(asked.begin() + static_cast<std::ptrdiff_t>(known), asked.end());
      return;
    }
    drop_probes_that_foretell_nothing(standing, asked, known);
    if (asked.size() == known) return;
    const Pool pool = vantage_.pool_of(asked);
    const std::vector<int> set =
        standing.empty() ? find_best_set(pool) : improve_set(pool, members_of(pool, standing));
    std::vector<int> names, probes;
    for (const int form : forms_of(pool, set)) {
      (is_probe(form) ? probes : names).push_back(form);
    }
    if (probes == probes_) return;
    if (names != names_) {
      // What the search promised must hold where the fit ends.
      const std::vector<int> all = forms_of(pool, set);
      const double before = vantage_.score_of(standing, trust_);
      const double foretold = foretold_by(standing);
      const auto place = vantage_.place();
      vantage_.settle(names);
      if (!(vantage_.score_of(all, trust_) > before && foretold_by(all) > foretold)) {
        vantage_.return_to(*place);
        other_structure_.insert(other_structure_.end(),
                                asked.begin() + static_cast<std::ptrdiff_t>(known), asked.end());
        return;
      }
    }
    names_ = names;
    probes_ = probes;
  }
}

/// That the `i`-th of a set is luck, beside the others: by Fisher's F, with all that was tried of
/// all effects counted.
double Examiner::chance(const Pool& pool, int member, const SetFit& fit, std::size_t i) const {
  return std::min(
      1.0, pool.about(member).trials * effects_ * f_tail(fit.f[i], fit.width[i], fit.freedom));
}

/// Where the search looked, a name may have been worth it that is not where the fit ended, or not
/// beside structure found later.
void Examiner::drop_what_is_not_needed() {
  while (!names_.empty()) {
    std::vector<int> asked = names_;
    asked.insert(asked.end(), probes_.begin(), probes_.end());
    const Pool pool = vantage_.pool_of(asked);
    std::vector<int> set = improve_set(pool, everyone(pool));
    // A name may help only in that it makes another look smaller, and cost less.
    const auto fit = pool.judge(set);
    std::size_t weakest = set.size();
    double p = kChance;
    for (std::size_t i = 0; i < set.size(); ++i) {
      if (pool.about(set[i]).probe || !(chance(pool, set[i], *fit, i) > p)) continue;
      weakest = i;
      p = chance(pool, set[i], *fit, i);
    }
    if (weakest < set.size()) set.erase(set.begin() + static_cast<std::ptrdiff_t>(weakest));
    std::vector<int> needed = forms_of(pool, set);
    std::erase_if(needed, [this](int form) { return is_probe(form); });
    if (needed == names_) return;
    names_ = needed;
    vantage_.settle(names_);
  }
}

/// A name must foretell what it has not seen.
void Examiner::drop_what_foretells_nothing() {
  for (;;) {
    drop_what_is_not_needed();
    FormsHeldOut held(vantage_, names_, out_.blocks);
    const std::size_t promised = held.forms().size();
    const HeldOutErrors before = held.errors_of_base();
    for (;;) {
      const std::size_t count = held.forms().size();
      const double with = held.density();
      std::size_t worst = count;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < count; ++i) {
        const double gain = with - held.density(i);
        if (gain < least) {
          least = gain;
          worst = i;
        }
      }
      const double squares = held.squares();
      const bool gains_nothing = squares >= before.of_block.sum();
      if (least > 0.0 && gains_nothing) {
        // Some that only make up for each other are each needed. One that sends held-out rows far
        // away spoils what the others gain.
        double fewest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count; ++i) {
          const double left = held.squares(i);
          if (left < fewest) {
            fewest = left;
            worst = i;
          }
        }
      }
      if (count > 0 && (!(least > 0.0) || gains_nothing)) {
        held.drop(worst);
        continue;
      }
      if (count < promised) break;
      out_.names.clear();
      for (std::size_t i = 0; i < count; ++i) {
        Chosen chosen;
        chosen.form = held.forms()[i];
        chosen.held_out_with = squares / held.rows();
        chosen.held_out_without = held.squares(i) / held.rows();
        out_.names.push_back(chosen);
      }
      const HeldOutErrors after = held.errors();
      out_.error_before = before.error;
      out_.error_after = after.error;
      out_.luck = sign_flip_p(before.of_block - after.of_block);
      return;
    }
    names_ = held.forms();
    std::sort(names_.begin(), names_.end());
    vantage_.settle(names_);
  }
}

void Examiner::tell_evidence() {
  std::vector<int> all = names_;
  all.insert(all.end(), probes_.begin(), probes_.end());
  const Pool pool = vantage_.pool_of(all);
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
    chosen.p = chance(pool, m, *whole, i);
    if (pool.about(m).probe) {
      out_.probes.push_back(chosen);
    } else {
      *std::find_if(out_.names.begin(), out_.names.end(),
                    [&](const Chosen& c) { return c.form == chosen.form; }) = chosen;
    }
  }
}

/// Structure that takes no name's place is there all the same, where it is worth its freedom beside
/// what stands.
void Examiner::tell_other_structure() {
  std::vector<int> standing = names_;
  standing.insert(standing.end(), probes_.begin(), probes_.end());
  std::vector<int> asked = standing;
  asked.insert(asked.end(), other_structure_.begin(), other_structure_.end());
  const Pool pool = vantage_.pool_of(asked);
  std::vector<int> set = members_of(pool, standing);
  const auto rows = static_cast<double>(subject_.linearization().misfit.size());
  for (const int m : members_of(pool, other_structure_)) {
    const auto now = pool.judge(set);
    set.push_back(m);
    const auto with = pool.judge(set);
    if (!now || !with || !(with->score > now->score)) {
      set.pop_back();
      continue;
    }
    Chosen probe;
    probe.form = pool.form(m);
    probe.f = with->f.back();
    probe.width = with->width.back();
    probe.explained = now->left - with->left;
    const double beyond = std::max(probe.explained - probe.width * with->noise(), 0.0);
    probe.size = std::sqrt(beyond / rows);
    probe.p = chance(pool, m, *with, set.size() - 1);
    out_.probes.push_back(probe);
    out_.left_over += beyond;
  }
}

/// Structure that names stood for which foretold nothing is still there.
void Examiner::look_at_what_dropped_names_leave() {
  const auto rows = static_cast<double>(subject_.linearization().misfit.size());
  std::vector<int> standing = names_;
  standing.insert(standing.end(), probes_.begin(), probes_.end());
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<Dependence> beyond = vantage_.dependences(vantage_.ground(standing));
    if (beyond.empty() || beyond.front().p > kBeyondNoise) return;
    const Dependence& most = beyond.front();
    Chosen probe;
    probe.form = most.form;
    probe.explained = most.explained;
    probe.width = most.width;
    probe.size = most.size;
    probe.p = most.p;
    out_.probes.push_back(probe);
    out_.left_over += most.size * most.size * rows;
    standing.push_back(most.form);
  }
}

void Examiner::tell_rivals() {
  if (names_.empty()) return;
  for (const int form : names_) explainer_.remember(form);
  const Pool pool = vantage_.pool_of(explainer_.candidates());
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

Examination Examiner::run(const FirstLook& look) {
  tell(look.forms.empty() ? 0.1 : 0.4, "looking at what geometry leaves");
  out_.blocks = make_blocks(subject_.units(), options_.blocks);
  choose_explanation(look);
  tell_detectable();
  out_.trust = trust_;
  const Ground& whole = vantage_.ground(names_);
  out_.held_out = out_.blocks.count >= kLeastBlocks && whole.freedom >= kLeastFreedom;
  if (!out_.held_out) {
    vantage_.settle({});
    names_.clear();
    return std::move(out_);
  }
  weigh_noise();
  if (!out_.noise.empty()) {
    // Rows count by their own noise from here on, and what was named is asked again.
    for (const NoiseFit& fit : out_.noise) out_.trust.array() /= fit.factor.array();
    vantage_.set_trust(out_.trust);
    vantage_.settle(names_);
    names_ = explainer_.best_forms(names_, 1);
    vantage_.settle(names_);
  }
  tell(0.6, "looking for what is left");
  look_beyond_names();
  tell(0.8, "measuring the gain");
  const std::vector<int> promised = names_;
  drop_what_foretells_nothing();
  tell_evidence();
  if (names_ == promised) {
    tell_other_structure();
  } else {
    look_at_what_dropped_names_leave();
  }
  tell_rivals();
  for (Index i = 0; i < trust_.size(); ++i) {
    if (!(trust_[i] > 0.0)) out_.odd.push_back(static_cast<int>(i));
  }
  tell(1.0, "done");
  return std::move(out_);
}

}  // namespace

Examination examine(Subject& subject, const ExaminationOptions& options, const Progress& progress,
                    const FirstLook& look) {
  return Examiner(subject, options, progress).run(look);
}

FirstLook find_forms(Subject& subject, int num_threads, const Progress& progress) {
  Vantage vantage(subject, num_threads);
  vantage.set_trust(Eigen::VectorXd::Ones(subject.units().count()));
  vantage.settle({});
  Explainer explainer(vantage, [&progress] {
    if (progress) progress(0.1, "looking for causes in some of the rows");
  });
  return explainer.look_at(explainer.best().forms);
}

}  // namespace bathyal
