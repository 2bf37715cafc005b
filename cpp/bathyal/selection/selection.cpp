// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/selection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/selection/internal/cross_validation.hpp"
#include "bathyal/selection/internal/subset_search.hpp"

namespace bathyal {
namespace {

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

  void choose_explanation(const FirstLook& look);
  void weigh_noise();
  void drop_what_is_not_needed();
  void drop_what_foretells_nothing();
  double chance(const Pool& pool, int member, const SetFit& fit, std::size_t i) const;
  void tell_held_out(const FormsHeldOut& held, const HeldOutErrors& before);
  void tell_evidence();
  void tell_structure(const std::vector<Dependence>& beside);
  void tell_rivals();
  void tell_detectable();

  const Subject& subject_;
  const ExaminationOptions& options_;
  const Progress& progress_;
  Vantage vantage_;
  Explainer explainer_;
  double effects_;  ///< that could be named
  Standing standing_;
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
  standing_.names = best.forms;
  trust_ = best.trust;
}

void Examiner::weigh_noise() {
  const Ground& whole = vantage_.ground(standing_.names);
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
    if (named) out_.noise.push_back(fit);
  }
  if (out_.noise.empty()) return;
  // Rows count by their own noise from here on, and what was named is asked again.
  Eigen::VectorXd ratios = Eigen::VectorXd::Zero(static_cast<Index>(subject_.noise_forms().size()));
  for (const NoiseFit& fit : out_.noise) ratios[fit.form] = fit.ratio;
  vantage_.set_noise_forms(ratios);
  vantage_.settle(standing_.names);
  const Explanation again = explainer_.again({standing_.names, trust_});
  standing_.names = again.forms;
  trust_ = again.trust;
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
  while (!standing_.names.empty()) {
    const Pool pool = vantage_.pool_of(standing_.all());
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
    std::erase_if(needed, [this](int form) { return vantage_.form(form).probe; });
    if (needed == standing_.names) return;
    standing_.names = needed;
    vantage_.settle(standing_.names);
  }
}

/// The place of a name that foretells nothing beside the others, where there is one. `before`:
/// squares of the base model.
std::optional<std::size_t> place_without_use(const FormsHeldOut& held, double before) {
  if (held.forms().empty()) return std::nullopt;
  const auto least = [&held](const auto& of_place) {
    std::vector<double> values;
    for (std::size_t i = 0; i < held.forms().size(); ++i) values.push_back(of_place(i));
    const auto at = std::min_element(values.begin(), values.end());
    return std::pair(*at, static_cast<std::size_t>(at - values.begin()));
  };
  const double with = held.density();
  const auto [gain, worst] = least([&](std::size_t i) { return with - held.density(i); });
  if (!(gain > 0.0)) return worst;
  if (held.squares() < before) return std::nullopt;
  // Some that only make up for each other are each needed. One that sends held-out rows far away
  // spoils what the others gain.
  return least([&](std::size_t i) { return held.squares(i); }).second;
}

/// A name must foretell what it has not seen.
void Examiner::drop_what_foretells_nothing() {
  for (;;) {
    drop_what_is_not_needed();
    FormsHeldOut held(vantage_, standing_.names, out_.blocks);
    const std::size_t promised = held.forms().size();
    const HeldOutErrors before = held.errors_of_base();
    while (const auto place = place_without_use(held, before.of_block.sum())) held.drop(*place);
    if (held.forms().size() == promised) {
      tell_held_out(held, before);
      return;
    }
    standing_.names = held.forms();
    std::sort(standing_.names.begin(), standing_.names.end());
    vantage_.settle(standing_.names);
  }
}

void Examiner::tell_held_out(const FormsHeldOut& held, const HeldOutErrors& before) {
  const double squares = held.squares();
  for (std::size_t i = 0; i < held.forms().size(); ++i) {
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
}

void Examiner::tell_evidence() {
  const Pool pool = vantage_.pool_of(standing_.all());
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
    const bool probe = pool.about(m).probe;
    if (probe) out_.probes.push_back({pool.form(m)});
    Chosen& chosen = probe ? out_.probes.back()
                           : *std::find_if(out_.names.begin(), out_.names.end(),
                                           [&](const Chosen& c) { return c.form == pool.form(m); });
    chosen.f = f;
    chosen.width = width;
    chosen.explained = f * width * noise;
    chosen.size = std::sqrt(std::max(f * width - width, 0.0) / rows);
    chosen.p = chance(pool, m, *whole, i);
  }
}

/// Structure beside all that stands.
void Examiner::tell_structure(const std::vector<Dependence>& beside) {
  const auto rows = static_cast<double>(subject_.linearization().misfit.size());
  for (const Dependence& d : beside) {
    Chosen probe;
    probe.form = d.form;
    probe.explained = d.explained;
    probe.width = d.width;
    probe.size = d.size;
    probe.p = d.p;
    out_.probes.push_back(probe);
    out_.left_over += d.size * d.size * rows;
  }
}

void Examiner::tell_rivals() {
  if (standing_.names.empty()) return;
  for (const int form : standing_.names) explainer_.remember(form);
  const Pool pool = vantage_.pool_of(explainer_.candidates());
  for (const Rival& rival : find_rivals(pool, members_of(pool, standing_.names))) {
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
  const Ground& whole = vantage_.ground(standing_.names);
  out_.held_out = out_.blocks.count >= kLeastBlocks && whole.freedom >= kLeastFreedom;
  if (!out_.held_out) {
    vantage_.settle({});
    standing_.names.clear();
    return std::move(out_);
  }
  weigh_noise();
  tell(0.6, "looking for what is left");
  BeyondNames beyond(vantage_, explainer_.candidates(), out_.blocks, trust_,
                     [this] { tell_again(); });
  standing_ = beyond.look(standing_.names);
  tell(0.8, "measuring the gain");
  const std::vector<int> promised = standing_.names;
  drop_what_foretells_nothing();
  tell_evidence();
  tell_structure(beyond.left_by(standing_, standing_.names != promised));
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
