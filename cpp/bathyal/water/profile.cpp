// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/text.hpp"
#include "bathyal/water/seawater.hpp"

namespace bathyal {
namespace {

using Column = std::vector<double> WaterProfile::*;

struct NamedColumn {
  const char* name;
  Column column;
  double low;
  double high;
};

constexpr std::array<NamedColumn, 5> kColumns{{
    {"depth", &WaterProfile::depth, 0.0, 12000.0},
    {"temperature", &WaterProfile::temperature, -10.0, 60.0},
    {"salinity", &WaterProfile::salinity, 0.0, 100.0},
    {"sound_speed", &WaterProfile::sound_speed, 1300.0, 1800.0},
    {"pressure", &WaterProfile::pressure, -10.0, 13000.0},
}};

std::string row_text(const char* name, std::size_t row, double value) {
  return std::string(name) + " " + to_text(value) + " in row " + std::to_string(row);
}

bool present(const std::vector<double>& column) {
  return std::any_of(column.begin(), column.end(), [](double v) { return std::isfinite(v); });
}

/// Rows with every number that the cast measures, at or below the surface.
std::vector<std::size_t> whole_rows(const WaterProfile& profile,
                                    const std::vector<NamedColumn>& columns) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < profile.depth.size(); ++i) {
    const bool whole = std::all_of(columns.begin(), columns.end(), [&](const NamedColumn& c) {
      return std::isfinite((profile.*c.column)[i]);
    });
    if (whole && profile.depth[i] >= 0.0) rows.push_back(i);
  }
  return rows;
}

/// Rows to be averaged, one list a row of the result: layers of `step`, or equal depths.
std::vector<std::vector<std::size_t>> groups_of(const WaterProfile& profile,
                                                const std::vector<std::size_t>& rows, double step) {
  std::vector<std::vector<std::size_t>> groups;
  double deepest = -1.0;
  for (const std::size_t row : rows) {
    const double depth = profile.depth[row];
    if (depth < deepest) continue;
    const bool joined =
        !groups.empty() &&
        (step > 0.0 ? std::floor(depth / step) == std::floor(deepest / step) : depth == deepest);
    if (!joined) groups.emplace_back();
    groups.back().push_back(row);
    deepest = depth;
  }
  return groups;
}

}  // namespace

void WaterProfile::check_columns() const {
  for (const NamedColumn& c : kColumns) {
    const std::vector<double>& values = this->*c.column;
    if (!values.empty() && values.size() != depth.size()) {
      throw_argument(c.name, counted(static_cast<long>(depth.size()), "value") + ", one a depth",
                     std::to_string(values.size()));
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isinf(values[i])) {
        throw_argument(c.name, "finite numbers, NaN where none was measured",
                       row_text(c.name, i, values[i]));
      }
    }
  }
}

void WaterProfile::check() const {
  check_columns();
  if (depth.size() < 2) {
    throw_argument("profile",
                   "at least two rows (water that is the same everywhere is made by temperature=, "
                   "salinity= and sound_speed=, without a profile)",
                   counted(static_cast<long>(depth.size()), "row"));
  }
  for (const NamedColumn& c : kColumns) {
    const std::vector<double>& values = this->*c.column;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(values[i] >= c.low && values[i] <= c.high)) {
        throw_argument("profile",
                       std::string(c.name) + " from " + to_text(c.low) + " to " + to_text(c.high) +
                           " in every row (Profile.cleaned() leaves out what is missing)",
                       row_text(c.name, i, values[i]));
      }
    }
  }
  for (std::size_t i = 1; i < depth.size(); ++i) {
    if (!(depth[i] > depth[i - 1])) {
      throw_argument("profile", "rising depths (Profile.cleaned() keeps the way down)",
                     to_text(depth[i]) + " m after " + to_text(depth[i - 1]) + " m in row " +
                         std::to_string(i));
    }
  }
}

void CleanProfileOptions::check() const { check_not_negative("step", step); }

WaterProfile clean_profile(const WaterProfile& profile, const CleanProfileOptions& options) {
  options.check();
  profile.check_columns();
  std::vector<NamedColumn> columns;
  for (const NamedColumn& c : kColumns) {
    if (present(profile.*c.column)) columns.push_back(c);
  }
  WaterProfile result = profile;
  for (const NamedColumn& c : kColumns) (result.*c.column).clear();
  const auto groups = groups_of(profile, whole_rows(profile, columns), options.step);
  for (const std::vector<std::size_t>& group : groups) {
    for (const NamedColumn& c : columns) {
      double sum = 0.0;
      for (const std::size_t row : group) sum += (profile.*c.column)[row];
      (result.*c.column).push_back(sum / static_cast<double>(group.size()));
    }
  }
  if (groups.size() < 2) {
    throw_argument("profile", "at least two depths with every number of the cast",
                   counted(static_cast<long>(groups.size()), "such depth") + " among " +
                       counted(static_cast<long>(profile.depth.size()), "row"));
  }
  return result;
}

std::vector<double> profile_sound_speed(const WaterProfile& profile, SoundSpeedFormula formula,
                                        double latitude) {
  if (profile.temperature.empty() || profile.salinity.empty()) {
    throw_argument("profile", "temperature and salinity, from which to compute the sound speed",
                   profile.temperature.empty() ? "no temperature" : "no salinity");
  }
  std::vector<double> speed(profile.depth.size());
  for (std::size_t i = 0; i < speed.size(); ++i) {
    const double pressure = profile.pressure.empty()
                                ? pressure_from_depth(profile.depth[i], latitude)
                                : profile.pressure[i];
    speed[i] = sound_speed(formula, profile.temperature[i], profile.salinity[i],
                           {.depth = profile.depth[i], .pressure = pressure});
  }
  return speed;
}

double column_at(const WaterProfile& profile, const std::vector<double>& column, double depth) {
  const auto above = std::upper_bound(profile.depth.begin(), profile.depth.end(), depth);
  if (above == profile.depth.begin()) return column.front();
  if (above == profile.depth.end()) return column.back();
  const auto row = static_cast<std::size_t>(above - profile.depth.begin());
  const double part =
      (depth - profile.depth[row - 1]) / (profile.depth[row] - profile.depth[row - 1]);
  return column[row - 1] + part * (column[row] - column[row - 1]);
}

}  // namespace bathyal
