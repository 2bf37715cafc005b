// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/devices/thruster_table.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

void check_rising(std::string_view name, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    check_finite(name, values[i]);
    if (i > 0 && !(values[i] > values[i - 1])) {
      throw_argument(name, "rising numbers",
                     to_text(values[i]) + " after " + to_text(values[i - 1]));
    }
  }
}

void check_values(std::string_view name, const std::vector<double>& values, std::size_t size) {
  if (values.size() != size) {
    throw_argument(name, std::to_string(size) + " numbers, one a voltage and command",
                   std::to_string(values.size()));
  }
  for (const double value : values) check_finite(name, value);
}

/// Between which two of the rising `values`, and how far.
struct Place {
  std::size_t low = 0, high = 0;
  double share = 0.0;
};

Place place_of(const std::vector<double>& values, double value) {
  if (!(value > values.front())) return {};
  if (value >= values.back()) return {values.size() - 1, values.size() - 1, 0.0};
  const auto above = std::upper_bound(values.begin(), values.end(), value);
  const auto high = static_cast<std::size_t>(above - values.begin());
  return {high - 1, high, (value - values[high - 1]) / (values[high] - values[high - 1])};
}

}  // namespace

void ThrusterTable::check() const {
  if (command.size() < 2) {
    throw_argument("command", "2 commands or more", std::to_string(command.size()));
  }
  if (voltage.empty()) throw_argument("voltage", "1 voltage or more", "none");
  check_rising("command", command);
  check_range("command", command.front(), -1.0, 1.0);
  check_range("command", command.back(), -1.0, 1.0);
  check_rising("voltage", voltage);
  check_positive("voltage", voltage.front());
  const std::size_t size = command.size() * voltage.size();
  check_values("thrust", thrust, size);
  check_values("power", power, size);
  check_values("speed", speed, size);
  for (const double value : power) check_not_negative("power", value);
}

ThrusterPoint ThrusterTable::measured(std::size_t row, std::size_t column) const {
  const std::size_t i = row * command.size() + column;
  return {thrust[i], power[i], speed[i]};
}

ThrusterPoint ThrusterTable::at(double at_command, double at_voltage) const {
  const Place column = place_of(command, at_command), row = place_of(voltage, at_voltage);
  const auto between = [&](const std::vector<double>& values) {
    const auto along = [&](std::size_t r) {
      const double* first = values.data() + r * command.size();
      return (1.0 - column.share) * first[column.low] + column.share * first[column.high];
    };
    return (1.0 - row.share) * along(row.low) + row.share * along(row.high);
  };
  return {between(thrust), between(power), between(speed)};
}

}  // namespace bathyal
