// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bathyal/compensation/corrected_arm.hpp"

// Why effects of a corrected arm do not lie within its support, row by row. An argument that lies
// beyond is a reason for an effect only if the effect depends on it: if the effect changes when
// that argument alone is moved to the nearest value of the support.

namespace bathyal {
namespace {

using PerturbationLists = std::vector<std::vector<Perturbation>>;

bool same_in_row(const PerturbationLists& one, const PerturbationLists& other, Index row) {
  for (std::size_t p = 0; p < one.size(); ++p) {
    for (std::size_t i = 0; i < one[p].size(); ++i) {
      if (one[p][i].values.row(row) != other[p][i].values.row(row)) return false;
    }
  }
  return true;
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string range_text(double low, double high) {
  return number_text(low) + " to " + number_text(high);
}

/// "joint 2 at 1.7 rad, data -1 to 1"; "temperature unknown".
std::string place_text(const std::string& name, double asked, const std::string& unit, double low,
                       double high) {
  if (std::isnan(asked)) return name + " unknown";
  return name + " at " + number_text(asked) + unit + ", data " + range_text(low, high);
}

std::string use_text(EffectUse use) {
  switch (use) {
    case EffectUse::kExtrapolated:
      return " extrapolated";
    case EffectUse::kHeld:
      return " held";
    case EffectUse::kOmitted:
      return " omitted";
    case EffectUse::kWithin:
      break;
  }
  return "";
}

/// One argument of effects, in rows where it lies beyond the support: `low` and `high` are `query`
/// with that argument alone moved within, as QueryRows.
struct Argument {
  std::vector<std::string> texts;  ///< of each row; empty where it lies within
  EffectData low;
  EffectData high;
};

bool is_prismatic(const Arm& arm, Index coordinate) {
  return std::any_of(arm.joints().begin(), arm.joints().end(), [&](const Joint& joint) {
    return joint.coordinate == coordinate && joint.type == JointType::kPrismatic;
  });
}

/// The arguments that lie beyond in any row.
class Arguments {
 public:
  Arguments(const Support& support, const QueryRows& rows, const Covariates& given)
      : support_(support), rows_(rows), given_(given) {
    for (Index j = 0; j < rows.query.q.cols(); ++j) add_joint(j);
    if (rows.query.gravity != rows.low.gravity) add_gravity();
    for (const auto& [name, values] : rows.query.covariates) {
      if (name != "gravity") add_covariate(name, values);
    }
  }

  /// All of them, and joints that lie in gaps wider than `period`.
  std::vector<Argument> with_gaps(double period) const {
    std::vector<Argument> out = list_;
    for (Index j = 0; j < rows_.query.q.cols(); ++j) {
      Argument in_gap = gap(j, period);
      if (!in_gap.texts.empty()) out.push_back(std::move(in_gap));
    }
    return out;
  }

 private:
  /// That a joint lies in a gap wider than `period`; no texts where none does.
  Argument gap(Index joint, double period) const {
    Argument out{{}, rows_.query, rows_.query};
    RowMatrix near = rows_.low.q;
    if (!support_.leave_gaps(period, near)) return out;
    const auto wide = support_.gaps_wider_than(period, joint);
    std::vector<std::string> texts(static_cast<std::size_t>(near.rows()));
    bool any = false;
    for (Index i = 0; i < near.rows(); ++i) {
      const double value = rows_.low.q(i, joint);
      if (near(i, joint) == value) continue;
      const auto at = std::find_if(wide.begin(), wide.end(),
                                   [&](const Support::Gap& g) { return value < g.high; });
      texts[i] = joint_name(joint) + " at " + number_text(value) + unit(joint) +
                 ", in the gap of the data from " + range_text(at->low, at->high);
      any = true;
    }
    if (!any) return out;
    out.texts = std::move(texts);
    out.low.q.col(joint) = out.high.q.col(joint) = near.col(joint);
    return out;
  }

  static std::string joint_name(Index joint) { return "joint " + std::to_string(joint + 1); }
  std::string unit(Index joint) const {
    return is_prismatic(*rows_.query.arm, joint) ? " m" : " rad";
  }

  void add_joint(Index j) {
    if (rows_.query.q.col(j) == rows_.low.q.col(j)) return;
    Argument out = unchanged();
    out.low.q.col(j) = out.high.q.col(j) = rows_.low.q.col(j);
    for (Index i = 0; i < rows_.query.rows(); ++i) {
      if (rows_.query.q(i, j) == rows_.low.q(i, j)) continue;
      out.texts[i] = place_text(joint_name(j), rows_.query.q(i, j), unit(j), support_.joints.low[j],
                                support_.joints.high[j]);
    }
    list_.push_back(std::move(out));
  }

  void add_gravity() {
    Argument out = unchanged();
    out.low.gravity = rows_.low.gravity;
    out.high.gravity = rows_.high.gravity;
    for (auto [data, from] : {std::pair(&out.low, &rows_.low), std::pair(&out.high, &rows_.high)}) {
      if (data->covariates.contains("gravity"))
        data->covariates["gravity"] = from->covariates.at("gravity");
    }
    for (Index i = 0; i < rows_.query.rows(); ++i) {
      if (rows_.query.gravity.row(i) != rows_.low.gravity.row(i))
        out.texts[i] = "gravity beyond that of the data";
    }
    list_.push_back(std::move(out));
  }

  void add_covariate(const std::string& name, const RowMatrix& values) {
    const RowMatrix& low = rows_.low.covariates.at(name);
    const RowMatrix& high = rows_.high.covariates.at(name);
    if (values == low && values == high) return;
    Argument out = unchanged();
    out.low.covariates[name] = low;
    out.high.covariates[name] = high;
    const auto given = given_.find(name);
    for (Index i = 0; i < values.rows(); ++i) {
      for (Index k = 0; k < values.cols() && out.texts[i].empty(); ++k) {
        if (values(i, k) == low(i, k) && values(i, k) == high(i, k)) continue;
        const double asked = given == given_.end()
                                 ? values(i, k)
                                 : given->second(given->second.rows() == 1 ? 0 : i, k);
        out.texts[i] = covariate_text(name, asked, k);
      }
    }
    list_.push_back(std::move(out));
  }

  std::string covariate_text(const std::string& name, double asked, Index column) const {
    if (name == "session" && !std::isnan(asked))
      return "session " + number_text(asked) + ", not in the data";
    const auto range = support_.covariates.find(name);
    if (range == support_.covariates.end()) return name + " unknown";
    return place_text(name, asked, "", range->second.low[column], range->second.high[column]);
  }

  Argument unchanged() const {
    return {std::vector<std::string>(static_cast<std::size_t>(rows_.query.rows())), rows_.query,
            rows_.query};
  }

  const Support& support_;
  const QueryRows& rows_;
  const Covariates& given_;
  std::vector<Argument> list_;
};

/// The reasons of each row: an argument once, with all effects that it concerns.
class Reasons {
 public:
  explicit Reasons(Index rows) : by_row_(static_cast<std::size_t>(rows)) {}

  void add(Index row, const std::string& place, const std::string& effect) {
    auto& reasons = by_row_[static_cast<std::size_t>(row)];
    auto at = std::find_if(reasons.begin(), reasons.end(),
                           [&](const Reason& reason) { return reason.place == place; });
    if (at == reasons.end()) at = reasons.insert(at, {place, {}});
    if (std::find(at->effects.begin(), at->effects.end(), effect) == at->effects.end())
      at->effects.push_back(effect);
  }

  std::string text(std::size_t row) const {
    std::string out;
    for (const Reason& reason : by_row_[row]) {
      out += (out.empty() ? "" : "; ") + reason.place + ": ";
      for (std::size_t e = 0; e < reason.effects.size(); ++e)
        out += (e == 0 ? "" : ", ") + reason.effects[e];
    }
    return out;
  }

 private:
  struct Reason {
    std::string place;
    std::vector<std::string> effects;
  };
  std::vector<std::vector<Reason>> by_row_;
};

/// Of each row and argument, whether the effect depends on it there; where it depends on none of
/// them alone, on all that lie beyond together.
std::vector<std::vector<char>> depends_on(const FoundEffect& found, const EffectData& query,
                                          const std::vector<Argument>& arguments) {
  const auto evaluated_at = [&found](const EffectData& data) {
    return perturbations_of(*found.effect, found.variant, data);
  };
  const auto rows = static_cast<std::size_t>(query.rows());
  std::vector<std::vector<char>> out(rows, std::vector<char>(arguments.size(), 0));
  const PerturbationLists asked = evaluated_at(query);
  for (std::size_t a = 0; a < arguments.size(); ++a) {
    const PerturbationLists low = evaluated_at(arguments[a].low);
    const PerturbationLists high = evaluated_at(arguments[a].high);
    for (std::size_t i = 0; i < rows; ++i) {
      const auto row = static_cast<Index>(i);
      out[i][a] = !same_in_row(asked, low, row) || !same_in_row(asked, high, row);
    }
  }
  for (std::size_t i = 0; i < rows; ++i) {
    if (std::find(out[i].begin(), out[i].end(), 1) != out[i].end()) continue;
    for (std::size_t a = 0; a < arguments.size(); ++a) out[i][a] = !arguments[a].texts[i].empty();
  }
  return out;
}

/// The given rows of a table, or its only row.
Covariates picked(const Covariates& covariates, const std::vector<Index>& rows) {
  Covariates out;
  for (const auto& [name, values] : covariates) {
    out[name] = values.rows() == 1 ? values : RowMatrix(values(rows, Eigen::all));
  }
  return out;
}

}  // namespace

std::vector<std::string> CorrectedArm::support_reasons(JointView q,
                                                       const Covariates& covariates) const {
  const EffectUses all_uses = effect_uses(q, covariates);
  const SupportMask inside = within(all_uses);
  std::vector<std::string> out(static_cast<std::size_t>(q.rows()));
  std::vector<Index> beyond;
  for (Index i = 0; i < q.rows(); ++i) {
    if (!inside.row(i).all()) beyond.push_back(i);
  }
  if (beyond.empty()) return out;
  const EffectUses uses = all_uses(beyond, Eigen::all);
  const Covariates given = picked(covariates, beyond);
  const QueryRows rows = clamp_to_support(arm_, support_, RowMatrix(q(beyond, Eigen::all)), given);
  const Arguments arguments(support_, rows, given);
  const std::vector<char> usable = usable_effects(covariates);
  Reasons reasons(uses.rows());
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const auto column = static_cast<Index>(e);
    if (inside.col(column).all()) continue;
    const auto add = [&](Index i, const std::string& place) {
      reasons.add(i, place, describe(effects_[e]) + use_text(uses(i, column)));
    };
    if (usable[e] == 0) {
      for (const std::string& name : effects_[e].effect->info().needs) {
        if (covariates.contains(name)) continue;
        for (Index i = 0; i < uses.rows(); ++i) add(i, name + " not given");
      }
      continue;
    }
    const std::vector<Argument> own = arguments.with_gaps(periods_[e]);
    const auto depends = depends_on(effects_[e], rows.query, own);
    for (Index i = 0; i < uses.rows(); ++i) {
      for (std::size_t a = 0; a < own.size(); ++a) {
        if (uses(i, column) != EffectUse::kWithin && depends[i][a] != 0)
          add(i, own[a].texts[static_cast<std::size_t>(i)]);
      }
    }
  }
  for (std::size_t i = 0; i < beyond.size(); ++i)
    out[static_cast<std::size_t>(beyond[i])] = reasons.text(i);
  return out;
}

}  // namespace bathyal
