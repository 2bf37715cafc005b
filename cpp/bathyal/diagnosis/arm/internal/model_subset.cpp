// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>

#include "bathyal/diagnosis/arm/internal/model.hpp"

// A model of a subset of another's rows.

namespace bathyal::diagnosis {
namespace {

EffectData subset_of(const EffectData& all, const std::vector<int>& rows) {
  EffectData out = all;
  out.q = all.q(rows, Eigen::all);
  out.gravity = all.gravity(rows, Eigen::all);
  for (auto& [name, values] : out.covariates) values = RowMatrix(values(rows, Eigen::all));
  std::vector<int> at(static_cast<std::size_t>(all.rows()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) at[rows[i]] = static_cast<int>(i);
  out.order.clear();
  for (const int row : all.order) {
    if (at[row] >= 0) out.order.push_back(at[row]);
  }
  return out;
}

std::unique_ptr<const Measurement> own_rows(const Measurement& all, const std::vector<int>& rows) {
  auto out = std::make_unique<Measurement>(subset(all, rows));
  out->perturbation_rows.clear();
  return out;
}

}  // namespace

ArmModel::ArmModel(const ArmModel& whole, const std::vector<int>& rows)
    : ArmModel(whole, rows, own_rows(whole.m_, rows)) {}

ArmModel::ArmModel(const ArmModel& whole, const std::vector<int>& rows,
                   std::unique_ptr<const Measurement>&& own)
    : ArmModel(whole.nominal_, *own, std::move(own), whole.problem_.options) {
  data_ = subset_of(whole.data_, rows);
  record_ = whole.data_;
  data_.arm = record_->arm = &effects_arm_;
  rows_ = rows;
  gather_observations();
  take_terms(whole);
  largest_ = whole.largest_;
  find_record_effects();
  evaluate_effects_at(x_);
  linearize_at(x_);
}

void ArmModel::take_terms(const ArmModel& subset) {
  terms_ = subset.terms_;
  sources_ = subset.sources_;
  scans_ = subset.scans_;
  neighbours_ = subset.neighbours_;
}

std::vector<std::vector<Perturbation>> ArmModel::perturbations_of(
    const Effect& effect, const EffectVariant& variant) const {
  std::vector<std::vector<Perturbation>> out =
      needs_record_.contains(&effect) ? perturbations_in_record(effect, variant)
                                      : bathyal::perturbations_of(effect, variant, data_);
  silence(effect, variant, out);
  return out;
}

/// Evaluated with all rows of the record.
std::vector<std::vector<Perturbation>> ArmModel::perturbations_in_record(
    const Effect& effect, const EffectVariant& variant) const {
  std::vector<std::vector<Perturbation>> out = bathyal::perturbations_of(effect, variant, *record_);
  for (std::vector<Perturbation>& perturbations : out) {
    for (Perturbation& perturbation : perturbations)
      perturbation.values = RowMatrix(perturbation.values(rows_, Eigen::all));
  }
  return out;
}

/// Effects that depend on neighbouring rows (speeds, positions in a list), by their first and last
/// variants.
void ArmModel::find_record_effects() {
  std::map<const Effect*, std::vector<const EffectVariant*>> terms;
  for (const Source& source : sources_) {
    if (source.effect) terms[source.effect.get()].push_back(&source.variant);
  }
  const auto same = [](const std::vector<std::vector<Perturbation>>& a,
                       const std::vector<std::vector<Perturbation>>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](const auto& first, const auto& second) {
      return std::equal(
          first.begin(), first.end(), second.begin(),
          [](const Perturbation& x, const Perturbation& y) { return x.values == y.values; });
    });
  };
  for (const auto& [effect, variants] : terms) {
    for (const EffectVariant* variant : {variants.front(), variants.back()}) {
      if (!same(bathyal::perturbations_of(*effect, *variant, data_),
                perturbations_in_record(*effect, *variant))) {
        needs_record_.insert(effect);
      }
    }
  }
}

}  // namespace bathyal::diagnosis
