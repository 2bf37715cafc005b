// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "bathyal/world/material.hpp"

namespace bathyal {

/// Materials by name. Soils have the sediment parameters of APL-UW TR 9407 (1994), table 2, and the
/// strength of Lambert's law that is usual for them at some 100 kHz (Lurton 2010, chapter 3);
/// what is built has plausible values.
const std::vector<Material>& material_library();

}  // namespace bathyal
