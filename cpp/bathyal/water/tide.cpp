// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/tide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/water/internal/rising.hpp"

namespace bathyal {
namespace {

constexpr std::array<std::pair<const char*, double>, 9> kDegreesPerHour{{
    {"M2", 28.9841042},
    {"S2", 30.0},
    {"N2", 28.4397295},
    {"K2", 30.0821373},
    {"K1", 15.0410686},
    {"O1", 13.9430356},
    {"P1", 14.9589314},
    {"Q1", 13.3986609},
    {"M4", 57.9682084},
}};

}  // namespace

double tide_rate(const std::string& name) {
  std::string names;
  for (const auto& [known, rate] : kDegreesPerHour) {
    if (name == known) return rate * std::numbers::pi / 180.0 / 3600.0;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw_argument("constituent", "one of " + names, "\"" + name + "\"");
}

Tide::Tide(std::vector<TideConstituent> constituents) : constituents_(std::move(constituents)) {
  for (const TideConstituent& c : constituents_) {
    check_not_negative("amplitude", c.amplitude);
    check_not_negative("rate", c.rate);
    check_finite("phase", c.phase);
  }
}

Tide::Tide(std::vector<double> time, std::vector<double> height)
    : time_(std::move(time)), height_(std::move(height)) {
  if (time_.empty()) throw_argument("time", "at least one time", "none");
  check_rising("time", time_);
  if (height_.size() != time_.size()) {
    throw_argument("height", std::to_string(time_.size()) + " heights, one a time",
                   std::to_string(height_.size()));
  }
  for (const double h : height_) check_finite("height", h);
}

double Tide::height(double time) const {
  double sum = 0.0;
  for (const TideConstituent& c : constituents_) {
    sum += c.amplitude * std::cos(c.rate * time - c.phase);
  }
  if (!time_.empty()) {
    const Interval in = interval_of(time_, time);
    sum += height_[in.low] + in.share * (height_[in.high] - height_[in.low]);
  }
  return sum;
}

double Tide::rate(double time) const {
  double sum = 0.0;
  for (const TideConstituent& c : constituents_) {
    sum -= c.amplitude * c.rate * std::sin(c.rate * time - c.phase);
  }
  if (!time_.empty()) {
    const Interval in = interval_of(time_, time);
    if (in.high > in.low) {
      sum += (height_[in.high] - height_[in.low]) / (time_[in.high] - time_[in.low]);
    }
  }
  return sum;
}

double Tide::highest() const {
  double sum = 0.0;
  for (const TideConstituent& c : constituents_) sum += c.amplitude;
  double table = 0.0;
  for (const double h : height_) table = std::max(table, h);
  return sum + table;
}

}  // namespace bathyal
