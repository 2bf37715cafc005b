// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/internal/record_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "bathyal/base/text.hpp"
#include "bathyal/effects/gravity_load.hpp"

namespace bathyal::diagnosis {
namespace {

using Effects = std::vector<std::shared_ptr<const Effect>>;
using Sentences = std::vector<std::string>;

constexpr std::size_t kFewestSessionRows = 3;  ///< fewer determine no frame: effects/sessions.cpp

std::string number_of_rows(Index count) { return counted(static_cast<long>(count), "row"); }

/// Names of the effects that need a covariate.
std::string wanting(const std::string& covariate, const Effects& effects) {
  std::vector<std::string> names;
  for (const auto& effect : effects) {
    const EffectInfo info = effect->info();
    if (std::find(info.needs.begin(), info.needs.end(), covariate) != info.needs.end()) {
      names.push_back(info.name);
    }
  }
  return listed(names);
}

/// The assumption made without a covariate that was not recorded in every row.
std::string instead_of(const std::string& covariate) {
  static const std::map<std::string, std::string> known{
      {"time", "rows were taken in the order of the record"},
      {"session", "all rows were taken as one session"},
      {"payload", "the arm was taken to carry nothing"},
      {"gravity", "gravity was taken as 9.80665 m/s² down the base's z"}};
  const auto found = known.find(covariate);
  return found == known.end() ? "" : "; " + found->second;
}

void check_missing(const EffectData& data, const Effects& effects, Sentences& out) {
  for (const auto& [name, values] : data.covariates) {
    const auto missing = static_cast<Index>(
        std::count_if(values.rowwise().begin(), values.rowwise().end(),
                      [](const auto& row) { return !row.array().isFinite().all(); }));
    if (missing == 0) continue;
    const std::string blind = wanting(name, effects);
    std::string text = "`" + name + "` is missing in " + std::to_string(missing) + " of " +
                       number_of_rows(data.rows()) + " and was not used" + instead_of(name);
    if (!blind.empty()) text += "; what needs it was not looked for: " + blind;
    if (missing < data.rows()) text += ". To use it, diagnose the rows that have it by themselves";
    out.push_back(text + ".");
  }
}

/// Gravity and sessions may well be constant. A constant load still matters for an arm whose masses
/// are known.
void check_constant(const EffectData& data, Sentences& out) {
  for (const auto& [name, values] : data.covariates) {
    const bool expected =
        name == "gravity" || name == "session" || (name == "payload" && masses_known(*data.arm));
    if (expected || data.rows() < 2 || !data.has(name)) continue;
    if ((values.rowwise() - values.row(0)).cwiseAbs().maxCoeff() > 0.0) continue;
    out.push_back("`" + name +
                  "` is the same in all rows: its effect cannot be distinguished from the rest of "
                  "the arm.");
  }
}

/// Rows of each session, in their order; all rows where no sessions are given.
std::map<double, std::vector<int>> rows_by_session(const EffectData& data) {
  std::map<double, std::vector<int>> out;
  for (int i = 0; i < static_cast<int>(data.rows()); ++i) {
    out[data.has("session") ? data.covariate("session")(i, 0) : 0.0].push_back(i);
  }
  return out;
}

void check_time(const EffectData& data, Sentences& out) {
  if (!data.has("time")) return;
  const RowMatrix& time = data.covariate("time");
  std::vector<int> back;
  std::vector<std::array<double, 2>> spans;
  for (const auto& [session, rows] : rows_by_session(data)) {
    spans.push_back({time(rows[0], 0), time(rows[0], 0)});
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double now = time(rows[i], 0);
      if (now < time(rows[i - 1], 0)) back.push_back(rows[i]);
      spans.back() = {std::min(spans.back()[0], now), std::max(spans.back()[1], now)};
    }
  }
  if (!back.empty()) {
    out.push_back("`time` runs backwards " +
                  (back.size() == 1 ? "once, at row " + std::to_string(back[0])
                                    : std::to_string(back.size()) + " times, first at row " +
                                          std::to_string(*std::ranges::min_element(back))) +
                  " (counted from 0): rows were taken in the order of their times.");
  }
  std::sort(spans.begin(), spans.end());
  const bool overlap = std::adjacent_find(spans.begin(), spans.end(), [](auto a, auto b) {
                         return b[0] <= a[1];
                       }) != spans.end();
  if (overlap) {
    out.push_back(
        "Sessions overlap in `time`: drifts and slips were looked for as if by one clock. Where "
        "each session has a clock of its own, give times that continue from one to the next.");
  }
}

void check_sessions(const EffectData& data, Sentences& out) {
  if (!data.has("session")) return;
  const auto sessions = rows_by_session(data);
  const auto few = std::count_if(sessions.begin(), sessions.end(), [](const auto& session) {
    return session.second.size() < kFewestSessionRows;
  });
  if (few == 0) return;
  out.push_back(std::to_string(few) + " of " +
                counted(static_cast<long>(sessions.size()), "session") + " " +
                (few == 1 ? "has" : "have") +
                " fewer than three rows: whether base or tool moved there cannot be seen.");
}

void check_own_effects(const EffectData& data, const Effects& effects, Sentences& out) {
  std::set<std::string> library;
  for (const auto& effect : library_effects()) library.insert(effect->info().name);
  for (const auto& effect : effects) {
    const EffectInfo info = effect->info();
    if (library.contains(info.name)) continue;
    for (const std::string& need : info.needs) {
      if (data.covariates.contains(need)) continue;
      out.push_back("The effect " + info.name + " was not looked for: it needs `" + need +
                    "`, which was not recorded.");
    }
  }
}

}  // namespace

std::vector<std::string> check_record(const EffectData& data, const Effects& effects) {
  Sentences out;
  check_missing(data, effects, out);
  check_constant(data, out);
  check_time(data, out);
  check_sessions(data, out);
  check_own_effects(data, effects, out);
  return out;
}

}  // namespace bathyal::diagnosis
