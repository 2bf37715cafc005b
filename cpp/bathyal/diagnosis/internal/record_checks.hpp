// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bathyal/effects/effect.hpp"

namespace bathyal::diagnosis {

/// What a person should know of what was recorded beside the poses, in sentences: covariates that
/// are missing in parts or never change, times that run backwards, sessions too short to tell,
/// effects of the user's own that want what was not recorded. For use inside the room.
std::vector<std::string> check_record(const EffectData& data,
                                      const std::vector<std::shared_ptr<const Effect>>& effects);

}  // namespace bathyal::diagnosis
