// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/diagnose.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/diagnosis/arm/internal/next_poses.hpp"
#include "bathyal/diagnosis/arm/internal/room_check.hpp"
#include "bathyal/diagnosis/internal/duplicates.hpp"
#include "bathyal/diagnosis/internal/model_check.hpp"
#include "bathyal/diagnosis/internal/nested.hpp"
#include "bathyal/diagnosis/internal/record_checks.hpp"
#include "bathyal/diagnosis/internal/report.hpp"
#include "bathyal/effects/gravity_load.hpp"
#include "bathyal/identify/model/calibration_data.hpp"
#include "bathyal/selection/decisions.hpp"
#include "bathyal/selection/selection.hpp"

namespace bathyal {
namespace diagnosis {
namespace {

void check_effects(const std::vector<std::shared_ptr<const Effect>>& effects) {
  std::set<std::string> names;
  for (const auto& effect : effects) {
    if (!effect) throw_argument("effects", "effects", "nothing in place of one");
    const std::string name = effect->info().name;
    if (!names.insert(name).second) throw_argument("effects", "each effect once", name + " twice");
  }
}

/// Numbers of the groups in the order of their first rows.
std::vector<int> numbered(const std::vector<std::string>& groups) {
  std::map<std::string, int> known;
  std::vector<int> out;
  for (const std::string& group : groups)
    out.push_back(known.emplace(group, static_cast<int>(known.size())).first->second);
  return out;
}

void check_groups(const std::vector<std::string>& groups, Index rows) {
  if (groups.empty()) return;
  const auto count = static_cast<Index>(groups.size());
  if (count != rows) {
    throw_argument("groups", std::to_string(rows) + " labels, one a row", std::to_string(count));
  }
  const std::set<std::string> different(groups.begin(), groups.end());
  if (static_cast<int>(different.size()) < selection::Decisions::kMinGivenGroups) {
    throw_argument("groups", "two groups or more", "\"" + groups.front() + "\" in all rows");
  }
}

/// Effects that the caller chose, and that act by a weight that these data do not have.
void check_weight(const EffectData& data,
                  const std::vector<std::shared_ptr<const Effect>>& effects) {
  if (masses_known(*data.arm) || data.has("payload")) return;
  std::set<std::string> names;
  for (const auto& effect : effects) names.insert(effect->info().name);
  const auto library = library_effects();
  const bool chosen = std::any_of(library.begin(), library.end(), [&](const auto& effect) {
    return !names.contains(effect->info().name);
  });
  for (const auto& effect : effects) {
    if (!chosen || !effect->needs_weight({})) continue;
    throw_argument("effects", "effects that these data can show",
                   effect->info().name +
                       ", which an arm without masses does not feel: give its links their masses, "
                       "or record `payload`");
  }
}

void check_positions_differ(const RowMatrix& position) {
  if ((position.rowwise() - position.row(0)).cwiseAbs().maxCoeff() > 0.0) return;
  throw_argument("position", "positions that differ", "the same in all rows");
}

/// Of a long record of tracked poses, the result of a search in a subset of rows; else empty. Rows
/// are drawn at random, so that they follow no grid of the record.
selection::Shortlist shortlist_from_subset(ArmModel& arm_model, int num_threads,
                                           const DiagnosisProgress& progress) {
  constexpr int kLong = 6000, kLookedAt = 3000;
  const int count = static_cast<int>(arm_model.observations().count());
  if (count <= kLong || !arm_model.is_tracked()) return {};
  std::vector<int> rows(static_cast<std::size_t>(count));
  std::iota(rows.begin(), rows.end(), 0);
  RandomStream random(0);
  for (int i = 0; i < kLookedAt; ++i) {
    std::swap(rows[i], rows[i + static_cast<int>(random.uniform(0.0, count - i))]);
  }
  rows.resize(kLookedAt);
  std::sort(rows.begin(), rows.end());
  ArmModel subset(arm_model, rows);
  selection::Shortlist found = selection::shortlist_terms(subset, num_threads, progress);
  arm_model.take_terms(subset);
  return found;
}

IdentifyOptions identify_options(const DiagnoseOptions& options) {
  IdentifyOptions identify;
  identify.parametrization = options.parametrization;
  identify.fixed = options.fixed;
  identify.length_prior = options.length_prior;
  identify.num_threads = options.num_threads;
  return identify;
}

/// What is found in a record; the model is fitted with it.
selection::SelectionResult select(ArmModel& arm_model, const DiagnoseOptions& options,
                                  const DiagnosisProgress& progress) {
  const selection::SelectionOptions asked{options.num_threads, options.blocks,
                                          numbered(options.groups)};
  const selection::Shortlist shortlist =
      shortlist_from_subset(arm_model, options.num_threads, progress);
  return selection::select_terms(arm_model, asked, progress, shortlist);
}

/// The values at `rows` of each covariate.
Covariates covariates_of_rows(const Covariates& covariates, const std::vector<int>& rows) {
  Covariates out;
  for (const auto& [name, values] : covariates) out[name] = values(rows, Eigen::all);
  return out;
}

/// Of all rows, by what is found in `rows` alone.
Prediction predict(const Arm& arm, const Measurement& all, const Covariates& covariates,
                   const DiagnoseOptions& options,
                   const std::vector<std::shared_ptr<const Effect>>& effects,
                   const std::vector<int>& rows, const DiagnosisProgress& progress) {
  Measurement some = subset(all, rows);
  some.perturbation_rows.clear();
  const IdentifyOptions identify = identify_options(options);
  ArmModel arm_model(arm, some, covariates_of_rows(covariates, rows), identify, effects);
  DiagnoseOptions of_some = options;
  of_some.groups = picked(options.groups, rows);
  // Of two groups one is left, which is held out in blocks.
  const std::set<std::string> groups(of_some.groups.begin(), of_some.groups.end());
  if (groups.size() < selection::Decisions::kMinGivenGroups) of_some.groups.clear();
  const Diagnosis found =
      report(arm_model, some, arm, select(arm_model, of_some, progress), of_some);
  Prediction out{found.verdict, {}, {}};
  for (const NamedEffect& effect : found.effects) out.found.emplace_back(effect.name, effect.joint);
  Covariates known;
  for (const auto& [name, values] : used_covariates(arm_model.data())) {
    if (covariates.contains(name)) known[name] = covariates.at(name);
  }
  const Eigen::Matrix3Xd tips = tips_of_model(found, arm_model, all, known, options.num_threads);
  out.errors = (tips - all.position).colwise().norm();
  const std::set<int> tools(some.tool.begin(), some.tool.end());
  const std::set<int> stations(some.station.begin(), some.station.end());
  for (Index i = 0; i < all.rows(); ++i) {
    if (tools.contains(all.tool[i]) && stations.contains(all.station[i])) continue;
    out.errors[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return out;
}

/// Folds of whole groups, where there are some.
selection::Folds nested_folds(const ArmModel& arm_model, const DiagnoseOptions& options) {
  const selection::Folds folds =
      options.groups.empty() ? selection::make_folds(arm_model.observations(), options.nested)
                             : selection::folds_of_groups(numbered(options.groups));
  if (folds.count >= selection::Decisions::kMinGivenGroups) return folds;
  throw_argument("nested", "0 where the poses make no two blocks that differ",
                 std::to_string(options.nested));
}

Diagnosis run(const Arm& arm, const Measurement& measurement, const Covariates& covariates,
              const DiagnoseOptions& options,
              const std::vector<std::shared_ptr<const Effect>>& effects,
              const DiagnosisProgress& progress) {
  check_effects(effects);
  // Bad covariates are refused before the long computation.
  check_weight(make_effect_data(arm, measurement.q, covariates, measurement.has_rotation()),
               effects);
  const IdentifyOptions identify = identify_options(options);
  ArmModel arm_model(arm, measurement, covariates, identify, effects);
  const bool nested = options.nested > 0;
  const selection::Folds folds = nested ? nested_folds(arm_model, options) : selection::Folds{};
  // Each diagnosis is a part of the work.
  const double parts = 1.0 + folds.count;
  const auto progress_from = [&](double begin) -> DiagnosisProgress {
    if (!progress || !nested) return progress;
    return [&, begin](double done, const std::string& stage) {
      progress((begin + done) / parts, begin > 0.0 ? stage + " without a fold" : stage);
    };
  };
  const selection::SelectionResult found = select(arm_model, options, progress_from(0.0));
  Diagnosis out = report(arm_model, measurement, arm, found, options);
  check_model(out, arm_model, measurement, options.num_threads);
  for (const auto& sentences :
       {arm_model.geometry_warnings(), check_room(arm, arm_model.state(), measurement),
        arm_model.untried(), check_record(arm_model.data(), effects)}) {
    out.warnings.insert(out.warnings.end(), sentences.begin(), sentences.end());
  }
  if (out.verdict == Verdict::kAmbiguous) {
    out.next_poses = next_poses(arm_model, found, options.rival_odds, options.num_next_poses);
  }
  if (nested) {
    const auto without = [&](const std::vector<int>& rows, int fold) {
      return predict(arm, measurement, covariates, options, effects, rows,
                     progress_from(1.0 + fold));
    };
    cross_validate_whole(folds, found.outliers, without, out);
    if (progress) progress(1.0, "done");
  }
  return out;
}

template <class Data>
Diagnosis run_without_duplicates(const Arm& arm, const Data& data, const DiagnoseOptions& options,
                                 const std::vector<std::shared_ptr<const Effect>>& effects,
                                 const DiagnosisProgress& progress) {
  check_groups(options.groups, data.q.rows());
  const std::vector<int> first = find_duplicates(data);
  const Data once = without_duplicates(data, first);
  DiagnoseOptions of_once = options;
  of_once.groups = picked(options.groups, distinct_rows(first));
  check_groups(of_once.groups, once.q.rows());
  Diagnosis out = run(arm, to_measurement(arm, once), once.covariates, of_once, effects, progress);
  expand_to_duplicates(first, out);
  return out;
}

}  // namespace
}  // namespace diagnosis

void DiagnoseOptions::check() const {
  check_range("blocks", blocks, 3, 50);
  check_range("rival_odds", rival_odds, 0.0, 1.0);
  check_not_negative("leftover", leftover);
  if (length_prior) check_positive("length_prior", *length_prior);
  constexpr int kMostNextPoses = 1000;
  constexpr int kMostNested = 50;
  if (nested != 0) check_range("nested", nested, 2, kMostNested);
  check_range("num_next_poses", num_next_poses, 0, kMostNextPoses);
}

Diagnosis diagnose(const Arm& arm, const Touches& touches, const DiagnoseOptions& options,
                   const std::vector<std::shared_ptr<const Effect>>& effects,
                   const DiagnosisProgress& progress) {
  options.check();
  touches.check();
  if (options.nested != 0) {
    throw_argument("nested", "0 for touches: where a touched point lies is not measured",
                   std::to_string(options.nested));
  }
  return diagnosis::run_without_duplicates(arm, touches, options, effects, progress);
}

Diagnosis diagnose(const Arm& arm, const Tracked& tracked, const DiagnoseOptions& options,
                   const std::vector<std::shared_ptr<const Effect>>& effects,
                   const DiagnosisProgress& progress) {
  options.check();
  tracked.check();
  diagnosis::check_positions_differ(tracked.position);
  return diagnosis::run_without_duplicates(arm, tracked, options, effects, progress);
}

}  // namespace bathyal
