// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/internal/report.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/selection/decisions.hpp"

namespace bathyal::diagnosis {
namespace {

constexpr std::size_t kMaxAlternatives = 5;  ///< `rivals` of an effect
constexpr std::size_t kMaxListed = 4;        ///< of them in `ambiguous`, the effect included

/// The t whose two tails hold 5 %.
double t_of_95(double dof) {
  double low = 1.0, high = 20.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (f_tail(middle * middle, 1.0, dof) > 0.05 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

class Reporter {
 public:
  Reporter(const ArmModel& arm_model, const Measurement& measurement, const Arm& nominal,
           const selection::SelectionResult& found, const DiagnoseOptions& options)
      : model_(arm_model), m_(measurement), found_(found), options_(options), out_(nominal) {}

  Diagnosis report() {
    out_.fit = model_.geometry();
    out_.arm = model_.arm();
    out_.found = model_.found();
    out_.support = support_of(m_.q, used_covariates(model_.data()));
    out_.residuals_before = model_.deviations_before();
    out_.residuals_after = model_.deviations();
    fill_noise();
    fill_lack_of_fit_before();
    if (!found_.held_out) {
      fill_too_few_data();
      return std::move(out_);
    }
    out_.detectable = found_.detectable * model_.mean_unit();
    fill_held_out();
    fill_effects();
    fill_unexplained();
    decide();
    return std::move(out_);
  }

 private:
  const selection::Term& term_at(int index) const { return model_.terms()[index]; }

  /// Pure error from replicates of a pose; else the residuals of the model.
  void fill_noise() {
    std::vector<Eigen::VectorXd> values(static_cast<std::size_t>(m_.rows()));
    for (Index i = 0; i < m_.rows(); ++i) values[i] = out_.residuals_after.col(i);
    for (const int row : found_.outliers) values[row].resize(0);
    const selection::PureError pure =
        selection::pure_error(values, model_.observations().replicate);
    if (pure.is_measured()) {
      out_.noise_is_measured = true;
      out_.noise = std::sqrt(pure.squares / pure.dof);
      out_.noise_source = "repeats of " + counted(pure.sets, "pose");
    } else {
      out_.noise = model_.mean_noise();
      out_.noise_source = "what the model leaves";
    }
    constexpr double kComputed = 1e-7;  // [m] at which the search's convergence becomes visible
    if (found_.held_out && out_.noise < kComputed) {
      out_.warnings.push_back(
          "Noise of " + millimetres(out_.noise) +
          " per axis is less than any instrument has: these data look computed, and what the "
          "search rounds off passes for structure. Give them the noise of an instrument.");
    }
  }

  void fill_lack_of_fit_before() {
    std::set<std::string> reported;
    for (const selection::LackOfFit& d : found_.lack_of_fit_before) {
      if (d.p > selection::Decisions::kBeyondNoise && !out_.lack_of_fit_before.empty())
        break;  // the most significant is reported in any case
      if (!reported.insert(term_at(d.term).effect).second) continue;
      out_.lack_of_fit_before.push_back(
          structure(d.term, d.size * found_.base_noise, d.share, d.p));
    }
  }

  void fill_too_few_data() {
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    HeldOut& out = out_.held_out;
    out.how = counted(m_.rows(), m_.tracked ? "pose" : "touch", m_.tracked ? "poses" : "touches") +
              (options_.groups.empty() && found_.folds.count < selection::Decisions::kMinFolds
                   ? " make fewer than three blocks of poses that differ"
                   : " leave hardly more equations than unknowns");
    out.noise = std::sqrt(3.0) * out_.noise;
    out.rms_before = out.rms_after = out_.gain = out_.detectable = kNothing;
    out_.warnings.push_back("Too few data to hold any out: what is shown is all that can be said.");
  }

  void fill_held_out() {
    HeldOut& out = out_.held_out;
    out.how = found_.folds.description;
    out.blocks = found_.folds.count;
    out.p_value = found_.p_value;
    out.noise = std::sqrt(3.0) * out_.noise;
    out.before = errors(found_.error_before);
    out.after = errors(found_.error_after);
    const auto part = [&](const std::string& name, const auto& wanted) {
      HeldOut::Part p{name, 0, 0.0, 0.0};
      for (Index i = 0; i < m_.rows(); ++i) {
        if (!wanted(i) || std::isnan(out.before[i])) continue;
        ++p.rows;
        p.rms_before += out.before[i] * out.before[i];
        p.rms_after += out.after[i] * out.after[i];
      }
      const double count = std::max(p.rows, 1);
      p.rms_before = std::sqrt(p.rms_before / count);
      p.rms_after = std::sqrt(p.rms_after / count);
      return p;
    };
    const HeldOut::Part all = part("all", [](Index) { return true; });
    out.rms_before = all.rms_before;
    out.rms_after = all.rms_after;
    const std::vector<int>& session = model_.observations().session;
    const std::vector<std::string> names = session_names();
    std::set<std::string> reported;
    for (const std::string& group : options_.groups) {
      if (!reported.insert(group).second) continue;
      out.parts.push_back(
          part("group " + group, [&](Index i) { return options_.groups[i] == group; }));
    }
    const bool by_session = names.size() > 1 && options_.groups.empty();
    for (std::size_t s = 0; by_session && s < names.size(); ++s) {
      out.parts.push_back(
          part("session " + names[s], [&](Index i) { return session[i] == static_cast<int>(s); }));
    }
    for (int p = 0; !m_.tracked && p < m_.points(); ++p) {
      out.parts.push_back(
          part("point " + m_.name_of(m_.labels[p]), [&](Index i) { return m_.point[i] == p; }));
    }
    const std::vector<bool> outside = extrapolated();
    if (std::find(outside.begin(), outside.end(), true) != outside.end()) {
      out.parts.push_back(part("within others' ranges", [&](Index i) { return !outside[i]; }));
      out.parts.push_back(part("beyond others' ranges", [&](Index i) { return bool(outside[i]); }));
    }
    if (out.parts.empty()) out.parts.push_back(all);
    const double above = out.rms_before * out.rms_before - out.noise * out.noise;
    if (above > 0.0) {
      out_.gain = (out.rms_before * out.rms_before - out.rms_after * out.rms_after) / above;
    }
  }

  /// As in the record; counted from 1 where it has none.
  std::vector<std::string> session_names() const {
    const EffectData& data = model_.data();
    std::vector<std::string> names;
    if (data.has("session")) {
      const auto labels = data.covariate("session").reshaped();
      for (const double label : std::set<double>(labels.begin(), labels.end())) {
        names.push_back(to_text(label));
      }
    } else {
      const std::vector<int>& session = model_.observations().session;
      const int count = 1 + *std::max_element(session.begin(), session.end());
      for (int s = 1; s <= count; ++s) names.push_back(std::to_string(s));
    }
    return names;
  }

  /// (N,) whether a row's joints are outside the ranges of all other folds: there the prediction
  /// extrapolates.
  std::vector<bool> extrapolated() const {
    std::vector<bool> out(static_cast<std::size_t>(m_.rows()), false);
    for (int block = 0; block < found_.folds.count; ++block) {
      std::vector<Index> own, others;
      for (Index i = 0; i < m_.rows(); ++i) {
        (found_.folds.fold_of[i] == block ? own : others).push_back(i);
      }
      const RowMatrix known = m_.q(others, Eigen::all);
      const Eigen::RowVectorXd low = known.colwise().minCoeff();
      const Eigen::RowVectorXd high = known.colwise().maxCoeff();
      for (const Index i : own) {
        const auto q = m_.q.row(i).array();
        out[i] = (q < low.array()).any() || (q > high.array()).any();
      }
    }
    return out;
  }

  /// (N,) 3-D, of position rows [m]; NaN for outliers.
  Eigen::VectorXd errors(const Eigen::VectorXd& rows) const {
    Eigen::VectorXd out = model_.in_metres(rows).colwise().norm();
    for (const int row : found_.outliers) out[row] = std::numeric_limits<double>::quiet_NaN();
    return out;
  }

  void fill_effects() {
    const Eigen::MatrixXd covariance = model_.covariance();
    const double t = t_of_95(model_.dof());
    const HeldOut& held = out_.held_out;
    const double above =
        std::max(held.rms_before * held.rms_before - held.noise * held.noise, 1e-300);
    Index at = 0, order = 0;
    for (const FoundEffect& effect : out_.found)
      order += static_cast<Index>(effect.variant.parameters.size());
    for (const FoundEffect& effect : out_.found) {
      const auto chosen = std::find_if(
          found_.terms.begin(), found_.terms.end(), [&](const selection::SelectedTerm& c) {
            return model_.effect(c.term) == effect.effect.get() &&
                   model_.variant(c.term).settings == effect.variant.settings &&
                   model_.variant(c.term).joint == effect.variant.joint;
          });
      NamedEffect named;
      named.name = effect.variant.effect;
      named.joint = effect.variant.joint;
      named.description = term_at(chosen->term).description;
      for (const auto& [name, value] : effect.variant.settings) {
        const bool fitted = name == "order" && !has_whole_order(effect.variant);
        const double std = fitted ? std::sqrt(std::max(covariance(order, order), 0.0)) : 0.0;
        order += fitted ? 1 : 0;
        named.parameters.push_back({name, "", value, std, value - t * std, value + t * std});
      }
      for (std::size_t p = 0; p < effect.variant.parameters.size(); ++p, ++at) {
        const EffectParameter& parameter = effect.variant.parameters[p];
        const double value = effect.values[static_cast<Index>(p)];
        const double std = std::sqrt(std::max(covariance(at, at), 0.0));
        named.parameters.push_back(
            {parameter.name, parameter.unit, value, std, value - t * std, value + t * std});
      }
      named.size = chosen->size * model_.mean_unit();
      const double rows = 3.0;  // a held-out mean square is per row, rms are of three
      named.held_out_before = std::sqrt(rows * chosen->held_out_without) * model_.mean_unit();
      named.held_out_after = std::sqrt(rows * chosen->held_out_with) * model_.mean_unit();
      named.gain = (named.held_out_before * named.held_out_before -
                    named.held_out_after * named.held_out_after) /
                   above;
      named.p_value = chosen->p;
      for (const selection::AlternativeTerm& alternative : found_.alternatives) {
        if (alternative.term != chosen->term || named.alternatives.size() == kMaxAlternatives)
          continue;
        named.alternatives.push_back(cause(alternative.replacement, alternative.odds));
      }
      out_.effects.push_back(std::move(named));
    }
    std::stable_sort(out_.effects.begin(), out_.effects.end(),
                     [](const NamedEffect& a, const NamedEffect& b) { return a.size > b.size; });
    fill_outliers();
    for (const selection::VarianceComponentFit& fit : found_.noise) {
      const selection::VarianceComponent& about = model_.variance_components()[fit.term];
      NamedEffect named;
      named.name = about.effect;
      named.description = about.description;
      named.parameters.push_back({about.parameter, about.unit, fit.parameter, fit.std,
                                  fit.parameter - t * fit.std, fit.parameter + t * fit.std});
      named.size = std::sqrt(fit.share) * model_.mean_noise();
      named.gain = fit.held_out_gain;
      out_.effects.push_back(std::move(named));
    }
  }

  void fill_outliers() {
    if (found_.outliers.empty()) return;
    NamedEffect named;
    named.name = "outliers";
    named.rows = found_.outliers;
    named.description = counted(static_cast<long>(found_.outliers.size()), "row") + " that " +
                        (found_.outliers.size() == 1 ? "does" : "do") + " not belong";
    const auto count = static_cast<double>(found_.outliers.size());
    named.parameters.push_back({"count", "1", count, 0.0, count, count});
    double squares = 0.0;
    for (const int row : found_.outliers) squares += out_.residuals_after.col(row).squaredNorm();
    named.size = std::sqrt(squares / static_cast<double>(3 * m_.rows()));
    out_.effects.push_back(std::move(named));
  }

  Structure structure(int index, double size, double share, double p_value) const {
    const LackOfFitTerm& term = model_.lack_of_fit_term(index);
    return {term.dependence, term.joint, term.description, size, share, p_value};
  }

  Cause cause(int index, double odds) const {
    return {term_at(index).effect, term_at(index).joint, term_at(index).description, odds};
  }

  void fill_unexplained() {
    const auto rows = static_cast<double>(3 * m_.rows());
    const double size = std::sqrt(found_.unexplained / rows) * model_.mean_unit();
    const double share = found_.base_squares > 0.0 ? found_.unexplained / found_.base_squares : 0.0;
    if (found_.lack_of_fit.empty()) {
      if (found_.autocorrelation.empty()) {
        if (!found_.scatter.empty()) {
          const selection::VarianceComponentFit& most = found_.scatter.front();
          const selection::VarianceComponent& about = model_.variance_components()[most.term];
          out_.unexplained = {{}, about.joint, about.description, size, share, most.p()};
        } else if (found_.pure_error.p <= selection::Decisions::kBeyondNoise) {
          out_.unexplained = {{},   -1,    "more than repeats of a pose differ",
                              size, share, found_.pure_error.p};
        }
        return;
      }
      const selection::Autocorrelation& alike = found_.autocorrelation.front();
      const Dependence& context = model_.context(alike.context);
      out_.unexplained = {context,
                          std::max(alike.direction - kFirstJoint, -1),
                          describe(alike.direction, context),
                          size,
                          share,
                          alike.p};
      return;
    }
    const auto most =
        std::max_element(found_.lack_of_fit.begin(), found_.lack_of_fit.end(),
                         [](const selection::SelectedTerm& a, const selection::SelectedTerm& b) {
                           return a.explained < b.explained;
                         });
    out_.unexplained = structure(most->term, size, share, most->p);
  }

  void decide() {
    const bool unexplained =
        (!found_.lack_of_fit.empty() || !found_.autocorrelation.empty() ||
         !found_.scatter.empty() || found_.pure_error.p <= selection::Decisions::kBeyondNoise) &&
        found_.unexplained > options_.leftover * found_.explained;
    if (unexplained) {
      out_.verdict = Verdict::kUnknown;
      return;
    }
    if (out_.effects.empty()) {
      out_.verdict = Verdict::kClean;
      return;
    }
    out_.verdict = Verdict::kNamed;
    std::map<int, std::size_t> listed;  // causes in the place of a term, itself included
    for (const selection::AlternativeTerm& alternative : found_.alternatives) {
      if (alternative.odds < options_.rival_odds || listed[alternative.term] == kMaxListed)
        continue;
      if (++listed[alternative.term] == 1) {
        ++listed[alternative.term];
        out_.ambiguous.push_back(cause(alternative.term, 1.0));
      }
      out_.ambiguous.push_back(cause(alternative.replacement, alternative.odds));
    }
    if (!out_.ambiguous.empty()) out_.verdict = Verdict::kAmbiguous;
  }

  const ArmModel& model_;
  const Measurement& m_;
  const selection::SelectionResult& found_;
  const DiagnoseOptions& options_;
  Diagnosis out_;
};

}  // namespace

Diagnosis report(const ArmModel& arm_model, const Measurement& measurement, const Arm& nominal,
                 const selection::SelectionResult& found, const DiagnoseOptions& options) {
  return Reporter(arm_model, measurement, nominal, found, options).report();
}

}  // namespace bathyal::diagnosis
