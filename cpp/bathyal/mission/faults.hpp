// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/mission/plan.hpp"

namespace bathyal {

struct FaultState {
  bool active = false;
  double since = 0.0;  ///< [s]
  bool over = false;   ///< one that comes once has come
};

/// Begins and ends faults. \param changed rows that did either
void update_faults(const std::vector<MissionFault>& faults, std::vector<FaultState>& states,
                   double time, double tick, std::int64_t number, std::span<const double> signals,
                   std::uint64_t seed, std::vector<int>& changed);

/// What faults make of a sensor's reading. \param held the last one before it got stuck
/// \return whether it comes at all
bool apply_sensor_fault(const MissionFault& fault, const FaultState& state, std::uint64_t seed,
                        const SensorReading& held, SensorReading& reading);

/// What faults make of a command to a thruster or fin. \param held the angle of a fin that is stuck
double apply_drive_fault(const MissionFault& fault, double command, double held);

std::string_view fault_name(FaultKind kind);
/// \throw std::invalid_argument that lists the names for another
FaultKind fault_kind(std::string_view name);

}  // namespace bathyal
