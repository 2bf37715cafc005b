// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "bathyal/navigation/navigation_filter.hpp"

namespace bathyal {

/// All numbers of a filter's state, in the machine's own order of bytes; no padding among them, so
/// that equal states have equal bytes.
std::string to_bytes(const NavigationState& state);

/// The state that to_bytes() was given.
/// \throw std::invalid_argument for bytes that are none of it
NavigationState navigation_state_of(std::string_view bytes);

}  // namespace bathyal
