// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>

#include "bathyal/diagnosis/arm/internal/model.hpp"

// A subject beside some rows of another's.

namespace bathyal {
namespace {

EffectData some_of(const EffectData& all, const std::vector<int>& rows) {
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

ArmSubject::ArmSubject(const ArmSubject& whole, const std::vector<int>& rows)
    : ArmSubject(whole, rows, own_rows(whole.m_, rows)) {}

ArmSubject::ArmSubject(const ArmSubject& whole, const std::vector<int>& rows,
                       std::unique_ptr<const Measurement>&& some)
    : ArmSubject(whole.nominal_, *some, std::move(some), whole.problem_.options) {
  data_ = some_of(whole.data_, rows);
  record_ = whole.data_;
  data_.arm = record_->arm = &effects_arm_;
  rows_ = rows;
  gather_units();
  take_forms(whole);
  find_those_that_need_the_record();
  evaluate_effects_at(x_);
  stand_at(x_);
}

void ArmSubject::take_forms(const ArmSubject& some) {
  forms_ = some.forms_;
  sources_ = some.sources_;
  scans_ = some.scans_;
  neighbours_ = some.neighbours_;
}

std::vector<std::vector<Perturbation>> ArmSubject::perturbations_of(
    const Effect& effect, const EffectVariant& variant) const {
  if (!needs_record_.contains(&effect)) return bathyal::perturbations_of(effect, variant, data_);
  return perturbations_in_record(effect, variant);
}

/// Of a row that is seen among all rows of the record.
std::vector<std::vector<Perturbation>> ArmSubject::perturbations_in_record(
    const Effect& effect, const EffectVariant& variant) const {
  std::vector<std::vector<Perturbation>> out = bathyal::perturbations_of(effect, variant, *record_);
  for (std::vector<Perturbation>& perturbations : out) {
    for (Perturbation& perturbation : perturbations)
      perturbation.values = RowMatrix(perturbation.values(rows_, Eigen::all));
  }
  return out;
}

/// Effects whose rows look at others (speeds, places in a list): their first and last forms are
/// tried.
void ArmSubject::find_those_that_need_the_record() {
  std::map<const Effect*, std::vector<const EffectVariant*>> forms;
  for (const Source& source : sources_) {
    if (source.effect) forms[source.effect.get()].push_back(&source.variant);
  }
  const auto same = [](const std::vector<std::vector<Perturbation>>& a,
                       const std::vector<std::vector<Perturbation>>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](const auto& first, const auto& second) {
      return std::equal(
          first.begin(), first.end(), second.begin(),
          [](const Perturbation& x, const Perturbation& y) { return x.values == y.values; });
    });
  };
  for (const auto& [effect, variants] : forms) {
    for (const EffectVariant* variant : {variants.front(), variants.back()}) {
      if (!same(bathyal::perturbations_of(*effect, *variant, data_),
                perturbations_in_record(*effect, *variant))) {
        needs_record_.insert(effect);
      }
    }
  }
}

}  // namespace bathyal
