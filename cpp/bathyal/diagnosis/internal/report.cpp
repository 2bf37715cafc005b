// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/internal/report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bathyal/estimation/f_distribution.hpp"

namespace bathyal {
namespace {

constexpr double kLeastRepeats = 12.0;  ///< degrees of freedom of repeats that tell the noise
constexpr std::size_t kMostRivals = 5;

/// The t whose two tails hold 5 %.
double t_of_95(double freedom) {
  double low = 1.0, high = 20.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (f_tail(middle * middle, 1.0, freedom) > 0.05 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

class Reporter {
 public:
  Reporter(const ArmSubject& subject, const Measurement& measurement, const Arm& nominal,
           const Examination& found, const DiagnoseOptions& options)
      : subject_(subject), m_(measurement), found_(found), options_(options), out_(nominal) {}

  Diagnosis report() {
    out_.fit = subject_.geometry();
    out_.arm = subject_.arm();
    out_.found = subject_.found();
    out_.support = support_of(m_.q, used_covariates(subject_.data()));
    out_.residuals_before = subject_.bare_deviations();
    out_.residuals_after = subject_.deviations();
    tell_noise();
    tell_shown();
    if (!found_.held_out) {
      tell_why_nothing_is_held_out();
      return std::move(out_);
    }
    out_.detectable = found_.detectable * subject_.mean_unit();
    tell_held_out();
    tell_effects();
    tell_leftover();
    decide();
    return std::move(out_);
  }

 private:
  const Form& form(int index) const { return subject_.forms()[index]; }

  /// By repeats of a pose, which no model explains away; else by what the model leaves.
  void tell_noise() {
    std::map<int, std::vector<Index>> twins;
    std::set<int> odd(found_.odd.begin(), found_.odd.end());
    for (Index i = 0; i < m_.rows(); ++i) {
      if (!odd.contains(static_cast<int>(i))) twins[subject_.units().twin[i]].push_back(i);
    }
    double squares = 0.0, freedom = 0.0;
    int poses = 0;
    for (const auto& [twin, rows] : twins) {
      if (rows.size() < 2) continue;
      const Eigen::Matrix3Xd same = out_.residuals_after(Eigen::all, rows);
      squares += (same.colwise() - same.rowwise().mean()).squaredNorm();
      freedom += 3.0 * (static_cast<double>(rows.size()) - 1.0);
      ++poses;
    }
    if (freedom >= kLeastRepeats && squares > 0.0) {
      out_.noise = std::sqrt(squares / freedom);
      out_.noise_source = "repeats of " + counted(poses, "pose");
    } else {
      out_.noise = subject_.mean_noise();
      out_.noise_source = "what the model leaves";
    }
    constexpr double kComputed = 1e-7;  // [m] at which steps of the search come to be seen
    if (found_.held_out && out_.noise < kComputed) {
      out_.warnings.push_back(
          "Noise of " + millimetres(out_.noise) +
          " per axis is less than any instrument has: these data look computed, and what the "
          "search rounds off passes for structure. Give them the noise of an instrument.");
    }
  }

  void tell_shown() {
    std::set<std::string> told;
    for (const Dependence& d : found_.shown) {
      if (d.p > kBeyondNoise && !out_.shown.empty())
        break;  // the least unlikely is told in any case
      if (!told.insert(form(d.form).effect).second) continue;
      out_.shown.push_back(
          {form(d.form).effect, form(d.form).words, d.size * found_.base_noise, d.share, d.p});
    }
  }

  void tell_why_nothing_is_held_out() {
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    HeldOut& out = out_.held_out;
    out.how =
        counted(m_.rows(), m_.tracked ? "pose" : "touch", m_.tracked ? "poses" : "touches") +
        (found_.blocks.count < kLeastBlocks ? " make fewer than three blocks of poses that differ"
                                            : " leave hardly more equations than unknowns");
    out.noise = std::sqrt(3.0) * out_.noise;
    out.rms_before = out.rms_after = out_.gain = out_.detectable = kNothing;
    out_.warnings.push_back("Too few data to hold any out: what is shown is all that can be said.");
  }

  void tell_held_out() {
    HeldOut& out = out_.held_out;
    out.how = found_.blocks.how;
    out.blocks = found_.blocks.count;
    out.p_value = found_.luck;
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
    const std::vector<int>& session = subject_.units().session;
    const std::vector<std::string> names = session_names();
    for (std::size_t s = 0; names.size() > 1 && s < names.size(); ++s) {
      out.parts.push_back(
          part("session " + names[s], [&](Index i) { return session[i] == static_cast<int>(s); }));
    }
    for (int p = 0; !m_.tracked && p < m_.points(); ++p) {
      out.parts.push_back(
          part("point " + m_.name_of(m_.labels[p]), [&](Index i) { return m_.point[i] == p; }));
    }
    const std::vector<bool> beyond = beyond_the_others();
    if (std::find(beyond.begin(), beyond.end(), true) != beyond.end()) {
      out.parts.push_back(part("within others' ranges", [&](Index i) { return !beyond[i]; }));
      out.parts.push_back(part("beyond others' ranges", [&](Index i) { return bool(beyond[i]); }));
    }
    if (out.parts.empty()) out.parts.push_back(all);
    const double above = out.rms_before * out.rms_before - out.noise * out.noise;
    if (above > 0.0) {
      out_.gain = (out.rms_before * out.rms_before - out.rms_after * out.rms_after) / above;
    }
  }

  /// As the record calls them; counted from 1 where it does not.
  std::vector<std::string> session_names() const {
    const EffectData& data = subject_.data();
    std::vector<std::string> names;
    if (data.has("session")) {
      const auto labels = data.covariate("session").reshaped();
      for (const double label : std::set<double>(labels.begin(), labels.end())) {
        names.push_back(to_text(label));
      }
    } else {
      const std::vector<int>& session = subject_.units().session;
      const int count = 1 + *std::max_element(session.begin(), session.end());
      for (int s = 1; s <= count; ++s) names.push_back(std::to_string(s));
    }
    return names;
  }

  /// (N,) whether a row's joints lie where no row of the other blocks reaches: what was found is a
  /// guess there.
  std::vector<bool> beyond_the_others() const {
    std::vector<bool> out(static_cast<std::size_t>(m_.rows()), false);
    for (int block = 0; block < found_.blocks.count; ++block) {
      std::vector<Index> own, others;
      for (Index i = 0; i < m_.rows(); ++i) {
        (found_.blocks.of[i] == block ? own : others).push_back(i);
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

  /// (N,) 3-D, of position rows [m]; NaN of rows that are left out.
  Eigen::VectorXd errors(const Eigen::VectorXd& rows) const {
    Eigen::VectorXd out = subject_.in_metres(rows).colwise().norm();
    for (const int odd : found_.odd) out[odd] = std::numeric_limits<double>::quiet_NaN();
    return out;
  }

  void tell_effects() {
    const Eigen::MatrixXd covariance = subject_.covariance();
    const double t = t_of_95(subject_.freedom());
    const HeldOut& held = out_.held_out;
    const double above =
        std::max(held.rms_before * held.rms_before - held.noise * held.noise, 1e-300);
    Index at = 0;
    for (const FoundEffect& effect : out_.found) {
      const auto chosen =
          std::find_if(found_.names.begin(), found_.names.end(), [&](const Chosen& c) {
            return subject_.effect(c.form) == effect.effect.get() &&
                   subject_.variant(c.form).settings == effect.variant.settings &&
                   subject_.variant(c.form).joint == effect.variant.joint;
          });
      NamedEffect named;
      named.name = effect.variant.effect;
      named.joint = effect.variant.joint;
      named.words = form(chosen->form).words;
      for (const auto& [name, value] : effect.variant.settings) {
        named.parameters.push_back({name, "", value, 0.0, value, value});
      }
      for (std::size_t p = 0; p < effect.variant.parameters.size(); ++p, ++at) {
        const EffectParameter& parameter = effect.variant.parameters[p];
        const double value = effect.values[static_cast<Index>(p)];
        const double std = std::sqrt(std::max(covariance(at, at), 0.0));
        named.parameters.push_back(
            {parameter.name, parameter.unit, value, std, value - t * std, value + t * std});
      }
      named.size = chosen->size * subject_.mean_unit();
      const double rows = 3.0;  // a held-out mean square is per row, rms are of three
      named.held_out_before = std::sqrt(rows * chosen->held_out_without) * subject_.mean_unit();
      named.held_out_after = std::sqrt(rows * chosen->held_out_with) * subject_.mean_unit();
      named.gain = (named.held_out_before * named.held_out_before -
                    named.held_out_after * named.held_out_after) /
                   above;
      named.p_value = chosen->p;
      for (const RivalForm& rival : found_.rivals) {
        if (rival.form != chosen->form || named.rivals.size() == kMostRivals) continue;
        named.rivals.push_back(cause(rival.instead, rival.odds));
      }
      out_.effects.push_back(std::move(named));
    }
    std::stable_sort(out_.effects.begin(), out_.effects.end(),
                     [](const NamedEffect& a, const NamedEffect& b) { return a.size > b.size; });
    tell_odd();
    for (const NoiseFit& fit : found_.noise) {
      const NoiseForm& about = subject_.noise_forms()[fit.form];
      NamedEffect named;
      named.name = about.effect;
      named.words = about.words;
      named.parameters.push_back({about.parameter, about.unit, fit.parameter, fit.std,
                                  fit.parameter - t * fit.std, fit.parameter + t * fit.std});
      named.size = std::sqrt(fit.share) * out_.noise;
      named.gain = fit.held_out_gain;
      out_.effects.push_back(std::move(named));
    }
  }

  void tell_odd() {
    if (found_.odd.empty()) return;
    NamedEffect named;
    named.name = "outliers";
    named.rows = found_.odd;
    named.words = counted(static_cast<long>(found_.odd.size()), "row") + " that " +
                  (found_.odd.size() == 1 ? "does" : "do") + " not belong";
    const auto count = static_cast<double>(found_.odd.size());
    named.parameters.push_back({"count", "1", count, 0.0, count, count});
    double squares = 0.0;
    for (const int row : found_.odd) squares += out_.residuals_after.col(row).squaredNorm();
    named.size = std::sqrt(squares / static_cast<double>(3 * m_.rows()));
    out_.effects.push_back(std::move(named));
  }

  Cause cause(int index, double odds) const {
    return {form(index).effect, form(index).joint, form(index).words, odds};
  }

  void tell_leftover() {
    if (found_.probes.empty()) return;
    const auto most = std::max_element(
        found_.probes.begin(), found_.probes.end(),
        [](const Chosen& a, const Chosen& b) { return a.explained < b.explained; });
    const auto rows = static_cast<double>(3 * m_.rows());
    out_.leftover = {form(most->form).effect, form(most->form).words,
                     std::sqrt(found_.left_over / rows) * subject_.mean_unit(),
                     found_.base_squares > 0.0 ? found_.left_over / found_.base_squares : 0.0,
                     most->p};
  }

  void decide() {
    const bool left =
        !found_.probes.empty() && found_.left_over > options_.leftover * found_.removed;
    if (left) {
      out_.verdict = Verdict::kUnknown;
      return;
    }
    if (out_.effects.empty()) {
      out_.verdict = Verdict::kClean;
      return;
    }
    out_.verdict = Verdict::kNamed;
    std::vector<int> forms;
    for (const RivalForm& rival : found_.rivals) {
      if (rival.odds < options_.rival_odds) continue;
      if (std::find(forms.begin(), forms.end(), rival.form) == forms.end()) {
        forms.push_back(rival.form);
        out_.ambiguous.push_back(cause(rival.form, 1.0));
      }
      out_.ambiguous.push_back(cause(rival.instead, rival.odds));
    }
    if (!out_.ambiguous.empty()) out_.verdict = Verdict::kAmbiguous;
  }

  const ArmSubject& subject_;
  const Measurement& m_;
  const Examination& found_;
  const DiagnoseOptions& options_;
  Diagnosis out_;
};

}  // namespace

Diagnosis report(const ArmSubject& subject, const Measurement& measurement, const Arm& nominal,
                 const Examination& found, const DiagnoseOptions& options) {
  return Reporter(subject, measurement, nominal, found, options).report();
}

}  // namespace bathyal
