// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/internal/duplicates.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bathyal/base/text.hpp"
#include "bathyal/identify/model/calibration_data.hpp"

namespace bathyal::diagnosis {
namespace {

using Numbers = std::vector<double>;

void add(Numbers& numbers, const auto& more) {
  constexpr double kUnknown = 1e300;  // larger than any covariate; NaN has no order
  for (const double value : more) numbers.push_back(std::isnan(value) ? kUnknown : value);
}

/// The values that duplicates share, of touches and tracked poses alike.
template <class Data>
Numbers row_values(const Data& data, int row) {
  Numbers numbers;
  add(numbers, data.q.row(row));
  for (const std::vector<int>* number : {&data.tool, &data.station}) {
    if (!number->empty()) numbers.push_back((*number)[row]);
  }
  for (const auto& [name, values] : data.covariates) {
    if (name != "time" && name != "session") add(numbers, values.row(row));
  }
  return numbers;
}

std::vector<int> first_alike(const std::vector<Numbers>& rows) {
  std::map<Numbers, int> known;
  std::vector<int> of;
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    of.push_back(known.emplace(rows[i], i).first->second);
  }
  return of;
}

template <class Data>
Data common_part(const Data& data, const std::vector<int>& rows) {
  Data out = data;
  out.q = data.q(rows, Eigen::all);
  out.weights = picked(data.weights, rows);
  out.tool = picked(data.tool, rows);
  out.station = picked(data.station, rows);
  for (auto& [name, values] : out.covariates) {
    values = RowMatrix(data.covariates.at(name)(rows, Eigen::all));
  }
  return out;
}

}  // namespace

std::vector<int> distinct_rows(const std::vector<int>& of) {
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(of.size()); ++i) {
    if (of[i] == i) rows.push_back(i);
  }
  return rows;
}

std::vector<int> find_duplicates(const Tracked& tracked) {
  std::vector<Numbers> rows;
  for (int i = 0; i < static_cast<int>(tracked.q.rows()); ++i) {
    rows.push_back(row_values(tracked, i));
    add(rows.back(), tracked.position.row(i));
    if (!tracked.pose.empty()) add(rows.back(), tracked.pose[i].linear().reshaped());
  }
  return first_alike(rows);
}

std::vector<int> find_duplicates(const Touches& touches) {
  std::vector<Numbers> rows;
  for (int i = 0; i < static_cast<int>(touches.q.rows()); ++i) {
    rows.push_back(row_values(touches, i));
    rows.back().push_back(touches.point[i]);
  }
  for (const TouchedPlane& plane : touches.planes) {
    for (const int row : plane.rows) rows[row].push_back(row);
  }
  return first_alike(rows);
}

Tracked without_duplicates(const Tracked& tracked, const std::vector<int>& of) {
  const std::vector<int> rows = distinct_rows(of);
  Tracked out = common_part(tracked, rows);
  out.position = tracked.position(rows, Eigen::all);
  out.pose = picked(tracked.pose, rows);
  return out;
}

Touches without_duplicates(const Touches& touches, const std::vector<int>& of) {
  const std::vector<int> rows = distinct_rows(of);
  Touches out = common_part(touches, rows);
  out.point = picked(touches.point, rows);
  for (TouchedPlane& plane : out.planes) {
    for (int& row : plane.rows) {
      row = static_cast<int>(std::ranges::lower_bound(rows, row) - rows.begin());
    }
  }
  return out;
}

void expand_to_duplicates(const std::vector<int>& of, Diagnosis& diagnosis) {
  const std::vector<int> rows = distinct_rows(of);
  const std::size_t copies = of.size() - rows.size();
  if (copies == 0) return;
  std::map<int, int> place;
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) place[rows[i]] = i;
  std::vector<int> from, duplicated;
  for (int i = 0; i < static_cast<int>(of.size()); ++i) {
    from.push_back(place[of[i]]);
    if (of[i] != i) duplicated.push_back(i);
  }
  for (Eigen::Matrix3Xd* residuals : {&diagnosis.residuals_before, &diagnosis.residuals_after,
                                      &diagnosis.fit.residuals, &diagnosis.fit.residuals_before}) {
    *residuals = Eigen::Matrix3Xd((*residuals)(Eigen::all, from));
  }
  HeldOut& held = diagnosis.held_out;
  for (Eigen::VectorXd* errors : {&held.before, &held.after, &held.nested.after}) {
    if (errors->size() > 0) *errors = Eigen::VectorXd((*errors)(from));
  }
  for (NamedEffect& effect : diagnosis.effects) {
    for (int& row : effect.rows) row = rows[row];
  }
  // Moments of slips count rows, of those that were kept.
  for (FoundEffect& found : diagnosis.found) {
    const auto moment = found.variant.settings.find("moment");
    if (moment == found.variant.settings.end() || found.variant.settings.contains("time")) continue;
    const double kept = moment->second;
    moment->second = rows[static_cast<std::size_t>(kept)];
    for (NamedEffect& effect : diagnosis.effects) {
      if (effect.name != found.variant.effect) continue;
      for (Estimate& setting : effect.parameters) {
        if (setting.name != "moment" || setting.value != kept) continue;
        setting.value = setting.low = setting.high = moment->second;
        effect.description = found.effect->describe(found.variant, diagnosis.arm);
      }
    }
  }
  for (Outlier& outlier : diagnosis.fit.outliers) outlier.row = rows[outlier.row];
  diagnosis.warnings.push_back(
      (copies == 1 ? "One row is a copy" : std::to_string(copies) + " rows are copies") +
      std::string(" of others to the last digit (") + (copies == 1 ? "row " : "rows ") +
      listed(duplicated, 3) +
      ", counted from 0). Nothing is measured the same twice: they were left out, and have the "
      "errors of the rows that they repeat.");
}

}  // namespace bathyal::diagnosis
