// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "bathyal/mission/run.hpp"

namespace bathyal {

/// A run's state with what it belongs to.
std::string saved_run(const MissionState& state, const std::string& fingerprint,
                      std::uint64_t seed);

/// \param like a state of the same plan: as many devices, leaves and so on
/// \throw Error for bytes that are no saved run, or of another plan or seed
MissionState loaded_run(const std::string& bytes, const MissionState& like,
                        const std::string& fingerprint, std::uint64_t seed);

}  // namespace bathyal
