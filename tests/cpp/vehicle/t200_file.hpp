// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#include "bathyal/vehicle/devices/thruster_table.hpp"

namespace bathyal {

/// Blue Robotics' bollard tests, where they are.
inline std::optional<ThrusterTable> t200_table() {
  std::ifstream file(BATHYAL_SHARED_DATA "/thruster/t200_data.csv");
  std::string line;
  if (!std::getline(file, line)) return {};
  ThrusterTable table;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::array<double, 8> row{};
    for (double& value : row) {
      std::string cell;
      std::getline(cells, cell, ',');
      value = std::stod(cell);
    }
    if (table.voltage.empty() || table.voltage.back() != row[0]) table.voltage.push_back(row[0]);
    const double command = (row[1] - 1500.0) / 400.0;
    if (table.voltage.size() == 1) table.command.push_back(command);
    table.speed.push_back(std::copysign(row[2] / 60.0, command));
    table.power.push_back(row[5]);
    table.thrust.push_back(9.80665 * row[6]);
  }
  return table;
}

}  // namespace bathyal
