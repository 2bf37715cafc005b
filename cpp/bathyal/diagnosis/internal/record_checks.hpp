// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bathyal/effects/effect.hpp"

namespace bathyal::diagnosis {

/// Warnings about the covariates: partly missing or constant ones, times that run backwards,
/// sessions too short for a frame, effects of the user's own that need what was not recorded.
std::vector<std::string> check_record(const EffectData& data,
                                      const std::vector<std::shared_ptr<const Effect>>& effects);

}  // namespace bathyal::diagnosis
