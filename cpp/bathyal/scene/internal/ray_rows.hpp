// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "bathyal/geometry/shared_array.hpp"

// Errors of the functions that take rays as two arrays.

namespace bathyal::scene {

/// \throw std::invalid_argument unless `first` has one row or as many as `second`.
void check_rows(PointView first, PointView second, std::string_view first_name,
                std::string_view second_name);

/// \throw std::invalid_argument that says what is wrong with row `row`: `first` not finite, else
/// `second`, which should be what `expected` says.
[[noreturn]] void throw_bad_row(PointView first, PointView second, Index row,
                                std::string_view first_name, std::string_view second_name,
                                std::string_view expected);

}  // namespace bathyal::scene
