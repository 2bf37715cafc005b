// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/copies.hpp"

#include <map>

#include "bathyal/identify/wording.hpp"

namespace bathyal {
namespace {

/// Rows that are copies of none, in their order.
std::vector<int> firsts(const std::vector<int>& of) {
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(of.size()); ++i) {
    if (of[i] == i) rows.push_back(i);
  }
  return rows;
}

template <class Item>
std::vector<Item> picked(const std::vector<Item>& all, const std::vector<int>& rows) {
  std::vector<Item> some;
  for (const int row : rows) {
    if (!all.empty()) some.push_back(all[row]);
  }
  return some;
}

}  // namespace

std::vector<int> find_copies(const Tracked& tracked) {
  std::map<std::vector<double>, int> known;
  std::vector<int> of;
  for (int i = 0; i < static_cast<int>(tracked.q.rows()); ++i) {
    std::vector<double> numbers(tracked.q.row(i).begin(), tracked.q.row(i).end());
    numbers.insert(numbers.end(), tracked.position.row(i).begin(), tracked.position.row(i).end());
    if (!tracked.pose.empty()) {
      const auto turned = tracked.pose[i].linear().reshaped();
      numbers.insert(numbers.end(), turned.begin(), turned.end());
    }
    for (const std::vector<int>& number : {tracked.tool, tracked.station}) {
      if (!number.empty()) numbers.push_back(number[i]);
    }
    of.push_back(known.emplace(std::move(numbers), i).first->second);
  }
  return of;
}

Tracked without_copies(const Tracked& tracked, const std::vector<int>& of) {
  const std::vector<int> rows = firsts(of);
  Tracked out;
  out.q = tracked.q(rows, Eigen::all);
  out.position = tracked.position(rows, Eigen::all);
  out.pose = picked(tracked.pose, rows);
  out.weights = picked(tracked.weights, rows);
  out.tool = picked(tracked.tool, rows);
  out.station = picked(tracked.station, rows);
  for (const auto& [name, values] : tracked.covariates) {
    out.covariates[name] = values(rows, Eigen::all);
  }
  return out;
}

void spread_over_copies(const std::vector<int>& of, Diagnosis& diagnosis) {
  const std::vector<int> rows = firsts(of);
  const std::size_t copies = of.size() - rows.size();
  if (copies == 0) return;
  std::map<int, int> place;
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) place[rows[i]] = i;
  std::vector<int> from, told;
  for (int i = 0; i < static_cast<int>(of.size()); ++i) {
    from.push_back(place[of[i]]);
    if (of[i] != i) told.push_back(i);
  }
  for (Eigen::Matrix3Xd* residuals : {&diagnosis.residuals_before, &diagnosis.residuals_after,
                                      &diagnosis.fit.residuals, &diagnosis.fit.residuals_before}) {
    *residuals = Eigen::Matrix3Xd((*residuals)(Eigen::all, from));
  }
  for (Eigen::VectorXd* errors : {&diagnosis.held_out.before, &diagnosis.held_out.after}) {
    if (errors->size() > 0) *errors = Eigen::VectorXd((*errors)(from));
  }
  for (NamedEffect& effect : diagnosis.effects) {
    for (int& row : effect.rows) row = rows[row];
  }
  for (Outlier& outlier : diagnosis.fit.outliers) outlier.row = rows[outlier.row];
  diagnosis.warnings.push_back(
      (copies == 1 ? "One row is a copy" : std::to_string(copies) + " rows are copies") +
      std::string(" of others to the last digit (") + (copies == 1 ? "row " : "rows ") +
      listed(told, 3) +
      ", counted from 0). No instrument measures the same twice: they were left out, and have the "
      "errors of the rows that they repeat.");
}

}  // namespace bathyal
